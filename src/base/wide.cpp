#include "base/wide.h"

#include <bit>

#include "base/check.h"

namespace shodo {

namespace {

constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

struct Division {
  std::uint64_t quotient;
  std::uint64_t remainder;
};

/// One digit of the quotient: (remainder 2^32 + next) / divisor, which is below 2^32; the divisor's top bit is set.
/// The guess from the divisor's upper half is at most 2 too large, and never above 2^32 (Knuth, volume 2, 4.3.1).
Division next_digit(std::uint64_t remainder, std::uint32_t next, std::uint64_t divisor) {
  const std::uint64_t upper = divisor >> 32, lower = divisor & 0xffffffffu;
  std::uint64_t digit = remainder / upper;
  std::uint64_t rest = remainder - digit * upper;
  while (digit * lower > ((rest << 32) | next)) {
    --digit;
    rest += upper;
    if (rest > 0xffffffffu) break;
  }
  return {digit, ((remainder << 32) | next) - digit * divisor};
}

/// (high 2^64 + low) / divisor; high < divisor, so that the quotient fits.
Division divide_unsigned(std::uint64_t high, std::uint64_t low, std::uint64_t divisor) {
  if (high == 0) return {low / divisor, low % divisor};
  const int shift = std::countl_zero(divisor);
  if (shift != 0) {
    divisor <<= shift;
    high = (high << shift) | (low >> (64 - shift));
    low <<= shift;
  }
  const Division first = next_digit(high, static_cast<std::uint32_t>(low >> 32), divisor);
  const Division second = next_digit(first.remainder, static_cast<std::uint32_t>(low), divisor);
  return {(first.quotient << 32) + second.quotient, second.remainder >> shift};
}

enum class Towards { floor, ceiling };

std::int64_t divide_wide(const Int128& numerator, std::int64_t denominator, Towards towards) {
  const bool negative = (numerator.high < 0) != (denominator < 0);
  const Int128 size = numerator.high < 0 ? -numerator : numerator;  // 2^127 too, read as unsigned
  const std::uint64_t divisor =
      denominator < 0 ? 0 - static_cast<std::uint64_t>(denominator) : static_cast<std::uint64_t>(denominator);
  const std::int64_t limit = negative ? kLeast : kMost;
  if (static_cast<std::uint64_t>(size.high) >= divisor) return limit;
  const Division result = divide_unsigned(static_cast<std::uint64_t>(size.high), size.low, divisor);
  const bool away = result.remainder != 0 && negative == (towards == Towards::floor);
  if (result.quotient > static_cast<std::uint64_t>(kMost) - (away ? 1 : 0)) return limit;
  const std::int64_t quotient = static_cast<std::int64_t>(result.quotient) + (away ? 1 : 0);
  return negative ? -quotient : quotient;
}

}  // namespace

std::int64_t floor_divide(const Int128& numerator, std::int64_t denominator) {
  SHODO_CHECK(denominator != 0);
  const std::int64_t n = static_cast<std::int64_t>(numerator.low);
  if (!fits_64(numerator) || n == kLeast) return divide_wide(numerator, denominator, Towards::floor);
  const std::int64_t quotient = n / denominator;
  const std::int64_t rest = n - quotient * denominator;
  return rest != 0 && (rest < 0) != (denominator < 0) ? quotient - 1 : quotient;
}

std::int64_t ceil_divide(const Int128& numerator, std::int64_t denominator) {
  SHODO_CHECK(denominator != 0);
  const std::int64_t n = static_cast<std::int64_t>(numerator.low);
  if (!fits_64(numerator) || n == kLeast) return divide_wide(numerator, denominator, Towards::ceiling);
  const std::int64_t quotient = n / denominator;
  const std::int64_t rest = n - quotient * denominator;
  return rest != 0 && (rest < 0) == (denominator < 0) ? quotient + 1 : quotient;
}

}  // namespace shodo
