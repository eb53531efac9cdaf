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

/// Along every side of the rectangle the crossing moves one way with each coordinate: the boxes' corners tell all.
TEST(Blockers, ARectangleHidesAllIfItBlocksTheSegmentsBetweenAllCorners) {
  Random random(5);
  int hidden = 0, not_hidden = 0, wrong = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const int axis = static_cast<int>(random.below(3)), u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    LatticePoint corner[4];
    const std::int32_t plane = 2 * random.between(-200, 200);
    const std::int32_t low_u = 2 * random.between(-2000, 0), high_u = 2 * random.between(1, 2000);
    const std::int32_t low_v = 2 * random.between(-2000, 0), high_v = 2 * random.between(1, 2000);
    for (int k = 0; k < 4; ++k) {
      std::int32_t at[3];
      at[axis] = plane;
      at[u] = k == 1 || k == 2 ? high_u : low_u;
      at[v] = k >= 2 ? high_v : low_v;
      corner[k] = {at[0], at[1], at[2]};
    }
    const Triangle halves[2] = {triangle_of(corner[0], corner[1], corner[2]),
                                triangle_of(corner[0], corner[2], corner[3])};
    const auto box = [&](std::int32_t along) {
      LatticeBox made;
      for (int k = 0; k < 3; ++k) {
        const std::int32_t size = random.below(3) == 0 ? 0 : random.between(0, 1500);
        made.low[k] = k == axis ? along + random.between(-300, 300) : random.between(-3000, 3000);
        made.high[k] = made.low[k] + (k == axis ? size / 10 : size);
      }
      return made;
    };
    const std::int32_t far = random.below(2) == 0 ? 700 : -700;
    const LatticeBox a = box(plane + far), b = box(plane - far);
    bool all = true;
    for (int k = 0; k < 64; ++k) {
      const auto at = [&](const LatticeBox& from, int bits) {
        return LatticePoint{(bits & 1 ? from.high : from.low)[0], (bits & 2 ? from.high : from.low)[1],
                            (bits & 4 ? from.high : from.low)[2]};
      };
      const LatticePoint p = at(a, k & 7), q = at(b, k >> 3);
      all = all && (blocks_segment(halves[0], p, q) || blocks_segment(halves[1], p, q));
    }
    bool tilted = false;
    const LatticeBox rectangle = facet_box(halves, tilted);
    ASSERT_TRUE(fill_box(halves, rectangle));
    wrong += hides_all(rectangle, a, b) != all ? 1 : 0;
    (all ? hidden : not_hidden) += 1;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(hidden, 1000);
  EXPECT_GT(not_hidden, 1000);
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
