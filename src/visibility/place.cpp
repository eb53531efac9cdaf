// From a scene to mended polygons (design: exact visibility, T-junctions).
#include "visibility/mending.h"

namespace shodo {

namespace {

/// Where a vertex has been moved, an edge may cross a triangle that it did not cross before; one repetition is enough
/// for what rounding does.
constexpr int kCrossingPasses = 3;

}  // namespace

bool make_rings(const Scene& scene, Arena& arena, Placement& placement) {
  if (!arena.take("polygons' sites", polygon_count(scene), placement.rings)) return false;
  PolygonWalk walk(scene, placement);
  Polygon polygon;
  for (std::uint32_t p = 0; walk.next(polygon); ++p) {
    SiteRing& ring = placement.rings[p];
    for (int k = 0; k < 4; ++k) ring.site[k] = polygon.site[k];
    ring.corners = static_cast<std::uint8_t>(polygon.corners);
    ring.cut_from_1 = polygon.cut_from_1;
    ring.blocks = polygon.blocks;
  }
  return true;
}

bool place(const Scene& scene, Arena& arena, Placement& placement) {
  PolygonTree tree;
  return place(scene, arena, placement, tree);
}

bool place(const Scene& scene, Arena& arena, Placement& placement, PolygonTree& tree) {
  if (!make_sites(scene, arena, placement)) return false;
  if (!weld_sites(arena, placement)) return false;
  if (!make_rings(scene, arena, placement)) return false;
  if (!tree.build(placement, arena)) return false;
  if (!insert_vertices(tree, arena, placement)) return false;
  placement.file_sites = static_cast<std::uint32_t>(placement.sites.size());
  if (!move_vertices(tree, arena, placement)) return false;
  bool any = true;
  for (int pass = 0; any && pass < kCrossingPasses; ++pass) {
    if (!insert_crossings(tree, arena, placement, any)) return false;
    if (any && !move_vertices(tree, arena, placement)) return false;
  }
  return true;
}

}  // namespace shodo
