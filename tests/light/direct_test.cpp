// Direct light of whole scenes: shadows, hidden area, hard cases, means, counts, memory.
#include <gtest/gtest.h>

#include "lit_scene.h"

namespace shodo {
namespace {

TEST(Hidden, SubPatchesUnderABoxAreExactlyThoseAndAreNoPartOfTheMean) {
  // A box without a bottom of its own over 2 x 3 of 8 x 8 sub-patches of the floor, with and without light.
  for (const bool lit : {true, false}) {
    for (const bool bottom : {true, false}) {
      LitScene scene;
      const std::uint32_t floor = scene.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, 4, 4, 2, 2);
      scene.object();
      const Vec3 low{1, 1.5, 0}, high{2, 3, 0.5};
      if (bottom) {
        scene.box(low, high);
      } else {
        scene.quad({1, 1.5, 0.5}, {2, 1.5, 0.5}, {2, 3, 0.5}, {1, 3, 0.5});
        scene.quad({1, 1.5, 0}, {2, 1.5, 0}, {2, 1.5, 0.5}, {1, 1.5, 0.5});
        scene.quad({2, 3, 0}, {1, 3, 0}, {1, 3, 0.5}, {2, 3, 0.5});
        scene.quad({2, 1.5, 0}, {2, 3, 0}, {2, 3, 0.5}, {2, 1.5, 0.5});
        scene.quad({1, 3, 0}, {1, 1.5, 0}, {1, 1.5, 0.5}, {1, 3, 0.5});
      }
      if (lit) {
        scene.add_point({3.3, 0.7, 2.5}, 100);
        scene.add_sun({1, 1, 1}, {0.1, 0.2, -1}, 1000);
        // Close to the box: uneven on the hidden sub-patches too, if it could reach them.
        scene.add_area({2.05, 2, 0.3}, {2.05, 2.3, 0.3}, {2.4, 2.3, 0.3}, {2.4, 2, 0.3}, 1000);
      }
      scene.light();
      const Mesh& mesh = scene.scene.meshes[floor];
      for (std::uint32_t v = 0; v < 8; ++v) {
        for (std::uint32_t u = 0; u < 8; ++u) {
          const bool under = u >= 2 && u < 4 && v >= 3 && v < 6;
          EXPECT_EQ(scene.direct.hidden[mesh.first_sub_patch + 8 * v + u], under ? 1 : 0) << u << " " << v;
          if (under) {
            EXPECT_EQ(scene.lux(floor, u, v), 0);
          }
        }
      }
      // Patch (1, 1) has its lower half visible, (1, 2) none.
      EXPECT_EQ(scene.direct.visible_area[4 * 1 + 1], 0.5f);
      EXPECT_EQ(scene.direct.visible_area[4 * 2 + 1], 0.0f);
      EXPECT_EQ(scene.direct.visible_area[4 * 2 + 2], 1.0f);
      EXPECT_EQ(scene.direct.patch_lx[4 * 2 + 1], 0);
      const double mean = 0.5 * (scene.lux(floor, 2, 2) + scene.lux(floor, 3, 2));
      EXPECT_NEAR(scene.direct.patch_lx[4 * 1 + 1], mean, 1e-6 * mean);
    }
  }
}

TEST(Hidden, ASubPatchHalfUnderABoxIsAsBrightAsItsVisibleHalf) {
  // The sun shines along the box's side, and so lights all of what is visible.
  LitScene scene;
  const std::uint32_t floor = scene.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, 2, 2);
  scene.object();
  scene.box({0, -1, 0}, {1, 5, 0.5});
  scene.add_sun({1, 1, 1}, {0, 0.5, -1}, 1000);
  scene.light();
  const double full = 1000 / std::sqrt(1.25);
  EXPECT_NEAR(scene.lux(floor, 0, 0), full, 1e-2);
  EXPECT_NEAR(scene.lux(floor, 1, 0), full, 1e-2);
}

