#include "visibility/surface.h"

namespace shodo {

namespace {

std::int64_t magnitude(std::int64_t x) { return x < 0 ? -x : x; }

std::int64_t largest(const LatticeVector& v) {
  std::int64_t most = magnitude(v.x);
  if (magnitude(v.y) > most) most = magnitude(v.y);
  return magnitude(v.z) > most ? magnitude(v.z) : most;
}

/// Rounding takes a vertex one step off in each coordinate, and so the plane: twice that is near, twice again is not.
constexpr std::int64_t kClear = 4;

void add_flush(const Placement& placement, const SurfaceTriangle& plane, std::uint32_t polygon, Reach& reach) {
  const LatticeVector n = ring_normal(placement, polygon);
  // The cosine's sign in double: the product doesn't fit 64 bits, and flush normals are far from square to each other.
  const double along = static_cast<double>(n.x) * static_cast<double>(plane.n.x) +
                       static_cast<double>(n.y) * static_cast<double>(plane.n.y) +
                       static_cast<double>(n.z) * static_cast<double>(plane.n.z);
  const int front = along > 0 ? 1 : along < 0 ? -1 : 0;
  reach.flush = !reach.found || reach.flush == front ? front : 0;
  reach.found = true;
  const double area = ring_area(placement, polygon);
  if (area > reach.flush_area) reach.flush_area = area;
}

}  // namespace

bool make_surface(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, SurfaceTriangle& surface) {
  surface.corner[0] = a;
  surface.corner[1] = b;
  surface.corner[2] = c;
  surface.n = cross(b - a, c - a);
  surface.d = surface.n.x * a.x + surface.n.y * a.y + surface.n.z * a.z;
  const std::int64_t x = magnitude(surface.n.x), y = magnitude(surface.n.y), z = magnitude(surface.n.z);
  surface.n_sum = x + y + z;
  surface.axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  std::int64_t longest = largest(b - a);
  if (largest(c - b) > longest) longest = largest(c - b);
  if (largest(a - c) > longest) longest = largest(a - c);
  return surface.n_sum > 4 * longest;
}

std::int64_t orientation(std::uint32_t axis, const LatticePoint& a, const LatticePoint& b, const LatticePoint& p) {
  const LatticeVector n = cross(b - a, p - a);
  return axis == 0 ? n.x : axis == 1 ? n.y : n.z;
}

bool lies_on(const SurfaceTriangle& surface, const LatticePoint& p, std::int64_t steps) {
  const std::int64_t side = surface.side(p);
  if (side > steps * surface.n_sum || side < -steps * surface.n_sum) return false;
  const std::int64_t sign = surface.n_axis() > 0 ? 1 : -1;
  for (int k = 0; k < 3; ++k) {
    const LatticePoint &a = surface.corner[k], &b = surface.corner[(k + 1) % 3];
    const LatticeVector along = b - a;
    const std::int64_t reach =
        (along.x < 0 ? -along.x : along.x) + (along.y < 0 ? -along.y : along.y) + (along.z < 0 ? -along.z : along.z);
    if (sign * orientation(surface.axis, a, b, p) < -steps * reach) return false;
  }
  return true;
}

bool in_ring(const Placement& placement, std::uint32_t polygon, std::uint32_t site) {
  const SiteRing& ring = placement.rings[polygon];
  for (std::uint32_t k = 0; k < ring.corners; ++k) {
    if (ring.site[k] == site) return true;
  }
  for (std::uint32_t k = placement.first_insertion[polygon]; k < placement.first_insertion[polygon + 1]; ++k) {
    if (placement.insertions[k].site == site && placement.insertions[k].drawn == 0) return true;
  }
  return false;
}

Ring blocking_ring(const Placement& placement, std::uint32_t polygon) {
  const SiteRing& sites = placement.rings[polygon];
  Ring ring;
  ring.edges = sites.corners;
  ring.cut_from_1 = sites.cut_from_1;
  std::uint32_t next = placement.first_insertion[polygon];
  const std::uint32_t end = placement.first_insertion[polygon + 1];
  for (std::uint32_t k = 0; k < ring.edges; ++k) {
    ring.edge[k].from.point = placement.sites[sites.site[k]];
    ring.edge[k].to.point = placement.sites[sites.site[(k + 1) % ring.edges]];
    const std::uint32_t first = next;
    while (next < end && placement.insertions[next].edge == k) ++next;
    ring.edge[k].inserted = placement.insertions.subspan(first, next - first);
  }
  return ring;
}

LatticeVector ring_normal(const Placement& placement, std::uint32_t polygon) {
  const SiteRing& ring = placement.rings[polygon];
  const LatticePoint &a = placement.sites[ring.site[0]], &b = placement.sites[ring.site[1]],
                     &c = placement.sites[ring.site[2]];
  if (ring.corners == 3) return cross(b - a, c - a);
  return cross(c - a, placement.sites[ring.site[3]] - b);
}

double ring_area(const Placement& placement, std::uint32_t polygon) {
  return length(vector_of(ring_normal(placement, polygon)));
}

Reach reach_of(const Placement& placement, const PolygonTree& tree, const SurfaceTriangle& plane, std::uint32_t a,
               std::uint32_t b) {
  Reach reach;
  const LatticePoint at = placement.sites[a];
  tree.visit([&](const LatticeBox& box) { return box.contains(at, kSearchMargin); },
             [&](std::uint32_t polygon) {
               const SiteRing& ring = placement.rings[polygon];
               if (!ring.blocks) return;
               if (!in_ring(placement, polygon, a) || !in_ring(placement, polygon, b)) return;
               bool off = false;
               for (std::uint32_t k = 0; k < ring.corners; ++k) {
                 const std::int64_t side = plane.side(placement.sites[ring.site[k]]);
                 if (side > kClear * plane.n_sum) reach.positive = off = true;
                 if (side < -kClear * plane.n_sum) reach.negative = off = true;
               }
               if (!off) add_flush(placement, plane, polygon, reach);
             });
  return reach;
}

}  // namespace shodo
