#include "picture/active_triangle.h"

namespace shodo {

namespace {

constexpr std::int64_t kFixedLimit = std::int64_t{1} << 61;
constexpr std::int64_t kCrossingLimit = std::int64_t{1} << 30;

std::int64_t magnitude(std::int64_t a) { return a < 0 ? (a == INT64_MIN ? INT64_MAX : -a) : a; }

/// a b of which 128 bits are enough.
Int128 product(const Int128& a, std::int64_t b) {
  const Int192 p = multiply(a, b);
  return {static_cast<std::int64_t>(p.middle), p.low};
}

bool fits(const LinearValue& value, const SampleGrid& grid) {
  return magnitude(value.c) < kFixedLimit && magnitude(value.cx) < kFixedLimit / grid.columns &&
         magnitude(value.cy) < kFixedLimit / grid.rows;
}

/// n.D with D = `start` at x = 0 of the row; cy is to be taken 2^split times.
struct EdgeValue {
  Int128 c;
  std::int64_t cx = 0, cy = 0;
};

EdgeValue edge_value(const LatticeVector& n, const SampleGrid& grid, const LatticeVector& start) {
  return {dot_wide(n, start), dot(n, grid.dx), dot(n, grid.dy)};
}

/// False if the crossing would leave 32 bits within `rows` rows.
bool set_edge(const EdgeValue& value, unsigned split, std::int64_t rows, ActiveEdge& edge) {
  const bool lower = value.cx > 0;
  const Int128 m = lower ? -value.c : value.c;
  const Int128 m_step = Int128(lower ? -value.cy : value.cy) << split;
  edge.size = magnitude(value.cx);
  const std::int64_t x = ceil_divide(m, edge.size);
  const std::int64_t x_step = ceil_divide(m_step, edge.size);
  if (magnitude(x) >= kCrossingLimit || magnitude(x_step) >= kCrossingLimit / rows) {
    edge = ActiveEdge();
    return false;
  }
  edge.x = static_cast<std::int32_t>(x);
  edge.x_step = static_cast<std::int32_t>(x_step);
  edge.below = static_cast<std::int64_t>((multiply(x - 1, edge.size) - m).low);
  edge.rest_step = static_cast<std::int64_t>((multiply(x_step, edge.size) - m_step).low);
  return true;
}

/// (a_1 e_1 + a_2 e_2) 2^bits / depth: the numerator's three coefficients.
struct WideLinear {
  Int128 c, cx, cy;
};

WideLinear combine(const EdgeValue& e1, std::int64_t a1, const EdgeValue& e2, std::int64_t a2, unsigned split) {
  return {product(e1.c, a1) + product(e2.c, a2), multiply(e1.cx, a1) + multiply(e2.cx, a2),
          (multiply(e1.cy, a1) + multiply(e2.cy, a2)) << split};
}

LinearValue fixed(const WideLinear& value, unsigned bits, std::int64_t depth) {
  return {floor_divide(value.c << bits, depth), floor_divide(value.cx << bits, depth),
          floor_divide(value.cy << bits, depth)};
}

/// Which of the triangle's sides edge[k] is.
unsigned side_of(const ActiveTriangle& active, unsigned k) { return active.sides >> 2 * k & 3; }

/// Whether a coordinate changes by less than 2^15 sub-patches over the triangle.
bool is_narrow(const std::int32_t* at) {
  constexpr std::int64_t kMost = (std::int64_t{1} << 23) - 256;
  return magnitude(std::int64_t{at[1]} - at[0]) < kMost && magnitude(std::int64_t{at[2]} - at[0]) < kMost;
}

}  // namespace

void find_span(const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t row, ActiveTriangle& active) {
  const std::int32_t columns = static_cast<std::int32_t>(grid.columns);
  SeenTriangle seen;
  if (active.slow_edges != 0) see_triangle(drawn, grid.eye, seen);
  std::int32_t x0 = 0, x1 = columns;
  for (unsigned k = 0; k < active.edges; ++k) {
    std::int32_t x = active.edge[k].x;
    if ((active.slow_edges >> k & 1) != 0) {
      const EdgeValue value = edge_value(seen.edge[side_of(active, k)], grid, grid.direction(0, row));
      const std::int64_t crossing = ceil_divide(value.c, -value.cx);
      x = crossing < 0 ? 0 : crossing > columns ? columns : static_cast<std::int32_t>(crossing);
    }
    if (k < active.lower_edges && x > x0) x0 = x;
    if (k >= active.lower_edges && x < x1) x1 = x;
  }
  active.x0 = x0 < columns ? x0 : columns;
  active.x1 = x1;
}

void activate(const DrawnTriangle& drawn, std::uint32_t triangle, const SampleGrid& grid, std::int32_t row,
              std::uint16_t last_row, ActiveTriangle& active) {
  SeenTriangle seen;
  see_triangle(drawn, grid.eye, seen);
  active = ActiveTriangle();
  active.triangle = triangle;
  active.front = seen.front;
  active.last_row = last_row;
  const LatticeVector start = grid.direction(0, row);
  EdgeValue value[3];
  for (int k = 0; k < 3; ++k) value[k] = edge_value(seen.edge[k], grid, start);
  // Sides along the rows are none here: rows_of has seen to them.
  const auto add = [&](unsigned side) {
    active.sides = static_cast<std::uint8_t>(active.sides | side << 2 * active.edges);
    ++active.edges;
  };
  for (unsigned k = 0; k < 3; ++k) {
    if (value[k].cx > 0) add(k);
  }
  active.lower_edges = active.edges;
  for (unsigned k = 0; k < 3; ++k) {
    if (value[k].cx < 0) add(k);
  }
  for (unsigned k = 0; k < active.edges; ++k) {
    const bool steps = set_edge(value[side_of(active, k)], grid.split, last_row - row + 1, active.edge[k]);
    if (!steps) active.slow_edges = static_cast<std::uint8_t>(active.slow_edges | 1u << k);
  }
  find_span(drawn, grid, row, active);
  const EdgeValue normal = edge_value(seen.normal, grid, start);
  active.inverse_depth =
      fixed({normal.c, Int128(normal.cx), Int128(normal.cy) << grid.split}, kInverseDepthBits, seen.depth);
  active.wide = !fits(active.inverse_depth, grid);
  if (active.wide) active.inverse_depth = LinearValue();
}

void place_map(const DrawnTriangle& carrier, const SampleGrid& grid, std::int32_t row, ActiveTriangle& active) {
  SeenTriangle seen;
  see_triangle(carrier, grid.eye, seen);
  const LatticeVector start = grid.direction(0, row);
  // The weight of a corner is the edge opposite to it: corner 1 has edge 2, corner 2 has edge 0.
  const EdgeValue first = edge_value(seen.edge[2], grid, start), second = edge_value(seen.edge[0], grid, start);
  const auto map = [&](const std::int32_t* at) {
    return fixed(combine(first, std::int64_t{at[1]} - at[0], second, std::int64_t{at[2]} - at[0], grid.split),
                 kMapBits - 8, seen.depth);
  };
  active.map_u = map(carrier.u);
  active.map_v = map(carrier.v);
  active.map_row = static_cast<std::uint16_t>(row);
  active.has_map = true;
  active.wide_map = active.wide || !fits(active.map_u, grid) || !fits(active.map_v, grid) || !is_narrow(carrier.u) ||
                    !is_narrow(carrier.v);
  if (active.wide_map) active.map_u = active.map_v = LinearValue();
}

MapPoint exact_map_point(const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t x, std::int32_t row) {
  SeenTriangle seen;
  see_triangle(drawn, grid.eye, seen);
  const LatticeVector direction = grid.direction(x, row);
  const Int128 e1 = dot_wide(seen.edge[2], direction), e2 = dot_wide(seen.edge[0], direction);
  Int128 whole = dot_wide(seen.normal, direction);
  unsigned shift = 0;
  for (; !fits_64(whole); whole = whole >> 1) ++shift;
  const auto at = [&](const std::int32_t* u) {
    const Int128 part = product(e1, std::int64_t{u[1]} - u[0]) + product(e2, std::int64_t{u[2]} - u[0]);
    const std::int64_t beyond = floor_divide((part << (12 - 8)) >> shift, static_cast<std::int64_t>(whole.low));
    return static_cast<std::int32_t>((std::int64_t{u[0]} << (12 - 8)) + beyond);
  };
  return {at(drawn.u), at(drawn.v)};
}

}  // namespace shodo
