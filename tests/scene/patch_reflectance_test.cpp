// What patches of textured meshes reflect: means of their part of the picture, and what interreflection makes of them.
#include "scene/patch_reflectance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "model.h"
#include "scene/mesh.h"
#include "scene/texture.h"
#include "support/files.h"
#include "support/kept_scene.h"

namespace shodo {
namespace {

/// Different everywhere.
std::string picture(std::uint32_t width, std::uint32_t height) {
  std::string text = "P6 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
  for (std::uint32_t k = 0; k < width * height * 3; ++k) {
    const std::uint32_t noise = (k * 2654435761u >> 16) % 100;
    text += static_cast<char>(static_cast<unsigned char>(90 + 8 * (k % 3) + noise * (k / 3 % width) / width));
  }
  return text;
}

/// The mean over points of the patch, of the finest texels.
double slow_reflectance(const Scene& scene, std::uint32_t m, std::uint32_t local, std::uint32_t c) {
  const Mesh& mesh = scene.meshes[m];
  const Texture& texture = scene.textures[texture_of(scene, mesh)];
  const Repeats repeats = texture_repeats(scene, mesh, texture);
  const PieceIndex at = patch_index(mesh, local);
  constexpr int kPoints = 480;
  double sum = 0, count = 0;
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      double x = (i + 0.5) / kPoints, y = (j + 0.5) / kPoints;
      if (mesh.kind == MeshKind::kTriangle && x + y > 1) continue;
      if (at.inverted) x = 1 - x, y = 1 - y;
      const double s = (at.u + x) / mesh.nu * repeats.u, t = 1 - (at.v + y) / mesh.nv * repeats.v;
      const auto column = static_cast<std::size_t>((s - std::floor(s)) * texture.width);
      const auto row = static_cast<std::size_t>((t - std::floor(t)) * texture.height);
      sum += scene.texture_linear[texture.texels[(row * texture.width + column) * 3 + c]];
      ++count;
    }
  }
  return scene.materials[mesh.material].diffuse.c[c] * sum / count / texture.mean[c];
}

TEST(PatchReflectance, IsTheMeanOfThePatchsPartOfTheTexture) {
  const KeptScene scene(
      "shodo 1\nmaterial plain diffuse 0.2\nmaterial m diffuse 0.2 0.15 0.1 texture p.ppm size 1.1 0.7\n"
      "material once diffuse 0.15 texture q.ppm\nobject o\n"
      "quad plain 0 0 0  1 0 0  1 1 0  0 1 0 patches 2 2\n"
      "quad m 0 0 1  3 0 1  3 2 1  0 2 1 patches 5 3 sub 2 2\n"
      "tri once 0 0 2  3 0 2  0 3 2 patches 3\n"
      "quad once 0 0 3  3 0 3  3 2 3  0 2 3 patches 1 2\n",
      {}, {{"p.ppm", picture(37, 23)}, {"q.ppm", picture(64, 48)}});
  double most = 0;
  for (std::uint32_t m = 0; m < scene.scene.meshes.size(); ++m) {
    const MeshReflectance found(scene.scene, m);
    for (std::uint32_t local = 0; local < scene.scene.meshes[m].patch_count(); ++local) {
      double room[3], upper[3];
      for (std::uint32_t c = 0; c < 3; ++c) {
        const double value = found.of(local, room)[c];
        EXPECT_LE(value, found.most(upper)[c]);
        if (m == 0) {
          EXPECT_EQ(value, 0.2);
          continue;
        }
        const double slow = slow_reflectance(scene.scene, m, local, c);
        // 8-bit levels of detail: 0.5 of 255 a texel, of some 100 each; 64 points of a triangular patch.
        EXPECT_NEAR(value, slow, (m == 2 ? 0.03 : 0.005) * slow) << m << ' ' << local << ' ' << c;
        most = std::max(most, std::abs(slow / scene.scene.materials[scene.scene.meshes[m].material].diffuse.c[c] - 1));
      }
    }
  }
  EXPECT_GT(most, 0.1);  // patches differ
}

