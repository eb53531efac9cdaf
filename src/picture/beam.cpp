#include "picture/beam.h"

#include <bit>

namespace shodo {

namespace {

constexpr int kSteps = 6;   // of the lattice in one, log2
constexpr int kBits = 13;   // of a normal
constexpr std::int32_t kMargin = 4;

std::int64_t magnitude(std::int64_t a) { return a < 0 ? -a : a; }

/// Shifted right until 13 bits hold the largest; false if all are zero.
bool shorten(std::int64_t (&v)[3]) {
  const std::uint64_t bits = static_cast<std::uint64_t>(magnitude(v[0]) | magnitude(v[1]) | magnitude(v[2]));
  const int width = 64 - std::countl_zero(bits), by = width > kBits ? width - kBits : 0;
  for (std::int64_t& c : v) c = c < 0 ? -(-c >> by) : c >> by;
  return bits != 0;
}

void cross(const std::int64_t (&a)[3], const std::int64_t (&b)[3], std::int64_t (&to)[3]) {
  for (int k = 0; k < 3; ++k) {
    const int u = k == 2 ? 0 : k + 1, v = k == 0 ? 2 : k - 1;
    to[k] = a[u] * b[v] - a[v] * b[u];
  }
}

std::int64_t size_of(const std::int64_t (&v)[3]) { return magnitude(v[0]) + magnitude(v[1]) + magnitude(v[2]); }

}  // namespace

void Beam::include(const LatticePoint& p) {
  around_.include(LatticePoint{p.x - kMargin, p.y - kMargin, p.z - kMargin});
  around_.include(LatticePoint{p.x + kMargin, p.y + kMargin, p.z + kMargin});
}

/// Points and vertices are rounded down, each by less than 1, and the margin is less than 1.
void Beam::add_slab(const std::int64_t (&normal)[3], std::span<const Point> points) {
  Slab& slab = slabs_[count_++];
  std::int32_t pad = 0;
  for (int k = 0; k < 3; ++k) {
    slab.normal[k] = static_cast<std::int32_t>(normal[k]);
    pad += 3 * (slab.normal[k] < 0 ? -slab.normal[k] : slab.normal[k]);
  }
  slab.low = INT32_MAX;
  slab.high = INT32_MIN;
  for (const Point& p : points) {
    const std::int32_t at = slab.normal[0] * p.c[0] + slab.normal[1] * p.c[1] + slab.normal[2] * p.c[2];
    if (at - pad < slab.low) slab.low = at - pad;
    if (at + pad > slab.high) slab.high = at + pad;
  }
}

Beam::Beam(const LatticePoint& from_a, const LatticePoint& from_b, const LatticePoint& to_a,
           const LatticePoint& to_b) {
  const LatticePoint given[4] = {from_a, from_b, to_a, to_b};
  Point points[4];
  for (int k = 0; k < 4; ++k) {
    include(given[k]);
    points[k] = {{given[k].x >> kSteps, given[k].y >> kSteps, given[k].z >> kSteps}};
  }
  std::int64_t way_a[3], way_b[3], across_from[3], across_to[3];
  for (int k = 0; k < 3; ++k) {
    way_a[k] = points[2].c[k] - points[0].c[k];
    way_b[k] = points[3].c[k] - points[1].c[k];
    across_from[k] = points[1].c[k] - points[0].c[k];
    across_to[k] = points[3].c[k] - points[2].c[k];
  }
  // Whichever two span the plane best.
  std::int64_t normal[3] = {0, 0, 0}, other[3];
  for (const auto* across : {&across_from, &across_to, &way_b}) {
    cross(way_a, *across, other);
    if (size_of(other) <= size_of(normal)) continue;
    for (int k = 0; k < 3; ++k) normal[k] = other[k];
  }
  if (!shorten(normal)) return;
  add_slab(normal, points);
  for (auto* way : {&way_a, &way_b}) {
    if (!shorten(*way)) continue;
    cross(normal, *way, other);
    if (shorten(other)) add_slab(other, points);
  }
}

bool Beam::misses(const LatticeBox& box) const {
  if (apart(around_, box)) return true;
  if (count_ == 0) return false;
  const Slab& slab = slabs_[0];  // the others rarely tell of a box
  std::int32_t least = 0, most = 0;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t n = slab.normal[k], low = n * (box.low[k] >> kSteps), high = n * (box.high[k] >> kSteps);
    least += n > 0 ? low : high;
    most += n > 0 ? high : low;
  }
  return least > slab.high || most < slab.low;
}

bool Beam::misses(const DrawnTriangle& triangle) const {
  const LatticePoint &a = triangle.vertex[0], &b = triangle.vertex[1], &c = triangle.vertex[2];
  const auto beyond = [&](std::int32_t p, std::int32_t q, std::int32_t r, int k) {
    const std::int32_t low = around_.low[k], high = around_.high[k];
    return p < low ? q < low && r < low : p > high && q > high && r > high;
  };
  if (beyond(a.x, b.x, c.x, 0) || beyond(a.y, b.y, c.y, 1) || beyond(a.z, b.z, c.z, 2)) return true;
  const Slab* const end = slabs_ + count_;
  for (const Slab* slab = slabs_; slab != end; ++slab) {
    const auto at = [&](const LatticePoint& p) {
      return slab->normal[0] * (p.x >> kSteps) + slab->normal[1] * (p.y >> kSteps) + slab->normal[2] * (p.z >> kSteps);
    };
    const std::int32_t first = at(a);
    if (first < slab->low ? at(b) < slab->low && at(c) < slab->low
                          : first > slab->high && at(b) > slab->high && at(c) > slab->high) {
      return true;
    }
  }
  return false;
}

}  // namespace shodo
