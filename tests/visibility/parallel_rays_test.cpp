// Parallel rays: against Intersector::nearest(), which tries every triangle, and the slow twin's fractions.
#include <gtest/gtest.h>

#include <random>

#include "visibility/parallel_rays.h"
#include "visibility/scenes.h"
#include "visibility/slow_twin.h"
#include "visibility/sweep.h"
#include "visibility/triangle_test.h"

namespace shodo {
namespace {

/// Boxes, touching ones too, plates one on another, loose triangles and a bent sheet, in a closed room.
void build(HandMadeScene& scene, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 5) * 0x1p-27; };
  const auto eighth = [&] { return static_cast<double>(random() % 25) / 8; };
  scene.box({0, 0, 0}, {4, 4, 4}, true);
  for (int k = 0; k < 8; ++k) {
    const Vec3 low{eighth(), eighth(), eighth()};
    scene.box(low, low + Vec3{0.125 + 0.25 * eighth(), 0.5, 0.125 + 0.25 * eighth()});
    scene.triangle({4 * unit(), 4 * unit(), 4 * unit()}, {4 * unit(), 4 * unit(), 4 * unit()},
                   {4 * unit(), 4 * unit(), 4 * unit()});
  }
  scene.quad({1, 1, 0.5}, {2, 1, 0.5}, {2, 2, 0.5}, {1, 2, 0.5});
  scene.quad({1, 1, 0.5}, {1, 2, 0.5}, {2, 2, 0.5}, {2, 1, 0.5});
  scene.quad({3, 1, 1}, {3.5, 1.25, 1}, {3.5, 1.25, 3}, {3, 1, 3});
  scene.quad({1, 3, 1}, {2, 3, 1}, {2, 3.5, 2}, {1, 3, 2});
  scene.area_light({1, 1, 3.75}, {1, 2, 3.75}, {2, 2, 3.75}, {2, 1, 3.75});
  scene.place();
}

LatticePoint odd_in(std::mt19937& random, const LatticeBox& box) {
  const auto at = [&](int k) {
    const std::uint32_t steps = static_cast<std::uint32_t>(box.high[k] - box.low[k]) / 2 + 1;
    return box.low[k] + 2 * static_cast<std::int32_t>(random() % steps);
  };
  return {at(0), at(1), at(2)};
}

LatticeBox some_box(std::mt19937& random) {
  LatticeBox box;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t size = random() % 4 == 0 ? 0 : 2 << (random() % 16);
    box.low[k] = 2 * (static_cast<std::int32_t>(random() % 400000) - 200000) + 1;
    box.high[k] = box.low[k] + size;
  }
  return box;
}

LatticeVector some_direction(std::mt19937& random) {
  const auto part = [&] { return random() % 5 == 0 ? 0.0 : static_cast<double>(random() % 2001) - 1000; };
  const LatticeVector way = lattice_direction({part(), part(), part()});
  return way == LatticeVector{} ? LatticeVector{0, 0, 1 << 20} : way;
}

std::uint32_t polygon_of(const Geometry& geometry, std::uint32_t triangle) {
  std::uint32_t number = 0;
  for (const std::span<PolygonTriangles> all : {geometry.cells, geometry.light_triangles}) {
    for (const PolygonTriangles& polygon : all) {
      if (triangle - polygon.first < polygon.count) return number;
      ++number;
    }
  }
  return kNone;
}