/// Against the same floor cut along the box's edges into sub-patches that are hidden or aren't. A plate shades all of
/// one of two sub-patches, and the sun lights what the box leaves of the other. Parts of it are counted in sixteenths,
/// at whose edges the box ends: exact but for single precision.
TEST(Hidden, ASubPatchPartlyUnderABoxCountsByItsVisiblePart) {
  for (const double x : {1.25, 1.5, 1.75}) {
    for (const double y : {0.0, 0.5, 0.75}) {
      double lux[2] = {}, visible[2] = {};
      for (const std::uint32_t cut : {1u, 4u}) {
        LitScene scene;
        scene.quad({0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, 1, 1, 2 * cut, cut);
        scene.object();
        scene.box({x, y, 0}, {3, 2, 0.25});
        scene.quad({-9, -9, 1}, {-9, 9, 1}, {1, 9, 1}, {1, -9, 1});  // the plate, facing down
        scene.add_sun({1.1, 0.1, 2}, {0, 0, -1}, 1000);
        scene.light();
        lux[cut / 4] = scene.direct.patch_lx[0];
        visible[cut / 4] = scene.direct.visible_area[0];
      }
      const double lit = 1 - (2 - x) * (1 - y);
      EXPECT_NEAR(visible[1], 0.5 * (1 + lit), 1e-6) << x << ' ' << y;
      EXPECT_NEAR(visible[0], visible[1], 1e-6) << x << ' ' << y;
      EXPECT_NEAR(lux[1], 1000 * lit / (1 + lit), 1e-3) << x << ' ' << y;
      EXPECT_NEAR(lux[0], lux[1], 1e-6 * lux[1]) << x << ' ' << y;
    }
  }
}

TEST(Hidden, ASubPatchCoveredAtItsCentreOnlyIsNotHidden) {
  for (const bool lit : {true, false}) {
    LitScene scene;
    const std::uint32_t floor = scene.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
    scene.object();
    scene.box({1.6, 1.6, 0}, {2.4, 2.4, 0.5});
    if (lit) scene.add_sun({1, 1, 1}, {0, 0, -1}, 1000);
    scene.light();
    EXPECT_EQ(scene.direct.hidden[0], 0);
    EXPECT_EQ(scene.lux(floor, 0, 0), lit ? 1000 : 0);
  }
}

TEST(Hidden, AShadowIsNoHiding) {
  LitScene scene;
  const std::uint32_t floor = scene.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, 4, 4);
  scene.object();
  scene.quad({-9, -9, 1}, {-9, 9, 1}, {9, 9, 1}, {9, -9, 1});  // a table without legs, facing down
  scene.add_sun({1, 1, 2}, {0, 0, -1}, 1000);
  scene.light();
  EXPECT_EQ(scene.flux(floor), 0);
  for (std::uint32_t k = 0; k < 16; ++k) {
    EXPECT_EQ(scene.direct.hidden[k], 0);
    EXPECT_EQ(scene.direct.visible_area[k], 1.0f);
  }
}

/// Two closed rooms side by side with a wall of their own each; `turn` about (1, 2, 3).
void two_rooms(LitScene& scene, const Vec3& light, double turn) {
  scene.room({0, 0, 0}, {2, 2, 2}, 3, 2);
  scene.object();
  scene.room({2, 0, 0}, {4, 2, 2}, 3, 2);
  scene.add_point(light, 100);
  scene.transform([=](const Vec3& v) { return turned(v, {1, 2, 3}, turn); });
  scene.light();
}

