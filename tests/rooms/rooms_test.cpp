// The paper's two rooms, as the table of paper 3.3 has them.
#include <gtest/gtest.h>

#include <vector>

#include "picture/view.h"
#include "picture/visible_lines.h"
#include "scene/scene_file.h"
#include "support/files.h"
#include "support/picture_twin.h"
#include "visibility/geometry.h"

namespace shodo {
namespace {

struct Room {
  FolderReader files{source_folder() + "/data"};
  std::vector<std::uint64_t> memory = std::vector<std::uint64_t>(1 << 20);
  Arena arena{memory.data(), memory.size() * sizeof(memory[0])};
  Scene scene;

  explicit Room(std::string_view name) {
    std::string_view text;
    EXPECT_TRUE(files.read(name, text));
    const Status status = load_scene(name, text, files.reader(), Options{}, arena, scene);
    EXPECT_TRUE(status.done()) << status.file << ":" << status.line << ":" << status.column << ": " << status.message;
  }

  int kinds_of_light() const {
    bool seen[4] = {};
    for (const Light& light : scene.lights) seen[static_cast<int>(light.kind)] = true;
    return seen[0] + seen[1] + seen[2] + seen[3];
  }
};

TEST(Rooms, TheDayHasThePapersPatchesAndSubPatches) {
  const Room day("day.scn");
  EXPECT_EQ(day.scene.patch_count, 1526u);
  EXPECT_EQ(day.scene.sub_patch_count, 8006u);
}

TEST(Rooms, TheEveningHasThePapersPatchesAndSubPatches) {
  const Room evening("evening.scn");
  EXPECT_EQ(evening.scene.patch_count, 1526u);
  EXPECT_EQ(evening.scene.sub_patch_count, 10086u);
}

TEST(Rooms, TheEveningHasSevenLampsOfThreeKinds) {
  const Room evening("evening.scn");
  EXPECT_EQ(evening.scene.lights.size(), 7u);
  EXPECT_GE(evening.kinds_of_light(), 3);
}

TEST(Rooms, BothRoomsAreTheSameRoom) {
  const Room day("day.scn"), evening("evening.scn");
  ASSERT_EQ(day.scene.meshes.size(), evening.scene.meshes.size());
  for (std::size_t m = 0; m < day.scene.meshes.size(); ++m) {
    EXPECT_EQ(day.scene.meshes[m].patch_count(), evening.scene.meshes[m].patch_count()) << "mesh " << m;
  }
}

/// Pixels of a room's picture, 1280 x 1024 with one sample each, at which scanlines and twin don't see the same.
std::uint64_t pixels_apart(Room& room, std::uint32_t& seen_pixels) {
  Geometry geometry;
  EXPECT_TRUE(place_scene(room.scene, room.arena, geometry).done());
  const SampleGrid grid = sample_grid(view_of(room.scene.cameras[0], geometry.lattice, 1280, 1024), 1280, 1024, 1);
  VisibleLines lines;
  EXPECT_TRUE(lines.start(room.scene, geometry, grid, room.arena));
  const PictureTwin twin(room.scene, geometry, grid);
  std::uint64_t apart = 0;
  for (std::uint32_t y = 0; y < grid.rows; ++y) {
    std::vector<TwinHit> row(grid.columns);
    lines.begin_row(y);
    for (VisibleSpan span; lines.next(span);) {
      for (std::int32_t x = span.x0; x < span.x1; ++x) row[static_cast<std::size_t>(x)] = {span.triangle, span.front};
    }
    for (std::uint32_t x = 0; x < grid.columns; ++x) {
      if (row[x] != twin.hit(x, y)) ++apart;
      if (row[x].triangle != kNone) ++seen_pixels;
    }
  }
  return apart;
}

TEST(Rooms, EveryPixelOfTheDaySeesTheSurfaceThatTheTwinsSegmentMeets) {
  Room day("day.scn");
  std::uint32_t seen = 0;
  EXPECT_EQ(pixels_apart(day, seen), 0u);
  EXPECT_EQ(seen, 1280u * 1024u);  // the room is closed, and sky and garden fill the window
}

TEST(Rooms, EveryPixelOfTheEveningSeesTheSurfaceThatTheTwinsSegmentMeets) {
  Room evening("evening.scn");
  std::uint32_t seen = 0;
  EXPECT_EQ(pixels_apart(evening, seen), 0u);
  EXPECT_GT(seen, 1280u * 1024u * 4 / 5);  // the window is open to the night
}

TEST(Rooms, NoFaceIsDropped) {
  EXPECT_EQ(Room("day.scn").scene.polygons_dropped, 0u);
}

}  // namespace
}  // namespace shodo
