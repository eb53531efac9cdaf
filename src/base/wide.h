// Integers of 128 and 192 bits, for the few products of the picture that do not fit 64 (design: pictures).
//
// Two's complement in 64-bit limbs, made of 32-bit products, since small machines have no 128-bit type. Everything is
// exact; sums and shifts wrap around as 64-bit unsigned ones do, so callers keep within the range. Edge functions need
// 2^69, comparisons of depths 2^126: there is room.
// Approximate: nothing. Quotients that don't fit 64 bits become the nearest limit, which is what a scanline wants.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace shodo {

/// high 2^64 + low.
struct Int128 {
  std::int64_t high = 0;
  std::uint64_t low = 0;

  constexpr Int128() = default;
  constexpr Int128(std::int64_t high_limb, std::uint64_t low_limb) : high(high_limb), low(low_limb) {}
  constexpr explicit Int128(std::int64_t value) : high(value < 0 ? -1 : 0), low(static_cast<std::uint64_t>(value)) {}

  constexpr bool operator==(const Int128&) const = default;
  constexpr std::strong_ordering operator<=>(const Int128&) const = default;
};

/// high 2^128 + middle 2^64 + low.
struct Int192 {
  std::int64_t high = 0;
  std::uint64_t middle = 0;
  std::uint64_t low = 0;

  constexpr bool operator==(const Int192&) const = default;
  constexpr std::strong_ordering operator<=>(const Int192&) const = default;
};

constexpr Int128 operator+(const Int128& a, const Int128& b) {
  const std::uint64_t low = a.low + b.low;
  const std::uint64_t carry = low < a.low ? 1 : 0;
  return {static_cast<std::int64_t>(static_cast<std::uint64_t>(a.high) + static_cast<std::uint64_t>(b.high) + carry),
          low};
}

constexpr Int128 operator-(const Int128& a, const Int128& b) {
  const std::uint64_t borrow = a.low < b.low ? 1 : 0;
  return {static_cast<std::int64_t>(static_cast<std::uint64_t>(a.high) - static_cast<std::uint64_t>(b.high) - borrow),
          a.low - b.low};
}

constexpr Int128 operator-(const Int128& a) { return Int128() - a; }

constexpr Int128& operator+=(Int128& a, const Int128& b) { return a = a + b; }
constexpr Int128& operator-=(Int128& a, const Int128& b) { return a = a - b; }

/// a 2^n; n from 0 to 127.
constexpr Int128 operator<<(const Int128& a, unsigned n) {
  if (n == 0) return a;
  if (n >= 64) return {static_cast<std::int64_t>(a.low << (n - 64)), 0};
  return {static_cast<std::int64_t>((static_cast<std::uint64_t>(a.high) << n) | (a.low >> (64 - n))), a.low << n};
}

/// The floor of a / 2^n; n from 0 to 127.
constexpr Int128 operator>>(const Int128& a, unsigned n) {
  if (n == 0) return a;
  if (n >= 64) return Int128(a.high >> (n - 64));
  return {a.high >> n, (static_cast<std::uint64_t>(a.high) << (64 - n)) | (a.low >> n)};
}

/// -1, 0 or 1.
constexpr int sign(const Int128& a) { return a.high < 0 ? -1 : (a.high | static_cast<std::int64_t>(a.low)) != 0; }
constexpr int sign(const Int192& a) {
  return a.high < 0 ? -1 : (a.high | static_cast<std::int64_t>(a.middle | a.low)) != 0;
}

constexpr bool fits_64(const Int128& a) { return a.high == (static_cast<std::int64_t>(a.low) >> 63); }

/// a b as 128 unsigned bits: `high` is to be read as unsigned.
constexpr Int128 multiply_unsigned(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t a0 = a & 0xffffffffu, a1 = a >> 32;
  const std::uint64_t b0 = b & 0xffffffffu, b1 = b >> 32;
  const std::uint64_t lower = a0 * b0;
  const std::uint64_t inner = a1 * b0 + (lower >> 32);  // below 2^64: (2^32 - 1)^2 + 2^32 - 1
  const std::uint64_t outer = a0 * b1 + (inner & 0xffffffffu);
  return {static_cast<std::int64_t>(a1 * b1 + (inner >> 32) + (outer >> 32)), (outer << 32) | (lower & 0xffffffffu)};
}

/// a b, exact. A negative factor read as unsigned is 2^64 too large: the other one is taken off the high limb.
constexpr Int128 multiply(std::int64_t a, std::int64_t b) {
  const std::uint64_t ua = static_cast<std::uint64_t>(a), ub = static_cast<std::uint64_t>(b);
  const Int128 product = multiply_unsigned(ua, ub);
  const std::uint64_t excess = (a < 0 ? ub : 0) + (b < 0 ? ua : 0);
  return {static_cast<std::int64_t>(static_cast<std::uint64_t>(product.high) - excess), product.low};
}

/// a b, exact.
constexpr Int192 multiply(const Int128& a, std::int64_t b) {
  const Int128 upper = multiply(a.high, b);
  const Int128 lower = multiply_unsigned(a.low, static_cast<std::uint64_t>(b));
  Int128 sum = upper + Int128(0, static_cast<std::uint64_t>(lower.high));
  if (b < 0) sum -= Int128(0, a.low);
  return {sum.high, sum.low, lower.low};
}

/// a_numerator / a_denominator < b_numerator / b_denominator, exactly; both denominators above 0.
constexpr bool less_fraction(std::int64_t a_numerator, std::int64_t a_denominator, std::int64_t b_numerator,
                             std::int64_t b_denominator) {
  return multiply(a_numerator, b_denominator) < multiply(b_numerator, a_denominator);
}

/// The largest integer not above, and the smallest not below, numerator / denominator; the denominator is not 0.
/// A quotient outside the 64-bit range becomes the limit next to it. One 64-bit division where the numerator fits 64
/// bits, else a long division by 32-bit digits.
std::int64_t floor_divide(const Int128& numerator, std::int64_t denominator);
std::int64_t ceil_divide(const Int128& numerator, std::int64_t denominator);

static_assert(multiply(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::min()) ==
              Int128(std::int64_t{1} << 62, 0));
static_assert(multiply(-1, 1) == Int128(-1));
static_assert(sign(Int128(0, std::uint64_t{1} << 63)) == 1 && sign(Int128(-1)) == -1 && sign(Int128()) == 0);

}  // namespace shodo
