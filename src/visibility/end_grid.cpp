#include "visibility/end_grid.h"

namespace shodo {

namespace {

constexpr int kSteps = 6;   // of the lattice in one of ours, log2
constexpr int kRatio = 10;  // bits of a ratio after the point
constexpr std::int32_t kLargestRatio = 1 << (kRatio + 6);
constexpr std::int32_t kFar = 1 << 20;  // beyond every light

std::int32_t floor_of(std::int32_t x) { return x >> kSteps; }
std::int32_t ceiling_of(std::int32_t x) { return (x + (1 << kSteps) - 1) >> kSteps; }
std::int32_t coordinate(const LatticePoint& p, std::uint32_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

}  // namespace

void EndGrid::fill(Side& side, std::uint32_t axis, std::span<const LatticePoint> ends, const LatticeBox& box) {
  side.axis = axis;
  side.low = floor_of(box.low[axis]);
  side.size = floor_of(box.high[axis]) - side.low;
  side.scale = (kBins << 16) / (side.size + 1);
  for (std::uint32_t k = 0; k < ends.size(); ++k) {
    const std::uint32_t bin = side.bin(floor_of(coordinate(ends[k], axis)));
    for (std::uint32_t b = bin + 1; b <= kBins; ++b) side.before[b] |= std::uint32_t{1} << k;
  }
}

EndGrid::EndGrid(std::span<const LatticePoint> ends, const LatticeBox& box) {
  for (std::uint32_t axis = 0; axis < 3 && axis_ == 3; ++axis) {
    if (box.low[axis] == box.high[axis]) axis_ = axis;
  }
  if (axis_ == 3) return;
  plane_ = box.low[axis_];
  fill(side_[0], axis_ == 0 ? 1 : 0, ends, box);
  fill(side_[1], axis_ == 2 ? 1 : 2, ends, box);
}

std::uint32_t EndGrid::shadow(const LatticeBox& box, const LatticeBox& from) const {
  // Distances from the plane, on the side of `from`; a flat facet's box has low > high by 2.
  const std::int32_t a = box.low[axis_], b = box.high[axis_];
  const std::int32_t near_low = a < b ? a : b, near_high = a < b ? b : a;
  const bool above = from.low[axis_] > plane_;
  if (!above && from.high[axis_] >= plane_) return ~std::uint32_t{0};
  const std::int32_t x_least = floor_of(above ? near_low - plane_ : plane_ - near_high);
  const std::int32_t x_most = ceiling_of(above ? near_high - plane_ : plane_ - near_low);
  const std::int32_t p_least = floor_of(above ? from.low[axis_] - plane_ : plane_ - from.high[axis_]);
  const std::int32_t p_most = ceiling_of(above ? from.high[axis_] - plane_ : plane_ - from.low[axis_]);
  if (x_most <= 0 || x_least >= p_most) return 0;
  const std::int32_t least = x_least <= 0 ? 0 : (x_least << kRatio) / (p_most - x_least);
  const std::int32_t most =
      x_most >= p_least ? kLargestRatio : (x_most << kRatio) / (p_least - x_most) + 1;
  const bool infinite = most >= kLargestRatio;
  std::uint32_t ends = ~std::uint32_t{0};
  for (const Side& side : side_) {
    const std::uint32_t u = side.axis;
    const std::int32_t low = floor_of(box.low[u]) - 1, high = ceiling_of(box.high[u]) + 1;
    const std::int32_t way_low = low - ceiling_of(from.high[u]), way_high = high - floor_of(from.low[u]);
    const auto moved = [&](std::int32_t way, std::int32_t ratio) { return way * ratio >> kRatio; };
    const std::int32_t first = way_low >= 0 ? low + moved(way_low, least < kLargestRatio ? least : kLargestRatio)
                               : infinite   ? -kFar
                                            : low + moved(way_low, most);
    const std::int32_t last = way_high <= 0 ? high + moved(way_high, least < kLargestRatio ? least : kLargestRatio) + 1
                              : infinite    ? kFar
                                            : high + moved(way_high, most) + 1;
    ends &= side.before[side.bin(last) + 1] & ~side.before[side.bin(first)];
  }
  return ends;
}

}  // namespace shodo