TEST(HardCases, ALightOnTheCeilingLightsItsOwnRoomOnly) {
  // Hard case 12: on the ceiling, on the edge to a wall, in a corner.
  for (const Vec3& at : {Vec3{0.7, 0.9, 2}, Vec3{0.7, 0, 2}, Vec3{0, 0, 2}}) {
    LitScene scene;
    two_rooms(scene, at, 0);
    EXPECT_EQ(scene.flux(1), 0);
    double first = 0, second = 0;
    for (std::uint32_t m = 0; m < 6; ++m) first += scene.flux(m);
    for (std::uint32_t m = 6; m < 12; ++m) second += scene.flux(m);
    // The room is an octant's, quadrant's or half space's worth of the sphere; what lies in a wall's plane it doesn't
    // light.
    const int walls = 1 + (at.y == 0) + (at.x == 0);
    EXPECT_NEAR(first, 400 * M_PI / (1 << walls), 0.01 * 400 * M_PI) << at.x << " " << at.y;
    EXPECT_EQ(second, 0);
  }
}

TEST(HardCases, ALightInAPatchsPlaneGivesItExactlyNothing) {
  // Hard case 13, with coordinates that are no binary fractions, and sub-patches whose own corners are rounded: the
  // height of a light is that over the file's corners.
  for (int k = 0; k < 10; ++k) {
    const double z = 0.7 + 0.0937 * k;
    LitScene scene;
    const std::uint32_t wall = scene.quad({0.1, 0.3, z}, {2.3, 0.3, z}, {2.3, 1.9, z}, {0.1, 1.9, z}, 7, 5, 3, 3);
    scene.quad({0, 0, -1.37}, {1, 0, -1.37}, {1, 1, -1.37}, {0, 1, -1.37});  // so that z isn't the scene's middle
    scene.add_point({3.1, 1.1, z}, 1e6);
    scene.add_area({3, 0, z}, {4, 0, z}, {4, 1, z}, {3, 1, z}, 1e6);
    scene.light();
    for (std::uint32_t s = 0; s < 7 * 5 * 9; ++s) ASSERT_EQ(scene.lux(wall, s % 21, s / 21), 0) << z;
  }
}

TEST(HardCases, ALightInATurnedPatchsPlaneGivesNextToNothing) {
  LitScene scene;
  const std::uint32_t wall = scene.quad({0.1, 0.3, 0.7}, {2.3, 0.3, 0.7}, {2.3, 1.9, 0.7}, {0.1, 1.9, 0.7}, 7, 5, 3, 3);
  scene.add_point({3.1, 1.1, 0.7}, 1e6);
  scene.add_area({3, 0, 0.7}, {4, 0, 0.7}, {4, 1, 0.7}, {3, 1, 0.7}, 1e6);
  scene.transform([](const Vec3& v) { return turned(v, {1, 2, 3}, 0.1); });
  scene.light();
  for (std::uint32_t k = 0; k < 7 * 5 * 9; ++k) EXPECT_LE(scene.lux(wall, k % 21, k / 21), 1e-12 * 1e6);
}

TEST(HardCases, ADarkRoomAmongLightsStaysExactlyDark) {
  // Hard case 16: bright all round; also turned, so that no wall lies along the lattice.
  for (const double turn : {0.0, 0.1}) {
    LitScene scene;
    scene.room({0, 0, 0}, {2, 2, 2}, 4, 3);
    scene.object();
    scene.quad({-3, -3, -1}, {5, -3, -1}, {5, 5, -1}, {-3, 5, -1}, 4, 4);
    for (const Vec3& at : {Vec3{3, 1, 1}, Vec3{-1, -1, -0.5}, Vec3{1, 1, 3}, Vec3{2.5, 2.5, 2.5}})
      scene.add_point(at, 1e5);
    scene.add_area({-1, -1, 3}, {-1, 3, 3}, {3, 3, 3}, {3, -1, 3}, 1e4);
    const Vec3 down = turned({0, 0, -1}, {1, 2, 3}, turn), aslant = turned({1, 1, -1}, {1, 2, 3}, turn);
    scene.add_sun({1, 1, 1}, down, 1e5);
    scene.add_sun({1, 1, 1}, aslant, 1e5);
    scene.transform([=](const Vec3& v) { return turned(v, {1, 2, 3}, turn); });
    scene.light();
    for (std::uint32_t m = 0; m < 6; ++m) EXPECT_EQ(scene.flux(m), 0) << turn << " " << m;
    EXPECT_GT(scene.flux(6), 0);
  }
}

