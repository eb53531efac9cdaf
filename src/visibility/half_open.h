// Which side of a triangle's edge a line passes, so that a surface cut into triangles is passed once, never twice.
//
// d.(A x B) decides, with A and B from the line's start; where it is zero the direction counts as turned by a hair
// towards +x, by a hair of that towards +y, and by a hair of that towards +z, so that the first component of A x B
// that isn't zero does. All triangles see the same direction: each point of a seam belongs to exactly one of them.
// Exact; what blocks is closed instead (visibility/triangle_test.h), since light must not leak.
#pragma once

#include <cstdint>

#include "base/lattice.h"
#include "visibility/geometry.h"

namespace shodo {

struct EdgeSide {
  std::int64_t value;  // d.(A x B)
  int sign;            // -1 or 1; 0 if the start and the edge are in line
};

inline EdgeSide edge_side(const LatticeVector& d, const LatticeVector& a, const LatticeVector& b) {
  const LatticeVector n = cross(a, b);
  const std::int64_t value = dot(d, n);
  const std::int64_t decides = value != 0 ? value : n.x != 0 ? n.x : n.y != 0 ? n.y : n.z;
  return {value, decides > 0 ? 1 : decides < 0 ? -1 : 0};
}

/// Whether the ray from p along d, components within 2^20, passes the triangle: open at p, half-open at its edges.
inline bool passes(const Triangle& triangle, const LatticePoint& p, const LatticeVector& d) {
  const std::int64_t side = triangle.side(p), through = dot(triangle.n, d);
  if (side >= 0 ? (side == 0 || through >= 0) : through <= 0) return false;
  const LatticeVector a = triangle.a - p, b = triangle.b - p, c = triangle.c - p;
  const int sign = edge_side(d, a, b).sign;
  return sign != 0 && sign == edge_side(d, b, c).sign && sign == edge_side(d, c, a).sign;
}

}  // namespace shodo
