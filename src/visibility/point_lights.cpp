// Where point lights stand (hard case 12): a light that lies on a surface counts as in front of it.
//
// A light within 2 lattice steps, in each coordinate, of some triangles goes to the nearest odd point that is strictly
// in front of them all: on an edge or in a corner, of each wall. Of two surfaces back to back the first of the file has
// the light, and the room behind stays dark. Scratch: 4 bytes a triangle that carries the light.
#include "visibility/placement.h"
#include "visibility/surface.h"

namespace shodo {

namespace {

/// How far a light may go, in steps of 2; walls that meet at a sharp angle need most.
constexpr std::int32_t kFurthest = 24;

bool carries(const Triangle& triangle, const LatticePoint& p) {
  SurfaceTriangle surface;
  return make_surface(triangle.a, triangle.b, triangle.c, surface) && lies_on(surface, p, kNearSteps);
}

/// Whether two normals are opposite to about 8 degrees.
bool back_to_back(const LatticeVector& a, const LatticeVector& b) {
  constexpr double kCosine = 0.99;
  const Vec3 x = vector_of(a), y = vector_of(b);
  return dot(x, y) < -kCosine * length(x) * length(y);
}

/// The triangles on which p lies, but those that stand back to back with an earlier one. `list` has room for all.
std::uint32_t carriers(std::span<const Triangle> triangles, const LatticePoint& p, std::span<std::uint32_t> list) {
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < triangles.size(); ++k) {
    if (!carries(triangles[k], p)) continue;
    bool taken = false;
    for (std::uint32_t j = 0; j < count; ++j) {
      taken = taken || back_to_back(triangles[list[j]].n, triangles[k].n);
    }
    if (!taken) list[count++] = k;
  }
  return count;
}

/// Whether p is strictly in front of the whole list.
bool in_front(std::span<const Triangle> triangles, std::span<const std::uint32_t> list, const LatticePoint& p) {
  for (const std::uint32_t k : list) {
    if (triangles[k].side(p) <= 0) return false;
  }
  return true;
}

/// The nearest point at even offsets from `given`, none larger than 2 `shell` and one that large, in front of the list.
bool search_shell(std::span<const Triangle> triangles, std::span<const std::uint32_t> list, const LatticePoint& given,
                  std::int32_t shell, LatticePoint& found) {
  std::int32_t nearest = INT32_MAX;
  for (std::int32_t z = -shell; z <= shell; ++z) {
    for (std::int32_t y = -shell; y <= shell; ++y) {
      const bool face = z == -shell || z == shell || y == -shell || y == shell;
      for (std::int32_t x = -shell; x <= shell; x += face || shell == 0 ? 1 : 2 * shell) {
        const std::int32_t distance = x * x + y * y + z * z;
        const LatticePoint p{given.x + 2 * x, given.y + 2 * y, given.z + 2 * z};
        if (distance >= nearest || !in_front(triangles, list, p)) continue;
        nearest = distance;
        found = p;
      }
    }
  }
  return nearest != INT32_MAX;
}

/// In front of all of the list; if there is no such place, of as many from its start as can be.
LatticePoint in_front_of(std::span<const Triangle> triangles, std::span<const std::uint32_t> list,
                         const LatticePoint& given) {
  for (; !list.empty(); list = list.first(list.size() - 1)) {
    LatticePoint found;
    for (std::int32_t shell = 0; shell <= kFurthest; ++shell) {
      if (search_shell(triangles, list, given, shell, found)) return found;
    }
  }
  return given;
}

}  // namespace

bool place_point_lights(const Scene& scene, Arena& arena, Geometry& geometry) {
  for (std::size_t k = 0; k < scene.lights.size(); ++k) {
    if (scene.lights[k].kind != LightKind::kPoint) continue;
    const LatticePoint given = odd_point(geometry.lattice, scene.lights[k].position);
    std::uint32_t count = 0;
    for (const Triangle& triangle : geometry.triangles) count += carries(triangle, given) ? 1 : 0;
    ArenaScratch scratch(arena);
    std::span<std::uint32_t> list;
    if (!arena.take("triangles that carry a light", count, list)) return false;
    count = carriers(geometry.triangles, given, list);
    geometry.light_points[k] = in_front_of(geometry.triangles, list.first(count), given);
  }
  return true;
}

}  // namespace shodo
