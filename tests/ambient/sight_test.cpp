// What finds the blockers of a link, against points of the hull, and against every triangle of the scene.
#include "ambient/sight.h"

#include <random>

#include "ambient/lean_shaft.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

using Random = std::mt19937;

std::int32_t between(Random& random, std::int32_t low, std::int32_t high) {
  return std::uniform_int_distribution<std::int32_t>(low, high)(random);
}

/// With sides up to `longest`; flat along an axis, in the way of facet_box(), now and then.
LatticeBox random_box(Random& random, std::int32_t longest, bool flat) {
  LatticeBox box;
  for (int k = 0; k < 3; ++k) {
    box.low[k] = between(random, -kLatticeHalf, kLatticeHalf - longest);
    box.high[k] = box.low[k] + between(random, 2, longest);
  }
  if (flat) {
    const int axis = between(random, 0, 2);
    box.high[axis] = box.low[axis] - 2;
  }
  return box;
}

LatticeBox random_part(Random& random, const LatticeBox& whole) {
  LatticeBox box;
  for (int k = 0; k < 3; ++k) {
    box.low[k] = between(random, whole.low[k], whole.high[k]);
    box.high[k] = between(random, box.low[k], whole.high[k]);
  }
  return box;
}

LatticePoint random_point(Random& random, const LatticeBox& box) {
  return {between(random, box.low[0], box.high[0]), between(random, box.low[1], box.high[1]),
          between(random, box.low[2], box.high[2])};
}

/// The lattice point next to p + t (q - p).
LatticePoint on_the_way(const LatticePoint& p, const LatticePoint& q, double t) {
  const auto at = [&](std::int32_t from, std::int32_t to) {
    return static_cast<std::int32_t>(std::lround(from + t * (double(to) - from)));
  };
  return {at(p.x, q.x), at(p.y, q.y), at(p.z, q.z)};
}

/// Boxes of all sizes around one point; one in two so thin along an axis that it is flat.
LatticeBox box_at(Random& random, const LatticePoint& p) {
  const std::int32_t at[3] = {p.x, p.y, p.z}, size = 1 << between(random, 1, 18);
  const int flat = between(random, 0, 5);
  LatticeBox box;
  for (int k = 0; k < 3; ++k) {
    // The point is off the segment by half a step.
    box.low[k] = k == flat ? at[k] + 1 : at[k] - between(random, 1, size);
    box.high[k] = k == flat ? at[k] - 1 : at[k] + between(random, 1, size);
    if (box.low[k] < -kLatticeHalf) box.low[k] = -kLatticeHalf;
    if (box.high[k] > kLatticeHalf) box.high[k] = kLatticeHalf;
  }
  return box;
}

TEST(FacetMasks, CallEveryFacetThatHoldsAPointOfTheHullOnceAndInOrder) {
  Random random(1);
  std::vector<LatticeBox> facets;
  LatticeBox around;
  for (int k = 0; k < 2100; ++k) facets.push_back(random_box(random, 1 << between(random, 4, 18), k % 3 == 0));
  for (const LatticeBox& facet : facets) around.include(facet);
  std::vector<unsigned char> memory(1 << 17);
  Arena arena(memory.data(), memory.size());
  FacetMasks masks;
  const std::uint32_t count = static_cast<std::uint32_t>(facets.size());
  ASSERT_TRUE(masks.take(arena, count));
  EXPECT_EQ(arena.used(), FacetMasks::bytes(count));
  masks.start(count, around);
  for (std::uint32_t f = 0; f < count; ++f) {
    if (f % 7 != 0) masks.add(f, facets[f]);
  }
  std::uint64_t called = 0, held = 0;
  for (int pair = 0; pair < 300; ++pair) {
    const LatticeBox a = random_box(random, 1 << between(random, 4, 18), pair % 4 == 0);
    const LatticeBox b = random_box(random, 1 << between(random, 4, 18), false);
    std::vector<bool> seen(count);
    std::uint32_t last = 0;
    masks.visit(a, b, [&](std::uint32_t f) {
      EXPECT_TRUE(f < count && f % 7 != 0 && (f > last || last == 0));
      seen[f] = true;
      last = f;
      ++called;
      return false;
    });
    for (int k = 0; k < 50; ++k) {
      LatticeBox from = a;
      for (int axis = 0; axis < 3; ++axis) from.high[axis] = std::max(from.high[axis], from.low[axis]);
      const LatticePoint p = on_the_way(random_point(random, from), random_point(random, b), 0.02 * k);
      for (std::uint32_t f = 0; f < count; ++f) {
        LatticeBox point;
        point.include(p);
        if (f % 7 == 0 || apart(point, facets[f])) continue;
        EXPECT_TRUE(seen[f]) << pair << ": " << f;
        ++held;
      }
    }
  }
  EXPECT_GT(held, 4000u);
  EXPECT_LT(called, 300u * count / 4);
}

