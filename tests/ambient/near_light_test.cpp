// Sub-patches to which a point light is near, and what others gather from them, against sums over small pieces.
#include "ambient/near_light.h"

#include <cmath>

#include "tests/ambient/gathered.h"

namespace shodo {
namespace {

/// Lights of a scene that are near to its only sub-patch, a square of 1 that faces up.
std::vector<std::string> near_to_square(const std::string& lights) {
  const LoadedScene loaded(grey(0.5) + "object floor_\n" + facing("+z", "white", {0, 0, 0}, {1, 1, 0}) + lights);
  const Scene& scene = loaded.scene;
  std::vector<std::string> names;
  for_near_lights(scene, 1e-6, [&](std::uint32_t l, std::uint32_t m, std::uint32_t k, const NearLight& where) {
    EXPECT_EQ(m + k, 0u);
    names.emplace_back(scene.lights[l].name);
    const Vec3 at = Vec3{0.1, 0.7, 0} - scene.origin, off = scene.lights[l].position - at;
    if (!scene.lights[l].aimed) {
      EXPECT_NEAR(where.lux(scene, scene.lights[l], at, 1e-6), 100 * off.z / std::pow(length(off), 3), 1e-9);
    }
  });
  return names;
}
using Names = std::vector<std::string>;

/// Over the middle, h high, a corner gets (h^2 / (h^2 + 1/2))^(3/2) of what the middle gets: a half at h = 0.92, a
/// sixteenth at 0.306.
TEST(NearLight, IsNeitherTooFarNorTooNear) {
  const auto at = [](double h) {
    return near_to_square("light lamp point at 0.5 0.5 " + std::to_string(h) + " intensity 100\n");
  };
  EXPECT_EQ(at(0.93), Names());
  EXPECT_EQ(at(0.91), Names{"lamp"});
  EXPECT_EQ(at(0.31), Names{"lamp"});
  EXPECT_EQ(at(0.30), Names());
  EXPECT_EQ(at(-0.5), Names());
}

/// Over a quarter of the square the middle gets 13 times what a corner gets, the point below the lamp 50 times; a lamp
/// beside the square has no point below it there.
TEST(NearLight, IsLookedAtBelowItTooIfThatIsOnTheSubPatch) {
  EXPECT_EQ(near_to_square("light lamp point at 0.25 0.25 0.3 intensity 100\n"), Names());
  EXPECT_EQ(near_to_square("light lamp point at -0.5 0.5 0.3 intensity 100\n"), Names{"lamp"});
}

/// Near along a wall, but farther than three sides.
TEST(NearLight, IsWithinThreeSides) {
  EXPECT_EQ(near_to_square("light lamp point at 3.4 0.5 0.2 intensity 100\n"), Names{"lamp"});
  EXPECT_EQ(near_to_square("light lamp point at 3.6 0.5 0.2 intensity 100\n"), Names());
}

TEST(NearLight, IsAPointLightThatShinesThere) {
  EXPECT_EQ(near_to_square("light up point at 0.5 0.5 0.5 towards 0 0 1 intensity 100 cosine 1\n"
                           "light area area quad 0.4 0.4 0.5  0.4 0.6 0.5  0.6 0.6 0.5  0.6 0.4 0.5 luminance 100\n"
                           "light sun sun towards 0 0 -1 illuminance 1000\n"
                           "light down point at 0.5 0.5 0.8 towards 0 0 -1 intensity 100 cosine 1\n"
                           "light lamp point at 0.5 0.5 0.5 intensity 100\n"),
            (Names{"down", "lamp"}));
}

/// Every cell of a grid and every patch of a triangle is looked at: the lamp stands over one of them.
TEST(NearLight, IsFoundOnMeshesOfEveryKind) {
  const LoadedScene loaded(grey(0.5) + "object floor_\n"
                           "grid white 3 2  0 0 0  4 0 0  8 0 0  0 4 0  4 4 0  8 4 0 sub 1 1\n"
                           "tri white 0 10 0  8 10 0  0 18 0  patches 2 sub 2\n"
                           "quad white 0 20 0  8 20 0  8 28 0  0 28 0  patches 2 2 sub 2 2\n"
                           "light one point at 6 2 -2 intensity 100\n"
                           "light two point at 5.3 11.3 1 intensity 100\n"
                           "light three point at 1 27 1 intensity 100\n");
  const Scene& scene = loaded.scene;
  std::vector<std::pair<std::uint32_t, Vec3>> found;
  for_near_lights(scene, 1e-6, [&](std::uint32_t l, std::uint32_t m, std::uint32_t k, const NearLight&) {
    EXPECT_EQ(l, m);
    const Vec3 off = sub_patch_piece(scene, scene.meshes[m], k).centre() - scene.lights[l].position;
    if (off.x * off.x + off.y * off.y < 2) found.emplace_back(m, off);
  });
  ASSERT_GE(found.size(), 3u);
  EXPECT_EQ(found.front().first, 0u);
  EXPECT_EQ(found.back().first, 2u);
}

/// Sub-patches far from the middle of their patch, and long ones, to whose ends nothing else is near.
TEST(NearLight, IsFoundWhereverASubPatchIsOnItsPatch) {
  const auto found = [](const std::string& counts, const std::string& at) {
    const LoadedScene loaded(grey(0.5) + "object floor_\n" + facing("+z", "white", {0, 0, 0}, {8, 8, 0}, counts) +
                             "light lamp point at " + at + " intensity 100\n");
    std::uint32_t count = 0;
    const auto add = [&](std::uint32_t, std::uint32_t, std::uint32_t, const NearLight&) { ++count; };
    for_near_lights(loaded.scene, 1e-6, add);
    return count;
  };
  EXPECT_GE(found("patches 1 1 sub 8 8", "7.5 7.5 0.5"), 1u);
  EXPECT_GE(found("patches 1 1 sub 1 8", "16 4 2"), 1u);
  EXPECT_GE(found("patches 1 1 sub 8 1", "4 16 2"), 1u);
}

/// A floor of one sub-patch with a lamp over it, and black walls of 4 x 4 sub-patches at both of its ends.
struct Lamp {
  static constexpr double kX = 0.2, kY = 0.4, kHeight = 0.45, kIntensity = 100, kColour[3] = {1, 0.5, 0.25};

