// Rays of the picture beyond what the camera's scanlines see: through glass, off mirrors, towards lights (paper 2.4).
//
// A ray starts at a lattice point and goes along a direction whose largest component is at most 2^20, so that all
// determinants fit 64 bits, as for segments (visibility/triangle_test.h). It meets the triangles that are drawn, not
// those that block: what a mirror shows is what the camera would see.
//
// A ray through an edge or a corner meets a triangulated pane once, not twice or never: visibility/half_open.h.
//
// Exact: which triangles are met, and their order along the ray; ties as in the picture (wins_tie). Approximate: the
// map coordinates of a hit, to 2^-15 of the triangle, and the point of a hit, to two lattice steps.
#pragma once

#include <cstdint>
#include <span>

#include "picture/seen_triangle.h"
#include "visibility/geometry.h"

namespace shodo {

inline constexpr std::int64_t kRayLength = std::int64_t{1} << 20;

struct Ray {
  LatticePoint origin;
  LatticeVector direction;  // the largest component is +-kRayLength, or less
};

/// The direction, halved or doubled until its largest component has 20 bits, rounded half away from zero; below 2^63.
LatticeVector ray_direction(const LatticeVector& any);

/// Where a ray meets a triangle: at the fraction distance / speed of the direction.
struct RayHit {
  std::uint32_t triangle = kNone;
  bool front = false;
  std::int64_t distance = 0;  // |s(origin)|
  std::int64_t speed = 1;     // |N.d|
  std::int64_t b = 0, c = 0;  // weights of the second and third corner, parts of `speed`

  bool any() const { return triangle != kNone; }
};

/// False if the ray misses it, or starts in its plane.
bool meet(const DrawnTriangle& triangle, std::uint32_t index, const Ray& ray, RayHit& hit);

/// Whether `a` comes before `b` on their ray: exact, and total.
bool comes_before(std::span<const DrawnTriangle> drawn, const RayHit& a, const RayHit& b);

/// Map coordinates, sub-patches 20.12.
struct MapPlace {
  std::int32_t u = 0, v = 0;
};
MapPlace map_place(const DrawnTriangle& triangle, const RayHit& hit);

/// A point's side of the triangle's plane: its distance times 2 areas, above 0 in front.
std::int64_t side_of(const DrawnTriangle& triangle, const LatticePoint& point);

/// An odd lattice point at the hit, to the nearest.
LatticePoint point_at(const Ray& ray, const RayHit& hit);

/// The same, strictly on the side of the triangle from which the ray comes.
LatticePoint point_before(const DrawnTriangle& triangle, const Ray& ray, const RayHit& hit);

/// The way on after a mirror: d - 2 (d.n) n / n.n, with n the triangle's normal as a ray_direction(). Off by at most
/// 2^-18 rad: what is 5 m away is 1/50 mm off.
LatticeVector mirrored(const DrawnTriangle& triangle, const LatticeVector& direction);

}  // namespace shodo
