// Each kind of light against closed forms: attenuation, distributions, suns, area lights.
#include <gtest/gtest.h>

#include "lit_scene.h"

namespace shodo {
namespace {

/// A sub-patch of 2 mm about (x, y, z), facing up: a point for all that matters here.
std::uint32_t speck(LitScene& scene, double x, double y, double z = 0) {
  const double r = 0.001;
  return scene.quad({x - r, y - r, z}, {x + r, y - r, z}, {x + r, y + r, z}, {x - r, y + r, z});
}

LitScene::Change attenuate(double c, double l, double q) {
  return [=](Light& light) {
    light.attenuation[0] = c;
    light.attenuation[1] = l;
    light.attenuation[2] = q;
  };
}

TEST(PointLight, AttenuationDividesByCLQ) {
  LitScene plain;
  const std::uint32_t m = speck(plain, 1.5, 0);
  plain.add_point({0, 0, 2}, 900, attenuate(0.5, 0.25, 2));
  plain.light();
  const double d = 2.5, cosine = 2 / d;
  EXPECT_NEAR(plain.lux(m, 0, 0), 900 * cosine / (0.5 + 0.25 * d + 2 * d * d), 1e-4);
}

TEST(PointLight, AttenuationTakesMetresInAnyUnit) {
  LitScene scene;
  const std::uint32_t m = speck(scene, 150, 0);
  scene.scene.metres_per_unit = 0.01;
  scene.add_point({0, 0, 200}, 900, attenuate(0.5, 0.25, 2));
  scene.light();
  const double d = 2.5;
  EXPECT_NEAR(scene.lux(m, 0, 0), 900 * 0.8 / (0.5 + 0.25 * d + 2 * d * d), 1e-4);
}

TEST(PointLight, ConstantAttenuationIsFiniteAndRightNearTheLight) {
  // E = I cos / C: over a disc-like patch as large as the height, integrate the cosine directly.
  LitScene scene;
  const std::uint32_t m = scene.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  scene.add_point({0.2, -0.3, 0.5}, 100, attenuate(1, 0, 0));
  scene.light();
  double sum = 0;
  const int n = 400;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = -1 + 2 * (i + 0.5) / n - 0.2, y = -1 + 2 * (j + 0.5) / n + 0.3;
      sum += 0.5 / std::sqrt(x * x + y * y + 0.25);
    }
  }
  EXPECT_NEAR(scene.lux(m, 0, 0), 100 * sum / (n * n), 0.01 * 100 * sum / (n * n));  // cells of half a radian
}

TEST(PointLight, IntensityIsICosToTheNAboutItsAxisAndNothingBehind) {
  for (const double n : {0.0, 0.5, 1.0, 3.0, 12.0}) {
    LitScene scene;
    const std::uint32_t ahead = speck(scene, 0, 0), aside = speck(scene, 1.5, 0), behind = speck(scene, -2, 0);
    scene.add_lambertian_point({0, 0, 2}, {2, 0, -1}, 700, n);
    scene.light();
    const double s5 = std::sqrt(5.0);
    EXPECT_NEAR(scene.lux(ahead, 0, 0), 700 * std::pow(1 / s5, n) / 4, 1e-3);
    EXPECT_NEAR(scene.lux(aside, 0, 0), 700 * std::pow((2 * 1.5 + 2) / (s5 * 2.5), n) * 0.8 / 6.25, 1e-3);
    EXPECT_EQ(scene.lux(behind, 0, 0), 0);
  }
}

TEST(PointLight, AtADistanceBelowOneStepIsFiniteAndCounted) {
  LitScene scene;
  const std::uint32_t m = scene.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, 3, 3);
  scene.add_point({0, 0, 0}, 100);     // on the middle sub-patch's centre
  scene.add_point({0, 0, 1e-7}, 100);  // a tenth of a step over it
  scene.light();
  EXPECT_EQ(scene.statistics.lights_clamped, 1u);  // the first lies in the plane and gives nothing at all
  for (std::uint32_t k = 0; k < 9; ++k) {
    EXPECT_TRUE(std::isfinite(scene.lux(m, k % 3, k / 3)));
    EXPECT_GE(scene.lux(m, k % 3, k / 3), 0);
  }
}

TEST(PointLight, BelowOneStepFromASampleShinesAsFromOneStep) {
  // Over the first of the 4 x 4 samples of one sub-patch, at a tenth of a step: that sample has all of the light.
  LitScene scene;
  const std::uint32_t m = scene.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  scene.add_point({-0.75, -0.75, 3e-7}, 100);
  scene.light();
  const double step = scene.geometry.lattice.step();
  EXPECT_EQ(scene.statistics.lights_clamped, 1u);
  EXPECT_NEAR(scene.lux(m, 0, 0), 100 / (step * step) / 16, 1e-6 * 100 / (step * step));
}

