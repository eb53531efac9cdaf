#include "ambient/row_store.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace shodo {
namespace {

using Entries = std::vector<std::pair<std::uint32_t, double>>;

template <bool kDoubles>
Entries read(const std::uint16_t* row, std::uint32_t index) {
  Entries entries;
  constexpr RowFormat kFormat = kDoubles ? RowFormat::kDoubles : RowFormat::kShort;
  for (RowReader<kFormat> entry(row, index, kDoubles); entry.next();) {
    entries.emplace_back(entry.column(), entry.value());
  }
  return entries;
}

template <bool kDoubles>
Entries written_and_read(std::uint32_t index, const Entries& entries) {
  std::vector<std::uint16_t> words(row_words(1000, kDoubles));
  RowWriter writer(words, kDoubles);
  writer.start(index);
  for (const auto& [column, value] : entries) writer.add(column, value);
  return read<kDoubles>(writer.finish().data(), index);
}

TEST(RowStore, ColumnsFartherApartThan65535AreReached) {
  // Around each multiple of the longest gap; values that 16 bits hold exactly.
  Entries entries;
  std::uint32_t column = 7;
  for (const std::uint32_t gap : {1u, 2u, 65534u, 65535u, 65536u, 131069u, 131070u, 131071u, 1u, 4000000u, 1u}) {
    entries.emplace_back(column += gap, 0.5 / static_cast<double>(entries.size() + 1 == 3 ? 2 : 1));
  }
  EXPECT_EQ(written_and_read<false>(7, entries), entries);
  EXPECT_EQ(written_and_read<true>(7, entries), entries);
}

TEST(RowStore, DoublesKeepEveryBitAnd16BitsRoundToNearest) {
  const Entries entries{{3, 1.0 / 3}, {4, 1e-300}, {9, 1.0}, {10, 0x1.fffffffffffffp-1}};
  EXPECT_EQ(written_and_read<true>(2, entries), entries);
  const Entries short_ones = written_and_read<false>(2, entries);
  ASSERT_EQ(short_ones.size(), 3u);  // 1e-300 is nothing
  EXPECT_NEAR(short_ones[0].second, 1.0 / 3, kRowValueError / 3);
  EXPECT_EQ(short_ones[1], std::make_pair(9u, 1.0));
  EXPECT_EQ(short_ones[2], std::make_pair(10u, 1.0));
}

TEST(RowStore, ARowThatUsesEveryColumnFitsTheWordsPlannedForIt) {
  for (const bool doubles : {false, true}) {
    std::vector<std::uint16_t> words(row_words(500, doubles));
    RowWriter writer(words, doubles);
    writer.start(0);
    for (std::uint32_t j = 1; j <= 500; ++j) writer.add(j, 0.25);
    EXPECT_LE(writer.finish().size(), words.size());
  }
  // The most continuations come from columns spread over the whole range.
  std::vector<std::uint16_t> words(row_words(200000, false));
  RowWriter writer(words, false);
  writer.start(0);
  for (std::uint32_t j = 1; j <= 200000; ++j) writer.add(j, 0.25);
  EXPECT_LE(writer.finish().size(), words.size());
}

TEST(RowStore, TheFirstRowsAreKeptUntilTheSpaceIsFullAndNoneAfterThat) {
  alignas(8) std::byte memory[1024];
  Arena arena(memory, sizeof memory);
  RowStore store(arena, 200);
  std::vector<std::uint16_t> words(row_words(200, false));
  RowWriter writer(words, false);
  std::vector<Entries> rows;
  std::uint32_t kept = 0;
  bool refused = false;
  for (std::uint32_t i = 0; i < 40; ++i) {
    writer.start(i);
    Entries entries;
    for (std::uint32_t j = i + 1; j < i + 2 + i * 5 % 13; ++j) {
      entries.emplace_back(j, 1.0 / (1 << (j % 8)));
      writer.add(j, entries.back().second);
    }
    if (store.keep(writer.finish())) {
      ASSERT_FALSE(refused) << "a row after one that didn't fit";
      rows.push_back(entries);
      ++kept;
    } else {
      refused = true;
    }
  }
  EXPECT_TRUE(refused);
  EXPECT_GT(kept, 5u);
  EXPECT_EQ(store.rows(), kept);
  EXPECT_EQ(store.bytes(), arena.used());
  EXPECT_GE(arena.left(), 200u);
  const std::uint16_t* row = store.first();
  for (std::uint32_t i = 0; i < kept; ++i, row = RowStore::after(row)) EXPECT_EQ(read<false>(row, i), rows[i]) << i;
}

}  // namespace
}  // namespace shodo
