// Direct light against the closed forms of CIE 171:2006 (references.md).
#include <gtest/gtest.h>

#include "lit_scene.h"

namespace shodo {
namespace {

/// Sub-patches of 2 cm about the points asked for: the area mean is the value there to 1e-4.
std::uint32_t spot(LitScene& scene, const Vec3& at, const Vec3& s, const Vec3& t) {
  const Vec3 a = 0.01 * s, b = 0.01 * t;
  return scene.quad(at - a - b, at + a - b, at + a + b, at - a + b);
}

const Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

TEST(Cie52, LambertianPointSource) {
  const double expected[][3] = {{0, 0, 111.11},  {0.5, 0, 105.19}, {1, 0, 90.00},
                                {1.5, 0, 71.11}, {1, 1, 74.38},    {1.5, 1.5, 49.38}};
  LitScene scene;
  for (const auto& e : expected) spot(scene, {e[0], e[1], 0}, kX, kY);
  scene.add_lambertian_point({0, 0, 3}, -kZ, 1000);
  scene.light();
  for (std::uint32_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(scene.lux(k, 0, 0), expected[k][2], 1e-3 * expected[k][2]) << k;
    const double d_squared = 9 + expected[k][0] * expected[k][0] + expected[k][1] * expected[k][1];
    EXPECT_NEAR(scene.lux(k, 0, 0), 1000 * 9 / (d_squared * d_squared), 1e-4 * expected[k][2]) << k;
  }
}

TEST(Cie52, IsotropicPointSource) {
  const double expected[][2] = {{0, 111.11}, {0.5, 106.64}, {1, 94.87}, {1.5, 79.50}, {2, 64.00}};
  LitScene scene;
  for (const auto& e : expected) spot(scene, {e[0], 0, 0}, kX, kY);
  scene.add_point({0, 0, 3}, 1000);
  scene.light();
  for (std::uint32_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(scene.lux(k, 0, 0), expected[k][1], 1e-3 * expected[k][1]) << k;
    const double d_squared = 9 + expected[k][0] * expected[k][0];
    EXPECT_NEAR(scene.lux(k, 0, 0), 3000 / (d_squared * std::sqrt(d_squared)), 1e-4 * expected[k][1]) << k;
  }
}

TEST(Cie53, AreaSource) {
  const double wall[][2] = {{2.75, 32.68}, {2.25, 75.19}, {1.75, 81.32}, {1.25, 69.06}, {0.75, 53.40}, {0.25, 40.00}};
  const double floor[][2] = {{0.25, 61.42}, {0.75, 79.26}, {1.25, 95.67}, {1.75, 105.78}};
  LitScene scene;
  scene.room({0, 0, 0}, {4, 4, 3}, 1, 1);
  // The spots lie a hundredth of a millimetre off the walls that bound the lattice.
  for (const auto& e : wall) spot(scene, {2, 1e-4, e[0]}, kZ, kX);
  for (const auto& e : floor) spot(scene, {2, e[0], 1e-4}, kX, kY);
  scene.add_area({1.5, 1.5, 3}, {1.5, 2.5, 3}, {2.5, 2.5, 3}, {2.5, 1.5, 3}, 1000);
  scene.light();
  std::uint32_t m = 6;
  for (const auto& e : wall) EXPECT_NEAR(scene.lux(m++, 0, 0), e[1], 0.005 * e[1]) << "wall " << e[0];
  for (const auto& e : floor) EXPECT_NEAR(scene.lux(m++, 0, 0), e[1], 0.005 * e[1]) << "floor " << e[0];
}

TEST(Cie54, APointLightsFluxArrives) {
  LitScene scene;
  scene.room({0, 0, 0}, {4, 4, 3}, 5, 2);
  scene.add_point({2, 2, 1.5}, 10000 / (4 * M_PI));
  scene.light();
  EXPECT_NEAR(scene.flux(), 10000, 10);
  EXPECT_EQ(scene.statistics.lights_clamped, 0u);
}

TEST(Cie54, AnAreaLightsFluxArrives) {
  LitScene scene;
  scene.room({0, 0, 0}, {4, 4, 3}, 5, 3);
  scene.add_area({1.5, 1.5, 2.9}, {1.5, 2.5, 2.9}, {2.5, 2.5, 2.9}, {2.5, 1.5, 2.9}, 10000 / M_PI);
  scene.light();
  EXPECT_NEAR(scene.flux(), 10000, 10);
}

TEST(Cie58, DirectPart) {
  LitScene scene;
  scene.room({0, 0, 0}, {4, 4, 4}, 101, 1);
  scene.add_point({2, 2, 2}, 10000 / (4 * M_PI));
  scene.light();
  for (std::uint32_t m = 0; m < 6; ++m) {
    EXPECT_NEAR(scene.lux(m, 50, 50), 198.94, 0.2) << m;
    // The corner sub-patch is 4 cm wide: its mean is that of the point 2 cm in from either edge.
    const double r2 = 4 + 2 * 1.98 * 1.98;
    EXPECT_NEAR(scene.lux(m, 0, 0), 2 * 10000 / (4 * M_PI) / (r2 * std::sqrt(r2)), 0.02) << m;
    EXPECT_NEAR(scene.lux(m, 0, 0), 38.29, 0.8);
    // Exact for any patches, since near a light flux is a solid angle.
    EXPECT_NEAR(scene.flux(m), 10000.0 / 6, 1e-4 * 10000 / 6) << m;
  }
}

TEST(DirectLight, FluxOfAnIsotropicLightIsExactHoweverCoarseTheWalls) {
  // One sub-patch a wall: every wall is near, and receives I times its solid angle.
  for (const Vec3& at : {Vec3{2, 2, 1.5}, Vec3{0.5, 3.9, 0.01}, Vec3{3.9999, 0.0001, 2.9999}}) {
    LitScene scene;
    scene.room({0, 0, 0}, {4, 4, 3}, 1, 1);
    scene.add_point(at, 10000 / (4 * M_PI));
    scene.light();
    EXPECT_NEAR(scene.flux(), 10000, 0.01);  // the maps are floats: 1e-7 of it, six times
  }
}

TEST(DirectLight, FluxOfADistributionArrivesAlsoFromNear) {
  // 2 pi I / (n + 1), of a light 1 cm over the floor that looks down or sideways, on sub-patches of 40 cm.
  for (const double n : {0.0, 1.0, 3.0, 20.0}) {
    for (const Vec3& towards : {Vec3{0, 0, -1}, Vec3{1, 0.3, -0.2}}) {
      LitScene scene;
      scene.room({0, 0, 0}, {4, 4, 3}, 5, 2);
      scene.add_lambertian_point({1.5, 1.3, 0.01}, towards, 100, n);
      scene.light();
      const double expected = 2 * M_PI * 100 / (n + 1);
      EXPECT_NEAR(scene.flux(), expected, 0.01 * expected) << n << " " << towards.x;
    }
  }
}

}  // namespace
}  // namespace shodo
