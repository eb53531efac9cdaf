// Lambert's contour integral, clipped at the horizon (paper 2.1, 2.2).
//
// The corners are taken relative to the point, so that all that follows is small where the polygon is near. An edge is
// crossed with its own direction, r x (r' - r) and not r x r': of a polygon of size e at distance d the result then
// keeps all but d/e of its digits, and not only all but (d/e)^2.
//
// Approximate: a corner within kFlat of the horizon counts as on it, and a point within kFlat of the polygon's plane,
// both as sines of angles, receives nothing. What is lost so is below kFlat unless the point is that near to the
// polygon itself; what is gained is that rounding never shows a light to the surface on which it lies.
// Error otherwise below 2^-50 d/e + 2^-50 (tests/light/polygon_factor_test.cpp). 450 bytes of stack, no memory.
#include "light/polygon_factor.h"

namespace shodo {

namespace {

constexpr double kFlat = 0x1p-40;
/// A line meets four edges of a concave quadrilateral: at most two corners and four crossings remain.
constexpr std::uint32_t kMostCorners = 8;

/// The edge's term of Lambert's sum: the angle from r to r_next, times the cosine between `normal` and the normal of
/// the plane of both. The polygon runs counter-clockwise seen from the point, so that (r_next - r) x r points up.
double edge_term(const Vec3& r, const Vec3& r_next, const Vec3& normal) {
  const Vec3 across = cross(r_next - r, r);
  const double size = length(across);
  if (!(size > 0)) return 0;  // seen end on, or the point lies on it
  return arctangent2(size, dot(r, r_next)) * (dot(across, normal) / size);
}

/// Twice the vector area (planar, counter-clockwise seen from where it points).
Vec3 double_area(const Vec3* corner, std::uint32_t corners) {
  if (corners == 3) return cross(corner[1] - corner[0], corner[2] - corner[0]);
  return cross(corner[2] - corner[0], corner[3] - corner[1]);
}

/// The part of the polygon `from` above the horizon (Sutherland and Hodgman 1974); returns its number of corners.
/// A concave one may come out with edges that run along the horizon to and fro: their terms cancel.
std::uint32_t clip(const Vec3* from, const double* height, std::uint32_t corners, Vec3* to) {
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < corners; ++k) {
    const std::uint32_t next = k + 1 < corners ? k + 1 : 0;
    if (height[k] >= 0) to[count++] = from[k];
    if ((height[k] > 0 && height[next] < 0) || (height[k] < 0 && height[next] > 0)) {
      const double part = height[k] / (height[k] - height[next]);
      to[count++] = from[k] + part * (from[next] - from[k]);
    }
  }
  return count;
}

}  // namespace

double point_to_polygon(const Vec3& point, const Vec3& normal, const Vec3* corner, std::uint32_t corners) {
  Vec3 r[4];
  double height[4];
  bool any_above = false, any_below = false;
  double farthest = 0;
  for (std::uint32_t k = 0; k < corners; ++k) {
    r[k] = corner[k] - point;
    const double distance_squared = length_squared(r[k]);
    height[k] = dot(r[k], normal);
    if (height[k] * height[k] <= kFlat * kFlat * distance_squared) height[k] = 0;
    any_above = any_above || height[k] > 0;
    any_below = any_below || height[k] < 0;
    if (distance_squared > farthest) farthest = distance_squared;
  }
  if (!any_above) return 0;
  const Vec3 front = double_area(r, corners);
  const double side = -dot(front, r[0]);
  if (!(side > 0) || side * side <= kFlat * kFlat * farthest * length_squared(front)) return 0;

  Vec3 clipped[kMostCorners];
  const Vec3* shape = r;
  if (any_below) {
    corners = clip(r, height, corners, clipped);
    shape = clipped;
  }
  double sum = 0;
  for (std::uint32_t k = 0; k < corners; ++k) sum += edge_term(shape[k], shape[k + 1 < corners ? k + 1 : 0], normal);
  const double factor = sum / kTwoPi;
  return factor < 0 ? 0 : factor > 1 ? 1 : factor;
}

}  // namespace shodo