TEST(LeanShaft, MissesNoBoxThatHoldsAPointOfTheHullAndNoneThatThatOfPartsHas) {
  Random random(2);
  int missed = 0, kept = 0;
  for (int pair = 0; pair < 20000; ++pair) {
    const std::int32_t longest = 1 << between(random, 4, 18);
    const LatticeBox a = random_box(random, longest, false), b = random_box(random, longest, false);
    LeanShaft shaft(a, b);
    const double t = 0.0001 * between(random, 0, 10000);
    const LatticePoint p = on_the_way(random_point(random, a), random_point(random, b), t);
    ASSERT_FALSE(shaft.misses(box_at(random, p))) << pair;
    LeanShaft of_parts(random_part(random, a), random_part(random, b));
    const LatticePoint near = on_the_way(p, random_point(random, random_box(random, 16, false)), 0.1);
    const LatticeBox other = box_at(random, near);
    const bool misses = shaft.misses(other);
    ASSERT_TRUE(!misses || of_parts.misses(other)) << pair;
    ++(misses ? missed : kept);
  }
  EXPECT_GT(missed, 1000);
  EXPECT_GT(kept, 1000);
}

TEST(LeanSegment, MayMeetEveryBoxThatHoldsAPointOfItAndPassesByWhatIsBesideIt) {
  Random random(3);
  for (int pair = 0; pair < 50000; ++pair) {
    const LatticePoint p = random_point(random, random_box(random, 4, false));
    const std::int32_t reach = 1 << between(random, 0, 20);
    const auto moved = [&](std::int32_t x) {
      return std::clamp(x + between(random, -reach, reach), -kLatticeHalf, kLatticeHalf);
    };
    const LatticePoint q{moved(p.x), moved(p.y), moved(p.z)};
    const LeanSegment segment(p, q);
    const LatticePoint on = on_the_way(p, q, 0.0001 * between(random, 0, 10000));
    ASSERT_TRUE(segment.may_meet(lean_box(box_at(random, on)))) << pair;
    // 20 steps aside along the axis on which it is shortest, beyond all rounding.
    const std::int32_t dx = std::abs(q.x - p.x), dy = std::abs(q.y - p.y), dz = std::abs(q.z - p.z);
    const std::int32_t far = 640;
    LatticePoint aside = on;
    (dx <= dy && dx <= dz ? aside.x : dy <= dz ? aside.y : aside.z) += 2 * far;
    LatticeBox box;
    box.include(aside);
    ASSERT_FALSE(segment.may_meet(lean_box(box))) << pair;
  }
}

