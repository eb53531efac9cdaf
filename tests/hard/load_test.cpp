// Loads: what is large finishes within a stated budget, or is refused before it starts with the need. The largest run
// with `make load` only (SHODO_HARD=all); tests run smaller ones of the same kind.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "shodo/shodo.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo::hard {
namespace {

/// A room of 6 n^2 patches.
std::string room(int n, const std::string& more = "") {
  SceneText scene;
  scene.material("white", 0.5);
  scene.object("room");
  scene.room({0, 0, 0}, {6, 5, 3}, n, 1);
  scene.point_light({2, 2, 2}, 100);
  scene.camera("eye", {1, 1, 1}, {6, 4, 1.5}, {0, 0, 1}, 90);
  return scene.text() + more;
}

/// From a budget that is too small to the smallest that works: refused before anything is lit, with the need; then it
/// finishes in exactly that.
void expect_need_told(const std::string& text, const Options& options) {
  FullRun little(text, options, std::size_t{64} << 10);
  ASSERT_EQ(little.status.code, StatusCode::kMemory);
  EXPECT_GT(little.status.bytes_needed, std::uint64_t{64} << 10);
  FullRun exact(text, options, little.status.bytes_needed);
  if (exact.status.code == StatusCode::kMemory) {  // loading told what loading needs, now the run tells what it needs
    const std::uint64_t needed = exact.status.bytes_needed;
    EXPECT_GT(needed, little.status.bytes_needed);
    FullRun again(text, options, needed);
    EXPECT_TRUE(again.done()) << again.status.message;
    EXPECT_LE(again.model().statistics.memory_peak, needed);
    EXPECT_TRUE(again.sound());
    return;
  }
  EXPECT_TRUE(exact.done()) << exact.status.message;
}

TEST(Load, ManyPatchesFinishInTheSmallestMemoryThatIsTold) {
  Options options = small_picture();
  options.rules.blocks = true;
  // 98,304 patches with blocks; 1,536 in tests.
  expect_need_told(room(thorough() ? 128 : 16), options);
}

TEST(Load, RowsOfMoreThan65535ColumnsAreReached) {
  // 73,728 patches, of which the first and the last exchange light: their columns lie 70,000 apart.
  if (!thorough()) GTEST_SKIP() << "make load";
  Options options;
  options.rules.blocks = true;
  FullRun run(room(111), options);
  ASSERT_TRUE(run.done()) << run.status.message;
  EXPECT_GT(run.patches(), 65536u);
  EXPECT_TRUE(run.sound());
  // The flux is kept: in a closed room of one reflectance the mean E is E0's over 1 - rho.
  double flux = 0, all = 0;
  for (std::uint32_t i = 0; i < run.patches(); ++i) {
    flux += run.model().patches[i].area * run.e0(i);
    all += run.model().patches[i].area * run.total(i);
  }
  EXPECT_NEAR(flux / (400 * M_PI), 1, 1e-3);
  // Blocks lose 0.6 % of it in a bare room (doc/rules.md); a lost column of blocks would be more.
  EXPECT_NEAR(all * 0.5 / flux, 1, 0.01);
}

TEST(Load, AGapOf70000DroppedColumnsIsStored) {
  // Plates at both ends of the file, and 70,000 patches between them that see neither.
  SceneText scene;
  scene.material("white", 0.5);
  scene.object("first");
  scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  scene.object("between");
  // In the first plate's plane and looking down: it sees nothing of either.
  scene.quad({2, 0, 0}, {2, 1, 0}, {3, 1, 0}, {3, 0, 0}, thorough() ? 350 : 40, thorough() ? 200 : 20);
  scene.object("last");
  scene.quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1});
  scene.point_light({0.5, 0.5, 0.5}, 100);
  const FullRun run(scene.text(), to_the_last_digits());
  ASSERT_TRUE(run.done()) << run.status.message;
  const std::uint32_t last = run.patches() - 1;
  // By symmetry both get rho F E of the other, F = 0.1998: E0 / (1 - rho F).
  EXPECT_NEAR(run.total(0), run.total(last), 1e-9 * run.total(0));
  EXPECT_NEAR(run.total(0), run.e0(0) / (1 - 0.5 * 0.1998248956983874), 1e-3 * run.total(0));
  EXPECT_EQ(run.sum(1, 2), 0);
}

TEST(Load, ManyLightsAddUp) {
  // 10,000 lamps of 1 cd; 400 in tests. The flux is theirs.
  const int side = thorough() ? 100 : 20;
  std::string lights;
  for (int k = 0; k < side * side; ++k) {
    lights += "light m" + std::to_string(k) + " point at " + number(0.5 + 5.0 * (k % side) / side) + " " +
              number(0.5 + 4.0 * (k / side) / side) + " " + number(1 + 0.001 * (k % 7)) + " intensity 1\n";
  }
  FullRun run(room(4, lights), small_picture());
  ASSERT_TRUE(run.done()) << run.status.message;
  EXPECT_TRUE(run.sound());
  double flux = 0;
  for (std::uint32_t i = 0; i < run.patches(); ++i) flux += run.model().patches[i].area * run.e0(i);
  EXPECT_NEAR(flux, 4 * M_PI * (100 + side * side), 0.01 * flux);
}

TEST(Load, AnImageOf4000By4000NeedsNoFrame) {
  const std::uint32_t size = thorough() ? 4000 : 1000;
  FullRun run(room(4), small_picture(size, size));
  ASSERT_TRUE(run.done());
  const std::uint64_t needed = smallest_memory(run.model());
  // Lines go out one by one: some bytes a column, not a pixel.
  EXPECT_LT(needed, std::uint64_t{400} * size + 200000);
  FullRun tight(room(4), small_picture(size, size), needed);
  const auto pixels = tight.picture();
  EXPECT_EQ(pixels.size(), std::size_t{3} * size * size);
  EXPECT_EQ(std::count(pixels.begin(), pixels.end(), 0), 0) << "a closed room: no pixel is black";
}

TEST(Load, ManyPolygonsBelowAPixelAreDrawn) {
  // 1e5 quads of a grid (10,000 in tests) far below a pixel; their picture is that of the sheet.
  const int cells = thorough() ? 316 : 100;
  const std::string side = std::to_string(cells + 1);
  std::string text = "shodo 1\nmaterial white diffuse 0.5\nobject sheet\ngrid white " + side + " " + side;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) text += " " + number(i / 256.0) + " " + number((cells - j) / 256.0) + " 0";
  }
  text +=
      "\nsub sheet 1 1\nlight l sun towards 0 0 -1 illuminance 1000\n"
      "camera eye eye 0.2 0.2 3 look 0.2 0.2 0 up 0.1 1 0 fov 50\n";
  Options options = small_picture(50, 50);
  options.rules.blocks = true;
  FullRun run(text, options);
  ASSERT_TRUE(run.done()) << run.status.message;
  const auto pixels = run.picture();
  ASSERT_FALSE(pixels.empty());
  // Two values: the sheet's and the dark around it.
  std::vector<std::uint8_t> values(pixels.begin(), pixels.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  EXPECT_EQ(values.size(), 2u);
  EXPECT_EQ(values[0], 0);
}

}  // namespace
}  // namespace shodo::hard
