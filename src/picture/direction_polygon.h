// A convex polygon of directions, such as a lamp fills seen from a point, and cuts of it (picture/highlight.h).
//
// Corners are vectors of any length, less than a half space of them; the inside lies where (corner k x corner k+1).u
// is positive. A plane through the point cuts such a polygon into two: a new corner lies between two old ones. Doubles.
// 392 bytes.
#pragma once

#include <cstdint>

#include "base/vector.h"

namespace shodo {

inline constexpr std::uint32_t kMostCorners = 16;

struct DirectionPolygon {
  std::uint32_t count = 0;
  Vec3 corner[kMostCorners];

  /// False if there is no room.
  bool push(const Vec3& u) {
    if (count == kMostCorners) return false;
    corner[count++] = u;
    return true;
  }
};

/// Whether no direction u of the polygon has side.u > 0.
bool beyond(const DirectionPolygon& polygon, const Vec3& side);

/// Leaves in `polygon` what has side.u >= 0 and puts the rest into `outside`; either may be empty. False if one of them
/// has too many corners.
[[nodiscard]] bool split(DirectionPolygon& polygon, const Vec3& side, DirectionPolygon& outside);

}  // namespace shodo
