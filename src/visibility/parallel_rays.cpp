#include "visibility/parallel_rays.h"

#include <bit>

#include "base/wide.h"
#include "visibility/triangle_test.h"

namespace shodo {

namespace {

constexpr int kPartBits = 22;  // of the direction, whose components are within 2^20

/// The floor of 2^22 a / b for 0 <= a <= b < 2^31, by divisions of 32 bits.
std::uint32_t part_of(std::int32_t numerator, std::int32_t denominator) {
  std::uint32_t a = static_cast<std::uint32_t>(numerator);
  const std::uint32_t b = static_cast<std::uint32_t>(denominator);
  const int room = std::countl_zero(b);  // so many bits a remainder may be moved
  std::uint32_t part = 0;
  for (int left = kPartBits; left > 0;) {
    const int bits = room < left ? room : left;
    const std::uint32_t more = a << bits;
    part = (part << bits) + more / b;
    a = more % b;
    left -= bits;
  }
  return part;
}

/// The same of 64 bits, from their first 31.
std::uint32_t part_of(std::int64_t a, std::int64_t b) {
  const int width = 64 - std::countl_zero(static_cast<std::uint64_t>(b));
  const int right = width > 31 ? width - 31 : 0;
  return part_of(static_cast<std::int32_t>(a >> right), static_cast<std::int32_t>(b >> right));
}

/// The axis to which a triangle is square, 3: none.
int axis_of(const Triangle& triangle) {
  const LatticeVector& n = triangle.n;
  if (n.y == 0 && n.z == 0) return 0;
  if (n.x == 0 && n.z == 0) return 1;
  return n.x == 0 && n.y == 0 ? 2 : 3;
}

std::int32_t component(const LatticePoint& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
bool faces_up(const Triangle& triangle) { return triangle.n.x > 0 || triangle.n.y > 0 || triangle.n.z > 0; }

/// low <= part / whole way <= high; whole above 0.
bool passes_between(std::int32_t low, std::int32_t high, std::int32_t part, std::int32_t way, std::int32_t whole) {
  const std::int64_t run = product(part, way);
  return run >= product(low, whole) && run <= product(high, whole);
}

/// Whether |far / fast| is above part / whole, judged by their upper halves.
bool surely_after(std::int64_t far, std::int64_t fast, std::int32_t part, std::int32_t whole) {
  const auto upper = [](std::int64_t x) { return static_cast<std::int32_t>((x < 0 ? -x : x) >> 32); };
  return product(upper(far), whole) > product(upper(fast) + 1, part);
}

}  // namespace

/// The nearest facets so far, of those square to an axis and of the others, at part / whole of the direction.
struct ParallelRays::Nearest {
  std::uint32_t flat = kNone, tilted = kNone;  // triangles
  bool flat_front = false, tilted_front = false;
  std::int32_t part = 1, whole = 0;
  std::int64_t far = 1, fast = 0;
};

ParallelRays::ParallelRays(const Geometry& geometry, Intersector& intersector)
    : geometry_(geometry), intersector_(intersector) {
  if (intersector.facets().empty()) around_.include(LatticePoint{});
  for (const Facet& facet : intersector.facets()) around_.include(facet.box);
  for (int k = 0; k < 3; ++k) {  // flat ones are thinner than flat
    --around_.low[k];
    ++around_.high[k];
  }
}

/// How much of the direction, in parts of a Sweep and at least, takes all of the box beyond the last facet: there is
/// nothing to list there.
std::int32_t ParallelRays::way_out(const LatticeBox& from) const {
  std::uint32_t least = 1 << Sweep::kPartBits;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t way = component(way_, k), size = way < 0 ? -way : way;
    const std::int32_t out = way > 0 ? around_.high[k] - from.low[k] : from.high[k] - around_.low[k];
    if (size == 0 || out < 0) continue;
    const std::uint32_t part =
        (static_cast<std::uint32_t>(out) << Sweep::kPartBits) / static_cast<std::uint32_t>(size) + 1;
    least = part < least ? part : least;
  }
  return static_cast<std::int32_t>(least);
}

void ParallelRays::aim(const LatticeBox& from, const LatticeVector& direction) {
  listed_ = {};
  direction_ = direction;
  way_ = {static_cast<std::int32_t>(direction.x), static_cast<std::int32_t>(direction.y),
          static_cast<std::int32_t>(direction.z)};
  if (!intersector_.seeking()) return;
  const auto size = [&](int k) { return coarse_[k] < 0 ? -coarse_[k] : coarse_[k]; };
  for (int k = 0; k < 3; ++k) coarse_[k] = component(way_, k) >> ShaftLine::kSteps;
  for (int k = 0; k < 3; ++k) doubt_[k] = 2 * (size(k) + size(k == 2 ? 0 : k + 1)) + (4 << (20 - ShaftLine::kSteps));
  listed_ = intersector_.gather_in(Sweep(from, way_, way_out(from)), flat_);
}

/// Whether a ray surely misses a box: of a linear form square to the direction the box has other values.
bool ParallelRays::passes_by(const LatticeBox& box, const LatticePoint& from) const {
  for (int u = 0; u < 3; ++u) {
    const int v = u == 2 ? 0 : u + 1;
    const std::int32_t a = coarse_[u], b = coarse_[v];
    const auto off = [&](std::int32_t bound, int axis) {
      return (bound >> ShaftLine::kSteps) - (component(from, axis) >> ShaftLine::kSteps);
    };
    const std::int32_t low_u = off(box.low[u], u), high_u = off(box.high[u], u);
    const std::int32_t low_v = off(box.low[v], v), high_v = off(box.high[v], v);
    if ((a > 0 ? a * high_v : a * low_v) - (b > 0 ? b * low_u : b * high_u) < -doubt_[u]) return true;
    if ((a > 0 ? a * low_v : a * high_v) - (b > 0 ? b * high_u : b * low_u) > doubt_[u]) return true;
  }
  return false;
}

void ParallelRays::offer_flat(const Facet& facet, const LatticePoint& from, Nearest& best) const {
  const LatticeBox& box = facet.box;
  const int axis = box.low[0] > box.high[0] ? 0 : box.low[1] > box.high[1] ? 1 : 2;
  std::int32_t part = box.low[axis] - 1 - component(from, axis), whole = component(way_, axis);
  const bool up = part > 0;
  if (!up) part = -part, whole = -whole;
  if (whole <= 0) return;
  const std::int64_t nearer = product(best.part, whole) - product(part, best.whole);
  if (nearer < 0) return;
  if (axis != 0 && !passes_between(box.low[0] - from.x, box.high[0] - from.x, part, way_.x, whole)) return;
  if (axis != 1 && !passes_between(box.low[1] - from.y, box.high[1] - from.y, part, way_.y, whole)) return;
  if (axis != 2 && !passes_between(box.low[2] - from.z, box.high[2] - from.z, part, way_.z, whole)) return;
  std::uint32_t t = facet.first;
  if (facet.rectangle == 0) {
    const std::uint32_t end = t + facet.count;
    while (t < end && !blocks_ray(geometry_.triangles[t], from, direction_)) ++t;
    if (t == end) return;
  } else {
    while (geometry_.triangles[t].n == LatticeVector{}) ++t;
  }
  const bool front = faces_up(geometry_.triangles[t]) != up;
  if (nearer == 0 && (front != best.flat_front ? best.flat_front : best.flat < t)) return;
  best.flat = t;
  best.flat_front = front;
  best.part = part;
  best.whole = whole;
}

void ParallelRays::offer_tilted(const Facet& facet, const LatticePoint& from, Nearest& best) const {
  std::int64_t side = 0, through = 0;
  for (std::uint32_t t = facet.first; t < facet.first + facet.count; ++t) {
    const Triangle& triangle = geometry_.triangles[t];
    if (facet.tilted == 1 || t == facet.first) {  // else both are in one plane
      side = triangle.side(from);
      through = dot(triangle.n, direction_);
    }
    if (side >= 0 ? (side == 0 || through >= 0) : through <= 0) continue;
    if (best.flat != kNone && surely_after(side, through, best.part, best.whole)) continue;
    if (!line_meets(triangle, from, direction_, through)) continue;
    const bool front = side > 0;
    const std::int64_t far = front ? side : -side, fast = front ? -through : through;
    if (best.tilted != kNone && !less_fraction(far, fast, best.far, best.fast)) {
      if (less_fraction(best.far, best.fast, far, fast)) continue;
      if (front != best.tilted_front ? best.tilted_front : best.tilted < t) continue;
    }
    best.tilted = t;
    best.tilted_front = front;
    best.far = far;
    best.fast = fast;
  }
}

LatticePoint ParallelRays::reached(const LatticePoint& from, std::uint32_t part) const {
  const auto along = [&](std::int32_t at, std::int32_t way) {
    return at + static_cast<std::int32_t>(product(way, static_cast<std::int32_t>(part)) >> kPartBits);
  };
  return {along(from.x, way_.x), along(from.y, way_.y), along(from.z, way_.z)};
}

/// Of the nearest of both kinds the nearer; there is a tilted one.
ParallelRays::First ParallelRays::settled(const LatticePoint& from, const Nearest& best) const {
  bool flat = best.flat != kNone;
  if (flat) {
    flat = less_fraction(best.part, best.whole, best.far, best.fast);
    if (!flat && !less_fraction(best.far, best.fast, best.part, best.whole)) {
      flat = best.flat_front != best.tilted_front ? best.flat_front : best.flat < best.tilted;
    }
  }
  if (flat) return {best.flat, best.flat_front, reached(from, part_of(best.part, best.whole))};
  return met(from, best.tilted, best.tilted_front, best.far, best.fast);
}

/// A triangle square to an axis may be one of a facet that isn't.
ParallelRays::First ParallelRays::met(const LatticePoint& from, std::uint32_t t, bool front, std::int64_t far,
                                      std::int64_t fast) const {
  const Triangle& triangle = geometry_.triangles[t];
  const int axis = axis_of(triangle);
  if (axis == 3) return {t, front, reached(from, part_of(far, fast))};
  const std::int32_t part = component(triangle.a, axis) - component(from, axis), whole = component(way_, axis);
  return {t, front, reached(from, part_of(part < 0 ? -part : part, whole < 0 ? -whole : whole))};
}

ParallelRays::First ParallelRays::first(const LatticePoint& from) const {
  if (!features::kAims || listed_.any_triangle) {
    const Hit hit = intersector_.nearest(from, direction_);
    if (hit.triangle == kNone) return {};
    return met(from, hit.triangle, hit.front, hit.distance, hit.speed);
  }
  const std::span<const Facet> facets = intersector_.facets();
  Nearest best;
  for (const std::uint32_t k : listed_.facets.first(flat_)) offer_flat(facets[k], from, best);
  const LatticePoint end =
      best.flat == kNone ? LatticePoint{from.x + way_.x, from.y + way_.y, from.z + way_.z}
                         : reached(from, part_of(best.part, best.whole));
  if (flat_ < listed_.facets.size()) {
    LatticeBox before;
    before.include(from);
    before.include(end);
    for (int k = 0; k < 3; ++k) --before.low[k], ++before.high[k];
    for (const std::uint32_t k : listed_.facets.subspan(flat_)) {
      if (!apart(before, facets[k].box) && !passes_by(facets[k].box, from)) offer_tilted(facets[k], from, best);
    }
  }
  if (best.tilted != kNone) return settled(from, best);
  return best.flat == kNone ? First{} : First{best.flat, best.flat_front, end};
}

}  // namespace shodo
