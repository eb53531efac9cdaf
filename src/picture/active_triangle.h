// A triangle while the scanline crosses it: where its sides cut the present line, and its depth and map coordinates
// there.
//
// A side is crossed at x = ceil(m / |n.dx|), m = +-n.D linear in the row: quotient and remainder are stepped,
// exactly, so that a line costs two additions and a look at a sign a side. Sides so flat that the quotient leaves 32
// bits are divided anew in each line. Inverse depth and map coordinates over depth are 64-bit fixed point, sums of
// three quotients each rounded down: at most 1 + x + rows units below the truth. What would not fit is marked `wide`
// and left to exact integers. Where columns are parts of a pixel, directions are so many times longer, all this finer.
#pragma once

#include <cstdint>
#include <span>

#include "picture/seen_triangle.h"

namespace shodo {

inline constexpr int kInverseDepthBits = 32;
inline constexpr int kMapBits = 20;

/// a b modulo 2^64, in fewer multiplications where registers have 32 bits.
inline std::int64_t times(std::int64_t a, std::int32_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) * static_cast<std::uint32_t>(b));
}

/// c + x cx in one row.
struct LinearValue {
  std::int64_t c = 0;   // at x = 0
  std::int64_t cx = 0;  // a column
  std::int64_t cy = 0;  // a row

  std::int64_t at(std::int32_t x) const { return c + times(cx, x); }
  void move_rows(std::int32_t rows) { c += rows == 1 ? cy : times(cy, rows); }
};

/// One side in the present line: it is crossed at x = ceil(m / size), m = (x - 1) size - below.
struct ActiveEdge {
  std::int64_t below = -1;     // -size .. -1
  std::int64_t rest_step = 0;  // 0 .. size - 1: what m falls short of x_step sizes by, a row
  std::int64_t size = 1;       // |n.dx|
  std::int32_t x = 0;
  std::int32_t x_step = 0;
};

/// Sides and depth stand for every row; map coordinates, of what is visible only, wait at the row where they were last
/// asked for.
struct ActiveTriangle {
  std::int32_t x0 = 0, x1 = 0;    // span in the present line, x0 within 0 .. columns; none if x1 <= x0
  std::uint32_t triangle = 0;
  std::uint16_t last_row = 0;
  std::uint16_t map_row = 0;
  std::uint8_t lower_edges = 0;   // so many first of `edge`: inside is x >= the crossing
  std::uint8_t edges = 0;         // lower and upper ones: inside of these is x < the crossing
  std::uint8_t slow_edges = 0;    // bit k: edge[k] is to be divided anew in each line
  std::uint8_t sides = 0;         // of the triangle, two bits each: which of them edge[k] is
  bool front = false;
  bool wide = false;              // inverse depth could overflow
  bool has_map = false;
  bool wide_map = false;          // inverse depth or map coordinates could overflow
  ActiveEdge edge[3];
  LinearValue inverse_depth;      // normal.D / depth 2^32; above 0 inside
  LinearValue map_u, map_v;       // (u - u[0]) normal.D / depth 2^20, u in sub-patches; of the carrier and map_row
};

static_assert(sizeof(ActiveTriangle) == 192, "src/memory_plan.cpp");

/// The triangle at `row`, its first (rows_of), and its span; it must be seen (see_triangle).
void activate(const DrawnTriangle& drawn, std::uint32_t triangle, const SampleGrid& grid, std::int32_t row,
              std::uint16_t last_row, ActiveTriangle& active);

/// Its span where the edges stand now; slow ones are divided for `row`.
void find_span(const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t row, ActiveTriangle& active);

/// Where an edge is crossed in the next row; a slow one moves too, to no effect.
inline std::int32_t move_edge(ActiveEdge& edge) {
  std::int32_t x = edge.x + edge.x_step;
  std::int64_t below = edge.below + edge.rest_step;
  if (below >= 0) {
    below -= edge.size;
    --x;
  }
  edge.below = below;
  edge.x = x;
  return x;
}

/// Its span and depth in `row`, the one after that of its last call.
inline void move_to_row(const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t row, ActiveTriangle& active) {
  const std::int32_t columns = static_cast<std::int32_t>(grid.columns);
  std::int32_t x0 = 0, x1 = columns;
  ActiveEdge* edge = active.edge;
  for (const ActiveEdge* const end = active.edge + active.lower_edges; edge != end; ++edge) {
    const std::int32_t x = move_edge(*edge);
    if (x > x0) x0 = x;
  }
  for (const ActiveEdge* const end = active.edge + active.edges; edge != end; ++edge) {
    const std::int32_t x = move_edge(*edge);
    if (x < x1) x1 = x;
  }
  active.x0 = x0 < columns ? x0 : columns;
  active.x1 = x1;
  active.inverse_depth.c += active.inverse_depth.cy;
  if (active.slow_edges != 0) find_span(drawn, grid, row, active);
}

/// map_u and map_v for `row`, by the map of `carrier`, a triangle in the same plane (map_plane.h).
void place_map(const DrawnTriangle& carrier, const SampleGrid& grid, std::int32_t row, ActiveTriangle& active);

inline void settle_map(const DrawnTriangle& carrier, const SampleGrid& grid, std::int32_t row, ActiveTriangle& active) {
  if (!active.has_map) return place_map(carrier, grid, row, active);
  active.map_u.move_rows(row - active.map_row);
  active.map_v.move_rows(row - active.map_row);
  active.map_row = static_cast<std::uint16_t>(row);
}

/// Map coordinates at a column of the triangle, sub-patches 20.12, each at most 2^-12 below the truth.
struct MapPoint {
  std::int32_t u = 0, v = 0;
};
MapPoint exact_map_point(const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t x, std::int32_t row);

}  // namespace shodo
