// Glass in the light: segments through panes carry what all of them transmit, in direct light and in form factors.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "model.h"
#include "shodo/shodo.h"

namespace shodo {
namespace {

class Solved {
 public:
  explicit Solved(const std::string& text, const Options& options = {}) : memory_(std::size_t{16} << 20) {
    const Status loaded = load("top.scn", text, {}, options, memory_.data(), memory_.size(), model_);
    EXPECT_TRUE(loaded.done()) << loaded.message;
    const Status solved = solve(*model_, {});
    EXPECT_TRUE(solved.done()) << solved.message;
  }
  double direct(std::size_t sub_patch, std::uint32_t c = 0) const { return at(model_->maps.direct_lx, sub_patch, c); }
  double ambient(std::size_t sub_patch, std::uint32_t c = 0) const { return at(model_->maps.ambient_lx, sub_patch, c); }
  std::size_t count() const { return model_->scene.sub_patch_count; }
  std::uint32_t channels() const { return model_->scene.channels; }

 private:
  double at(std::span<const float> map, std::size_t sub_patch, std::uint32_t c) const {
    return static_cast<double>(map[sub_patch * model_->scene.channels + c]);
  }
  std::vector<std::byte> memory_;
  Model* model_ = nullptr;
};

/// Floats, and sums of up to 64 weights.
constexpr double kRounding = 1e-6;

const std::string kFloor =
    "shodo 1\nmaterial m diffuse 0.5\nmaterial red diffuse 0 transmit 0.8 0.2 0.1\n"
    "material grey diffuse 0 transmit 0.6\nmaterial dark diffuse 0.001\n"
    "object floor\nquad m 0 0 0  0 0 2  2 0 2  2 0 0  patches 4 4 sub 2 2\n";
constexpr double kRed[3] = {0.8, 0.2, 0.1};
/// Beyond all segments from the floor to what is above 1.2 m; cut into polygons whose seams segments meet.
std::string plate(const std::string& material, double y) {
  std::string text;
  for (const char* x : {"-6 0.5", "0.5 1", "1 8"}) {
    const std::string x0 = std::string(x).substr(0, std::string(x).find(' ')),
                      x1 = std::string(x).substr(std::string(x).find(' ') + 1), h = std::to_string(y);
    text += "quad " + material + " " + x0 + " " + h + " -6  " + x0 + " " + h + " 8  " + x1 + " " + h + " 8  " + x1 +
            " " + h + " -6  patches 1 1 sub 1 1\n";
  }
  return text;
}

TEST(Panes, EveryKindOfLightIsWeakenedByEachPaneOnTheWay) {
  const std::string lights[] = {
      "light l sun towards 0.3 -1 0.2 illuminance 1000\n",
      "light l point at 1 2 1 intensity 300\n",
      "light l point at 0.25 2.5 0.75 towards 0 -1 0 intensity 300 cosine 3\n",
      "light l area quad 0.5 2 0.5  1.5 2 0.5  1.5 2 1.5  0.5 2 1.5 luminance 1000\n",
      "light l area quad -2 1.3 -2  4 1.3 -2  4 1.3 4  -2 1.3 4 luminance 1000\n",  // near: by leaves
      "object lamp\nquad m 0.9 2 0.9  1.1 2 0.9  1.1 2 1.1  0.9 2 1.1  patches 1 1\n"
      "light l polyhedron object lamp luminance 5000\n"};
  for (const std::string& light : lights) {
    for (const FlagMode mode : {FlagMode::kAuto, FlagMode::kOff}) {
      Options options;
      options.flags = mode;
      const Solved plain(kFloor + "object panes\n" + plate("m", -1) + plate("m", -2) + light, options);
      const Solved behind(kFloor + "object panes\n" + plate("red", 1) + plate("grey", 0.5) + light, options);
      ASSERT_EQ(behind.channels(), 3u);
      for (std::size_t k = 0; k < 64; ++k) {
        ASSERT_GT(plain.direct(k), 0) << light;
        for (std::uint32_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(behind.direct(k, c), 0.6 * kRed[c] * plain.direct(k), kRounding * plain.direct(k)) << light;
        }
      }
    }
  }
}

TEST(Panes, LightIsFullBesideThem) {
  const std::string light = "light l sun towards 0 -1 0 illuminance 1000\n";
  const Solved half(kFloor + "object pane\nquad grey 0 1 0  0 1 2  1 1 2  1 1 0  patches 1 1 sub 1 1\n" + light);
  for (std::size_t v = 0; v < 8; ++v) {
    for (std::size_t u = 0; u < 8; ++u) {
      // u runs along z, v along x: the pane is over x < 1.
      EXPECT_NEAR(half.direct(v * 8 + u), v < 4 ? 600 : 1000, 1e-3);
    }
  }
}

TEST(Panes, FormFactorsCarryWhatThePanesTransmit) {
  const std::string other =
      "object top\nquad dark 0 2 0  2 2 0  2 2 2  0 2 2  patches 3 3 sub 1 1\n"
      "light l point at 1 0.3 1 towards 0 -1 0 intensity 300 cosine 1\n";
  for (const bool blocks : {false, true}) {
    Options options;
    options.rules.blocks = blocks;
    options.row_value_bits = 64;
    options.scale_rows = false;
    options.tolerance = 1e-9;
    const Solved plain(kFloor + "object panes\n" + plate("dark", -1) + plate("dark", -2) + other, options);
    const Solved behind(kFloor + "object panes\n" + plate("red", 1.5) + plate("grey", 1) + other, options);
    for (std::size_t k = 70; k < 79; ++k) {  // the top
      ASSERT_GT(plain.ambient(k), 0);
      for (std::uint32_t c = 0; c < 3; ++c) {
        // What goes back and forth is a small part; blocks are linked otherwise where a pane may be between.
        const double tolerance = (blocks ? 1e-2 : 1e-4) * plain.ambient(k);
        EXPECT_NEAR(behind.ambient(k, c), 0.6 * kRed[c] * plain.ambient(k), tolerance) << blocks << ' ' << k;
      }
    }
  }
}

TEST(Panes, ThinAirChangesNothing) {
  // A pane that transmits nearly all and reflects nothing, across a closed room: rows are scaled as without it.
  const auto room = [](const std::string& pane) {
    return "shodo 1\nmaterial m diffuse 0.8\nmaterial air diffuse 0 transmit 0.9999\nobject room\n"
           "quad m 0 0 0  0 0 2  2 0 2  2 0 0  patches 4 4 sub 1 1\nquad m 0 2 0  2 2 0  2 2 2  0 2 2  patches 4 4 "
           "sub 1 1\nquad m 0 0 0  0 2 0  0 2 2  0 0 2  patches 4 4 sub 1 1\nquad m 2 0 0  2 0 2  2 2 2  2 2 0  "
           "patches 4 4 sub 1 1\nquad m 0 0 0  2 0 0  2 2 0  0 2 0  patches 4 4 sub 1 1\nquad m 0 0 2  0 2 2  2 2 2  "
           "2 0 2  patches 4 4 sub 1 1\nlight l point at 0.5 1.1 0.7 intensity 100\n" + pane;
  };
  Options options;
  options.scale_rows = true;
  const Solved plain(room(""), options);
  const Solved divided(room("object pane\nquad air 1 0 0  1 0 2  1 2 2  1 2 0  patches 4 4 sub 1 1\n"), options);
  for (std::size_t k = 0; k < plain.count(); ++k) {
    EXPECT_NEAR(divided.direct(k), plain.direct(k), 1e-3 * plain.direct(k));
    // 16 segments instead of none, row values of 11 bits; the pane takes 1e-4 a passage, of about 5.
    EXPECT_NEAR(divided.ambient(k), plain.ambient(k), 5e-3 * plain.ambient(k)) << k;
  }
}

TEST(Panes, APaneOverHalfOfAWindowWeakensHalfOfItsLight) {
  // The floor's centre sees the window's two halves alike.
  const std::string light = "light l area quad 0.5 2 0.5  1.5 2 0.5  1.5 2 1.5  0.5 2 1.5 luminance 1000\n";
  const std::string floor =
      "shodo 1\nmaterial m diffuse 0.5\nmaterial grey diffuse 0 transmit 0.6\n"
      "object floor\nquad m 0.99 0 0.99  0.99 0 1.01  1.01 0 1.01  1.01 0 0.99  patches 1 1 sub 1 1\n";
  const Solved plain(floor + light);
  const Solved half(floor + "object pane\nquad grey 0 1 0  0 1 2  1 1 2  1 1 0  patches 1 1 sub 1 1\n" + light);
  // Four samples, up to 6 mm off the middle, and 8 or 32 ends: 1 % of the light.
  EXPECT_NEAR(half.direct(0) / plain.direct(0), 0.8, 0.01);
}

}  // namespace
}  // namespace shodo
