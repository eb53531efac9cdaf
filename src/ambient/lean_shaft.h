// The hull of two boxes, in steps of 64 of the lattice: what the lists of ambient/sight.h are narrowed by.
//
// Seen along the three axes as in visibility/shaft.h, but so coarse that every product fits 32 bits. Boxes are rounded
// outwards: nothing that meets the hull is missed. A box is rejected if it lies outside the common box of both, or,
// grown by two steps, beyond a line of the hull seen along an axis. Of two convex outlines that are apart some side
// tells, so a box that a shaft rejects is rejected by the shaft of any parts of its ends too, and so is each part of
// the box: what is left of a list doesn't depend on the way by which it was narrowed.
// Stack: 300 bytes.
#pragma once

#include <cstdint>

#include "visibility/lattice_box.h"
#include "visibility/shaft_line.h"

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
    if (lines_[0].rules_out(box)) return true;
    for (std::uint32_t k = 1; k < lines_used_; ++k) {
      if (!lines_[k].rules_out(box)) continue;
      const ShaftLine line = lines_[k];
      lines_[k] = lines_[0];
      lines_[0] = line;
      return true;
    }
    return false;
  }

 private:
  void add_lines(const LatticeBox& a, const LatticeBox& b, std::uint32_t u, std::uint32_t v);

  LatticeBox around_;
  ShaftLine lines_[12];
  std::uint32_t lines_used_ = 0;
};

}  // namespace shodo
