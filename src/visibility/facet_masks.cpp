#include "visibility/facet_masks.h"

namespace shodo {

const std::uint8_t FacetMasks::kBitNumber[32] = {0,  1,  28, 2,  29, 14, 24, 3, 30, 22, 20, 15, 25, 17, 4,  8,
                                                 31, 27, 13, 23, 21, 19, 16, 7, 26, 12, 18, 6,  11, 5,  10, 9};

namespace {

std::size_t words_of(std::uint32_t facets) { return (std::size_t{facets} + 63) / 64 * 2; }

/// How many pieces, log2, the way from slice to slice is worth: along one axis alone there is nothing to gain.
int pieces_for(const std::int32_t* moved) {
  std::int32_t most = 0, second = 0;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t way = moved[k] < 0 ? -moved[k] : moved[k];
    if (way > most) {
      second = most;
      most = way;
    } else if (way > second) {
      second = way;
    }
  }
  return second < 3 ? 0 : second < 9 ? 1 : 2;
}

}  // namespace

std::uint64_t FacetMasks::bytes(std::uint32_t facets) {
  return sizeof(std::uint32_t) * 6 * kSlices * std::uint64_t{words_of(facets)};
}

bool FacetMasks::take(Arena& arena, std::uint32_t facets) {
  words_ = 0;
  return arena.take("masks of blockers", 6 * kSlices * words_of(facets), masks_);
}

void FacetMasks::start(std::uint32_t facets, const LatticeBox& around) {
  words_ = static_cast<std::uint32_t>(words_of(facets));
  for (std::uint32_t& mask : masks_) mask = 0;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    base_[axis] = around.low[axis];
    shift_[axis] = 0;
    const std::int64_t length = std::int64_t{around.high[axis]} - around.low[axis];
    while (length >> shift_[axis] >= kSlices) ++shift_[axis];
  }
}

void FacetMasks::add(std::uint32_t facet, const LatticeBox& box) {
  const std::uint32_t word = facet / 32, bit = std::uint32_t{1} << facet % 32;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    for (std::uint32_t s = slice(axis, box.low[axis]); s < kSlices; ++s) masks_[row(axis, s) + word] |= bit;
    for (std::uint32_t s = slice(axis, box.high[axis]) + 1; s-- > 0;) masks_[row(3 + axis, s) + word] |= bit;
  }
}

/// The hull of two boxes lies in the boxes around its pieces, cut where a box that moves and grows from the one to the
/// other is at k / pieces of the way. In lattice steps times pieces.
std::uint32_t FacetMasks::cut(const LatticeBox& a, const LatticeBox& b, Rows* rows) const {
  std::int32_t moved[3];
  for (int k = 0; k < 3; ++k) moved[k] = (b.low[k] - a.low[k]) >> shift_[k];
  const int log2_pieces = pieces_for(moved);
  const std::uint32_t pieces = std::uint32_t{1} << log2_pieces;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const int shift = shift_[axis] + log2_pieces;
    const std::int32_t rise_low = b.low[axis] - a.low[axis], rise_high = b.high[axis] - a.high[axis];
    std::int32_t low = (a.low[axis] - base_[axis]) * (1 << log2_pieces);
    std::int32_t high = (a.high[axis] - base_[axis]) * (1 << log2_pieces);
    const std::uint32_t* const begun = &masks_[row(axis, 0)];
    const std::uint32_t* const unended = &masks_[row(3 + axis, 0)];
    for (std::uint32_t k = 0; k < pieces; ++k) {
      const std::int32_t next_low = low + rise_low, next_high = high + rise_high;
      rows[k].row[axis] = begun + words_ * slice_at((rise_high > 0 ? next_high : high) >> shift);
      rows[k].row[3 + axis] = unended + words_ * slice_at((rise_low < 0 ? next_low : low) >> shift);
      low = next_low;
      high = next_high;
    }
  }
  return pieces;
}

void FacetMasks::gather(std::span<const Rows> pieces, std::uint32_t first, std::span<std::uint32_t> near) const {
  const auto combine = [&](const Rows& piece, auto put) {
    const std::uint32_t *a = piece.row[0] + first, *b = piece.row[1] + first, *c = piece.row[2] + first;
    const std::uint32_t *d = piece.row[3] + first, *e = piece.row[4] + first, *f = piece.row[5] + first;
    for (std::size_t k = 0; k < near.size(); k += 2) {
      put(near[k], a[k] & b[k] & c[k] & d[k] & e[k] & f[k]);
      put(near[k + 1], a[k + 1] & b[k + 1] & c[k + 1] & d[k + 1] & e[k + 1] & f[k + 1]);
    }
  };
  combine(pieces[0], [](std::uint32_t& to, std::uint32_t word) { to = word; });
  for (const Rows& piece : pieces.subspan(1)) {
    combine(piece, [](std::uint32_t& to, std::uint32_t word) { to |= word; });
  }
}

}  // namespace shodo
