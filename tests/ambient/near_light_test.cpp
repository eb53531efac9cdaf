// Sub-patches to which a point light is near, and what others gather from them, against sums over small pieces.
#include "ambient/near_light.h"

#include <cmath>

#include "support/solved_scene.h"
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
  EXPECT_EQ(SentLight::uneven_count(scene, 1e-6), names.size());
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
  std::uint32_t all = 0;
  for_near_lights(scene, 1e-6, [&](std::uint32_t l, std::uint32_t m, std::uint32_t k, const NearLight&) {
    ++all;
    EXPECT_EQ(l, m);
    const Vec3 off = sub_patch_piece(scene, scene.meshes[m], k).centre() - scene.lights[l].position;
    if (off.x * off.x + off.y * off.y < 2) found.emplace_back(m, off);
  });
  ASSERT_GE(found.size(), 3u);
  EXPECT_EQ(found.front().first, 0u);
  EXPECT_EQ(found.back().first, 2u);
  EXPECT_EQ(SentLight::uneven_count(scene, 1e-6), all);
}

/// Sub-patches far from the middle of their patch, and long ones, to whose ends nothing else is near.
TEST(NearLight, IsFoundWhereverASubPatchIsOnItsPatch) {
  const auto found_on = [](const std::string& meshes, const std::string& at) {
    const LoadedScene loaded(grey(0.5) + "object floor_\n" + meshes + "light lamp point at " + at + "\n");
    std::uint32_t count = 0;
    const auto add = [&](std::uint32_t, std::uint32_t, std::uint32_t, const NearLight&) { ++count; };
    for_near_lights(loaded.scene, 1e-6, add);
    EXPECT_EQ(SentLight::uneven_count(loaded.scene, 1e-6), count);
    return count;
  };
  const auto found = [&](const std::string& counts, const std::string& at) {
    return found_on(facing("+z", "white", {0, 0, 0}, {8, 8, 0}, counts), at + " intensity 100");
  };
  EXPECT_GE(found("patches 1 1 sub 8 8", "7.5 7.5 0.5"), 1u);
  EXPECT_GE(found("patches 1 1 sub 1 8", "16 4 2"), 1u);
  EXPECT_GE(found("patches 1 1 sub 8 1", "4 16 2"), 1u);
  // The last three of twelve cells, and of twelve patches.
  std::string grid = "grid white 13 2 ";
  for (int k = 0; k < 26; ++k) grid += " " + std::to_string(k % 13) + (k < 13 ? " 0 0" : " 1 0");
  EXPECT_EQ(found_on(grid + " sub 1 1\n", "11.5 0.5 -0.5 intensity 100"), 3u);
  const std::string strip = facing("+z", "white", {0, 0, 0}, {12, 1, 0}, "patches 12 1 sub 1 1");
  EXPECT_EQ(found_on(strip, "11.5 0.5 0.5 intensity 100"), 3u);
  // A kite whose first corner is near its middle, a lamp beyond the second; and one there that shines away from the
  // first.
  const std::string kite = "quad white 3 3 0  8 0 0  8 8 0  0 8 0 patches 1 1 sub 8 8\n";
  EXPECT_GE(found_on(kite, "9.3 -1.3 0.5 intensity 100"), 1u);
  EXPECT_GE(found_on(kite, "7.2 1 0.5 towards 1 -0.5 -0.5 intensity 100 cosine 1"), 1u);
  // A long triangle, a lamp beyond its tip: what else is in the scene doesn't matter.
  const std::string beside = facing("+z", "white", {-3.5, -1, 0}, {-3, 1, 0});
  EXPECT_GE(found_on("tri white 0 -1 0  12 0 0  0 1 0 patches 1 sub 12\n" + beside, "13.5 0 0.5 intensity 100"), 1u);
}

struct Lamp {
  double x, y, height;
};
using Lamps = std::vector<Lamp>;

/// A floor of one sub-patch for each lamp, 1 x 1 each and side by side, and black walls of 4 x 4 sub-patches at both of
/// its ends. A sub-patch has its own lamp's light as it is, the others' in the mean.
struct Lit {
  static constexpr double kIntensity = 100;

  explicit Lit(const Lamps& at = {{0.2, 0.4, 0.45}}, const Vec3& light = {1, 0.5, 0.25}, const std::string& more = "",
               double part = 1)
      : lamps(at), colour{light.x, light.y, light.z}, arriving(part),
        g(text(more), 65536, [](const Vec3&, std::uint32_t m) { return m == 0 ? 1.0 : 0; }) {
    const std::uint32_t channels = g.scene.loaded.scene.channels;
    EXPECT_EQ(channels, light.x == light.y ? 1u : 3u);
    for (std::uint32_t k = 0; k < lamps.size(); ++k) {
      own.push_back(mean(k, k));
      others.push_back(-own[k]);
      for (std::uint32_t l = 0; l < lamps.size(); ++l) others[k] += mean(k, l);
      for (std::uint32_t c = 0; c < channels; ++c) {
        g.direct[k * channels + c] = static_cast<float>(part * (own[k] + others[k]) * colour[c]);
      }
    }
    std::fill(g.lx.begin(), g.lx.end(), 0.0f);
    EXPECT_TRUE(g.gather().done());
  }