TEST(HardCases, WithoutLightsEverythingIsExactlyDark) {
  LitScene scene;
  scene.room({0, 0, 0}, {2, 2, 2}, 2, 2);
  scene.light();
  for (const float lux : scene.direct.sub_patch_lx) EXPECT_EQ(lux, 0);
  for (const double lux : scene.direct.patch_lx) EXPECT_EQ(lux, 0);
  for (const float part : scene.direct.visible_area) EXPECT_EQ(part, 1.0f);
  EXPECT_EQ(scene.statistics.segments_direct, 0u);
}

TEST(HardCases, OfFiftyClosedBoxesOneIsLit) {
  LitScene scene;
  for (int k = 0; k < 50; ++k) {
    scene.room({2.0 * k, 0, 0}, {2.0 * k + 1, 1, 1}, 1, 2);
    scene.object();
  }
  scene.add_point({20.5, 0.4, 0.6}, 100);
  scene.light();
  for (std::uint32_t m = 0; m < 300; ++m) {
    if (m / 6 != 10) {
      EXPECT_EQ(scene.flux(m), 0);
    }
  }
  EXPECT_NEAR(scene.flux(), 400 * M_PI, 1e-3);
}

TEST(HardCases, AMirroredSceneHasMirroredLight) {
  // Hard case 31: left and right half of a symmetric room; mirrored samples, and sums of the same terms.
  LitScene scene;
  const auto half = [&](double sign) {
    const std::uint32_t m = sign < 0 ? scene.quad({0, -1, 0}, {0, 1, 0}, {-2, 1, 0}, {-2, -1, 0}, 3, 4, 2, 2)
                                     : scene.quad({0, 1, 0}, {0, -1, 0}, {2, -1, 0}, {2, 1, 0}, 3, 4, 2, 2);
    scene.quad({sign * 0.7, 0.2, 0.5}, {sign * 1.1, 0.2, 0.5}, {sign * 1.1, 0.6, 0.5}, {sign * 0.7, 0.6, 0.5});
    return m;
  };
  const std::uint32_t left = half(-1), right = half(1);
  scene.add_point({0, 0.3, 1.5}, 100);
  scene.add_point({-1, -0.3, 1.1}, 50);
  scene.add_point({1, -0.3, 1.1}, 50);
  scene.light();
  for (std::uint32_t v = 0; v < 8; ++v) {
    for (std::uint32_t u = 0; u < 6; ++u) {
      const double value = scene.lux(left, u, v);
      EXPECT_NEAR(scene.lux(right, 5 - u, v), value, 1e-6 * value);  // floats
    }
  }
}

TEST(HardCases, ALightOfAbsurdStrengthStaysFinite) {
  LitScene scene;
  scene.room({0, 0, 0}, {1, 1, 1}, 2, 2);
  scene.add_point({0.5, 0.5, 0.5}, 1e308);
  scene.add_point({0.25, 0.25, 1e-5}, 1e308);
  scene.light();
  for (const float lux : scene.direct.sub_patch_lx) EXPECT_TRUE(std::isfinite(lux));
  for (const double lux : scene.direct.patch_lx) EXPECT_TRUE(std::isfinite(lux));
}

TEST(DirectLight, OfDroppedPatchesIsNothing) {
  LitScene scene;
  scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2, 2);
  const std::uint32_t thread = scene.quad({0, 2, 0}, {1, 2, 0}, {1, 2.000001, 0}, {0, 2.000001, 0}, 2, 1, 2, 2);
  scene.add_point({0.5, 0.5, 1}, 100);
  scene.light();
  EXPECT_EQ(scene.statistics.patches_dropped, 2u);
  EXPECT_EQ(scene.flux(thread), 0);
  EXPECT_EQ(scene.direct.visible_area[4], 0.0f);
  EXPECT_GT(scene.flux(0), 0);
}

