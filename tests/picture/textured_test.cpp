// Textured surfaces against a slow twin: exact rays and map coordinates, the filter's formulas in doubles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "model.h"
#include "picture/display.h"
#include "picture/textured.h"
#include "picture/view.h"
#include "support/collected_lines.h"
#include "support/files.h"
#include "support/picture_stage.h"
#include "support/picture_twin.h"
#include "support/kept_scene.h"
#include "support/smooth_light.h"
#include "support/texture_twin.h"

namespace shodo {
namespace {

/// A scene with maps that vary, and its picture.
struct TexturedScene {
  TexturedScene(const std::string& text, const TestFiles& files, Options of)
      : loaded(text, of, files), options(of), light(loaded.scene, 400, 100, 0.4), maps(light.maps()) {
    // Of 300 to 500 lx, a picture's levels come from the texture mostly.
    EXPECT_TRUE(place_scene(loaded.scene, loaded.arena, geometry).done());
  }

  std::vector<std::uint8_t> draw() {
    std::vector<std::uint8_t> rgb;
    const LineSink sink = collected_in(rgb);
    const std::uint64_t bytes = picture_bytes(loaded.scene, geometry, options);
    const Arena::Mark before = loaded.arena.mark();
    EXPECT_TRUE(draw_picture(loaded.scene, geometry, maps, options, {}, loaded.arena, sink).done());
    EXPECT_EQ(loaded.arena.mark(), before);
    EXPECT_GT(bytes, 0u);
    return rgb;
  }

  KeptScene loaded;
  Options options;
  Geometry geometry;
  SmoothLight light;
  IlluminanceMaps maps;
};

/// What the design says a textured sample shows, in doubles.
class TextureTwin {
 public:
  TextureTwin(TexturedScene& scene, const SampleGrid& grid)
      : scene_(scene.loaded.scene), geometry_(scene.geometry), twin_(scene_, geometry_, grid), level_(kWhite + 1),
        memory_(std::size_t{1} << 22), arena_(memory_.data(), memory_.size() * 8) {
    EXPECT_TRUE(build_display_maps(scene_, scene.maps, arena_, maps_));
    fill_display_table(level_);
  }

  /// The level that a sample shows in a channel.
  int level(std::int64_t x, std::int64_t y, std::uint32_t c) const {
    const TwinHit hit = twin_.hit(x, y);
    if (hit.triangle == kNone || !hit.front) return 0;
    const DrawnTriangle& drawn = geometry_.drawn[hit.triangle];
    const Mesh& mesh = scene_.meshes[drawn.mesh];
    const auto at = twin_.map_point(hit.triangle, x, y);
    double steps = light(mesh, static_cast<double>(at[0]), static_cast<double>(at[1]), c);
    const std::uint32_t which = texture_of(scene_, mesh);
    if (which != kNone) {
      const Texture& texture = scene_.textures[which];
      const Repeats repeats = texture_repeats(scene_, mesh, texture);
      const auto texel = [&](const std::array<long double, 2>& p) {
        return std::array<long double, 2>{p[0] * repeats.u / mesh.map_width() * texture.width,
                                          (1 - p[1] * repeats.v / mesh.map_height()) * texture.height};
      };
      // Slopes at the sample by central differences over a hundredth of its neighbours' distance would need directions
      // between samples: the coordinates are quotients of linear functions, so three samples a side give them exactly.
      const auto slope = [&](std::int64_t dx, std::int64_t dy, std::size_t k) {
        const long double here = texel(at)[k], next = texel(twin_.map_point(hit.triangle, x + dx, y + dy))[k],
                          before = texel(twin_.map_point(hit.triangle, x - dx, y - dy))[k];
        // u(x) = (a + b x) / (1 + d x): u(1) - u(-1) and u(1) + u(-1) - 2 u(0) give the derivative b - a d.
        const long double n = next - here, p = here - before;
        return static_cast<double>(std::fabs(n + p == 0 ? 0 : 2 * n * p / (n + p)));
      };
      const double step = std::max({slope(1, 0, 0), slope(1, 0, 1), slope(0, 1, 0), slope(0, 1, 1)});
      const double value = filtered_twin(texture, static_cast<double>(texel(at)[0]), static_cast<double>(texel(at)[1]),
                                         step, c);
      const Display& display = scene_.display;
      steps = steps * value / texture.mean[c] - kWhite * display.min_cd_m2 / (display.max_cd_m2 - display.min_cd_m2);
    }
    return level_[static_cast<std::size_t>(std::lround(std::clamp(steps, 0.0, double{kWhite})))];
  }

