// Vertices that end on a surface: moved until on or beyond it.
//
// A partition that ends on a wall has vertices within the wall's polygons. Rounding leaves them a step short of it or a
// step beyond; short of it light would pass. So a vertex within 2 lattice steps, in each coordinate, of a polygon's
// interior goes in steps of 2 along the polygon's dominant axis to the side where none of its own polygons stands. What
// lies flat on a larger polygon (a picture on a wall) has no such side: it goes to the front of its own.
// Passes over all vertices, in order, until nothing changes, at most 8: a move may bring a vertex near another polygon.
// Scratch: 13 bytes a vertex.
#include "visibility/mending.h"
#include "visibility/surface.h"

namespace shodo {

namespace {

constexpr int kPasses = 8;
/// Lattice steps that a vertex moves in all, in each coordinate: as many as one move takes at most. Beside a strip as
/// thin as that, whose plane turns with every move, two vertices would chase each other.
constexpr std::int64_t kMost = 8;

/// The side of the plane on which the site has to be, or on the plane: +1, -1, or 0 if it may stay where it is.
int wanted_side(const Placement& placement, const PolygonTree& tree, std::uint32_t polygon,
                const SurfaceTriangle& surface, std::uint32_t site) {
  const Reach reach = reach_of(placement, tree, surface, site, site);
  if (reach.positive || reach.negative) return -reach.body();
  return reach.flush_area < ring_area(placement, polygon) ? reach.flush : 0;
}

/// Moves p to `wanted` side of the plane; false if it is there.
bool move_to_side(const SurfaceTriangle& surface, int wanted, LatticePoint& p) {
  const std::int64_t missing = -wanted * surface.side(p);
  if (missing <= 0) return false;
  const std::int64_t n = surface.n_axis();
  const std::int64_t size = 2 * (n < 0 ? -n : n);
  const std::int64_t by = 2 * ((missing + size - 1) / size) * ((n > 0) == (wanted > 0) ? 1 : -1);
  std::int32_t& coordinate = surface.axis == 0 ? p.x : surface.axis == 1 ? p.y : p.z;
  coordinate = static_cast<std::int32_t>(coordinate + by);
  return true;
}

bool far_from(const LatticePoint& p, const LatticePoint& q) {
  const LatticeVector d = p - q;
  return d.x > kMost || d.x < -kMost || d.y > kMost || d.y < -kMost || d.z > kMost || d.z < -kMost;
}

/// One site against all polygons near it; true if it moved.
bool settle(const PolygonTree& tree, Placement& placement, std::uint32_t site, const LatticePoint& start) {
  bool moved = false;
  const LatticePoint at = placement.sites[site];
  // A vertex where edges cross was found between two that are near, and rounded once more.
  const std::int64_t near = site < placement.file_sites ? kNearSteps : kNearSteps + 2;
  tree.visit([&](const LatticeBox& box) { return box.contains(at, kSearchMargin); },
             [&](std::uint32_t polygon) {
               if (!placement.rings[polygon].blocks || !polygon_box(placement, polygon).contains(at, kSearchMargin))
                 return;
               if (in_ring(placement, polygon, site)) return;
               for_surfaces(placement, polygon, [&](const SurfaceTriangle& surface) {
                 LatticePoint& p = placement.sites[site];
                 if (!lies_on(surface, p, near) || surface.side(p) == 0) return;
                 const int wanted = wanted_side(placement, tree, polygon, surface, site);
                 LatticePoint to = p;
                 if (wanted == 0 || !move_to_side(surface, wanted, to) || far_from(to, start)) return;
                 p = to;
                 moved = true;
               });
             });
  return moved;
}

}  // namespace

bool move_vertices(PolygonTree& tree, Arena& arena, Placement& placement) {
  ArenaScratch scratch(arena);
  std::span<std::uint8_t> has_moved;
  if (!arena.take("moved vertices", placement.sites.size(), has_moved)) return false;
  std::span<LatticePoint> start;
  if (!arena.take("vertices before moves", placement.sites.size(), start)) return false;
  for (std::size_t site = 0; site < start.size(); ++site) start[site] = placement.sites[site];
  for (int pass = 0; pass < kPasses; ++pass) {
    bool changed = false;
    for (std::uint32_t site = 0; site < placement.sites.size(); ++site) {
      if (placement.drawn_only(site) || !settle(tree, placement, site, start[site])) continue;
      changed = true;
      if (has_moved[site] == 0 && site < placement.vertex_sites) ++placement.moved;
      has_moved[site] = 1;
    }
    if (!changed) break;
    tree.fit(placement);
  }
  return true;
}

}  // namespace shodo
