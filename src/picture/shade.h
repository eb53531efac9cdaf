// Where on its map a visible span lies (paper 2.4): perspective-correct map coordinates in integers.
//
// u and v over depth are linear along a line, so u itself is a quotient. It is found by division at the ends of
// pieces of at most kPieceLength samples, and linearly between. With inverse depths z0 and z1 at the ends, the line
// differs from the hyperbola by at most |u1 - u0| (r - 1) / (sqrt(r) + 1)^2 <= |u1 - u0| |z1 - z0| / (4 min z), r the
// ratio of the greater z to the smaller: pieces are halved until that is at most 1/32 sub-patch; a piece of one
// sample is a quotient itself. A point costs one 32-bit division and a step of Newton's for 1 / z, right to 2^-28,
// and a multiplication a coordinate.
//
// Approximate: rounding adds under 1/100 sub-patch, so coordinates are right to 1/16.
#pragma once

#include <cstdint>

#include "picture/active_triangle.h"
#include "picture/sample_run.h"

namespace shodo {

inline constexpr std::int32_t kPieceLength = 128;
inline constexpr std::int32_t kPieceTolerance = 4096 / 32;  // sub-patches 20.12

/// Samples x .. x + length - 1, at most kPieceLength + 1: u and v in sub-patches at x, and a sample's step.
struct MapPiece {
  std::int32_t x = 0, length = 0;
  std::int32_t u = 0, v = 0;    // 20.12
  std::int32_t du = 0, dv = 0;  // 16.16
};

/// Cuts a run of samples into pieces, from left to right.
class MapWalk {
 public:
  /// The triangle's values must be those of the row (settle_map).
  MapWalk(const ActiveTriangle& active, const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t row,
          const SampleRun& run)
      : active_(&active), drawn_(&drawn), grid_(&grid), row_(row), x_(run.x0), end_(run.x1),
        column_of_0_(run.column_of(0)), bits_(run.bits), start_(point(x_)) {}

  bool next(MapPiece& piece);

 private:
  struct Point {
    std::int32_t u, v;
    std::uint32_t inverse_depth;  // 31 bits; so many
    std::int32_t shift;           // were cut off
  };
  Point point(std::int32_t x) const;
  static bool straight(const Point& a, const Point& b);

  const ActiveTriangle* active_;
  const DrawnTriangle* drawn_;
  const SampleGrid* grid_;
  std::int32_t row_, x_, end_, column_of_0_;
  std::uint32_t bits_;
  Point start_;  // at x_
};

inline bool MapWalk::straight(const Point& a, const Point& b) {
  const Point& low = a.shift < b.shift ? a : b;
  const Point& high = a.shift < b.shift ? b : a;
  const std::int32_t apart = high.shift - low.shift;
  const std::uint32_t cut = apart > 31 ? 0 : low.inverse_depth >> apart;
  const std::uint32_t near = cut > high.inverse_depth ? cut : high.inverse_depth;
  const std::uint32_t far = cut > high.inverse_depth ? high.inverse_depth : cut;
  const auto size = [](std::int32_t d) { return static_cast<std::uint32_t>(d < 0 ? -d : d); };
  const std::uint32_t du = size(a.u - b.u), dv = size(a.v - b.v);
  // One unit for what the shift cuts off.
  return std::uint64_t{du > dv ? du : dv} * (near - far + 1) <= std::uint64_t{4 * kPieceTolerance} * far;
}

inline bool MapWalk::next(MapPiece& piece) {
  if (x_ >= end_) return false;
  piece = {x_, 1, start_.u, start_.v, 0, 0};
  std::int32_t reach = end_ - x_ <= kPieceLength ? end_ - x_ - 1 : kPieceLength;
  if (active_->wide_map && reach > 1) reach = 1;
  Point end = start_;
  for (; reach > 0; reach /= 2) {
    end = point(x_ + reach);
    if (reach == 1 || straight(start_, end)) break;
  }
  if (reach > 1) {
    // The last piece has its end, others leave it to the next. Differences are below 2^27.
    piece.length = x_ + reach + 1 == end_ ? reach + 1 : reach;
    piece.du = (end.u - start_.u) * 8 / reach * 2;
    piece.dv = (end.v - start_.v) * 8 / reach * 2;
  }
  x_ += piece.length;
  start_ = end;
  return true;
}

}  // namespace shodo
