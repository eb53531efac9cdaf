// `--rules blocks`: links, energy, bounds, memory.
#include <algorithm>
#include <cmath>

#include "ambient/ambient_memory.h"
#include "support/solved_scene.h"
#include "tests/ambient/rules_scene.h"

namespace shodo {
namespace {

/// Every pair of patches that see each other is covered by one link; a box's rows then sum to 1.
TEST(Blocks, LinksCoverEveryPairOnceAndKeepTheEnergy) {
  for (const double error : {1e-1, 1e-2, 1e-3, 1e-6}) {
    Options options = with_rules(blocks(error));
    options.scale_rows = false;
    AmbientScene scene(grey(0.8) + box_walls(4, 3, 2.5, 7, 5, 3, "white"), options);
    scene.light([](const Vec3&, std::uint32_t) { return 100.0; });
    const StoredMatrix stored(scene);
    for (std::size_t i = 0; i < stored.n; ++i) {
      for (std::size_t j = 0; j < stored.n; ++j) {
        EXPECT_EQ(stored.covered[i * stored.n + j], scene.patches[i].mesh == scene.patches[j].mesh ? 0 : 1);
      }
    }
    // Energy: what all patches together send to all others is what they have, but for the error of the kernels: of
    // links that matter less than REL that of a disc's form factor, up to a fifth, and most of them too large.
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < stored.n; ++i) {
      sum += scene.patches[i].area * stored.row_sum(i);
      area += scene.patches[i].area;
    }
    EXPECT_NEAR(sum / area, 1, error < 1e-5 ? 2e-3 : error < 5e-3 ? 5e-3 : 5e-2) << error;
  }
}

TEST(Blocks, InABareRoomRowsAreScaledToOneAndTheLightIsKept) {
  // The parts of a block get its mean and so too much or too little; the estimated error of their rows counts that, so
  // that too little is scaled up as too much is scaled down. What is lost still: scaling a row isn't scaling its
  // column.
  AmbientScene scene(grey(0.5) + box_walls(6, 5, 3, 8, 8, 8, "white"), with_rules(blocks(0)));
  scene.light([](const Vec3& p, std::uint32_t) {  // of a small ball
    const Vec3 way = Vec3{2, 2, 2} - p;
    return 100 / (dot(way, way) + 0.3);
  });
  ASSERT_TRUE(scene.solve().done());
  double sent = 0, all = 0;
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    sent += scene.patches[i].area * scene.lux[i];
    all += scene.patches[i].area * scene.total(i);
  }
  EXPECT_NEAR(all * 0.5 / sent, 1, 0.01);
  const StoredMatrix stored(scene);
  EXPECT_GT(scene.statistics.rows_scaled, stored.n * 95 / 100);
}

TEST(Blocks, InAnOpenRoomWhatIsMissingStaysMissing) {
  // The light that leaves through a missing ceiling and wall is no error of the rows.
  const std::string whole = box_walls(4, 3, 2.5, 6, 5, 4, "white");
  const std::size_t ceiling = whole.find("object ceiling_"), next = whole.find("object wall_y0"),
                    last = whole.find("object wall_x1");
  const std::string open = grey(0.8) + whole.substr(0, ceiling) + whole.substr(next, last - next);
  const auto lit = [](const Vec3& p, std::uint32_t) { return 50 + 20 * p.y; };
  AmbientScene none(open, with_rules({})), linked(open, with_rules(blocks(0)));
  for (AmbientScene* scene : {&none, &linked}) {
    scene->light(lit);
    ASSERT_TRUE(scene->solve().done());
  }
  // Half of a corner's hemisphere is open: a row that were scaled up would have up to twice its light.
  for (std::size_t i = 0; i < none.patches.size(); ++i) {
    EXPECT_LT(linked.ambient.patch_lx[i], 1.25 * none.ambient.patch_lx[i]) << i;
  }
  EXPECT_NEAR(linked.mean(true) / none.mean(true), 1, 0.02);
  EXPECT_LT(linked.statistics.rows_scaled, none.patches.size() / 2);
}

