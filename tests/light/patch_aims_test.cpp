// The list of what can come between a patch and a light, against aims from the tree of all facets.
#include "light/patch_aims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "visibility/scenes.h"

namespace shodo {
namespace {

using Facets = std::vector<std::uint32_t>;

Facets sorted(const Aim& aim) {
  EXPECT_FALSE(aim.any_triangle);
  Facets facets(aim.facets.begin(), aim.facets.end());
  std::sort(facets.begin(), facets.end());
  return facets;
}

/// Boxes and triangles within 4 x 4 x 4, and over them a bent sheet of 40 x 40 cells: more facets than are listed.
void build(HandMadeScene& scene, Random& random) {
  for (int k = 0; k < 60; ++k) {
    const Vec3 low{3.5 * random.unit(), 3.5 * random.unit(), 3.5 * random.unit()};
    scene.box(low, low + 0.4 * Vec3{random.unit(), random.unit(), random.unit()});
    const auto any = [&] { return 4 * Vec3{random.unit(), random.unit(), random.unit()}; };
    const Vec3 at = any();
    scene.triangle(at, at + 0.2 * any(), at + 0.2 * any());
  }
  std::vector<Vec3> sheet;
  for (int v = 0; v <= 40; ++v) {
    for (int u = 0; u <= 40; ++u) sheet.push_back({u * 0.1, v * 0.1, 4.5 + 0.01 * random.unit()});
  }
  scene.grid(41, 41, sheet);
  scene.place();
}

/// Closed, about a random place of the cube's lower part or anywhere; flat in one direction sometimes.
LatticeBox box_about(Random& random, std::int32_t size, std::int32_t highest) {
  const auto point = [&](std::int32_t reach) {
    return LatticePoint{random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)};
  };
  LatticePoint at = point(kLatticeHalf - size);
  if (at.z > highest) at.z = highest;
  LatticeBox box;
  box.include(at);
  const LatticePoint off = point(size);
  box.include(LatticePoint{at.x + off.x, at.y + off.y, random.below(3) == 0 ? at.z : at.z + off.z});
  return box;
}

/// A part of it.
LatticeBox part_of(Random& random, const LatticeBox& box) {
  LatticeBox part;
  for (int k = 0; k < 2; ++k) {
    part.include(LatticePoint{random.between(box.low[0], box.high[0]), random.between(box.low[1], box.high[1]),
                              random.between(box.low[2], box.high[2])});
  }
  return part;
}

TEST(PatchAims, FindTheFacetsThatTheTreeFinds) {
  Random random(1);
  HandMadeScene scene;
  build(scene, random);
  ASSERT_TRUE(scene.status.done());
  Intersector listed(scene.geometry, scene.scene, FlagMode::kAuto);
  Intersector tree(scene.geometry, scene.scene, FlagMode::kAuto);
  ASSERT_TRUE(listed.start(scene.arena) && tree.start(scene.arena));
  constexpr std::uint32_t kLights = 3, kSun = 3;
  PatchAims aims(listed);
  const std::size_t before = scene.arena.used();
  ASSERT_TRUE(aims.take(scene.arena, kLights + 1));
  EXPECT_EQ(scene.arena.used() - before, PatchAims::bytes(kLights + 1));
  std::uint64_t found = 0, longest = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const LatticeBox patch = box_about(random, 1 << (8 + random.below(11)), 0);
    LatticeBox whole[kLights];
    for (LatticeBox& light : whole) light = box_about(random, 1 << (8 + random.below(11)), kLatticeHalf);
    if (trial % 10 == 0) {  // the first list doesn't fit, those after it may
      whole[0].include(LatticePoint{-kLatticeHalf, -kLatticeHalf, kLatticeHalf});
      whole[0].include(LatticePoint{kLatticeHalf, kLatticeHalf, kLatticeHalf});
    }
    const LatticeVector sun = lattice_direction({random.signed_unit(), random.signed_unit(), random.unit()});
    aims.start(patch, false);
    for (int s = 0; s < 12; ++s) {
      LatticeBox from = part_of(random, patch);
      if (s % 4 == 3) from.include(LatticePoint{patch.high[0] + 1, from.low[1], from.low[2]});  // leaves the patch
      for (std::uint32_t l = 0; l < kLights; ++l) {
        const LatticeBox ends = part_of(random, whole[l]);
        const Facets expected = sorted(tree.aim(from, ends, {}));
        EXPECT_EQ(sorted(aims.towards(l, {}, from, ends, whole[l])), expected);
        found += expected.size();
        longest = std::max<std::uint64_t>(longest, expected.size());
      }
      EXPECT_EQ(sorted(aims.along(kSun, {}, from, sun)), sorted(tree.aim_along(from, sun, {})));
    }
  }
  EXPECT_GT(found, 20000u);
  EXPECT_GT(longest, 1024u);
}

