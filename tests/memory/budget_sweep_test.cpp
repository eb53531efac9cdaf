// Less memory costs time, never pixels: budgets in steps of 1 %, from below the smallest to twice the default.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "shodo/shodo.h"
#include "support/collected_lines.h"
#include "support/files.h"

namespace shodo {
namespace {

constexpr std::uint64_t kTwiceTheDefault = 16 << 20;

struct Sweep {
  Sweep(const std::string& name, const Rules& asked) : scene(name), rules(asked) {}

  std::string scene;
  Rules rules;
  bool gather = false, mirror_light = false;
  std::uint32_t refused = 0, done = 0, lit_again = 0, placed_again = 0, geometry_again = 0, rows_recomputed = 0;

  /// The picture, or nothing if the budget is refused, as it must be before anything is lit.
  std::optional<std::vector<std::uint8_t>> run(std::uint64_t bytes, std::uint64_t& smallest) {
    FolderReader files(source_folder() + "/tests/cli/scenes");
    std::string_view text;
    EXPECT_TRUE(files.read(scene, text));
    Options options;
    options.rules = rules;
    options.gather = gather;
    options.mirror_light = mirror_light;
    options.gather_lines = 4;
    options.width = 32;
    options.height = 24;
    options.segments_first = 1;  // hundreds of runs
    options.segments_mixed = 16;
    Model* model = nullptr;
    Status status = load(scene, text, files.reader(), options, memory_.data(), bytes, model);
    if (status.done()) {
      smallest = smallest_memory(*model);
      EXPECT_EQ(bytes < smallest_memory(*model, false), !(status = solve(*model, {})).done()) << bytes;
      EXPECT_TRUE(status.done() || statistics(*model).segments_direct == 0);
    }
    std::vector<std::uint8_t> picture;
    const LineSink sink = collected_in(picture);
    if (status.done()) status = draw(*model, {}, sink);
    if (!status.done()) {
      EXPECT_EQ(status.code, StatusCode::kMemory);
      EXPECT_TRUE(picture.empty());
      EXPECT_GT(status.bytes_needed, bytes);
      ++refused;
      return {};
    }
    const Statistics& counted = statistics(*model);
    EXPECT_LE(counted.memory_peak, bytes);
    lit_again += counted.lit_again;
    placed_again += counted.placed_again;
    geometry_again += counted.geometry_again;
    rows_recomputed += counted.rows_recomputed > 0 ? 1 : 0;
    ++done;
    return picture;
  }

 private:
  std::vector<std::uint64_t> memory_ = std::vector<std::uint64_t>(kTwiceTheDefault / 8 + 64 * 1024);
};

/// `step`: of the budget, in parts of it; from `percent_below` the smallest budget on.
void sweep(Sweep& sweep, std::uint64_t step, std::uint64_t percent_below = 10) {
  std::uint64_t smallest = 0, none = 0;
  const auto expected = sweep.run(kTwiceTheDefault, smallest);
  ASSERT_TRUE(expected.has_value());
  sweep.done = 0;
  const std::uint64_t first = smallest - smallest * percent_below / 100;
  for (std::uint64_t bytes = first; bytes <= kTwiceTheDefault; bytes += bytes / step) {
    const auto picture = sweep.run(bytes, none);
    ASSERT_EQ(picture.has_value(), bytes >= smallest) << bytes << " of " << smallest;
    ASSERT_TRUE(!picture.has_value() || *picture == *expected) << bytes << " bytes";
  }
  EXPECT_TRUE(sweep.run(smallest, none).has_value());
  EXPECT_FALSE(sweep.run(smallest - 1, none).has_value());
  EXPECT_GT(sweep.refused, step / 12);
  EXPECT_GT(sweep.done, 3 * step);
}

/// The sweep has passed through everything that a small budget does.
void expect_scarcity(const Sweep& sweep) {
  EXPECT_GT(sweep.lit_again, 0u);
  EXPECT_GT(sweep.placed_again, 0u);
  EXPECT_TRUE(sweep.geometry_again > 0 || !sweep.rules.blocks);
  // In a small scene a gather needs more memory than all rows.
  EXPECT_TRUE(sweep.rows_recomputed > 0 || sweep.gather);
  EXPECT_LT(sweep.rows_recomputed, sweep.done);
}

TEST(BudgetSweep, EveryBudgetGivesTheSameBytesOrIsRefused) {
  Sweep box("box.scn", {});
  sweep(box, 100);
  expect_scarcity(box);
}

TEST(BudgetSweep, EveryBudgetGivesTheSameBytesWithBlocksToo) {
  Sweep shapes("shapes.scn", {.blocks = true});
  sweep(shapes, 100);
  expect_scarcity(shapes);
}

TEST(BudgetSweep, EveryBudgetGivesTheSameBytesWhereSubPatchesGather) {
  Sweep shapes("shapes.scn", {.blocks = true});
  shapes.gather = true;
  sweep(shapes, 20);
  expect_scarcity(shapes);
}

TEST(BudgetSweep, EveryBudgetGivesTheSameBytesWhenColumnsComeBack) {
  Sweep box("box.scn", {.rule2_repeated = true});
  sweep(box, 20);
  expect_scarcity(box);
}

// Here the picture needs more than all rows, so that few budgets are scarce for light.

TEST(BudgetSweep, EveryBudgetGivesTheSameBytesWithTextures) {
  Sweep textures("textures.scn", {.blocks = true});
  sweep(textures, 20);
}

TEST(BudgetSweep, EveryBudgetGivesTheSameBytesWithPanesMirrorsAndHighlights) {
  Sweep glass("glass.scn", {.blocks = true});
  sweep(glass, 20);
}

TEST(BudgetSweep, EveryBudgetGivesTheSameBytesWithLightOverMirrors) {
  Sweep glass("glass.scn", {});
  glass.mirror_light = true;
  sweep(glass, 10, 60);  // light alone needs much less than the picture
}

}  // namespace
}  // namespace shodo
