// Edges that lie on a surface of several triangles.
//
// A surface that is plane in the file has creases of a lattice step once its vertices are rounded: along the diagonal
// of a quad, and between the cells of a grid. An edge whose ends are on or beyond the surface may then pass short of it
// in between. Where it crosses an edge of the surface's triangles, seen along the surface's axis, short of it by at
// most what rounding does, it gets a vertex there, which is then moved until on or beyond the surface like any other.
// From one such vertex to the next the edge passes one triangle only, and is beyond it all along. Exact: whether an
// edge passes short. Approximate: where the new vertex stands, which only has to be the same for all polygons along
// that edge: it is found from the ends in ascending order.
#include "base/sort.h"
#include "visibility/mending.h"
#include "visibility/surface.h"

namespace shodo {

namespace {

constexpr std::int32_t kReach = 8;  // lattice steps: more than rounding does along one axis

/// A new vertex between sites a < b.
struct Crossing {
  std::uint32_t a = 0, b = 0;
  double along = 0;  // 0 at a, 1 at b
  LatticePoint point;
};

bool before(const Crossing& x, const Crossing& y) {
  if (x.a != y.a) return x.a < y.a;
  if (x.b != y.b) return x.b < y.b;
  if (x.along != y.along) return x.along < y.along;
  return position_before(x.point, y.point);
}

/// visit(edge, from, to) for the pieces of a polygon's edges as a blocker, in the order of its ring.
template <class Visit>
void for_pieces(const Placement& placement, std::uint32_t polygon, Visit visit) {
  const SiteRing& ring = placement.rings[polygon];
  std::uint32_t next = placement.first_insertion[polygon];
  const std::uint32_t end = placement.first_insertion[polygon + 1];
  for (std::uint32_t edge = 0; edge < ring.corners; ++edge) {
    std::uint32_t from = ring.site[edge];
    for (; next < end && placement.insertions[next].edge == edge; ++next) {
      if (placement.insertions[next].drawn != 0) continue;
      visit(edge, from, placement.insertions[next].site);
      from = placement.insertions[next].site;
    }
    visit(edge, from, ring.site[(edge + 1) % ring.corners]);
  }
}

double coordinate(const LatticePoint& p, std::uint32_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

std::int32_t even(double x) {
  const double half = 0.5 * x;
  return 2 * static_cast<std::int32_t>(half < 0 ? half - 0.5 : half + 0.5);
}

/// The side of the surface, +1 or -1, on which the edge a-b passes the triangle's edge c-d where it crosses that, if it
/// does within what rounding does; 0 if not, or if they touch.
int passing_side(const SurfaceTriangle& surface, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                 const LatticePoint& d, Crossing& crossing) {
  const std::uint32_t axis = surface.axis;
  const std::int64_t at_a = orientation(axis, c, d, a), at_b = orientation(axis, c, d, b);
  if (at_a == 0 || at_b == 0 || (at_a > 0) == (at_b > 0)) return 0;
  const std::int64_t at_c = orientation(axis, a, b, c), at_d = orientation(axis, a, b, d);
  if ((at_c > 0 && at_d > 0) || (at_c < 0 && at_d < 0) || at_c == at_d) return 0;
  if (dot(cross(b - a, d - c), c - a) == 0) return 0;
  const double t = static_cast<double>(at_a) / (static_cast<double>(at_a) - static_cast<double>(at_b));
  const double u = static_cast<double>(at_c) / (static_cast<double>(at_c) - static_cast<double>(at_d));
  const double on_edge = coordinate(a, axis) + t * (coordinate(b, axis) - coordinate(a, axis));
  const double on_surface = coordinate(c, axis) + u * (coordinate(d, axis) - coordinate(c, axis));
  const double gap = (on_edge - on_surface) * static_cast<double>(surface.n_axis());
  const double most = static_cast<double>(kNearSteps * surface.n_sum);
  if (gap > most || gap < -most) return 0;
  crossing.along = t;
  crossing.point = {even(a.x + t * (static_cast<double>(b.x) - a.x)), even(a.y + t * (static_cast<double>(b.y) - a.y)),
                    even(a.z + t * (static_cast<double>(b.z) - a.z))};
  if (crossing.point == a || crossing.point == b) return 0;
  return gap > 0 ? 1 : gap < 0 ? -1 : 0;
}

bool has_piece(const Placement& placement, std::uint32_t polygon, std::uint32_t a, std::uint32_t b) {
  bool own = false;
  for_pieces(placement, polygon, [&](std::uint32_t, std::uint32_t from, std::uint32_t to) {
    own = own || (from == a && to == b) || (from == b && to == a);
  });
  return own;
}

/// Calls found(crossing) for every place where the edge between two sites, a < b, passes short of a polygon: on the
/// side on which everything stands that has this edge.
template <class Found>
void find_crossings(const Placement& placement, const PolygonTree& tree, std::uint32_t a, std::uint32_t b,
                    Found found) {
  const LatticePoint from = placement.sites[a], to = placement.sites[b];
  tree.visit([&](const LatticeBox& box) { return box.met_by(from, to, kReach); },
             [&](std::uint32_t polygon) {
               if (!placement.rings[polygon].blocks || !polygon_box(placement, polygon).met_by(from, to, kReach))
                 return;
               if (has_piece(placement, polygon, a, b)) return;
               for_surfaces(placement, polygon, [&](const SurfaceTriangle& surface) {
                 Crossing crossing{a, b, 0, {}};
                 for (int k = 0; k < 3; ++k) {
                   // Each edge one way, whichever of its triangles it is seen from.
                   const LatticePoint &c = surface.corner[k], &d = surface.corner[(k + 1) % 3];
                   const bool forward = position_before(c, d);
                   const int side = passing_side(surface, from, to, forward ? c : d, forward ? d : c, crossing);
                   if (side != 0 && side == reach_of(placement, tree, surface, a, b).body()) found(crossing);
                 }
               });
             });
}

/// Runs over all pieces of all polygons' edges; with an empty span it only counts.
std::uint32_t collect(const Placement& placement, const PolygonTree& tree, std::span<Crossing> crossings) {
  std::uint32_t count = 0;
  for (std::uint32_t polygon = 0; polygon < placement.rings.size(); ++polygon) {
    if (!placement.rings[polygon].blocks) continue;
    for_pieces(placement, polygon, [&](std::uint32_t, std::uint32_t from, std::uint32_t to) {
      find_crossings(placement, tree, from < to ? from : to, from < to ? to : from, [&](const Crossing& crossing) {
        if (count < crossings.size()) crossings[count] = crossing;
        ++count;
      });
    });
  }
  return count;
}

/// Equal places once; near ones (the surface's two triangles may see one slightly differently) only the first.
std::uint32_t drop_repeated(std::span<Crossing> crossings) {
  heap_sort(crossings, before);
  std::uint32_t kept = 0;
  for (const Crossing& crossing : crossings) {
    if (kept > 0) {
      const Crossing& last = crossings[kept - 1];
      if (last.a == crossing.a && last.b == crossing.b && last.point == crossing.point) continue;
    }
    crossings[kept++] = crossing;
  }
  return kept;
}

/// The crossings between two sites; `crossings` is sorted.
std::span<const Crossing> between(std::span<const Crossing> crossings, std::uint32_t from, std::uint32_t to,
                                  std::size_t& first) {
  const std::uint32_t a = from < to ? from : to, b = from < to ? to : from;
  std::size_t low = 0, high = crossings.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    const Crossing& at = crossings[middle];
    if (at.a < a || (at.a == a && at.b < b)) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  first = low;
  while (high < crossings.size() && crossings[high].a == a && crossings[high].b == b) ++high;
  return crossings.subspan(low, high - low);
}

/// A polygon's insertions with the crossings between them; `out` may be empty, to count.
std::uint32_t merge(const Placement& placement, std::uint32_t polygon, std::span<const Crossing> crossings,
                    std::uint32_t first_site, std::span<Insertion> out) {
  std::uint32_t count = 0, copied = placement.first_insertion[polygon];
  const auto put = [&](const Insertion& insertion) {
    if (count < out.size()) out[count] = insertion;
    ++count;
  };
  // Corners of drawn patches keep their places before the vertex that follows them.
  const auto copy_until = [&](std::uint32_t edge, std::uint32_t site) {
    while (copied < placement.first_insertion[polygon + 1] && placement.insertions[copied].edge == edge) {
      put(placement.insertions[copied]);
      if (placement.insertions[copied++].site == site) return;
    }
  };
  for_pieces(placement, polygon, [&](std::uint32_t edge, std::uint32_t from, std::uint32_t to) {
    std::size_t first = 0;
    const std::span<const Crossing> own = between(crossings, from, to, first);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const std::size_t at = from < to ? k : own.size() - 1 - k;
      put({polygon, static_cast<std::uint16_t>(edge), 0, static_cast<std::uint32_t>(first_site + first + at)});
    }
    copy_until(edge, to);
  });
  return count;
}

}  // namespace

bool insert_crossings(PolygonTree& tree, Arena& arena, Placement& placement, bool& any) {
  const std::uint32_t found = collect(placement, tree, {});
  any = found > 0;
  if (!any) return true;
  std::span<Crossing> crossings;
  if (!arena.take("crossings", found, crossings)) return false;
  collect(placement, tree, crossings);
  crossings = crossings.first(drop_repeated(crossings));
  const std::uint32_t old_sites = static_cast<std::uint32_t>(placement.sites.size());
  const std::uint32_t polygons = static_cast<std::uint32_t>(placement.rings.size());
  std::span<LatticePoint> sites;
  std::span<std::uint32_t> first;
  if (!arena.take("sites", old_sites + crossings.size(), sites)) return false;
  if (!arena.take("polygons' insertions", std::size_t{polygons} + 1, first)) return false;
  for (std::uint32_t k = 0; k < old_sites; ++k) sites[k] = placement.sites[k];
  for (std::size_t k = 0; k < crossings.size(); ++k) sites[old_sites + k] = crossings[k].point;
  for (std::uint32_t p = 0; p < polygons; ++p) first[p + 1] = first[p] + merge(placement, p, crossings, old_sites, {});
  std::span<Insertion> insertions;
  if (!arena.take("inserted vertices", first[polygons], insertions)) return false;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    merge(placement, p, crossings, old_sites, insertions.subspan(first[p], first[p + 1] - first[p]));
  }
  placement.inserted += static_cast<std::uint32_t>(crossings.size());
  placement.sites = sites;
  placement.first_insertion = first;
  placement.insertions = insertions;
  tree.fit(placement);
  return true;
}

}  // namespace shodo
