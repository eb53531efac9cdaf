#include "ambient/gauss_seidel.h"

#include <cmath>
#include <random>

#include "support/eliminated.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

std::string table(double z) {
  char text[600];
  std::snprintf(text, sizeof text,
                "object table\nquad wood 1 1 %g 1 2 %g 3 2 %g 3 1 %g patches 2 2 sub 1 1\n"
                "quad wood 1 1 %g 3 1 %g 3 2 %g 1 2 %g patches 2 3 sub 1 1\n",
                z, z, z, z, z + 0.01, z + 0.01, z + 0.01, z + 0.01);
  return text;
}

TEST(GaussSeidel, TheBoundIsNeverBelowTheTrueErrorOfTheStoredSystem) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double rho : {0.05, 0.5, 0.9, 0.99, 0.9999}) {
    for (const double tolerance : {0.1, 1e-2, 1e-4, 1e-7, 1e-10}) {
      for (const bool coloured : {false, true}) {
        Options options;
        options.tolerance = tolerance;
        const std::string wood = coloured ? "material wood diffuse 0.6 0.3 0.1\n" : "material wood diffuse 0.3\n";
        AmbientScene scene(grey(rho) + wood + box_walls(4, 3, 2.5, 3, 2, 3, "white") + table(0.7), options);
        scene.light([&](const Vec3&, std::uint32_t) { return unit(random) < 0.3 ? 1000 * unit(random) : 0; });
        ASSERT_TRUE(scene.solve().done());
        const Statistics statistics = scene.statistics;
        EXPECT_EQ(scene.loaded.scene.channels, coloured ? 3u : 1u);
        // Rounding is bounded by (n + 16) 2^-52 / (1 - rho), here up to 3e-10: nothing below that is promised.
        EXPECT_LE(statistics.solution_bound, std::max(tolerance, 3e-10)) << rho << " in " << statistics.sweeps;
        // Elimination in long double is itself off by a few 1e-19 / (1 - rho).
        EXPECT_LE(true_error(scene), statistics.solution_bound + 1e-15) << rho << ", " << tolerance;
        EXPECT_LT(statistics.sweeps, 60u) << rho << ", " << tolerance;
      }
    }
  }
}

TEST(GaussSeidel, TheRowSumsBehindTheBoundAreThoseOfTheStoredMatrix) {
  // Rows of very different sums, two reflectances, so that each part of a sum shows in the largest.
  const std::string whole = box_walls(4, 3, 2.5, 4, 3, 3, "white");
  const std::string open = whole.substr(0, whole.find("object wall_x1")) + table(0.7);  // the largest sums come early
  for (const bool blocks : {false, true}) {
    for (const bool coloured : {false, true}) {
      Options options;
      options.rules.blocks = blocks;
      const std::string wood = coloured ? "material wood diffuse 0.6 0.9 0.1\n" : "material wood diffuse 0.3\n";
      AmbientScene scene(grey(0.7) + wood + open, options);
      scene.light([](const Vec3& p, std::uint32_t) { return 100 * p.x; });
      const StoredMatrix stored(scene);
      const Scene& s = scene.loaded.scene;
      for (std::uint32_t c = 0; c < s.channels; ++c) {
        double most = 0, most_above = 0;
        for (std::uint32_t a = 0; a < stored.matrix.surfaces.size(); ++a) {
          if (stored.matrix.surfaces.is_block(a)) continue;
          const std::size_t i = stored.matrix.surfaces.patch_at[a];
          double sum = 0, above = 0;
          for (std::uint32_t b = 0; b < stored.matrix.surfaces.size(); ++b) {
            if (stored.matrix.surfaces.is_block(b)) continue;
            const std::size_t j = stored.matrix.surfaces.patch_at[b];
            const Material& material = s.materials[s.meshes[scene.patches[j].mesh].material];
            const double sent = stored.form_factor(i, j) * material.diffuse.c[c];
            sum += sent;
            above += b > a ? sent : 0;
          }
          most = std::max(most, sum);
          most_above = std::max(most_above, above);
        }
        EXPECT_NEAR(stored.matrix.reflected[c], most, 1e-12);
        EXPECT_NEAR(stored.matrix.reflected_upper[c], blocks ? most : most_above, 1e-12);
      }
    }
  }
}

