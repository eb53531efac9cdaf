// What four corners make: convex, concave (then with which valid diagonal), crossing itself, or nothing with area.
//
// At each corner k stands n_k = (c_k - c_k-1) x (c_k+1 - c_k), twice the area of the triangle that it cuts off. The
// corners of a convex quadrilateral turn one way; in a concave one a single corner turns the other way; in one that
// crosses itself two do. Always n_0 + n_2 = n_1 + n_3 = twice the vector area, so the largest n_k gives the direction
// to compare with. A quadrilateral need not be plane; one that folds by more than a right angle counts as crossing
// itself.
//
// Approximate: corners within 2^-40 of the longest side of a straight line count as on it, since coordinates are
// rounded.
#pragma once

#include "base/vector.h"

namespace shodo {

enum class QuadShape : unsigned char {
  kConvex,
  kCut02,     // concave at corner 0 or 2: valid is the diagonal from 0 to 2
  kCut13,     // concave at corner 1 or 3
  kCrossing,
  kNoArea,
};

QuadShape quad_shape(const Vec3 corner[4]);

/// False if a triangle's height is below 2^-40 of its longest side.
bool triangle_has_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace shodo
