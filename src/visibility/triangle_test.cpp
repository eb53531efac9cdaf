// The exact test (design: exact visibility). With s(X) = N.X - D, d = Q - P and determinants of the line against the
// triangle's edges, t_ab = det(d, A-P, B-P) and so on, the segment passes the triangle if s(P) and s(Q) have strictly
// opposite signs and t_ab, t_bc, t_ca are each zero or have the sign of s(Q) - s(P) = t_ab + t_bc + t_ca.
//
// Exact: all of it. |s| <= 2^61 and |t| <= 2^61.6; partial sums stay below 2^62.6, so that nothing overflows.
#include "visibility/triangle_test.h"

namespace shodo {

namespace {

/// Whether the line from p along d passes the closed triangle; `through` is s(Q) - s(P) = N.d, not zero.
bool line_meets(const Triangle& triangle, const LatticePoint& p, const LatticeVector& d, std::int64_t through) {
  const LatticeVector m = cross(d, triangle.b - p);
  const std::int64_t ab = -dot(m, triangle.a - p);
  if (through > 0 ? ab < 0 : ab > 0) return false;
  const std::int64_t bc = dot(m, triangle.c - p);
  if (through > 0 ? bc < 0 : bc > 0) return false;
  const std::int64_t ca = through - ab - bc;
  return through > 0 ? ca >= 0 : ca <= 0;
}

}  // namespace

bool blocks_segment(const Triangle& triangle, const LatticePoint& p, const LatticePoint& q) {
  const std::int64_t sp = triangle.side(p);
  const std::int64_t sq = triangle.side(q);
  // Strictly opposite: a triangle without normal (s = 0 everywhere) and a segment in its plane never pass this.
  if (sp >= 0 ? (sp == 0 || sq >= 0) : sq <= 0) return false;
  return line_meets(triangle, p, q - p, sq - sp);
}

bool blocks_ray(const Triangle& triangle, const LatticePoint& p, const LatticeVector& direction) {
  const std::int64_t sp = triangle.side(p);
  const std::int64_t through = dot(triangle.n, direction);
  if (sp >= 0 ? (sp == 0 || through >= 0) : through <= 0) return false;
  return line_meets(triangle, p, direction, through);
}

}  // namespace shodo
