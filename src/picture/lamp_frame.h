// A lamp as a flat window that is 256 cells wide and high: which of what stands in the way can't meet a piece of it
// (picture/lamp_sight.h).
//
// The directions of the lamp's polygon are projected on a plane across them, where all of it lies before the eye; so do
// its pieces, and a triangle that has a corner beside or behind the eye fills the window. Boxes of cells that don't
// meet are a triangle and a piece that don't, which saves finding the triangle's sides. Exact in what it leaves out:
// boxes are a 16th of a cell wider than what is in them, and directions nearly across the view count as behind.
// Bytes: 4 a triangle and piece.
#pragma once

#include <cstdint>
#include <span>

#include "picture/direction_polygon.h"

namespace shodo {

/// Cells from `low` to `high`, both included.
struct CellBox {
  std::uint8_t low[2], high[2];

  static CellBox all() { return {{0, 0}, {255, 255}}; }

  bool apart(const CellBox& other) const {
    return high[0] < other.low[0] || other.high[0] < low[0] || high[1] < other.low[1] || other.high[1] < low[1];
  }
};

class LampFrame {
 public:
  /// `across`: sum of the cross products of the polygon's corners, one after the other; no corner is at more than a
  /// right angle to it.
  void start(const DirectionPolygon& polygon, const Vec3& across);
  /// Around vectors of any length.
  CellBox box(std::span<const Vec3> corners) const;

 private:
  Vec3 view_, axis_[2];
  double low_[2] = {0, 0}, cells_[2] = {0, 0};  // where the window begins, and cells per unit
};

}  // namespace shodo