 private:
  double light(const Mesh& mesh, double u, double v, std::uint32_t c) const {
    const std::int64_t width = mesh.map_width(), height = mesh.map_height();
    return bilinear_twin(u, v, [&](std::int64_t x, std::int64_t y) {
      x = std::clamp<std::int64_t>(x, 0, width - 1);
      y = std::clamp<std::int64_t>(y, 0, height - 1);
      const std::size_t at = mesh.first_sub_patch + static_cast<std::size_t>(y * width + x);
      return double{1} * maps_.texel[at * scene_.channels + c];
    });
  }

  const Scene& scene_;
  const Geometry& geometry_;
  PictureTwin twin_;
  std::vector<std::uint8_t> level_;
  std::vector<std::uint64_t> memory_;
  Arena arena_;
  DisplayMaps maps_;
};

void expect_twin(TexturedScene& scene) {
  const Options& options = scene.options;
  const SampleGrid grid = sample_grid(
      view_of(scene.loaded.scene.cameras[0], scene.geometry.lattice, options.width, options.height), options.width,
      options.height, 1);
  const std::vector<std::uint8_t> rgb = scene.draw();
  const TextureTwin twin(scene, grid);
  std::uint64_t none = 0, one = 0, more = 0;
  for (std::uint32_t y = 0; y < options.height; ++y) {
    for (std::uint32_t x = 0; x < options.width; ++x) {
      for (std::uint32_t c = 0; c < scene.loaded.scene.channels; ++c) {
        const int off = std::abs(twin.level(x, y, c) - rgb[(std::size_t{y} * options.width + x) * 3 + c]);
        ++(off == 0 ? none : off == 1 ? one : more);
      }
    }
  }
  EXPECT_LT(more * 1000, none + one + more) << none << ' ' << one << ' ' << more;
  EXPECT_LT(one * 5, none) << one;
}

Options plain_options() {
  Options options;
  options.width = 200;
  options.height = 160;
  options.antialias = 1;
  return options;
}

TEST(Textured, SurfacesAreTheTwinsToOneLevelAtNineHundredAndNinetyNineOfAThousandPixels) {
  FolderReader folder(source_folder() + "/tests/cli/scenes");
  std::string_view scene, tiles;
  ASSERT_TRUE(folder.read("textures.scn", scene));
  ASSERT_TRUE(folder.read("tiles.ppm", tiles));
  TexturedScene textured{std::string(scene), {{"tiles.ppm", std::string(tiles)}}, plain_options()};
  expect_twin(textured);
}

std::string checks(std::uint32_t size) {
  std::string text = "P5 " + std::to_string(size) + " " + std::to_string(size) + " 255\n";
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) text += (2 * x / size + 2 * y / size) % 2 == 0 ? '\xd0' : '\x20';
  }
  return text;
}

const char* const kPlain =
    "shodo 1\ndisplay 0 250\nmaterial m diffuse 0.4 texture c.pgm size 0.5 0.5\nobject o\n"
    "quad m -400 0 -400  -400 0 400  400 0 400  400 0 -400  patches 16 16 sub 1 1\n";

// Up to the horizon, 1,600 repeats away.
TEST(Textured, PlainsAreTheTwinsUpToTheHorizon) {
  TexturedScene plain(std::string(kPlain) + "camera a eye 0 1.5 0 look 5 0.9 3 up 0 1 0 fov 65\n",
                      {{"c.pgm", checks(16)}}, plain_options());
  expect_twin(plain);
}

/// A ramp of four texels across (or up) a texture, in linear light: what a sample shows tells where on it it lies.
std::string ramp(bool across) {
  std::string text = "P5 4 4 255\n";
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const double linear = ((across ? x : 3 - y) + 0.5) / 4;
      const double srgb = 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
      text += static_cast<char>(static_cast<unsigned char>(std::lround(255 * srgb)));
    }
  }
  return text;
}

