// What is drawn beyond illuminance maps can be left out, and light doesn't know it; glass that is drawn only; the
// background's picture; textures read once more for the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "model.h"
#include "support/collected_lines.h"
#include "support/scene_from_text.h"

namespace shodo {
namespace {

std::string noise_ppm(std::uint32_t width, std::uint32_t height, unsigned seed, unsigned least = 0) {
  std::string text = "P6 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
  for (std::uint32_t k = 0; k < 3 * width * height; ++k) {
    seed = seed * 1664525u + 1013904223u;
    text += static_cast<char>(least + (seed >> 24) % (256 - least));
  }
  return text;
}

Options small_picture(bool effects = true) {
  Options options;
  options.width = 64;
  options.height = 48;
  options.effects = effects;
  return options;
}

/// A model with its memory, and its picture.
struct DrawnRun {
  DrawnRun(const std::string& text, TestFiles named, Options options = small_picture(),
           std::size_t bytes = std::size_t{1} << 24)
      : files(std::move(named)), memory(bytes / 8 + 1) {
    status = load("top.scn", text, reader_of(files), options, memory.data(), bytes, model);
    EXPECT_TRUE(status.done()) << to_text(status);
  }
  DrawnRun& solved() {
    EXPECT_TRUE((status = solve(*model, {})).done()) << to_text(status);
    return *this;
  }
  std::vector<std::uint8_t> picture() {
    std::vector<std::uint8_t> pixels;
    const LineSink sink = collected_in(pixels);
    status = draw(*model, {}, sink);
    return pixels;
  }
  bool same_light(const DrawnRun& other) const {
    const auto same = [](std::span<const float> a, std::span<const float> b) {
      return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
    };
    return same(model->maps.direct_lx, other.model->maps.direct_lx) &&
           same(model->maps.ambient_lx, other.model->maps.ambient_lx);
  }

