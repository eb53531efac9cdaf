#include "visibility/shadow.h"

#include "base/bits.h"
#include "visibility/rounded_normal.h"
#include "visibility/triangle_test.h"

namespace shodo {

namespace {

/// Over a box.
struct Extent {
  std::int64_t least, most;
};

/// The box of the ends as seen from the point: differences of coordinates.
struct Ways {
  std::int32_t low[3], high[3];
};

Ways ways_of(const Segments& segments) {
  const LatticePoint& p = segments.from;
  const LatticeBox& box = segments.box;
  return {{box.low[0] - p.x, box.low[1] - p.y, box.low[2] - p.z},
          {box.high[0] - p.x, box.high[1] - p.y, box.high[2] - p.z}};
}

LatticePoint way(const LatticePoint& p, const LatticePoint& q) { return {q.x - p.x, q.y - p.y, q.z - p.z}; }

std::int64_t along(const LatticeVector& m, const LatticePoint& d) { return m.x * d.x + m.y * d.y + m.z * d.z; }

void add(std::int32_t m, std::int32_t low, std::int32_t high, Extent& extent) {
  if (m == 0) return;
  const std::int64_t a = product(m, low), b = low == high ? a : product(m, high);
  extent.least += m > 0 ? a : b;
  extent.most += m > 0 ? b : a;
}

/// Of m . d.
Extent extent_of(const RoundedNormal& m, const Ways& ways) {
  Extent extent{0, 0};
  add(m.x, ways.low[0], ways.high[0], extent);
  add(m.y, ways.low[1], ways.high[1], extent);
  add(m.z, ways.low[2], ways.high[2], extent);
  return extent;
}

/// m . d >= limit, for which rounded numbers do but near it.
struct Condition {
  RoundedNormal rough;
  std::int64_t never, sure;
  LatticeVector m;
  std::int64_t limit;

  bool holds(const LatticePoint& d) const {
    const std::int64_t value = rough.along(d);
    return value >= sure || (value >= never && along(m, d) >= limit);
  }
};

/// Of all ends at once: conditions that hold for some of them, or nobody knows yet.
struct Conditions {
  Condition open[5];
  std::uint32_t count = 0;

