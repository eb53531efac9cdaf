// T-junctions: a vertex within 2 lattice steps of an edge is inserted there.
//
// A vertex that lies on an edge in the file is at most one step off after rounding, in each coordinate, and so is the
// edge: two steps catch it. Which sites an edge gets depends on its two ends and the sites alone, not on the polygon,
// so two polygons with a common edge get the same chain, and no gap can open (design: T-junctions). Exact: the
// distance, in fractions.
#include "base/sort.h"
#include "visibility/mending.h"

namespace shodo {

namespace {

constexpr std::int64_t kReach = 2;  // lattice steps

struct Fraction {
  std::int64_t numerator = 0;
  std::int64_t denominator = 1;  // above 0
};

bool less(const Fraction& a, const Fraction& b) { return a.numerator * b.denominator < b.numerator * a.denominator; }

bool is_corner(const SiteRing& ring, std::uint32_t edge, std::uint32_t site) {
  return ring.site[edge] == site || ring.site[(edge + 1) % ring.corners] == site;
}

/// Calls found(polygon, edge) for every edge of a polygon that gets the site.
template <class Found>
void for_edges_near(const Placement& placement, const PolygonTree& tree, std::uint32_t site, Found found) {
  const LatticePoint v = placement.sites[site];
  tree.visit([&](const LatticeBox& box) { return box.contains(v, kReach); },
             [&](std::uint32_t polygon) {
               const SiteRing& ring = placement.rings[polygon];
               for (std::uint32_t edge = 0; edge < ring.corners; ++edge) {
                 if (is_corner(ring, edge, site)) continue;
                 const LatticePoint& a = placement.sites[ring.site[edge]];
                 const LatticePoint& b = placement.sites[ring.site[(edge + 1) % ring.corners]];
                 if (near_edge(a, b, v)) found(polygon, edge);
               }
             });
}

}  // namespace

bool near_edge(const LatticePoint& a, const LatticePoint& b, const LatticePoint& v) {
  const std::int64_t to[3] = {std::int64_t{v.x} - a.x, std::int64_t{v.y} - a.y, std::int64_t{v.z} - a.z};
  const std::int64_t along[3] = {std::int64_t{b.x} - a.x, std::int64_t{b.y} - a.y, std::int64_t{b.z} - a.z};
  // The fractions of the edge that are near enough in each coordinate; they must have one in common.
  Fraction enter, leave{1, 1};
  for (int k = 0; k < 3; ++k) {
    if (along[k] == 0) {
      if (to[k] > kReach || to[k] < -kReach) return false;
      continue;
    }
    const std::int64_t sign = along[k] > 0 ? 1 : -1;
    const Fraction first{sign * to[k] - kReach, sign * along[k]};
    const Fraction last{sign * to[k] + kReach, sign * along[k]};
    if (less(enter, first)) enter = first;
    if (less(last, leave)) leave = last;
  }
  return !less(leave, enter);
}

namespace {

/// In order from site a to site b; the same order, reversed, from b to a.
void sort_along_edge(const Placement& placement, std::uint32_t a, std::uint32_t b, std::span<Insertion> inserted) {
  const bool forward = a < b;
  const LatticePoint from = placement.sites[forward ? a : b];
  const LatticeVector along = placement.sites[forward ? b : a] - from;
  heap_sort(inserted, [&](const Insertion& x, const Insertion& y) {
    const std::int64_t at_x = dot(placement.sites[x.site] - from, along);
    const std::int64_t at_y = dot(placement.sites[y.site] - from, along);
    const bool before = at_x == at_y ? x.site < y.site : at_x < at_y;
    return forward ? before : !before && x.site != y.site;
  });
}

}  // namespace

void sort_insertions(Placement& placement, std::uint32_t polygon) {
  const std::uint32_t first = placement.first_insertion[polygon];
  const std::span<Insertion> own = placement.insertions.subspan(first, placement.first_insertion[polygon + 1] - first);
  heap_sort(
      own, [](const Insertion& a, const Insertion& b) { return a.edge == b.edge ? a.site < b.site : a.edge < b.edge; });
  const SiteRing& ring = placement.rings[polygon];
  for (std::size_t k = 0, end = 0; k < own.size(); k = end) {
    const std::uint32_t edge = own[k].edge;
    while (end < own.size() && own[end].edge == edge) ++end;
    sort_along_edge(placement, ring.site[edge], ring.site[(edge + 1) % ring.corners], own.subspan(k, end - k));
  }
}

bool insert_vertices(const PolygonTree& tree, Arena& arena, Placement& placement) {
  const std::uint32_t polygons = static_cast<std::uint32_t>(placement.rings.size());
  const std::uint32_t sites = static_cast<std::uint32_t>(placement.sites.size());
  if (!arena.take("polygons' insertions", std::size_t{polygons} + 1, placement.first_insertion)) return false;
  // Counted one place on, so that the sums below are the first of each polygon.
  for (std::uint32_t site = 0; site < sites; ++site) {
    bool inserted = false;
    for_edges_near(placement, tree, site, [&](std::uint32_t polygon, std::uint32_t) {
      ++placement.first_insertion[polygon + 1];
      inserted = true;
    });
    if (inserted && site < placement.vertex_sites) ++placement.inserted;
  }
  for (std::uint32_t p = 0; p < polygons; ++p) placement.first_insertion[p + 1] += placement.first_insertion[p];
  if (!arena.take("inserted vertices", placement.first_insertion[polygons], placement.insertions)) return false;
  ArenaScratch scratch(arena);
  std::span<std::uint32_t> next;
  if (!arena.take("next insertion", polygons, next)) return false;
  for (std::uint32_t p = 0; p < polygons; ++p) next[p] = placement.first_insertion[p];
  for (std::uint32_t site = 0; site < sites; ++site) {
    const std::uint16_t drawn = site < placement.vertex_sites ? 0 : 1;
    for_edges_near(placement, tree, site, [&](std::uint32_t polygon, std::uint32_t edge) {
      placement.insertions[next[polygon]++] = {polygon, static_cast<std::uint16_t>(edge), drawn, site};
    });
  }
  for (std::uint32_t p = 0; p < polygons; ++p) sort_insertions(placement, p);
  return true;
}

}  // namespace shodo
