// The library as its callers see it: shodo.h alone, in memory of any size and alignment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "shodo/shodo.h"
#include "support/collected_lines.h"
#include "support/files.h"

namespace shodo {
namespace {

const char* const kScenes[] = {"sun.scn", "box.scn", "shapes.scn", "glass.scn"};

/// One scene in one piece of memory.
class Pipeline {
 public:
  Pipeline(const std::string& name, std::size_t bytes, std::size_t skew = 0) : memory_(bytes + 64), bytes_(bytes) {
    // Beyond the memory stands a pattern that must stay.
    std::memset(memory_.data(), 0x5a, memory_.size());
    start_ = memory_.data() + (16 - reinterpret_cast<std::uintptr_t>(memory_.data()) % 16) + skew;
    options_.width = 40;
    options_.height = 30;
    EXPECT_TRUE(files_.read(name, text_));
    loaded_ = load(name, text_, files_.reader(), options_, start_, bytes, model_);
  }
  ~Pipeline() {
    for (unsigned char* p = start_ + bytes_; p != memory_.data() + memory_.size(); ++p) EXPECT_EQ(*p, 0x5a);
  }

  const Status& loaded() const { return loaded_; }
  Model& model() { return *model_; }

  /// The picture after solve and draw, or nothing.
  std::optional<std::vector<std::uint8_t>> picture() {
    if (!loaded_.done() || !solve(*model_, {}).done()) return {};
    return drawn();
  }

  std::optional<std::vector<std::uint8_t>> drawn() {
    std::vector<std::uint8_t> pixels;
    const LineSink sink = collected_in(pixels);
    if (!draw(*model_, {}, sink).done()) return {};
    return pixels;
  }

