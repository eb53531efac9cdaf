// Segments tested in bulk, against the 128-bit twin one by one.
#include "visibility/shadow.h"

#include <gtest/gtest.h>

#include <vector>

#include "scenes.h"
#include "slow_twin.h"

namespace shodo {
namespace {

constexpr std::int32_t kHalf = 1 << 19;

std::int32_t clamped(std::int64_t x) { return static_cast<std::int32_t>(x < -kHalf ? -kHalf : x > kHalf ? kHalf : x); }

/// A rectangle square to an axis, a trapezoid in such a plane, any two triangles with a common side, one, or a
/// parallelogram; also slivers.
void make_facet(Random& random, std::uint32_t kind, std::vector<Triangle>& triangles, Facet& facet) {
  const std::int32_t most = kind == 4 ? kHalf / 4 : kHalf;
  const std::int32_t reach = random.below(3) == 0 ? 60 : random.below(2) == 0 ? 5000 : most;
  LatticePoint v[4];
  for (LatticePoint& p : v) p = even_within(random, reach);
  if (kind < 2) {
    const std::uint32_t axis = random.below(3);
    const auto at = [&](LatticePoint& p) -> std::int32_t& { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
    for (LatticePoint& p : v) at(p) = at(v[0]);
    if (kind == 0) {
      const LatticePoint low = v[0], high = v[2];
      const std::uint32_t u = axis == 0 ? 1 : 0;
      v[1] = low;
      v[3] = high;
      (u == 0 ? v[1].x : v[1].y) = u == 0 ? high.x : high.y;
      (u == 0 ? v[3].x : v[3].y) = u == 0 ? low.x : low.y;
    }
  }
  triangles = {triangle_of(v[0], v[1], v[2]), triangle_of(v[0], v[2], v[3])};
  if (kind == 3) triangles.pop_back();
  if (kind == 4) {
    v[3] = {v[0].x + v[2].x - v[1].x, v[0].y + v[2].y - v[1].y, v[0].z + v[2].z - v[1].z};
    triangles = {triangle_of(v[0], v[1], v[2]), triangle_of(v[2], v[3], v[0])};
  }
  bool tilted = false;
  facet.box = facet_box(triangles, tilted);
  facet.count = static_cast<std::uint8_t>(triangles.size());
  facet.tilted = !tilted ? 0 : kind == 4 ? 2 : 1;
  facet.rectangle = !tilted && fill_box(triangles, facet.box) ? 1 : 0;
}

/// Beyond a place on the facet, seen from p: on an edge, a corner, in the middle, or a few steps beside them.
LatticePoint end_beyond(Random& random, const Triangle& t, const LatticePoint& p) {
  const double s = random.below(3) == 0 ? 0 : random.unit(), r = random.below(2) == 0 ? 0 : random.unit();
  const LatticeVector ab = t.b - t.a, ac = t.c - t.a;
  const auto on = [&](std::int32_t a, std::int64_t b, std::int64_t c) {
    return a + static_cast<std::int64_t>(s * static_cast<double>(b) + (1 - s) * r * static_cast<double>(c)) +
           (random.below(2) == 0 ? 0 : random.between(-3, 3));
  };
  const std::int64_t x = on(t.a.x, ab.x, ac.x), y = on(t.a.y, ab.y, ac.y), z = on(t.a.z, ab.z, ac.z);
  const std::int64_t times = random.between(1, 3);
  return {clamped(p.x + times * (x - p.x)), clamped(p.y + times * (y - p.y)), clamped(p.z + times * (z - p.z))};
}

TEST(Shadow, OfAFacetIsThatOfItsTrianglesSegmentBySegment) {
  Random random(11);
  std::uint64_t mismatches = 0, blocked = 0, asked = 0, rectangles = 0;
  for (int trial = 0; trial < 60000; ++trial) {
    std::vector<Triangle> triangles;
    Facet facet;
    make_facet(random, random.below(5), triangles, facet);
    rectangles += facet.rectangle;
    const LatticePoint p = even_within(random, random.below(2) == 0 ? 8000 : kHalf);
    const std::uint32_t count = 1 + random.below(kMostEnds);
    std::vector<LatticePoint> ends;
    Segments segments;
    const bool cluster = random.below(2) == 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      LatticePoint q = end_beyond(random, triangles[random.below(static_cast<std::uint32_t>(triangles.size()))], p);
      if (cluster && k > 0) {
        q = {clamped(ends[0].x + random.between(-90, 90)), clamped(ends[0].y + random.between(-90, 90)),
             clamped(ends[0].z + random.between(-90, 90))};
      }
      ends.push_back(q);
      segments.box.include(q);
    }
    segments.from = p;
    segments.ends = ends;
    std::uint32_t wanted = static_cast<std::uint32_t>(random.next());
    if (random.below(3) == 0) wanted = 1U << random.below(count) | 1U << random.below(count);
    if (count < 32) wanted &= (1U << count) - 1;
    std::uint32_t expected = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      for (const Triangle& t : triangles) {
        if ((wanted >> k & 1) != 0 && twin::blocks_segment(t, p, ends[k])) expected |= 1U << k;
      }
    }
    const std::uint32_t shadow = shadow_of(facet, triangles, segments, wanted);
    mismatches += shadow != expected ? 1 : 0;
    blocked += static_cast<std::uint64_t>(__builtin_popcount(expected));
    asked += static_cast<std::uint64_t>(__builtin_popcount(wanted));
  }
  EXPECT_EQ(mismatches, 0u);
  EXPECT_GT(rectangles, 10000u);
  EXPECT_GT(blocked, asked / 10);  // the cases are not all easy ones
  EXPECT_LT(blocked, asked - asked / 10);
}

}  // namespace
}  // namespace shodo
