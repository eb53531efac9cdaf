// A triangle while the scanline crosses it: where its sides cut the present line, and its depth and map coordinates
// there.
//
// A side is crossed at x = ceil(m / |n.dx|), m = +-n.D linear in the row: quotient and remainder are stepped,
// exactly, so that a line costs two additions and a comparison a side. Sides so flat that the quotient leaves 32 bits
// are divided anew in each line. Inverse depth and map coordinates over depth are 64-bit fixed point, sums of three
// quotients each rounded down: at most 1 + x + rows units below the truth. What would not fit is marked `wide` and
// left to exact integers.
#pragma once

#include <cstdint>
#include <span>

#include "picture/seen_triangle.h"

namespace shodo {

inline constexpr int kInverseDepthBits = 32;
inline constexpr int kMapBits = 20;

/// c + x cx in the present line.
struct LinearValue {
  std::int64_t c = 0;   // at x = 0
  std::int64_t cx = 0;  // a sample
  std::int64_t cy = 0;  // a row

  std::int64_t at(std::int32_t x) const { return c + x * cx; }
};

/// One side in the present line: it is crossed at x = ceil(m / size), m = x size - rest.
struct ActiveEdge {
  std::int64_t size = 1;       // |n.dx|
  std::int64_t rest = 0;       // 0 .. size - 1
  std::int64_t rest_step = 0;  // 0 .. size - 1
  std::int32_t x = 0;
  std::int32_t x_step = 0;
};

struct ActiveTriangle {
  ActiveEdge edge[3];
  LinearValue inverse_depth;     // normal.D / depth 2^32; above 0 inside
  LinearValue map_u, map_v;      // (u - u[0]) normal.D / depth 2^20, u in sub-patches
  std::uint32_t triangle = 0;
  std::int32_t last_row = 0;
  std::int32_t x0 = 0, x1 = 0;   // span in the present line; x0 = columns if there is none
  std::uint8_t lower_edges = 0;  // bit k: inside is x >= edge k's crossing
  std::uint8_t upper_edges = 0;  // bit k: inside is x < edge k's crossing
  std::uint8_t slow_edges = 0;   // bit k: to be divided anew in each line
  bool front = false;
  bool wide = false;             // fixed point could overflow
};

/// The triangle at `row`, its first; it must be seen (see_triangle).
void activate(const DrawnTriangle& drawn, std::uint32_t triangle, const SampleGrid& grid, std::int32_t row,
              ActiveTriangle& active);

void move_to_next_row(ActiveTriangle& active);

/// x0 and x1 in the present row.
void find_span(const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t row, ActiveTriangle& active);

/// Map coordinates at a sample of the triangle, sub-patches 20.12, each at most 2^-12 below the truth.
struct MapPoint {
  std::int32_t u = 0, v = 0;
};
MapPoint exact_map_point(const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t x, std::int32_t row);

}  // namespace shodo
