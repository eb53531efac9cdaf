// What must not change when a scene is written, placed or cut in another way, and to how many digits.
//
// To the bit: the order of objects and polygons (patches, maps and picture), exact shifts, scale by powers of two
// (E of point lights times 1 / s^2), an object that is hidden, black and far, but within the scene's box. To 1e-12 of
// the largest E, with
// --tolerance 1e-13 --row-values 64: rotation by 90 degrees, mirroring, splitting a polygon along its patches.
// Shadows are decided on the lattice, which maps on itself under all of these.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "hard/variants.h"

namespace shodo::hard {
namespace {

/// Asked for of what isn't equal to the bit.
constexpr double kDigits = 1e-12;

/// A room with a table, a slanted board and lights of three kinds; nothing symmetric.
void furnish(SceneText& scene) {
  scene.material("white", 0.7);
  scene.material("dark", 0.3);
  scene.object("room");
  scene.room({0, 0, 0}, {3.1, 2.3, 1.9}, 4, 2);
  scene.object("table");
  scene.use("dark");
  scene.box({0.7, 0.6, 0.4}, {1.5, 1.3, 0.7}, 2, 2);
  scene.object("board");
  scene.quad({2.1, 0.4, 0.3}, {2.6, 0.9, 0.3}, {2.4, 1.2, 1.1}, {1.9, 0.7, 1.1}, 3, 2, 2);
  scene.triangle({2.2, 1.5, 0.2}, {2.9, 1.6, 0.5}, {2.4, 2.1, 0.9});
  scene.use("white");
  scene.point_light({0.4, 1.7, 1.5}, 100);
  scene.area_light({1.7, 1.6, 1.87}, {1.7, 1.9, 1.87}, {2.2, 1.9, 1.87}, {2.2, 1.6, 1.87}, 2000);
  scene.camera("eye", {0.2, 0.3, 1.1}, {2.8, 1.7, 0.6}, {0, 0, 1}, 75);
}

struct Variant {
  explicit Variant(Map map = {}, bool mirrored = false, std::uint64_t shuffle = 0) : scene(std::move(map), mirrored) {
    furnish(scene);
    run = std::make_unique<FullRun>(scene.text(shuffle), to_the_last_digits());
    EXPECT_TRUE(run->done()) << run->status.message;
    patches = by_key(*run, scene);
  }
  SceneText scene;
  std::unique_ptr<FullRun> run;
  std::vector<Keyed> patches;
};

const Variant& plain() {
  static const Variant variant;
  return variant;
}

bool same_bits(const std::vector<Keyed>& a, const std::vector<Keyed>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].e0 != b[k].e0 || a[k].total != b[k].total || a[k].map != b[k].map) return false;
  }
  return true;
}

TEST(Metamorphic, TheOrderOfObjectsAndPolygonsChangesNoBit) {
  const std::vector<std::uint8_t> pixels = Variant().run->picture();
  for (std::uint64_t seed = 1; seed <= (thorough() ? 40 : 4); ++seed) {
    Variant shuffled({}, false, seed);
    EXPECT_TRUE(same_bits(shuffled.patches, plain().patches))
        << seed << ": " << difference(plain().patches, shuffled.patches);
    EXPECT_EQ(shuffled.run->picture(), pixels);
  }
}

TEST(Metamorphic, AnExactShiftChangesNoBit) {
  // Multiples of 2^-40 below 4 stay exact up to 2^12.
  const auto grid = [](const Vec3& v) {
    const auto on = [](double x) { return std::nearbyint(x * 0x1p40) * 0x1p-40; };
    return Vec3{on(v.x), on(v.y), on(v.z)};
  };
  Variant still([=](const Vec3& v) { return grid(v); });
  const std::vector<std::uint8_t> pixels = still.run->picture();
  for (const Vec3& by : {Vec3{1, -2, 3}, Vec3{1000, 2000, -500}, Vec3{-0.125, 0.0625, 4000}}) {
    Variant moved([=](const Vec3& v) { return grid(v) + by; });
    EXPECT_TRUE(same_bits(moved.patches, still.patches)) << difference(still.patches, moved.patches);
    EXPECT_EQ(moved.run->picture(), pixels);
  }
}

TEST(Metamorphic, ScaleByPowersOfTwoChangesNoBitButThePointLights) {
  // One kind of light at a time: E of both together isn't a power of two times the other.
  const auto make = [](double s, bool point) {
    SceneText scene([=](const Vec3& v) { return s * v; });
    scene.material("white", 0.7);
    scene.object("room");
    scene.room({0, 0, 0}, {3.1, 2.3, 1.9}, 4, 2);
    scene.object("board");
    scene.quad({2.1, 0.4, 0.3}, {2.6, 0.9, 0.3}, {2.4, 1.2, 1.1}, {1.9, 0.7, 1.1}, 3, 2, 2);
    if (point) {
      scene.point_light({0.4, 1.7, 1.5}, 100);
    } else {
      scene.area_light({1.7, 1.6, 1.87}, {1.7, 1.9, 1.87}, {2.2, 1.9, 1.87}, {2.2, 1.6, 1.87}, 2000);
    }
    return scene.text();
  };
  for (const bool point : {false, true}) {
    const FullRun still(make(1, point), to_the_last_digits());
    for (const double s : {0x1p-20, 0.5, 2.0, 4.0, 0x1p20}) {
      const FullRun run(make(s, point), to_the_last_digits());
      ASSERT_EQ(run.patches(), still.patches());
      const double factor = point ? 1 / (s * s) : 1;
      for (std::uint32_t i = 0; i < run.patches(); ++i) {
        EXPECT_EQ(run.e0(i), factor * still.e0(i)) << s;
        EXPECT_EQ(run.ambient(i), factor * still.ambient(i)) << s;
      }
    }
  }
}

