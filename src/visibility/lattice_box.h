// A box of lattice points, sides along the axes. 24 bytes.
#pragma once

#include <cstdint>

#include "base/lattice.h"

namespace shodo {

/// Closed; empty if low > high.
struct LatticeBox {
  std::int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX};
  std::int32_t high[3] = {INT32_MIN, INT32_MIN, INT32_MIN};

  void include(const LatticePoint& p) { include({{p.x, p.y, p.z}, {p.x, p.y, p.z}}); }
  void include(const LatticeBox& box) {
    for (int k = 0; k < 3; ++k) {
      if (box.low[k] < low[k]) low[k] = box.low[k];
      if (box.high[k] > high[k]) high[k] = box.high[k];
    }
  }
  bool contains(const LatticePoint& p, std::int32_t margin) const;
  /// Whether the segment meets the box grown by `margin`; may err by a billionth of the segment, towards true.
  bool met_by(const LatticePoint& from, const LatticePoint& to, std::int32_t margin) const;
};

/// Whether no point belongs to both; either may be flat in the way of facet_box() (visibility/blockers.h).
constexpr bool apart(const LatticeBox& a, const LatticeBox& b) {
  return a.low[0] > b.high[0] || a.high[0] < b.low[0] || a.low[1] > b.high[1] || a.high[1] < b.low[1] ||
         a.low[2] > b.high[2] || a.high[2] < b.low[2];
}

}  // namespace shodo