/// From one sample nothing is sifted: shadows are those of all triangles all the same.
TEST(PatchAims, FromASingleSampleHideWhatAllTrianglesHide) {
  Random random(3);
  HandMadeScene scene;
  build(scene, random);
  Intersector listed(scene.geometry, scene.scene, FlagMode::kAuto);
  ASSERT_TRUE(listed.start(scene.arena, Rectangles::kWhole));
  Intersector off(scene.geometry);
  PatchAims aims(listed);
  ASSERT_TRUE(aims.take(scene.arena, 1));
  int none = 0, some = 0, gridded = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const LatticeBox patch = box_about(random, 1 << (8 + random.below(10)), 0);
    const LatticeBox light = box_about(random, 1 << (8 + random.below(10)), kLatticeHalf);
    aims.start(patch, false);
    std::vector<LatticePoint> ends;
    LatticeBox around;
    for (int k = 0; k < 32; ++k) {
      const LatticeBox at = part_of(random, light);
      ends.push_back({at.low[0] | 1, at.low[1] | 1, at.low[2] | 1});
      around.include(ends.back());
    }
    LatticeBox whole = light;
    whole.include(around);
    const LatticeBox within = part_of(random, patch);
    const LatticePoint from{within.low[0] | 1, within.low[1] | 1, within.low[2] | 1};
    LatticeBox at;
    at.include(from);
    if (!patch.contains(from, 0)) continue;
    const EndGrid grid(ends, around);
    const std::uint32_t wanted = random.below(0xFFFFFFFF);
    const Segments segments{from, ends, around};
    const Aim aim = aims.towards(0, {}, at, around, whole, grid.usable() ? &grid : nullptr);
    const std::uint32_t expected = off.shadow(segments, wanted, {}, Aim{});
    EXPECT_EQ(listed.shadow(segments, wanted, {}, aim), expected);
    (expected == 0 ? none : some) += 1;
    gridded += grid.usable() ? 1 : 0;
  }
  EXPECT_GT(none, 100);
  EXPECT_GT(some, 100);
  EXPECT_GT(gridded, 100);
}

/// All of a light, or nothing, is shown only where every single segment says so.
TEST(PatchAims, ShowAllOfALightOrNothingOnlyWhereEverySegmentDoes) {
  Random random(2);
  HandMadeScene scene;
  build(scene, random);
  Intersector listed(scene.geometry, scene.scene, FlagMode::kAuto);
  ASSERT_TRUE(listed.start(scene.arena, Rectangles::kWhole) && listed.take_masks(scene.arena));
  Intersector off(scene.geometry);
  PatchAims aims(listed);
  ASSERT_TRUE(aims.take(scene.arena, 1));
  int all = 0, nothing = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const LatticeBox patch = box_about(random, 1 << (4 + random.below(10)), 0);
    const LatticeBox light = box_about(random, 1 << (4 + random.below(10)), kLatticeHalf);
    aims.start(patch, true);
    const Shown shown = aims.shown(0, {}, light);
    if (shown == Shown::kUnknown) continue;
    (shown == Shown::kAll ? all : nothing) += 1;
    for (int s = 0; s < 8; ++s) {
      const LatticeBox from = part_of(random, patch), to = part_of(random, light);
      const LatticePoint p{from.low[0] | 1, from.low[1] | 1, from.low[2] | 1};
      const LatticePoint q{to.low[0] | 1, to.low[1] | 1, to.low[2] | 1};
      if (!patch.contains(p, 0) || !light.contains(q, 0)) continue;
      EXPECT_EQ(off.blocked(p, q, {}), shown == Shown::kNothing);
    }
  }
  EXPECT_GT(all, 50);
  EXPECT_GT(nothing, 5);
}

TEST(PatchAims, WithFlagsOffKnowNothing) {
  Random random(1);
  HandMadeScene scene;
  build(scene, random);
  Intersector off(scene.geometry);
  PatchAims aims(off);
  ASSERT_TRUE(aims.take(scene.arena, 1));
  const LatticeBox box = box_about(random, 1000, 0);
  aims.start(box, true);
  EXPECT_EQ(aims.shown(0, {}, box), Shown::kUnknown);
  EXPECT_TRUE(aims.towards(0, {}, box, box, box).any_triangle);
  EXPECT_FALSE(aims.towards(0, {}, box, box, box).clear());
}

}  // namespace
}  // namespace shodo