// From beneath the eye, and behind it, to the horizon. Levels tell places to 0.04 texel: a level is 0.0094 of white at
// most, in the texture and in the picture, and each is rounded.
TEST(Textured, CoordinatesAreWithinASixteenthOfATexelOfTheExactOnesUpToTheHorizon) {
  for (const double height : {0.01, 0.3, 8.0}) {
    for (const bool across : {true, false}) {
      TexturedScene scene(
          "shodo 1\ndisplay 0 110\nmaterial m diffuse 0.4 texture r.pgm\nobject o\n"
          "quad m -90 0 -90  -90 0 90  90 0 90  90 0 -90  patches 1 1 sub 3 2\n"
          "camera a eye 1 " + std::to_string(height) + " 2 look 4 " + std::to_string(0.9 * height) +
              " 4 up 0 1 0 fov 70\n",
          {{"r.pgm", ramp(across)}}, plain_options());
      scene.light.fill(400);
      const Scene& s = scene.loaded.scene;
      const SampleGrid grid = sample_grid(view_of(s.cameras[0], scene.geometry.lattice, 200, 160), 200, 160, 1);
      const PictureTwin twin(s, scene.geometry, grid);
      const std::vector<std::uint8_t> rgb = scene.draw();
      const double white = 0.4 * 400 / M_PI / 110 / (s.textures[0].mean[0] / 65535.0);
      std::size_t compared = 0;
      double worst = 0;
      for (std::uint32_t y = 1; y + 1 < 160; ++y) {
        for (std::uint32_t x = 1; x + 1 < 200; ++x) {
          const TwinHit hit = twin.hit(x, y);
          if (hit.triangle == kNone || !hit.front) continue;
          const auto texel = [&](std::int64_t at_x, std::int64_t at_y) {
            const auto at = twin.map_point(hit.triangle, at_x, at_y);
            return static_cast<double>(across ? at[0] / s.meshes[0].map_width() : at[1] / s.meshes[0].map_height()) * 4;
          };
          const double exact = texel(x, y);
          // Nearer the horizon coarser levels show, and beyond it neighbours lie behind the eye.
          bool fine = exact > 0.5 && exact < 3.5 && twin.hit(x, y - 1).triangle != kNone;
          for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
            fine = fine && std::abs(texel(x + dx, y + dy) - exact) < 0.9;
          }
          if (!fine) continue;
          const double srgb = rgb[3 * (std::size_t{y} * 200 + x)] / 255.0;
          const double linear = srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
          worst = std::max(worst, std::abs(linear / white * 4 - exact));
          ++compared;
        }
      }
      EXPECT_GT(compared, 1000u) << height;
      EXPECT_LE(worst, 1.0 / 16) << height << ' ' << across;
    }
  }
}

// Where a map is so fine that fixed point doesn't hold its coordinates, its texture's mean is shown.
TEST(Textured, ManyThousandSubPatchesShowTheMean) {
  TexturedScene scene(
      "shodo 1\ndisplay 0 250\nmaterial m diffuse 0.4 texture c.pgm size 0.5 0.5\nobject o\n"
      "quad m -40 0 -40  -40 0 40  40 0 40  40 0 -40  patches 1 1 sub 40000 1\n"
      "camera a eye 0 1.5 0 look 3 0 2 up 0 1 0 fov 65\n",
      {{"c.pgm", checks(16)}}, plain_options());
  scene.light.fill(400);
  const std::vector<std::uint8_t> rgb = scene.draw();
  // 400 lx at reflectance 0.4: 0.4 * 400 / pi / 250 of white, as sRGB.
  const double linear = 0.4 * 400 / M_PI / 250, expected = 255 * (1.055 * std::pow(linear, 1 / 2.4) - 0.055);
  std::size_t seen = 0;
  for (const std::uint8_t value : rgb) {
    if (value == 0) continue;
    ++seen;
    EXPECT_NEAR(value, expected, 1.5);
  }
  EXPECT_GT(seen, rgb.size() / 2);
}

