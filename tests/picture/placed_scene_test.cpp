// Scenes of the file format, placed on the lattice, against the picture's twin at every sample.
#include <gtest/gtest.h>

#include <string>

#include "picture/view.h"
#include "support/scene_from_text.h"
#include "support/seen_row.h"
#include "visibility/geometry.h"

namespace shodo {
namespace {

/// Number of samples that see something.
std::uint64_t expect_twin(const std::string& text, std::uint32_t width, std::uint32_t height,
                          std::uint32_t antialias = 1) {
  LoadedScene loaded("shodo 1\nmaterial white diffuse 0.5\n" + text);
  Geometry geometry;
  EXPECT_TRUE(place_scene(loaded.scene, loaded.arena, geometry).done());
  std::uint64_t covered = 0;
  for (const Camera& camera : loaded.scene.cameras) {
    SCOPED_TRACE(std::string(camera.name));
    const SampleGrid grid = sample_grid(view_of(camera, geometry.lattice, width, height), width, height, antialias);
    const PictureTwin twin(loaded.scene, geometry, grid);
    VisibleLines lines;
    EXPECT_TRUE(lines.start(loaded.scene, geometry, grid, loaded.arena));
    std::uint64_t wrong = 0;
    for (std::uint32_t y = 0; y < grid.rows; ++y) {
      const std::vector<TwinHit> seen = seen_row(lines, grid, y);
      for (std::uint32_t x = 0; x < grid.columns; ++x) {
        covered += seen[x].triangle != kNone ? 1 : 0;
        wrong += seen[x] == twin.hit(x, y) ? 0 : 1;
      }
    }
    EXPECT_EQ(wrong, 0u);
  }
  return covered;
}

const char* const kRoom =
    "object room\n"
    "quad white 0 0 0  0 0 4.5  6.5 0 4.5  6.5 0 0\n"
    "quad white 0 2.5 0  6.5 2.5 0  6.5 2.5 4.5  0 2.5 4.5\n"
    "quad white 0 0 0  6.5 0 0  6.5 2.5 0  0 2.5 0\n"
    "quad white 6.5 0 4.5  0 0 4.5  0 2.5 4.5  6.5 2.5 4.5\n"
    "quad white 0 0 4.5  0 0 0  0 2.5 0  0 2.5 4.5\n"
    "quad white 6.5 0 0  6.5 0 4.5  6.5 2.5 4.5  6.5 2.5 0\n";

// Every sample inside a closed room sees something: no gap, not even in the corners.
TEST(PlacedScene, AClosedRoomHasNoGaps) {
  const std::string cameras =
      "camera a eye 0.6 1.5 0.6 look 5 1 3.2 up 0 1 0 fov 65\n"
      "camera b eye 6.4 0.1 4.4 look 0 2 0 up 0 1 0 fov 110\n"
      "camera c eye 3 1 2 look 3 0 2.001 up 0 0 1 fov 150\n"
      "camera d eye 3.1 1.234 0.001 look 6.5 2.5 0.0005 up 0 1 0 fov 80\n";
  EXPECT_EQ(expect_twin(cameras + kRoom, 131, 97), 4u * 131 * 97);
}

TEST(PlacedScene, EyesOnSurfacesAndOutsideEqualTheTwin) {
  const std::string cameras =
      "camera floor eye 3 0 2 look 5 1 3.2 up 0 1 0 fov 65\n"
      "camera edge eye 3 0 0 look 5 1 3.2 up 0 1 0 fov 65\n"
      "camera corner eye 0 0 0 look 5 1 3.2 up 0 1 0 fov 65\n"
      "camera outside eye -9 5 -7 look 3 1 2 up 0 1 0 fov 40\n"
      "camera plane eye -9 2.5 -7 look 3 2.5 2 up 0 1 0 fov 40\n";
  EXPECT_GT(expect_twin(cameras + kRoom, 101, 77), 4000u);
}

TEST(PlacedScene, SaddlesConcaveQuadsAndGridsEqualTheTwin) {
  const std::string text =
      "camera a eye 4 5 7 look 1 0.5 1 up 0 1 0 fov 50\n"
      "camera b eye 1 0.4 6 look 1 0.5 1 up 0 1 0 fov 30\n"
      "object saddle\n"
      "quad white 0 0 0  0 1 2  2 0 2  2 1 0 patches 7 5\n"
      "object dart\n"
      "quad white -3 0 0  -2 0 2  -1 0 0  -2 0 0.7 patches 4 4\n"
      "quad white -3 2 0  -2.2 2 0.7  -1 2 0  -2 2 2\n"
      "object leaf\n"
      "grid white 3 3  3 0 0  4 0.3 0  5 0 0   3 0.5 1  4 1 1  5 0.5 1   3 0 2  4 0.2 2  5 0.1 2\n"
      "object flat\n"
      "tri white -1 -0.5 -1  -1 -0.5 4  6 -0.5 -1 patches 4\n";
  EXPECT_GT(expect_twin(text, 120, 90, 4), 5000u);
}

TEST(PlacedScene, TJunctionsAndPartitionsLeaveNoGaps) {
  std::string text = "camera a eye 2 3 9 look 2.5 0.9 0 up 0.1 1 0 fov 30\nobject wall\n";
  // Strips of 3, 5 and 7 cells one over the other.
  int row = 0;
  for (const int cells : {3, 5, 7}) {
    for (int k = 0; k < cells; ++k) {
      const std::string x0 = std::to_string(5.0 * k / cells), x1 = std::to_string(5.0 * (k + 1) / cells);
      const std::string y0 = std::to_string(row), y1 = std::to_string(row + 1);
      text += "quad white " + x0 + ' ' + y0 + " 0 " + x1 + ' ' + y0 + " 0 " + x1 + ' ' + y1 + " 0 " + x0 + ' ' + y1 +
              " 0\n";
    }
    ++row;
  }
  const std::string backdrop = "object back\nquad white -20 -20 -0.5  20 -20 -0.5  20 20 -0.5  -20 20 -0.5\n";
  const std::uint64_t alone = expect_twin(text, 140, 100);
  EXPECT_GT(alone, 3000u);
  EXPECT_EQ(expect_twin(text + backdrop, 140, 100), 140u * 100);
}

}  // namespace
}  // namespace shodo
