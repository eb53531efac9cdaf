// The space through which parallel rays from a box pass (visibility/parallel_rays.h): a shaft both of whose ends are
// one box.
//
// Seen along an axis it is a strip: of the linear form that is square to the direction all rays have values between the
// least and the largest that the box has. So a box is missed if it is outside the common box of the sweep's ends or
// beyond one of the strips' six borders. Lattice points and directions are taken in steps of 64, rounded outwards, so
// that products fit 32 bits (visibility/shaft_line.h).
// Exact: no box that a ray meets is missed. Approximate: others are taken, too. Stack: 190 bytes.
#pragma once

#include <cstdint>

#include "visibility/lattice_box.h"
#include "visibility/shaft_line.h"

namespace shodo {

class Sweep {
 public:
  /// `direction`: of lattice_direction(); `part` of it, in 2^-kPartBits, counts.
  Sweep(const LatticeBox& from, const LatticePoint& direction, std::int32_t part);
  static constexpr int kPartBits = 10;

  const LatticeBox& from() const { return from_; }
  const LatticeBox& to() const { return to_; }
  /// The border that rejects is tried first from then on.
  bool misses(const LatticeBox& box) {
    if (apart(around_, box)) return true;
    for (std::uint32_t k = 0; k < kLines; ++k) {
      if (!lines_[k].rules_out(box)) continue;
      if (k > 0) swap_first(k);
      return true;
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kLines = 6;

  void add(const LatticeBox& from, std::uint32_t line, std::uint32_t u, std::uint32_t v, std::int32_t normal_u,
           std::int32_t normal_v);
  void swap_first(std::uint32_t k) {
    const ShaftLine line = lines_[k];
    lines_[k] = lines_[0];
    lines_[0] = line;
  }

  LatticeBox from_, to_, around_;
  ShaftLine lines_[kLines];
};

}  // namespace shodo
