// Finding possible blockers: against every triangle, tried one by one.
#include <gtest/gtest.h>

#include <random>

#include "visibility/blockers.h"
#include "visibility/scenes.h"
#include "visibility/triangle_test.h"

namespace shodo {
namespace {

class Points {
 public:
  explicit Points(std::uint32_t seed) : random_(seed) {}
  /// Odd, within `size` of the cube's half.
  LatticePoint odd(std::int32_t size) { return {coordinate(size), coordinate(size), coordinate(size)}; }
  LatticeBox box(std::vector<LatticePoint>& points, std::int32_t size, int count) {
    const LatticePoint at = odd(kLatticeHalf - size);
    const bool flat = random_() % 3 == 0;
    points.clear();
    LatticeBox box;
    for (int k = 0; k < count; ++k) {
      const LatticePoint off = odd(size);
      points.push_back({at.x + off.x + 1, at.y + off.y + 1, flat ? at.z : at.z + off.z + 1});
      box.include(points.back());
    }
    return box;
  }
  std::uint32_t next() { return static_cast<std::uint32_t>(random_()); }

 private:
  std::int32_t coordinate(std::int32_t size) {
    return static_cast<std::int32_t>(random_() % static_cast<std::uint32_t>(size)) / 2 * 4 + 1 - size;
  }
  std::mt19937 random_;
};

/// Boxes, walls and loose triangles, some square to the axes.
void build_clutter(HandMadeScene& scene, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 5) * 0x1p-27; };
  scene.box({0, 0, 0}, {4, 4, 4}, true);
  for (int k = 0; k < 12; ++k) {
    const Vec3 low{3 * unit(), 3 * unit(), 3 * unit()};
    scene.box(low, low + Vec3{unit(), unit(), unit()});
    scene.triangle({4 * unit(), 4 * unit(), 4 * unit()}, {4 * unit(), 4 * unit(), 4 * unit()},
                   {4 * unit(), 4 * unit(), 4 * unit()});
  }
  scene.place();
}

TEST(Blockers, NothingOutsideAShaftBlocksAnySegmentInIt) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    HandMadeScene scene;
    build_clutter(scene, seed);
    ASSERT_TRUE(scene.status.done());
    Blockers blockers;
    ASSERT_TRUE(blockers.build(scene.geometry, scene.arena));
    Points points(seed);
    std::uint64_t found = 0, blocking = 0;
    for (int trial = 0; trial < 200; ++trial) {
      std::vector<LatticePoint> a, b;
      const std::int32_t size = 1 << (6 + points.next() % 12);
      const LatticeBox box_a = points.box(a, size, 4), box_b = points.box(b, size, 4);
      std::vector<bool> in_shaft(scene.geometry.triangles.size());
      blockers.visit(Shaft(box_a, box_b), [&](std::uint32_t k) {
        const Facet& facet = blockers.facets()[k];
        const auto triangles = scene.geometry.triangles.subspan(facet.first, facet.count);
        if (misses_side(triangles, a, b)) return;
        for (std::uint32_t t = facet.first; t < facet.first + facet.count; ++t) {
          in_shaft[t] = true;
          ++found;
        }
      });
      for (std::size_t t = 0; t < in_shaft.size(); ++t) {
        bool any = false;
        for (const LatticePoint& p : a) {
          for (const LatticePoint& q : b) any = any || blocks_segment(scene.geometry.triangles[t], p, q);
        }
        blocking += any ? 1 : 0;
        EXPECT_TRUE(in_shaft[t] || !any) << "triangle " << t << " of seed " << seed;
      }
    }
    // The shafts are worth their while: the scene has some 170 triangles.
    EXPECT_GT(blocking, 300u);
    EXPECT_LT(found, 10 * blocking);
  }
}

TEST(Blockers, NothingOutsideAShaftAlongADirectionBlocksARayInIt) {
  HandMadeScene scene;
  build_clutter(scene, 77);
  Blockers blockers;
  ASSERT_TRUE(blockers.build(scene.geometry, scene.arena));
  Points points(5);
  std::mt19937 random(9);
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<LatticePoint> a;
    const LatticeBox box = points.box(a, 1 << (6 + points.next() % 12), 4);
    const auto part = [&] { return random() % 4 == 0 ? 0.0 : static_cast<double>(random() % 2001) - 1000; };
    const Vec3 way{part(), part(), part()};
    if (way == Vec3{}) continue;
    const LatticeVector direction = lattice_direction(way);
    std::vector<bool> in_shaft(scene.geometry.triangles.size());
    blockers.visit(Shaft::along(box, direction), [&](std::uint32_t k) {
      const Facet& facet = blockers.facets()[k];
      for (std::uint32_t t = facet.first; t < facet.first + facet.count; ++t) in_shaft[t] = true;
    });
    for (std::size_t t = 0; t < in_shaft.size(); ++t) {
      for (const LatticePoint& p : a) {
        EXPECT_TRUE(in_shaft[t] || !blocks_ray(scene.geometry.triangles[t], p, direction));
      }
    }
  }
}

TEST(Blockers, TheNearestHitIsTheSameWithAndWithout) {
  HandMadeScene scene;
  build_clutter(scene, 3);
  const Intersector off(scene.geometry);
  Intersector on(scene.geometry, scene.scene, FlagMode::kAuto);
  ASSERT_TRUE(on.start(scene.arena));
  Points points(4);
  for (int trial = 0; trial < 3000; ++trial) {
    const LatticePoint p = points.odd(kLatticeHalf / 2);
    const LatticePoint q = points.odd(1000);
    const LatticeVector direction =
        lattice_direction({static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)});
    const Hit first = off.nearest(p, direction), second = on.nearest(p, direction);
    EXPECT_EQ(first.triangle, second.triangle);
    EXPECT_EQ(first.front, second.front);
  }
}

TEST(Blockers, WithoutStartAnIntersectorTriesEveryTriangle) {
  HandMadeScene scene;
  build_clutter(scene, 1);
  Intersector on(scene.geometry, scene.scene, FlagMode::kAuto);
  LatticeBox box;
  box.include(LatticePoint{1, 1, 1});
  EXPECT_FALSE(on.aim(box, box, {}).clear());
}

TEST(Blockers, TakesTheBytesThatItSays) {
  HandMadeScene scene;
  build_clutter(scene, 2);
  Intersector on(scene.geometry, scene.scene, FlagMode::kAuto);
  ASSERT_TRUE(on.take_flags(scene.arena));
  const std::size_t before = scene.arena.used();
  ASSERT_TRUE(on.start(scene.arena));
  EXPECT_EQ(scene.arena.used() - before, Intersector::bytes(scene.geometry, FlagMode::kAuto));
  EXPECT_EQ(Intersector::bytes(scene.geometry, FlagMode::kOff), 0u);
}

}  // namespace
}  // namespace shodo
