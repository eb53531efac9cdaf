// Spreading of ambient illuminance: means kept, no seams, constants and lines reproduced, hidden parts left out.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "map/illuminance_map.h"
#include "map/parabolic.h"
#include "map/triangle_spread.h"
#include "scene/mesh.h"

namespace shodo {
namespace {

std::vector<double> spread_all(const std::vector<double>& mean, std::uint32_t parts, bool periodic = false) {
  std::vector<double> result(mean.size() * parts, -1);
  spread({mean.data(), static_cast<std::uint32_t>(mean.size()), 1, periodic}, parts,
         [&](std::uint32_t k, double value) { result[k] = value; });
  return result;
}

std::vector<double> random_means(std::uint32_t seed, std::size_t count) {
  std::mt19937 random(seed);
  std::vector<double> mean(count);
  for (double& m : mean) m = random() % 4 == 0 ? 0 : static_cast<double>(random() % 1000);
  return mean;
}

// Differences of an integral, a few roundings of values up to 3000 each.
constexpr double kRounding = 1e-9;

TEST(Spread, KeepsTheMeanOfEveryCellAndIsNeverNegative) {
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    const std::vector<double> mean = random_means(seed, 1 + seed % 9);
    for (const std::uint32_t parts : {1u, 2u, 3u, 7u}) {
      const std::vector<double> fine = spread_all(mean, parts, seed % 2 == 0);
      for (std::size_t k = 0; k < mean.size(); ++k) {
        double sum = 0;
        for (std::uint32_t part = 0; part < parts; ++part) {
          EXPECT_GE(fine[k * parts + part], 0);
          sum += fine[k * parts + part];
        }
        EXPECT_NEAR(sum / parts, mean[k], kRounding);
      }
    }
  }
}

TEST(Spread, KeepsConstantsAndLinesUpToTheBorder) {
  for (const std::uint32_t count : {1u, 2u, 3u, 4u, 9u}) {
    for (const double slope : {0.0, 3.0, -3.0}) {
      if (count == 1 && slope != 0) continue;
      std::vector<double> mean;
      for (std::uint32_t k = 0; k < count; ++k) mean.push_back(100 + slope * (k + 0.5));
      const std::vector<double> fine = spread_all(mean, 4);
      for (std::size_t k = 0; k < fine.size(); ++k) {
        EXPECT_NEAR(fine[k], 100 + slope * (static_cast<double>(k) + 0.5) / 4, kRounding);
      }
    }
  }
}

// A cubic without a turn: values between inner cells are of fourth order, hence exact.
TEST(Spread, GivesCubicsTheirOwnValuesBetweenInnerCells) {
  const auto integral = [](double x) { return 50 * x + 4 * x * x + x * x * x * x / 4; };  // of 50 + 8 x + x^3
  std::vector<double> mean;
  for (int k = 0; k < 8; ++k) mean.push_back(integral(k + 1) - integral(k));
  const CellMeans cells{mean.data(), 8, 1, false};
  for (std::uint32_t k = 2; k <= 6; ++k) EXPECT_NEAR(value_between(cells, k), 50 + 8.0 * k + 1.0 * k * k * k, 1e-9);
}

// The finest parts on both sides of a border differ no more than a continuous curve of bounded slope lets them: halved
// with the size of the parts. A seam would stay.
TEST(Spread, HasNoSeamsBetweenCells) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const std::vector<double> mean = random_means(seed, 8);
    for (const bool periodic : {false, true}) {
      const std::uint32_t parts = 2000;
      const std::vector<double> fine = spread_all(mean, parts, periodic);
      for (std::size_t k = 1; k < mean.size() + (periodic ? 1 : 0); ++k) {
        // Slopes are at most 4 |ends| + 6 mean of a cell, under 20,000 here.
        EXPECT_NEAR(fine[k * parts - 1], fine[k * parts % fine.size()], 20000.0 / parts + kRounding);
      }
    }
  }
}