TEST(DirectLight, OfAThinStripIsThatOfAWideOne) {
  // 16 lattice steps wide (2^-19 a step here): samples keep to the middle half.
  LitScene scene;
  const double width = 16 * 0x1p-19;
  const std::uint32_t strip =
      scene.quad({0.2, 0.5, 0}, {0.8, 0.5, 0}, {0.8, 0.5 + width, 0}, {0.2, 0.5 + width, 0}, 3, 1);
  scene.quad({0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1});
  scene.add_point({0.3, 0.1, 0.9}, 100);
  scene.light();
  EXPECT_GT(scene.statistics.patches_thin, 0u);
  for (std::uint32_t u = 0; u < 3; ++u) {
    const double dx = 0.3 + 0.2 * u - 0.3, d2 = dx * dx + 0.16 + 0.81;
    EXPECT_NEAR(scene.lux(strip, u, 0), 90 / (d2 * std::sqrt(d2)), 0.03 * 90 / (d2 * std::sqrt(d2)));
  }
}

/// Solid angle of a triangle from the sum of its angles on the sphere (Girard): shares nothing with the program's.
double girard(const Vec3& eye, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 r[3] = {normalised(a - eye), normalised(b - eye), normalised(c - eye)};
  double sum = -M_PI;
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = normalised(cross(r[k], r[(k + 1) % 3])), q = normalised(cross(r[k], r[(k + 2) % 3]));
    sum += std::acos(std::fmax(-1, std::fmin(1, dot(p, q))));
  }
  return sum;
}

TEST(DirectLight, OfATriangleIsITimesItsSolidAngle) {
  for (const double height : {0.05, 0.6, 4.0}) {
    for (const std::uint32_t n : {1u, 3u}) {
      LitScene scene;
      const Vec3 a{0, 0, 0}, b{2, 0.3, 0.2}, c{0.4, 1.5, -0.1}, eye{0.7, 0.8, height};
      const std::uint32_t m = scene.triangle(a, b, c, n, 2);
      scene.add_point(eye, 100);
      scene.light();
      const double expected = 100 * girard(eye, a, b, c);
      EXPECT_NEAR(scene.flux(m), expected, 1e-3 * expected) << height << " " << n;
    }
  }
}

TEST(DirectLight, OfTrapezoidsIsITimesTheirSolidAngle) {
  // Sub-patches of unequal area, far from the light: the rule has to weight by area.
  LitScene scene;
  const Vec3 corner[4] = {{-1, -1, 0}, {1, -1, 0}, {0.1, 1, 0}, {-0.1, 1, 0}}, eye{0.5, 1.5, 3};
  const std::uint32_t m = scene.quad(corner[0], corner[1], corner[2], corner[3], 2, 2);
  scene.add_lambertian_point(eye, {0, 0, -1}, 100, 0);
  scene.light();
  const double expected =
      100 * (girard(eye, corner[0], corner[1], corner[2]) + girard(eye, corner[0], corner[2], corner[3]));
  EXPECT_NEAR(scene.flux(m), expected, 1e-3 * expected);
}

TEST(DirectLight, OfAPatchIsTheAreaWeightedMeanOfItsSubPatches) {
  LitScene scene;
  const std::uint32_t quad = scene.quad({-1, -1, 0}, {1, -1, 0}, {0.1, 1, 0}, {-0.1, 1, 0}, 3, 2, 2, 3);
  const std::uint32_t triangle = scene.triangle({2, 0, 0}, {4, 0, 0}, {2, 2, 0.5}, 4, 3);
  scene.add_point({1.3, 0.4, 0.8}, 100);
  scene.light();
  for (const std::uint32_t m : {quad, triangle}) {
    const Mesh& mesh = scene.scene.meshes[m];
    std::vector<double> flux(mesh.patch_count()), area(mesh.patch_count());
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const double a = length(sub_patch_piece(scene.scene, mesh, k).vector_area());
      flux[patch_of_sub_patch(mesh, k)] += a * static_cast<double>(scene.direct.sub_patch_lx[mesh.first_sub_patch + k]);
      area[patch_of_sub_patch(mesh, k)] += a;
    }
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      const double mean = flux[p] / area[p];
      EXPECT_NEAR(scene.direct.patch_lx[mesh.first_patch + p], mean, 1e-6 * mean);  // floats
    }
  }
}