  /// False if it surely holds for none.
  bool add(const LatticeVector& m, std::int64_t limit, const Ways& ways) {
    const RoundedNormal rough(m);
    const Extent extent = extent_of(rough, ways);
    const std::int64_t low = limit >> RoundedNormal::kBits;
    if (extent.most < low - RoundedNormal::kDoubt) return false;
    if (extent.least > low + RoundedNormal::kDoubt) return true;
    Condition& condition = open[count++];
    condition.rough = rough;
    condition.never = low - RoundedNormal::kDoubt;
    condition.sure = low + RoundedNormal::kDoubt + 1;
    condition.m = m;
    condition.limit = limit;
    return true;
  }
  bool hold(const LatticePoint& d) const {
    std::uint32_t e = 0;
    while (e < count && open[e].holds(d)) ++e;
    return e == count;
  }
};

/// a x b, both within the cube's size.
LatticeVector small_cross(const LatticePoint& a, const LatticePoint& b) {
  return {product(a.y, b.z) - product(a.z, b.y), product(a.z, b.x) - product(a.x, b.z),
          product(a.x, b.y) - product(a.y, b.x)};
}

std::int32_t at(const LatticePoint& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// One side of a rectangle square to axis a, seen from the point: an end is on its inner side if
/// reach w >= part d (or <=, of the upper side), d its way along the side's normal and w that along a.
struct Side {
  std::int32_t reach;
  bool upper;

  bool holds(std::int32_t w, std::int64_t run) const {
    const std::int64_t limit = product(reach, w);
    return upper ? run <= limit : run >= limit;
  }
};

}  // namespace

namespace {

LatticeVector operator-(const LatticeVector& a, const LatticeVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

/// Of a triangle, or of a parallelogram whose first half it is: d is then the fourth corner.
std::uint32_t shadow_of(const Triangle& triangle, const LatticePoint* fourth, const Segments& segments,
                        std::uint32_t wanted) {
  const LatticePoint& p = segments.from;
  const std::int64_t here = triangle.side(p);
  if (here == 0) return 0;
  const Ways ways = ways_of(segments);
  // Everything with the sign that makes N.d positive where the plane is passed.
  const std::int64_t sign = here > 0 ? -1 : 1;
  const LatticeVector n{sign * triangle.n.x, sign * triangle.n.y, sign * triangle.n.z};
  Conditions conditions;
  if (!conditions.add(n, 1 - sign * here, ways)) return 0;
  const LatticePoint a = way(p, triangle.a), b = way(p, triangle.b), c = way(p, triangle.c);
  const auto edge = [&](const LatticePoint& from, const LatticePoint& to) {
    return sign > 0 ? small_cross(from, to) : small_cross(to, from);
  };
  const LatticeVector ab = edge(a, b);
  if (!conditions.add(ab, 0, ways)) return 0;
  const LatticeVector bc = edge(b, c);
  if (!conditions.add(bc, 0, ways)) return 0;
  // The edges' determinants add up to N.d, of a parallelogram to twice that.
  LatticeVector rest = n - ab - bc;
  if (fourth != nullptr) {
    const LatticeVector cd = edge(c, way(p, *fourth));
    if (!conditions.add(cd, 0, ways)) return 0;
    rest = rest - (cd - n);
  }
  if (!conditions.add(rest, 0, ways)) return 0;
  if (conditions.count == 0) return wanted;
  std::uint32_t shadow = 0;
  for_each_bit(wanted, [&](std::uint32_t k, std::uint32_t bit) {
    if (conditions.hold(way(p, segments.ends[k]))) shadow |= bit;
  });
  return shadow;
}

}  // namespace

std::uint32_t shadow_of(const Triangle& triangle, const Segments& segments, std::uint32_t wanted) {
  return shadow_of(triangle, nullptr, segments, wanted);
}

namespace {

/// Of the part of the plane square to an axis that the facet's box is.
std::uint32_t shadow_of_rectangle(const LatticeBox& box, const Segments& segments, std::uint32_t wanted) {
  const LatticePoint& p = segments.from;
  const int axis = box.low[0] > box.high[0] ? 0 : box.low[1] > box.high[1] ? 1 : 2;
  const std::int32_t plane = box.low[axis] - 1, here = at(p, axis);
  // Ways along the axis, positive towards the plane; an end beyond it has w > part.
  const bool up = plane > here;
  const std::int32_t part = up ? plane - here : here - plane;
  std::int32_t w_low = up ? segments.box.low[axis] - here : here - segments.box.high[axis];
  const std::int32_t w_high = up ? segments.box.high[axis] - here : here - segments.box.low[axis];
  if (part == 0 || w_high <= part) return 0;
  bool all_beyond = w_low > part;
  if (!all_beyond) w_low = part;
  Side open[4];
  int of_axis[4], count = 0;
  for (int u = 0; u < 3; ++u) {
    if (u == axis) continue;
    const std::int32_t from = at(p, u);
    const std::int64_t run_low = product(part, segments.box.low[u] - from);
    const std::int64_t run_high = product(part, segments.box.high[u] - from);
    for (const bool upper : {false, true}) {
      const Side side{(upper ? box.high[u] : box.low[u]) - from, upper};
      // The limit, reach w, is easiest met at one end of w, hardest at the other.
      const bool grows = (side.reach > 0) == upper;
      if (!side.holds(grows ? w_high : w_low, upper ? run_low : run_high)) return 0;
      if (side.holds(grows ? w_low : w_high, upper ? run_high : run_low)) continue;
      of_axis[count] = u;
      open[count++] = side;
    }
  }
  if (count == 0 && all_beyond) return wanted;
  std::uint32_t shadow = 0;
  for_each_bit(wanted, [&](std::uint32_t k, std::uint32_t bit) {
    const LatticePoint& q = segments.ends[k];
    const std::int32_t w = up ? at(q, axis) - here : here - at(q, axis);
    if (w <= part) return;
    int e = 0;
    while (e < count && open[e].holds(w, product(part, at(q, of_axis[e]) - at(p, of_axis[e])))) ++e;
    if (e == count) shadow |= bit;
  });
  return shadow;
}

/// So few ends are sooner asked one by one.
bool are_few(std::uint32_t ends) {
  ends &= ends - 1;
  ends &= ends - 1;
  return (ends & (ends - 1)) == 0;
}

/// shadow_of_rectangle() end by end.
class Rectangle {
 public:
  Rectangle(const LatticeBox& box, const LatticePoint& p) : p_(p) {
    axis_ = box.low[0] > box.high[0] ? 0 : box.low[1] > box.high[1] ? 1 : 2;
    side_[0] = axis_ == 0 ? 1 : 0;
    side_[1] = axis_ == 2 ? 1 : 2;
    part_ = box.low[axis_] - 1 - at(p, axis_);
    for (int k = 0; k < 2; ++k) {
      low_[k] = box.low[side_[k]] - at(p, side_[k]);
      high_[k] = box.high[side_[k]] - at(p, side_[k]);
    }
  }
  bool hides(const LatticePoint& q) const {
    const std::int32_t way[3] = {q.x - p_.x, q.y - p_.y, q.z - p_.z}, whole = way[axis_];
    if (part_ > 0 ? whole <= part_ : part_ == 0 || whole >= part_) return false;
    for (int k = 0; k < 2; ++k) {
      const std::int64_t run = product(part_, way[side_[k]]);
      const std::int64_t low = product(low_[k], whole);
      if (part_ > 0 ? run < low : run > low) return false;
      const std::int64_t high = product(high_[k], whole);
      if (part_ > 0 ? run > high : run < high) return false;
    }
    return true;
  }