TEST(GaussSeidel, SweepsAreThoseOfTheTextbook) {
  // Two sweeps without a correction between are not to be had, so one: tolerance 1e9 stops after the first.
  Options options;
  options.tolerance = 1e9;
  AmbientScene scene(grey(0.8) + box_walls(2, 3, 1, 2, 3, 2, "white"), options);
  scene.light([](const Vec3& p, std::uint32_t m) { return m == 1 ? 100 * p.x : 10.0; });
  ASSERT_TRUE(scene.solve().done());
  EXPECT_EQ(scene.statistics.sweeps, 1u);
  const StoredMatrix stored(scene);
  std::vector<double> e(scene.lux);
  for (std::uint32_t position = 0; position < stored.n; ++position) {
    const std::size_t i = stored.matrix.surfaces.patch_at[position];
    double sum = 0;
    for (std::size_t j = 0; j < stored.n; ++j) sum += stored.form_factor(i, j) * 0.8 * e[j];
    e[i] = scene.lux[i] + sum;
  }
  for (std::size_t i = 0; i < stored.n; ++i) EXPECT_NEAR(scene.total(i), e[i], 1e-12 * e[i]);
}

TEST(GaussSeidel, FurnaceGivesE0OverOneMinusRho) {
  for (const double rho : {0.1, 0.5, 0.9, 0.99, 0.9999}) {
    Options options;
    options.tolerance = 1e-9;
    AmbientScene scene(grey(rho) + box_walls(3, 2, 1, 3, 4, 2, "white"), options);
    scene.light([](const Vec3&, std::uint32_t) { return 50.0; });
    ASSERT_TRUE(scene.solve().done());
    // Every row is scaled to 1, so the answer is flat, whatever the form factors.
    for (std::size_t i = 0; i < scene.patches.size(); ++i) {
      EXPECT_NEAR(scene.total(i) * (1 - rho) / 50, 1, 1e-6) << rho;
    }
  }
}

TEST(GaussSeidel, FurnaceOfOneStoredRowSumGivesE0OverOneMinusRhoTimesThatSum) {
  // A cube of six patches: all rows have one sum s by symmetry, which isn't 1 without scaling.
  Options options;
  options.scale_rows = false;
  options.tolerance = 1e-9;
  AmbientScene scene(grey(0.95) + box_walls(1, 1, 1, 1, 1, 1, "white"), options);
  scene.light([](const Vec3&, std::uint32_t) { return 50.0; });
  ASSERT_TRUE(scene.solve().done());
  const StoredMatrix stored(scene);
  const double s = stored.row_sum(0);
  EXPECT_NE(s, 1);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(scene.total(i) * (1 - 0.95 * s) / 50, 1, 1e-6);
}

TEST(GaussSeidel, NearlyWhiteRoomsNeedFewSweeps) {
  for (const int n : {2, 5, 8}) {
    AmbientScene scene(grey(0.9999) + box_walls(6, 4, 3, n, n, n, "white"));
    scene.light([](const Vec3& p, std::uint32_t m) { return m == 0 && p.x < 2 ? 1000.0 : 0; });
    ASSERT_TRUE(scene.solve().done());
    EXPECT_LE(scene.statistics.solution_bound, 1e-4);
    EXPECT_LT(scene.statistics.sweeps, 20u) << n;
  }
}

TEST(GaussSeidel, LightThatGoesFarInSmallStepsNeedsFewSweepsToo) {
  // A corridor of a hundred times its width, a flat gap, plates a thousandth apart in squares and in strips: sweeps
  // alone need hundreds to thousands. Several channels, and several meshes a group.
  const std::string plates = "object plates\nquad white 0 0 0  1 0 0  1 1 0  0 1 0 patches %d %d sub 1 1\n"
                             "quad white 0 0 1e-3  0 1 1e-3  1 1 1e-3  1 0 1e-3 patches %d %d sub 1 1\n";
  const auto cut = [&](int n, int m) {
    char text[300];
    std::snprintf(text, sizeof text, plates.c_str(), n, m, m, n);
    return std::string(text);
  };
  const auto expect_few = [](const std::string& text, double tolerance, bool blocks, bool eliminate) {
    SCOPED_TRACE(testing::Message() << tolerance << (blocks ? ", blocks: " : ": ") << text.substr(0, 100));
    Options options;
    options.tolerance = tolerance;
    options.rules.blocks = blocks;
    AmbientScene scene(grey(0.9999) + text, options);
    scene.light([](const Vec3& p, std::uint32_t m) { return m == 0 ? 100 + 50 * p.x : 0; });
    ASSERT_TRUE(scene.solve().done());
    const Statistics statistics = scene.statistics;
    EXPECT_LT(statistics.sweeps, 45u);  // asked for: 60
    EXPECT_LE(statistics.solution_bound, tolerance);
    if (eliminate) {
      EXPECT_LE(true_error(scene), statistics.solution_bound + 1e-15);
    }
  };
  const std::string scenes[] = {box_walls(1, 1, 100, 1, 1, 60, "white"), box_walls(10, 10, 0.1, 12, 12, 1, "white"),
                                cut(12, 12), cut(150, 1)};
  const std::string larger[] = {box_walls(1, 1, 100, 2, 2, 100, "white"), box_walls(1, 1, 300, 1, 1, 300, "white"),
                                box_walls(10, 10, 0.1, 20, 20, 1, "white"), cut(20, 20), cut(200, 1)};
  for (const bool blocks : {false, true}) {
    for (const std::string& text : scenes) {
      for (const double tolerance : {1e-2, 1e-4, 1e-8}) expect_few(text, tolerance, blocks, true);
    }
    for (const std::string& text : larger) expect_few(text, 1e-8, blocks, false);
  }
}