TEST(PointLight, OnATurnedPatchGivesItNextToNothing) {
  // The rounding of its height must not turn the patch to the light, which would send it half its flux.
  for (const double turn : {0.1, 0.7, 1.9}) {
    LitScene scene;
    scene.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, 2, 2, 3, 3);
    scene.quad({-1, 1, 0}, {1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, 2, 2, 3, 3);
    scene.add_point({0.13, 0.27, 0}, 100);
    scene.transform([=](const Vec3& v) { return turned(v, {1, 2, 3}, turn); });
    scene.light();
    EXPECT_LT(scene.flux(), 1e-6);
  }
}

TEST(PointLight, ItsFluxIsRightHoweverNear) {
  // A quarter of a millimetre to half a metre over any place of one sub-patch of a metre, between its samples or on
  // them.
  for (const double h : {0.00025, 0.001, 0.01, 0.1, 0.5}) {
    for (const double x : {0.0, 0.25, 0.1}) {
      LitScene scene;
      scene.room({-0.5, -0.5, 0}, {0.5, 0.5, 1}, 1, 1);
      scene.add_point({x, 0.25, h}, 100);
      scene.light();
      EXPECT_NEAR(scene.flux(), 400 * M_PI, 1e-5 * 400 * M_PI) << h << " " << x;
    }
  }
}

TEST(Sun, IlluminanceIsThatOfTheBeamTimesTheCosine) {
  LitScene scene;
  const std::uint32_t floor = scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2, 2);
  const std::uint32_t wall = scene.quad({1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}, 2, 2);
  const std::uint32_t away = scene.quad({1, 2, 0}, {1, 3, 0}, {1, 3, 1}, {1, 2, 1});  // fronts +x
  const Vec3 towards = normalised({2, 0, -1});
  scene.add_sun({0.5, 0.5, 0.5}, towards, 50000);
  scene.light();
  for (std::uint32_t k = 0; k < 4; ++k) {
    // The direction is rounded to 2^-20 of its largest part.
    EXPECT_NEAR(scene.lux(floor, k % 2, k / 2), 50000 / std::sqrt(5.0), 0.1);
    EXPECT_NEAR(scene.lux(wall, k % 2, k / 2), 100000 / std::sqrt(5.0), 0.1);
  }
  EXPECT_EQ(scene.lux(away, 0, 0), 0);
}

TEST(Sun, AlongASurfaceGivesExactlyNothing) {
  LitScene scene;
  const std::uint32_t floor = scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2, 2);
  scene.add_sun({0.5, 0.5, 0}, {3, -1, 0}, 50000);
  scene.light();
  EXPECT_EQ(scene.flux(floor), 0);
}

TEST(Sun, LightsExactlyTheAreaOutsideAShadow) {
  // Shadow edges on multiples of 1/32, the sides of the sample cells of 8 x 8 sub-patches: every sample decides
  // rightly.
  LitScene scene;
  const std::uint32_t floor = scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 4, 4, 2, 2);
  const double x0 = 5.0 / 32, x1 = 12.0 / 32, y0 = 3.0 / 32, y1 = 27.0 / 32, h = 0.25;
  scene.quad({x0, y0, h}, {x1, y0, h}, {x1, y1, h}, {x0, y1, h});
  scene.add_sun({0.5, 0.5, 0.2}, {1, -0.25, -2}, 1000);
  scene.light();
  const double cosine = 2 / std::sqrt(1 + 0.0625 + 4);
  EXPECT_NEAR(scene.flux(floor) / (1000 * cosine), 1 - (x1 - x0) * (y1 - y0), 1e-6);
}

TEST(Sun, AnEdgeAcrossASubPatchIsSeenBySixtyFourPlaces) {
  // The sun stands over a slanting edge. 8 x 8 places, one in each cell, are wrong where the edge crosses their cell,
  // 10 of 64 in the mean, each by an even chance: sqrt(10 / 6) / 64 = 0.02 of a sub-patch. 4 x 4 were 0.04 off.
  LitScene scene;
  const std::uint32_t floor = scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 10, 10);
  scene.quad({-1, -1, 0.5}, {1.27, -1, 0.5}, {0.13, 2, 0.5}, {-1, 2, 0.5});
  scene.add_sun({0.5, 0.5, 0.2}, {0, 0, -1}, 1000);
  scene.light();
  double squares = 0;
  int cut = 0;
  for (std::uint32_t k = 0; k < 100; ++k) {
    constexpr int kFine = 100;
    int lit = 0;
    for (int n = 0; n < kFine * kFine; ++n) {
      const double x = 0.1 * (k % 10 + (n % kFine + 0.5) / kFine), y = 0.1 * (k / 10 + (n / kFine + 0.5) / kFine);
      lit += x > 1.27 - 0.38 * (y + 1);
    }
    if (lit == 0 || lit == kFine * kFine) continue;
    ++cut;
    const double off = scene.lux(floor, k % 10, k / 10) / 1000 - static_cast<double>(lit) / (kFine * kFine);
    squares += off * off;
  }
  EXPECT_GE(cut, 10);
  EXPECT_LT(std::sqrt(squares / cut), 0.03);
}