/// A room with boxes and tilted boards in it.
std::string furnished() {
  Random random(4);
  std::string text = grey(0.5) + box_walls(4, 3, 2.5, 3, 3, 2, "white");
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int k = 0; k < 40; ++k) {
    text += "object thing" + std::to_string(k) + "\nquad white";
    const Vec3 at{number(0.4, 3), number(0.4, 2), number(0.4, 1.7)};
    const bool straight = k % 2 == 0;
    const double tilt[4] = {number(-0.3, 0.3), number(-0.3, 0.3), number(-0.3, 0.3), number(-0.3, 0.3)};
    const double long_u = number(0.1, 0.6), long_v = number(0.1, 0.6);
    const Vec3 u = straight ? Vec3{long_u, 0, 0} : Vec3{long_u, tilt[0], tilt[1]};
    const Vec3 v = straight ? Vec3{0, long_v, 0} : Vec3{tilt[2], long_v, tilt[3]};
    for (const Vec3& corner : {at, at + u, at + u + v, at + v}) {
      text += " " + std::to_string(corner.x) + " " + std::to_string(corner.y) + " " + std::to_string(corner.z);
    }
    text += " patches 1 1 sub 1 1\n";
  }
  return text;
}

/// Facets found by masks, lists and blockers of late, and none of that.
class Sights : public testing::Test {
 protected:
  Sights() : scene(furnished()), seeking(scene.geometry, scene.loaded.scene, FlagMode::kAuto), trying(scene.geometry) {
    EXPECT_TRUE(seeking.take_flags(scene.loaded.arena) && seeking.start(scene.loaded.arena));
    Options off;
    off.flags = FlagMode::kOff;
    const std::size_t before = scene.loaded.arena.used();
    EXPECT_TRUE(sight.take(scene.loaded.arena, scene.geometry, {}).done());
    EXPECT_EQ(scene.loaded.arena.used() - before, Sight::bytes(scene.geometry, {}));
    EXPECT_TRUE(twin.take(scene.loaded.arena, scene.geometry, off).done());
    EXPECT_EQ(Sight::bytes(scene.geometry, off), 0u);
    sight.start(seeking);
    twin.start(trying);
    sight.turn_to(link, 0, seeking);
    twin.turn_to(link, 0, trying);
  }
  LatticeBox node(Random& random) const {
    const LatticeBox box = random_box(random, 1 << between(random, 8, 17), false);
    LatticeBox inside;
    inside.include(random_point(random, box));
    inside.include(random_point(random, box));
    return inside;
  }
  ~Sights() override { seeking.finish(); }

  AmbientScene scene;
  Intersector seeking, trying;
  Sight sight, twin;
  const Link link{0, 1, LightSet::kAmbient};
};

TEST_F(Sights, SayThatNothingIsBetweenWhereNoFacetIsInTheShaft) {
  Random random(5);
  int clear = 0;
  for (int pair = 0; pair < 4000; ++pair) {
    const LatticeBox a = node(random), b = pair % 2 == 0 ? node(random) : random_part(random, a);
    const bool expected = twin.clear(a, b);
    ASSERT_EQ(sight.clear(a, b), expected) << pair;
    ASSERT_EQ(sight.list(a, b), expected) << pair;
    if (expected) ++clear;
  }
  EXPECT_GT(clear, 100);
  EXPECT_LT(clear, 3900);
}

TEST_F(Sights, BlockTheSegmentsThatAnyTriangleBlocks) {
  Random random(6);
  int blocked = 0, clear = 0;
  for (int pair = 0; pair < 4000; ++pair) {
    const LatticeBox a = node(random), b = node(random);
    LatticePoint p = random_point(random, a), q = random_point(random, b);
    if (sight.list_unless_blocked(p, q, a, b)) {
      ++clear;
      EXPECT_FALSE(trying.blocked(p, q, link));
      continue;
    }
    for (int k = 0; k < 6; ++k) {
      const bool expected = trying.blocked(p, q, link);
      ASSERT_EQ(sight.blocked(p, q, link, seeking), expected) << pair;
      if (expected) ++blocked;
      p = random_point(random, a);
      q = random_point(random, b);
    }
  }
  EXPECT_GT(blocked, 2000);
  EXPECT_GT(clear, 10);
}

}  // namespace
}  // namespace shodo
