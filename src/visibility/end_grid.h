// Which ends on a flat light a box can hide, seen from a box of points (paper 3.1).
//
// From P the shadow of X on the light's plane lies at X + (X - P) t_X / (t_P - t_X), t the distances from the plane: it
// grows with X and falls with P along each axis of the plane, and is monotonous in the ratio, so that boxes of X and P
// give a rectangle that holds all shadows. The ends are sorted into 16 columns and 16 rows once; those whose column and
// row the rectangle meets are found with two divisions and four table look-ups. Only they have to be tested.
// For lights square to an axis. Exact in that no end is missed: coordinates are in steps of 64 of the lattice, rounded
// outwards, and ratios in 1/1,024, so that all products fit 32 bits. Bytes: 176 a light.
#pragma once

#include <cstdint>
#include <span>

#include "base/lattice.h"
#include "visibility/lattice_box.h"

namespace shodo {

class EndGrid {
 public:
  /// `box`: around the ends, of which there are 32 at most. Not usable() if it is flat along no axis.
  EndGrid() = default;
  EndGrid(std::span<const LatticePoint> ends, const LatticeBox& box);

  bool usable() const { return axis_ < 3; }
  /// The ends (a bit each) that `box`, which may be flat in the way of facet_box(), can hide from points of `from`.
  std::uint32_t shadow(const LatticeBox& box, const LatticeBox& from) const;

 private:
  static constexpr std::int32_t kBins = 16;

  struct Side {
    std::uint32_t before[kBins + 1] = {};  // the ends in bins below
    std::int32_t low = 0, size = 0, scale = 0;
    std::uint32_t axis = 0;

    std::uint32_t bin(std::int32_t at) const {
      const std::int32_t in = at < low ? 0 : at - low > size ? size : at - low;
      return static_cast<std::uint32_t>(in * scale) >> 16;
    }
  };
  void fill(Side& side, std::uint32_t axis, std::span<const LatticePoint> ends, const LatticeBox& box);

  Side side_[2];
  std::int32_t plane_ = 0;
  std::uint32_t axis_ = 3;
};

}  // namespace shodo
