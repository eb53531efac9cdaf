// Measuring planes: closed forms, and that measuring changes nothing.
#include "ambient/plane_gather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/solved_scene.h"

namespace shodo {
namespace {

/// A 4 x 4 x 3 m room, fronts inwards, of one material.
std::string room(const std::string& name, const std::string& counts) {
  return "object room\n"
         "quad " + name + " 0 0 0  4 0 0  4 4 0  0 4 0 " + counts +  // floor, ceiling, four walls
         "quad " + name + " 0 0 3  0 4 3  4 4 3  4 0 3 " + counts +
         "quad " + name + " 0 0 0  0 0 3  4 0 3  4 0 0 " + counts +
         "quad " + name + " 0 4 0  4 4 0  4 4 3  0 4 3 " + counts +
         "quad " + name + " 0 0 0  0 4 0  0 4 3  0 0 3 " + counts +
         "quad " + name + " 4 0 0  4 0 3  4 4 3  4 4 0 " + counts;
}

const std::string kHead = "shodo 1\nmaterial black diffuse 0\nmaterial grey diffuse 0.5\n";

// CIE 171:2006, 5.2: sub-patches of 2 cm, so that the area mean is the value at their centre to 1e-4.
TEST(PlaneMaps, ALambertianPointSourceThreeMetresOverAPlaneGivesTheTablesLux) {
  const double expected[][3] = {{0, 0, 111.11},  {0.5, 0, 105.19}, {1, 0, 90.00},
                                {1.5, 0, 71.11}, {1, 1, 74.38},    {1.5, 1.5, 49.38}};
  std::string text = kHead;
  int number = 0;
  for (const auto& e : expected) {
    std::string corners;
    for (const auto& way : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      corners += " " + std::to_string(e[0] + 0.01 * way.first) + " " + std::to_string(e[1] + 0.01 * way.second) + " 0";
    }
    text += "plane p" + std::to_string(number++) + corners + " patches 1 1 sub 1 1\n";
  }
  text += "light lamp point at 0 0 3 towards 0 0 -1 intensity 1000 cosine 1\n";
  const SolvedScene scene(text);
  for (std::uint32_t p = 0; p < 6; ++p) {
    EXPECT_NEAR(scene.plane_lx(p, 0, 0), expected[p][2], 1e-4 * expected[p][2] + 0.005) << p;
  }
}

// A closed room at one illuminance E sends rho E to every place in it, whichever way a plane looks: the contour
// integrals of a closed surface add up to 1. In float 6e-8 are a rounding; 1e-6 leaves room for the integrals' own.
TEST(PlaneMaps, InAFurnaceEveryPlaneGathersWhatTheWallsSend) {
  SolvedScene scene(kHead + room("grey", "patches 5 4\n") +
                    "plane level 1 1 1  3 1 1  3 3 1  1 3 1 patches 3 2 sub 2 3\n"
                    "plane tilted 1 1 1  3 1 2  3 3 2  1 3 1 patches 2 2 sub 1 1\n"
                    "plane down 1 1 0.3  1 3 0.3  3 3 0.3  3 1 0.3 patches 2 2 sub 1 1\n"
                    "plane wall 4 0 0  4 0 3  4 4 3  4 4 0 patches 2 2 sub 1 1\n");
  Model& model = *scene.model;
  for (double& lux : model.ambient.patch_lx) lux = 600;
  Intersector intersector(model.geometry, model.scene, FlagMode::kAuto);
  PlaneMaps maps;
  Statistics counted;
  ASSERT_TRUE(take_plane_maps(model.scene, model.arena, maps));
  ASSERT_TRUE(gather_planes({model.scene, model.geometry, model.patches, model.direct, model.ambient}, intersector, {},
                            model.arena, maps, counted)
                  .done());
  ASSERT_EQ(maps.ambient_lx.size(), 36u + 4u + 4u + 4u);
  for (const float lux : maps.ambient_lx) EXPECT_NEAR(static_cast<double>(lux), 300, 300 * 1e-6);
}

// CIE 171:2006, 5.6: a floor evenly lit to E sends E rho; in % of it. Only the floor reflects, so the light comes once.
TEST(PlaneMaps, OneReflectionGivesTheTablesValuesOnWallAndCeiling) {
  const double wall[][2] = {{0.75, 35.901}, {1.25, 27.992}, {1.75, 21.639}, {2.25, 16.716}, {2.75, 12.967}};
  const double ceiling[][2] = {{0.25, 26.795}, {0.75, 30.939}, {1.25, 33.976}, {1.75, 35.567}};
  const SolvedScene scene(kHead +
                          "object floor\nquad grey 0 0 0  4 0 0  4 4 0  0 4 0 patches 4 4 sub 1 1\n"
                          "light sun sun towards 0 0 -1 illuminance 200\n"
                          "plane wall 1.75 0 0.5  1.75 0 3  2.25 0 3  2.25 0 0.5 patches 5 1 sub 1 1\n"
                          "plane ceiling 1.75 0 3  1.75 2 3  2.25 2 3  2.25 0 3 patches 4 1 sub 1 1\n");
  std::uint32_t u = 0;
  for (const auto& e : wall) EXPECT_NEAR(scene.plane_lx(0, u++, 0), e[1], 0.0006) << "wall " << e[0];
  u = 0;
  for (const auto& e : ceiling) EXPECT_NEAR(scene.plane_lx(1, u++, 0), e[1], 0.0006) << "ceiling " << e[0];
}

// CIE 171:2006, 5.7: a wall evenly lit behind a black box; in % of E rho. The wall has 96 rows of
// patches of 0.2 % each: at the edge of the box's shadow up to 1/8 of a row is taken for lit or dark.
TEST(PlaneMaps, AnObstructionTakesWhatTheTableSays) {
  const double floor[][2] = {{0.25, 3.382}, {0.75, 3.629}, {1.25, 3.013}, {1.75, 0}, {2.25, 0}};
  const double wall[][2] = {{0.25, 7.079},  {0.75, 10.317}, {1.25, 13.322},
                            {1.75, 15.399}, {2.25, 16.330}, {2.75, 16.071}};
  const SolvedScene scene(kHead +
                          "object lit\nquad grey 0 4 0  4 4 0  4 4 3  0 4 3 patches 8 96 sub 1 1\n"
                          "object box\nquad black 0 2.5 0  4 2.5 0  4 2.5 1  0 2.5 1\n"
                          "quad black 0 2.5 1  4 2.5 1  4 2.7 1  0 2.7 1\n"
                          "quad black 0 2.7 0  0 2.7 1  4 2.7 1  4 2.7 0\n"
                          "light sun sun towards 0 1 0 illuminance 200 direct -shadowed_leaving\n"
                          "plane floor 1.75 0 0  2.25 0 0  2.25 2.5 0  1.75 2.5 0 patches 1 5 sub 1 1\n"
                          "plane wall 1.75 0 0  1.75 0 3  2.25 0 3  2.25 0 0 patches 6 1 sub 1 1\n",
                          [] {
                            Options options;  // the sun passes the box, as the flag asks
                            options.flags = FlagMode::kScene;
                            return options;
                          }());
  std::uint32_t k = 0;
  for (const auto& e : floor) EXPECT_NEAR(scene.plane_lx(0, 0, k++), e[1], 0.03) << "floor " << e[0];
  k = 0;
  for (const auto& e : wall) EXPECT_NEAR(scene.plane_lx(1, k++, 0), e[1], 0.03) << "wall " << e[0];
}

// On a table's top, on a floor: what the surface there receives.
TEST(PlaneMaps, APlaneInASurfaceReceivesDirectLightAsTheSurfaceDoes) {
  const SolvedScene scene(kHead + room("black", "patches 4 4 sub 2 2\n") +
                          "object table\nquad black 1 1 0.75  3 1 0.75  3 3 0.75  1 3 0.75 patches 4 4 sub 2 2\n"
                          "plane top 1 1 0.75  3 1 0.75  3 3 0.75  1 3 0.75 patches 4 4 sub 2 2\n"
                          "plane floor 0 0 0  4 0 0  4 4 0  0 4 0 patches 4 4 sub 2 2\n"
                          "light lamp point at 1.2 2.1 2.5 intensity 1000\n");
  const Model& model = *scene.model;
  const std::uint32_t table = model.scene.meshes[6].first_sub_patch, floor = model.scene.meshes[0].first_sub_patch;
  for (std::uint32_t k = 0; k < 64; ++k) {
    EXPECT_EQ(model.planes.direct_lx[k], model.maps.direct_lx[table + k]) << k;
    EXPECT_EQ(model.planes.direct_lx[64 + k], model.maps.direct_lx[floor + k]) << k;
    EXPECT_EQ(model.planes.hidden[k] + model.planes.hidden[64 + k], 0) << k;
  }
}

// What the pane lets through twice (sun, floor, plane) or once, channel by channel.
TEST(PlaneMaps, PanesWeakenDirectAndAmbientLightChannelByChannel) {
  const std::string open =
      kHead + "material glass diffuse 0 transmit 0.5 0.25 0.9\nobject floor\nquad grey 0 0 0  4 0 0  4 4 0  0 4 0\n"
      "light sun sun towards 0 0 -1 illuminance 200\n"
      "plane down 1 1 2  1 3 2  3 3 2  3 1 2 patches 3 2 sub 1 1\n"
      "plane up 1 1 0.5  3 1 0.5  3 3 0.5  1 3 0.5 patches 3 2 sub 1 1\n";
  const SolvedScene without(open), with(open + "object pane\nquad glass -9 -9 1  13 -9 1  13 13 1  -9 13 1\n");
  const double part[3] = {0.5, 0.25, 0.9};
  const PlaneMaps &a = without.model->planes, &b = with.model->planes;
  for (std::uint32_t k = 0; k < 6; ++k) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const double gathered = static_cast<double>(a.ambient_lx[3 * k + c]);
      EXPECT_GT(gathered, 0);
      EXPECT_NEAR(static_cast<double>(b.ambient_lx[3 * k + c]), part[c] * part[c] * gathered, 1e-6 * gathered);
      EXPECT_NEAR(static_cast<double>(b.direct_lx[3 * (6 + k) + c]), 200 * part[c], 1e-4);
    }
  }
}

