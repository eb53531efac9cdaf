// The promise of doc/memory.md: each of the two rooms works in 640 KiB.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "shodo/shodo.h"
#include "support/files.h"

namespace shodo {
namespace {

constexpr std::uint64_t kPromised = 640 << 10;

TEST(RoomsBudget, EachRoomWorksIn640KiBWithBlocksAndWithout) {
  std::vector<std::uint64_t> memory(kPromised / 8);
  for (const std::string name : {"day.scn", "evening.scn"}) {
    for (const bool blocks : {false, true}) {
      FolderReader files(source_folder() + "/data");
      std::string_view text;
      ASSERT_TRUE(files.read(name, text));
      Options options;
      options.rules.blocks = blocks;
      Model* model = nullptr;
      ASSERT_TRUE(load(name, text, files.reader(), options, memory.data(), kPromised, model).done());
      EXPECT_LE(smallest_memory(*model), kPromised) << name;
    }
  }
}

}  // namespace
}  // namespace shodo
