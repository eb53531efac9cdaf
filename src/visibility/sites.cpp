// Vertices become sites: rounded to even lattice points, equal ones become one.
#include "base/sort.h"
#include "visibility/drawn.h"
#include "visibility/mending.h"

namespace shodo {

namespace {

bool before(const LatticePoint& a, const LatticePoint& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

std::uint32_t entry_count(const Scene& scene, const Placement& placement) {
  PolygonWalk walk(scene, placement);
  for (Polygon polygon; walk.next(polygon);) {
  }
  return walk.entries();
}

/// The points of all entries of Placement::site_of; `order` gets those that are used.
std::uint32_t round_entries(const Scene& scene, const Placement& placement, std::span<LatticePoint> points,
                            std::span<std::uint32_t> order) {
  std::uint32_t entry = 0, count = 0;
  for (const Vec3& vertex : scene.vertices) {
    order[count++] = entry;
    points[entry++] = even_point(placement.lattice, vertex);
  }
  for (const Light& light : scene.lights) {
    for (const Vec3& corner : light.corners) {
      if (light.kind == LightKind::kArea) order[count++] = entry;
      points[entry++] = even_point(placement.lattice, corner);
    }
  }
  PolygonWalk walk(scene, placement);
  for (Polygon polygon; walk.next(polygon);) {
    if (polygon.along[0] == 0) continue;
    for (std::uint32_t edge = 0; edge < 4; ++edge) {
      for (std::uint32_t k = 1; k < polygon.along[edge % 2]; ++k) {
        order[count++] = entry;
        points[entry++] = even_point(placement.lattice, edge_point(scene, polygon, edge, k));
      }
    }
  }
  return count;
}

/// Numbers groups of equal points: those with a vertex of the file first, each kind in ascending order of position, so
/// that nothing depends on the order of the file. `order` is sorted by position, then by entry: a group's first entry
/// tells its kind.
void number_sites(std::span<const std::uint32_t> order, std::span<const LatticePoint> points,
                  std::uint32_t file_entries, Placement& placement) {
  std::uint32_t sites = 0;
  for (const bool of_file : {true, false}) {
    for (std::size_t k = 0; k < order.size();) {
      const LatticePoint& point = points[order[k]];
      const bool wanted = (order[k] < file_entries) == of_file;
      if (wanted) placement.sites[sites] = point;
      for (; k < order.size() && points[order[k]] == point; ++k) {
        if (wanted) placement.site_of[order[k]] = sites;
      }
      if (wanted) ++sites;
    }
    if (of_file) placement.vertex_sites = sites;
  }
  placement.sites = placement.sites.first(sites);
}

}  // namespace

bool make_sites(const Scene& scene, Arena& arena, Placement& placement) {
  const std::uint32_t entries = entry_count(scene, placement);
  if (!arena.take("vertices' sites", entries, placement.site_of)) return false;
  if (!arena.take("sites", entries, placement.sites)) return false;
  ArenaScratch scratch(arena);
  std::span<LatticePoint> points;
  std::span<std::uint32_t> order;
  if (!arena.take("rounded vertices", entries, points)) return false;
  if (!arena.take("order of vertices", entries, order)) return false;
  order = order.first(round_entries(scene, placement, points, order));
  heap_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return points[a] == points[b] ? a < b : before(points[a], points[b]);
  });
  const std::size_t file_entries = scene.vertices.size() + 4 * scene.lights.size();
  number_sites(order, points, static_cast<std::uint32_t>(file_entries), placement);
  return true;
}

}  // namespace shodo
