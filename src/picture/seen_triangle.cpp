#include "picture/seen_triangle.h"

namespace shodo {

namespace {

LatticeVector turned(const LatticeVector& a, bool turn) { return turn ? LatticeVector{-a.x, -a.y, -a.z} : a; }

std::int32_t clamped_row(std::int64_t row, std::uint32_t rows) {
  if (row < 0) return -1;
  return row > rows ? static_cast<std::int32_t>(rows) : static_cast<std::int32_t>(row);
}

/// A corner in the picture: at row `row` / `depth`, before the eye if depth > 0.
struct SeenCorner {
  Int128 row;
  std::int64_t depth;
};

/// Where the side from `a`, before the eye, to `b`, beside or behind it, leaves the picture: it runs to row +infinity
/// if positive, to -infinity if negative.
int row_at_infinity(const SeenCorner& a, const SeenCorner& b) {
  const auto order = multiply(b.row, a.depth) <=> multiply(a.row, b.depth);
  return order > 0 ? 1 : order < 0 ? -1 : 0;
}

/// The rows between the corners, which reach to infinity where a side passes the eye's plane.
RowRange rows_between_corners(const SeenTriangle& seen, const SampleGrid& grid) {
  SeenCorner corner[3];
  for (int k = 0; k < 3; ++k) {
    corner[k] = {dot_wide(seen.corner[k], grid.row_of), dot(seen.corner[k], grid.depth_of)};
  }
  const std::int32_t end = static_cast<std::int32_t>(grid.rows);
  RowRange range{end, -1};
  const auto widen = [&](std::int32_t first, std::int32_t last) {
    if (first < range.first) range.first = first < 0 ? 0 : first;
    if (last > range.last) range.last = last >= end ? end - 1 : last;
  };
  for (int k = 0; k < 3; ++k) {
    if (corner[k].depth <= 0) continue;
    const std::int32_t row = clamped_row(floor_divide(corner[k].row, corner[k].depth), grid.rows);
    widen(row, row);
    for (int other = 0; other < 3; ++other) {
      if (corner[other].depth > 0) continue;
      const int way = row_at_infinity(corner[k], corner[other]);
      if (way <= 0) widen(0, -1);
      if (way >= 0) widen(end, end - 1);
    }
  }
  return range;
}

struct Point {
  std::int32_t c[3];
};

Point point_of(const LatticePoint& p) { return {{p.x, p.y, p.z}}; }

bool less(const Point& a, const Point& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.c[k] != b.c[k]) return a.c[k] < b.c[k];
  }
  return false;
}

struct SortedVertices {
  Point vertex[3];
};

SortedVertices sorted(const DrawnTriangle& triangle) {
  SortedVertices s{{point_of(triangle.vertex[0]), point_of(triangle.vertex[1]), point_of(triangle.vertex[2])}};
  const auto order = [&](int a, int b) {
    if (!less(s.vertex[b], s.vertex[a])) return;
    const Point swap = s.vertex[a];
    s.vertex[a] = s.vertex[b];
    s.vertex[b] = swap;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return s;
}

/// Four times the area squared, lattice steps^4: below 2^84.
Int128 area_measure(const DrawnTriangle& triangle) {
  const LatticeVector n = cross(triangle.vertex[1] - triangle.vertex[0], triangle.vertex[2] - triangle.vertex[0]);
  return dot_wide(n, n);
}

/// A vector's direction, with components below 2^30.
LatticePoint cut(const LatticeVector& v) {
  unsigned shift = 0;
  const auto fits = [&](std::int64_t c) {
    c >>= shift;
    return c < (std::int64_t{1} << 30) && c > -(std::int64_t{1} << 30);
  };
  while (!fits(v.x) || !fits(v.y) || !fits(v.z)) ++shift;
  return {static_cast<std::int32_t>(v.x >> shift), static_cast<std::int32_t>(v.y >> shift),
          static_cast<std::int32_t>(v.z >> shift)};
}

}  // namespace

Frame::Frame(const SampleGrid& grid) : eye_(grid.eye) {
  const LatticeVector right = grid.direction(grid.columns - 1, 0), bottom = grid.direction(0, grid.rows - 1);
  inwards_[0] = cut(cross(grid.dy, grid.d0));
  inwards_[1] = cut(cross(right, grid.dy));
  inwards_[2] = cut(cross(grid.d0, grid.dx));
  inwards_[3] = cut(cross(grid.dx, bottom));
}

