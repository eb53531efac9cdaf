// Where segments start and end: odd lattice points strictly in front of the surface they belong to.
//
// A point is rounded to the nearest odd point and moved by steps of 2 along the dominant axis of the polygon's normal
// until it is in front of the triangle that lies there; one division finds how many. A point beside all triangles (on a
// polygon's border, after rounding) takes the plane of the nearest of them. Where another polygon touches, the point is
// raised over what sticks out of its own first (raise.cpp).
// Exact: being in front. Approximate: the place, by a few lattice steps.
#include "visibility/geometry.h"
#include "visibility/placement.h"

namespace shodo {

namespace {

std::int64_t magnitude(std::int64_t x) { return x < 0 ? -x : x; }

std::int64_t component(const LatticeVector& v, std::uint32_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

std::uint32_t dominant_axis(const LatticeVector& n) {
  const std::int64_t x = magnitude(n.x), y = magnitude(n.y), z = magnitude(n.z);
  if (x >= y && x >= z) return 0;
  return y >= z ? 1 : 2;
}

/// Along `axis`, how far p lies outside the triangle in barycentric coordinates; 0 or less within or on it.
double outside(const Triangle& triangle, std::uint32_t axis, const LatticePoint& p) {
  const LatticePoint* corner[3] = {&triangle.a, &triangle.b, &triangle.c};
  const double whole = static_cast<double>(component(triangle.n, axis));
  double worst = -1;
  for (int k = 0; k < 3; ++k) {
    const LatticePoint &a = *corner[k], &b = *corner[(k + 1) % 3];
    const double part = -static_cast<double>(component(cross(b - a, p - a), axis)) / whole;
    if (part > worst) worst = part;
  }
  return worst;
}

void move_along(std::uint32_t axis, std::int64_t by, LatticePoint& p) {
  std::int32_t& coordinate = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  coordinate = static_cast<std::int32_t>(coordinate + by);
}

/// Strictly in front of `triangle` by the fewest steps of 2 along `axis`, where its normal isn't zero.
void move_in_front(const Triangle& triangle, std::uint32_t axis, LatticePoint& p) {
  const std::int64_t side = triangle.side(p);
  if (side > 0) return;
  const std::int64_t n = component(triangle.n, axis);
  const std::int64_t steps = -side / (2 * magnitude(n)) + 1;
  move_along(axis, n > 0 ? 2 * steps : -2 * steps, p);
}

std::int32_t coordinate(const LatticePoint& p, std::uint32_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Whether all triangles lie in one plane square to `axis`.
bool all_in_plane(std::span<const Triangle> triangles, std::uint32_t axis) {
  const std::int32_t plane = coordinate(triangles[0].a, axis);
  for (const Triangle& t : triangles) {
    for (const LatticePoint* corner : {&t.a, &t.b, &t.c}) {
      if (coordinate(*corner, axis) != plane) return false;
    }
  }
  return true;
}

FlatFront flat_front_of(std::span<const Triangle> triangles) {
  for (std::uint32_t axis = 0; axis < 3 && !triangles.empty(); ++axis) {
    if (!all_in_plane(triangles, axis)) continue;
    std::int64_t normal = 0;
    for (const Triangle& triangle : triangles) normal += component(triangle.n, axis);
    if (normal == 0) return {};
    return {axis, coordinate(triangles[0].a, axis), normal > 0 ? 1 : -1};
  }
  return {};
}

/// In front of the one of the triangles that lies at p as seen along the dominant axis of their common normal.
LatticePoint in_front(std::span<const Triangle> triangles, LatticePoint p) {
  if (const FlatFront front = flat_front_of(triangles); front.flat()) return front.move(p);
  LatticeVector normal;
  for (const Triangle& triangle : triangles) {
    normal = {normal.x + triangle.n.x, normal.y + triangle.n.y, normal.z + triangle.n.z};
  }
  const std::uint32_t axis = dominant_axis(normal);
  const bool up = component(normal, axis) > 0;
  const Triangle* nearest = nullptr;
  double least = 0;
  for (const Triangle& triangle : triangles) {
    const std::int64_t n = component(triangle.n, axis);
    if (n == 0 || (n > 0) != up) continue;  // a sliver that stands upright or is folded over
    const double distance = outside(triangle, axis, p);
    if (distance <= 0) {
      move_in_front(triangle, axis, p);
      nearest = nullptr;
      least = -1;
    } else if (least >= 0 && (nearest == nullptr || distance < least)) {
      nearest = &triangle;
      least = distance;
    }
  }
  if (nearest != nullptr) move_in_front(*nearest, axis, p);
  return p;
}

/// A face that another touches: over what that sticks out of it.
LatticePoint raised(std::span<const Triangle> triangles, std::uint32_t raise, LatticePoint p) {
  Vec3 normal;
  for (const Triangle& t : triangles) normal = normal + vector_of(t.n);
  normal = normalised(normal);
  const double half[3] = {0.5 * raise * normal.x, 0.5 * raise * normal.y, 0.5 * raise * normal.z};
  for (std::uint32_t k = 0; k < 3; ++k) {
    move_along(k, 2 * static_cast<std::int32_t>(half[k] < 0 ? half[k] - 0.5 : half[k] + 0.5), p);
  }
  return p;
}

LatticePoint in_front(const Geometry& geometry, const PolygonTriangles& range, LatticePoint p) {
  const std::span<const Triangle> triangles = geometry.triangles.subspan(range.first, range.count);
  return in_front(triangles, range.raise == 0 ? p : raised(triangles, range.raise, p));
}

}  // namespace

std::uint32_t lattice_quad(const Lattice& lattice, const Vec3* corners, Triangle (&triangles)[2]) {
  std::uint32_t count = 0;
  for (std::uint32_t half = 0; half < 2; ++half) {
    Triangle& triangle = triangles[count];
    triangle.a = even_point(lattice, corners[0]);
    triangle.b = even_point(lattice, corners[half + 1]);
    triangle.c = even_point(lattice, corners[half + 2]);
    triangle.n = cross(triangle.b - triangle.a, triangle.c - triangle.a);
    triangle.d = triangle.n.x * triangle.a.x + triangle.n.y * triangle.a.y + triangle.n.z * triangle.a.z;
    if (!(triangle.n == LatticeVector{})) ++count;
  }
  return count;
}

FlatFront flat_front(std::span<const Triangle> triangles) { return flat_front_of(triangles); }

LatticePoint sample_point(const Lattice& lattice, std::span<const Triangle> own, const Vec3& point) {
  return in_front(own, odd_point(lattice, point));
}

FlatFront flat_front(const Geometry& geometry, std::uint32_t mesh, std::uint32_t cell) {
  const PolygonTriangles range = geometry.cells[geometry.first_cell[mesh] + cell];
  return flat_front_of(geometry.triangles.subspan(range.first, range.count));
}

FlatFront flat_front(const Scene& scene, const Geometry& geometry, std::uint32_t light) {
  const PolygonTriangles range = geometry.light_triangles[light];
  if (range.count > 0) return flat_front_of(geometry.triangles.subspan(range.first, range.count));
  Triangle triangles[2];
  const std::uint32_t count = lattice_quad(geometry.lattice, scene.lights[light].corners, triangles);
  return flat_front_of(std::span<const Triangle>(triangles, count));
}

LatticePoint sample_point(const Scene& scene, const Geometry& geometry, std::uint32_t mesh, std::uint32_t cell,
                          const Vec3& point) {
  static_cast<void>(scene);
  const PolygonTriangles range = geometry.cells[geometry.first_cell[mesh] + cell];
  return in_front(geometry, range, odd_point(geometry.lattice, point));
}

LatticePoint light_sample_point(const Scene& scene, const Geometry& geometry, std::uint32_t light, const Vec3& point) {
  const LatticePoint p = odd_point(geometry.lattice, point);
  const PolygonTriangles range = geometry.light_triangles[light];
  if (range.count > 0) return in_front(geometry, range, p);
  Triangle triangles[2];
  const std::uint32_t count = lattice_quad(geometry.lattice, scene.lights[light].corners, triangles);
  return in_front(std::span<const Triangle>(triangles, count), p);
}

}  // namespace shodo
