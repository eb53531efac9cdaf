// The sparsity rules of paper 3.2, each against what it says, taken literally on a dense matrix.
#include <algorithm>
#include <cmath>

#include "ambient/ambient_memory.h"
#include "support/solved_scene.h"
#include "tests/ambient/rules_scene.h"

namespace shodo {
namespace {

/// Rules 1 and 2 on the matrix that has every pair: rows and columns emptied, nothing scaled.
TEST(Rules, RulesOneAndTwoEmptyRowsAndColumnsOfTheMatrixThatHasEveryPair) {
  for (int which = 1; which <= 3; ++which) {
    Rules rules;
    rules.rule1 = (which & 1) != 0;
    rules.rule2 = (which & 2) != 0;
    Options none = with_rules({}), some = with_rules(rules);
    none.scale_rows = some.scale_rows = false;
    AmbientScene full(furnished(kRho, 1), none), scene(furnished(kRho, 1), some);
    full.light(e0_of);
    scene.light(e0_of);
    StoredMatrix stored(full);
    const std::size_t n = stored.n;
    std::uint32_t rows = 0, columns = 0;
    std::uint64_t nonzeros = 0;
    std::vector<double> f(stored.f);
    for (std::size_t i = 0; i < n; ++i) {
      const double luminance = kRho * scene.lux[i] / M_PI;
      const bool bright = rules.rule1 && luminance > 50, dark = rules.rule2 && luminance < 1;
      rows += bright;
      columns += dark;
      for (std::size_t j = 0; j < n; ++j) {
        if (bright) f[i * n + j] = 0;
        if (dark) f[j * n + i] = 0;
      }
    }
    for (const double factor : f) nonzeros += factor > 0;
    ASSERT_TRUE(scene.solve().done());
    EXPECT_EQ(scene.statistics.rows_emptied, rows);
    EXPECT_EQ(scene.statistics.columns_emptied, columns);
    EXPECT_EQ(scene.statistics.nonzeros, nonzeros);
    EXPECT_GT(rows + columns, 0u);
    EXPECT_LT(largest_difference(solved(f, scene, kRho), scene), 1e-6);
    for (std::size_t i = 0; i < n; ++i) {
      if (rules.rule1 && kRho * scene.lux[i] / M_PI > 50) {
        EXPECT_EQ(scene.ambient.patch_lx[i], 0);
      }
    }
  }
}

/// references.md: a cube, one face lit 100 lx, rho 0.7: rule 2 keeps the first bounce only.
TEST(Rules, RuleTwoLosesHalfOfACubeAndItsBoundSaysSo) {
  const std::string text = grey(0.7) + "display 0.01 250\n" + box_walls(1, 1, 1, 4, 4, 4, "white");
  const auto lit = [](const Vec3&, std::uint32_t m) { return m == 0 ? 100.0 : 0; };
  AmbientScene none(text, with_rules({})), two(text, with_rules(rule(2)));
  Rules repeated;
  repeated.rule2_repeated = true;
  AmbientScene again(text, with_rules(repeated));
  for (AmbientScene* scene : {&none, &two, &again}) {
    scene->light(lit);
    ASSERT_TRUE(scene->solve().done());
  }
  // All light: 100 / 6 / (1 - 0.7) = 55.6 lx in the mean; the four bounces lost are all but the first.
  EXPECT_NEAR(none.mean(false), 100.0 / 6 / 0.3, 0.01);
  EXPECT_NEAR(two.mean(false), 100.0 / 6 * (1 + 0.7), 0.1);
  double loss = 0;
  for (std::size_t i = 0; i < none.patches.size(); ++i) loss = std::max(loss, none.total(i) - two.total(i));
  EXPECT_GT(loss, 25);
  EXPECT_GE(two.statistics.rule2_bound_lx, loss);
  EXPECT_LT(two.statistics.rule2_bound_lx, 4 * loss);
  EXPECT_EQ(two.statistics.columns_emptied, 80u);
  // All come back, and then nothing tells the two apart.
  EXPECT_EQ(again.statistics.columns_restored, 80u);
  EXPECT_EQ(again.statistics.columns_emptied, 0u);
  EXPECT_EQ(again.statistics.rule2_bound_lx, 0);
  EXPECT_EQ(again.statistics.segments_ambient, none.statistics.segments_ambient);
  for (std::size_t i = 0; i < none.patches.size(); ++i) EXPECT_NEAR(again.total(i), none.total(i), 1e-6 * 100);
}

TEST(Rules, TheLastRoundPutsEveryColumnBack) {
  // One more patch is bright in each round, as along a row of rooms: what is still out before the last round comes
  // then.
  Options options;
  options.rules.rule2_repeated = true;
  AmbientScene scene(grey(0.7) + "display 1 250\n" + box_walls(1, 1, 1, 3, 3, 3, "white"), options);
  scene.light([](const Vec3&, std::uint32_t) { return 0.0; });
  Matrix matrix(scene.loaded.arena);
  Surfaces& surfaces = matrix.surfaces = surfaces_of(scene);
  Sparsity& sparsity = matrix.sparsity;
  ASSERT_TRUE(sparsity.take(scene.loaded.arena, surfaces, scene.direct, options.rules).done());
  std::vector<double> ambient(scene.patches.size(), 0.0);
  const auto sending = [&] {
    std::size_t count = 0;
    for (std::uint32_t node = 0; node < surfaces.size(); ++node) count += sparsity.sends(node) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(sending(), 0u);
  EXPECT_FALSE(sparsity.restore(surfaces, scene.direct, ambient)) << "nothing is bright";
  for (std::size_t round = 1; round < kGenerations; ++round) {
    ambient[5 * round] = 100;
    ASSERT_TRUE(sparsity.restore(surfaces, scene.direct, ambient)) << round;
    EXPECT_EQ(sparsity.now(), round);
    EXPECT_EQ(sending(), round + 1 < kGenerations ? round : ambient.size());
  }
  EXPECT_FALSE(sparsity.restore(surfaces, scene.direct, ambient)) << "all are there";
}

TEST(Rules, RuleTwosBoundIsNeverBelowItsLoss) {
  for (const double least : {0.1, 1.0, 3.0, 10.0}) {
    for (const double rho : {0.2, 0.6, 0.9}) {
      const std::string text = grey(rho) + "display " + std::to_string(least) + " 500\n" +
                               box_walls(4, 3, 2.5, 4, 3, 3, "white") + kTable;
      // The bound speaks of one matrix; scaling would make it two.
      Options none = with_rules({}), two = with_rules(rule(2));
      none.scale_rows = two.scale_rows = false;
      AmbientScene full(text, none), scene(text, two);
      full.light(e0_of);
      scene.light(e0_of);
      ASSERT_TRUE(full.solve().done());
      ASSERT_TRUE(scene.solve().done());
      double loss = 0;
      for (std::size_t i = 0; i < full.patches.size(); ++i) loss = std::max(loss, full.total(i) - scene.total(i));
      EXPECT_GE(scene.statistics.rule2_bound_lx, loss) << least << ", " << rho;
      EXPECT_GT(scene.statistics.columns_emptied, 0u);
    }
  }
}

/// A row of rooms behind one another, each lit only through a slit from the one before: columns come back in rounds.
TEST(Rules, RuleTwoRepeatedLeavesOnlyColumnsBelowTheLeastLuminance) {
  for (const double least : {0.5, 0.05}) {
    std::string text = grey(0.5) + "display " + std::to_string(least) + " 500\n" + box_walls(8, 2, 2, 8, 2, 2, "white");
    text += "object screens\n";
    for (int k = 2; k < 8; k += 2) {
      const std::string x = std::to_string(k), beyond = std::to_string(k + 0.05);
      const std::string low = k % 4 == 0 ? "0" : "0.2", high = k % 4 == 0 ? "1.8" : "2";
      text += "quad white " + x + " " + low + " 0 " + x + " " + low + " 2 " + x + " " + high + " 2 " + x + " " + high +
              " 0 patches 2 2 sub 1 1\n";
      text += "quad white " + beyond + " " + low + " 0 " + beyond + " " + high + " 0 " + beyond + " " + high +
              " 2 " + beyond + " " + low + " 2 patches 2 2 sub 1 1\n";
    }
    Rules repeated;
    repeated.rule2_repeated = true;
    Options none = with_rules({}), some = with_rules(repeated);
    none.scale_rows = some.scale_rows = false;
    AmbientScene full(text, none), scene(text, some);
    for (AmbientScene* each : {&full, &scene}) {
      each->light([](const Vec3& p, std::uint32_t m) { return m == 0 && p.x < 2 ? 1000.0 : 0; });
      ASSERT_TRUE(each->solve().done());
    }
    EXPECT_GE(scene.statistics.rule2_rounds, 2u);
    EXPECT_GT(scene.statistics.columns_restored, 20u);
    double loss = 0;
    for (std::size_t i = 0; i < full.patches.size(); ++i) loss = std::max(loss, full.total(i) - scene.total(i));
    // Every column that is left out has rho E / pi < least, so rho E / (1 - rho) < pi least / (1 - rho).
    EXPECT_LE(scene.statistics.rule2_bound_lx, M_PI * least / 0.5);
    EXPECT_LE(loss, scene.statistics.rule2_bound_lx + 1e-6);
    // The rounds go on where they stopped: the same rows, and the same fixed point as in one go.
    const StoredMatrix stored(scene);
    EXPECT_LT(largest_difference(solved(stored.f, scene, 0.5), scene), 1e-5);
  }
}

/// Rule 3 as the paper has it, F_ij = F_im / p, on a dense matrix: F_im from the exchange with the mesh as one patch.
TEST(Rules, RuleThreeGivesEachPatchOfADistantMeshAnEqualShareOfItsFormFactor) {
  Rules rules = rule(3);
  rules.rule3_diameters = 0.5;
  Options options = with_rules(rules);
  options.scale_rows = false;
  AmbientScene scene(furnished(kRho, 2), options);
  scene.light(e0_of);
  ASSERT_TRUE(scene.solve().done());
  EXPECT_GT(scene.statistics.block_links, 100u);
  const StoredMatrix stored(scene);
  const std::size_t n = stored.n;
  for (std::size_t k = 0; k < n * n; ++k) EXPECT_LE(stored.covered[k], 1);
  const Surfaces& s = stored.matrix.surfaces;
  Intersector intersector(scene.geometry);
  int shares = 0;
  for (std::uint32_t i = 0; i < s.size(); ++i) {
    for (std::uint32_t m = 0; m < s.size(); ++m) {
      if (s.is_block(i) || !s.is_block(m) || s.patch(i).mesh == s.patch(m).mesh) continue;
      const std::vector<std::uint32_t> parts = stored.patches_of(m);
      const std::size_t patch = s.patch_at[i];
      const auto share = [&](std::uint32_t j) { return stored.form_factor(patch, j); };
      if (std::ranges::any_of(parts, [&](std::uint32_t j) { return share(j) != share(parts[0]); })) continue;
      if (!(share(parts[0]) > 0)) continue;
      const PairExchange whole = exchange_between(s, row_side(s, std::min(i, m)), std::max(i, m), options.tiers);
      double sum = 0;
      for (const std::uint32_t j : parts) sum += share(j);
      if (!(sum * s.patch(i).area > 0.99 * whole.geometric)) continue;  // shadowed by the table
      EXPECT_NEAR(sum, whole.geometric / s.patch(i).area, 1e-12);
      ++shares;
    }
  }
  EXPECT_GT(shares, 100);
  EXPECT_LT(largest_difference(solved(stored.f, scene, kRho), scene), 1e-6);
}

TEST(Rules, RuleThreeWantsDistanceAndEqualAreas) {
  // Far: one link a patch. Near, or with unequal patches: one a pair.
  const auto links = [](const std::string& mesh, double height) {
    const std::string at = std::to_string(height);
    AmbientScene scene(grey(0.5) + "object a\nquad white 0 0 0 1 0 0 1 1 0 0 1 0 patches 1 1 sub 1 1\n" +
                           "object b\nquad white " +
                           (mesh == "even" ? "0 0 " + at + " 0 1 " + at + " 1 1 " + at + " 1 0 " + at
                                           : "0 0 " + at + " 0.4 1 " + at + " 0.6 1 " + at + " 1 0 " + at) +
                           " patches 3 3 sub 1 1\n",
                       with_rules(rule(3)));
    scene.light([](const Vec3&, std::uint32_t) { return 100.0; });
    EXPECT_TRUE(scene.solve().done());
    return scene.statistics.links;
  };
  EXPECT_EQ(links("even", 5), 1u);
  EXPECT_EQ(links("even", 0.5), 9u);
  EXPECT_EQ(links("uneven", 5), 9u);
}

TEST(Rules, AllOfThemTogetherSolveTheirOwnMatrix) {
  Rules rules;
  rules.rule1 = rules.rule2 = rules.rule3 = true;
  rules.rule3_diameters = 0.7;
  AmbientScene scene(furnished(kRho, 2), with_rules(rules));
  scene.light(e0_of);
  ASSERT_TRUE(scene.solve().done());
  EXPECT_GT(scene.statistics.rows_emptied, 0u);
  EXPECT_GT(scene.statistics.columns_emptied, 0u);
  EXPECT_GT(scene.statistics.block_links, 0u);
  const StoredMatrix stored(scene);
  EXPECT_EQ(scene.statistics.nonzeros,
            static_cast<std::uint64_t>(std::ranges::count_if(stored.f, [](double f) { return f > 0; })));
  EXPECT_LT(largest_difference(solved(stored.f, scene, kRho), scene), 1e-6);
}

TEST(Rules, ARowFromWhichAColumnWasDroppedIsNotScaledUp) {
  const std::string text = grey(0.5) + box_walls(1, 1, 1, 3, 3, 3, "white");
  const auto lit = [](const Vec3&, std::uint32_t m) { return m < 5 ? 100.0 : 0; };
  AmbientScene none(text, with_rules({})), two(text, with_rules(rule(2)));
  none.light(lit);
  two.light(lit);
  const StoredMatrix all(none), some(two);
  for (std::size_t i = 0; i < all.n; ++i) {
    EXPECT_NEAR(all.row_sum(i), 1, 1e-12);
    const bool dark = two.lux[i] == 0;
    if (!dark) {
      EXPECT_LT(some.row_sum(i), 0.98);
    }
    EXPECT_LE(some.row_sum(i), 1 + 1e-12);
  }
}

}  // namespace
}  // namespace shodo
