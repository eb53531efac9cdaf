// Which facets' boxes meet a box, 32 at a time (ours; paper 3.1).
//
// Along each axis the scene is cut into up to kSlices equal slices. For each slice one bit a facet tells whether the
// facet begins there or before, and one whether it ends there or after. A box meets those facets that begin no later
// than it ends and end no earlier than it begins, along all three axes: six words of 32 facets, combined by "and",
// leave those that can. The hull of two boxes is cut into up to four pieces, each in a box of its own: the common box
// of two corners of a room is all of the room, four boxes between them are a tenth of it. So no tree, and no lists
// that are handed on from pair to pair: a question costs about 20 instructions for 32 facets and a piece.
// Exact: no facet whose box meets the hull is left out. Approximate: others are called too.
// Bytes: 24 a facet, in steps of 64 facets.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "visibility/blockers.h"
#include "visibility/lattice_box.h"

namespace shodo {

class FacetMasks {
 public:
  static constexpr std::uint32_t kSlices = 32;

  /// False: the arena is too small.
  bool take(Arena& arena, std::uint32_t facets);
  static std::uint64_t bytes(std::uint32_t facets);
  bool taken() const { return !masks_.empty(); }

  /// Starts anew; facets lie in the box.
  void start(std::uint32_t facets, const LatticeBox& around);
  void add(std::uint32_t facet, const LatticeBox& box);

  /// Calls visit(facet number), ascending, for all that were added and may meet the hull of two boxes; stops at true.
  template <class Visit>
  bool visit(const LatticeBox& a, const LatticeBox& b, Visit visit) const {
    Rows rows[kMostPieces];
    const std::uint32_t pieces = cut(a, b, rows);
    std::uint32_t near[kChunk];
    for (std::uint32_t first = 0; first < words_; first += kChunk) {
      const std::uint32_t words = words_ - first < kChunk ? words_ - first : kChunk;
      gather({rows, pieces}, first, {near, words});
      for (std::uint32_t word = 0; word < words; ++word) {
        for (std::uint32_t left = near[word]; left != 0;) {
          const std::uint32_t lowest = left & (0u - left);
          const std::uint32_t facet = 32 * (first + word) + kBitNumber[lowest * kDeBruijn >> 27];
          left ^= lowest;
          if (visit(facet)) return true;
        }
      }
    }
    return false;
  }

 private:
  /// Of a word with a single bit, times this, the first five bits are all different (Leiserson, Prokop, Randall 1998).
  static constexpr std::uint32_t kDeBruijn = 0x077CB531;
  static const std::uint8_t kBitNumber[32];
  static constexpr std::uint32_t kMostPieces = 4, kChunk = 32;

  /// Masks of one box.
  struct Rows {
    const std::uint32_t* row[6];
  };
  std::uint32_t cut(const LatticeBox& a, const LatticeBox& b, Rows* rows) const;
  void gather(std::span<const Rows> pieces, std::uint32_t first, std::span<std::uint32_t> near) const;

  static std::uint32_t slice_at(std::int32_t slices) {
    if (slices < 0) return 0;
    return static_cast<std::uint32_t>(slices) < kSlices ? static_cast<std::uint32_t>(slices) : kSlices - 1;
  }
  std::uint32_t slice(std::uint32_t axis, std::int32_t at) const {
    return slice_at((at - base_[axis]) >> shift_[axis]);
  }
  std::size_t row(std::uint32_t bound, std::uint32_t slice) const {
    return std::size_t{words_} * (kSlices * bound + slice);
  }

  std::span<std::uint32_t> masks_;  // [axis: begun; 3 + axis: not ended][slice][word]
  std::uint32_t words_ = 0;  // even
  std::int32_t base_[3] = {0, 0, 0};
  int shift_[3] = {0, 0, 0};
};

}  // namespace shodo
