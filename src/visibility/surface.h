// What mending asks of a polygon: its triangles as they will block, and on which side of one of them others stand.
#pragma once

#include "visibility/placement.h"
#include "visibility/polygon_tree.h"
#include "visibility/ring.h"

namespace shodo {

/// A triangle with area, its plane, and the axis along which it is seen largest.
struct SurfaceTriangle {
  LatticePoint corner[3];
  LatticeVector n;
  std::int64_t d = 0;
  std::int64_t n_sum = 0;  // |n.x| + |n.y| + |n.z|: one step in every coordinate is worth this much of side()
  std::uint32_t axis = 0;

  std::int64_t side(const LatticePoint& p) const { return n.x * p.x + n.y * p.y + n.z * p.z - d; }
  std::int64_t n_axis() const { return axis == 0 ? n.x : axis == 1 ? n.y : n.z; }
};

/// False if it has no area, or is so narrow (4 steps or less) that its plane says nothing.
bool make_surface(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, SurfaceTriangle& surface);

/// What lies on a surface in the file is at most so many steps off in each coordinate: one by its own rounding, one by
/// the surface's.
inline constexpr std::int64_t kNearSteps = 2;

/// Whether p is within `steps`, in each coordinate, of the triangle's plane, and seen along its axis in the triangle or
/// at most about as much beside it.
bool lies_on(const SurfaceTriangle& surface, const LatticePoint& p, std::int64_t steps);

/// Twice the area of a-b-p seen along an axis, positive counter-clockwise.
std::int64_t orientation(std::uint32_t axis, const LatticePoint& a, const LatticePoint& b, const LatticePoint& p);

/// Whether a site is a corner of a polygon, or inserted in one of its edges as a blocker.
bool in_ring(const Placement& placement, std::uint32_t polygon, std::uint32_t site);

/// The polygon's ring without map coordinates.
Ring blocking_ring(const Placement& placement, std::uint32_t polygon);

/// visit(surface) for each triangle of a polygon.
template <class Visit>
void for_surfaces(const Placement& placement, std::uint32_t polygon, Visit visit) {
  const TriangleSink sink{[](void* context, const RingVertex& a, const RingVertex& b, const RingVertex& c) {
                            SurfaceTriangle surface;
                            if (make_surface(a.point, b.point, c.point, surface))
                              (*static_cast<Visit*>(context))(surface);
                          },
                          &visit};
  cut_ring(blocking_ring(placement, polygon), placement.sites, false, sink);
}

/// Which sides of a plane the polygons on some site or edge reach, further than rounding does. If none: `flush` is the
/// side to which their fronts look, 0 if they don't agree, and `flush_area` the largest of them.
struct Reach {
  bool positive = false;
  bool negative = false;
  bool found = false;
  int flush = 0;
  double flush_area = 0;

  /// +1 or -1: the side on which everything stands; 0: both or none.
  int body() const { return positive == negative ? 0 : positive ? 1 : -1; }
};

/// Of the blocking polygons that have both sites in their rings (the same one twice: that one).
Reach reach_of(const Placement& placement, const PolygonTree& tree, const SurfaceTriangle& plane, std::uint32_t a,
               std::uint32_t b);

/// The length of the sum of a polygon's triangles' normals: twice its area in steps.
LatticeVector ring_normal(const Placement& placement, std::uint32_t polygon);
double ring_area(const Placement& placement, std::uint32_t polygon);

/// How far beyond its box a polygon is looked for: more than a vertex moves in one pass.
inline constexpr std::int32_t kSearchMargin = 64;

}  // namespace shodo
