// The exact test (design: exact visibility). With s(X) = N.X - D, d = Q - P and determinants of the line against the
// triangle's edges, t_ab = det(d, A-P, B-P) and so on, the segment passes the triangle if s(P) and s(Q) have strictly
// opposite signs and t_ab, t_bc, t_ca are each zero or have the sign of s(Q) - s(P) = t_ab + t_bc + t_ca.
//
// Exact: all of it. |s| <= 2^61 and |t| <= 2^61.6; partial sums stay below 2^62.6, so that nothing overflows.
#include "visibility/triangle_test.h"

#include "visibility/rounded_normal.h"

namespace shodo {

namespace {

/// m . (q - p), without making 64 bits of the difference before they are needed.
std::int64_t along(const LatticeVector& m, const LatticePoint& q, const LatticePoint& p) {
  return m.x * (q.x - p.x) + m.y * (q.y - p.y) + m.z * (q.z - p.z);
}

}  // namespace

/// `through` is s(Q) - s(P).
bool line_meets(const Triangle& triangle, const LatticePoint& p, const LatticeVector& d, std::int64_t through) {
  const std::int32_t dx = static_cast<std::int32_t>(d.x), dy = static_cast<std::int32_t>(d.y),
                     dz = static_cast<std::int32_t>(d.z);
  const LatticePoint& b = triangle.b;
  const std::int32_t bx = b.x - p.x, by = b.y - p.y, bz = b.z - p.z;
  const LatticeVector m{product(dy, bz) - product(dz, by), product(dz, bx) - product(dx, bz),
                        product(dx, by) - product(dy, bx)};
  // All with the sign that makes `through` positive; the doubts of the first two add up in the third.
  const RoundedNormal rough(m);
  const LatticePoint &a = triangle.a, &c = triangle.c;
  const std::int64_t to_a = rough.along({a.x - p.x, a.y - p.y, a.z - p.z});
  const std::int64_t rough_ab = through > 0 ? -to_a : to_a;
  if (rough_ab < -RoundedNormal::kDoubt) return false;
  const std::int64_t to_c = rough.along({c.x - p.x, c.y - p.y, c.z - p.z});
  const std::int64_t rough_bc = through > 0 ? to_c : -to_c;
  if (rough_bc < -RoundedNormal::kDoubt) return false;
  const std::int64_t rough_ca = ((through > 0 ? through : -through) >> RoundedNormal::kBits) - rough_ab - rough_bc;
  constexpr std::int64_t kBoth = 2 * RoundedNormal::kDoubt + 1;
  if (rough_ca < -kBoth) return false;
  if (rough_ab > RoundedNormal::kDoubt && rough_bc > RoundedNormal::kDoubt && rough_ca > kBoth) return true;
  const std::int64_t ab = -along(m, triangle.a, p);
  if (through > 0 ? ab < 0 : ab > 0) return false;
  const std::int64_t bc = along(m, triangle.c, p);
  if (through > 0 ? bc < 0 : bc > 0) return false;
  const std::int64_t ca = through - ab - bc;
  return through > 0 ? ca >= 0 : ca <= 0;
}

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