TEST(PatchReflectance, TakesNoBytesInScenesWithoutTextures) {
  const LoadedScene plain("shodo 1\nmaterial m diffuse 0.5\nobject o\nquad m 0 0 0  0 0 1  1 0 1  1 0 0\n");
  EXPECT_TRUE(plain.scene.textured.empty());
  EXPECT_TRUE(plain.scene.patch_reflectance.empty());
}

/// A room whose floor is half light, half dark: by a texture, or by two materials.
std::string room(bool textured) {
  const std::string walls =
      "object ceiling\nquad wall 0 3 0  4 3 0  4 3 4  0 3 4  patches 4 4 sub 1 1\n"
      "object west\nquad wall 0 0 0  0 3 0  0 3 4  0 0 4  patches 3 4 sub 1 1\n"
      "object east\nquad glossy 4 0 0  4 0 4  4 3 4  4 3 0  patches 4 3 sub 1 1\n"
      "object north\nquad wall 0 0 0  4 0 0  4 3 0  0 3 0  patches 4 3 sub 1 1\n"
      "object south\nquad wall 0 0 4  0 3 4  4 3 4  4 0 4  patches 3 4 sub 1 1\n"
      "plane desk 1 1 1  1 1 3  3 1 3  3 1 1 patches 2 2 sub 1 1\n"
      "light l point at 1 2.5 1.5 intensity 300\n";
  // 188 and 99 of 255 are 0.503 and 0.125 in linear light.
  const auto linear = [](double level) { return std::pow((level / 255 + 0.055) / 1.055, 2.4); };
  const double light = linear(188), dark = linear(99), mean = 0.5 * (light + dark);
  const auto number = [](double x) { return std::to_string(x); };
  const std::string head = "shodo 1\nmaterial wall diffuse 0.6\nmaterial glossy diffuse 0.4 reflect 0.3\n"
                           "material tiles diffuse 0.4 texture t.pgm size 4 4\n"
                           "material light diffuse " + number(0.4 * light / mean) +
                           "\nmaterial dark diffuse " + number(0.4 * dark / mean) + "\n";
  // u runs along z, the texture's left half is z < 2.
  const std::string floor =
      textured ? "object floor\nquad tiles 0 0 0  0 0 4  4 0 4  4 0 0  patches 4 4 sub 1 1\n"
               : "object floor\nquad light 0 0 0  0 0 2  4 0 2  4 0 0  patches 2 4 sub 1 1\n"
                 "quad dark 0 0 2  0 0 4  4 0 4  4 0 2  patches 2 4 sub 1 1\n";
  return head + floor + walls;
}

/// Ambient illuminance of the walls, and of the plane.
std::vector<double> solved(bool textured, const Options& options) {
  std::vector<std::uint64_t> memory(std::size_t{1} << 20);
  TestFiles files{{"t.pgm", "P5 2 1 255\n\xbc\x63"}};
  Model* model = nullptr;
  const std::string text = room(textured);
  EXPECT_TRUE(load("top.scn", text, reader_of(files), options, memory.data(), 8 * memory.size(), model).done());
  EXPECT_TRUE(solve(*model, {}).done());
  std::vector<double> lux;
  for (std::size_t k = 16; k < model->scene.sub_patch_count; ++k) {
    lux.push_back(static_cast<double>(model->maps.ambient_lx[k]));
  }
  for (const float value : model->planes.ambient_lx) lux.push_back(static_cast<double>(value));
  return lux;
}

TEST(PatchReflectance, ATexturedFloorLightsARoomAsTwoFloorsOfItsMeans) {
  for (int which = 0; which < 4; ++which) {
    Options options;
    options.rules.blocks = which == 1 || which == 2;
    options.rules.blocks_error = 1e-5;
    options.gather = which == 2;
    options.gather_lines = 4096;
    options.mirror_light = which == 3;
    options.tolerance = 1e-9;
    options.row_value_bits = 64;
    const std::vector<double> one = solved(true, options), two = solved(false, options);
    ASSERT_EQ(one.size(), two.size());
    // Blocks cut the floors differently, and their patches, numbered otherwise, shoot other rays to gather; else the
    // two are one matrix, but for digits of the materials.
    const double tolerance = which == 0 ? 1e-5 : 5e-3;
    for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k], two[k], tolerance * two[k]) << which;
  }
}

}  // namespace
}  // namespace shodo