// Far away a texture is its mean: neither pixels nor pictures from eyes that are a little apart differ more than light
// does, whereas near by black and white stand side by side.
TEST(Textured, NothingShimmersAtADistance) {
  std::vector<std::uint8_t> first;
  for (const char* const eye : {"0", "0.11", "0.23"}) {
    TexturedScene plain(std::string(kPlain) + "camera a eye " + eye + " 1.5 0 look 400 -30 40 up 0 1 0 fov 40\n",
                        {{"c.pgm", checks(16)}}, plain_options());
    plain.light.fill(400);
    const std::vector<std::uint8_t> rgb = plain.draw();
    const auto row = [&](std::uint32_t y) {
      const auto* const begin = &rgb[std::size_t{y} * 600];
      const auto [low, high] = std::minmax_element(begin, begin + 600);
      return *high - *low;
    };
    std::uint32_t horizon = 0;
    while (rgb[std::size_t{horizon} * 600 + 300] == 0) ++horizon;
    for (std::uint32_t y = horizon + 2; y < horizon + 8; ++y) EXPECT_LE(row(y), 1) << y;
    EXPECT_GT(row(159), 100);
    if (first.empty()) first = rgb;
    for (std::size_t k = (horizon + 2) * 600u; k < (horizon + 8) * 600u; ++k) EXPECT_NEAR(rgb[k], first[k], 1);
  }
}

// A texture of one colour multiplies by 1, whatever MIN is; what a lamp emits isn't multiplied.
TEST(Textured, OneColourShowsWhatNoTextureShows) {
  for (const char* const display : {"display 0 200\n", "display 20 200\n",
                                    "display 5 200\nlight lamp polyhedron object o luminance 60 colour 1 0.5 0.2\n"}) {
    const std::string shown = display, object = "object o\nquad m 0 0 0  3 0 0  3 2 0  0 2 0 patches 4 4 sub 2 2\n";
    const std::size_t lamp = shown.find("light");
    const std::string rest = shown.substr(0, lamp) + object + (lamp < shown.size() ? shown.substr(lamp) : "") +
                             "camera a eye 1.5 1 2 look 1.5 1 0 up 0 1 0 fov 60\n";
    TexturedScene with("shodo 1\nmaterial m diffuse 0.6 0.5 0.4 texture c.ppm\n" + rest,
                       {{"c.ppm", "P6 2 1 255\nabcabc"}}, plain_options());
    TexturedScene without("shodo 1\nmaterial m diffuse 0.6 0.5 0.4\n" + rest, {}, plain_options());
    const std::vector<std::uint8_t> a = with.draw(), b = without.draw();
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1);
  }
}

// A sign's left and right border, upper and lower one are of different colours: none looks round the corner.
TEST(Textured, WithoutASizeASurfaceShowsItsTextureOnceAndUpright) {
  const std::string sign = "P5 2 2 255\n\x10\x60\xa0\xe0";
  TexturedScene scene(
      "shodo 1\ndisplay 0 400\nmaterial m diffuse 0.3 texture s.pgm\nobject o\n"
      "quad m 0 0 0  3 0 0  3 2 0  0 2 0 patches 1 1 sub 1 1\ncamera a eye 1.5 1 2 look 1.5 1 0 up 0 1 0 fov 53\n",
      {{"s.pgm", sign}}, plain_options());
  const std::vector<std::uint8_t> rgb = scene.draw();
  std::uint32_t top = 0, left = 0;
  while (rgb[(top * 200 + 100) * 3] == 0) ++top;
  while (rgb[(80 * 200 + left) * 3] == 0) ++left;
  const auto at = [&](std::uint32_t x, std::uint32_t y) { return rgb[(std::size_t{y} * 200 + x) * 3]; };
  const std::uint8_t corner[4] = {at(left, top), at(199 - left, top), at(left, 159 - top), at(199 - left, 159 - top)};
  for (int k = 1; k < 4; ++k) EXPECT_GT(corner[k], corner[k - 1] + 20);
  for (std::uint32_t d = 1; d < 20; ++d) {
    EXPECT_EQ(at(left + d, top + d), corner[0]);
    EXPECT_EQ(at(199 - left - d, 159 - top - d), corner[3]);
  }
}

TEST(Textured, ScenesWithoutTexturesTakeNoBytesForThem) {
  const LoadedScene plain("shodo 1\nmaterial m diffuse 0.5\nobject o\nquad m 0 0 0  0 0 1  1 0 1  1 0 0\n");
  EXPECT_EQ(mesh_texture_bytes(plain.scene), 0u);
  EXPECT_TRUE(plain.scene.texture_linear.empty());
}

}  // namespace
}  // namespace shodo
