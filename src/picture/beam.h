// The space between a few points, which rays of neighbouring samples sweep: what lies outside can't come in their way
// (paper 2.4; picture/optics.h).
//
// The rays of a row's samples that met the same surfaces lie in a plane, between two of them, and end on lines: a flat
// quadrilateral. Its box, the plane, and the planes through both rays square to it leave out what doesn't meet it.
// All in steps of 64 of the lattice, directions to 13 bits, so that 32 bits hold every product; rounded outwards, so
// that nothing which meets the hull is missed, and 4 steps more for points that were rounded to the lattice.
// Exact in that sense; what is near the hull may count as in it. Stack: 100 bytes.
#pragma once

#include <cstdint>
#include <span>

#include "base/lattice.h"
#include "visibility/geometry.h"
#include "visibility/lattice_box.h"

namespace shodo {

class Beam {
 public:
  /// Between two rays: points at which they begin and end, coordinates within 2^22.
  Beam(const LatticePoint& from_a, const LatticePoint& from_b, const LatticePoint& to_a, const LatticePoint& to_b);

  bool misses(const LatticeBox& box) const;
  bool misses(const DrawnTriangle& triangle) const;

 private:
  struct Point {
    std::int32_t c[3];
  };
  struct Slab {  // low <= normal.p <= high
    std::int32_t normal[3], low, high;
  };
  void include(const LatticePoint& p);
  void add_slab(const std::int64_t (&normal)[3], std::span<const Point> points);

  LatticeBox around_;
  Slab slabs_[3];
  std::uint32_t count_ = 0;
};

}  // namespace shodo