TEST(ParallelRays, MeetWhatTryingEveryTriangleMeets) {
  std::uint64_t met = 0, backs = 0, apart_by_much = 0;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    HandMadeScene scene;
    build(scene, seed);
    ASSERT_TRUE(scene.status.done());
    Intersector off(scene.geometry), on(scene.geometry, scene.scene, FlagMode::kAuto);
    ASSERT_TRUE(on.start(scene.arena, seed % 2 == 0 ? Rectangles::kWhole : Rectangles::kCut));
    if (seed % 4 > 1) {
      ASSERT_TRUE(on.take_masks(scene.arena));
    }
    ParallelRays slow(scene.geometry, off), fast(scene.geometry, on);
    std::mt19937 random(seed);
    for (int trial = 0; trial < 400; ++trial) {
      const LatticeBox box = some_box(random);
      const LatticeVector direction = some_direction(random);
      slow.aim(box, direction);
      fast.aim(box, direction);
      EXPECT_LE(fast.tests(), slow.tests());
      for (int k = 0; k < 8; ++k) {
        const LatticePoint from = odd_in(random, box);
        const ParallelRays::First expected = slow.first(from), found = fast.first(from);
        const Hit hit = off.nearest(from, direction);
        ASSERT_EQ(expected.triangle, hit.triangle);
        ASSERT_EQ(found.triangle == kNone, hit.triangle == kNone);
        ASSERT_EQ(expected.front, hit.front);
        ASSERT_EQ(found.front, hit.front);
        ASSERT_EQ(found.at, expected.at);
        if (hit.triangle == kNone) continue;
        ASSERT_EQ(polygon_of(scene.geometry, found.triangle), polygon_of(scene.geometry, hit.triangle));
        ++met;
        backs += hit.front ? 0 : 1;
        // Where, by the fraction of another test: a part of 2^20 steps is cut to 2^-22, then the step to a whole one.
        const Triangle& t = scene.geometry.triangles[hit.triangle];
        const twin::Meeting there = twin::meet(t.a, t.b, t.c, twin::of(from), twin::of(direction), false);
        ASSERT_TRUE(there.blocks);
        const double part = static_cast<double>(there.numerator) / static_cast<double>(there.denominator);
        const double off_by[3] = {from.x + part * static_cast<double>(direction.x) - found.at.x,
                                  from.y + part * static_cast<double>(direction.y) - found.at.y,
                                  from.z + part * static_cast<double>(direction.z) - found.at.z};
        for (const double by : off_by) apart_by_much += by < -0.26 || by > 1.26 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(met, 10000u);
  EXPECT_GT(backs, 1000u);
  EXPECT_EQ(apart_by_much, 0u);
}

TEST(ParallelRays, WhereNothingStandsNothingIsMet) {
  HandMadeScene scene;
  scene.place(1);
  ASSERT_TRUE(scene.status.done());
  Intersector on(scene.geometry, scene.scene, FlagMode::kAuto);
  ASSERT_TRUE(on.start(scene.arena));
  ParallelRays rays(scene.geometry, on);
  LatticeBox box;
  box.include(LatticePoint{400001, -400001, 1});
  rays.aim(box, lattice_direction({1, -1, 0.5}));
  EXPECT_EQ(rays.first({400001, -400001, 1}).triangle, kNone);
  EXPECT_EQ(rays.tests(), 0u);
}

TEST(ParallelRays, NothingOutsideASweepIsMet) {
  HandMadeScene scene;
  build(scene, 77);
  Blockers blockers;
  ASSERT_TRUE(blockers.build(scene.geometry, scene.arena));
  std::mt19937 random(5);
  std::uint64_t in = 0, met = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const LatticeBox box = some_box(random);
    const LatticeVector direction = some_direction(random);
    const LatticePoint way{static_cast<std::int32_t>(direction.x), static_cast<std::int32_t>(direction.y),
                           static_cast<std::int32_t>(direction.z)};
    std::vector<bool> in_sweep(scene.geometry.triangles.size());
    blockers.visit(Sweep(box, way, 1 << Sweep::kPartBits), [&](std::uint32_t k) {
      const Facet& facet = blockers.facets()[k];
      for (std::uint32_t t = facet.first; t < facet.first + facet.count; ++t) in_sweep[t] = true;
    });
    for (std::size_t t = 0; t < in_sweep.size(); ++t) {
      bool any = false;
      for (int k = 0; k < 4; ++k) {
        LatticePoint from = odd_in(random, box);
        if (k == 0) from.x = box.low[0];
        if (k == 1) from.y = box.high[1];
        if (k == 2) from.z = box.low[2];
        any = any || blocks_ray(scene.geometry.triangles[t], from, direction);
      }
      EXPECT_TRUE(in_sweep[t] || !any);
      in += in_sweep[t] ? 1 : 0;
      met += any ? 1 : 0;
    }
  }
  // The strips are worth their while.
  EXPECT_LT(in, 12 * met);
}

}  // namespace
}  // namespace shodo