// Inner cells end between the means' least and greatest, or a sixth beyond where the means turn, and bulge by at most
// half of what is between their ends and their mean. The first and last cell are extrapolated by at most their step.
TEST(Spread, PassesTheRangeOfTheMeansByHalfAtMost) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    std::vector<double> mean(10);
    double low = 1000, high = 0;
    for (double& m : mean) {
      m = random() % 2 == 0 ? 200 : 600;
      low = std::min(low, m);
      high = std::max(high, m);
    }
    const std::vector<double> fine = spread_all(mean, 8);
    for (std::size_t k = 0; k < fine.size(); ++k) {
      const double beyond = (k < 8 || k >= 72 ? 1 : 0.5) * (high - low) + kRounding;
      EXPECT_LE(fine[k], high + beyond);
      EXPECT_GE(fine[k], low - beyond);
    }
  }
}

TEST(Spread, GoesRoundWhereTheMeshDoes) {
  std::vector<double> mean;
  for (int k = 0; k < 12; ++k) mean.push_back(300 + 200 * std::sin(k * M_PI / 6));
  const std::vector<double> fine = spread_all(mean, 3, true);
  std::vector<double> turned(mean.begin() + 5, mean.end());
  turned.insert(turned.end(), mean.begin(), mean.begin() + 5);
  const std::vector<double> fine_turned = spread_all(turned, 3, true);
  for (std::size_t k = 0; k < fine.size(); ++k) EXPECT_EQ(fine_turned[k], fine[(k + 15) % 36]);
}

// Round a mesh every cell is an inner one: the same as in the middle of three turns laid out in a row.
TEST(Spread, RoundAMeshHasNoBorder) {
  const std::vector<double> mean = random_means(11, 7);
  std::vector<double> turns;
  for (int turn = 0; turn < 3; ++turn) turns.insert(turns.end(), mean.begin(), mean.end());
  const std::vector<double> fine = spread_all(mean, 3, true), long_fine = spread_all(turns, 3);
  for (std::size_t k = 0; k < fine.size(); ++k) EXPECT_EQ(fine[k], long_fine[21 + k]);
}

std::vector<double> spread_patches(const std::vector<double>& patch, std::uint32_t k, std::uint32_t parts) {
  std::vector<double> scratch(triangle_scratch(k)), result(k * k * parts * parts);
  spread_triangle(patch, k, parts, scratch, result);
  return result;
}

TEST(SpreadTriangle, KeepsTheMeanOfEveryPatchAndIsNeverNegative) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const std::uint32_t k = 1 + seed % 6, parts = 1 + seed % 4;
    const std::vector<double> patch = random_means(seed, std::size_t{k} * k);
    const std::vector<double> fine = spread_patches(patch, k, parts);
    Mesh mesh;
    mesh.kind = MeshKind::kTriangle;
    mesh.nu = mesh.nv = k;
    mesh.su = mesh.sv = parts;
    std::vector<double> sum(patch.size());
    for (std::uint32_t s = 0; s < fine.size(); ++s) {
      EXPECT_GE(fine[s], 0);
      sum[patch_of_sub_patch(mesh, s)] += fine[s] / (parts * parts);
    }
    for (std::size_t p = 0; p < patch.size(); ++p) EXPECT_NEAR(sum[p], patch[p], 1e-8);
  }
}

TEST(SpreadTriangle, KeepsConstantsAndLinesUpToTheBorder) {
  for (const std::uint32_t k : {1u, 2u, 3u, 5u}) {
    for (const double slope : {0.0, 10.0}) {
      if (k == 1 && slope != 0) continue;
      const auto light = [&](const PieceIndex& at, double parts) {
        const double third = at.inverted ? 2.0 / 3 : 1.0 / 3;
        return 200 + slope * ((at.u + third) - 0.5 * (at.v + third)) / parts;
      };
      std::vector<double> patch;
      for (std::uint32_t p = 0; p < k * k; ++p) patch.push_back(light(triangle_piece(k, p), 1));
      const std::vector<double> fine = spread_patches(patch, k, 3);
      for (std::uint32_t s = 0; s < fine.size(); ++s) {
        EXPECT_NEAR(fine[s], light(triangle_piece(3 * k, s), 3), kRounding);
      }
    }
  }
}

