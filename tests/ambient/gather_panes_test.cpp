// What sub-patches gather through panes, and from them.
#include <cmath>

#include "tests/ambient/gathered.h"

namespace shodo {
namespace {

/// A floor under half of which a coloured pane hangs, against a sum over 128 x 128 places of the floor. 16384
/// lines leave 0.9 % (measured).
TEST(GatherPanes, WeakenWhatComesThroughThemChannelByChannel) {
  const double passes[3] = {0.9, 0.5, 0.1};
  Gathered room(black_and_white() + "material red diffuse 0 transmit 0.9 0.5 0.1\nobject floor_\n" +
                    facing("+z", "white", {0, 0, 0}, {4, 4, 0}) + "object ceiling_\n" +
                    facing("-z", "black", {0, 0, 3}, {4, 4, 3}, "patches 8 8 sub 1 1") + "object pane_\n" +
                    facing("+z", "red", {-1, -1, 1.3}, {2.1, 5, 1.3}),
                16384, [](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; });
  const Scene& s = room.scene.loaded.scene;
  ASSERT_EQ(s.channels, 3u);
  ASSERT_EQ(s.optics_of(s.meshes[2].material)->transmit.c[2], passes[2]);
  ASSERT_TRUE(room.gather().done());
  const Mesh& ceiling = s.meshes[1];
  Errors errors[3];
  double dimmest = 1, brightest = 0;
  for (std::uint32_t k = 0; k < ceiling.sub_patch_count(); ++k) {
    const Vec3 at = sub_patch_piece(s, ceiling, k).centre() + s.origin;
    double through = 0, beside = 0;
    for (int i = 0; i < 128 * 128; ++i) {
      const double x = (i % 128 + 0.5) / 32, y = (i / 128 + 0.5) / 32, squared = length_squared(at - Vec3{x, y, 0});
      const double lx = 500 * (3.0 * 3.0) / (M_PI * squared * squared) / (32 * 32);
      (x + (at.x - x) * 1.3 / 3 < 2.1 ? through : beside) += lx;
    }
    for (std::uint32_t c = 0; c < 3; ++c) errors[c].add(room.gathered(1, k, c), beside + passes[c] * through);
    dimmest = std::min(dimmest, through / (through + beside));
    brightest = std::max(brightest, through / (through + beside));
  }
  for (const Errors& each : errors) {
    EXPECT_LT(each.rms(), 0.01);
  }
  // The pane shows: sub-patches see little or most of the floor through it.
  EXPECT_LT(dimmest, 0.35);
  EXPECT_GT(brightest, 0.65);
}

/// The floor, last, gets from the pane, the first, and through it from the ceiling.
struct UnderPane {
  UnderPane(const char* way, const std::string& more)
      : g(black_and_white() +
              "material glass diffuse 0.2 0.1 0.05 transmit 0.5 0.6 0.7\n"
              "material clear diffuse 0 transmit 0.9 0.8 0.6\n"
              "object pane_\n" + facing(way, "glass", {-1, -1, 1}, {3, 3, 1}, "patches 2 2 sub 1 1") +
              "object ceiling_\n" + facing("-z", "white", {-1, -1, 1.5}, {3, 3, 1.5}, "patches 10 10 sub 1 1") + more +
              "object floor_\n" + facing("+z", "black", {0.5, 0.5, 0}, {1.5, 1.5, 0}, "patches 2 2 sub 1 1"),
          16384, [](const Vec3&, std::uint32_t m) { return m == 0 ? 3000.0 : m == 1 ? 1000.0 : 0; }) {
    EXPECT_TRUE(g.gather().done());
    floor = static_cast<std::uint32_t>(g.scene.loaded.scene.meshes.size() - 1);
    const Unhidden all(g);
    for (std::uint32_t c = 0; c < 3; ++c) {
      for (std::uint32_t k = 0; k < 4; ++k) {
        of_pane[c] += 0.25 * all(floor, k, c, 0);
        of_ceiling[c] += 0.25 * all(floor, k, c, 1);
      }
      found[c] = g.mean(floor, c);
    }
  }

  Gathered g;
  std::uint32_t floor = 0;
  double of_pane[3] = {0, 0, 0}, of_ceiling[3] = {0, 0, 0}, found[3];
};

constexpr double kGlass[3] = {0.5, 0.6, 0.7}, kClear[3] = {0.9, 0.8, 0.6};

/// The floor has 1e5 lines and more: some 1e-3 of a hemisphere, and 2e-3 is allowed, of what a bright one would send.
TEST(GatherPanes, FrontsSendWhatTheyReflectAndBacksDont) {
  for (const bool front : {true, false}) {
    const UnderPane u(front ? "-z" : "+z", "");
    for (std::uint32_t c = 0; c < 3; ++c) {
      const double expected = u.of_pane[c] + kGlass[c] * u.of_ceiling[c];
      EXPECT_EQ(u.of_pane[c] > 50, front);
      EXPECT_GT(u.of_ceiling[c], 200);
      EXPECT_NEAR(u.found[c], expected, 1) << front << c;
    }
  }
}

TEST(GatherPanes, StandBehindOneAnother) {
  const UnderPane u("-z", "object near\n" + facing("+z", "clear", {-1.5, -1.5, 0.4}, {3.5, 3.5, 0.4}));
  for (std::uint32_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(u.found[c], kClear[c] * (u.of_pane[c] + kGlass[c] * u.of_ceiling[c]), 1) << c;
  }
}

TEST(GatherPanes, BehindASurfaceSendNothing) {
  const UnderPane u("-z", "object lid\n" + facing("-z", "black", {-1.5, -1.5, 0.4}, {3.5, 3.5, 0.4}));
  for (const double found : u.found) EXPECT_EQ(found, 0);
}

/// A pane is lit like other surfaces: its front gathers, its own glass is not in the way.
TEST(GatherPanes, Gather) {
  Gathered g(black_and_white() + "material glass diffuse 0.2 transmit 0.5\nobject floor_\n" +
                 facing("+z", "white", {0, 0, 0}, {2, 2, 0}) + "object pane_\n" +
                 facing("-z", "glass", {0.5, 0.5, 1}, {1.5, 1.5, 1}, "patches 2 2 sub 1 1"),
             65536, [](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; });
  std::fill(g.lx.begin(), g.lx.end(), 0.0f);
  ASSERT_TRUE(g.gather().done());
  const Unhidden expected(g);
  for (std::uint32_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(g.gathered(1, k), expected(1, k), 2);
  }
}

}  // namespace
}  // namespace shodo
