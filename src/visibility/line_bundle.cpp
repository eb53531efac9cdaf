#include "visibility/line_bundle.h"

#include "base/wide.h"

namespace shodo {

namespace {

constexpr std::uint32_t kGolden = 0x9e3779b9;  // 2^32 / golden ratio

constexpr std::uint64_t block(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

/// The least whole number not below a / b, and how much larger it is, in parts of b; b above 0, and it fits.
std::int32_t ceiling_of(std::int64_t a, std::uint32_t b, std::uint32_t& beyond) {
  std::int64_t whole;
  if (a == static_cast<std::int32_t>(a) && b <= 0x7fffffff) {
    whole = static_cast<std::int32_t>(a) / static_cast<std::int32_t>(b);
  } else {
    whole = a / b;
  }
  std::int64_t rest = whole * b - a;
  if (rest < 0) rest += b, ++whole;
  beyond = static_cast<std::uint32_t>(rest);
  return static_cast<std::int32_t>(whole);
}

/// To the nearest, within 2^30: neighbouring lines may cross a polygon as far apart as the lattice is long.
std::int32_t rounded(double x) {
  constexpr double kMost = 1 << 30;
  if (!(magnitude(x) < kMost)) return x > 0 ? 1 << 30 : -(1 << 30);
  return static_cast<std::int32_t>(x < 0 ? x - 0.5 : x + 0.5);
}

const LatticePoint& corner_of(const Geometry& geometry, std::uint32_t corner) {
  const Triangle& triangle = geometry.triangles[corner >> 2];
  return (corner & 3) == 0 ? triangle.a : (corner & 3) == 1 ? triangle.b : triangle.c;
}
std::uint32_t next_corner(std::uint32_t corner) { return (corner & 3) == 2 ? corner - 2 : corner + 1; }

/// The outline of a polygon of the file: edges of its triangles that only one of them has.
class Boundary {
 public:
  Boundary(const Geometry& geometry, const PolygonTriangles& polygon)
      : geometry_(geometry), first_(4 * polygon.first), end_(4 * (polygon.first + polygon.count)) {}

  /// A triangle that has an area, kNone if none has.
  std::uint32_t triangle() const {
    for (std::uint32_t t = first_ / 4; t < end_ / 4; ++t) {
      if (!(geometry_.triangles[t].n == LatticeVector{})) return t;
    }
    return kNone;
  }
  /// Whether it is convex, in one plane and in one piece; corners may lie on its sides.
  bool simple() const {
    const std::uint32_t t = triangle();
    if (t == kNone || end_ - first_ > 4 * kMostTriangles) return false;
    const Triangle& plane = geometry_.triangles[t];
    std::uint32_t edges = 0, walked = 0;
    for (std::uint32_t k = first_; k < end_; k = after(k)) {
      if (plane.side(corner_of(geometry_, k)) != 0) return false;
      if (outer(k)) ++edges;
    }
    bool convex = true;
    const bool closed = walk([&](std::uint32_t from) {
      ++walked;
      const std::uint32_t then = following(from);
      if (then == kNone) return;
      const LatticePoint &a = corner_of(geometry_, from), &b = corner_of(geometry_, then);
      const LatticeVector turn = cross(b - a, corner_of(geometry_, next_corner(then)) - b);
      const auto agrees = [](std::int64_t x, std::int64_t n) { return x == 0 || (x > 0) == (n > 0); };
      if (turn == LatticeVector{}) {
        convex = convex && dot(b - a, corner_of(geometry_, next_corner(then)) - b) > 0;
      } else {
        convex = convex && agrees(turn.x, plane.n.x) && agrees(turn.y, plane.n.y) && agrees(turn.z, plane.n.z);
      }
    });
    return closed && convex && walked == edges;
  }
  /// take(corner) for each edge's beginning, once around. False: it doesn't close.
  template <class Take>
  bool walk(Take take) const {
    std::uint32_t begin = first_;
    while (begin < end_ && !outer(begin)) begin = after(begin);
    if (begin >= end_) return false;
    std::uint32_t at = begin;
    for (std::uint32_t steps = 0; steps < end_ - first_; ++steps) {
      take(at);
      at = following(at);
      if (at == begin) return true;
      if (at == kNone) return false;
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kMostTriangles = 512;  // each edge is compared with every other

  static std::uint32_t after(std::uint32_t corner) { return (corner & 3) == 2 ? corner + 2 : corner + 1; }
  bool joins(std::uint32_t k, const LatticePoint& from, const LatticePoint& to) const {
    return corner_of(geometry_, k) == from && corner_of(geometry_, next_corner(k)) == to;
  }
  bool outer(std::uint32_t corner) const {
    const LatticePoint &a = corner_of(geometry_, corner), &b = corner_of(geometry_, next_corner(corner));
    if (a == b) return false;
    for (std::uint32_t k = first_; k < end_; k = after(k)) {
      if (joins(k, b, a)) return false;
    }
    return true;
  }
  /// The outer edge that begins where this one ends; kNone if there is none.
  std::uint32_t following(std::uint32_t corner) const {
    const LatticePoint& b = corner_of(geometry_, next_corner(corner));
    for (std::uint32_t k = first_; k < end_; k = after(k)) {
      if (corner_of(geometry_, k) == b && outer(k)) return k;
    }
    return kNone;
  }

  const Geometry& geometry_;
  std::uint32_t first_, end_;  // corners, four numbers a triangle
};

std::uint16_t flat_axis(const LatticeVector& n) {
  if (n.y == 0 && n.z == 0) return 0;
  if (n.x == 0 && n.z == 0) return 1;
  return n.x == 0 && n.y == 0 ? 2 : 3;
}

}  // namespace

/// corner(number) for those of an outline, then take(triangle).
template <class Corner, class Take>
void LineBundle::for_outlines(const Geometry& geometry, Corner corner, Take take) {
  const auto polygon = [&](const PolygonTriangles& triangles) {
    const Boundary boundary(geometry, triangles);
    if (boundary.simple()) {
      boundary.walk(corner);
      take(boundary.triangle());
      return;
    }
    for (std::uint32_t t = triangles.first; t < triangles.first + triangles.count; ++t) {
      if (geometry.triangles[t].n == LatticeVector{}) continue;
      for (std::uint32_t k = 0; k < 3; ++k) corner(4 * t + k);
      take(t);
    }
  };
  for (const PolygonTriangles& cell : geometry.cells) polygon(cell);
  for (const PolygonTriangles& light : geometry.light_triangles) polygon(light);
}

bool LineBundle::take(const Geometry& geometry, Arena& arena, Arena& for_cuts) {
  geometry_ = &geometry;
  std::uint32_t count = 0, corners = 0;
  for_outlines(geometry, [&](std::uint32_t) { ++corners; }, [&](std::uint32_t) { ++count; });
  if (!for_cuts.take("outlines that a row cuts", count, cuts_) || !arena.take("outlines", count, outlines_) ||
      !arena.take("corners of outlines", corners, corners_) || !arena.take("outlines below a row", count, waiting_) ||
      !arena.take("rows of lines", kBuckets, bucket_) || !arena.take("what lines cross", count, crossings_) ||
      !arena.take("order of a row", count, by_first_) || !arena.take("order along a line", count, order_)) {
    return false;
  }
  std::uint32_t first = 0, end = 0;
  count = 0;
  const auto take_corner = [&](std::uint32_t corner) { corners_[end++] = corner; };
  for_outlines(geometry, take_corner, [&](std::uint32_t triangle) {
    outlines_[count++] = {triangle, first, static_cast<std::uint16_t>(end - first),
                          flat_axis(geometry.triangles[triangle].n)};
    first = end;
  });
  return true;
}

LineBundle::Bytes LineBundle::bytes(const Geometry& geometry) {
  static_assert(sizeof(Cut) == 72 && sizeof(Outline) == 12 && sizeof(Waiting) == 8 && sizeof(Crossing) == 20 &&
                sizeof(Beginning) == 8);  // as src/memory_plan.cpp tells
  std::uint64_t count = 0, corners = 0;
  for_outlines(geometry, [&](std::uint32_t) { ++corners; }, [&](std::uint32_t) { ++count; });
  return {block(sizeof(Cut) * count),
          block(sizeof(Outline) * count) + block(4 * corners) + block(sizeof(Waiting) * count) + block(4 * kBuckets) +
              block(sizeof(Crossing) * count) + block(sizeof(Beginning) * count) + block(4 * count),
          static_cast<std::uint32_t>(count)};
}

const LatticePoint& LineBundle::corner(const Outline& outline, std::uint32_t k) const {
  return corner_of(*geometry_, corners_[outline.first + k]);
}

void LineBundle::aim(const Vec3& direction, double spacing, double shift_y, double shift_z) {
  const double way[3] = {direction.x, direction.y, direction.z};
  axis_ = 0;
  for (int k = 1; k < 3; ++k) axis_ = magnitude(way[k]) > magnitude(way[axis_]) ? k : axis_;
  axis_y_ = axis_ == 2 ? 0 : axis_ + 1;
  axis_z_ = axis_y_ == 2 ? 0 : axis_y_ + 1;
  constexpr double kUnit = 1 << kUnitBits;
  a_ = rounded(kUnit * (way[axis_y_] / way[axis_]));
  b_ = rounded(kUnit * (way[axis_z_] / way[axis_]));
  // Lines start on the plane across the dominant axis, of which the direction sees the cosine.
  const double squared = (kUnit * kUnit + static_cast<double>(a_ * a_ + b_ * b_)) / (kUnit * kUnit);
  const double along = spacing * square_root(square_root(squared));
  spacing_ = rounded(along < kLeastSpacing ? kLeastSpacing : along < 2 * kMostSpacing ? along : 2 * kMostSpacing);
  pitch_ = spacing_ << kUnitBits;
  shift_ = rounded(shift_y * spacing_);
  first_z_ = rounded(shift_z * spacing_) << kUnitBits;
  find_waiting();
  row_ = first_row_ - 1;
  cut_ = 0;
  used_ = 0;
  free_ = kNone;
}

/// The first row of every outline that a row cuts.
void LineBundle::find_waiting() {
  first_row_ = INT32_MAX;
  last_row_ = INT32_MIN;
  for (std::uint32_t k = 0; k < outlines_.size(); ++k) {
    std::int32_t low = INT32_MAX, high = INT32_MIN;
    for (std::uint32_t c = 0; c < outlines_[k].corners; ++c) {
      const std::int32_t z = seen(corner(outlines_[k], c), axis_z_, b_);
      low = z < low ? z : low;
      high = z > high ? z : high;
    }
    const std::int32_t row = row_from(low), end = row_from(high);
    waiting_[k].row = row < end ? row : INT32_MAX;
    if (row >= end) continue;
    first_row_ = row < first_row_ ? row : first_row_;
    last_row_ = end > last_row_ ? end : last_row_;
  }
  for (std::uint32_t& first : bucket_) first = kNone;
  if (first_row_ > last_row_) return;
  rows_a_bucket_ = (last_row_ - first_row_) / static_cast<std::int32_t>(kBuckets) + 1;
  for (std::uint32_t k = 0; k < outlines_.size(); ++k) {
    if (waiting_[k].row == INT32_MAX) continue;
    std::uint32_t& first = bucket_[static_cast<std::uint32_t>((waiting_[k].row - first_row_) / rows_a_bucket_)];
    waiting_[k].next = first;
    first = k;
  }
}

std::int64_t LineBundle::through(const Triangle& triangle) const {
  const std::int64_t n[3] = {triangle.n.x, triangle.n.y, triangle.n.z};
  return n[axis_] * (1 << kUnitBits) + n[axis_y_] * a_ + n[axis_z_] * b_;
}

LatticePoint LineBundle::start_of(std::int32_t line) const {
  std::int32_t at[3] = {0, 0, 0};
  at[axis_y_] = row_y_ + line * spacing_;
  at[axis_z_] = row_z_;
  return {at[0], at[1], at[2]};
}

/// Of a polygon square to an axis the normal counts as one step long.
void LineBundle::find_depth(Cut& cut) const {
  const Outline& outline = outlines_[cut.outline()];
  double over, along_y = 0;
  if (outline.flat < 3) {
    over = 1.0 / (outline.flat == axis_ ? 1 << kUnitBits : outline.flat == axis_y_ ? a_ : b_);
    if (outline.flat == axis_y_) along_y = 1;
  } else {
    const Triangle& triangle = geometry_->triangles[outline.triangle];
    over = 1.0 / static_cast<double>(through(triangle));
    const std::int64_t n[3] = {triangle.n.x, triangle.n.y, triangle.n.z};
    along_y = static_cast<double>(n[axis_y_]);
  }
  over *= -static_cast<double>(1 << (kUnitBits + kDepthBits));
  cut.over_through = static_cast<float>(over);
  cut.step = rounded(over * along_y * spacing_);
}

/// Where the line at work meets it.
std::int32_t LineBundle::depth(const Cut& cut) const {
  const Outline& outline = outlines_[cut.outline()];
  const Triangle& triangle = geometry_->triangles[outline.triangle];
  const LatticePoint p = start_of(line_);
  if (outline.flat == 3) return rounded(static_cast<double>(cut.over_through) * static_cast<double>(triangle.side(p)));
  const std::int32_t off = component(p, outline.flat) - component(triangle.a, outline.flat);
  return outline.flat == axis_ ? -off * (1 << kDepthBits) : rounded(static_cast<double>(cut.over_through) * off);
}

void LineBundle::begin(std::uint32_t number) {
  const Outline& outline = outlines_[number];
  const std::int64_t along = through(geometry_->triangles[outline.triangle]);
  if (along == 0) return;
  const std::uint32_t place = free_ == kNone ? used_++ : free_;
  Cut& cut = cuts_[place];
  if (free_ != kNone) free_ = cut.packed;
  by_first_[cut_++].number = place;
  cut.packed = 2 * number + (along > 0 ? 1 : 0);
  crossings_[place].first = true;
  std::uint16_t lowest = 0;
  std::int32_t low = INT32_MAX, high = INT32_MIN;
  for (std::uint16_t k = 0; k < outline.corners; ++k) {
    const std::int32_t z = seen(corner(outline, k), axis_z_, b_);
    if (z < low) low = z, lowest = k;
    if (z > high) high = z;
  }
  cut.end = row_from(high);
  for (std::uint32_t side = 0; side < 2; ++side) {
    cut.corner[side] = lowest;
    begin_edge(cut, side);
  }
  find_depth(cut);
}

/// The next one along its side that the row cuts; there is one.
void LineBundle::begin_edge(Cut& cut, std::uint32_t side) const {
  const Outline& o = outlines_[cut.outline()];
  Edge& edge = cut.edge[side];
  std::uint32_t from = cut.corner[side], to = from;
  std::int32_t top = 0;
  do {
    from = to;
    to = side == 0 ? (to + 1 == o.corners ? 0 : to + 1) : (to == 0 ? o.corners - 1 : to - 1);
    top = seen(corner(o, to), axis_z_, b_);
    edge.end = row_from(top);
  } while (edge.end <= row_);
  cut.corner[side] = static_cast<std::uint16_t>(to);
  const std::int32_t y = seen(corner(o, from), axis_y_, a_), z = seen(corner(o, from), axis_z_, b_);
  const std::int32_t wide = seen(corner(o, to), axis_y_, a_) - y;
  edge.height = static_cast<std::uint32_t>(top - z);
  edge.y = y + ceiling_of(product(first_z_ + row_ * pitch_ - z, wide), edge.height, edge.beyond);
  if (edge.end == row_ + 1) return;
  edge.step = ceiling_of(product(pitch_, wide), edge.height, edge.more);
}

/// To the row at work; those that it doesn't cut go.
void LineBundle::step_edges() {
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < cut_; ++k) {
    const std::uint32_t number = by_first_[k].number;
    Cut& cut = cuts_[number];
    if (cut.end <= row_) {
      cut.packed = free_;
      free_ = number;
      continue;
    }
    by_first_[kept++].number = number;
    for (std::uint32_t side = 0; side < 2; ++side) {
      Edge& edge = cut.edge[side];
      if (edge.end <= row_) {
        begin_edge(cut, side);
        continue;
      }
      edge.y += edge.step;
      edge.beyond += edge.more;
      if (edge.beyond < edge.height) continue;
      edge.beyond -= edge.height;
      --edge.y;
    }
  }
  cut_ = kept;
}

/// Of every polygon that the row cuts; sorted by the first.
void LineBundle::find_lines() {
  const std::int32_t start = row_y_ * (1 << kUnitBits), pitch = pitch_;
  for (std::uint32_t k = 0; k < cut_; ++k) {
    Beginning begins = by_first_[k];
    Cut& cut = cuts_[begins.number];
    const std::int32_t one = ceiling(cut.edge[0].y - start, pitch), other = ceiling(cut.edge[1].y - start, pitch);
    begins.line = one < other ? one : other;
    cut.last = one < other ? other : one;
    std::uint32_t to = k;
    for (; to > 0 && by_first_[to - 1].line > begins.line; --to) by_first_[to] = by_first_[to - 1];
    by_first_[to] = begins;
  }
}

bool LineBundle::next_row() {
  for (++row_; row_ < last_row_; ++row_) {
    step_edges();
    std::uint32_t* next = &bucket_[static_cast<std::uint32_t>((row_ - first_row_) / rows_a_bucket_)];
    while (*next != kNone) {
      const std::uint32_t outline = *next;
      if (waiting_[outline].row == row_) {
        *next = waiting_[outline].next;
        begin(outline);
      } else {
        next = &waiting_[outline].next;
      }
    }
    if (cut_ == 0) continue;
    tests_ += cut_;
    row_z_ = (first_z_ >> kUnitBits) + row_ * spacing_;
    const std::uint32_t part = static_cast<std::uint32_t>(row_) * kGolden;
    row_y_ = shift_ + static_cast<std::int32_t>((std::uint64_t{part} * static_cast<std::uint32_t>(spacing_)) >> 32);
    find_lines();
    entered_ = 0;
    on_line_ = 0;
    together_ = 0;
    return true;
  }
  return false;
}

bool LineBundle::exactly_before(const Crossing& a, const Crossing& b, std::int32_t line) const {
  const LatticePoint p = start_of(line);
  const Triangle &one = geometry_->triangles[a.triangle], &other = geometry_->triangles[b.triangle];
  std::int64_t at_one = -one.side(p), at_other = -other.side(p), along_one = through(one), along_other = through(other);
  if (along_one < 0) at_one = -at_one, along_one = -along_one;
  if (along_other < 0) at_other = -at_other, along_other = -along_other;
  if (less_fraction(at_one, along_one, at_other, along_other)) return true;
  if (less_fraction(at_other, along_other, at_one, along_one)) return false;
  if (a.up != b.up) return b.up;
  return a.up ? a.triangle > b.triangle : a.triangle < b.triangle;
}

/// On a line `further` on than the first.
bool LineBundle::before(std::uint32_t a, std::uint32_t b, std::int32_t further) const {
  const Crossing &one = crossings_[a], &other = crossings_[b];
  const std::int32_t apart = (one.at + further * one.step) - (other.at + further * other.step);
  if (apart > kNear || apart < -kNear) return apart < 0;
  return exactly_before(one, other, line_ + further);
}

void LineBundle::sort() {
  for (std::uint32_t k = 1; k < on_line_; ++k) {
    const std::uint32_t moved = order_[k];
    if (!before(moved, order_[k - 1])) continue;
    std::uint32_t to = k;
    do {
      order_[to] = order_[to - 1];
      --to;
    } while (to > 0 && before(moved, order_[to - 1]));
    order_[to] = moved;
  }
}

/// From the line at work on.
void LineBundle::enter(std::uint32_t number) {
  const Cut& cut = cuts_[number];
  const std::int32_t longest = line_ + kLongest;
  const std::uint32_t triangle = outlines_[cut.outline()].triangle;
  Crossing& crossing = crossings_[number];
  crossing = {depth(cut), cut.step, cut.last < longest ? cut.last : longest, triangle, cut.up(), true, crossing.first};
}

/// To the line after those at work; what it doesn't cross goes.
void LineBundle::move_on() {
  line_ += together_;
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < on_line_; ++k) {
    const std::uint32_t number = order_[k];
    Crossing& crossing = crossings_[number];
    if (crossing.end > line_) {
      crossing.at += together_ * crossing.step;
    } else {
      if (cuts_[number].last <= line_) continue;
      enter(number);
    }
    order_[kept++] = number;
  }
  on_line_ = kept;
}

/// Depths are linear along a row: what is in order on the first and on the last line is on all.
void LineBundle::find_together() {
  std::int32_t end = entered_ < cut_ ? by_first_[entered_].line : INT32_MAX;
  for (std::uint32_t k = 0; k < on_line_; ++k) {
    const std::int32_t here = crossings_[order_[k]].end;
    end = here < end ? here : end;
  }
  together_ = end - line_;
  for (std::uint32_t k = 1; k < on_line_ && together_ > 1;) {
    if (before(order_[k], order_[k - 1], together_ - 1)) {
      together_ = (together_ + 1) / 2;  // those before are in order there, too
    } else {
      ++k;
    }
  }
}

bool LineBundle::next_lines() {
  move_on();
  while (entered_ < cut_) {
    const Beginning& begins = by_first_[entered_];
    if (on_line_ == 0) line_ = begins.line;
    if (begins.line > line_) break;
    if (cuts_[begins.number].last > line_) {
      enter(begins.number);
      order_[on_line_++] = begins.number;
    }
    ++entered_;
  }
  if (on_line_ == 0) return false;
  sort();
  find_together();
  return true;
}

LatticeVector LineBundle::direction() const {
  std::int64_t way[3];
  way[axis_] = 1 << kUnitBits;
  way[axis_y_] = a_;
  way[axis_z_] = b_;
  return {way[0], way[1], way[2]};
}

LatticePoint LineBundle::point(const Crossing& crossing, std::uint32_t further) const {
  const std::int32_t lines = static_cast<std::int32_t>(further), depth = crossing.at + lines * crossing.step;
  const LatticePoint p = start_of(line_ + lines);
  const std::int32_t from[3] = {p.x, p.y, p.z};
  std::int32_t at[3];
  at[axis_] = depth >> kDepthBits;
  at[axis_y_] = from[axis_y_] + static_cast<std::int32_t>(product(depth, a_) >> (kDepthBits + kUnitBits));
  at[axis_z_] = from[axis_z_] + static_cast<std::int32_t>(product(depth, b_) >> (kDepthBits + kUnitBits));
  return {at[0], at[1], at[2]};
}

LatticePoint LineBundle::way(const Crossing& crossing) const {
  std::int32_t way[3];
  way[axis_] = crossing.step;
  way[axis_y_] = (spacing_ << kDepthBits) + static_cast<std::int32_t>(product(crossing.step, a_) >> kUnitBits);
  way[axis_z_] = static_cast<std::int32_t>(product(crossing.step, b_) >> kUnitBits);
  return {way[0], way[1], way[2]};
}

}  // namespace shodo