TEST(Sun, ThroughAWindowGridLightsTheOpenPart) {
  // Hard case 35: 50 x 50 openings of 3/5 of their spacing each way, over a floor whose sub-patches are no multiple of
  // it.
  LitScene scene;
  const std::uint32_t floor = scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 9, 9, 3, 3);
  for (int k = 0; k <= 50; ++k) {
    const double middle = k / 50.0, r = 0.2 / 50;
    scene.quad({middle - r, -0.5, 0.5}, {middle + r, -0.5, 0.5}, {middle + r, 1.5, 0.5}, {middle - r, 1.5, 0.5});
    scene.quad({-0.5, middle - r, 0.5}, {1.5, middle - r, 0.5}, {1.5, middle + r, 0.5}, {-0.5, middle + r, 0.5});
  }
  scene.add_sun({0.5, 0.5, 0.2}, {0, 0, -1}, 1000);
  scene.light();
  EXPECT_NEAR(scene.flux(floor) / 1000, 0.36, 0.02);
}

TEST(AreaLight, ThePenumbraOfAHalfPlaneIsTheFactorOfTheVisiblePart) {
  // The edge lies half-way up, over x = 0: a point at x sees the part of the light beyond -x.
  LitScene scene;
  const std::uint32_t floor = scene.quad({-1, -0.02, 0}, {1, -0.02, 0}, {1, 0.02, 0}, {-1, 0.02, 0}, 50, 1);
  scene.quad({-3, -3, 1}, {0, -3, 1}, {0, 3, 1}, {-3, 3, 1});
  scene.add_area({-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}, 1000);
  scene.light();
  double sum = 0, sum_expected = 0, worst = 0;
  for (std::uint32_t k = 0; k < 50; ++k) {
    const double x = -1 + (k + 0.5) * 0.04;
    const double from = std::fmin(0.5, std::fmax(-0.5, -x));
    const Vec3 part[4] = {{from, -0.5, 2}, {from, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}};
    const double expected = 1000 * M_PI * point_to_polygon({x, 0, 0}, {0, 0, 1}, part, 4);
    worst = std::fmax(worst, std::fabs(scene.lux(floor, k, 0) - expected));
    sum += scene.lux(floor, k, 0);
    sum_expected += expected;
    if (x < -0.52) {
      EXPECT_EQ(scene.lux(floor, k, 0), 0);
    }
    if (k > 0 && x < 0.4) {
      // Between two columns the light falls off with distance, by up to 1 lx a sub-patch; and another half where one
      // sub-patch is resolved by its own samples and the next is not.
      EXPECT_GE(scene.lux(floor, k, 0), scene.lux(floor, k - 1, 0) - 1.5);
    }
  }
  // 32 points in 16 columns count 4/5, 8 in 4 columns 1/5: half a column of both is 4/5 1/32 + 1/5 1/8 = 1/20, 11 lx of
  // the 218 lx beneath; over all columns it cancels.
  EXPECT_LT(worst, 11);
  EXPECT_NEAR(sum, sum_expected, 0.01 * sum_expected);
}

TEST(AreaLight, NearALargeSubPatchIsTheMeanOfItsSamples) {
  // 40 cm over the middle of a sub-patch of 2 m: the rule of centre and corners would be off by half.
  LitScene scene;
  const std::uint32_t m = scene.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  const Vec3 light[4] = {{-0.3, -0.3, 0.4}, {-0.3, 0.3, 0.4}, {0.3, 0.3, 0.4}, {0.3, -0.3, 0.4}};
  scene.add_area(light[0], light[1], light[2], light[3], 1000);
  scene.light();
  double sum = 0;
  const int n = 60;
  for (int k = 0; k < n * n; ++k) {
    const Vec3 point{-1 + 2 * (k % n + 0.5) / n, -1 + 2 * (k / n + 0.5) / n, 0};
    sum += 1000 * M_PI * point_to_polygon(point, {0, 0, 1}, light, 4);
  }
  EXPECT_NEAR(scene.lux(m, 0, 0), sum / (n * n), 0.03 * sum / (n * n));  // samples half a metre apart
}

