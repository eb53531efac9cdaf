// The exchange between two rectangles whose sides run along the axes, in closed form (paper 2.2; Howell's catalogue
// C-13 and C-15; Ehlert and Smith 1993).
//
// Most near pairs in rooms are of this kind: 16 logarithms and 16 or 32 arctangents instead of contour integrals from
// 25 points or more. Parallel ones with the distance z, and u, v running over the four differences of their bounds:
//     2 pi G = sum of +-P,   P = v a atan(v / a) + u b atan(u / b), a^2 = u^2 + z^2, b^2 = v^2 + z^2,
//                                - z^2 / 2 ln(u^2 + v^2 + z^2)
// Square to each other, x and z their bounds over the other's plane (what is behind it is cut off), v the differences
// of their bounds along the common direction, c^2 = x^2 + z^2:
//     2 pi G = sum of +-P,   P = v c atan(v / c) - (c^2 - v^2) / 4 ln(c^2 + v^2)
// Exact but for rounding: the sums cancel, so that at the distance of 50 sides 8 digits are left; farther pairs are
// refused.
#pragma once

#include "ambient/patch_shape.h"

namespace shodo {

/// A rectangle along the axes: bounds, and the axis of its normal with its sign.
struct AxisRectangle {
  double low[3], high[3];
  int axis = -1;  // none: the patch isn't one
  bool up = true;
};

/// `flat`: what is rounding.
AxisRectangle axis_rectangle(const Vec3& centre, const Vec3& normal, const PatchShape& shape, double flat);

/// G of both, or below 0 if the closed form doesn't serve.
double box_exchange(const AxisRectangle& i, const AxisRectangle& j);

}  // namespace shodo
