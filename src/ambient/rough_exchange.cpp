#include "ambient/rough_exchange.h"

#include <bit>

namespace shodo {

namespace {

constexpr double kDisc = 0.3;  // of the sum of the squares of half axes: the area over pi of a square

std::int32_t magnitude(std::int32_t x) { return x < 0 ? -x : x; }

std::int32_t product(const std::int32_t* x, const std::int32_t* y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/// One end in four quarters, shifted.
struct Quarters {
  std::int32_t at[4][3];  // centres, from the end's
  std::int32_t height[4];  // of what of each is in front, over the other's plane
  std::int32_t axes;       // sum of the squares of a quarter's half axes

  /// `over`: of the end's centre over the plane with this normal.
  Quarters(const PlacedSide& side, int by, const std::int32_t* normal, std::int32_t over) {
    std::int32_t a[3], b[3];
    for (int k = 0; k < 3; ++k) {
      a[k] = side.a[k] >> (by + 1);
      b[k] = side.b[k] >> (by + 1);
    }
    axes = product(a, a) + product(b, b);
    const std::int32_t climb_a = product(normal, a) >> 14, climb_b = product(normal, b) >> 14;
    const std::int32_t extent = magnitude(climb_a) + magnitude(climb_b);
    for (int q = 0; q < 4; ++q) {
      const bool back_a = (q & 1) != 0, back_b = (q & 2) != 0;
      for (int k = 0; k < 3; ++k) at[q][k] = (back_a ? -a[k] : a[k]) + (back_b ? -b[k] : b[k]);
      height[q] = mean_in_front(over + (back_a ? -climb_a : climb_a) + (back_b ? -climb_b : climb_b), extent);
    }
  }
};

}  // namespace

double rough_exchange(const PlacedSide& i, const PlacedSide& j) {
  std::uint32_t bits = i.reach | j.reach;
  std::int32_t way[3];
  for (int k = 0; k < 3; ++k) {
    way[k] = j.centre[k] - i.centre[k];
    bits |= static_cast<std::uint32_t>(magnitude(way[k]));
  }
  const int width = static_cast<int>(std::bit_width(bits)), by = width > 13 ? width - 13 : 0;
  for (std::int32_t& w : way) w >>= by;
  const Quarters of_j(j, by, i.normal, product(i.normal, way) >> 14);
  const Quarters of_i(i, by, j.normal, -(product(j.normal, way) >> 14));
  const double disc = kDisc * static_cast<double>(of_i.axes > of_j.axes ? of_i.axes : of_j.axes);
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    if (of_i.height[k] <= 0) continue;
    const std::int32_t from[3] = {way[0] - of_i.at[k][0], way[1] - of_i.at[k][1], way[2] - of_i.at[k][2]};
    for (int l = 0; l < 4; ++l) {
      if (of_j.height[l] <= 0) continue;
      const std::int32_t apart[3] = {from[0] + of_j.at[l][0], from[1] + of_j.at[l][1], from[2] + of_j.at[l][2]};
      const std::int32_t squared = product(apart, apart), heights = of_i.height[k] * of_j.height[l];
      const double r2 = static_cast<double>(squared);
      sum += heights < squared ? static_cast<double>(heights) / (r2 * (r2 + disc)) : 1 / (r2 + disc);
    }
  }
  const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - 2 * by) << 52);  // 4^-by
  return i.weight * j.weight * scale * (sum * (1.0 / 16));
}

}  // namespace shodo