TEST(Blocks, WhatDoesNotBlockHidesNoneOfTheBlockersAfterIt) {
  // By the scene's flags: specks that block nothing, in corners so that some come before a screen that does in any
  // order.
  std::string specks = "\n";
  for (const char* at : {"0.1 0.1", "3.9 0.1", "0.1 2.8", "3.9 2.8"}) {
    for (const char* z : {"0.1", "2.3"}) {
      const double x = std::stod(at), y = std::stod(std::string(at).substr(4));
      const auto corner = [&](double dx, double dy) {
        return " " + std::to_string(x + dx) + " " + std::to_string(y + dy) + " " + z;
      };
      specks += "quad white" + corner(0, 0) + corner(0.05, 0) + corner(0.05, 0.05) + corner(0, 0.05) +
                " patches 1 1 sub 1 1\n";
    }
  }
  const auto mean = [&](const char* speck, const char* screen) {
    const std::string text = grey(0.5) + "display 0 1\n" + box_walls(4, 3, 2.5, 4, 4, 4, "white") +
                             "object specks ambient " + speck + specks + "object screen ambient " + screen +
                             "\nquad white 2 0.1 0.1  2 2.9 0.1  2 2.9 2.4  2 0.1 2.4 patches 1 1 sub 1 1\n"
                             "light l point at 1 1.5 1.2 intensity 100\n";
    Options options = with_rules(blocks(0));
    options.flags = FlagMode::kScene;
    const SolvedScene solved(text, options);
    double sum = 0;  // of the wall behind the screen
    const Mesh& wall = solved.model->scene.meshes[5];
    for (std::uint32_t k = 0; k < wall.patch_count(); ++k) sum += solved.model->ambient.patch_lx[wall.first_patch + k];
    return sum;
  };
  const double both = mean("+blocks", "+blocks"), one = mean("-blocks", "+blocks"), none = mean("-blocks", "-blocks");
  EXPECT_NEAR(one, both, 0.01 * both);
  EXPECT_GT(none, 1.2 * both);
}

TEST(Blocks, TiltedScreensHideAsMuchAsWithoutRules) {
  // A screen aslant through the room, of two triangles that are square to no axis; all light is on one side.
  const std::string screen = "object screen\nquad white 1.6 0 0  2.6 3 0  2.4 3 2.5  1.4 0 2.5 patches 1 1 sub 1 1\n"
                             "quad white 1.6 0 0  1.4 0 2.5  2.4 3 2.5  2.6 3 0 patches 1 1 sub 1 1\n";
  const auto behind = [](const std::string& text, const Rules& rules) {
    const SolvedScene solved(grey(0.5) + box_walls(4, 3, 2.5, 5, 5, 5, "white") + text +
                             "light l point at 0.7 1.5 1.2 intensity 100\n", with_rules(rules));
    const Mesh& wall = solved.model->scene.meshes[5];
    double sum = 0;
    for (std::uint32_t k = 0; k < wall.patch_count(); ++k) sum += solved.model->ambient.patch_lx[wall.first_patch + k];
    return sum;
  };
  const double hidden = behind(screen, {}), linked = behind(screen, blocks(0)), all = behind("", {});
  // Patches that stand on both sides of it, and their samples, let some light through.
  EXPECT_LT(hidden, 0.1 * all);
  EXPECT_LT(linked, 0.1 * all);
}

TEST(Blocks, TheSolutionIsThatOfTheStoredMatrix) {
  for (const double error : {1e-1, 1e-2, 1e-3}) {
    AmbientScene scene(furnished(kRho, 2), with_rules(blocks(error)));
    scene.light(e0_of);
    ASSERT_TRUE(scene.solve().done());
    const Statistics statistics = scene.statistics;
    const StoredMatrix stored(scene);
    const std::vector<double> e = solved(stored.f, scene, kRho);
    EXPECT_LE(largest_difference(e, scene), (statistics.solution_bound + 1e-12) * *std::ranges::max_element(e));
    EXPECT_LE(statistics.solution_bound, 1e-9);
    EXPECT_EQ(statistics.nonzeros,
              static_cast<std::uint64_t>(std::ranges::count_if(stored.f, [](double f) { return f > 0; })));
  }
}

