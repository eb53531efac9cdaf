// The slow twin of the exact test, in 128-bit integers and another way: the point where the segment's line meets the
// triangle's plane, as an exact fraction, is compared with the triangle's edges in the plane's largest projection.
#pragma once

#include <cstdint>

#include "visibility/geometry.h"

namespace shodo::twin {

__extension__ typedef __int128 Wide;

struct WideVector {
  Wide c[3];
};

inline WideVector of(const LatticePoint& p) { return {{p.x, p.y, p.z}}; }
inline WideVector of(const LatticeVector& v) { return {{v.x, v.y, v.z}}; }
inline WideVector minus(const WideVector& a, const WideVector& b) {
  return {{a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]}};
}
inline WideVector cross(const WideVector& a, const WideVector& b) {
  return {{a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2], a.c[0] * b.c[1] - a.c[1] * b.c[0]}};
}
inline Wide dot(const WideVector& a, const WideVector& b) {
  return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
}
inline Wide absolute(Wide x) { return x < 0 ? -x : x; }

/// Along p + (numerator / denominator) d; denominator above 0.
struct Meeting {
  bool blocks = false;
  Wide numerator = 0, denominator = 1;
  bool front = false;
};

/// `open_end`: a segment that ends at p + d, else a ray.
inline Meeting meet(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const WideVector& p,
                    const WideVector& d, bool open_end) {
  Meeting none;
  const WideVector A = of(a), B = of(b), C = of(c);
  const WideVector n = cross(minus(C, A), minus(B, A));  // the other way round than the library's
  Wide t = dot(n, minus(A, p)), w = dot(n, d);           // the plane is met at p + (t / w) d
  if (w == 0) return none;
  const bool front = w > 0;
  if (w < 0) {
    t = -t;
    w = -w;
  }
  if (t <= 0 || (open_end && t >= w)) return none;
  int drop = 0;
  for (int k = 1; k < 3; ++k) {
    if (absolute(n.c[k]) > absolute(n.c[drop])) drop = k;
  }
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  // The point times w, less the corner times w.
  const WideVector* corner[3] = {&A, &B, &C};
  bool positive = false, negative = false;
  for (int k = 0; k < 3; ++k) {
    const WideVector &from = *corner[k], &to = *corner[(k + 1) % 3];
    const Wide xu = (p.c[u] - from.c[u]) * w + d.c[u] * t, xv = (p.c[v] - from.c[v]) * w + d.c[v] * t;
    const Wide area = (to.c[u] - from.c[u]) * xv - (to.c[v] - from.c[v]) * xu;
    positive = positive || area > 0;
    negative = negative || area < 0;
  }
  if (positive && negative) return none;
  return {true, t, w, front};
}

inline bool blocks_segment(const Triangle& t, const LatticePoint& p, const LatticePoint& q) {
  return meet(t.a, t.b, t.c, of(p), minus(of(q), of(p)), true).blocks;
}
inline bool blocks_ray(const Triangle& t, const LatticePoint& p, const LatticeVector& d) {
  return meet(t.a, t.b, t.c, of(p), of(d), false).blocks;
}

}  // namespace shodo::twin
