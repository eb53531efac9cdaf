// The promise of doc/memory.md: each of the two rooms works in 640 KiB.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "shodo/shodo.h"
#include "support/files.h"

namespace shodo {
namespace {

constexpr std::uint64_t kPromised = 640 << 10;

TEST(RoomsBudget, EachRoomWorksIn640KiBWithBlocksAndWithoutAndWhereSubPatchesGather) {
  std::vector<std::uint64_t> memory(kPromised / 8);
  for (const std::string name : {"day.scn", "evening.scn"}) {
    for (const int way : {0, 1, 2, 3}) {
      FolderReader files(source_folder() + "/data");
      std::string_view text;
      ASSERT_TRUE(files.read(name, text));
      Options options;
      options.rules.blocks = way % 2 == 1;
      options.gather = way / 2 == 1;
      Model* model = nullptr;
      ASSERT_TRUE(load(name, text, files.reader(), options, memory.data(), kPromised, model).done());
      EXPECT_LE(smallest_memory(*model), kPromised) << name;
    }
  }
}

}  // namespace
}  // namespace shodo
