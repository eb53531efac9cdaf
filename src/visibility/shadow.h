// Which of many segments from one point something blocks: the exact test (visibility/triangle_test.h) in bulk.
//
// With the point P fixed every condition of the test is a linear function of the other end Q: the side of the plane,
// N.Q - D, and for each edge AB the determinant (Q-P).((A-P) x (B-P)). Over a box that holds all ends such a function
// takes its least and its largest value at corners. Where the largest fails no end is blocked, and where the least
// holds nothing is to be asked of single ends: most triangles are done so, with all or none of the ends in shadow, and
// of the rest one or two conditions remain. A facet that fills its box, square to an axis, needs the four sides of a
// rectangle only, in products of two 32-bit differences.
// Exact: all of it, the same answers as triangle by triangle and segment by segment. Stack: 350 bytes; no memory.
#pragma once

#include <cstdint>
#include <span>

#include "visibility/blockers.h"
#include "visibility/geometry.h"
#include "visibility/lattice_box.h"

namespace shodo {

inline constexpr std::uint32_t kMostEnds = 32;

/// Segments from one point.
struct Segments {
  LatticePoint from;
  std::span<const LatticePoint> ends;  // at most kMostEnds
  LatticeBox box;                      // around the ends, or more
};

/// Those of `wanted` (bit k: to end k) which the triangle blocks.
std::uint32_t shadow_of(const Triangle& triangle, const Segments& segments, std::uint32_t wanted);

/// Likewise, of a facet and its triangles.
std::uint32_t shadow_of(const Facet& facet, std::span<const Triangle> triangles, const Segments& segments,
                        std::uint32_t wanted);

}  // namespace shodo
