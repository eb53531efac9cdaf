// Phong's lobe, and how much of it a convex polygon of light fills (paper 2.4; doc/optics.md).
//
// With the mirrored direction of view r, the surface's normal N, exponent n and coefficient k, both of length 1
// (Phong 1975, normalised by Lewis 1994), light of luminance L0 from a set of directions shows as
//
//     L = k (n + 2) / (2 pi) L0 M,    M = integral of (l.r)^n (l.N) dw
//
// Over a convex polygon M is a sum over its edges (Stokes; Arvo 1995, "Applications of irradiance tensors", double-axis
// moments). For the edge from a to b on the plane with unit normal m = a x b / |a x b|, inside where m.l > 0, d = m.r:
//
//     (n + 2) M = (N.r) [2 pi if r is inside] + sum of (1 - d^2)^(n/2) ((N.m) I - (N.r) J)
//     I = integral of (1 + T^2)^(-n/2 - 1) dT,    J = integral of (1 + T^2)^(-n/2) d / (d^2 + T^2) dT
//
// T the tangent of the angle along the edge from the point nearest to r: rational, without sine or arctangent. Where
// r lies near the edge J is steep: 1 is then taken off the power, and the angle that this leaves out added.
// Approximate: I and J by 4 Gauss points on pieces whose ends lie at 0, 1.5, 3, 6 ... lobe's widths 1 / sqrt(n); errors
// of (n + 2) M were below 0.003, of 2 pi (0.0005), for n from 2 to 500. A lobe ends at `reach`.
#pragma once

#include <cstdint>

#include "base/vector.h"
#include "picture/direction_polygon.h"

namespace shodo {

struct Lobe {
  double strength = 0;  // k (n + 2) / (2 pi)
  double reach = 0;     // cosine of the angle at which it ends
  double ends = 0;      // the same for lamps, by their luminance: what lies beyond shows as less than a quarter step
  double width = 0;     // 1 / sqrt(n)
  double exponent = 0;

  /// (l.r)^n of a direction, given (l.r)^2.
  double raised(double squared) const;
  /// strength (l.r)^n; 0 where the lobe has ended.
  double at(double squared) const { return squared > reach * reach ? strength * raised(squared < 1 ? squared : 1) : 0; }
};

/// k (n + 2) / (2 pi) M of a polygon in front of the surface. `mirrored` and `normal` are of length 1.
double lobe_over(const Lobe& lobe, const Vec3& mirrored, const Vec3& normal, const DirectionPolygon& polygon);

}  // namespace shodo
