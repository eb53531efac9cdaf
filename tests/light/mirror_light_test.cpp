// The first bounce of light over mirrors, against image sources written out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "model.h"
#include "shodo/shodo.h"

namespace shodo {
namespace {

class Lit {
 public:
  explicit Lit(const std::string& text, bool mirror_light = true, FlagMode flags = FlagMode::kAuto)
      : memory_(std::size_t{16} << 20) {
    Options options;
    options.mirror_light = mirror_light;
    options.flags = flags;
    options.scale_rows = false;  // the scenes are open, and two of them are compared
    const Status loaded = load("top.scn", text, {}, options, memory_.data(), memory_.size(), model_);
    EXPECT_TRUE(loaded.done()) << loaded.message;
    EXPECT_TRUE(solve(*model_, {}).done());
  }
  double ambient(std::size_t sub_patch, std::uint32_t c = 0) const {
    return static_cast<double>(model_->maps.ambient_lx[sub_patch * model_->scene.channels + c]);
  }
  double lux(std::size_t sub_patch, std::uint32_t c = 0) const {
    return static_cast<double>(model_->maps.direct_lx[sub_patch * model_->scene.channels + c]);
  }

 private:
  std::vector<std::byte> memory_;
  Model* model_ = nullptr;
};

/// A floor of 8 x 8 sub-patches of 25 cm, u along z, v along x; a mirror at x = 0, as far as light goes.
const std::string kFloor =
    "shodo 1\nmaterial m diffuse 0.5\nmaterial mirror diffuse 0 reflect 0.8 0.6 0.4\nmaterial black diffuse 0\n"
    "material grey diffuse 0 transmit 0.5\n"
    "object floor\nquad m 0 0 0  0 0 2  2 0 2  2 0 0  patches 4 4 sub 2 2\n";
const std::string kMirror = "object mirror\nquad mirror 0 -1 6  0 -1 -4  0 5 -4  0 5 6  patches 1 1 sub 1 1\n";
constexpr double kReflect[3] = {0.8, 0.6, 0.4};

double centre(std::size_t k) { return 0.125 + 0.25 * static_cast<double>(k); }

TEST(MirrorLight, APointLightShinesFromItsImage) {
  const std::string light = "light l point at 1.5 1.5 1 intensity 100\n";
  for (const FlagMode flags : {FlagMode::kAuto, FlagMode::kOff}) {
    const Lit off(kFloor + kMirror + light, false, flags), on(kFloor + kMirror + light, true, flags);
    for (std::size_t v = 0; v < 8; ++v) {
      for (std::size_t u = 0; u < 8; ++u) {
        const double x = centre(v) + 1.5, z = centre(u) - 1, squared = x * x + z * z + 1.5 * 1.5;
        const double image = 100 * 1.5 / (squared * std::sqrt(squared));
        for (std::uint32_t c = 0; c < 3; ++c) {
          // 4 x 4 samples against the value at the centre: 2nd derivatives over 25 cm.
          EXPECT_NEAR(on.lux(v * 8 + u, c) - off.lux(v * 8 + u, c), kReflect[c] * image, 0.005 * image);
        }
      }
    }
  }
}

TEST(MirrorLight, TheSunIsMirroredAndEndsWhereTheMirrorDoes) {
  // Down and towards -x at 45 degrees: a mirror of 1 m throws light on the first metre.
  const std::string sun = "light s sun towards -1 -1 0 illuminance 1000\n";
  const std::string mirror = "object mirror\nquad mirror 0 0 6  0 0 -4  0 1 -4  0 1 6  patches 1 1 sub 1 1\n";
  const Lit off(kFloor + mirror + sun, false), on(kFloor + mirror + sun);
  for (std::size_t v = 0; v < 8; ++v) {
    for (std::size_t u = 0; u < 8; ++u) {
      const double image = v < 4 ? 1000 * std::sqrt(0.5) : 0;
      EXPECT_NEAR(on.lux(v * 8 + u) - off.lux(v * 8 + u), 0.8 * image, 1e-2);
    }
  }
}

TEST(MirrorLight, BothLegsAreTestedAndPanesWeakenThem) {
  const std::string light = "light l point at 1.5 1.5 1 intensity 100\n";
  // Between light and mirror, above all ways to the floor; then between mirror and floor only.
  const std::string wall = "quad %s 0.75 1 -4  0.75 1 6  0.75 5 6  0.75 5 -4  patches 1 1 sub 1 1\n";
  const auto with = [&](const std::string& material) {
    std::string text = wall;
    return "object wall\n" + text.replace(text.find("%s"), 2, material);
  };
  // A light at 1.5 m: what leaves downwards passes x = 0.75 below 1 m if it meets the mirror below 0.5 m.
  const Lit open(kFloor + kMirror + light), closed(kFloor + kMirror + with("black") + light),
      dimmed(kFloor + kMirror + with("grey") + light), off(kFloor + kMirror + light, false);
  std::size_t blocked = 0, free = 0;
  for (std::size_t k = 0; k < 64; ++k) {
    const double x = centre(k / 8), height = 1.5 * x / (x + 1.5), at_wall = (height + 1.5) / 2;
    const double mirrored = open.lux(k) - off.lux(k);
    if (at_wall > 1.05) {
      EXPECT_NEAR(closed.lux(k), off.lux(k), 1e-4) << k;
      EXPECT_NEAR(dimmed.lux(k), off.lux(k) + 0.5 * mirrored, 1e-3 * mirrored) << k;
      ++blocked;
    } else if (at_wall < 0.95) {
      EXPECT_NEAR(closed.lux(k), open.lux(k), 1e-4) << k;
      ++free;
    }
  }
  EXPECT_GT(blocked, 0u);
  EXPECT_GT(free, 0u);
}

TEST(MirrorLight, AnAreaLightShinesAsItsImageThroughAHole) {
  const std::string light = "light l area quad 1.2 1.5 0.8  1.6 1.5 0.8  1.6 1.5 1.2  1.2 1.5 1.2 luminance 2000\n";
  const std::string image = "light i area quad -1.2 1.5 0.8  -1.2 1.5 1.2  -1.6 1.5 1.2  -1.6 1.5 0.8 luminance 1600\n";
  const std::string lamp = "object lamp\nquad m 1.2 1.5 0.8  1.6 1.5 0.8  1.6 1.5 1.2  1.2 1.5 1.2 patches 2 2\n"
                           "light l polyhedron object lamp luminance 2000\n";
  const std::string no_mirror = "object box\nquad black 0 -1 -9  0 -1 -8  0 5 -8  0 5 -9  patches 1 1 sub 1 1\n";
  const Lit alone(kFloor + no_mirror + light), both(kFloor + no_mirror + light + image);
  const Lit area_off(kFloor + kMirror + light, false), area(kFloor + kMirror + light);
  const Lit faces_off(kFloor + kMirror + lamp, false), faces(kFloor + kMirror + lamp);
  for (std::size_t k = 0; k < 64; ++k) {
    const double expected = both.lux(k) - alone.lux(k);
    EXPECT_NEAR(area.lux(k) - area_off.lux(k), expected, 0.01 * expected);
    EXPECT_NEAR(faces.lux(k) - faces_off.lux(k), expected, 0.01 * expected);
  }
}

TEST(MirrorLight, DiffuseSurfacesSendEachOtherLightOverMirrors) {
  // The sun lights the floor, straight down; a wall at x = 2 sees the floor, and its image in the mirror at x = 0. The
  // other scene has a floor there, darker by what the mirror takes.
  const std::string wall = "object wall\nquad black 2 0 0  2 0 2  2 2 2  2 2 0  patches 4 4 sub 1 1\n";
  const std::string sun = "light s sun towards 0 -1 0 illuminance 1000\n";
  const std::string image = "material darker diffuse 0.4 0.3 0.2\nobject image\n"
                            "quad darker -2 0 0  -2 0 2  0 0 2  0 0 0  patches 4 4 sub 2 2\n";
  const Lit off(kFloor + wall + kMirror + sun, false), on(kFloor + wall + kMirror + sun), both(kFloor + image + wall + sun);
  for (std::size_t k = 0; k < 16; ++k) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const double mirrored = on.ambient(64 + k, c) - off.ambient(64 + k, c);
      const double expected = both.ambient(128 + k, c) - off.ambient(64 + k, c);
      ASSERT_GT(expected, 1);
      // 16 kernels a pair here, the near tiers there.
      EXPECT_NEAR(mirrored, expected, 0.01 * both.ambient(128 + k, c)) << k << ' ' << c;
    }
  }
}

TEST(MirrorLight, NothingIsDoneWithoutMirrors) {
  const std::string light = "light l point at 1.5 1.5 1 intensity 100\n";
  const Lit off(kFloor + light, false), on(kFloor + light, true);
  for (std::size_t k = 0; k < 64; ++k) EXPECT_EQ(on.lux(k), off.lux(k));
}

}  // namespace
}  // namespace shodo
