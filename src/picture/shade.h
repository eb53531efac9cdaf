// What a visible span looks like (paper 2.4): perspective-correct map coordinates and bilinear lookup, in integers.
//
// u and v over depth are linear along a line, so u itself is a quotient. It is found by division at the ends of
// pieces of at most kPieceLength samples, and linearly between. With inverse depths z0 and z1 at the ends, the line
// differs from the hyperbola by at most |u1 - u0| (r - 1) / (sqrt(r) + 1)^2 <= |u1 - u0| |z1 - z0| / (4 min z), r the
// ratio of the greater z to the smaller: pieces are halved until that is at most 1/32 sub-patch; a piece of one
// sample is a quotient itself.
//
// Approximate: rounding adds under 1/100 sub-patch, so coordinates are right to 1/16. Texel centres are sub-patch
// centres; lookups clamp at the border of a map, or go round (Mesh::wraps_u). Weights have 8 bits.
#pragma once

#include <cstdint>
#include <span>

#include "picture/active_triangle.h"
#include "picture/display.h"
#include "picture/visible_lines.h"

namespace shodo {

inline constexpr std::int32_t kPieceLength = 32;
inline constexpr std::int32_t kPieceTolerance = 4096 / 32;  // sub-patches 20.12

/// Samples x .. x + length - 1; u and v in sub-patches, 20.12, at x, and a sample's step.
struct MapPiece {
  std::int32_t x = 0, length = 0;
  std::int32_t u = 0, v = 0, du = 0, dv = 0;
};

/// Cuts a span into pieces, from left to right.
class MapWalk {
 public:
  MapWalk(const ActiveTriangle& active, const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t row,
          std::int32_t x0, std::int32_t x1);

  bool next(MapPiece& piece);

 private:
  struct Point {
    std::int32_t u, v;
    std::int64_t inverse_depth;
  };
  Point point(std::int32_t x) const;
  static bool straight(const Point& a, const Point& b);

  const ActiveTriangle* active_;
  const DrawnTriangle* drawn_;
  const SampleGrid* grid_;
  std::int32_t row_, x_, end_;
};

/// A mesh's part of the display maps.
struct MapTexels {
  const std::uint16_t* texel = nullptr;
  std::int32_t width = 0, height = 0;
  std::uint32_t channels = 1;
  bool wraps_u = false;
};

/// Adds the display steps of a piece's samples, at most white each, to sums[(x >> shift) channels + channel].
void add_piece(const MapTexels& map, const MapPiece& piece, std::uint32_t shift, std::span<std::uint32_t> sums);

/// The value of a map at one point, 20.12; at most 65535.
std::uint32_t map_value(const MapTexels& map, std::int32_t u, std::int32_t v, std::uint32_t channel);

}  // namespace shodo
