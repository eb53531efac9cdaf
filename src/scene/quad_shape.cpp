#include "scene/quad_shape.h"

#include <cstdint>

namespace shodo {

namespace {

constexpr double kStraight = 0x1p-40;

}  // namespace

QuadShape quad_shape(const Vec3 corner[4]) {
  Vec3 turn[4];
  double longest_squared = 0, largest_squared = 0;
  std::uint32_t largest = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const Vec3 before = corner[k] - corner[(k + 3) % 4], after = corner[(k + 1) % 4] - corner[k];
    turn[k] = cross(before, after);
    if (length_squared(after) > longest_squared) longest_squared = length_squared(after);
    if (length_squared(turn[k]) > largest_squared) {
      largest_squared = length_squared(turn[k]);
      largest = k;
    }
  }
  const double straight = kStraight * longest_squared;
  if (!(square_root(largest_squared) > straight)) return QuadShape::kNoArea;
  const Vec3 reference = normalised(turn[largest]);
  std::uint32_t left = 0, right = 0, last_left = 0, last_right = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const double size = dot(turn[k], reference);
    if (size > straight) ++left, last_left = k;
    if (size < -straight) ++right, last_right = k;
  }
  if (right == 0) return QuadShape::kConvex;
  if (left == 1 && right == 1) return QuadShape::kNoArea;  // there and back again
  if (left >= 2 && right >= 2) return QuadShape::kCrossing;
  const std::uint32_t reflex = right == 1 ? last_right : last_left;
  return reflex % 2 == 0 ? QuadShape::kCut02 : QuadShape::kCut13;
}

bool triangle_has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  double longest_squared = length_squared(b - a);
  if (length_squared(c - b) > longest_squared) longest_squared = length_squared(c - b);
  if (length_squared(a - c) > longest_squared) longest_squared = length_squared(a - c);
  return length(cross(b - a, c - a)) > kStraight * longest_squared;
}

}  // namespace shodo
