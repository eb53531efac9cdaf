// Every block of the arena refused in turn, once and from then on: the documented status, a message, and nothing that
// is half done. What was refused once works when it is asked for again.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "shodo/shodo.h"
#include "support/arena_hook.h"
#include "support/collected_lines.h"
#include "support/files.h"

namespace shodo {
namespace {

struct Case {
  std::string scene;
  Rules rules;
  FlagMode flags = FlagMode::kAuto;
  bool gather = false;
};

std::vector<Case> cases() {
  Rules none, paper, repeated, blocks;
  paper.rule1 = paper.rule2 = paper.rule3 = true;
  repeated.rule2_repeated = true;
  blocks.blocks = true;
  return {{"sun.scn", none},   {"box.scn", none},      {"shapes.scn", none}, {"shapes.scn", none, FlagMode::kOff},
          {"box.scn", paper},  {"box.scn", repeated},  {"shapes.scn", blocks},
          {"shapes.scn", blocks, FlagMode::kOff, true}, {"textures.scn", none}, {"glass.scn", none},
          {"model.scn", none}};
}

/// Load, solve and draw in memory that ends where it says.
struct Attempt {
  explicit Attempt(const Case& c) : memory(kBytes / 8), files(source_folder() + "/tests/cli/scenes") {
    EXPECT_TRUE(files.read(c.scene, text));
    options.rules = c.rules;
    options.flags = c.flags;
    options.gather = c.gather;
    options.gather_lines = 4;
    options.width = 16;
    options.height = 12;
    options.antialias = 1;
    options.refine = 0.5;  // few patches and segments: there are hundreds of runs
    options.segments_first = 1;
    options.segments_mixed = 1;
    name = c.scene;
  }

  Status load() {
    model = nullptr;
    return shodo::load(name, text, files.reader(), options, memory.data(), kBytes, model);
  }
  Status draw() {
    picture.clear();
    const LineSink sink = collected_in(picture);
    return shodo::draw(*model, {}, sink);
  }
  Status all() {
    Status status = load();
    if (status.done()) status = solve(*model, {});
    if (status.done()) status = draw();
    return status;
  }

  static constexpr std::size_t kBytes = 1 << 20;
  std::vector<std::uint64_t> memory;
  FolderReader files;
  std::string_view text;
  std::string name;
  Options options;
  Model* model = nullptr;
  std::vector<std::uint8_t> picture;
};

void expect_refusal(const Status& status) {
  EXPECT_EQ(status.code, StatusCode::kMemory) << status.message;
  EXPECT_NE(status.message[0], '\0');
  EXPECT_EQ(status.line, 0u) << "no place in the scene is at fault";
}

std::uint64_t blocks_of(const Case& c, std::vector<std::uint8_t>& picture) {
  Attempt attempt(c);
  ArenaHook hook;
  EXPECT_TRUE(attempt.all().done());
  picture = attempt.picture;
  return hook.taken();
}

TEST(ArenaFaults, ABlockRefusedOnceIsStatus4OrChangesNoPixelAndTheNextCallWorks) {
  for (const Case& c : cases()) {
    std::vector<std::uint8_t> expected;
    const std::uint64_t blocks = blocks_of(c, expected);
    std::uint64_t rows = 0;
    for (std::uint64_t k = 1; k <= blocks; ++k) {
      Attempt attempt(c);
      ArenaHook hook;
      hook.refuse(k, false);
      Status status = attempt.load();
      if (!status.done()) {
        expect_refusal(status);
        EXPECT_EQ(attempt.model, nullptr);
        ASSERT_TRUE(attempt.load().done()) << "block " << k;
      }
      status = solve(*attempt.model, {});
      if (!status.done()) {
        expect_refusal(status);
        EXPECT_EQ(shodo::draw(*attempt.model, {}, {}).code, StatusCode::kUsage) << "half a solution is none";
        ASSERT_TRUE(solve(*attempt.model, {}).done()) << "block " << k;
      }
      const bool before_drawing = hook.refused() == 1;
      status = attempt.draw();
      if (!status.done()) {
        expect_refusal(status);
        EXPECT_TRUE(attempt.picture.empty());
        status = attempt.draw();
      }
      ASSERT_TRUE(status.done() && attempt.picture == expected) << c.scene << ", block " << k;
      EXPECT_EQ(hook.refused(), 1u);
      if (before_drawing && statistics(*attempt.model).rows_recomputed > 0) ++rows;
    }
    EXPECT_GT(rows, 0u) << c.scene << ": a row that was refused is computed again";
  }
}

TEST(ArenaFaults, BlocksRefusedFromOneOnAreStatus4) {
  for (const Case& c : cases()) {
    std::vector<std::uint8_t> expected;
    const std::uint64_t blocks = blocks_of(c, expected);
    for (std::uint64_t k = 1; k <= blocks; ++k) {
      Attempt attempt(c);
      ArenaHook hook;
      hook.refuse(k, true);
      expect_refusal(attempt.all());
      EXPECT_TRUE(attempt.picture.empty()) << "nothing is drawn by halves";
    }
  }
}

}  // namespace
}  // namespace shodo
