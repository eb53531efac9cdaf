// The arena's promises: exact sizes, zeroed and aligned blocks, and a refusal that names the size that would do.
#include "base/arena.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace shodo {
namespace {

struct Memory {
  explicit Memory(std::size_t bytes) : words(bytes / 8 + 2, ~std::uint64_t{0}) {}
  std::byte* at(std::size_t skew) { return reinterpret_cast<std::byte*>(words.data()) + skew; }
  std::vector<std::uint64_t> words;
};

TEST(Arena, BlocksAreZeroedAlignedAndApart) {
  Memory memory(256);
  Arena arena(memory.at(0), 256);
  std::span<std::uint8_t> a;
  std::span<double> b;
  ASSERT_TRUE(arena.take("a", 3, a));
  ASSERT_TRUE(arena.take("b", 4, b));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(b.data()) % 8, 0u);
  EXPECT_GE(reinterpret_cast<std::byte*>(b.data()), reinterpret_cast<std::byte*>(a.data()) + 3);
  for (const std::uint8_t byte : a) EXPECT_EQ(byte, 0);
  for (const double value : b) EXPECT_EQ(value, 0);
  EXPECT_EQ(arena.used(), 8u + 32u);
}

TEST(Arena, ZeroesAgainWhatWasReleased) {
  Memory memory(64);
  Arena arena(memory.at(0), 64);
  std::span<std::uint8_t> block;
  {
    const ArenaScratch scratch(arena);
    ASSERT_TRUE(arena.take("first", 64, block));
    std::memset(block.data(), 1, block.size());
  }
  EXPECT_EQ(arena.used(), 0u);
  EXPECT_EQ(arena.peak(), 64u);
  ASSERT_TRUE(arena.take("second", 64, block));
  for (const std::uint8_t byte : block) EXPECT_EQ(byte, 0);
}

TEST(Arena, RefusalNamesTheBlockAndTheSizeThatWouldDo) {
  Memory memory(128);
  for (std::size_t bytes = 0; bytes < 48; ++bytes) {
    Arena arena(memory.at(0), bytes);
    std::span<std::uint8_t> a, b;
    if (arena.take("first", 20, a) && arena.take("rows", 21, b)) FAIL() << bytes;
    EXPECT_TRUE(b.empty());
    const Status status = arena.refused();
    EXPECT_EQ(status.code, StatusCode::kMemory);
    EXPECT_EQ(status.bytes_needed, bytes < 24 ? 24u : 48u);
    EXPECT_NE(std::string(status.message).find(bytes < 24 ? "first" : "rows"), std::string::npos) << status.message;
  }
  Arena arena(memory.at(0), 48);
  std::span<std::uint8_t> a, b;
  EXPECT_TRUE(arena.take("first", 20, a) && arena.take("rows", 21, b));
}

TEST(Arena, NothingIsAlwaysThere) {
  Arena arena(nullptr, 0);
  std::span<double> block;
  EXPECT_TRUE(arena.take("nothing", 0, block));
  EXPECT_TRUE(block.empty());
  EXPECT_FALSE(arena.take("something", 1, block));
}

TEST(Arena, CountsWhoseBytesOverflowAreRefused) {
  Memory memory(64);
  Arena arena(memory.at(0), 64);
  std::span<double> block;
  EXPECT_FALSE(arena.take("huge", SIZE_MAX / 8 + 1, block));
  EXPECT_FALSE(arena.take("huge", SIZE_MAX / 8, block));
  std::span<std::uint8_t> bytes;
  EXPECT_FALSE(arena.take("huge", SIZE_MAX, bytes));
  EXPECT_EQ(arena.used(), 0u);
}

TEST(Arena, SkewedMemoryStaysWithinItsBounds) {
  for (std::size_t skew = 0; skew < 8; ++skew) {
    for (std::size_t bytes = 0; bytes < 40; ++bytes) {
      Memory memory(64);
      Arena arena(memory.at(skew), bytes);
      std::span<std::uint64_t> block;
      std::size_t count = 0;
      while (arena.take("word", 1, block)) {
        const std::byte* start = reinterpret_cast<std::byte*>(block.data());
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(start) % 8, 0u);
        EXPECT_GE(start, memory.at(skew));
        EXPECT_LE(start + 8, memory.at(skew) + bytes);
        ++count;
      }
      EXPECT_GE(8 * count + 15, bytes);  // at most 7 bytes lost at either end
    }
  }
}

TEST(Arena, SpareBlocksGoWhenTheirMemoryIsWantedTheLastFirst) {
  Memory memory(128);
  Arena arena(memory.at(0), 128);
  std::span<std::uint64_t> first, second, block;
  ASSERT_TRUE(arena.take_spare("first", 3, first));
  ASSERT_TRUE(arena.take_spare("second", 2, second));
  EXPECT_EQ(arena.peak(), 40u);
  EXPECT_EQ(arena.left(), 128u);
  first[0] = 7;
  ASSERT_TRUE(arena.take("beside them", 11, block));
  EXPECT_TRUE(arena.holds(first) && arena.holds(second));
  EXPECT_EQ(arena.in_use(), 128u);
  ASSERT_TRUE(arena.take("in the way of the second", 1, block));
  EXPECT_TRUE(arena.holds(first) && !arena.holds(second));
  EXPECT_EQ(first[0], 7u);
  EXPECT_EQ(arena.stage_peak(), 128u);
  EXPECT_FALSE(arena.take_spare("another", 2, second)) << "none is given up for a spare one";
  ASSERT_TRUE(arena.take("in the way of the first", 4, block));
  EXPECT_FALSE(arena.holds(first));
  EXPECT_EQ(arena.used(), 128u);
}

TEST(Arena, PinnedBlocksStayAndARefusalCountsThem) {
  Memory memory(128);
  Arena arena(memory.at(0), 128);
  std::span<std::uint64_t> first, second, block;
  ASSERT_TRUE(arena.take_spare("first", 2, first));
  ASSERT_TRUE(arena.take_spare("second", 2, second));
  arena.pin_spares(1);
  EXPECT_EQ(arena.left(), 112u);
  EXPECT_FALSE(arena.take("too large", 15, block));
  EXPECT_EQ(arena.refused().bytes_needed, 136u);
  EXPECT_TRUE(arena.holds(second)) << "nothing is given up in vain";
  ASSERT_TRUE(arena.take("just fits", 14, block));
  EXPECT_TRUE(arena.holds(first) && !arena.holds(second));
}

TEST(Arena, LoweringMovesWhatStandsAbove) {
  Memory memory(64);
  Arena arena(memory.at(0), 64);
  std::span<std::uint64_t> a, b, c;
  ASSERT_TRUE(arena.take("a", 1, a));
  const Arena::Mark to = arena.mark();
  ASSERT_TRUE(arena.take("b", 2, b));
  const Arena::Mark from = arena.mark();
  ASSERT_TRUE(arena.take("c", 3, c));
  for (std::size_t k = 0; k < 3; ++k) c[k] = k + 1;
  EXPECT_EQ(arena.lower(from, to), 16u);
  EXPECT_EQ(arena.used(), 32u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(b[k], k + 1);
}

}  // namespace
}  // namespace shodo
