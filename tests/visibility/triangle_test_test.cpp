// The exact test against its 128-bit twin, on segments aimed where tests go wrong.
#include "visibility/triangle_test.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.h"
#include "slow_twin.h"

namespace shodo {
namespace {

constexpr std::int32_t kEnd = 1 << 19;

LatticePoint corner_of_cube(Random& random) {
  return {random.below(2) != 0 ? kEnd : -kEnd, random.below(2) != 0 ? kEnd : -kEnd,
          random.below(2) != 0 ? kEnd : -kEnd};
}

bool inside(const LatticePoint& p) {
  return p.x >= -kEnd && p.x <= kEnd && p.y >= -kEnd && p.y <= kEnd && p.z >= -kEnd && p.z <= kEnd;
}

/// A pair of triangles with a common edge: generic, tiny, slivers, flat ones, and with corners of the lattice's cube.
void make_pair(Random& random, Triangle (&pair)[2]) {
  const std::uint32_t kind = random.below(6);
  const std::int32_t reach = kind == 0 ? kEnd : kind == 1 ? 40 : kind == 2 ? 3000 : kEnd - 64;
  LatticePoint v[4];
  for (LatticePoint& p : v) p = even_within(random, reach);
  if (kind == 3) {  // slivers: the third corner within a few steps of the edge
    for (int k = 2; k < 4; ++k) {
      const double t = random.unit();
      v[k] = {v[0].x + 2 * static_cast<std::int32_t>(t * (v[1].x - v[0].x) / 2) + 2 * random.between(-2, 2),
              v[0].y + 2 * static_cast<std::int32_t>(t * (v[1].y - v[0].y) / 2) + 2 * random.between(-2, 2),
              v[0].z + 2 * static_cast<std::int32_t>(t * (v[1].z - v[0].z) / 2) + 2 * random.between(-2, 2)};
    }
  }
  if (kind == 4) {
    for (LatticePoint& p : v) p = corner_of_cube(random);
  }
  if (kind == 5) {  // axis-aligned
    const std::uint32_t axis = random.below(3);
    for (LatticePoint& p : v) (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = v[0].x;
  }
  pair[0] = triangle_of(v[0], v[1], v[2]);
  pair[1] = triangle_of(v[1], v[0], v[3]);
}

/// A target on or by the triangle: a corner, a point of an edge where that is on the lattice, else a step or two off.
LatticePoint unclamped_target(Random& random, const Triangle& t) {
  const LatticePoint* corner[3] = {&t.a, &t.b, &t.c};
  const std::uint32_t k = random.below(3);
  const LatticePoint &a = *corner[k], &b = *corner[(k + 1) % 3];
  if (random.below(4) == 0) return a;
  if (random.below(4) == 0) return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};  // exact: all are even
  const double s = random.unit();
  return {a.x + static_cast<std::int32_t>(s * (b.x - a.x)) + random.between(-1, 1),
          a.y + static_cast<std::int32_t>(s * (b.y - a.y)) + random.between(-1, 1),
          a.z + static_cast<std::int32_t>(s * (b.z - a.z)) + random.between(-1, 1)};
}

LatticePoint target(Random& random, const Triangle& t) {
  const LatticePoint p = unclamped_target(random, t);
  return {std::clamp(p.x, -kEnd, kEnd), std::clamp(p.y, -kEnd, kEnd), std::clamp(p.z, -kEnd, kEnd)};
}

/// A segment through the target, within the cube; one that starts there if nothing else fits (a corner of the cube).
void aim(Random& random, const LatticePoint& at, LatticePoint& p, LatticePoint& q) {
  for (int attempt = 0; attempt < 30; ++attempt) {
    const std::int32_t reach = attempt % 2 != 0 ? kEnd / 2 : 50;
    const LatticePoint v{random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)};
    const std::int32_t m = random.between(1, 3), n = random.between(1, 3);
    p = {at.x - m * v.x, at.y - m * v.y, at.z - m * v.z};
    q = {at.x + n * v.x, at.y + n * v.y, at.z + n * v.z};
    if (!inside(p) || !inside(q)) continue;
    if (random.below(16) == 0) q = at;  // ends on the triangle: open, so not blocked there
    return;
  }
  p = corner_of_cube(random);
  q = at;
}

TEST(TriangleTest, MatchesThe128BitTwinOnAMillionAdversarialSegments) {
  Random random(1);
  std::uint64_t mismatches = 0, blocked = 0;
  Triangle pair[2];
  const int segments = soaked(1000000);
  for (int k = 0; k < segments; ++k) {
    if (k % 8 == 0) make_pair(random, pair);
    LatticePoint p, q;
    aim(random, target(random, pair[random.below(2)]), p, q);
    for (const Triangle& t : pair) {
      const bool is = blocks_segment(t, p, q);
      mismatches += is != twin::blocks_segment(t, p, q) ? 1 : 0;
      blocked += is ? 1 : 0;
    }
  }
  EXPECT_EQ(mismatches, 0u);
  const auto tests = 2 * static_cast<std::uint64_t>(segments);
  EXPECT_GT(blocked, tests / 5);  // the cases are not all easy ones
  EXPECT_LT(blocked, tests / 5 * 4);
}

TEST(TriangleTest, RaysMatchThe128BitTwin) {
  Random random(2);
  std::uint64_t mismatches = 0, blocked = 0;
  Triangle pair[2];
  for (int k = 0; k < 250000; ++k) {
    if (k % 8 == 0) make_pair(random, pair);
    LatticePoint p, q;
    aim(random, target(random, pair[random.below(2)]), p, q);
    // Exactly through the target where the offset is small, else as the sun's directions are rounded.
    const LatticeVector d = random.below(2) != 0
                                ? q - p
                                : lattice_direction({static_cast<double>(q.x) - p.x, static_cast<double>(q.y) - p.y,
                                                     static_cast<double>(q.z) - p.z});
    for (const Triangle& t : pair) {
      const bool is = blocks_ray(t, p, d);
      mismatches += is != twin::blocks_ray(t, p, d) ? 1 : 0;
      blocked += is ? 1 : 0;
    }
  }
  EXPECT_EQ(mismatches, 0u);
  EXPECT_GT(blocked, 100000u);
  EXPECT_LT(blocked, 400000u);
}

TEST(TriangleTest, ExtremesOfTheLatticeStayExact) {
  // All corners of the cube: determinants reach 2^61, where a 63-bit intermediate would show.
  std::uint64_t mismatches = 0, blocked = 0;
  LatticePoint v[8];
  for (int k = 0; k < 8; ++k) v[k] = {k & 1 ? kEnd : -kEnd, k & 2 ? kEnd : -kEnd, k & 4 ? kEnd : -kEnd};
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) {
      for (int c = 0; c < 8; ++c) {
        const Triangle t = triangle_of(v[a], v[b], v[c]);
        for (int p = 0; p < 8; ++p) {
          for (int q = 0; q < 8; ++q) {
            const LatticePoint from{v[p].x + (v[p].x > 0 ? -1 : 1), v[p].y, v[p].z};
            const LatticeVector d{2 * v[q].x, 2 * v[q].y, 2 * v[q].z};  // 2^20 in every component
            mismatches += blocks_segment(t, v[p], v[q]) != twin::blocks_segment(t, v[p], v[q]) ? 1 : 0;
            mismatches += blocks_segment(t, from, v[q]) != twin::blocks_segment(t, from, v[q]) ? 1 : 0;
            mismatches += blocks_ray(t, from, d) != twin::blocks_ray(t, from, d) ? 1 : 0;
            blocked += blocks_segment(t, from, v[q]) ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_EQ(mismatches, 0u);
  EXPECT_GT(blocked, 100u);
}

TEST(TriangleTest, ClosedTriangleOpenSegment) {
  const Triangle t = triangle_of({0, 0, 0}, {10, 0, 0}, {0, 10, 0});
  EXPECT_TRUE(blocks_segment(t, {2, 2, 5}, {2, 2, -5}));
  EXPECT_TRUE(blocks_segment(t, {0, 0, 1}, {0, 0, -1})) << "through a corner";
  EXPECT_TRUE(blocks_segment(t, {5, 5, 1}, {5, 5, -1})) << "through an edge";
  EXPECT_FALSE(blocks_segment(t, {2, 2, 5}, {2, 2, 0})) << "ends on it";
  EXPECT_FALSE(blocks_segment(t, {2, 2, 0}, {2, 2, -5})) << "starts on it";
  EXPECT_FALSE(blocks_segment(t, {-5, 2, 0}, {20, 2, 0})) << "lies in its plane";
  EXPECT_FALSE(blocks_segment(t, {6, 6, 5}, {6, 6, -5})) << "beside it";
  EXPECT_FALSE(blocks_segment(triangle_of({0, 0, 0}, {4, 4, 4}, {8, 8, 8}), {0, 8, 4}, {8, 0, 4})) << "no normal";
  EXPECT_TRUE(blocks_ray(t, {2, 2, 5}, {0, 0, -(1 << 20)}));
  EXPECT_FALSE(blocks_ray(t, {2, 2, 5}, {0, 0, 1 << 20})) << "away from it";
  EXPECT_FALSE(blocks_ray(t, {2, 2, 0}, {0, 0, 1 << 20})) << "starts on it";
}

}  // namespace
}  // namespace shodo
