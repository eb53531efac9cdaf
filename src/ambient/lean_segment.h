// Segments and boxes in steps of 32 of the lattice: what a segment passes by is found with four small products.
//
// Along the axis of its largest extent, t steps from its middle, the segment is slope_u t and slope_v t from there,
// slopes within 1 and in 1/2^15. A box of half sides h reaches h_u + |slope_u| h to both sides of the place where
// the segment passes its middle. Rounding makes up to six steps: one from the slope over half the segment, one from
// each number; so much is allowed for: nothing is missed.
#pragma once

#include <cstdint>

#include "visibility/lattice_box.h"

namespace shodo {

/// A box of the lattice, rounded outwards. 12 bytes.
struct LeanBox {
  std::int16_t middle[3] = {0, 0, 0}, half[3] = {0, 0, 0};
};

LeanBox lean_box(const LatticeBox& box);

class LeanSegment {
 public:
  LeanSegment(const LatticePoint& p, const LatticePoint& q);
  /// False if it surely doesn't meet the box.
  bool may_meet(const LeanBox& box) const {
    const std::int32_t ahead = box.middle[along_] - middle_[along_], half = box.half[along_];
    return within(ahead, half + length_) && !beside(box, u_, slope_u_, steep_u_, ahead, half) &&
           !beside(box, v_, slope_v_, steep_v_, ahead, half);
  }

 private:
  static constexpr int kPlaces = 15;
  static constexpr std::int32_t kRounding = 6;

  /// |x| <= most; `most` is not negative.
  static bool within(std::int32_t x, std::int32_t most) {
    return static_cast<std::uint32_t>(x + most) <= 2 * static_cast<std::uint32_t>(most);
  }
  bool beside(const LeanBox& box, std::uint32_t axis, std::int32_t slope, std::int32_t steep, std::int32_t ahead,
              std::int32_t half) const {
    const std::int32_t off = box.middle[axis] - middle_[axis] - (slope * ahead >> kPlaces);
    return !within(off, box.half[axis] + (steep * half >> kPlaces) + kRounding);
  }

  std::int32_t middle_[3];
  std::uint32_t along_ = 0, u_ = 1, v_ = 2;
  std::int32_t length_ = 0;                    // half of it, along
  std::int32_t slope_u_ = 0, slope_v_ = 0, steep_u_ = 0, steep_v_ = 0;  // steep: without signs
};

}  // namespace shodo
