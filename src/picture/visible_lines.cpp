#include "picture/visible_lines.h"

#include "picture/map_plane.h"

namespace shodo {

namespace {

constexpr std::uint32_t kBands = 128;

/// Glass that the scene at hand leaves out, and panes where effects aren't drawn.
bool left_out(const Scene& scene, const DrawnTriangle& triangle) {
  if (triangle.mesh != kNone) return !scene.effects && scene.transmits(scene.meshes[triangle.mesh].material);
  return scene.glass.empty() && glass_of(scene, triangle) != kNone;
}

/// The rows of a triangle that can be seen; empty for one that can not, and for the back of an opening.
RowRange visible_rows(const Scene& scene, const DrawnTriangle& triangle, const SampleGrid& grid, const Frame& frame) {
  SeenTriangle seen;
  if (left_out(scene, triangle)) return {};
  if (frame.leaves_out(triangle)) return {};
  if (!see_triangle(triangle, grid.eye, seen)) return {};
  if (triangle.light < scene.lights.size() && !seen.front && scene.lights[triangle.light].open) return {};
  return rows_of(seen, grid);
}

/// Triangles that touch each of the bands of rows: at least as many as are ever active together in it.
struct BandCounts {
  std::uint32_t rows = 0;
  std::uint32_t count[kBands] = {};

