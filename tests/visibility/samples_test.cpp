// Samples, point lights, patches, hidden samples, and the intersector's answers and counts.
#include <gtest/gtest.h>

#include "scenes.h"
#include "slow_twin.h"
#include "visibility/hidden.h"

namespace shodo {
namespace {

bool odd(const LatticePoint& p) { return (p.x & 1) != 0 && (p.y & 1) != 0 && (p.z & 1) != 0; }

bool all_blocked(const Geometry& geometry, const LatticePoint& p, const LatticePoint& q) {
  Intersector intersector(geometry);
  return intersector.blocked(p, q, {});
}

TEST(Samples, StandOddAndCloseInFrontOfTheirOwnTriangles) {
  Random random(1);
  for (int k = 0; k < 300; ++k) {
    HandMadeScene scene;
    // A parallelogram turned any way, a triangle, and a quad bent by up to a third of its size.
    const Vec3 a{random.signed_unit(), random.signed_unit(), random.signed_unit()};
    const Vec3 b{random.signed_unit(), random.signed_unit(), random.signed_unit()};
    scene.quad({}, a, a + b, b);
    scene.triangle({2, 0, 0}, Vec3{2, 0, 0} + a, Vec3{2, 0, 0} + b);
    const bool bent = k % 2 != 0;
    const double bend = bent ? 0.3 * random.unit() : 0;
    scene.quad({4, 0, 0}, Vec3{5, 0, bend}, Vec3{5, 1, 0}, Vec3{4, 1, bend});
    const std::uint32_t light =
        scene.area_light({6, 0, 0}, Vec3{6, 0, 0} + a, Vec3{6, 0, 0} + a + b, Vec3{6, 0, 0} + b, k % 3 == 0);
    scene.place();
    ASSERT_TRUE(scene.status.done());
    const double step = scene.geometry.lattice.step();
    for (int s = 0; s < 30; ++s) {
      for (std::uint32_t m = 0; m < 4; ++m) {
        Piece cell;
        if (m < 3) {
          cell = cell_piece(scene.scene, scene.scene.meshes[m], 0);
        } else {
          for (int c = 0; c < 4; ++c) cell.corner[c] = scene.scene.lights[light].corners[c];
        }
        double u = random.unit(), v = random.unit();
        if (cell.corners == 3 && u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        const Vec3 point = cell.point(u, v);
        const LatticePoint p = m < 3 ? sample_point(scene.scene, scene.geometry, m, 0, point)
                                     : light_sample_point(scene.scene, scene.geometry, light, point);
        EXPECT_TRUE(odd(p));
        const Vec3 at = scene_point(scene.geometry.lattice, p);
        // One step of rounding, and along the dominant axis up to 6 for the surface's and the sample's own, and 2 more.
        if (m != 2 || !bent) {
          EXPECT_LT(length(at - point), 11 * step);
        }
        // Strictly in front of the triangle under it: a step back along the axis passes through.
        const Vec3 n = cell.vector_area();
        const double size = std::fmax(std::fabs(n.x), std::fmax(std::fabs(n.y), std::fabs(n.z)));
        LatticePoint back = p;
        if (std::fabs(n.x) == size) {
          back.x += n.x > 0 ? -200000 : 200000;
        } else if (std::fabs(n.y) == size) {
          back.y += n.y > 0 ? -200000 : 200000;
        } else {
          back.z += n.z > 0 ? -200000 : 200000;
        }
        if (m < 3 && u > 0.001 && v > 0.001 && u < 0.999 && v < 0.999 && (cell.corners == 4 || u + v < 0.999)) {
          EXPECT_TRUE(all_blocked(scene.geometry, p, back));
        }
      }
    }
  }
}

TEST(Samples, OnAnAxisAlignedFaceTheyAreOneStepAbove) {
  HandMadeScene scene;
  scene.box({0, 0, 0}, {1, 2, 3});
  scene.place();
  for (std::uint32_t m = 0; m < 6; ++m) {
    const Piece cell = cell_piece(scene.scene, scene.scene.meshes[m], 0);
    const LatticePoint p = sample_point(scene.scene, scene.geometry, m, 0, cell.centre());
    const Triangle& t = scene.geometry.triangles[scene.geometry.cells[scene.geometry.first_cell[m]].first];
    const LatticeVector n = t.n;
    const std::int64_t size = std::max({std::llabs(n.x), std::llabs(n.y), std::llabs(n.z)});
    EXPECT_EQ(t.side(p), size);
  }
}

/// The two faces of a wall, x0 <= x1, cut into quads: the lit one faces -x, the dark one +x.
enum class Cuts { kOneAgainstSix, kAlike, kOtherDiagonal, kSixAgainstSix };

struct ThinWall {
  std::vector<std::uint32_t> lit, dark;

  ThinWall(HandMadeScene& scene, double x0, double x1, Cuts cuts) {
    const bool six = cuts == Cuts::kSixAgainstSix, against_six = six || cuts == Cuts::kOneAgainstSix;
    cut(six ? 2 : 1, six ? 3 : 1, [&](double y0, double y1, double z0, double z1) {
      lit.push_back(scene.quad({x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}, {x0, y1, z0}));
    });
    cut(against_six ? 3 : 1, against_six ? 2 : 1, [&](double y0, double y1, double z0, double z1) {
      dark.push_back(cuts == Cuts::kOtherDiagonal
                         ? scene.quad({x1, y1, z0}, {x1, y1, z1}, {x1, y0, z1}, {x1, y0, z0})
                         : scene.quad({x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x1, y0, z1}));
    });
  }

 private:
  template <class Put>
  static void cut(int along_y, int along_z, Put put) {
    for (int i = 0; i < along_y; ++i) {
      for (int j = 0; j < along_z; ++j) {
        put(3.0 * i / along_y, 3.0 * (i + 1) / along_y, 2.0 * j / along_z, 2.0 * (j + 1) / along_z);
      }
    }
  }
};

struct Lost {
  int samples = 0, lost = 0, leaks = 0, unturned = 0;
};

/// 40 rooms with a thin wall, the first not turned: segments from both of its faces into both halves of the room.
Lost thin_walls(double thickness, Cuts cuts) {
  Random random(2);
  Lost count;
  for (int k = 0; k < 40; ++k) {
    HandMadeScene scene;
    const double x0 = 2 + 0.1 * random.unit();
    scene.box({0, 0, 0}, {4, 3, 2}, true);
    scene.object();
    const ThinWall wall(scene, x0, x0 + thickness, cuts);
    const Vec3 axis{random.signed_unit(), random.signed_unit(), 1.1};
    const double angle = k > 0 ? 3 * random.signed_unit() : 0;
    const auto turn = [&](const Vec3& v) { return k > 0 ? turned(v, axis, angle) : v; };
    scene.transform(turn);
    scene.place();
    EXPECT_TRUE(scene.status.done());
    const auto point = [&](double x) {
      return odd_point(scene.geometry.lattice,
                       turn({x, 0.1 + 2.8 * random.unit(), 0.1 + 1.8 * random.unit()}) - scene.scene.origin);
    };
    const auto look = [&](std::uint32_t m, const LatticePoint& own, const LatticePoint& beyond) {
      const Piece cell = cell_piece(scene.scene, scene.scene.meshes[m], 0);
      const auto sample = [&](double u, double v) {
        return sample_point(scene.scene, scene.geometry, m, 0, cell.point(u, v));
      };
      count.leaks += all_blocked(scene.geometry, sample(random.unit(), random.unit()), beyond) ? 0 : 1;
      const double u = 0.05 + 0.9 * random.unit(), v = 0.05 + 0.9 * random.unit();
      const bool lost = all_blocked(scene.geometry, sample(u, v), own);
      ++count.samples;
      count.lost += lost ? 1 : 0;
      count.unturned += lost && k == 0 ? 1 : 0;
    };
    for (int s = 0; s < 60; ++s) {
      const LatticePoint lit = point(0.1 + 1.8 * random.unit()), dark = point(2.2 + 1.7 * random.unit());
      look(wall.lit[random.below(static_cast<std::uint32_t>(wall.lit.size()))], lit, dark);
      look(wall.dark[random.below(static_cast<std::uint32_t>(wall.dark.size()))], dark, lit);
    }
  }
  return count;
}

TEST(ThinWalls, TheDarkSideIsDarkAndTheLitSideLitAtEveryThickness) {
  // A wall of two faces back to back, cut alike and not, from 1e-3 of the scene's size to nothing, turned and not.
  // Nothing passes. Of a turned wall, whose faces rounding and mending send through each other below some 12 steps, at
  // most 1 % of the samples are lost; of an unturned one none.
  constexpr double kSize = 5.385;  // the room's diagonal
  for (const Cuts cuts : {Cuts::kOneAgainstSix, Cuts::kAlike, Cuts::kOtherDiagonal, Cuts::kSixAgainstSix}) {
    for (const double relative : {1e-3, 2e-5, 1e-5, 8e-6, 6e-6, 5e-6, 4e-6, 2e-6, 1e-6, 1e-7, 0.0}) {
      SCOPED_TRACE(relative);
      const Lost count = thin_walls(relative * kSize, cuts);
      EXPECT_EQ(count.samples, 40 * 60 * 2);
      EXPECT_EQ(count.leaks, 0);
      EXPECT_EQ(count.unturned, 0);
      EXPECT_LE(count.lost, count.samples / 100);
    }
  }
}

/// Two rooms side by side; the wall between is two quads back to back at x = 2, the first room's before.
void two_rooms(HandMadeScene& scene) {
  scene.box({0, 0, 0}, {2, 3, 2}, true);
  scene.box({2, 0, 0}, {4, 3, 2}, true);
}

TEST(PointLights, OnASurfaceStandInFrontOfItAndLeaveTheNextRoomDark) {
  Random random(3);
  const Vec3 places[] = {{1, 1, 2},  // on the first room's ceiling
                         {2, 1, 1},  // on the wall between
                         {2, 1, 2},  // on its edge with the ceiling
                         {2, 3, 2},  // in the corner
                         {0, 0, 0}, {1.3, 0, 0}};
  for (const Vec3& place : places) {
    for (int k = 0; k < 40; ++k) {
      HandMadeScene scene;
      if (k % 2 != 0) {  // both faces of the wall before everything else
        scene.quad({2, 0, 0}, {2, 0, 2}, {2, 3, 2}, {2, 3, 0});
        scene.quad({2, 0, 0}, {2, 3, 0}, {2, 3, 2}, {2, 0, 2});
      }
      two_rooms(scene);
      const std::uint32_t light = scene.point_light(place);
      const Vec3 axis{random.signed_unit(), random.signed_unit(), 1.1};
      const double angle = k == 0 ? 0 : 3 * random.signed_unit();
      scene.transform([&](const Vec3& v) { return turned(v, axis, angle); });
      scene.place();
      ASSERT_TRUE(scene.status.done());
      const LatticePoint at = scene.geometry.light_points[light];
      EXPECT_TRUE(odd(at));
      const Vec3 given = scene.scene.lights[light].position;
      EXPECT_LT(length(scene_point(scene.geometry.lattice, at) - given), 40 * scene.geometry.lattice.step());
      for (int s = 0; s < 50; ++s) {
        const double y = 0.1 + 2.8 * random.unit(), z = 0.1 + 1.8 * random.unit(), x = 0.1 + 1.8 * random.unit();
        const auto point = [&](double dx) {
          return odd_point(scene.geometry.lattice, turned({x + dx, y, z}, axis, angle) - scene.scene.origin);
        };
        EXPECT_FALSE(all_blocked(scene.geometry, point(0), at)) << place.x << " " << place.y << " " << place.z;
        EXPECT_TRUE(all_blocked(scene.geometry, point(2), at)) << place.x << " " << place.y << " " << place.z;
      }
    }
  }
}

TEST(PointLights, InTheOpenStayWhereTheyAre) {
  HandMadeScene scene;
  two_rooms(scene);
  const std::uint32_t light = scene.point_light({1.1, 1.2, 1.3});
  scene.place();
  EXPECT_EQ(scene.geometry.light_points[light], odd_point(scene.geometry.lattice, scene.scene.lights[light].position));
}

TEST(Patches, HaveTheirGeometryAndDropWhatIsTooThin) {
  HandMadeScene scene;  // 4 units wide: 2^18 steps a unit at most
  scene.quad({0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}, 2, 1, 2, 3);
  const double step = 4.0 / (1 << 20);  // the lattice's, checked below
  scene.quad({0, 3, 0}, {2, 3, 0}, {2, 3 + 3.5 * 2 * step, 0}, {0, 3 + 3.5 * 2 * step, 0}, 1, 2);  // 3.5 and 3.5 steps
  scene.quad({0, 2.5, 0}, {2, 2.5, 0}, {2, 2.5 + 20 * step, 0}, {0, 2.5 + 20 * step, 0});          // 20 steps: thin
  scene.quad({0, 2.6, 0}, {2, 2.6, 0}, {2, 2.6 + 33 * step, 0}, {0, 2.6 + 33 * step, 0});          // 33 steps: not
  scene.triangle({3, 3, 0}, {3, 3, 0}, {3.5, 3, 0});                                               // no area
  scene.place(2.0 - 1e-4);
  ASSERT_TRUE(scene.status.done());
  ASSERT_EQ(scene.geometry.lattice.step(), step);
  std::span<Patch> patches;
  Statistics statistics;
  ASSERT_TRUE(build_patches(scene.scene, scene.geometry, scene.arena, patches, statistics).done());
  ASSERT_EQ(patches.size(), 7u);
  EXPECT_EQ(patches[1].centre, (Vec3{3, 1, 0}));
  EXPECT_EQ(patches[1].normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(patches[1].area, 4);
  EXPECT_EQ(patches[1].longest_side, 2);
  const int dropped[7] = {0, 0, 1, 1, 0, 0, 1}, thin[7] = {0, 0, 1, 1, 1, 0, 1};
  for (int k = 0; k < 7; ++k) {
    EXPECT_EQ(patches[static_cast<std::size_t>(k)].dropped, dropped[k]) << k;
    EXPECT_EQ(patches[static_cast<std::size_t>(k)].thin, thin[k]) << k;
  }
  EXPECT_EQ(statistics.patches, 4u);
  EXPECT_EQ(statistics.sub_patches, 2u * 6 + 2);
  EXPECT_EQ(statistics.patches_dropped, 3u);
  EXPECT_EQ(statistics.patches_thin, 1u);
  EXPECT_EQ(sample_inset(patches[4]), 0.25);
  EXPECT_EQ(sample_inset(patches[0]), 0);
}

TEST(Hidden, UnderABoxThatStandsOnAFloorAndInsideIt) {
  Random random(4);
  for (int k = 0; k < 60; ++k) {
    HandMadeScene scene;
    scene.box({0, 0, 0}, {4, 4, 3}, true);
    scene.object();
    scene.box({1, 1, 0}, {2, 2.5, 1});  // with a bottom, on the floor
    scene.object();
    scene.box({2.5, 2, -0.2}, {3, 3, 0.5});  // half sunk
    const Vec3 axis{random.signed_unit(), random.signed_unit(), 1.1};
    const double angle = k == 0 ? 0 : 3 * random.signed_unit();
    scene.transform([&](const Vec3& v) { return turned(v, axis, angle); });
    scene.place();
    ASSERT_TRUE(scene.status.done());
    Intersector intersector(scene.geometry);
    const std::uint32_t floor = 0;  // facing +z
    const Vec3 up = turned({0, 0, 1}, axis, angle);
    for (int s = 0; s < 100; ++s) {
      const double x = 4 * random.unit(), y = 4 * random.unit();
      const auto within = [&](double margin) {
        return (x > 1 + margin && x < 2 - margin && y > 1 + margin && y < 2.5 - margin) ||
               (x > 2.5 + margin && x < 3 - margin && y > 2 + margin && y < 3 - margin);
      };
      if (within(-1e-3) != within(1e-3)) continue;
      const Vec3 point = turned({x, y, 0}, axis, angle) - scene.scene.origin;
      const LatticePoint p = sample_point(scene.scene, scene.geometry, floor, 0, point);
      EXPECT_EQ(hidden_samples(intersector, {&p, 1}, up), within(0) ? 1u : 0u) << x << ", " << y;
    }
  }
}

// Furniture at a wall, without a back of its own: from inside one sees the wall's front, and a skirting's.
TEST(Hidden, UnderABoxThatLeansOnAWallAndHasNoBack) {
  HandMadeScene scene;
  scene.box({0, 0, 0}, {4, 4, 3}, true);
  scene.object();
  scene.quad({0, 0, 0.1}, {4, 0, 0.1}, {4, 0.02, 0}, {0, 0.02, 0});  // skirting
  scene.object();
  scene.quad({1, 0, 1}, {2, 0, 1}, {2, 0.8, 1}, {1, 0.8, 1});  // top, front, two sides
  scene.quad({1, 0.8, 0}, {1, 0.8, 1}, {2, 0.8, 1}, {2, 0.8, 0});
  scene.quad({1, 0, 0}, {1, 0, 1}, {1, 0.8, 1}, {1, 0.8, 0});
  scene.quad({2, 0, 0}, {2, 0.8, 0}, {2, 0.8, 1}, {2, 0, 1});
  scene.place();
  ASSERT_TRUE(scene.status.done());
  Intersector intersector(scene.geometry);
  Random random(9);
  const std::uint32_t floor = 0;
  for (int s = 0; s < 400; ++s) {
    const double x = 0.5 + 2 * random.unit(), y = 0.05 + 1.5 * random.unit();
    const auto within = [&](double margin) { return x > 1 + margin && x < 2 - margin && y < 0.8 - margin; };
    if (within(-1e-3) != within(1e-3)) continue;
    const LatticePoint p = sample_point(scene.scene, scene.geometry, floor, 0, Vec3{x, y, 0} - scene.scene.origin);
    EXPECT_EQ(hidden_samples(intersector, {&p, 1}, {0, 0, 1}), within(0) ? 1u : 0u) << x << ", " << y;
  }
}

TEST(Hidden, SamplesTogetherAreFoundAsOneByOne) {
  Random random(11);
  HandMadeScene scene;
  scene.box({0, 0, 0}, {4, 4, 3}, true);
  for (int k = 0; k < 20; ++k) {
    const Vec3 low{3 * random.unit(), 3 * random.unit(), -0.2 + 0.3 * random.unit()};
    scene.box(low, low + Vec3{0.2 + random.unit(), 0.2 + random.unit(), 0.2 + random.unit()});
  }
  scene.place();
  ASSERT_TRUE(scene.status.done());
  Intersector off(scene.geometry), on(scene.geometry, scene.scene, FlagMode::kAuto);
  ASSERT_TRUE(on.start(scene.arena));
  std::uint32_t all_hidden = 0, mixed = 0;
  for (int k = 0; k < 300; ++k) {
    LatticePoint samples[kMostHiddenSamples];
    const std::uint32_t count = 1 + random.below(kMostHiddenSamples);
    const double size = random.below(2) == 0 ? 0.05 : 1.5;
    const Vec3 corner = Vec3{0.1 + 2.3 * random.unit(), 0.1 + 2.3 * random.unit(), 0} - scene.scene.origin;
    std::uint32_t expected = 0;
    for (std::uint32_t s = 0; s < count; ++s) {
      const Vec3 point = corner + size * Vec3{random.unit(), random.unit(), 0};
      samples[s] = sample_point(scene.scene, scene.geometry, 0, 0, point);
      expected |= hidden_samples(off, {&samples[s], 1}, {0, 0, 1}) << s;
    }
    const std::uint32_t all = (std::uint32_t{1} << count) - 1;
    for (Intersector* intersector : {&off, &on}) {
      EXPECT_EQ(hidden_samples(*intersector, {samples, count}, {0, 0, 1}), expected);
      // What is hidden lies under backs, and what doesn't isn't hidden.
      const bool under = under_backs(*intersector, {samples, count}, {0, 0, 1});
      std::uint32_t apart = 0;
      for (const LatticePoint& sample : std::span(samples, count)) {
        apart += under_backs(off, {&sample, 1}, {0, 0, 1}) ? 1u : 0u;
      }
      EXPECT_EQ(under, apart == count);
      EXPECT_LE(expected == all, under);
    }
    all_hidden += expected == all ? 1 : 0;
    mixed += expected != 0 && expected != all ? 1 : 0;
  }
  EXPECT_GT(all_hidden, 20u);
  EXPECT_GT(mixed, 20u);
}

TEST(Intersector, NearestMatchesTheTwin) {
  Random random(5);
  std::uint64_t hits = 0, ties = 0;
  for (int k = 0; k < 200; ++k) {
    HandMadeScene scene;
    const bool coarse = k % 2 == 0;  // few places: many coplanar triangles, equal ones, and common edges
    for (int t = 0; t < 40; ++t) {
      Vec3 v[3];
      for (Vec3& p : v) {
        p = coarse ? Vec3{random.below(4) / 3.0, random.below(4) / 3.0, random.below(3) / 3.0}
                   : Vec3{random.unit(), random.unit(), random.unit()};
      }
      scene.triangle(v[0], v[1], v[2]);
    }
    scene.place();
    Intersector intersector(scene.geometry);
    for (int s = 0; s < 100; ++s) {
      const LatticePoint p =
          odd_point(scene.geometry.lattice, {random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5});
      const auto& triangles = scene.geometry.triangles;
      const Triangle& aim = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
      const LatticeVector d =
          random.below(2) != 0 ? aim.a - p
                               : lattice_direction({random.signed_unit(), random.signed_unit(), random.signed_unit()});
      Hit best;
      twin::Wide numerator = 0, denominator = 1;
      for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const twin::Meeting m =
            twin::meet(triangles[t].a, triangles[t].b, triangles[t].c, twin::of(p), twin::of(d), false);
        if (!m.blocks) continue;
        // 2^62 x 2^62 fits 128 bits.
        const twin::Wide mine = m.numerator * denominator, other = numerator * m.denominator;
        ties += best.triangle != kNone && mine == other ? 1 : 0;
        if (best.triangle == kNone || mine < other || (mine == other && m.front && !best.front)) {
          best = {t, m.front};
          numerator = m.numerator;
          denominator = m.denominator;
        }
      }
      const Hit hit = intersector.nearest(p, d);
      EXPECT_EQ(hit.triangle, best.triangle);
      EXPECT_EQ(hit.front, best.triangle != kNone && best.front);
      hits += best.triangle != kNone ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 10000u);
  EXPECT_GT(ties, 1000u);
}

TEST(Intersector, CountsTestsUpToTheFirstBlockerInFileOrder) {
  HandMadeScene scene;
  for (int k = 0; k < 4; ++k) {
    const double z = k;
    scene.quad({0, 0, z}, {4, 0, z}, {4, 4, z}, {0, 4, z});
  }
  scene.place();
  Intersector intersector(scene.geometry);
  const auto at = [&](double x, double y, double z) {
    return odd_point(scene.geometry.lattice, Vec3{x, y, z} - scene.scene.origin);
  };
  EXPECT_TRUE(intersector.blocked(at(3, 1, 0.5), at(3, 1, 2.5), {}));
  EXPECT_EQ(intersector.tests(LightSet::kDirect), 3u);  // both of the first quad, then the second's first
  EXPECT_FALSE(intersector.blocked(at(3, 1, 0.4), at(3, 1, 0.6), {}));
  EXPECT_EQ(intersector.tests(LightSet::kDirect), 11u);
  EXPECT_TRUE(intersector.ray_blocked(at(1, 3, 2.5), {0, 0, 1 << 20}, {kNone, kNone, LightSet::kAmbient}));
  EXPECT_EQ(intersector.tests(LightSet::kAmbient), 8u);
  EXPECT_EQ(intersector.segments(LightSet::kDirect), 2u);
  EXPECT_EQ(intersector.segments(LightSet::kAmbient), 1u);
}

}  // namespace
}  // namespace shodo