 private:
  std::vector<unsigned char> memory_;
  std::size_t bytes_;
  unsigned char* start_ = nullptr;
  FolderReader files_{source_folder() + "/tests/cli/scenes"};
  std::string_view text_;
  Options options_;
  Status loaded_;
  Model* model_ = nullptr;
};

constexpr std::size_t kPlenty = 4 << 20;

TEST(Pipeline, RunsInExactlyTheSmallestMemoryAtAnyAlignment) {
  for (const std::string name : kScenes) {
    Pipeline roomy(name, kPlenty);
    ASSERT_TRUE(roomy.loaded().done()) << roomy.loaded().message;
    const auto expected = roomy.picture();
    ASSERT_TRUE(expected.has_value());
    const std::uint64_t smallest = smallest_memory(roomy.model());
    EXPECT_LE(smallest_memory(roomy.model(), false), smallest);
    for (const std::size_t skew : std::initializer_list<std::size_t>{0, 1, 4, 7}) {
      // Up to 7 bytes go to alignment, and smallest_memory() then counts them.
      const std::size_t bytes = smallest + (8 - skew) % 8;
      Pipeline tight(name, bytes, skew);
      ASSERT_TRUE(tight.loaded().done()) << tight.loaded().message;
      EXPECT_EQ(smallest_memory(tight.model()), bytes) << "skew " << skew;
      EXPECT_TRUE(tight.picture() == expected) << name << ", skew " << skew;
      EXPECT_LE(statistics(tight.model()).memory_peak, bytes);
    }
  }
}

TEST(Pipeline, RefusesAByteLessBeforeAnythingIsLit) {
  for (const std::string name : kScenes) {
    Pipeline roomy(name, kPlenty);
    const std::uint64_t to_solve = smallest_memory(roomy.model(), false), to_draw = smallest_memory(roomy.model());
    Pipeline less(name, to_solve - 1);
    if (less.loaded().done()) {
      const Status status = solve(less.model(), {});
      EXPECT_EQ(status.code, StatusCode::kMemory);
      EXPECT_EQ(status.bytes_needed, to_solve);
      EXPECT_EQ(statistics(less.model()).segments_direct, 0u);
    } else {
      EXPECT_EQ(less.loaded().code, StatusCode::kMemory);
    }
    if (to_draw == to_solve) continue;
    Pipeline undrawn(name, to_draw - 1);
    ASSERT_TRUE(undrawn.loaded().done() && solve(undrawn.model(), {}).done());
    EXPECT_FALSE(undrawn.drawn().has_value());
  }
}

TEST(Pipeline, LessMemoryCostsTimeAndNeverPixels) {
  Pipeline roomy("box.scn", kPlenty);
  const auto expected = roomy.picture();
  EXPECT_EQ(statistics(roomy.model()).rows_recomputed, 0u);
  const std::uint64_t smallest = smallest_memory(roomy.model());
  std::uint32_t before[2] = {0xffffffff, 0xffffffff};  // geometry kept, and not
  std::uint32_t last = 0;
  for (std::uint64_t bytes = smallest; bytes < smallest + 40 * 1024; bytes += 1777) {
    Pipeline some("box.scn", bytes);
    EXPECT_TRUE(some.picture() == expected) << bytes << " bytes";
    EXPECT_TRUE(some.picture() == expected) << bytes << " bytes, once more";
    const Statistics& counted = statistics(some.model());
    EXPECT_LE(counted.rows_recomputed, before[counted.geometry_again]) << "more memory keeps more rows";
    last = before[counted.geometry_again] = counted.rows_recomputed;
  }
  EXPECT_LT(before[1], 0xffffffff) << "the smallest doesn't keep the patches' geometry";
  EXPECT_EQ(last, 0u) << "40 KiB more keep all rows of 88 patches";
}

TEST(Pipeline, WithTheSmallestMemorySubPatchesAreLitAndTrianglesPlacedOnceMore) {
  for (const std::string name : kScenes) {
    Pipeline roomy(name, kPlenty);
    ASSERT_TRUE(roomy.picture().has_value());
    EXPECT_EQ(statistics(roomy.model()).lit_again + statistics(roomy.model()).placed_again, 0u);
    Pipeline tight(name, smallest_memory(roomy.model()));
    ASSERT_TRUE(tight.picture().has_value());
    const bool needs_most_for_the_picture = name == "sun.scn" || name == "glass.scn";
    EXPECT_EQ(statistics(tight.model()).lit_again + statistics(tight.model()).placed_again,
              needs_most_for_the_picture ? 0u : 2u)
        << name;
    EXPECT_EQ(statistics(tight.model()).segments_direct, statistics(roomy.model()).segments_direct)
        << "what is done once more is not counted";
  }
}

TEST(Pipeline, PeaksOfTheStagesAreWithinThePlansAndTheLargestIsThePeak) {
  for (const std::string name : kScenes) {
    Pipeline roomy(name, kPlenty);
    Pipeline tight(name, smallest_memory(roomy.model()));
    ASSERT_TRUE(tight.picture().has_value());
    const Statistics& counted = statistics(tight.model());
    std::uint64_t most = 0;
    for (const std::uint64_t bytes : counted.stage_peak) {
      EXPECT_GT(bytes, 0u);
      most = std::max(most, bytes);
    }
    EXPECT_EQ(most, counted.memory_peak);
    EXPECT_LE(most, smallest_memory(roomy.model()));
  }
}

TEST(Pipeline, ALoadThatIsRefusedSaysHowManyBytesItWantedAndWritesNowhereElse) {
  std::uint64_t bytes = 1;
  for (int tries = 0; tries < 100; ++tries) {
    const Pipeline pipeline("shapes.scn", bytes);
    if (pipeline.loaded().done()) {
      EXPECT_GT(tries, 1);
      return;
    }
    ASSERT_EQ(pipeline.loaded().code, StatusCode::kMemory) << pipeline.loaded().message;
    ASSERT_GT(pipeline.loaded().bytes_needed, bytes);
    bytes = pipeline.loaded().bytes_needed;
  }
  ADD_FAILURE() << "what it wants never suffices";
}

TEST(Pipeline, SolvingTwiceGivesTheSameAndCountsOnce) {
  Pipeline pipeline("shapes.scn", kPlenty);
  const auto first = pipeline.picture();
  const Statistics counted = statistics(pipeline.model());
  EXPECT_TRUE(pipeline.picture() == first);
  EXPECT_TRUE(pipeline.drawn() == first) << "drawing again";
  const Statistics& again = statistics(pipeline.model());
  EXPECT_EQ(again.tests_direct, counted.tests_direct);
  EXPECT_EQ(again.tests_ambient, counted.tests_ambient);
  EXPECT_EQ(again.form_factors_computed, counted.form_factors_computed);
  EXPECT_EQ(again.nonzeros, counted.nonzeros);
  EXPECT_EQ(again.patches_thin, counted.patches_thin);
}

/// Where memory is short the picture takes that of the patches, and the light takes it back.
TEST(Pipeline, SolvingAndDrawingAgainInTheSmallestMemoryGivesTheSame) {
  for (const std::string name : kScenes) {
    Pipeline roomy(name, kPlenty);
    const auto expected = roomy.picture();
    Pipeline tight(name, smallest_memory(roomy.model()));
    EXPECT_TRUE(tight.picture() == expected) << name;
    EXPECT_TRUE(tight.drawn() == expected) << name << ", drawn again";
    EXPECT_TRUE(tight.picture() == expected) << name << ", solved again";
    int calls = 5;
    const Progress stop{[](void* left, Stage, std::uint64_t, std::uint64_t) { return --*static_cast<int*>(left) > 0; },
                        &calls};
    EXPECT_EQ(solve(tight.model(), stop).code, StatusCode::kInterrupted);
    EXPECT_TRUE(tight.picture() == expected) << name << ", after an interrupt";
  }
}

TEST(Pipeline, DrawingNeedsASolvedModel) {
  Pipeline pipeline("sun.scn", kPlenty);
  EXPECT_EQ(draw(pipeline.model(), {}, {}).code, StatusCode::kUsage);
}

TEST(Pipeline, StopsWhereverProgressSaysSoAndCanStartAgain) {
  struct Countdown {
    int left = 0;
    bool seen[kStageCount] = {};
  };
  const auto tick = [](void* context, Stage stage, std::uint64_t, std::uint64_t) {
    Countdown& countdown = *static_cast<Countdown*>(context);
    countdown.seen[static_cast<std::size_t>(stage)] = true;
    return countdown.left-- > 0;
  };
  Pipeline pipeline("box.scn", kPlenty);
  const auto expected = pipeline.picture();
  int calls = 0;
  for (;; calls += 1 + calls / 8) {
    Countdown countdown{calls};
    const Progress progress{tick, &countdown};
    const Status status = solve(pipeline.model(), progress);
    if (status.done()) {
      for (const Stage stage : {Stage::kDirect, Stage::kFormFactors, Stage::kSolution, Stage::kMap}) {
        EXPECT_TRUE(countdown.seen[static_cast<std::size_t>(stage)]) << stage_name(stage);
      }
      break;
    }
    ASSERT_EQ(status.code, StatusCode::kInterrupted);
    EXPECT_EQ(draw(pipeline.model(), {}, {}).code, StatusCode::kUsage) << "half a solution is none";
  }
  EXPECT_GT(calls, 100) << "88 patches twice";
  Countdown countdown{10};
  EXPECT_EQ(draw(pipeline.model(), Progress{tick, &countdown}, {}).code, StatusCode::kInterrupted);
  EXPECT_TRUE(countdown.seen[static_cast<std::size_t>(Stage::kPicture)]);
  EXPECT_TRUE(pipeline.drawn() == expected);
}

TEST(Pipeline, EveryStageHasItsNameInTheStatistics) {
  std::string names;
  for (std::uint32_t k = 0; k < kStageCount; ++k) names += std::string(stage_name(static_cast<Stage>(k))) + " ";
  EXPECT_EQ(names, "load direct form_factors solution map picture ");
}

}  // namespace
}  // namespace shodo
