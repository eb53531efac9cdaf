// Rows of the exchange between patches as a stream of 16-bit words (paper 3.2; design: rows).
//
// Deviation D2: only the upper triangle is kept: row i holds the columns j > i, ascending, of the symmetric matrix
//     v_ij = G_ij V_ij / sqrt(A_i A_j)   (G geometric factor, V visible fraction, A visible areas)
// so that F_ij = v_ij sqrt(A_j / A_i), F_ji = v_ij sqrt(A_i / A_j): half the memory of full rows, and reciprocity holds
// exactly in what is stored. An entry is the gap to the previous column (from i itself for the first; 65,535 means
// "go that far and read on", without a value) and the value: one word, or four for a double.
// Bytes: 4 an entry (10 with doubles) and 4 a row, rounded up to 8 a row. Exact but for the rounding of the value.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "ambient/row_value.h"
#include "base/arena.h"

namespace shodo {

inline constexpr std::uint16_t kLongGap = 65535;
inline constexpr std::uint32_t kRowHeaderWords = 2;

/// Words that a row of at most `columns` columns can need, in either format.
std::size_t row_words(std::size_t columns, bool doubles);

/// Writes one row into a buffer of row_words().
class RowWriter {
 public:
  RowWriter(std::span<std::uint16_t> words, bool doubles) : words_(words), doubles_(doubles) {}

  void start(std::uint32_t row);
  /// Columns ascend; 0 < value <= 1. What rounds to zero is left out.
  void add(std::uint32_t column, double value);
  /// The finished row, header included.
  std::span<const std::uint16_t> finish();

 private:
  void put(std::uint16_t gap, double value, RowCode code);

  std::span<std::uint16_t> words_;
  std::size_t used_ = 0;
  std::uint32_t column_ = 0;
  bool doubles_;
};

/// Which values a reader is made for: loops that know it are faster; one that asks row by row serves both.
enum class RowFormat : std::uint8_t { kShort, kDoubles, kEither };

/// Reads the entries of a row in ascending order. A row is its header (words that follow, low word first) and entries.
template <RowFormat kFormat>
class RowReader {
 public:
  RowReader(const std::uint16_t* row, std::uint32_t index, bool doubles)
      : word_(row + kRowHeaderWords), column_(index), either_(doubles) {
    end_ = word_ + (row[0] | std::uint32_t{row[1]} << 16);
  }

  /// False after the last entry.
  bool next() {
    while (word_ != end_) {
      const std::uint32_t gap = word_[0];
      column_ += gap;
      value_at_ = word_ + 1;
      word_ += doubles() ? 5 : 2;
      if (gap != kLongGap) return true;
    }
    return false;
  }
  std::uint32_t column() const { return column_; }
  double value() const {
    if (!doubles()) return static_cast<double>(decode_row_value(*value_at_));
    std::uint64_t bits = 0;
    for (int k = 3; k >= 0; --k) bits = bits << 16 | value_at_[k];
    return std::bit_cast<double>(bits);
  }

 private:
  bool doubles() const { return kFormat == RowFormat::kEither ? either_ : kFormat == RowFormat::kDoubles; }

  const std::uint16_t* word_;
  const std::uint16_t* end_;
  const std::uint16_t* value_at_ = nullptr;
  std::uint32_t column_;
  bool either_;  // read by kEither only
};

/// The first rows of the matrix, as many as fit; they are read from the first to the last.
///
/// Blocks of one arena that follow one another without another in between are contiguous, so a row needs no pointer.
class RowStore {
 public:
  explicit RowStore(Arena& arena, std::size_t reserve = 0) : arena_(&arena), reserve_(reserve) {}

  /// Keeps the next row if it fits and all before it were kept.
  bool keep(std::span<const std::uint16_t> row);
  std::uint32_t rows() const { return rows_; }
  std::uint64_t bytes() const { return bytes_; }
  const std::uint16_t* first() const { return first_; }
  static const std::uint16_t* after(const std::uint16_t* row);

 private:
  Arena* arena_;
  std::size_t reserve_;  // bytes of the arena left to others
  const std::uint16_t* first_ = nullptr;
  std::uint32_t rows_ = 0;
  std::uint64_t bytes_ = 0;
  bool full_ = false;
};

}  // namespace shodo
