// Cuts a plane polygon of more than four corners into triangles (ear clipping), convex or not.
//
// The corners are seen along that axis in which the polygon's vector area is largest, and rounded to a lattice of 2^29
// to 2^30 steps over the polygon's extent each way, a step a power of two: hundreds of times finer than the lattice on
// which the whole scene will lie (base/lattice.h), and whole millimetres stay what they are. From there on everything
// is decided in integers, exactly. An ear is a corner that turns left whose triangle no other part of the polygon
// enters; polygons that touch themselves, as those do whose holes are joined to the rim by a double edge, have ears
// too. Corners where the polygon turns back on itself are passed over. A polygon whose parts cancel but for 2^-30 of
// them crosses itself, and has no such axis: it is refused.
//
// Why what comes out is right, whatever went in: all triangles turn left and, a last step makes sure, no two overlap.
// Their edges add up to the polygon's, so it winds around each point as often as there are triangles on it: once or
// not at all. A polygon that crosses itself winds twice, or the other way round, somewhere, and is refused.
//
// Approximate: the rounding. Bytes: 16 a corner and 6 a triangle, of the caller's. Time n^2 for n corners.
#pragma once

#include <cstdint>
#include <span>

#include "base/vector.h"

namespace shodo {

inline constexpr std::uint32_t kMostCorners = 1024;  // of a face

struct CutCorner {
  std::int32_t u = 0, v = 0;                // lattice
  std::uint16_t previous = 0, next = 0;     // of those not cut off yet
  bool tried = false;                       // no ear, as long as its neighbours stay
};

struct CutTriangle {
  std::uint16_t corner[3] = {0, 0, 0};
};

/// The triangles, turning as the polygon does: the first so many of `triangles`; 0 if it can't be cut. From 3 to
/// kMostCorners corners, in order; `scratch` has as many, `triangles` two less.
std::uint32_t cut_polygon(std::span<const Vec3> corners, std::span<CutCorner> scratch,
                          std::span<CutTriangle> triangles);

}  // namespace shodo
