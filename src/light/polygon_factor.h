// Lambert's contour integral: how much of a point's cosine-weighted hemisphere a polygon fills.
#pragma once

#include <cstdint>

#include "base/vector.h"

namespace shodo {

/// The form factor from a surface element at `point` with unit `normal` to the front of a polygon of 3 or 4 corners
/// (planar; counter-clockwise seen from its front), clipped at the element's horizon; 0 .. 1, shadows not considered.
/// F = 1/2pi sum of angle_k (unit(r_k x r_k+1) . normal)  (Lambert 1760). Finite at any distance, also on the polygon.
double point_to_polygon(const Vec3& point, const Vec3& normal, const Vec3* corner, std::uint32_t corners);

}  // namespace shodo