TEST(Blocks, TheLargestReflectedSumIsThatOfTheStoredMatrix) {
  // The certified bound goes by it. A dark strip under a white ceiling, its first patch beside a white wall: that row's
  // sum is the largest, and a third of it is handed down from its blocks.
  const std::string text =
      "shodo 1\nmaterial white diffuse 0.9\nmaterial dark diffuse 0.1\n"
      "object strip\nquad dark 0 0 0  8 0 0  8 1 0  0 1 0 patches 8 1 sub 1 1\n"
      "object wall\nquad white -0.1 0 0  -0.1 1 0  -0.1 1 0.5  -0.1 0 0.5 patches 1 1 sub 1 1\n"
      "object ceiling\nquad white 0 -3 9  0 3 9  8 3 9  8 -3 9 patches 6 6 sub 1 1\n";
  AmbientScene scene(text, with_rules(blocks(0.0005)));
  scene.light([](const Vec3&, std::uint32_t) { return 1.0; });
  const StoredMatrix stored(scene);
  double largest = 0;
  std::size_t which = 0;
  for (std::size_t i = 0; i < stored.n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < stored.n; ++j) {
      sum += (scene.patches[j].mesh == 0 ? 0.1 : 0.9) * stored.form_factor(i, j);
    }
    if (sum > largest) {
      largest = sum;
      which = i;
    }
  }
  EXPECT_EQ(which, 0u);
  EXPECT_GT(stored.matrix.surfaces.blocks.size(), 0u);
  EXPECT_NEAR(stored.matrix.reflected[0], largest, 1e-12 * largest);
}

TEST(Blocks, ALooseToleranceHasABoundThatHolds) {
  for (const double tolerance : {0.3, 1e-1, 1e-2, 1e-4}) {
    Options options = with_rules(blocks(1e-2));
    options.tolerance = tolerance;
    AmbientScene scene(furnished(0.9, 2), options);
    scene.light(e0_of);
    ASSERT_TRUE(scene.solve().done());
    const double bound = scene.statistics.solution_bound;
    const StoredMatrix stored(scene);
    const std::vector<double> e = solved(stored.f, scene, 0.9);
    EXPECT_LE(largest_difference(e, scene), bound * *std::ranges::max_element(e));
  }
}

double rms_of_difference(const AmbientScene& a, const AmbientScene& b) {
  double sum = 0, area = 0, mean = 0;
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    const double apart = a.total(i) - b.total(i);
    sum += a.patches[i].area * apart * apart;
    mean += a.patches[i].area * b.total(i);
    area += a.patches[i].area;
  }
  return std::sqrt(sum / area) / (mean / area);
}

TEST(Blocks, ErrorToZeroGivesTheAnswerWithoutBlocks) {
  AmbientScene none(furnished(kRho, 2), with_rules({}));
  none.light(e0_of);
  ASSERT_TRUE(none.solve().done());
  double last = 1;
  for (const double error : {1e-1, 1e-2, 1e-3, 1e-9}) {
    AmbientScene scene(furnished(kRho, 2), with_rules(blocks(error)));
    scene.light(e0_of);
    ASSERT_TRUE(scene.solve().done());
    const double apart = rms_of_difference(scene, none);
    EXPECT_LE(apart, last) << error;
    last = apart;
    if (error == 1e-9) {
      EXPECT_EQ(scene.statistics.links, none.statistics.links);
    }
  }
  EXPECT_LT(last, 1e-9);  // the same pairs, summed in another order
}

TEST(Blocks, OfShapesWithoutAPlaceOnTheLatticeLinksAreFoundToo) {
  // An arrowhead over the floor, both ways: what it gets from the room, and what the floor below loses of the ceiling's
  // light and gets of the arrowhead's.
  const std::string text = grey(0.5) + box_walls(4, 3, 2.5, 6, 5, 4, "white") +
                           "object up\nquad white  1 1 1  2.5 1.5 1  1 2 1  1.5 1.5 1  patches 1 1 sub 1 1\n"
                           "object down\nquad white  1 1 0.98  1.5 1.5 0.98  1 2 0.98  2.5 1.5 0.98"
                           "  patches 1 1 sub 1 1\n";
  AmbientScene none(text, with_rules({})), linked(text, with_rules(blocks(0)));
  for (AmbientScene* scene : {&none, &linked}) {
    scene->light([](const Vec3& p, std::uint32_t) { return 50 + 20 * p.y; });
    ASSERT_TRUE(scene->solve().done());
  }
  int arrows = 0;
  for (std::size_t i = 0; i < none.patches.size(); ++i) {
    if (none.patches[i].mesh < 6) continue;
    ++arrows;
    EXPECT_NEAR(linked.ambient.patch_lx[i], none.ambient.patch_lx[i], 0.05 * none.ambient.patch_lx[i]) << i;
  }
  EXPECT_EQ(arrows, 2);
}