TEST(GaussSeidel, SlowLightIsFoundInEveryMemoryWithBlocksRulesAndColoursToo) {
  // Three channels have their vectors elsewhere than one; columns that come back have errors that must stay.
  const std::string coloured = "shodo 1\nmaterial white diffuse 0.9999 0.999 0.9\n", 
                    corridor = box_walls(1, 1, 12, 2, 2, 8, "white");
  for (const std::string& material : {coloured, grey(0.9999)}) {
    for (const char* rules : {"none", "blocks", "3", "2+"}) {
      Options options;
      options.rules.blocks = std::string_view(rules) == "blocks";
      options.rules.rule3 = std::string_view(rules) == "3";
      options.rules.rule2 = options.rules.rule2_repeated = std::string_view(rules) == "2+";
      SCOPED_TRACE(rules);
      expect_same_bits_in_any_memory(
          material + corridor, options,
          [](const Vec3& p, std::uint32_t) { return p.z < 2 ? 100 + 50 * p.x : 0.0; }, {0},
          [&](AmbientScene& tight, const Arena&, std::uint64_t) {
            const Statistics statistics = tight.statistics;
            EXPECT_GT(statistics.sweeps, 12u);  // what is tested is used
            EXPECT_LE(statistics.solution_bound, options.tolerance);
            EXPECT_LE(true_error(tight), statistics.solution_bound + 1e-15);
          });
    }
  }
}

TEST(GaussSeidel, AToleranceBeyondRoundingEndsAndTellsTheBoundReached) {
  Options options;
  options.tolerance = 1e-30;
  AmbientScene scene(grey(0.9999) + box_walls(1, 1, 1, 3, 3, 3, "white"), options);
  scene.light([](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; });
  ASSERT_TRUE(scene.solve().done());
  EXPECT_LT(scene.statistics.sweeps, 100u);
  const double bound = scene.statistics.solution_bound;
  EXPECT_LT(bound, 1e-8);
  EXPECT_LE(true_error(scene), bound);
}

TEST(GaussSeidel, RowsAboveOneThatAreNotScaledEndWithoutABound) {
  Options options;
  options.scale_rows = false;
  options.tiers = 0.5;  // far kernels between neighbours: sums well above 1
  AmbientScene scene(grey(0.9999) + box_walls(1, 1, 1, 2, 2, 2, "white"), options);
  scene.light([](const Vec3&, std::uint32_t) { return 1.0; });
  ASSERT_TRUE(scene.solve().done());
  EXPECT_LT(scene.statistics.sweeps, 200u);
  EXPECT_EQ(scene.statistics.solution_bound, kNoBound);
  for (const double lx : scene.ambient.patch_lx) EXPECT_TRUE(std::isfinite(lx));
}

TEST(GaussSeidel, DarknessStaysDarkness) {
  AmbientScene scene(grey(0.5) + box_walls(1, 1, 1, 2, 2, 2, "white"));
  ASSERT_TRUE(scene.solve().done());
  for (const double lx : scene.ambient.patch_lx) EXPECT_EQ(lx, 0);
  EXPECT_EQ(scene.statistics.solution_bound, 0);
}

}  // namespace
}  // namespace shodo