TEST(SpreadTriangle, HasNoSeamsBetweenPatches) {
  const std::uint32_t k = 4, parts = 40;
  const std::vector<double> patch = random_means(3, 16);
  const std::vector<double> fine = spread_patches(patch, k, parts);
  for (std::uint32_t s = 0; s < fine.size(); ++s) {
    const PieceIndex at = triangle_piece(k * parts, s);
    if (!at.inverted) continue;
    for (const PieceIndex& beside :
         {PieceIndex{at.u, at.v, false}, PieceIndex{at.u + 1, at.v, false}, PieceIndex{at.u, at.v + 1, false}}) {
      // Centres are under 1/40 of a patch apart; slopes under 1000 (1.5 + 9 / 0.45) a patch.
      EXPECT_NEAR(fine[s], fine[triangle_piece_order(k * parts, beside)], 1000 * 21.5 / 40);
    }
  }
}

/// One mesh, lit by a function of patch column and row.
struct OneMesh {
  explicit OneMesh(const Mesh& of, std::uint32_t channels = 1) : arena(memory, sizeof memory), mesh{of} {
    scene.meshes = std::span<Mesh>(mesh, 1);
    scene.channels = channels;
    scene.patch_count = of.patch_count();
    scene.sub_patch_count = of.sub_patch_count();
    patches.resize(scene.patch_count);
    ambient_lx.resize(std::size_t{scene.patch_count} * channels);
    direct_lx.resize(std::size_t{scene.sub_patch_count} * channels, 1);
    hidden.resize(scene.sub_patch_count);
    visible.resize(scene.patch_count, 1);
  }
  Status run() {
    direct.sub_patch_lx = direct_lx;
    direct.hidden = hidden;
    direct.visible_area = visible;
    ambient.patch_lx = ambient_lx;
    return map_illuminance(scene, patches, direct, ambient, options, arena, maps);
  }
  double mean_of_patch(std::uint32_t p, std::uint32_t c = 0) const {
    double sum = 0;
    for (std::uint32_t s = 0; s < scene.sub_patch_count; ++s) {
      if (patch_of_sub_patch(mesh[0], s) == p) sum += static_cast<double>(maps.ambient_lx[s * scene.channels + c]);
    }
    return sum / (mesh[0].su * mesh[0].sv);
  }

  alignas(8) std::byte memory[200000];
  Arena arena;
  Mesh mesh[1];
  Scene scene;
  std::vector<Patch> patches;
  std::vector<double> ambient_lx;
  std::vector<float> direct_lx, visible;
  std::vector<std::uint8_t> hidden;
  DirectLight direct;
  AmbientLight ambient;
  Options options;
  IlluminanceMaps maps;
};

Mesh quad_mesh(std::uint32_t nu, std::uint32_t nv, std::uint32_t su, std::uint32_t sv) {
  Mesh mesh;
  mesh.nu = nu;
  mesh.nv = nv;
  mesh.su = su;
  mesh.sv = sv;
  return mesh;
}

// Sub-patches are floats: 2^-24 of values up to 3000.
TEST(IlluminanceMaps, KeepEachPatchsMeanInEachChannel) {
  Mesh triangle = quad_mesh(5, 5, 3, 3);
  triangle.kind = MeshKind::kTriangle;
  for (const Mesh& mesh : {quad_mesh(6, 4, 3, 2), quad_mesh(1, 7, 4, 4), triangle}) {
    auto map = std::make_unique<OneMesh>(mesh, 3);
    map->ambient_lx = random_means(8, map->ambient_lx.size());
    ASSERT_TRUE(map->run().done());
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      for (std::uint32_t c = 0; c < 3; ++c) EXPECT_NEAR(map->mean_of_patch(p, c), map->ambient_lx[p * 3 + c], 2e-4);
    }
  }
}

