// What must not change direct light: unit, place, scale, how its lights are put together.
#include <gtest/gtest.h>

#include "lit_scene.h"

namespace shodo {
namespace {

/// A room with a lamp of each kind and something in the way, all coordinates times `unit`.
void furnish(LitScene& scene, double unit, const Vec3& shift) {
  const auto at = [&](double x, double y, double z) { return unit * Vec3{x, y, z} + shift; };
  scene.room(at(0, 0, 0), at(4, 3, 2.5), 3, 2);
  scene.box(at(1.25, 1, 0), at(2, 1.5, 0.75));
  scene.add_point(at(3, 2, 1.5), 100);
  scene.add_lambertian_point(at(0.5, 0.5, 2), {0.25, 0.5, -1}, 300, 2);
  scene.add_area(at(1, 1, 2.25), at(1, 2, 2.25), at(2.5, 2, 2.25), at(2.5, 1, 2.25), 500);
  scene.add_sun(at(1, 1, 1), {0.5, 0.25, -1}, 1000);
}

TEST(DirectLight, IsTheSameInMetresAndCentimetres) {
  LitScene metres, centimetres;
  furnish(metres, 1, {});
  furnish(centimetres, 100, {});
  centimetres.scene.metres_per_unit = 0.01;
  metres.light();
  centimetres.light();
  // The lattices differ, so that a segment along an edge may: a few sub-patches, each by a sample.
  double sum = 0, difference = 0;
  for (std::size_t k = 0; k < metres.direct.sub_patch_lx.size(); ++k) {
    sum += static_cast<double>(metres.direct.sub_patch_lx[k]);
    difference += std::fabs(static_cast<double>(metres.direct.sub_patch_lx[k] - centimetres.direct.sub_patch_lx[k]));
  }
  EXPECT_LT(difference, 1e-3 * sum);
}

TEST(DirectLight, ShiftedByAnExactAmountHasTheSameBits) {
  LitScene here, there;
  furnish(here, 1, {});
  furnish(there, 1, {1048576, -1048576, 524288});
  here.light();
  there.light();
  for (std::size_t k = 0; k < here.direct.sub_patch_lx.size(); ++k) {
    EXPECT_EQ(here.direct.sub_patch_lx[k], there.direct.sub_patch_lx[k]) << k;
  }
}

TEST(DirectLight, ScaledByAPowerOfTwoIsPointLightOverItsSquareAndAllElseEqual) {
  for (const double scale : {0x1p-13, 0x1p17}) {
    LitScene plain, scaled;
    furnish(plain, 1, {});
    furnish(scaled, scale, {});
    scaled.scene.metres_per_unit = 1 / scale;  // the same room in another unit: all bits equal
    plain.light();
    scaled.light();
    for (std::size_t k = 0; k < plain.direct.sub_patch_lx.size(); ++k) {
      EXPECT_EQ(plain.direct.sub_patch_lx[k], scaled.direct.sub_patch_lx[k]) << k;
    }
  }
  LitScene small, large;
  for (LitScene* scene : {&small, &large}) {
    const double unit = scene == &small ? 1 : 1024;
    scene->room({0, 0, 0}, unit * Vec3{4, 3, 2.5}, 3, 2);
    scene->add_point(unit * Vec3{3, 2, 1.5}, 100);
    scene->light();
  }
  for (std::size_t k = 0; k < small.direct.sub_patch_lx.size(); ++k) {
    EXPECT_EQ(small.direct.sub_patch_lx[k], large.direct.sub_patch_lx[k] * 1048576) << k;
  }
}

TEST(DirectLight, ColourMultipliesEachChannel) {
  LitScene grey, coloured;
  for (LitScene* scene : {&grey, &coloured}) {
    const auto tint = [=](double r, double g, double b) -> LitScene::Change {
      return [=](Light& light) { light.colour = scene == &grey ? Rgb{{1, 1, 1}} : Rgb{{r, g, b}}; };
    };
    scene->room({0, 0, 0}, {4, 3, 2.5}, 3, 2);
    scene->add_point({3, 2, 1.5}, 100, tint(1, 0.5, 0));
    scene->scene.channels = scene == &grey ? 1 : 3;
    scene->light();
  }
  for (std::size_t k = 0; k < grey.direct.sub_patch_lx.size(); ++k) {
    EXPECT_EQ(coloured.direct.sub_patch_lx[3 * k], grey.direct.sub_patch_lx[k]);
    EXPECT_EQ(coloured.direct.sub_patch_lx[3 * k + 1], 0.5f * grey.direct.sub_patch_lx[k]);
    EXPECT_EQ(coloured.direct.sub_patch_lx[3 * k + 2], 0);
  }
  for (std::size_t p = 0; p < grey.patches.size(); ++p) {
    EXPECT_EQ(coloured.direct.patch_lx[3 * p + 1], 0.5 * grey.direct.patch_lx[p]);
  }
}

TEST(DirectLight, OfTwoLightsIsTheSum) {
  const auto add = [](LitScene& scene, int lights) {
    scene.room({0, 0, 0}, {4, 3, 2.5}, 3, 2);
    scene.object();
    scene.box({1.3, 1.1, 0}, {2, 1.6, 0.75});
    if ((lights & 1) != 0) scene.add_point({3, 2, 1.5}, 100);
    if ((lights & 2) != 0) scene.add_area({1, 1, 2.4}, {1, 2, 2.4}, {2.5, 2, 2.4}, {2.5, 1, 2.4}, 500, true);
    scene.light();
  };
  LitScene first, second, both;
  add(first, 1);
  add(second, 2);
  add(both, 3);
  for (std::size_t k = 0; k < both.direct.sub_patch_lx.size(); ++k) {
    const float sum = first.direct.sub_patch_lx[k] + second.direct.sub_patch_lx[k];
    EXPECT_NEAR(both.direct.sub_patch_lx[k], sum, 1e-6f * sum);
  }
}

}  // namespace
}  // namespace shodo
