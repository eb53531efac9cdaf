// Textures of materials: what statements and files give, against formulas in doubles.
#include "scene/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/kept_scene.h"

namespace shodo {
namespace {

const std::string kSquare = "object o\nquad m 0 0 0  0 0 3  2 0 3  2 0 0\n";

std::string ppm(std::uint32_t width, std::uint32_t height, const std::string& texels, const char* head = "P6 ") {
  return head + std::to_string(width) + " " + std::to_string(height) + " 255\n" + texels;
}

std::string noise(std::size_t bytes, unsigned seed, unsigned least = 0, unsigned most = 255) {
  std::mt19937 random(seed);
  std::string texels;
  for (std::size_t k = 0; k < bytes; ++k) texels += static_cast<char>(least + random() % (most - least + 1));
  return texels;
}

double linear(std::uint8_t level) {
  const double s = level / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

std::string scene_with(const std::string& words) { return "shodo 1\nmaterial m diffuse 0.1 " + words + "\n" + kSquare; }

TEST(Texture, IsTheFilesTexelsAndTheirLinearMean) {
  const std::string texels = noise(5 * 3 * 3, 1);
  const KeptScene loaded(scene_with("texture a.ppm size 0.5 0.75"), {}, {{"a.ppm", ppm(5, 3, texels)}});
  ASSERT_EQ(loaded.scene.textures.size(), 1u);
  const Texture& texture = loaded.scene.textures[0];
  EXPECT_EQ(texture.width, 5u);
  EXPECT_EQ(texture.height, 3u);
  EXPECT_EQ(texture.channels, 3u);
  EXPECT_EQ(texture.size_u, 0.5);
  EXPECT_EQ(texture.size_v, 0.75);
  double sum[3] = {0, 0, 0};
  for (std::size_t k = 0; k < texels.size(); ++k) {
    EXPECT_EQ(texture.texels[k], static_cast<std::uint8_t>(texels[k]));
    sum[k % 3] += linear(static_cast<std::uint8_t>(texels[k])) / 15;
  }
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(texture.mean[c] / 65535, sum[c], 0.5 / 65535);
  EXPECT_EQ(loaded.scene.channels, 3u);
}

// The mean over the exact areas, in doubles; then 8-bit sRGB of it is right to the nearest level.
TEST(Texture, EachLevelHalvesTheOneBeforeByAreaMeans) {
  for (const auto& [width, height] : {std::pair(8u, 8u), {7u, 5u}, {1u, 9u}, {13u, 2u}, {3u, 3u}}) {
    const std::string file = ppm(width, height, noise(std::size_t{width} * height * 3, 2));
    const KeptScene loaded(scene_with("texture a.ppm"), {}, {{"a.ppm", file}});
    const Texture& texture = loaded.scene.textures[0];
    std::uint32_t level = 0;
    for (;; ++level) {
      const TextureLevel fine = texture_level(texture, level), coarse = texture_level(texture, level + 1);
      if (fine.texel == coarse.texel) break;
      EXPECT_EQ(coarse.width, std::max(1u, fine.width / 2));
      EXPECT_EQ(coarse.height, std::max(1u, fine.height / 2));
      for (std::uint32_t y = 0; y < coarse.height; ++y) {
        for (std::uint32_t x = 0; x < coarse.width; ++x) {
          for (std::uint32_t c = 0; c < 3; ++c) {
            const double wide = 1.0 * fine.width / coarse.width, high = 1.0 * fine.height / coarse.height;
            double mean = 0;
            for (std::uint32_t j = 0; j < fine.height; ++j) {
              for (std::uint32_t i = 0; i < fine.width; ++i) {
                const double w = std::min((x + 1) * wide, i + 1.0) - std::max(x * wide, double{1} * i),
                             h = std::min((y + 1) * high, j + 1.0) - std::max(y * high, double{1} * j);
                if (w > 0 && h > 0) mean += w * h / (wide * high) * linear(fine.texel[(j * fine.width + i) * 3 + c]);
              }
            }
            const std::uint8_t shown = coarse.texel[(y * coarse.width + x) * 3 + c];
            if (shown > 0) {
              EXPECT_GT(mean, (linear(static_cast<std::uint8_t>(shown - 1)) + linear(shown)) / 2 - 3e-5);
            }
            if (shown < 255) {
              EXPECT_LT(mean, (linear(static_cast<std::uint8_t>(shown + 1)) + linear(shown)) / 2 + 3e-5);
            }
          }
        }
      }
    }
    EXPECT_EQ(texture_level(texture, level).width * texture_level(texture, level).height, 1u);
  }
}

TEST(Texture, GreyPicturesHaveOneChannel) {
  std::string grey;
  for (const char c : noise(12, 3)) grey += std::string(3, c);
  const KeptScene colour(scene_with("texture a.ppm"), {}, {{"a.ppm", ppm(4, 3, grey)}});
  const KeptScene map(scene_with("texture a.pgm"), {}, {{"a.pgm", ppm(4, 3, noise(12, 3), "P5\t# from a scan\n")}});
  for (const KeptScene* loaded : {&colour, &map}) {
    EXPECT_EQ(loaded->scene.channels, 1u);
    EXPECT_EQ(loaded->scene.textures[0].channels, 1u);
  }
  EXPECT_TRUE(std::ranges::equal(colour.scene.textures[0].texels, map.scene.textures[0].texels));
}

// Repeats are lengths over sizes: the square is 3 long along u, 2 along v.
TEST(Texture, IsRepeatedInSceneUnits) {
  const std::string rest =
      "grid m 3 2  0 0 0  3 0 0  3 0 4   0 1 0  3 1 0  3 1 4\ntri m 0 0 0  0 0 2  4 0 0\n"
      "quad m 0 5 0  0 5 3  2 5 5  2 5 0\n";
  const LoadedScene once(scene_with("texture a.ppm") + rest, {}, {{"a.ppm", ppm(1, 1, "abc")}});
  const LoadedScene sized(scene_with("texture a.ppm size 0.5 0.25") + rest, {}, {{"a.ppm", ppm(1, 1, "abc")}});
  const double expected[4][2] = {{6, 8}, {14, 4}, {4, 16}, {8, 2 * (2 + std::sqrt(8))}};
  for (std::size_t m = 0; m < 4; ++m) {
    const Repeats one = texture_repeats(once.scene, once.scene.meshes[m], once.scene.textures[0]);
    EXPECT_EQ(one.u, 1);
    EXPECT_EQ(one.v, 1);
    const Repeats many = texture_repeats(sized.scene, sized.scene.meshes[m], sized.scene.textures[0]);
    EXPECT_NEAR(many.u, expected[m][0], 1e-12);
    EXPECT_NEAR(many.v, expected[m][1], 1e-12);
  }
}

TEST(Texture, OfMaterialsThatNothingHasIsNotRead) {
  const LoadedScene without("shodo 1\nmaterial m diffuse 0.1\nmaterial n diffuse 0.2\n" + kSquare);
  const LoadedScene with("shodo 1\nmaterial m diffuse 0.1\nmaterial n diffuse 0.2 texture nowhere.ppm\n" + kSquare);
  EXPECT_EQ(with.scene.textures[0].texels.size(), 0u);
  EXPECT_LE(with.arena.used() - without.arena.used(), sizeof(Texture) + 16);
  EXPECT_EQ(texture_of(with.scene, with.scene.meshes[0]), kNone);
}

TEST(Texture, OneFileIsInMemoryOnce) {
  const std::string two = "shodo 1\nmaterial m diffuse 0.1 texture a/x.ppm\n"
                          "material n diffuse 0.2 0.1 0.1 texture a/../a/x.ppm size 2 1\n" +
                          kSquare + "quad n 0 1 0  0 1 3  2 1 3  2 1 0\n";
  const KeptScene loaded(two, {}, {{"a/x.ppm", ppm(2, 2, noise(12, 4, 100, 140))}});
  EXPECT_EQ(loaded.scene.textures[0].texels.data(), loaded.scene.textures[1].texels.data());
  EXPECT_EQ(loaded.scene.textures[1].mean[2], loaded.scene.textures[0].mean[2]);
  EXPECT_EQ(loaded.scene.textures[1].size_u, 2);
}

// The path counts from the including file.
TEST(Texture, IsSoughtBesideTheFileThatNamesIt) {
  const LoadedScene loaded("shodo 1\ninclude rooms/m.scn\n" + kSquare, {},
                           {{"rooms/m.scn", "material m diffuse 0.1 texture a.ppm\n"},
                            {"rooms/a.ppm", ppm(1, 1, "abc")}});
  EXPECT_EQ(loaded.scene.textures[0].path, "rooms/a.ppm");
}

void expect_refused(const std::string& words, const std::string& file, const char* what, std::uint32_t column = 32) {
  SCOPED_TRACE(words);
  const TestScene scene(scene_with(words), {}, {{"a.ppm", file}});
  EXPECT_EQ(scene.status.line, 2u);
  EXPECT_EQ(scene.status.column, column);
  EXPECT_NE(std::string(scene.status.message).find(what), std::string::npos) << to_text(scene.status);
  EXPECT_EQ(scene.arena.used(), 0u);
}

TEST(Texture, RefusalsSayWhere) {
  const std::string good = ppm(1, 1, "abc");
  expect_refused("texture b.ppm", good, "expected a picture that can be read, found b.ppm");
  expect_refused("texture", good, "expected the path of a picture", 31);
  expect_refused("texture /a.ppm", good, "expected a path relative to this file");
  expect_refused("texture ../a.ppm", good, "expected a path that stays in the folder");
  expect_refused("texture a.ppm size 1", good, "(texture height, scene units), found the end", 44);
  expect_refused("texture a.ppm size 0 1", good, "from 1e-06 to 1e+06 (texture width, scene units)", 43);
  const char* const kFormat = "expected a texture in PPM or PGM (P6 or P5) with 255 levels, found a.ppm";
  for (const char* const bad :
       {"", "P", "P6", "P6 1", "P6 1 1 255", "P3 1 1 255\n1 2 3", "P6 1 1 65535\nabcdef", "P6 x 1 255\nabc",
        "P6 -1 1 255\nabc", "P6 1 123456 255\nabc", "\x89PNG", "P6 # 1 1 255 abc", "P6 1 1 255#\nabc"}) {
    expect_refused("texture a.ppm", bad, kFormat);
  }
  for (const char* const bad : {"P6 0 1 255\nabc", "P6 1 0 255\nabc", "P6 8193 1 255\nabc", "P6 1 99999 255\nabc"}) {
    expect_refused("texture a.ppm", bad, "expected a texture of 1 to 8192 texels each way");
  }
  expect_refused("texture a.ppm", ppm(2, 1, "abcde"), "expected a texture with all its texels");
}

// With diffuse 0.1 a texel may be 9.999 times as light as the mean: 10 black ones beside it are too many.
TEST(Texture, NoTexelMayReflectMoreThanEverything) {
  const auto one_white = [](std::uint32_t black) {
    return ppm(black + 1, 1, "\xff\xff\xff" + std::string(3 * std::size_t{black}, '\0'));
  };
  LoadedScene(scene_with("texture a.ppm"), {}, {{"a.ppm", one_white(8)}});
  expect_refused("texture a.ppm", one_white(10), "found red 1.1");
  expect_refused("texture a.ppm", ppm(1, 1, std::string("a\0b", 3)), "found green none");
}

// Reading takes the texels, for the patches' own means, and gives them back; so does a picture.
TEST(Texture, TooLittleMemoryNamesWhatWouldDo) {
  const TestFiles files{{"a.ppm", ppm(100, 100, noise(30000, 5, 100, 200))}};
  const TestScene scarce(scene_with("texture a.ppm"), {}, files, 20000);
  EXPECT_EQ(scarce.status.code, StatusCode::kMemory);
  EXPECT_GT(scarce.status.bytes_needed, 39000u);
  TestScene enough(scene_with("texture a.ppm"), {}, files, static_cast<std::size_t>(scarce.status.bytes_needed));
  ASSERT_TRUE(enough.status.done()) << to_text(enough.status);
  EXPECT_LT(enough.arena.used() + texel_bytes(enough.scene), scarce.status.bytes_needed + 8);
  std::span<std::uint8_t> room;
  ASSERT_TRUE(enough.arena.take("something else", enough.arena.left() - texel_bytes(enough.scene) + 8, room));
  const std::uint64_t before = enough.arena.used();
  EXPECT_FALSE(keep_texels(enough.scene, reader_of(enough.files), enough.arena, enough.status));
  EXPECT_EQ(enough.status.code, StatusCode::kMemory);
  EXPECT_EQ(enough.status.bytes_needed, before + texel_bytes(enough.scene));
}

}  // namespace
}  // namespace shodo