TEST(IlluminanceMaps, AreLinearWherePatchesAre) {
  auto map = std::make_unique<OneMesh>(quad_mesh(6, 5, 3, 4));
  for (std::uint32_t p = 0; p < 30; ++p) map->ambient_lx[p] = 50 + 7 * (p % 6 + 0.5) + 11 * (p / 6 + 0.5);
  ASSERT_TRUE(map->run().done());
  for (std::uint32_t s = 0; s < map->scene.sub_patch_count; ++s) {
    const double u = (s % 18 + 0.5) / 3, v = (s / 18 + 0.5) / 4;
    EXPECT_NEAR(map->maps.ambient_lx[s], 50 + 7 * u + 11 * v, 1e-4);
  }
}

// u and v are spread in turn: exchanging them must matter no more than the limits do, here not at all.
TEST(IlluminanceMaps, TreatUAndVAlikeWhereNothingIsLimited) {
  auto one = std::make_unique<OneMesh>(quad_mesh(5, 4, 2, 3)), other = std::make_unique<OneMesh>(quad_mesh(4, 5, 3, 2));
  for (std::uint32_t v = 0; v < 4; ++v) {
    for (std::uint32_t u = 0; u < 5; ++u) {
      one->ambient_lx[v * 5 + u] = other->ambient_lx[u * 4 + v] = 400 + 30.0 * u + 20.0 * v + 2.0 * u * v + u * u;
    }
  }
  ASSERT_TRUE(one->run().done() && other->run().done());
  for (std::uint32_t v = 0; v < 12; ++v) {
    for (std::uint32_t u = 0; u < 10; ++u)
      EXPECT_NEAR(one->maps.ambient_lx[v * 10 + u], other->maps.ambient_lx[u * 12 + v], 1e-3);
  }
}

TEST(IlluminanceMaps, AreConstantOverAPatchWithoutInterpolation) {
  Mesh triangle = quad_mesh(4, 4, 2, 2);
  triangle.kind = MeshKind::kTriangle;
  for (const Mesh& mesh : {quad_mesh(3, 4, 2, 2), triangle}) {
    auto map = std::make_unique<OneMesh>(mesh);
    map->options.interpolate = false;
    map->ambient_lx = random_means(5, map->ambient_lx.size());
    ASSERT_TRUE(map->run().done());
    for (std::uint32_t s = 0; s < map->scene.sub_patch_count; ++s) {
      EXPECT_EQ(map->maps.ambient_lx[s], static_cast<float>(map->ambient_lx[patch_of_sub_patch(mesh, s)]));
    }
  }
}

TEST(IlluminanceMaps, HiddenSubPatchesAreZeroAndNobodyElseChanges) {
  auto open = std::make_unique<OneMesh>(quad_mesh(4, 4, 2, 2)),
       partly = std::make_unique<OneMesh>(quad_mesh(4, 4, 2, 2));
  open->ambient_lx = partly->ambient_lx = random_means(6, 16);
  partly->hidden[20] = partly->hidden[21] = partly->hidden[29] = 1;
  ASSERT_TRUE(open->run().done() && partly->run().done());
  for (std::uint32_t s = 0; s < 64; ++s)
    EXPECT_EQ(partly->maps.ambient_lx[s], partly->hidden[s] != 0 ? 0 : open->maps.ambient_lx[s]);
}