TEST(Metamorphic, RotationBy90DegreesKeepsTwelveDigits) {
  const Map turns[] = {[](const Vec3& v) {
                         return Vec3{-v.y, v.x, v.z};
                       },
                       [](const Vec3& v) {
                         return Vec3{v.x, -v.z, v.y};
                       },
                       [](const Vec3& v) {
                         return Vec3{v.z, v.y, -v.x};
                       },
                       [](const Vec3& v) {
                         return Vec3{v.y, v.z, v.x};
                       },
                       [](const Vec3& v) {
                         return Vec3{-v.x, -v.y, v.z};
                       }};
  for (const Map& map : turns) {
    const double error = difference(plain().patches, Variant(map).patches);
    EXPECT_GE(error, 0);
    EXPECT_LE(error, kDigits);
  }
}

TEST(Metamorphic, MirroringKeepsTwelveDigits) {
  const Map mirrors[] = {[](const Vec3& v) {
                           return Vec3{-v.x, v.y, v.z};
                         },
                         [](const Vec3& v) {
                           return Vec3{v.x, v.y, -v.z};
                         },
                         [](const Vec3& v) {
                           return Vec3{v.y, v.x, v.z};
                         },
                         [](const Vec3& v) { return -1.0 * v; }};
  for (const Map& map : mirrors) {
    const double error = difference(plain().patches, Variant(map, true).patches);
    EXPECT_GE(error, 0);
    EXPECT_LE(error, kDigits);
  }
}

TEST(Metamorphic, SplittingAPolygonAlongItsPatchesKeepsTwelveDigits) {
  // A wall of 4 x 4 patches as one quad, and as 16; nothing else changes. Corners are binary fractions, so that the
  // parts' are the whole's.
  const auto make = [](bool split) {
    SceneText scene;
    scene.material("white", 0.7);
    scene.object("room");
    scene.quad({0, 0, 2}, {0, 2, 2}, {4, 2, 2}, {4, 0, 2}, 4, 4, 2);
    scene.quad({0, 0, 0}, {0, 0, 2}, {4, 0, 2}, {4, 0, 0}, 4, 4, 2);
    scene.quad({0, 2, 0}, {4, 2, 0}, {4, 2, 2}, {0, 2, 2}, 4, 4, 2);
    scene.object("board");
    scene.quad({2.125, 0.5, 0.25}, {2.625, 1, 0.25}, {2.375, 1.25, 1.125}, {1.875, 0.75, 1.125}, 3, 2, 2);
    scene.object("floor");
    for (int v = 0; v < (split ? 4 : 1); ++v) {
      for (int u = 0; u < (split ? 4 : 1); ++u) {
        const double x0 = u, x1 = split ? u + 1 : 4, y0 = 0.5 * v, y1 = split ? 0.5 * (v + 1) : 2;
        scene.quad({x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}, split ? 1 : 4, split ? 1 : 4, 2);
      }
    }
    scene.point_light({0.5, 1.5, 1.5}, 100);
    scene.point_light({3.5, 0.75, 1.75}, 100);
    return scene.text();
  };
  const FullRun whole(make(false), to_the_last_digits()), parts(make(true), to_the_last_digits());
  ASSERT_TRUE(whole.done() && parts.done());
  ASSERT_EQ(whole.patches(), parts.patches());  // patches of the floor stand in the same order
  const double error = difference(whole, parts);
  EXPECT_GE(error, 0);
  EXPECT_LE(error, kDigits);
}

TEST(Metamorphic, WhatNobodySeesAndWhatIsBlackAndFarChangeNothing) {
  // Within the box that the scene has anyway (a lamp far away makes it), so that the lattice is the same.
  const auto make = [](int with) {
    SceneText scene;
    scene.line("material black diffuse 0");
    furnish(scene);
    if (with == 1) {  // beyond the closed room's wall, black, in no light's way
      scene.object("far");
      scene.use("black");
      scene.box({30, 30, 30}, {31, 31, 31}, 2, 2);
    }
    if (with == 2) {  // a white box closed all round, in the open
      scene.object("unseen");
      scene.room({30, 30, 30}, {31, 31, 31}, 2, 2);
    }
    scene.camera("spare", {-40, -40, -40}, {0, 0, 0}, {0, 0, 1}, 30);
    scene.camera("spare2", {40, 40, 40}, {0, 0, 0}, {0, 0, 1}, 30);
    return scene.text();
  };
  FullRun without(make(0), to_the_last_digits());
  const auto pixels = without.picture();
  for (const int with : {1, 2}) {
    FullRun run(make(with), to_the_last_digits());
    ASSERT_TRUE(run.done());
    for (std::uint32_t i = 0; i < without.patches(); ++i) {
      ASSERT_EQ(run.e0(i), without.e0(i)) << with;
      // The coarse correction has one more group, so that sweeps go another way to the same end.
      ASSERT_NEAR(run.ambient(i), without.ambient(i), kDigits * without.largest()) << with;
    }
    EXPECT_EQ(run.picture(), pixels);
  }
}

}  // namespace
}  // namespace shodo::hard
