#include "ambient/row_store.h"

#include "base/check.h"

namespace shodo {

namespace {

std::size_t words_of(std::size_t entry_words) { return kRowHeaderWords + entry_words; }

/// Rows start at multiples of the arena's 8 bytes.
std::size_t padded_words(std::size_t words) { return (words + 3) / 4 * 4; }

}  // namespace

std::size_t row_words(std::size_t columns, bool doubles) {
  const std::size_t entries = columns + columns / kLongGap + 1;
  return padded_words(words_of(entries * (doubles ? 5 : 2)));
}

void RowWriter::start(std::uint32_t row) {
  used_ = kRowHeaderWords;
  column_ = row;
}

void RowWriter::put(std::uint16_t gap, double value, RowCode code) {
  SHODO_CHECK(used_ + (doubles_ ? 5 : 2) <= words_.size());
  words_[used_++] = gap;
  if (!doubles_) {
    words_[used_++] = code;
    return;
  }
  std::uint64_t bits = std::bit_cast<std::uint64_t>(value);
  for (int k = 0; k < 4; ++k, bits >>= 16) words_[used_++] = static_cast<std::uint16_t>(bits);
}

void RowWriter::add(std::uint32_t column, double value) {
  const std::int32_t code = encode_row_value(value);
  if (doubles_ ? !(value > 0) : code == kNoRowValue) return;
  std::uint32_t gap = column - column_;
  for (; gap >= kLongGap; gap -= kLongGap) put(kLongGap, 0, 0);
  put(static_cast<std::uint16_t>(gap), value, static_cast<RowCode>(code));
  column_ = column;
}

std::span<const std::uint16_t> RowWriter::finish() {
  const std::size_t words = used_ - kRowHeaderWords;
  words_[0] = static_cast<std::uint16_t>(words);
  words_[1] = static_cast<std::uint16_t>(words >> 16);
  return words_.first(used_);
}

bool RowStore::keep(std::span<const std::uint16_t> row) {
  const std::size_t words = padded_words(row.size());
  if (full_ || arena_->left() < reserve_ || words * 2 > arena_->left() - reserve_) {
    full_ = true;
    return false;
  }
  std::span<std::uint16_t> block;
  full_ = !arena_->take("rows", words, block);
  if (full_) return false;
  for (std::size_t k = 0; k < row.size(); ++k) block[k] = row[k];
  if (rows_ == 0) first_ = block.data();
  ++rows_;
  bytes_ += words * 2;
  return true;
}

const std::uint16_t* RowStore::after(const std::uint16_t* row) {
  return row + padded_words(words_of(row[0] | std::uint32_t{row[1]} << 16));
}

}  // namespace shodo
