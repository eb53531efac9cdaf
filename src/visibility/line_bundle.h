// A bundle of parallel lines through the whole scene, and all that each of them crosses, in order (ambient/gather.h):
// "global lines" (Sbert 1993), swept row by row as a scanline renderer does (paper 2.4; Neumann 1995).
//
// The direction is (m, a, b), m = 2^10, along its dominant axis x: seen along it a point is at (m y - a x, m z - b x),
// two integers of 31 bits. Lines start at lattice points of x = 0, at even distances in rows; each row is shifted
// against the one before by the golden section. Rows are cut with the polygons' outlines as scanlines are, half-open,
// by quotients that are stepped from row to row without any error: a seam is passed once, never twice.
// Where polygons are along a line is stepped in 2^-10 of the lattice; those that are within two steps of each other
// there are compared exactly, by fractions. Of those that a line meets at one point, what faces against it comes first,
// so that a sheet's two faces hide each other.
// Exact: which polygons a line crosses, and their order. Bytes: 124 a polygon, 4 a corner of it, 1,024.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "visibility/geometry.h"

namespace shodo {

class LineBundle {
 public:
  static constexpr int kUnitBits = 10;   // of the direction's largest component
  static constexpr int kDepthBits = 10;  // beyond those of the lattice
  static constexpr double kLeastSpacing = 64, kMostSpacing = 1 << 18;

  /// What a line crosses.
  struct Crossing {
    std::int32_t at, step;   // along the dominant axis, in 2^-kDepthBits; from line to line
    std::int32_t end;        // a line of the row: `at` is right until then
    std::uint32_t triangle;  // of the geometry; one of the polygon's
    bool up;                 // its front faces along the direction
    bool fresh;              // `at` doesn't follow from the line before; who has seen it may forget
    bool first;              // and `step` neither: the first one of its polygon
  };

  /// What it takes of an arena: a part that may come from elsewhere, and the rest.
  struct Bytes {
    std::uint64_t cuts = 0, rest = 0;
    std::uint32_t polygons = 0;  // polygons()
  };
  static Bytes bytes(const Geometry& geometry);
  /// False: an arena is too small.
  bool take(const Geometry& geometry, Arena& arena, Arena& for_cuts);
  /// Polygons that lines may cross: as many crossings has a line at most.
  std::uint32_t polygons() const { return static_cast<std::uint32_t>(outlines_.size()); }

  /// `direction` isn't zero; `spacing`: the side of a line's square, seen along the lines, in steps of the lattice;
  /// all lines are shifted by parts of it, 0 to 1.
  void aim(const Vec3& direction, double spacing, double shift_y, double shift_z);
  /// The next row that cuts anything; false: there is none.
  bool next_row();
  /// The next lines of the row that cross the same polygons, some, in the same order; false: there are none.
  bool next_lines();
  /// How many they are.
  std::uint32_t lines() const { return static_cast<std::uint32_t>(together_); }
  /// What they cross, in the direction's order; numbers of crossings, each below polygons().
  std::span<const std::uint32_t> order() const { return order_.first(on_line_); }
  Crossing& crossing(std::uint32_t number) { return crossings_[number]; }

  /// A point of the first of them, or of one `further` on, where the dominant axis is 0; and the lines' direction.
  LatticePoint start(std::uint32_t further = 0) const { return start_of(line_ + static_cast<std::int32_t>(further)); }
  LatticeVector direction() const;
  /// Where the first of them crosses it, or one `further` on, to a step of the lattice.
  LatticePoint point(const Crossing& crossing, std::uint32_t further = 0) const;
  /// From there to where the next line does, in 2^-kDepthBits.
  LatticePoint way(const Crossing& crossing) const;
  /// Rows times polygons that they cut, of all bundles.
  std::uint64_t tests() const { return tests_; }

 private:
  static constexpr std::int32_t kLongest = 1024;  // lines: until then `at` is right to a step
  static constexpr std::int32_t kNear = 2 << kDepthBits;
  static constexpr std::uint32_t kBuckets = 256;