/// What is displayed as white counts as white: a garden in the sun must not make all that is indoors too dark to
/// matter.
TEST(Blocks, ASunlitFieldOutsideTakesNoCareFromARoom) {
  const std::string room = furnished(kRho, 2);
  const std::string field = "object field\nquad white -40 -40 -1  -40 40 -1  40 40 -1  40 -40 -1 patches 8 8 sub 1 1\n";
  const std::uint32_t meshes = 8;
  double apart[2];
  for (const bool outside : {false, true}) {
    const std::string text = outside ? room + field : room;
    AmbientScene none(text, with_rules({})), some(text, with_rules(blocks(2e-4)));
    double squares = 0, sum = 0, area = 0;
    for (AmbientScene* scene : {&none, &some}) {
      scene->light([&](const Vec3& p, std::uint32_t m) { return m == meshes ? 1e5 : e0_of(p, m); });
      ASSERT_TRUE(scene->solve().done());
    }
    for (std::size_t i = 0; i < none.patches.size() && none.patches[i].mesh < meshes; ++i) {
      const double difference = some.total(i) - none.total(i);
      squares += none.patches[i].area * difference * difference;
      sum += none.patches[i].area * none.total(i);
      area += none.patches[i].area;
    }
    apart[outside ? 1 : 0] = std::sqrt(squares / area) / (sum / area);
  }
  EXPECT_LT(apart[0], 0.02);  // REL times the root of some thousand links
  EXPECT_LT(apart[1], apart[0]);  // 10 % when the field's 1e5 lx were the measure
}

/// Cost against size: at REL fixed, links must grow clearly slower than the square of the patches.
TEST(Blocks, LinksGrowSlowerThanTheSquareOfThePatches) {
  std::vector<double> patches, links;
  for (const double refine : {1.0, 2.0, 4.0}) {
    Options options = with_rules(blocks(1e-2));
    options.refine = refine;
    options.segments_first = options.segments_mixed = 1;
    AmbientScene scene(furnished(kRho, 1), options);
    scene.light(e0_of);
    ASSERT_TRUE(scene.solve().done());
    patches.push_back(static_cast<double>(scene.statistics.blocks) + 8);
    links.push_back(static_cast<double>(scene.statistics.links));
  }
  EXPECT_LT(std::log(links[2] / links[1]) / std::log(patches[2] / patches[1]), 1.5);
}

TEST(Blocks, RowsComputedAgainGiveTheBitsOfRowsKept) {
  Rules repeated = blocks(1e-2);
  repeated.rule2_repeated = true;
  for (const Rules& rules : {blocks(1e-2), rule(3), repeated}) {
    Options options = with_rules(rules);
    options.segments_first = 1;
    options.segments_mixed = 16;
    expect_same_bits_in_any_memory(furnished(0.7, 2), options, e0_of, {0, 1500, 4000},
                                   [](const AmbientScene&, const Arena&, std::uint64_t) {});
  }
}

TEST(Blocks, HiddenPatchesTakeNoPartInTheirBlocks) {
  for (const bool rule2 : {false, true}) {
    Rules rules = blocks(1);
    rules.rule2 = rule2;
    AmbientScene scene(grey(0.5) + box_walls(1, 1, 1, 4, 4, 4, "white"), with_rules(rules));
    scene.light([](const Vec3&, std::uint32_t) { return 100.0; });
    scene.visible[3] = 0;
    scene.patches[5].dropped = 1;
    for (std::size_t i = 16; i < 32; ++i) scene.visible[i] = 0;  // a whole mesh
    ASSERT_TRUE(scene.solve().done());
    const std::uint64_t nonzeros = scene.statistics.nonzeros;
    const StoredMatrix stored(scene);
    EXPECT_EQ(nonzeros, static_cast<std::uint64_t>(std::ranges::count_if(stored.f, [](double f) { return f > 0; })));
    for (std::size_t j = 0; j < stored.n; ++j) {
      for (const std::size_t gone : {3, 5, 16, 31}) {
        EXPECT_EQ(scene.ambient.patch_lx[gone], 0);
        EXPECT_EQ(stored.form_factor(gone, j), 0);
        EXPECT_EQ(stored.form_factor(j, gone), 0);
      }
    }
  }
}

}  // namespace
}  // namespace shodo
