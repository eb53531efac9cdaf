// The hull of two boxes, in steps of 64 of the lattice: what the lists of ambient/sight.h are narrowed by.
//
// Seen along the three axes as in visibility/shaft.h, but so coarse that every product fits 32 bits. Boxes are rounded
// outwards: nothing that meets the hull is missed. A box is rejected if it lies outside the common box of both, or,
// grown by two steps, beyond a line of the hull seen along an axis. Of two convex outlines that are apart some side
// tells, so a box that a shaft rejects is rejected by the shaft of any parts of its ends too, and so is each part of
// the box: what is left of a list doesn't depend on the way by which it was narrowed.
// Stack: 300 bytes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "visibility/lattice_box.h"

namespace shodo {

class LeanShaft {
 public:
  LeanShaft(const LatticeBox& a, const LatticeBox& b);
  /// The common box of both.
  const LatticeBox& around() const { return around_; }
  /// True if no segment between the boxes meets this one; it may be flat (visibility/blockers.h).
  bool misses(const LatticeBox& box) { return apart(around_, box) || cuts_off(box); }
  /// The same for one that isn't apart from the common box. The line that rejects is tried first from then on:
  /// neighbours of the box mostly fall to the same.
  bool cuts_off(const LatticeBox& box) {
    if (lines_used_ == 0) return false;
    if (beyond(lines_[0], box)) return true;
    for (std::uint32_t k = 1; k < lines_used_; ++k) {
      if (!beyond(lines_[k], box)) continue;
      const Line line = lines_[k];
      lines_[k] = lines_[0];
      lines_[0] = line;
      return true;
    }
    return false;
  }

 private:
  static constexpr int kSteps = 6;  // of the lattice in one, log2
  /// Beyond: normal_u u + normal_v v > limit, u and v of the box's nearest corner.
  struct Line {
    std::int32_t normal_u, normal_v, limit;
    std::uint32_t u, v;  // bounds of a box, by their offset in it
  };
  static_assert(offsetof(LatticeBox, low) == 0 && offsetof(LatticeBox, high) == 12 && sizeof(LatticeBox) == 24);

  static std::int32_t bound(const LatticeBox& box, std::uint32_t offset) {
    const auto* byte = reinterpret_cast<const unsigned char*>(&box) + offset;
    return *reinterpret_cast<const std::int32_t*>(byte) >> kSteps;
  }
  static bool beyond(const Line& line, const LatticeBox& box) {
    return line.normal_u * bound(box, line.u) + line.normal_v * bound(box, line.v) > line.limit;
  }
  void add_lines(const LatticeBox& a, const LatticeBox& b, std::uint32_t u, std::uint32_t v);

  LatticeBox around_;
  Line lines_[12];
  std::uint32_t lines_used_ = 0;
};

}  // namespace shodo