  TestFiles files;
  std::vector<std::uint64_t> memory;
  Model* model = nullptr;
  Status status;
};

/// A room that is open to the front, with or without what is drawn beyond maps.
std::string room(bool plain, bool textured = true) {
  const auto only = [&](const char* words) { return plain ? std::string() : std::string(words); };
  return "shodo 1\nunit m\ndisplay 0 60 roll\ncamera main eye 1.6 1.4 4.5 look 1.4 1 0 up 0 1 0 fov 60\n" +
         only("background zenith 9 20 30 horizon 40 40 40 ground 5 9 3 picture far.ppm towards 0 0 -1 width 60 "
              "luminance 50\n") +
         "material wall diffuse 0.5 0.45 0.4" + (textured ? only(" texture a.ppm size 0.7 0.9") : std::string()) +
         "\nmaterial shiny diffuse 0.3 0.1 0.1" + only(" reflect 0.2 highlight 0.2 20") + "\n" +
         only("material clear diffuse 0 reflect 0.1 transmit 0.8\n"
              "glass clear 0.5 0.2 2  2.5 0.2 2  2.5 1.8 2  0.5 1.8 2\n") +
         "object o\nquad wall 0 0 0  0 0 3  3 0 3  3 0 0\nquad shiny 0 0 0  3 0 0  3 1.5 0  0 1.5 0\n"
         "quad wall 0 0 0  0 2 0  0 2 3  0 0 3\n"
         "light lamp point at 1.5 1.9 1.5 intensity 90 colour 1 0.9 0.8\n";
}
TestFiles pictures() { return {{"a.ppm", noise_ppm(16, 16, 1, 120)}, {"far.ppm", noise_ppm(12, 9, 2)}}; }

TEST(Effects, WithoutThemThePictureIsThatOfASceneThatHasNone) {
  DrawnRun off(room(false, false), pictures(), small_picture(false)), never(room(true), {}),
      on(room(false, false), pictures());
  const std::vector<std::uint8_t> plain = never.solved().picture();
  EXPECT_EQ(off.solved().picture(), plain);
  EXPECT_NE(on.solved().picture(), plain);
  EXPECT_TRUE(off.same_light(never));
  EXPECT_TRUE(DrawnRun(room(false, false), pictures()).solved().same_light(never));  // but for textures' own means
  EXPECT_EQ(on.model->statistics.patches, never.model->statistics.patches);
}

/// What patches reflect is the means of their parts of a texture, so that is read both ways; the outdoor picture isn't.
TEST(Effects, WithoutThemLightIsTheSameAndTheOutdoorPictureNotRead) {
  TestFiles files = pictures();
  DrawnRun on(room(false), files);
  files.erase("far.ppm");
  DrawnRun off(room(false), files, small_picture(false));
  EXPECT_TRUE(off.solved().same_light(on.solved()));
}

TEST(Effects, WithoutThemPanesAreNotDrawn) {
  const std::string pane = "material pane diffuse 0.1 transmit 0.5\nobject p\nquad pane 0 0 2  3 0 2  3 2 2  0 2 2\n";
  // Behind the camera's near half the pane has but its light's part in the picture: what is seen is behind it.
  DrawnRun with(room(true) + pane, {}, small_picture(false)), without(room(true), {}, small_picture(false));
  with.solved();
  without.solved();
  const std::vector<std::uint8_t> seen = with.picture(), open = without.picture();
  std::size_t nothing = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) nothing += (seen[k] == 0) != (open[k] == 0) ? 1 : 0;
  EXPECT_EQ(nothing, 0u);
}

TEST(Glass, IsRefusedUnlessItReflectsOrTransmits) {
  const TestScene scene("shodo 1\nmaterial m diffuse 0.5\nobject o\nquad m 0 0 0  1 0 0  1 1 0  0 1 0\n"
                        "glass m 0 0 1  1 0 1  1 1 1  0 1 1\n");
  EXPECT_EQ(scene.status.line, 5u);
  EXPECT_NE(std::string(scene.status.message).find("a material that reflects or transmits"), std::string::npos);
}

// A sheet that transmits 0.5 halves the luminance of what is behind; seen from behind as well, and where it ends it
// ends.
TEST(Glass, WeakensWhatIsBehindItFromBothSides) {
  for (const char* const glass :
       {"glass half 0 0 1  2 0 1  2 4 1  0 4 1\n", "glass half 0 0 1  0 4 1  2 4 1  2 0 1\n"}) {
    DrawnRun run(std::string("shodo 1\ndisplay 0 100\ncamera c eye 2 2 4 look 2 2 0 up 0 1 0 fov 40\n") +
                "material m diffuse 0.5\nmaterial half diffuse 0 transmit 0.5\nobject o\n"
                "quad m 0 0 0  4 0 0  4 4 0  0 4 0\nlight s sun towards 0 0 -1 illuminance 314.159\n" + glass,
            {});
    const std::vector<std::uint8_t> rgb = run.solved().picture();
    const auto level = [&](std::size_t x) { return rgb[3 * (24 * 64 + x)]; };
    const auto srgb = [](double v) { return 255 * (1.055 * std::pow(v, 1 / 2.4) - 0.055); };
    EXPECT_NEAR(level(10), srgb(0.25), 1);
    EXPECT_NEAR(level(54), srgb(0.5), 1);
  }
}

/// Linear light of a PPM's texel.
double linear_at(const std::string& ppm, std::size_t head, std::size_t texel, std::size_t c) {
  const double s = static_cast<std::uint8_t>(ppm[head + 3 * texel + c]) / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// Every pixel against the projection on a plane at distance 1 and the bilinear formula, in doubles.
TEST(BackgroundPicture, HangsFarAwayUprightAndUnmirrored) {
  const std::uint32_t width = 12, height = 9;
  const std::string far = noise_ppm(width, height, 5, 150);
  const std::size_t head = far.size() - 3 * width * height;
  const std::string text =
      "shodo 1\ndisplay 0 100\ncamera c eye 0 0 0 look -3 0.3 -1 up 0 1 0 fov 40\n"
      "background zenith 0 horizon 0 ground 0 picture far.ppm towards -1 0 -0.2 width 50 luminance 100\n"
      "material m diffuse 0.5\nobject o\nquad m 5 0 0  5 0 1  6 0 1  6 0 0\n";
  Options options = small_picture();
  options.antialias = 1;
  DrawnRun run(text, {{"far.ppm", far}}, options);
  const std::vector<std::uint8_t> rgb = run.solved().picture();
  const auto unit = [](Vec3 v) { return (1 / std::sqrt(dot(v, v))) * v; };
  const Vec3 forward = unit({-3, 0.3, -1}), right = unit(cross(forward, {0, 1, 0})), up = cross(right, forward);
  const Vec3 a = unit({-1, 0, -0.2}), r = unit(cross(a, {0, 1, 0})), u = cross(r, a);
  const double half = std::tan(25 * M_PI / 180), tan_fov = std::tan(20 * M_PI / 180);
  std::size_t within = 0;
  for (std::uint32_t y = 0; y < 48; ++y) {
    for (std::uint32_t x = 0; x < 64; ++x) {
      const double to_right = tan_fov * (2 * (x + 0.5) - 64) / 48, down = tan_fov * (2 * (y + 0.5) / 48 - 1);
      const Vec3 d = forward + to_right * right - down * up;
      const double s = dot(d, r) / dot(d, a) / half, t = dot(d, u) / dot(d, a) / (half * height / width);
      if (std::abs(s) > 0.999 || std::abs(t) > 0.999) continue;
      ++within;
      const double px = (s + 1) / 2 * width - 0.5, py = (1 - t) / 2 * height - 0.5;
      const double x0 = std::floor(px), y0 = std::floor(py);
      for (std::size_t c = 0; c < 3; ++c) {
        double value = 0;
        for (int k = 0; k < 4; ++k) {
          const double i = std::clamp(x0 + k % 2, 0.0, width - 1.0), j = std::clamp(y0 + k / 2, 0.0, height - 1.0);
          const double weight = (k % 2 == 0 ? 1 - (px - x0) : px - x0) * (k / 2 == 0 ? 1 - (py - y0) : py - y0);
          value += weight * linear_at(far, head, static_cast<std::size_t>(j * width + i), c);
        }
        const double srgb = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
        EXPECT_NEAR(rgb[3 * (y * 64 + x) + c], 255 * srgb, 1.5) << x << ' ' << y;  // rounding, and weights of 8 bits
      }
    }
  }
  EXPECT_GT(within, 1500u);
}

/// A square room's four walls of sky, the picture 90 degrees wide: what is beside it is its mirror image.
TEST(BackgroundPicture, GoesOnAroundAsItsMirrorImage) {
  const std::string far = noise_ppm(12, 9, 5, 150);
  const auto drawn = [&](const std::string& look, const std::string& around) {
    Options options = small_picture();
    options.antialias = 1;
    DrawnRun run("shodo 1\ndisplay 0 100\ncamera c eye 0 0 0 look " + look + " up 0 1 0 fov 70\n"
                 "background zenith 0 horizon 0 ground 0 picture far.ppm towards -1 0 0 width 90 luminance 100" +
                 around + "\nmaterial m diffuse 0.5\nobject o\nquad m 0 -6 0  0 -6 1  1 -6 1  1 -6 0\n",
                 {{"far.ppm", far}}, options);
    return run.solved().picture();
  };
  const std::vector<std::uint8_t> ahead = drawn("-1 0 0", " around");
  // Ahead 86 degrees are seen, all of them of the picture.
  EXPECT_EQ(ahead, drawn("-1 0 0", ""));
  for (const char* const beside : {"0 0 1", "0 0 -1"}) {
    const std::vector<std::uint8_t> seen = drawn(beside, " around");
    EXPECT_NE(seen, drawn(beside, ""));
    for (std::size_t y = 0; y < 48; ++y) {
      for (std::size_t x = 0; x < 64; ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(seen[3 * (y * 64 + x) + c], ahead[3 * (y * 64 + 63 - x) + c], 1) << x << ' ' << y;
        }
      }
    }
  }
  // Behind it is mirrored twice.
  const std::vector<std::uint8_t> behind = drawn("1 0 0", " around");
  for (std::size_t k = 0; k < behind.size(); ++k) EXPECT_NEAR(behind[k], ahead[k], 1);
}

TEST(BackgroundPicture, IsNotHungAlongItsUp) {
  const TestScene scene("shodo 1\n"
                        "background zenith 1 horizon 1 ground 1 picture a.ppm towards 0 1 0 width 60 luminance 9\n");
  EXPECT_EQ(scene.status.line, 2u);
}

TEST(Texels, ThatChangedSinceTheSceneWasLoadedAreRefusedBeforeTheFirstLine) {
  DrawnRun run(room(false), pictures());
  run.solved();
  run.files["a.ppm"] = noise_ppm(8, 8, 1, 120);
  EXPECT_TRUE(run.picture().empty());
  EXPECT_EQ(run.status.code, StatusCode::kFile);
  run.files.erase("a.ppm");
  EXPECT_TRUE(run.picture().empty());
  EXPECT_EQ(run.status.code, StatusCode::kFile);
  run.files = pictures();
  EXPECT_FALSE(run.picture().empty());
}

// Textures larger than everything else: the picture takes the memory of what blocks, and solving places it anew.
TEST(Texels, GetTheMemoryOfTheLightAndGiveItBack) {
  TestFiles files = pictures();
  files["a.ppm"] = noise_ppm(120, 120, 7, 120);
  DrawnRun ample(room(false), files);
  const std::vector<std::uint8_t> expected = ample.solved().picture();
  DrawnRun scarce(room(false), files, small_picture(), static_cast<std::size_t>(smallest_memory(*ample.model)));
  for (int k = 0; k < 2; ++k) {
    scarce.solved();
    EXPECT_EQ(scarce.picture(), expected);
    EXPECT_TRUE(scarce.status.done()) << to_text(scarce.status);
    EXPECT_FALSE(scarce.model->placed);
    EXPECT_EQ(scarce.picture(), expected);
  }
}

}  // namespace
}  // namespace shodo