 private:
  LatticePoint p_;
  int axis_, side_[2];
  std::int32_t part_, low_[2], high_[2];
};

}  // namespace

std::uint32_t shadow_of(const Facet& facet, std::span<const Triangle> triangles, const Segments& segments,
                        std::uint32_t wanted) {
  const LatticePoint& p = segments.from;
  std::uint32_t shadow = 0;
  if (are_few(wanted)) {
    if (facet.tilted == 0) {
      const Rectangle rectangle(facet.box, p);
      for_each_bit(wanted, [&](std::uint32_t k, std::uint32_t bit) {
        if (rectangle.hides(segments.ends[k])) shadow |= bit;
      });
      if (facet.rectangle != 0) return shadow;
      wanted = shadow;
      shadow = 0;
    }
    for (const Triangle& triangle : triangles) {
      if (wanted == shadow) break;
      const std::int64_t here = triangle.side(p);
      if (here == 0) continue;
      for_each_bit(wanted & ~shadow, [&](std::uint32_t k, std::uint32_t bit) {
        const LatticePoint& q = segments.ends[k];
        const std::int64_t there = triangle.side(q);
        if (here > 0 ? there >= 0 : there <= 0) return;
        if (line_meets(triangle, p, q - p, there - here)) shadow |= bit;
      });
    }
    return shadow;
  }
  if (facet.tilted == 0) {
    wanted = shadow_of_rectangle(facet.box, segments, wanted);
    if (facet.rectangle != 0) return wanted;
  }
  if (facet.tilted == 2) return shadow_of(triangles[0], &triangles[1].b, segments, wanted);
  for (const Triangle& triangle : triangles) {
    if (shadow == wanted) break;
    shadow |= shadow_of(triangle, segments, wanted & ~shadow);
  }
  return shadow;
}

}  // namespace shodo