TEST(DirectLight, StopsWhenAskedTo) {
  LitScene scene;
  scene.room({0, 0, 0}, {2, 2, 2}, 4, 3);
  scene.add_point({1, 1, 1}, 100);
  int calls = 0;
  scene.progress.context = &calls;
  scene.progress.report = [](void* context, Stage stage, std::uint64_t done, std::uint64_t total) {
    EXPECT_EQ(stage, Stage::kDirect);
    EXPECT_LT(done, total);
    return ++*static_cast<int*>(context) < 3;
  };
  scene.light();
  EXPECT_EQ(scene.status.code, StatusCode::kInterrupted);
  EXPECT_EQ(calls, 3);
}

TEST(DirectLight, RefusesAnArenaThatIsTooSmallAndNamesOneThatIsNot) {
  LitScene scene;
  scene.room({0, 0, 0}, {2, 2, 2}, 2, 2);
  scene.add_point({1, 1, 1}, 100);
  scene.add_area({0.5, 0.5, 2}, {0.5, 1.5, 2}, {1.5, 1.5, 2}, {1.5, 0.5, 2}, 100);
  scene.light();
  std::vector<std::uint64_t> memory(4096);
  DirectLight direct;
  const auto run = [&](std::size_t bytes, DirectKeeps keeps) {
    Arena arena(memory.data(), bytes);
    Statistics statistics;
    Intersector intersector(scene.geometry);
    direct = scene.direct;
    direct.sub_patch_lx = {};
    direct.hidden = {};
    return light_directly(scene.scene, scene.geometry, scene.patches, {}, intersector, {}, arena, direct, statistics,
                          keeps);
  };
  for (const DirectKeeps keeps : {DirectKeeps::kPatches, DirectKeeps::kSubPatches}) {
    std::size_t bytes = 0;
    int refused = 0;
    for (Status status = run(0, keeps); !status.done(); status = run(bytes, keeps)) {
      ASSERT_EQ(status.code, StatusCode::kMemory);
      ASSERT_GT(status.bytes_needed, bytes);
      bytes = status.bytes_needed;
      ++refused;
    }
    const bool patches = keeps == DirectKeeps::kPatches;
    EXPECT_EQ(refused, (patches ? 3 : 2) + 6);  // each block of results, and of scratch, once
    EXPECT_EQ(direct.sub_patch_lx.empty(), patches) << "what isn't needed yet waits for room";
    EXPECT_EQ(run(bytes - 8, keeps).code, StatusCode::kMemory);
  }
}

TEST(DirectLight, LitOnceMoreSubPatchesAreTheSame) {
  LitScene scene;
  scene.room({0, 0, 0}, {2, 2, 2}, 2, 2);
  scene.add_point({1, 1, 1}, 100);
  scene.light();
  const std::vector<float> expected(scene.direct.sub_patch_lx.begin(), scene.direct.sub_patch_lx.end());
  std::vector<std::uint64_t> memory(1 << 16);
  Arena arena(memory.data(), 8 * memory.size());
  DirectLight direct = scene.direct;
  Statistics statistics;
  Intersector intersector(scene.geometry);
  ASSERT_TRUE(light_directly(scene.scene, scene.geometry, scene.patches, {}, intersector, {}, arena, direct, statistics,
                             DirectKeeps::kSubPatches).done());
  EXPECT_EQ(std::vector<float>(direct.sub_patch_lx.begin(), direct.sub_patch_lx.end()), expected);
}

}  // namespace
}  // namespace shodo
