// Which triangle every sample of a line sees (paper 2.4: hidden surfaces by scanline).
//
// A triangle enters at its first row. Its sides then move from line to line by quotient and remainder (an exact
// Bresenham with a division at the start only), which gives its span [x0, x1) of samples. Spans are swept from left to
// right with the list of those that are open. Inverse depths are linear along the line, and so are their differences:
// whoever wins at both ends of an interval wins all of it. So a span that starts is compared with the nearest one, at
// both ends of what they share; all open spans are compared where the nearest one ends or was found to be overtaken.
//
// Comparisons use 64-bit fixed point, inverse depth times 2^32, each at most 1 + columns + rows units below the
// truth; where that doesn't decide, 192-bit integers do, and the stated ties (seen_triangle.h). Nothing else is
// approximate, so each sample gets exactly the triangle that an exact ray would, and the order of `drawn` matters in
// total ties only.
//
// Bytes: 4 a drawn triangle, 4 a row, 8 + sizeof(ActiveTriangle) a triangle that can be active at once; that number
// is bounded by counting triangles in 128 bands of rows.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/active_triangle.h"

namespace shodo {

/// Samples x0 <= x < x1 of a line see `drawn[triangle]`.
struct VisibleSpan {
  std::int32_t x0 = 0, x1 = 0;
  std::uint32_t triangle = 0;
  std::uint32_t active = 0;  // index for VisibleLines::active
  bool front = false;
};

class VisibleLines {
 public:
  /// Scratch stays in the arena; `drawn` must outlive this. False if it doesn't fit.
  [[nodiscard]] bool start(const Scene& scene, const Geometry& geometry, const SampleGrid& grid, Arena& arena);
  /// What start() takes.
  static std::uint64_t bytes(const Scene& scene, const Geometry& geometry, const SampleGrid& grid);

  /// Rows in order, from 0.
  void begin_row(std::uint32_t y);
  /// The next span of the row, from left to right; false at its end. Samples between spans see nothing.
  bool next(VisibleSpan& span);

  const ActiveTriangle& active(std::uint32_t index) const { return pool_[index]; }
  std::uint32_t row() const { return row_; }
  /// Times that fixed point did not decide.
  std::uint64_t exact_comparisons() const { return exact_comparisons_; }

 private:
  void enter(std::uint32_t triangle);
  void sort_spans();
  void take_starts();
  void challenge(std::uint32_t slot);
  void choose_nearest();
  void limit_by_overtaking();
  bool nearer(std::uint32_t a, std::uint32_t b, std::int32_t x);
  std::int32_t overtaken(std::uint32_t by, std::int32_t last);
  std::int32_t next_start() const;

  std::span<const DrawnTriangle> drawn_;
  SampleGrid grid_;
  std::span<std::uint32_t> first_of_row_;    // head of the list of triangles that enter at a row; kNone: none
  std::span<std::uint32_t> next_in_row_;     // per drawn triangle
  std::span<ActiveTriangle> pool_;
  std::span<std::uint32_t> order_;           // slots of the pool: active_count_ in use, by x0; then the free ones
  std::span<std::uint32_t> open_;            // slots of spans that have started, the ended ones among them
  std::uint32_t active_count_ = 0;
  std::uint32_t open_count_ = 0;
  std::uint32_t position_ = 0;               // first of order_ that hasn't started
  std::uint32_t row_ = 0;
  std::uint32_t best_ = kNone;               // slot of the nearest open span
  std::int32_t x_ = 0;
  std::int32_t until_ = 0;                   // best_ stays the nearest of the open spans for x_ <= x < until_
  std::int64_t tolerance_ = 0;               // of fixed point
  std::uint64_t exact_comparisons_ = 0;
};

}  // namespace shodo
