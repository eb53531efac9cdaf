#include "picture/visible_lines.h"

namespace shodo {

namespace {

constexpr std::uint32_t kBands = 128;

/// The rows of a triangle that can be seen; empty for one that can not, and for the back of an opening.
RowRange visible_rows(const Scene& scene, const DrawnTriangle& triangle, const SampleGrid& grid) {
  SeenTriangle seen;
  if (!see_triangle(triangle, grid.eye, seen)) return {};
  if (triangle.light != kNone && !seen.front && scene.lights[triangle.light].open) return {};
  return rows_of(seen, grid);
}

/// At least as many triangles as are ever active together.
std::uint32_t count_active(const Scene& scene, const Geometry& geometry, const SampleGrid& grid) {
  std::uint32_t count[kBands] = {};
  for (const DrawnTriangle& triangle : geometry.drawn) {
    const RowRange rows = visible_rows(scene, triangle, grid);
    if (rows.empty()) continue;
    const auto band = [&](std::int32_t row) {
      return static_cast<std::uint32_t>(static_cast<std::uint64_t>(row) * kBands / grid.rows);
    };
    for (std::uint32_t b = band(rows.first); b <= band(rows.last); ++b) ++count[b];
  }
  std::uint32_t most = 0;
  for (const std::uint32_t c : count) most = c > most ? c : most;
  return most;
}

constexpr std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

std::uint64_t VisibleLines::bytes(const Scene& scene, const Geometry& geometry, const SampleGrid& grid) {
  const std::uint64_t most = count_active(scene, geometry, grid);
  return rounded_up(4 * std::uint64_t{grid.rows}) + rounded_up(4 * std::uint64_t{geometry.drawn.size()}) +
         most * sizeof(ActiveTriangle) + 2 * rounded_up(4 * most);
}

bool VisibleLines::start(const Scene& scene, const Geometry& geometry, const SampleGrid& grid, Arena& arena) {
  *this = VisibleLines();
  drawn_ = geometry.drawn;
  grid_ = grid;
  tolerance_ = std::int64_t{grid.columns} + grid.rows + 2;
  const std::uint32_t most = count_active(scene, geometry, grid);
  if (!arena.take("rows of the picture", grid.rows, first_of_row_)) return false;
  if (!arena.take("triangles by row", drawn_.size(), next_in_row_)) return false;
  if (!arena.take("active triangles", most, pool_)) return false;
  if (!arena.take("order of spans", most, order_)) return false;
  if (!arena.take("open spans", most, open_)) return false;
  for (std::uint32_t& head : first_of_row_) head = kNone;
  for (std::uint32_t k = 0; k < most; ++k) order_[k] = k;
  for (std::uint32_t t = static_cast<std::uint32_t>(drawn_.size()); t-- > 0;) {
    const RowRange rows = visible_rows(scene, drawn_[t], grid);
    if (rows.empty()) continue;
    std::uint32_t& head = first_of_row_[static_cast<std::uint32_t>(rows.first)];
    next_in_row_[t] = head;
    head = t;
  }
  return true;
}

void VisibleLines::enter(std::uint32_t triangle) {
  ActiveTriangle& active = pool_[order_[active_count_++]];
  activate(drawn_[triangle], triangle, grid_, static_cast<std::int32_t>(row_), active);
}

void VisibleLines::begin_row(std::uint32_t y) {
  row_ = y;
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < active_count_; ++k) {
    const std::uint32_t slot = order_[k];
    if (pool_[slot].last_row < static_cast<std::int32_t>(y)) continue;
    move_to_next_row(pool_[slot]);
    order_[k] = order_[kept];  // keeps order_ a permutation of all slots
    order_[kept++] = slot;
  }
  active_count_ = kept;
  for (std::uint32_t t = first_of_row_[y]; t != kNone; t = next_in_row_[t]) enter(t);
  for (std::uint32_t k = 0; k < active_count_; ++k) {
    ActiveTriangle& active = pool_[order_[k]];
    find_span(drawn_[active.triangle], grid_, static_cast<std::int32_t>(y), active);
  }
  sort_spans();
  open_count_ = 0;
  position_ = 0;
  best_ = kNone;
}

/// By x0. Lines resemble their predecessors, so few exchanges are needed; a heap takes over where they are many.
void VisibleLines::sort_spans() {
  std::uint64_t left = 16 * std::uint64_t{active_count_};
  const auto key = [&](std::uint32_t k) { return pool_[order_[k]].x0; };
  std::uint32_t done = 1;
  for (; done < active_count_ && left > 0; ++done) {
    const std::uint32_t slot = order_[done];
    const std::int32_t x0 = pool_[slot].x0;
    std::uint32_t k = done;
    for (; k > 0 && key(k - 1) > x0; --k) order_[k] = order_[k - 1];
    order_[k] = slot;
    left = left > done - k ? left - (done - k) : 0;
  }
  if (done >= active_count_) return;
  const auto exchange = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t slot = order_[a];
    order_[a] = order_[b];
    order_[b] = slot;
  };
  const auto sift = [&](std::uint32_t k, std::uint32_t size) {
    for (std::uint32_t child = 2 * k + 1; child < size; child = 2 * k + 1) {
      if (child + 1 < size && key(child + 1) > key(child)) ++child;
      if (key(child) <= key(k)) return;
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

/// Whether slot a is nearer than slot b at sample x.
bool VisibleLines::nearer(std::uint32_t a, std::uint32_t b, std::int32_t x) {
  const ActiveTriangle &ta = pool_[a], &tb = pool_[b];
  if (!ta.wide && !tb.wide) {
    const std::int64_t difference = ta.inverse_depth.at(x) - tb.inverse_depth.at(x);
    if (difference > tolerance_) return true;
    if (difference < -tolerance_) return false;
  }
  ++exact_comparisons_;
  return is_nearer(drawn_, grid_.eye, grid_.direction(x, row_), ta.triangle, tb.triangle);
}

/// The first sample after x_, at most `last`, at which slot `by` is nearer than best_; it is nearer at `last`, not at
/// x_.
std::int32_t VisibleLines::overtaken(std::uint32_t by, std::int32_t last) {
  std::int32_t behind = x_;
  while (last - behind > 1) {
    const std::int32_t middle = behind + (last - behind) / 2;
    if (nearer(by, best_, middle)) {
      last = middle;
    } else {
      behind = middle;
    }
  }
  return last;
}

/// best_ is nearest at x_: until_ becomes the first sample at which it ends or another open span is nearer.
void VisibleLines::limit_by_overtaking() {
  until_ = pool_[best_].x1;
  for (std::uint32_t k = 0; k < open_count_; ++k) {
    const std::uint32_t slot = open_[k];
    const std::int32_t end = pool_[slot].x1 < until_ ? pool_[slot].x1 : until_;
    if (slot == best_ || end - 1 <= x_) continue;
    if (nearer(slot, best_, end - 1)) until_ = overtaken(slot, end - 1);
  }
}

/// The nearest of the spans open at x_; ended ones leave the list.
void VisibleLines::choose_nearest() {
  best_ = kNone;
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < open_count_; ++k) {
    const std::uint32_t slot = open_[k];
    if (pool_[slot].x1 <= x_) continue;
    open_[kept++] = slot;
    if (best_ == kNone || nearer(slot, best_, x_)) best_ = slot;
  }
  open_count_ = kept;
  if (best_ != kNone) limit_by_overtaking();
}

/// A span starts at x_.
void VisibleLines::challenge(std::uint32_t slot) {
  open_[open_count_++] = slot;
  if (best_ == kNone) {
    best_ = slot;
    until_ = pool_[slot].x1;
    return;
  }
  if (nearer(slot, best_, x_)) {
    best_ = slot;
    limit_by_overtaking();
    return;
  }
  const std::int32_t end = pool_[slot].x1 < until_ ? pool_[slot].x1 : until_;
  if (end - 1 > x_ && nearer(slot, best_, end - 1)) until_ = overtaken(slot, end - 1);
}

std::int32_t VisibleLines::next_start() const {
  return position_ < active_count_ ? pool_[order_[position_]].x0 : static_cast<std::int32_t>(grid_.columns);
}

void VisibleLines::take_starts() {
  while (next_start() == x_ && x_ < static_cast<std::int32_t>(grid_.columns)) challenge(order_[position_++]);
}

bool VisibleLines::next(VisibleSpan& span) {
  const std::int32_t columns = static_cast<std::int32_t>(grid_.columns);
  if (best_ == kNone) {
    x_ = next_start();
    if (x_ == columns) return false;
    take_starts();
  }
  const std::uint32_t shown = best_;
  span.x0 = x_;
  while (best_ == shown) {
    const std::int32_t start = next_start();
    x_ = start < until_ ? start : until_;
    if (x_ == until_) choose_nearest();
    take_starts();
  }
  span.x1 = x_;
  span.active = shown;
  span.triangle = pool_[shown].triangle;
  span.front = pool_[shown].front;
  return true;
}

}  // namespace shodo
