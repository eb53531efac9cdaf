// Attenuation of lights, wherever they are looked at: c d^2 of the distance is a c-th of the light.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "model.h"
#include "support/collected_lines.h"
#include "support/solved_scene.h"

namespace shodo {
namespace {

std::vector<std::uint8_t> drawn(SolvedScene& scene) {
  std::vector<std::uint8_t> pixels;
  const LineSink sink = collected_in(pixels);
  EXPECT_TRUE(draw(*scene.model, {}, sink).done());
  return pixels;
}

TEST(Attenuation, OfHalfAtAnyDistanceIsHalfTheLightOverMirrorsAndInHighlightsToo) {
  const std::string head =
      "shodo 1\ndisplay 1 250\ncamera eye eye 0.5 0.5 1 look 2 2 0.8 up 0 0 1 fov 80\n"
      "material white diffuse 0.5\nmaterial mirror diffuse 0.1 reflect 0.8\n"
      "material lacquer diffuse 0.4 highlight 0.3 40\n"
      "object room\nquad lacquer 0 0 0  3 0 0  3 3 0  0 3 0 patches 4 4 sub 2 2\n"
      "quad mirror 3 0 0  3 0 2  3 3 2  3 3 0 patches 1 1 sub 1 1\n"
      "quad white 0 3 0  3 3 0  3 3 2  0 3 2 patches 3 3 sub 2 2\n";
  const std::string area = "light lamp area quad 1 1 1.9  1 1.5 1.9  1.5 1.5 1.9  1.5 1 1.9 luminance ",
                    point = "light bulb point at 1 1 1.7 intensity ";
  Options options;
  options.mirror_light = true;
  options.width = 60;
  options.height = 45;
  for (const auto& [full, half] : {std::pair{area + "3000 attenuation 0 0 2\n", area + "1500\n"},
                                   {point + "400 attenuation 0 0 2\n", point + "200\n"}}) {
    SolvedScene weakened(head + full, options), weak(head + half, options);
    const std::span<const float> a = weakened.model->maps.direct_lx, b = weak.model->maps.direct_lx;
    ASSERT_EQ(a.size(), b.size());
    // The distance is the centre's for all of an area light, so the factor is one half whatever it is; but what isn't
    // inverse square isn't interpolated over a patch, and that has an error of its own.
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 5e-3 * (1 + b[k]));
    const std::vector<std::uint8_t> first = drawn(weakened), second = drawn(weak);
    for (std::size_t k = 0; k < first.size(); ++k) {
      EXPECT_LE(std::abs(first[k] - second[k]), 1) << k;
    }
  }
}

TEST(Attenuation, NoneOfATinyLampIsThatOfAPoint) {
  // A lamp of 2 mm at 2 m: the far tier, one kernel between centres, is all that the error allows asks for.
  const SolvedScene scene(
      "shodo 1\nmaterial black diffuse 0\nobject floor\nquad black 0 0 0  1 0 0  1 1 0  0 1 0 patches 20 20 sub 1 1\n"
      "object lamp\nquad black 0.499 0.499 2  0.499 0.501 2  0.501 0.501 2  0.501 0.499 2 patches 1 1 sub 1 1\n"
      "light l polyhedron object lamp luminance 1000000\n");
  for (std::uint32_t k = 0; k < 400; ++k) {
    const Vec3 at = scene.model->patches[k].centre + scene.model->scene.origin;
    const double squared = (at.x - 0.5) * (at.x - 0.5) + (at.y - 0.5) * (at.y - 0.5) + 4;
    const double expected = 1e6 * 4e-6 * 4 / (squared * squared);
    EXPECT_NEAR(scene.model->direct.patch_lx[k], expected, 2e-3 * expected);
  }
}

}  // namespace
}  // namespace shodo
