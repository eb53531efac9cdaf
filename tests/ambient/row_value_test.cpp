#include "ambient/row_value.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shodo {
namespace {

/// Straight from the definition.
double slow_decode(unsigned code) { return std::ldexp(1 + (code % 2048) / 2048.0, static_cast<int>(code / 2048) - 31); }

TEST(RowValue, EveryCodeDecodesByItsDefinitionAndComesBack) {
  for (unsigned code = 0; code < 65536; ++code) {
    const double value = slow_decode(code);
    ASSERT_EQ(static_cast<double>(decode_row_value(static_cast<RowCode>(code))), value) << code;
    ASSERT_EQ(encode_row_value(value), static_cast<std::int32_t>(code)) << code;
  }
}

TEST(RowValue, BetweenTwoCodesTheNearerIsTakenAndTheEvenOneOfAHalf) {
  for (unsigned code = 0; code + 1 < 65536; ++code) {
    const double low = slow_decode(code), high = slow_decode(code + 1), half = (low + high) / 2;
    const int even = static_cast<int>(code % 2 == 0 ? code : code + 1);
    ASSERT_EQ(encode_row_value(half), even) << code;
    ASSERT_EQ(encode_row_value(std::nextafter(half, 0)), static_cast<int>(code));
    ASSERT_EQ(encode_row_value(std::nextafter(half, 2)), static_cast<int>(code) + 1);
    // The farthest values from any code are the halves: the stated error holds for them, hence for all.
    ASSERT_LE((high - half) / half, kRowValueError);
  }
}

TEST(RowValue, BelowHalfOfTheLeastCodeNothingIsStored) {
  EXPECT_EQ(encode_row_value(0), kNoRowValue);
  EXPECT_EQ(encode_row_value(0x1p-32), kNoRowValue);
  EXPECT_EQ(encode_row_value(std::nextafter(0x1p-32, 1)), 0);
  EXPECT_EQ(encode_row_value(1e-300), kNoRowValue);
  EXPECT_EQ(encode_row_value(-1), kNoRowValue);
}

}  // namespace
}  // namespace shodo