  explicit Lamp(const std::string& more = "", double part = 1)
      : g(black_and_white() + "object floor_\n" + facing("+z", "white", {0, 0, 0}, {1, 1, 0}) + "object walls\n" +
              facing("+x", "black", {0, 0, 0}, {0, 1, 1}, "patches 4 4 sub 1 1") +
              facing("-x", "black", {1, 0, 0}, {1, 1, 1}, "patches 4 4 sub 1 1") + more +
              "light lamp point at 0.2 0.4 0.45 intensity 100 colour 1 0.5 0.25\n",
          65536, [](const Vec3&, std::uint32_t m) { return m == 0 ? 1.0 : 0; }) {
    double mean = 0;
    for (int k = 0; k < 200 * 200; ++k) mean += lux((k % 200 + 0.5) / 200, (k / 200 + 0.5) / 200) / (200 * 200);
    for (std::uint32_t c = 0; c < 3; ++c) g.direct[c] = static_cast<float>(part * mean * kColour[c]);
    std::fill(g.lx.begin(), g.lx.end(), 0.0f);
    EXPECT_TRUE(g.gather().done());
  }

  static double lux(double x, double y) {
    const double squared = (x - kX) * (x - kX) + (y - kY) * (y - kY) + kHeight * kHeight;
    return kIntensity * kHeight / (squared * std::sqrt(squared));
  }
  /// By the floor's light as it is, of 50 x 50 pieces, or by its mean.
  Errors errors(bool even) const {
    const Scene& s = g.scene.loaded.scene;
    Errors errors;
    for (std::uint32_t m = 1; m < 3; ++m) {
      for (std::uint32_t k = 0; k < 16; ++k) {
        const Piece own = sub_patch_piece(s, s.meshes[m], k);
        double sum = 0;
        for (int p = 0; p < 36; ++p) {
          const Vec3 at = own.point((p % 6 + 0.5) / 6, (p / 6 + 0.5) / 6) + s.origin;
          for (int cell = 0; cell < 50 * 50; ++cell) {
            const double x = cell % 50 / 50.0, y = cell / 50 / 50.0, side = 1 / 50.0;
            Piece piece;
            piece.corner[0] = {x, y, 0}, piece.corner[1] = {x + side, y, 0};
            piece.corner[2] = {x + side, y + side, 0}, piece.corner[3] = {x, y + side, 0};
            const double sent = even ? static_cast<double>(g.direct[0]) : lux(x + side / 2, y + side / 2);
            sum += 0.5 * sent * filled(at, normalised(own.vector_area()), piece) / 36;
          }
        }
        for (std::uint32_t c = 0; c < 3; ++c) errors.add(g.gathered(m, k, c) / kColour[c], sum);
      }
    }
    return errors;
  }

  Gathered g;
};

/// The walls get a quarter more or less than from an even floor. 65,536 lines leave 0.15 % (measured).
TEST(NearLight, WhatASubPatchSendsDependsOnWhere) {
  const Lamp room;
  EXPECT_LT(room.errors(false).rms(), 0.004);
  EXPECT_GT(room.errors(true).rms(), 0.1);
}

/// Where there are panes lines are followed one by one; this one hangs out of the way.
TEST(NearLight, SendsSoPastPanes) {
  const Lamp room("material clear diffuse 0 transmit 0.9\nobject pane_\n" +
                  facing("+z", "clear", {0, 0, 2}, {1, 1, 2}));
  EXPECT_LT(room.errors(false).rms(), 0.004);
}

/// A tenth of its light doesn't arrive, as something stands in its way: nobody knows where.
TEST(NearLight, OfALightThatIsPartlyHiddenTheMeanIsSent) {
  const Lamp room("", 0.9);
  EXPECT_LT(room.errors(true).rms(), 0.004);
}

/// Most of what falls on the floor is another light's, and that is even.
TEST(NearLight, OfALightBesideABrighterOneTheMeanIsSent) {
  const Lamp room("", 2.1);
  EXPECT_LT(room.errors(true).rms(), 0.004);
}

}  // namespace
}  // namespace shodo
