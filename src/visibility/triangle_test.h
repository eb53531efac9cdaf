// Whether a triangle blocks a segment or a ray, decided in 64-bit integers (design: exact visibility; deviation D8).
#pragma once

#include "visibility/geometry.h"

namespace shodo {

/// Closed triangle, open segment; exact for points of the lattice.
bool blocks_segment(const Triangle& triangle, const LatticePoint& p, const LatticePoint& q);

/// Closed triangle, open ray from p along `direction` (components within +-2^20); exact.
bool blocks_ray(const Triangle& triangle, const LatticePoint& p, const LatticeVector& direction);

/// Part of both: whether the line from p along d passes the closed triangle; `through` is N.d, not zero.
bool line_meets(const Triangle& triangle, const LatticePoint& p, const LatticeVector& d, std::int64_t through);

}  // namespace shodo
