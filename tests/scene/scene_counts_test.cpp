// How many patches and sub-patches a mesh gets where the file doesn't say (contract 1 and 2).
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scene/mesh.h"
#include "support/scene_from_text.h"

namespace shodo {
namespace {

const std::string kStart = "shodo 1\nmaterial m diffuse 0.5\nobject o\n";
// 6.5 along u, 4.5 along v.
const std::string kFloor = "quad m 0 0 0  6.5 0 0  6.5 0 4.5  0 0 4.5\n";

struct Counts {
  std::uint32_t nu, nv, su, sv;
  bool operator==(const Counts&) const = default;
};

void PrintTo(const Counts& c, std::ostream* out) { *out << c.nu << " " << c.nv << " " << c.su << " " << c.sv; }

Counts counts_of(const std::string& text, const Options& options = {}, std::uint32_t m = 0) {
  const LoadedScene s(kStart + text, options);
  const Mesh& mesh = s.scene.meshes[m];
  return {mesh.nu, mesh.nv, mesh.su, mesh.sv};
}

Options with_patch(double size) {
  Options options;
  options.patch_size = size;
  return options;
}

Options with_sub_patch(double size) {
  Options options;
  options.sub_patch_size = size;
  return options;
}

Options with_refine(double k) {
  Options options;
  options.refine = k;
  return options;
}

TEST(SceneCounts, EdgesAreCutToThePatchSize) {
  EXPECT_EQ(counts_of(kFloor, with_patch(1)), (Counts{7, 5, 3, 3}));
  EXPECT_EQ(counts_of(kFloor, with_patch(0.5)), (Counts{13, 9, 3, 3}));
  EXPECT_EQ(counts_of(kFloor, with_patch(100)), (Counts{1, 1, 3, 3}));
  // 2.7 / 0.3 is 9 and a little more in doubles.
  EXPECT_EQ(counts_of("quad m 0 0 0  2.7 0 0  2.7 0 0.3  0 0 0.3", with_patch(0.3)), (Counts{9, 1, 3, 3}));
  EXPECT_EQ(counts_of(kFloor, with_patch(0.325)), (Counts{20, 14, 3, 3}));
  EXPECT_EQ(counts_of(kFloor, with_patch(0.1)), (Counts{65, 45, 3, 3}));
  EXPECT_EQ(counts_of(kFloor, with_patch(0.0999)), (Counts{66, 46, 3, 3}));
}

TEST(SceneCounts, TheDefaultIsTheTwentyFourthPartOfTheDiagonal) {
  // A 6 x 8 floor and a point 0.001 high make a diagonal of 10.
  EXPECT_EQ(counts_of("quad m 0 0 0  6 0 0  6 0 8  0 0 8"), (Counts{15, 20, 3, 3}));
  // Half of it, with the other half beside it: the same size of patches.
  EXPECT_EQ(counts_of("quad m 0 0 0  3 0 0  3 0 8  0 0 8\nquad m 3 0 0  6 0 0  6 0 8  3 0 8"), (Counts{8, 20, 3, 3}));
}

TEST(SceneCounts, WhereOneLooksFromAndLightsChangeNoPatches) {
  const std::string far = "camera c eye 100 0 0 look 0 0 0 up 0 1 0 fov 9\nlight l point at 0 99 0 intensity 1\n";
  EXPECT_EQ(counts_of(kFloor + far), counts_of(kFloor));
}

TEST(SceneCounts, OfOppositeEdgesTheLongerCounts) {
  EXPECT_EQ(counts_of("quad m 0 0 0  2 0 0  5 0 3  0 0 4", with_patch(1)),
            (Counts{6, 5, 3, 3}));  // u: 2 and sqrt(26); v: sqrt(18) and 4
}

TEST(SceneCounts, OfATriangleTheLongestEdgeCounts) {
  EXPECT_EQ(counts_of("tri m 0 0 0  0 0 3  4 0 0", with_patch(1)), (Counts{5, 5, 3, 3}));
  EXPECT_EQ(counts_of("quad m 0 0 0  0 0 3  4 0 0  4 0 0", with_patch(1)), (Counts{5, 5, 3, 3}));
}

TEST(SceneCounts, AGridHasOnePatchACell) {
  const std::string grid = "grid m 3 2  0 0 0  1 0 0  9 0 0   0 0 4  1 0 4  9 0 4\n";
  EXPECT_EQ(counts_of(grid), (Counts{2, 1, 3, 3}));
  EXPECT_EQ(counts_of(grid, with_patch(0.01)), (Counts{2, 1, 3, 3}));
  EXPECT_EQ(counts_of(grid, with_refine(2.5)), (Counts{6, 3, 3, 3}));
  EXPECT_EQ(counts_of(grid, with_refine(0.1)), (Counts{2, 1, 3, 3}));
  // The longest cell: 8 along u, 4 along v.
  EXPECT_EQ(counts_of(grid, with_sub_patch(1)), (Counts{2, 1, 8, 4}));
}

TEST(SceneCounts, RefineMultipliesGivenAndFoundCounts) {
  const std::string quad = "quad m 0 0 0  6.5 0 0  6.5 0 4.5  0 0 4.5 patches 18 25 sub 2 2\n";
  EXPECT_EQ(counts_of(quad, with_refine(2)), (Counts{36, 50, 2, 2}));
  EXPECT_EQ(counts_of(quad, with_refine(0.5)), (Counts{9, 13, 2, 2}));  // 12.5 is rounded up
  EXPECT_EQ(counts_of(quad, with_refine(0.1)), (Counts{2, 3, 2, 2}));
  EXPECT_EQ(counts_of(quad, with_refine(1e-30)), (Counts{1, 1, 2, 2}));
  Options both = with_patch(1);
  both.refine = 3;
  EXPECT_EQ(counts_of(kFloor, both), (Counts{21, 15, 3, 3}));
}

TEST(SceneCounts, SubPatchesAreAThirdOfThePatchOrAsAsked) {
  const std::string quad = "quad m 0 0 0  6 0 0  6 0 4  0 0 4 patches 6 2\n";
  EXPECT_EQ(counts_of(quad), (Counts{6, 2, 3, 3}));
  EXPECT_EQ(counts_of(quad, with_sub_patch(0.5)), (Counts{6, 2, 2, 4}));
  EXPECT_EQ(counts_of(quad, with_sub_patch(0.1)), (Counts{6, 2, 10, 20}));
  EXPECT_EQ(counts_of(quad, with_sub_patch(7)), (Counts{6, 2, 1, 1}));
}

TEST(SceneCounts, NearLightsSubPatchesAreFinerUpToEight) {
  const std::string quad = "quad m 0 0 0  6 0 0  6 0 4  0 0 4 patches 3 4\n";  // patches of 2 x 1
  const auto lit = [&](const std::string& at) { return counts_of(quad + "light l point intensity 1 at " + at); };
  EXPECT_EQ(lit("4 2 1"), (Counts{3, 4, 3, 3}));     // at a distance of 2: at most 2/3
  EXPECT_EQ(lit("4 1.5 1"), (Counts{3, 4, 4, 3}));   // 1/2
  EXPECT_EQ(lit("2 1 3"), (Counts{3, 4, 6, 3}));     // 1/3
  EXPECT_EQ(lit("2 -0.6 3"), (Counts{3, 4, 8, 5}));  // 1/5, and 10 would be too many
  EXPECT_EQ(lit("4 -0.6 1"), (Counts{3, 4, 8, 5}));  // above the other half of the quad
  EXPECT_EQ(lit("3 0 2"), (Counts{3, 4, 8, 8}));     // on it
  EXPECT_EQ(lit("7.5 0 2"), (Counts{3, 4, 4, 3}));   // 1.5 beside each edge
  EXPECT_EQ(lit("-1.5 0 2"), (Counts{3, 4, 4, 3}));
  EXPECT_EQ(lit("3 0 -1.5"), (Counts{3, 4, 4, 3}));
  EXPECT_EQ(lit("3 0 5.5"), (Counts{3, 4, 4, 3}));
  EXPECT_EQ(lit("6.9 1.2 2"), (Counts{3, 4, 4, 3}));    // 1.5 from an edge, slanting
  EXPECT_EQ(lit("6.6 0.6 4.3"), (Counts{3, 4, 7, 4}));  // 0.9 from the corner: 0.3
  EXPECT_EQ(counts_of(quad + "light l sun towards 0 -1 0 illuminance 1"), (Counts{3, 4, 3, 3}));
  EXPECT_EQ(counts_of("quad m 0 0 0  6 0 0  6 0 4  0 0 4 patches 3 4 sub 2 1\nlight l point intensity 1 at 3 0 2"),
            (Counts{3, 4, 2, 1}));
}

TEST(SceneCounts, AreaAndPolyhedralLightsCountByTheirCentresAndNotForThemselves) {
  const std::string quad = "quad m 0 0 0  6 0 0  6 0 4  0 0 4 patches 3 4\n";
  EXPECT_EQ(counts_of(quad + "light l area luminance 1 quad 2.5 1 1.5  3.5 1 1.5  3.5 1 2.5  2.5 1 2.5"),
            (Counts{3, 4, 6, 3}));
  const std::string lamp =
      "object lamp\ntri m 3 1 0  2 1 3  4 1 3 patches 1\nlight l polyhedron object lamp luminance 1\n";
  EXPECT_EQ(counts_of(quad + lamp), (Counts{3, 4, 6, 3}));
  EXPECT_EQ(counts_of(quad + lamp, {}, 1), (Counts{1, 1, 3, 3}));
}

TEST(SceneCounts, DoNotDependOnTheOrderOfStatements) {
  const std::string light = "light l point at 3 1 2 intensity 1\n", object = "object p\n";
  const std::string a = "quad m 0 0 0  6 0 0  6 0 4  0 0 4\n", b = "tri m 0 0 1  3 0 0  0 0 9\n";
  const LoadedScene one(kStart + a + object + b + light), two(kStart + light + b + object + a);
  const Mesh &a1 = one.scene.meshes[0], &a2 = two.scene.meshes[1], &b1 = one.scene.meshes[1], &b2 = two.scene.meshes[0];
  EXPECT_TRUE(a1.nu == a2.nu && a1.nv == a2.nv && a1.su == a2.su && a1.sv == a2.sv);
  EXPECT_TRUE(b1.nu == b2.nu && b1.su == b2.su);
  for (std::uint32_t k = 0; k < 3; ++k) {
    EXPECT_EQ(one.scene.vertices[b1.first_vertex + k], two.scene.vertices[b2.first_vertex + k]);
  }
}

}  // namespace
}  // namespace shodo
