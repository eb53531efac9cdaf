// The lists of nodes that blocks leave to their parts.
#include "ambient/link_walk.h"

#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

using Step = LinkWalk::Step;

/// Two unit squares that face each other, the first of 2 patches.
std::string two_walls(int nu, int nv) {
  return "object first\nquad white 0 0 0 0 0 1 1 0 1 1 0 0 patches 2 1 sub 1 1\n"
         "object second\nquad white 0 1 0 1 1 0 1 1 1 0 1 1 patches " +
         std::to_string(nu) + " " + std::to_string(nv) + " sub 1 1\n";
}

/// Of two walls with one block each, the first wall's block leaves every patch of the second to its own.
void expect_all_left(int nu, int nv) {
  Options options;
  options.rules.rule3 = true;
  AmbientScene scene(grey(0.5) + two_walls(nu, nv), options);
  Surfaces surfaces = surfaces_of(scene);
  Sparsity sparsity;
  LinkWalk walk;
  Arena& arena = scene.loaded.arena;
  ASSERT_TRUE(sparsity.take(arena, surfaces, scene.direct, options.rules).done());
  const std::size_t before = arena.used();
  ASSERT_TRUE(walk.take(arena, surfaces, sparsity, options).done());
  EXPECT_EQ(arena.used() - before, LinkWalk::bytes(scene.loaded.scene, options));
  const std::uint32_t other = surfaces.mesh_begin[1], size = surfaces.size();
  ASSERT_EQ(other, 3u);
  std::uint32_t expected = other + 1, judged = 0;
  const auto judge = [&](const RowSide& side, std::uint32_t b) {
    ++judged;
    if (surfaces.is_block(b)) return Step::kSplitSecond;
    return surfaces.is_block(side.position) ? Step::kSplitFirst : Step::kLink;
  };
  walk.visit(row_side(surfaces, 1), judge, [&](std::uint32_t b) { EXPECT_EQ(b, expected++); });
  EXPECT_EQ(expected, size);
  EXPECT_EQ(judged, 1 + 2 * (size - other - 1));
}

TEST(LinkWalk, APartGetsEveryNodeThatItsBlockLeaves) { expect_all_left(5, 4); }

TEST(LinkWalk, APartGetsEveryNodeThatItsBlockLeavesBeyond65536Too) { expect_all_left(300, 240); }

}  // namespace
}  // namespace shodo