const std::string kFurnished =
    kHead + "material red diffuse 0.6 0.2 0.1\n" + room("red", "patches 5 5 sub 2 2\n") +
    "object box\nquad grey 1 1 1  2 1 1  2 2 1  1 2 1\nquad grey 1 1 0  2 1 0  2 1 1  1 1 1\n"
    "quad grey 2 1 0  2 2 0  2 2 1  2 1 1\nquad grey 2 2 0  1 2 0  1 2 1  2 2 1\nquad grey 1 2 0  1 1 0  1 1 1  1 2 1\n"
    "light lamp point at 2.6 2.9 2.4 intensity 300\n"
    "light window area quad 0 1 1  0 3 1  0 3 2  0 1 2 luminance 300\n";
const std::string kPlanes =
    "plane through 0.5 0.5 0.5  3.5 0.5 0.5  3.5 3.5 0.5  0.5 3.5 0.5 patches 6 6 sub 2 2\n"
    "plane tilted 0.5 0.5 1.2  3.5 0.5 2  3.5 3.5 2  0.5 3.5 1.2 patches 3 3 sub 2 2\n";

TEST(PlaneMaps, WhatLiesInsideFurnitureIsHidden) {
  const SolvedScene scene(kFurnished + kPlanes);
  const PlaneMaps& maps = scene.model->planes;
  for (std::uint32_t v = 0; v < 12; ++v) {
    for (std::uint32_t u = 0; u < 12; ++u) {
      const bool inside = u >= 2 && u < 6 && v >= 2 && v < 6;  // of sub-patches of 25 cm
      EXPECT_EQ(maps.hidden[v * 12 + u], inside ? 1 : 0) << u << " " << v;
      EXPECT_EQ(maps.ambient_lx[3 * (v * 12 + u)] > 0, !inside) << u << " " << v;
    }
  }
}