  /// A convex polygon in one plane: a triangle of the geometry, or all triangles of a polygon of the file.
  struct Outline {
    std::uint32_t triangle;  // one with an area
    std::uint32_t first;     // in corners_
    std::uint16_t corners;
    std::uint16_t flat;  // the axis to which it is square, 3: none
  };
  /// Of a polygon, from its lowest corner to its highest: where rows cut it.
  struct Edge {
    std::int32_t y, step;                 // rounded up; from row to row
    std::uint32_t beyond, more, height;   // both are beyond / height and more / height too large
    std::int32_t end;                     // the first row that doesn't cut it
  };
  /// A polygon that the row cuts.
  struct Cut {
    Edge edge[2];
    float over_through;  // -2^(kUnitBits + kDepthBits) over the normal's part along the direction
    std::int32_t step;   // Crossing's
    std::int32_t end;    // the first row that doesn't cut it
    std::int32_t last;   // the line after those that cross it
    std::uint32_t packed;     // twice the outline, + 1: up
    std::uint16_t corner[2];  // where the edges end

    std::uint32_t outline() const { return packed >> 1; }
    bool up() const { return (packed & 1) != 0; }
  };
  struct Beginning {
    std::int32_t line;     // the first
    std::uint32_t number;  // of the cut
  };
  struct Waiting {
    std::int32_t row;
    std::uint32_t next;
  };

  template <class Corner, class Take>
  static void for_outlines(const Geometry& geometry, Corner corner, Take take);
  const LatticePoint& corner(const Outline& outline, std::uint32_t k) const;
  /// Along the direction, in 2^-kUnitBits of a step.
  std::int32_t seen(const LatticePoint& p, int axis, std::int32_t slope) const {
    return component(p, axis) * (1 << kUnitBits) - component(p, axis_) * slope;
  }
  /// The least whole number not below a / b; b above 0.
  static std::int32_t ceiling(std::int32_t a, std::int32_t b) {
    const std::int32_t whole = a / b;
    return whole + (a - whole * b > 0 ? 1 : 0);
  }
  std::int32_t row_from(std::int32_t z) const { return ceiling(z - first_z_, pitch_); }
  void find_waiting();
  void begin(std::uint32_t outline);
  void begin_edge(Cut& cut, std::uint32_t side) const;
  void find_depth(Cut& cut) const;
  std::int64_t through(const Triangle& triangle) const;
  LatticePoint start_of(std::int32_t line) const;
  std::int32_t depth(const Cut& cut) const;
  void step_edges();
  void find_lines();
  void enter(std::uint32_t number);
  bool before(std::uint32_t a, std::uint32_t b, std::int32_t further = 0) const;
  bool exactly_before(const Crossing& a, const Crossing& b, std::int32_t line) const;
  void sort();
  void move_on();
  void find_together();

  const Geometry* geometry_ = nullptr;
  std::span<Outline> outlines_;
  std::span<std::uint32_t> corners_;  // 4 triangle + its corner; around an outline, its front's way
  std::span<Waiting> waiting_;       // per outline: its first row
  std::span<std::uint32_t> bucket_;  // the first outline of so many rows
  std::span<Cut> cuts_;              // each stays where it is
  std::span<Crossing> crossings_;    // of the same numbers
  std::span<Beginning> by_first_;    // of what the row cuts
  std::span<std::uint32_t> order_;   // numbers of what the line crosses
  std::uint32_t cut_ = 0, entered_ = 0, on_line_ = 0;
  std::uint32_t used_ = 0, free_ = kNone;  // places in cuts_; the next free one is in `packed`
  int axis_ = 0, axis_y_ = 1, axis_z_ = 2;
  std::int32_t a_ = 0, b_ = 0;            // of the direction
  std::int32_t spacing_ = 1, pitch_ = 1;  // of lines: steps, and in 2^-kUnitBits
  std::int32_t shift_ = 0;
  std::int32_t first_z_ = 0, first_row_ = 0, row_ = 0, last_row_ = 0, rows_a_bucket_ = 1;
  std::int32_t row_y_ = 0, row_z_ = 0, line_ = 0, together_ = 0;
  std::uint64_t tests_ = 0;
};

}  // namespace shodo
