#include "visibility/sweep.h"

namespace shodo {

/// What is beyond n_u u + n_v v = limit is out. Of the box the largest value counts, of what is asked about the least;
/// corners are rounded down, a flat facet's box may be a step too small (facet_box()), and the rounded direction is off
/// by half a step of 64 in each coordinate at the end of its way.
void Sweep::add(const LatticeBox& from, std::uint32_t number, std::uint32_t u, std::uint32_t v,
                std::int32_t normal_u, std::int32_t normal_v) {
  const auto largest = [&](std::uint32_t axis, std::int32_t normal) {
    return normal * ((normal > 0 ? from.high[axis] : from.low[axis]) >> ShaftLine::kSteps);
  };
  const std::int32_t size = (normal_u < 0 ? -normal_u : normal_u) + (normal_v < 0 ? -normal_v : normal_v);
  constexpr std::int32_t kTurned = 1 << (20 - ShaftLine::kSteps);  // of the direction, 2^20 steps long
  ShaftLine& line = lines_[number];
  line.u = 4 * (normal_u > 0 ? u : 3 + u);
  line.v = 4 * (normal_v > 0 ? v : 3 + v);
  line.normal_u = normal_u;
  line.normal_v = normal_v;
  line.limit = largest(u, normal_u) + largest(v, normal_v) + 2 * size + 2 * kTurned;
}

Sweep::Sweep(const LatticeBox& from, const LatticePoint& direction, std::int32_t part)
    : from_(from), to_(from), around_(from) {
  constexpr std::int32_t kHalf = 1 << (ShaftLine::kSteps - 1);
  const std::int32_t whole[3] = {direction.x, direction.y, direction.z};
  std::int32_t way[3];
  for (int k = 0; k < 3; ++k) {
    way[k] = (whole[k] + kHalf) >> ShaftLine::kSteps;
    const std::int32_t moved = static_cast<std::int32_t>(product(whole[k], part) >> kPartBits);
    to_.low[k] += moved;
    to_.high[k] += moved + 1;
  }
  around_.include(to_);
  for (std::uint32_t u = 0; u < 3; ++u) {
    const std::uint32_t v = u == 2 ? 0 : u + 1;
    add(from, 2 * u, u, v, way[v], -way[u]);
    add(from, 2 * u + 1, u, v, -way[v], way[u]);
  }
}

}  // namespace shodo