TEST(AreaLight, ASubPatchThatItsPlaneCutsHasTheLightOfItsPartInFront) {
  // A strip along the top of a wall, which goes on 5 mm beyond the strip's plane: a tenth of the sub-patch, or none.
  const Vec3 light[4] = {{0, -1.8, 1}, {0, 1.8, 1}, {0.26, 1.8, 1}, {0.26, -1.8, 1}};
  for (const double top : {1.005, 1.0, 1.025}) {
    const Vec3 wall[4] = {{0, -0.2, 0.95}, {0, 0.2, 0.95}, {0, 0.2, top}, {0, -0.2, top}};
    double expected = 0;
    constexpr int kColumns = 40, kRows = 330;  // the strip's plane is between two rows, 10/11 or 2/3 up
    for (int n = 0; n < kColumns * kRows; ++n) {
      const double y = -0.2 + 0.4 * (n % kColumns + 0.5) / kColumns;
      const double z = 0.95 + (top - 0.95) * (n / kColumns + 0.5) / kRows;
      expected += 1000 * M_PI * point_to_polygon({0, y, z}, {1, 0, 0}, light, 4) / (kColumns * kRows);
    }
    for (int first = 0; first < 4; ++first) {  // whichever corner is named first
      LitScene scene;
      const auto corner = [&](int k) { return wall[(first + k) % 4]; };
      const std::uint32_t m = scene.quad(corner(0), corner(1), corner(2), corner(3));
      scene.add_area(light[0], light[1], light[2], light[3], 1000);
      scene.light();
      EXPECT_NEAR(scene.lux(m, 0, 0), expected, 0.001 * expected) << top << ' ' << first;  // four rows of the curve
    }
  }
}

TEST(AreaLight, AttenuationIsTakenAtItsCentre) {
  LitScene plain, attenuated;
  for (LitScene* scene : {&plain, &attenuated}) {
    speck(*scene, 1, 0);
    scene->add_area({-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}, 1000, false,
                    scene == &plain ? LitScene::Change{} : attenuate(1, 0.5, 0.25));
    scene->light();
  }
  const double d_squared = 5;
  EXPECT_NEAR(attenuated.lux(0, 0, 0), plain.lux(0, 0, 0) * d_squared / (1 + 0.5 * std::sqrt(5.0) + 0.25 * d_squared),
              1e-3);
}

TEST(AreaLight, FormFactorsFromAClosedRoomAddUpToItsArea) {
  // A_i F_i->l = A_l F_l->i, and the light's F sum to 1; with an obstacle the part that it hides is missing on both
  // sides.
  LitScene scene;
  scene.room({0, 0, 0}, {4, 3, 2.5}, 4, 3);
  scene.add_area({1, 1, 2.4}, {1, 2, 2.4}, {2.5, 2, 2.4}, {2.5, 1, 2.4}, 500, true);
  scene.light();
  double sum = 0;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    sum += scene.patches[p].area * static_cast<double>(scene.direct.light_form_factor[p]);
    EXPECT_NEAR(scene.direct.patch_lx[p], 500 * M_PI * static_cast<double>(scene.direct.light_form_factor[p]), 1e-4);
  }
  EXPECT_NEAR(sum, 1.5, 0.0015);
}

TEST(AreaLight, AnOpeningLetsTheSunThroughAndALampDoesNot) {
  for (const bool open : {true, false}) {
    LitScene scene;
    const std::uint32_t floor = scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2, 2);
    scene.add_area({-1, -1, 1}, {-1, 2, 1}, {2, 2, 1}, {2, -1, 1}, 0, open);
    scene.add_sun({0.5, 0.5, 0.5}, {0.25, 0, -1}, 1000);
    scene.light();
    EXPECT_NEAR(scene.flux(floor), open ? 1000 / std::sqrt(1.0625) : 0, 1e-2);
  }
}

TEST(AreaLight, ThatIsConcaveSendsNoSegmentToItsNotch) {
  // An arrowhead, from any of its corners on; a screen right below its notch hides nothing of it from the speck
  // beneath.
  const Vec3 arrow[4] = {{0, 0, 2}, {2, 2, 2}, {0, -2, 2}, {-2, 2, 2}};
  for (std::uint32_t turn = 0; turn < 4; ++turn) {
    LitScene open, screened;
    for (LitScene* scene : {&open, &screened}) {
      speck(*scene, 0, 0);
      if (scene == &screened) scene->triangle({0, 0.03, 1.99}, {1.9, 1.95, 1.99}, {-1.9, 1.95, 1.99});
      scene->add_area(arrow[turn], arrow[(turn + 1) % 4], arrow[(turn + 2) % 4], arrow[(turn + 3) % 4], 100);
      scene->light();
    }
    EXPECT_NEAR(open.lux(0, 0, 0), 100 * M_PI * point_to_polygon({0, 0, 0}, {0, 0, 1}, arrow, 4), 1e-3);
    EXPECT_EQ(screened.lux(0, 0, 0), open.lux(0, 0, 0)) << turn;
  }
}

}  // namespace
}  // namespace shodo
