// The space through which all segments between two boxes pass: what lies outside cannot block any of them (paper 3.1;
// Haines and Wallace 1991, shaft culling).
//
// Seen along an axis the boxes A and B are rectangles, and the hull of two rectangles has, besides sides of theirs,
// edges from a corner of A to the same corner of B only: two mostly, four if they cross. So a box misses the hull
// if it is outside the common box of A and B or beyond one of these lines. Lines are found in steps of 64 of the
// lattice, rounded outwards, so that products fit 32 bits. Exact: no box that meets the hull is missed.
// Approximate: hull and box may be apart where no axis shows it; that costs tests only. For a sun B is A moved
// along the direction, which reaches out of the lattice's cube. Stack: 330 bytes.
#pragma once

#include <cstdint>

#include "visibility/lattice_box.h"
#include "visibility/shaft_line.h"

namespace shodo {

class Shaft {
 public:
  Shaft(const LatticeBox& a, const LatticeBox& b) : a_(a), b_(b), around_(a) { around_.include(b); }
  /// `direction`: of lattice_direction(), its largest component is the size of the cube.
  static Shaft along(const LatticeBox& a, const LatticeVector& direction);

  const LatticeBox& from() const { return a_; }
  const LatticeBox& to() const { return b_; }
  /// True if no segment from A to B meets the box, which may be flat in the way of facet_box().
  bool misses(const LatticeBox& box) { return apart(around_, box) || beyond_a_line(box); }

 private:
  /// The line that rejects is tried first from then on: neighbours of the box mostly fall to the same.
  bool beyond_a_line(const LatticeBox& box);
  void find_lines();
  void add_lines(std::uint32_t u, std::uint32_t v);

  LatticeBox a_, b_, around_;
  ShaftLine lines_[12];
  std::uint32_t lines_used_ = kNotYet;  // found when a box asks that the common box does not rule out
  static constexpr std::uint32_t kNotYet = 0xFFFFFFFF;
};

}  // namespace shodo
