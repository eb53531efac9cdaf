// Which triangle every column of a line sees (paper 2.4: hidden surfaces by scanline). Columns are samples, or so much
// narrower (view.h) that spans tell what surfaces cover.
//
// A triangle enters at its first row. Its sides then move from line to line by quotient and remainder (an exact
// Bresenham with a division at the start only), which gives its span [x0, x1) of columns. Spans are swept from left to
// right with the list of those that are open. Inverse depths are linear along the line, and so are their differences:
// whoever wins at both ends of an interval wins all of it. So a span that starts is compared with the nearest one, at
// both ends of what they share; all open spans are compared where the nearest one ends or was found to be overtaken:
// with a guess, the span of the same plane that starts there or the one that was nearest before.
//
// Comparisons use 64-bit fixed point, inverse depth times 2^32, each at most 1 + columns + rows units below the
// truth; where that doesn't decide, 192-bit integers do, and the stated ties (seen_triangle.h). Nothing else is
// approximate, so each column gets exactly the triangle that an exact ray would, and the order of `drawn` matters in
// total ties only.
//
// Bytes: 10 a drawn triangle, 4 a row, 16 + sizeof(ActiveTriangle) a triangle that can be active at once; that number
// is bounded by counting triangles in 128 bands of rows.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/active_triangle.h"

namespace shodo {

/// Columns x0 <= x < x1 of a line see `drawn[triangle]`.
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
  /// The next span of the row, from left to right; false at its end. Columns between spans see nothing.
  bool next(VisibleSpan& span);

  /// With all its values for this row.
  const ActiveTriangle& active(std::uint32_t index) {
    ActiveTriangle& active = pool_[index];
    settle_map(drawn_[map_of_[active.triangle]], grid_, static_cast<std::int32_t>(row_), active);
    return active;
  }
  /// The triangle whose map it takes (map_plane.h).
  std::uint32_t map_of(std::uint32_t triangle) const { return map_of_[triangle]; }
  std::span<const std::uint32_t> carriers() const { return map_of_; }
  std::uint32_t row() const { return row_; }
  /// Times that fixed point did not decide.
  std::uint64_t exact_comparisons() const { return exact_comparisons_; }

 private:
  /// Where a span starts or ends, and its triangle's slot of the pool.
  struct SpanEnd {
    std::int32_t x = 0;
    std::uint32_t slot = 0;
  };

  std::uint32_t link_rows(const Scene& scene);
  void sort_spans();
  void take_starts();
  void challenge(std::uint32_t slot);
  void replace_best();
  void choose_nearest();
  void limit_by_all();
  void limit_by(const SpanEnd& other, const ActiveTriangle& best);
  bool find_lead(const ActiveTriangle& a, const ActiveTriangle& b, std::int32_t x, std::int64_t& lead) const;
  bool nearer(const ActiveTriangle& a, const ActiveTriangle& b, std::int32_t x);
  bool is_nearer_exactly(const ActiveTriangle& a, const ActiveTriangle& b, std::int32_t x);
  std::int32_t overtaken(const ActiveTriangle& by, const ActiveTriangle& best, std::int32_t last);
  std::int32_t next_start() const;
  bool starts_here() const;

  std::span<const DrawnTriangle> drawn_;
  SampleGrid grid_;
  std::span<std::uint32_t> first_of_row_;    // head of the list of triangles that enter at a row; kNone: none
  std::span<std::uint32_t> next_in_row_;     // per drawn triangle
  std::span<std::uint32_t> map_of_;          // per drawn triangle
  std::span<std::uint16_t> last_row_;        // per drawn triangle that enters
  std::span<ActiveTriangle> pool_;
  std::span<SpanEnd> order_;                 // all slots: active_count_ in use, by x0; then the free ones
  std::span<SpanEnd> open_;                  // spans that have started, by their ends; ended ones among them
  std::uint32_t active_count_ = 0;
  std::uint32_t open_count_ = 0;
  std::uint32_t wide_count_ = 0;             // active triangles that fixed point doesn't hold
  std::uint32_t position_ = 0;               // first of order_ that hasn't started
  std::uint32_t row_ = 0;
  std::uint32_t best_ = kNone;               // slot of the nearest open span
  std::uint32_t next_best_ = kNone;          // slot that may be nearest when best_ isn't any more
  std::int32_t x_ = 0;
  std::int32_t until_ = 0;                   // best_ stays the nearest of the open spans for x_ <= x < until_
  std::int64_t tolerance_ = 0;               // of fixed point
  std::uint64_t exact_comparisons_ = 0;
};

}  // namespace shodo