bool Frame::leaves_out(const DrawnTriangle& triangle) const {
  // What was cut off is below 1 in each component, and corners are within 2^21 of the eye.
  constexpr std::int64_t kSurely = -3 * (std::int64_t{1} << 21);
  LatticePoint corner[3];
  for (int k = 0; k < 3; ++k) {
    const LatticePoint& p = triangle.vertex[k];
    corner[k] = {p.x - eye_.x, p.y - eye_.y, p.z - eye_.z};
  }
  for (const LatticePoint& n : inwards_) {
    bool beyond = true;
    for (int k = 0; k < 3 && beyond; ++k) {
      beyond = product(n.x, corner[k].x) + product(n.y, corner[k].y) + product(n.z, corner[k].z) < kSurely;
    }
    if (beyond) return true;
  }
  return false;
}

bool see_triangle(const DrawnTriangle& triangle, const LatticePoint& eye, SeenTriangle& seen) {
  for (int k = 0; k < 3; ++k) seen.corner[k] = triangle.vertex[k] - eye;
  const LatticeVector bc = cross(seen.corner[1], seen.corner[2]);
  const std::int64_t depth = dot(seen.corner[0], bc);
  if (depth == 0) return false;
  seen.front = depth < 0;
  seen.depth = seen.front ? -depth : depth;
  seen.edge[0] = turned(cross(seen.corner[0], seen.corner[1]), seen.front);
  seen.edge[1] = turned(bc, seen.front);
  seen.edge[2] = turned(cross(seen.corner[2], seen.corner[0]), seen.front);
  seen.normal = {seen.edge[0].x + seen.edge[1].x + seen.edge[2].x, seen.edge[0].y + seen.edge[1].y + seen.edge[2].y,
                 seen.edge[0].z + seen.edge[1].z + seen.edge[2].z};
  return true;
}

RowRange rows_of(const SeenTriangle& seen, const SampleGrid& grid) {
  RowRange range = rows_between_corners(seen, grid);
  for (int k = 0; k < 3 && !range.empty(); ++k) {
    const LatticeVector& n = seen.edge[k];
    if (dot(n, grid.dx) != 0) continue;
    const std::int64_t slope = dot(n, grid.dy);
    // An edge in the eye's own plane has all directions on one side: the inner one, or nothing lay before the eye.
    if (slope == 0) continue;
    const std::int32_t row = clamped_row(ceil_divide(dot_wide(n, grid.d0), -slope), grid.rows);
    if (slope > 0 && row > range.first) range.first = row;
    if (slope < 0 && row - 1 < range.last) range.last = row - 1;
  }
  return range;
}

bool wins_tie(std::span<const DrawnTriangle> drawn, std::uint32_t a, bool a_front, std::uint32_t b, bool b_front) {
  if (a_front != b_front) return a_front;
  const Int128 area_a = area_measure(drawn[a]), area_b = area_measure(drawn[b]);
  if (area_a != area_b) return area_a < area_b;
  const SortedVertices va = sorted(drawn[a]), vb = sorted(drawn[b]);
  for (int k = 0; k < 3; ++k) {
    if (less(va.vertex[k], vb.vertex[k])) return true;
    if (less(vb.vertex[k], va.vertex[k])) return false;
  }
  return a < b;
}

bool is_nearer(std::span<const DrawnTriangle> drawn, const LatticePoint& eye, const LatticeVector& direction,
               std::uint32_t a, std::uint32_t b) {
  SeenTriangle seen_a, seen_b;
  see_triangle(drawn[a], eye, seen_a);
  see_triangle(drawn[b], eye, seen_b);
  // normal.D / depth of both, crosswise: 2^69 times 2^61.
  const Int192 left = multiply(dot_wide(seen_a.normal, direction), seen_b.depth);
  const Int192 right = multiply(dot_wide(seen_b.normal, direction), seen_a.depth);
  if (left != right) return left > right;
  return wins_tie(drawn, a, seen_a.front, b, seen_b.front);
}

}  // namespace shodo