// Linear light, of which patches at the border of something show three parts in four, a half or a corner: their own
// value is the mean over what shows. Sub-patches beside it must have the light's own values, and patch means be kept.
TEST(IlluminanceMaps, PartlyHiddenPatchesHaveTheirMeanWhereTheyAreVisible) {
  const auto light = [](std::uint32_t s) { return 300 + 7.0 * (s % 24 + 0.5) + 3.0 * (s / 24 + 0.5); };
  auto map = std::make_unique<OneMesh>(quad_mesh(6, 6, 4, 4));
  std::vector<double> shown(36);
  for (std::uint32_t s = 0; s < map->scene.sub_patch_count; ++s) {
    const std::uint32_t u = s % 24, v = s / 24, p = patch_of_sub_patch(map->mesh[0], s);
    map->hidden[s] = u >= 7 && u < 18 && v >= 10 && v < 19 ? 1 : 0;
    if (map->hidden[s] != 0) continue;
    map->ambient_lx[p] += light(s);
    shown[p] += 1;
  }
  for (std::uint32_t p = 0; p < 36; ++p) {
    map->visible[p] = static_cast<float>(shown[p] / 16);
    if (shown[p] > 0) map->ambient_lx[p] /= shown[p];
  }
  ASSERT_TRUE(map->run().done());
  std::vector<double> mean(36);
  for (std::uint32_t s = 0; s < map->scene.sub_patch_count; ++s) {
    const std::uint32_t p = patch_of_sub_patch(map->mesh[0], s);
    if (map->hidden[s] != 0) {
      EXPECT_EQ(map->maps.ambient_lx[s], 0);
      continue;
    }
    mean[p] += static_cast<double>(map->maps.ambient_lx[s]) / shown[p];
    // Three passes leave 0.46; spread as if nothing were hidden, light beside the border is wrong by up to 7.7.
    EXPECT_NEAR(map->maps.ambient_lx[s], light(s), 0.6) << s % 24 << ", " << s / 24;
  }
  for (std::uint32_t p = 0; p < 36; ++p) {
    if (shown[p] > 0) {
      EXPECT_NEAR(mean[p], map->ambient_lx[p], 0.02) << p;
    }
  }
}

// A hidden patch and a dropped one in linear light: their neighbours must come out as if all were known.
TEST(IlluminanceMaps, PatchesWithoutAValueDoNotDragTheirNeighboursDown) {
  Mesh triangle = quad_mesh(6, 6, 2, 2);
  triangle.kind = MeshKind::kTriangle;
  for (const bool flat : {true, false}) {
    for (const Mesh& mesh : {quad_mesh(6, 6, 2, 2), triangle}) {
      if (!flat && mesh.kind == MeshKind::kTriangle) continue;  // neighbours there continue as constants
      auto whole = std::make_unique<OneMesh>(mesh), gaps = std::make_unique<OneMesh>(mesh);
      for (std::uint32_t p = 0; p < 36; ++p) whole->ambient_lx[p] = flat ? 500 : 500 + 20.0 * (p % 6) + 10.0 * (p / 6);
      gaps->ambient_lx = whole->ambient_lx;
      for (const std::uint32_t p : {0u, 14u, 15u, 21u}) gaps->ambient_lx[p] = 0;
      gaps->visible[0] = gaps->visible[14] = gaps->visible[15] = 0;
      gaps->patches[21].dropped = 1;
      ASSERT_TRUE(whole->run().done() && gaps->run().done());
      for (std::uint32_t s = 0; s < whole->scene.sub_patch_count; ++s) {
        EXPECT_NEAR(gaps->maps.ambient_lx[s], whole->maps.ambient_lx[s], 1e-3) << s;
      }
    }
  }
}

TEST(IlluminanceMaps, OfAMeshWithoutAnyValueAreZero) {
  auto map = std::make_unique<OneMesh>(quad_mesh(2, 2, 2, 2));
  for (Patch& patch : map->patches) patch.dropped = 1;
  ASSERT_TRUE(map->run().done());
  for (const float lx : map->maps.ambient_lx) EXPECT_EQ(lx, 0);
}

TEST(IlluminanceMaps, TakeTheBytesThatTheySay) {
  Mesh triangle = quad_mesh(5, 5, 3, 3);
  triangle.kind = MeshKind::kTriangle;
  for (const Mesh& mesh : {quad_mesh(7, 3, 3, 2), triangle}) {
    for (const bool interpolate : {true, false}) {
      auto map = std::make_unique<OneMesh>(mesh, 3);
      map->options.interpolate = interpolate;
      const std::uint64_t bytes = map_bytes(map->scene, map->options);
      map->arena = Arena(map->memory, bytes);
      EXPECT_TRUE(map->run().done());
      EXPECT_EQ(map->arena.peak(), bytes);
      EXPECT_EQ(map->arena.used(), (4 * std::size_t{map->scene.sub_patch_count} * 3 + 7) / 8 * 8);
      map->arena = Arena(map->memory, bytes - 8);
      EXPECT_EQ(map->run().code, StatusCode::kMemory);
    }
  }
}

}  // namespace
}  // namespace shodo