  void add(const RowRange& range) {
    const auto band = [&](std::int32_t row) {
      return static_cast<std::uint32_t>(static_cast<std::uint64_t>(row) * kBands / rows);
    };
    for (std::uint32_t b = band(range.first); b <= band(range.last); ++b) ++count[b];
  }
  std::uint32_t most() const {
    std::uint32_t most = 0;
    for (const std::uint32_t c : count) most = c > most ? c : most;
    return most;
  }
};

constexpr std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

std::uint64_t VisibleLines::bytes(const Scene& scene, const Geometry& geometry, const SampleGrid& grid) {
  const Frame frame(grid);
  BandCounts bands{grid.rows};
  for (const DrawnTriangle& triangle : geometry.drawn) {
    const RowRange rows = visible_rows(scene, triangle, grid, frame);
    if (!rows.empty()) bands.add(rows);
  }
  const std::uint64_t most = bands.most();
  const std::uint64_t drawn = geometry.drawn.size();
  return rounded_up(4 * std::uint64_t{grid.rows}) + 2 * rounded_up(4 * drawn) + rounded_up(2 * drawn) +
         most * (sizeof(ActiveTriangle) + 2 * sizeof(SpanEnd));
}

/// Lists the triangles by the row at which they enter; returns how many can be active together.
std::uint32_t VisibleLines::link_rows(const Scene& scene) {
  const Frame frame(grid_);
  BandCounts bands{grid_.rows};
  for (std::uint32_t& head : first_of_row_) head = kNone;
  for (std::uint32_t t = static_cast<std::uint32_t>(drawn_.size()); t-- > 0;) {
    const RowRange rows = visible_rows(scene, drawn_[t], grid_, frame);
    if (rows.empty()) continue;
    bands.add(rows);
    std::uint32_t& head = first_of_row_[static_cast<std::uint32_t>(rows.first)];
    next_in_row_[t] = head;
    last_row_[t] = static_cast<std::uint16_t>(rows.last);
    head = t;
  }
  return bands.most();
}

bool VisibleLines::start(const Scene& scene, const Geometry& geometry, const SampleGrid& grid, Arena& arena) {
  *this = VisibleLines();
  drawn_ = geometry.drawn;
  grid_ = grid;
  tolerance_ = std::int64_t{grid.columns} + grid.rows + 2;
  if (!arena.take("rows of the picture", grid.rows, first_of_row_)) return false;
  if (!arena.take("triangles by row", drawn_.size(), next_in_row_)) return false;
  if (!arena.take("last rows of triangles", drawn_.size(), last_row_)) return false;
  if (!arena.take("carriers of maps", drawn_.size(), map_of_)) return false;
  find_map_planes(drawn_, map_of_);
  const std::uint32_t most = link_rows(scene);
  if (!arena.take("active triangles", most, pool_)) return false;
  if (!arena.take("order of spans", most, order_)) return false;
  if (!arena.take("open spans", most, open_)) return false;
  for (std::uint32_t k = 0; k < most; ++k) order_[k].slot = k;
  return true;
}

void VisibleLines::begin_row(std::uint32_t y) {
  row_ = y;
  const std::int32_t row = static_cast<std::int32_t>(y);
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < active_count_; ++k) {
    const std::uint32_t slot = order_[k].slot;
    ActiveTriangle& active = pool_[slot];
    if (active.last_row < row) {
      wide_count_ -= active.wide ? 1 : 0;
      continue;
    }
    move_to_row(drawn_[active.triangle], grid_, row, active);
    order_[k].slot = order_[kept].slot;  // keeps order_ a permutation of all slots
    order_[kept++] = {active.x0, slot};
  }
  active_count_ = kept;
  for (std::uint32_t t = first_of_row_[y]; t != kNone; t = next_in_row_[t]) {
    SpanEnd& start = order_[active_count_++];
    ActiveTriangle& active = pool_[start.slot];
    activate(drawn_[t], t, grid_, row, last_row_[t], active);
    wide_count_ += active.wide ? 1 : 0;
    start.x = active.x0;
  }
  sort_spans();
  open_count_ = 0;
  position_ = 0;
  best_ = kNone;
}

/// By x0. Lines resemble their predecessors, so few exchanges are needed; a heap takes over where they are many.
void VisibleLines::sort_spans() {
  const std::span<SpanEnd> order = order_.first(active_count_);
  std::uint64_t left = 16 * std::uint64_t{active_count_};
  std::uint32_t done = 1;
  for (; done < active_count_ && left > 0; ++done) {
    const SpanEnd start = order[done];
    if (order[done - 1].x <= start.x) continue;
    std::uint32_t k = done;
    for (; k > 0 && order[k - 1].x > start.x; --k) order[k] = order[k - 1];
    order[k] = start;
    left = left > done - k ? left - (done - k) : 0;
  }
  if (done >= active_count_) return;
  const auto exchange = [&](std::uint32_t a, std::uint32_t b) {
    const SpanEnd start = order[a];
    order[a] = order[b];
    order[b] = start;
  };
  const auto sift = [&](std::uint32_t k, std::uint32_t size) {
    for (std::uint32_t child = 2 * k + 1; child < size; child = 2 * k + 1) {
      if (child + 1 < size && order[child + 1].x > order[child].x) ++child;
      if (order[child].x <= order[k].x) return;
      exchange(k, child);
      k = child;
    }
  };
  for (std::uint32_t k = active_count_ / 2; k-- > 0;) sift(k, active_count_);
  for (std::uint32_t size = active_count_; size-- > 1;) {
    exchange(0, size);
    sift(0, size);
  }
}

bool VisibleLines::is_nearer_exactly(const ActiveTriangle& a, const ActiveTriangle& b, std::int32_t x) {
  ++exact_comparisons_;
  return is_nearer(drawn_, grid_.eye, grid_.direction(x, row_), a.triangle, b.triangle);
}

/// How far a is nearer than b at sample x, in fixed point; false if that doesn't decide.
inline bool VisibleLines::find_lead(const ActiveTriangle& a, const ActiveTriangle& b, std::int32_t x,
                                    std::int64_t& lead) const {
  if (wide_count_ != 0 && (a.wide || b.wide)) return false;
  lead = a.inverse_depth.c - b.inverse_depth.c + times(a.inverse_depth.cx - b.inverse_depth.cx, x);
  const std::int32_t high = static_cast<std::int32_t>(lead >> 32);  // the tolerance has 32 bits
  return high > 0 || high < -1 || lead > tolerance_ || lead < -tolerance_;
}

/// Whether a, behind b at a sample, is behind it at all later ones.
inline bool falls_back(const ActiveTriangle& a, const ActiveTriangle& b) {
  return a.inverse_depth.cx <= b.inverse_depth.cx;
}

/// Whether a is nearer than b at sample x.
inline bool VisibleLines::nearer(const ActiveTriangle& a, const ActiveTriangle& b, std::int32_t x) {
  std::int64_t lead = 0;
  return find_lead(a, b, x, lead) ? lead > 0 : is_nearer_exactly(a, b, x);
}

/// The first sample after x_, at most `last`, at which `by` is nearer than `best`; it is nearer at `last`, not at x_.
std::int32_t VisibleLines::overtaken(const ActiveTriangle& by, const ActiveTriangle& best, std::int32_t last) {
  std::int32_t behind = x_;
  while (last - behind > 1) {
    const std::int32_t middle = behind + (last - behind) / 2;
    if (nearer(by, best, middle)) {
      last = middle;
    } else {
      behind = middle;
    }
  }
  return last;
}

/// `other` is open and isn't nearer than best_ at x_: until_ becomes at most the first sample at which it is.
inline void VisibleLines::limit_by(const SpanEnd& other, const ActiveTriangle& best) {
  const std::int32_t last = (other.x < until_ ? other.x : until_) - 1;
  if (last <= x_) return;
  const ActiveTriangle& by = pool_[other.slot];
  if (!nearer(by, best, last)) return;
  until_ = overtaken(by, best, last);
  next_best_ = other.slot;
}

/// best_ is nearest at x_: until_ becomes the first sample at which it ends or another open span is nearer.
void VisibleLines::limit_by_all() {
  const ActiveTriangle& best = pool_[best_];
  until_ = best.x1;
  for (const SpanEnd& other : open_.first(open_count_)) {
    if (other.slot != best_) limit_by(other, best);
  }
}

/// The nearest of the spans open at x_, of which best_ is a guess that mostly holds.
void VisibleLines::choose_nearest() {
  const std::uint32_t guess = best_;
  until_ = pool_[best_].x1;
  for (const SpanEnd& other : open_.first(open_count_)) {
    if (other.slot == guess) continue;
    const ActiveTriangle &best = pool_[best_], &by = pool_[other.slot];
    std::int64_t lead = 0;
    const bool sure = find_lead(by, best, x_, lead);
    if (sure ? lead > 0 : is_nearer_exactly(by, best, x_)) {
      best_ = other.slot;
    } else if (best_ == guess && !(sure && falls_back(by, best))) {
      limit_by(other, best);
    }
  }
  if (best_ != guess) limit_by_all();
}

/// best_ ends at x_, or another span is nearer from here on.
void VisibleLines::replace_best() {
  const std::uint32_t carrier = map_of_[pool_[best_].triangle];
  std::uint32_t guess = kNone, kept = 0;
  for (std::uint32_t k = 0; k < open_count_; ++k) {
    const SpanEnd end = open_[k];
    if (end.x <= x_) continue;
    open_[kept++] = end;
    if (guess == kNone || end.slot == next_best_) guess = end.slot;
  }
  open_count_ = kept;
  for (; starts_here(); ++position_) {
    const std::uint32_t slot = order_[position_].slot;
    const ActiveTriangle& starts = pool_[slot];
    if (starts.x1 <= x_) continue;
    open_[open_count_++] = {starts.x1, slot};
    if (guess == kNone || map_of_[starts.triangle] == carrier) guess = slot;
  }
  best_ = guess;
  if (best_ != kNone) choose_nearest();
}

/// A span starts at x_.
void VisibleLines::challenge(std::uint32_t slot) {
  const ActiveTriangle& starts = pool_[slot];
  const SpanEnd end{starts.x1, slot};
  open_[open_count_++] = end;
  if (best_ == kNone) {
    best_ = slot;
    until_ = starts.x1;
    return;
  }
  const ActiveTriangle& best = pool_[best_];
  std::int64_t lead = 0;
  const bool sure = find_lead(starts, best, x_, lead);
  if (sure ? lead > 0 : is_nearer_exactly(starts, best, x_)) {
    next_best_ = best_;
    best_ = slot;
    limit_by_all();
  } else if (!(sure && falls_back(starts, best))) {
    limit_by(end, best);
  }
}

std::int32_t VisibleLines::next_start() const {
  return position_ < active_count_ ? order_[position_].x : static_cast<std::int32_t>(grid_.columns);
}

bool VisibleLines::starts_here() const {
  return position_ < active_count_ && order_[position_].x == x_ && x_ < static_cast<std::int32_t>(grid_.columns);
}

void VisibleLines::take_starts() {
  for (; starts_here(); ++position_) {
    const std::uint32_t slot = order_[position_].slot;
    if (pool_[slot].x1 > x_) challenge(slot);
  }
}

bool VisibleLines::next(VisibleSpan& span) {
  const std::int32_t columns = static_cast<std::int32_t>(grid_.columns);
  while (best_ == kNone) {
    x_ = next_start();
    if (x_ == columns) return false;
    take_starts();
  }
  const std::uint32_t shown = best_;
  span.x0 = x_;
  while (best_ == shown) {
    const std::int32_t start = next_start();
    x_ = start < until_ ? start : until_;
    if (x_ == until_) {
      replace_best();
    } else {
      take_starts();
    }
  }
  span.x1 = x_;
  span.active = shown;
  span.triangle = pool_[shown].triangle;
  span.front = pool_[shown].front;
  return true;
}

}  // namespace shodo
