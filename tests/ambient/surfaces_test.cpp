// Geometry of nodes that isn't kept: found again to the same bits, whatever was looked at in between.
#include "ambient/surfaces.h"

#include <cstring>
#include <random>

#include "ambient/ambient_scene.h"
#include "support/files.h"

namespace shodo {
namespace {

Options with_blocks(bool blocks) {
  Options options;
  options.rules.blocks = blocks;
  return options;
}

/// The scene gathered both ways.
struct Both {
  Both(const std::string& text, const Options& options) : scene(text, options) {
    if (scene.visible.size() > 3) scene.visible[3] = 0;  // a patch that takes no part
    const Scene& s = scene.loaded.scene;
    Arena& arena = scene.loaded.arena;
    arena.start_stage();
    std::size_t before = arena.used();
    EXPECT_TRUE(gather_surfaces(s, scene.geometry, scene.patches, scene.direct, options, arena, kept).done());
    EXPECT_EQ(arena.used() - before, surfaces_bytes(s, options, SurfacesKeep::kGeometry));
    before = arena.used();
    const SurfacesKeep nothing = SurfacesKeep::kNothing;
    EXPECT_TRUE(gather_surfaces(s, scene.geometry, {}, scene.direct, options, arena, found, nothing).done());
    EXPECT_EQ(arena.used() - before, surfaces_bytes(s, options, SurfacesKeep::kNothing));
  }

  void expect_same(std::uint32_t node) const {
    EXPECT_EQ(kept.is_block(node), found.is_block(node));
    EXPECT_EQ(kept.end(node), found.end(node));
    EXPECT_EQ(kept.mesh_index(node), found.mesh_index(node));
    EXPECT_EQ(kept.root_area[node], found.root_area[node]);
    EXPECT_EQ(std::memcmp(&kept.patch(node), &found.patch(node), sizeof(Patch)), 0) << node;
    EXPECT_EQ(std::memcmp(&kept.shape(node), &found.shape(node), sizeof(PatchShape)), 0) << node;
    const std::size_t bytes = kept.cached_points * sizeof(LatticePoint);
    EXPECT_EQ(std::memcmp(kept.samples(node), found.samples(node), bytes), 0) << node;
  }

  AmbientScene scene;
  Surfaces kept, found;
};

std::string scene_text(const std::string& name) {
  FolderReader files(source_folder() + "/tests/cli/scenes");
  std::string_view text;
  EXPECT_TRUE(files.read(name, text));
  return std::string(text);
}

TEST(Surfaces, WhatIsFoundAgainIsWhatIsKept) {
  for (const std::string name : {"sun.scn", "box.scn", "shapes.scn"}) {
    for (const bool blocks : {false, true}) {
      const Both both(scene_text(name), with_blocks(blocks));
      ASSERT_EQ(both.kept.size(), both.found.size());
      EXPECT_EQ(both.kept.blocks.empty(), both.found.blocks.empty());
      for (std::uint32_t node = 0; node < both.kept.size(); ++node) both.expect_same(node);
      std::mt19937 random(5);
      for (int k = 0; k < 2000; ++k) both.expect_same(static_cast<std::uint32_t>(random() % both.kept.size()));
      EXPECT_EQ(both.kept.mesh_box.size(), blocks ? 0 : both.kept.mesh_at.size());
      ASSERT_EQ(both.kept.mesh_box.size(), both.found.mesh_box.size());
      for (std::size_t m = 0; m < both.kept.mesh_at.size(); ++m) {
        EXPECT_EQ(both.kept.mesh_at[m], both.found.mesh_at[m]);
        EXPECT_EQ(both.kept.planar[m], both.found.planar[m]);
      }
      EXPECT_EQ(std::memcmp(both.kept.mesh_box.data(), both.found.mesh_box.data(), both.kept.mesh_box.size_bytes()), 0);
    }
  }
}

TEST(Surfaces, AReferenceIsGoodUntilSoManyOthersWereLookedAt) {
  const Both both(scene_text("box.scn"), with_blocks(true));
  ASSERT_GT(both.found.size(), 2 * kFoundNodes);
  for (std::uint32_t first = 0; first + kFoundNodes < both.found.size(); ++first) {
    const Patch& patch = both.found.patch(first);
    for (std::uint32_t k = 1; k < kFoundNodes; ++k) both.found.patch(first + k);
    EXPECT_EQ(std::memcmp(&patch, &both.kept.patch(first), sizeof(Patch)), 0) << first;
  }
}

TEST(Surfaces, ARowsSideOfItsOwnStaysGood) {
  const Both both(scene_text("box.scn"), with_blocks(true));
  NodeGeometry own;
  const RowSide side = row_side(both.found, 7, own);
  for (std::uint32_t node = 8; node < 80; ++node) both.found.patch(node);
  EXPECT_EQ(std::memcmp(side.patch, &both.kept.patch(7), sizeof(Patch)), 0);
  EXPECT_EQ(std::memcmp(side.shape, &both.kept.shape(7), sizeof(PatchShape)), 0);
}

}  // namespace
}  // namespace shodo