  std::string text(const std::string& more) const {
    const double end = static_cast<double>(lamps.size());
    std::string text = black_and_white() + "object floor_\n" +
                       facing("+z", "white", {0, 0, 0}, {end, 1, 0},
                              "patches " + std::to_string(lamps.size()) + " 1 sub 1 1") +
                       "object walls\n" + facing("+x", "black", {0, 0, 0}, {0, 1, 1}, "patches 4 4 sub 1 1") +
                       facing("-x", "black", {end, 0, 0}, {end, 1, 1}, "patches 4 4 sub 1 1") + more;
    for (std::size_t l = 0; l < lamps.size(); ++l) {
      text += "light lamp" + std::to_string(l) + " point at";
      for (const double at : {lamps[l].x, lamps[l].y, lamps[l].height}) text += " " + std::to_string(at);
      text += " intensity 100 colour";
      for (const double part : colour) text += " " + std::to_string(part);
      text += "\n";
    }
    return text;
  }

  double lux(std::uint32_t l, double x, double y) const {
    const Lamp& lamp = lamps[l];
    const double squared = (x - lamp.x) * (x - lamp.x) + (y - lamp.y) * (y - lamp.y) + lamp.height * lamp.height;
    return kIntensity * lamp.height / (squared * std::sqrt(squared));
  }
  double mean(std::uint32_t k, std::uint32_t l) const {
    double sum = 0;
    for (int n = 0; n < 200 * 200; ++n) sum += lux(l, k + (n % 200 + 0.5) / 200, (n / 200 + 0.5) / 200);
    return sum / (200 * 200);
  }
  /// By the floor's light as it is, of 50 x 50 pieces a sub-patch, or by the means that arrive.
  Errors errors(bool even) const {
    const Scene& s = g.scene.loaded.scene;
    Errors errors;
    for (std::uint32_t m = 1; m < 3; ++m) {
      for (std::uint32_t k = 0; k < 16; ++k) {
        const Piece wall = sub_patch_piece(s, s.meshes[m], k);
        double sum = 0;
        for (int p = 0; p < 36; ++p) {
          const Vec3 at = wall.point((p % 6 + 0.5) / 6, (p / 6 + 0.5) / 6) + s.origin;
          for (std::uint32_t cell = 0; cell < 50 * 50 * lamps.size(); ++cell) {
            const std::uint32_t l = cell / (50 * 50);
            const double x = l + cell % 50 / 50.0, y = cell / 50 % 50 / 50.0, side = 1 / 50.0;
            Piece piece;
            piece.corner[0] = {x, y, 0}, piece.corner[1] = {x + side, y, 0};
            piece.corner[2] = {x + side, y + side, 0}, piece.corner[3] = {x, y + side, 0};
            const double sent = even ? arriving * (own[l] + others[l]) : others[l] + lux(l, x + side / 2, y + side / 2);
            sum += 0.5 * sent * filled(at, normalised(wall.vector_area()), piece) / 36;
          }
        }
        for (std::uint32_t c = 0; c < s.channels; ++c) {
          if (colour[c] > 0) errors.add(g.gathered(m, k, c) / colour[c], sum);
        }
      }
    }
    return errors;
  }

  Lamps lamps;
  double colour[3], arriving;
  std::vector<double> own, others;  // lux, means over sub-patches
  Gathered g;
};
constexpr Vec3 kWhite{1, 1, 1};

/// The walls get a quarter more or less than from an even floor. 65,536 lines leave 0.15 % (measured).
TEST(NearLight, WhatASubPatchSendsDependsOnWhere) {
  const Lit room;
  EXPECT_LT(room.errors(false).rms(), 0.004);
  EXPECT_GT(room.errors(true).rms(), 0.1);
}

/// Through all stages: there is room for what was counted when the scene was loaded.
TEST(NearLight, SendsSoInAWholeSolution) {
  Lit room;
  Options options;
  options.gather = true;
  options.gather_lines = 65536;
  const SolvedScene solved(room.text(""), options);
  const std::span<const float> lx = solved.model->maps.ambient_lx;
  room.g.lx.assign(lx.begin(), lx.end());
  EXPECT_LT(room.errors(false).rms(), 0.004);
}

/// In one channel, and where the first of three is dark.
TEST(NearLight, SendsSoInAnyColour) {
  for (const Vec3& light : {kWhite, Vec3{0, 0.5, 0.25}}) {
    const Lit room({{0.2, 0.4, 0.45}}, light);
    EXPECT_LT(room.errors(false).rms(), 0.004) << light.x;
  }
}

/// Each sub-patch has a lamp of its own, from which it has more than half; the other's counts as its mean.
TEST(NearLight, SeveralSubPatchesSendSo) {
  const Lit room({{0.2, 0.4, 0.45}, {1.7, 0.5, 0.45}});
  EXPECT_LT(room.errors(false).rms(), 0.004);
  EXPECT_GT(room.errors(true).rms(), 0.1);
}

/// Where there are panes lines are followed one by one; this one hangs out of the way.
TEST(NearLight, SendsSoPastPanes) {
  const Lit room({{0.2, 0.4, 0.45}}, {1, 0.5, 0.25},
                 "material clear diffuse 0 transmit 0.9\nobject pane_\n" + facing("+z", "clear", {0, 0, 2}, {1, 1, 2}));
  EXPECT_LT(room.errors(false).rms(), 0.004);
}

/// A tenth of its light doesn't arrive, as something stands in its way: nobody knows where.
TEST(NearLight, OfALightThatIsPartlyHiddenTheMeanIsSent) {
  const Lit room({{0.2, 0.4, 0.45}}, kWhite, "", 0.9);
  EXPECT_LT(room.errors(true).rms(), 0.004);
}

/// Most of what falls on the floor is another light's, and that is even.
TEST(NearLight, OfALightBesideABrighterOneTheMeanIsSent) {
  const Lit room({{0.2, 0.4, 0.45}}, kWhite, "", 2.1);
  EXPECT_LT(room.errors(true).rms(), 0.004);
}

}  // namespace
}  // namespace shodo
