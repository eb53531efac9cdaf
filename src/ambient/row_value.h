// The 16-bit number of a row: a 5-bit exponent over an 11-bit fraction, for values of (0, 1] (design: rows).
//
// value = 2^(exponent - 31) (1 + fraction / 2048). Rounded to the nearest, halves to the even fraction: the relative
// error is at most 2^-12. Below 2^-32 nothing is stored (code kNoRowValue), from there to 2^-31 it is rounded to 2^-31.
// Code and value ascend together. Decoding is a shift and an addition: a code is the middle of a float.
#pragma once

#include <bit>
#include <cstdint>

namespace shodo {

using RowCode = std::uint16_t;

inline constexpr std::int32_t kNoRowValue = -1;
inline constexpr double kRowValueError = 0x1p-12;  // relative

/// Exact.
constexpr float decode_row_value(RowCode code) {
  return std::bit_cast<float>((std::uint32_t{code} << 12) + (96u << 23));
}

/// The code nearest to `value` (not above 1), or kNoRowValue if that is zero.
constexpr std::int32_t encode_row_value(double value) {
  if (!(value > 0x1p-32)) return kNoRowValue;
  if (value <= 0x1p-31) return 0;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t kept = bits >> 41, rest = bits & ((std::uint64_t{1} << 41) - 1);
  const std::uint64_t half = std::uint64_t{1} << 40;
  const std::uint64_t up = rest > half || (rest == half && (kept & 1) != 0) ? 1 : 0;
  // A double's exponent is biased by 1023, ours by 31.
  return static_cast<std::int32_t>(kept + up - (std::uint64_t{1023 - 31} << 11));
}

static_assert(decode_row_value(31 << 11) == 1.0f && encode_row_value(1.0) == 31 << 11);
static_assert(decode_row_value(0) == 0x1p-31f && encode_row_value(0x1p-31) == 0);

}  // namespace shodo