TEST(PlaneMaps, MeasuringChangesNoBitOfTheMaps) {
  const SolvedScene with(kFurnished + kPlanes), without(kFurnished);
  const IlluminanceMaps &a = with.model->maps, &b = without.model->maps;
  ASSERT_EQ(a.direct_lx.size(), b.direct_lx.size());
  for (std::size_t k = 0; k < a.direct_lx.size(); ++k) {
    ASSERT_EQ(a.direct_lx[k], b.direct_lx[k]);
    ASSERT_EQ(a.ambient_lx[k], b.ambient_lx[k]);
  }
  const Statistics &with_planes = statistics(*with.model), &plain = statistics(*without.model);
  EXPECT_EQ(with_planes.patches, plain.patches);
  EXPECT_EQ(with_planes.sub_patches, plain.sub_patches);
  EXPECT_EQ(with_planes.segments_direct, plain.segments_direct);
  EXPECT_EQ(with_planes.segments_ambient, plain.segments_ambient);
  EXPECT_EQ(with_planes.planes, 2u);
  EXPECT_EQ(with_planes.plane_sub_patches, 144u + 36u);
  EXPECT_GT(with_planes.segments_planes, 0u);
  EXPECT_EQ(plain.segments_planes, 0u);
}

void expect_same(const PlaneMaps& a, const PlaneMaps& b) {
  ASSERT_EQ(a.direct_lx.size(), b.direct_lx.size());
  for (std::size_t k = 0; k < a.direct_lx.size(); ++k) {
    ASSERT_EQ(a.direct_lx[k], b.direct_lx[k]) << k;
    ASSERT_EQ(a.ambient_lx[k], b.ambient_lx[k]) << k;
  }
}

TEST(PlaneMaps, FlagsChangeNoBit) {
  Options off;
  off.flags = FlagMode::kOff;
  const SolvedScene without(kFurnished + kPlanes, off), with(kFurnished + kPlanes);
  expect_same(without.model->planes, with.model->planes);
}

TEST(PlaneMaps, EveryBudgetGivesTheSameBitsUpToTheSmallestAndAfterThePicture) {
  Options options;
  options.width = 16, options.height = 12;
  const std::string text = kFurnished + kPlanes + "camera c eye 3.5 0.5 2 look 1 3 0.5 up 0 0 1 fov 60\n";
  SolvedScene roomy(text, options);
  const std::vector<float> direct(roomy.model->planes.direct_lx.begin(), roomy.model->planes.direct_lx.end());
  const std::uint64_t smallest = smallest_memory(*roomy.model);
  for (std::uint64_t bytes = smallest; bytes < 2 * smallest; bytes += smallest / 7) {
    SolvedScene tight(text, options, bytes);
    ASSERT_TRUE(tight.status.done());
    expect_same(tight.model->planes, roomy.model->planes);
    ASSERT_TRUE(draw(*tight.model, {}, {}).done());
    expect_same(tight.model->planes, roomy.model->planes);
    EXPECT_LE(statistics(*tight.model).memory_peak, bytes);
  }
}

}  // namespace
}  // namespace shodo
