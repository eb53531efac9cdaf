#include "base/decimal.h"

#include <bit>

namespace shodo {

namespace {

constexpr int kKeptDigits = 770;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// ---- the token

/// A token that keeps to the grammar: (-1)^negative 0.d1 d2 ... 10^point, d1 and the last digit not 0.
struct Token {
  std::string_view digits;  // from d1 to the last digit that is not 0; there may be a '.' inside
  std::int64_t count = 0;   // of digits among them; 0: the number is 0
  std::int64_t point = 0;
  bool negative = false;
  DecimalError error = DecimalError::none;
  std::size_t offset = 0;
};

/// Sets digits, count and point from the mantissa that starts at `at`; returns its end. False in `found`: no digit.
std::size_t scan_mantissa(std::string_view text, std::size_t at, Token& token, bool& found) {
  std::size_t first = 0, last = 0;  // places of d1 and of the last digit that is not 0
  std::int64_t since_first = 0;     // digits from d1 on
  bool after_point = false;
  found = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '.' && !after_point) {
      after_point = true;
      continue;
    }
    if (!is_digit(c)) break;
    found = true;
    if (c != '0' || since_first > 0) {
      if (since_first++ == 0) first = at;
      if (!after_point) ++token.point;
    } else if (after_point) {
      --token.point;
    }
    if (c != '0') {
      last = at;
      token.count = since_first;
    }
  }
  if (token.count > 0) token.digits = std::string_view(text.data() + first, last + 1 - first);
  return at;
}

/// Adds the exponent, digits from `at`, to the point; returns its end. Beyond 10^17 it stays: no token is as long.
std::size_t scan_exponent(std::string_view text, std::size_t at, bool negative, Token& token) {
  std::int64_t exponent = 0;
  for (; at < text.size() && is_digit(text[at]); ++at) {
    if (exponent < 100'000'000'000'000'000) exponent = 10 * exponent + (text[at] - '0');
  }
  token.point += negative ? -exponent : exponent;
  return at;
}

Token refused(DecimalError error, std::size_t offset) {
  Token token;
  token.error = error;
  token.offset = offset;
  return token;
}

bool is_sign(std::string_view text, std::size_t at) { return at < text.size() && (text[at] == '-' || text[at] == '+'); }

Token scan(std::string_view text) {
  if (text.empty()) return refused(DecimalError::empty, 0);
  Token token;
  std::size_t at = 0;
  if (is_sign(text, at)) token.negative = text[at++] == '-';
  bool found = false;
  at = scan_mantissa(text, at, token, found);
  if (!found) return refused(DecimalError::not_a_number, at);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    bool negative = false;
    if (is_sign(text, at)) negative = text[at++] == '-';
    if (at == text.size() || !is_digit(text[at])) return refused(DecimalError::not_a_number, at);
    at = scan_exponent(text, at, negative, token);
  }
  if (at != text.size()) return refused(DecimalError::trailing, at);
  return token;
}

// ---- big integers

/// An unsigned integer of a fixed size; limbs above `used` are not kept. The largest here is the one of 771 digits,
/// 2,562 bits; 5^1094 has 2,541; both are shifted to equal lengths, and one further in the long division.
struct Big {
  static constexpr int kLimbs = 82;  // 2,624 bits
  std::uint32_t limbs[kLimbs];
  int used = 0;

  void multiply_add(std::uint32_t factor, std::uint32_t summand) {
    std::uint64_t carry = summand;
    for (int k = 0; k < used; ++k) {
      carry += std::uint64_t{limbs[k]} * factor;
      limbs[k] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) limbs[used++] = static_cast<std::uint32_t>(carry);
  }

  void multiply_power_of_5(std::int64_t n) {
    constexpr std::uint32_t kFiveToThe13 = 1220703125;
    for (; n >= 13; n -= 13) multiply_add(kFiveToThe13, 0);
    for (; n > 0; --n) multiply_add(5, 0);
  }

  int bits() const { return used == 0 ? 0 : 32 * used - std::countl_zero(limbs[used - 1]); }

  void shift_left(int n) {
    const int whole = n / 32, part = n % 32;
    if (part != 0) multiply_add(std::uint32_t{1} << part, 0);
    if (whole == 0 || used == 0) return;
    for (int k = used; k-- > 0;) limbs[k + whole] = limbs[k];
    for (int k = 0; k < whole; ++k) limbs[k] = 0;
    used += whole;
  }

  bool at_least(const Big& other) const {
    if (used != other.used) return used > other.used;
    for (int k = used; k-- > 0;) {
      if (limbs[k] != other.limbs[k]) return limbs[k] > other.limbs[k];
    }
    return true;
  }

  /// other <= *this.
  void subtract(const Big& other) {
    std::uint32_t borrow = 0;
    for (int k = 0; k < used; ++k) {
      const std::uint64_t taken = std::uint64_t{k < other.used ? other.limbs[k] : 0} + borrow;
      borrow = limbs[k] < taken ? 1 : 0;
      limbs[k] = static_cast<std::uint32_t>(limbs[k] - taken);
    }
    while (used > 0 && limbs[used - 1] == 0) --used;
  }
};

// ---- the value

/// The first kKeptDigits digits as an integer, and a 1 behind them if more follow (the last of those is not 0): on the
/// same side of every half-way point as the whole. Returns how many digits that makes.
std::int64_t read_digits(const Token& token, Big& number) {
  std::int64_t count = 0;
  for (const char c : token.digits) {
    if (c == '.') continue;
    if (count == kKeptDigits) {
      number.multiply_add(10, 1);
      return count + 1;
    }
    number.multiply_add(10, static_cast<std::uint32_t>(c - '0'));
    ++count;
  }
  return count;
}

/// bits 2^(exponent - 63), plus less than one unit if `more`; the top bit is set.
struct Quotient {
  std::uint64_t bits;
  int exponent;
  bool more;
};

/// numerator / denominator, both above 0, by schoolbook long division in base 2.
Quotient divide(Big& numerator, Big& denominator) {
  Quotient result = {0, numerator.bits() - denominator.bits(), false};
  if (result.exponent > 0) denominator.shift_left(result.exponent);
  if (result.exponent < 0) numerator.shift_left(-result.exponent);
  if (!numerator.at_least(denominator)) {
    numerator.shift_left(1);
    --result.exponent;
  }
  for (int bit = 0; bit < 64; ++bit) {
    result.bits <<= 1;
    if (numerator.at_least(denominator)) {
      numerator.subtract(denominator);
      result.bits |= 1;
    }
    numerator.shift_left(1);
  }
  result.more = numerator.used != 0;
  return result;
}

/// To the nearest double, to even in a tie. The carry out of a full mantissa is the next exponent, as IEEE meant it.
double rounded(const Quotient& q) {
  constexpr int kLeastExponent = -1022;
  const bool normal = q.exponent >= kLeastExponent;
  const int drop = normal ? 11 : 11 + (kLeastExponent - q.exponent);
  if (drop > 64) return 0;  // below half of the least denormal
  const std::uint64_t kept = drop == 64 ? 0 : q.bits >> drop;
  const std::uint64_t half = std::uint64_t{1} << (drop - 1);
  const std::uint64_t dropped = drop == 64 ? q.bits : q.bits & (2 * half - 1);
  const bool up = dropped > half || (dropped == half && (q.more || (kept & 1) != 0));
  const std::uint64_t biased = normal ? static_cast<std::uint64_t>(q.exponent - kLeastExponent) << 52 : 0;
  return std::bit_cast<double>(biased + kept + (up ? 1 : 0));
}

constexpr double kPowersOf10[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                  1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// The value where digits and power of ten are exact doubles; false elsewhere.
bool short_value(const Token& token, double& value) {
  const std::int64_t power = token.point - token.count;
  if (token.count > 15 || power < -22 || power > 22) return false;
  std::uint64_t digits = 0;
  for (const char c : token.digits) {
    if (c != '.') digits = 10 * digits + static_cast<std::uint64_t>(c - '0');
  }
  value = static_cast<double>(digits);
  value = power < 0 ? value / kPowersOf10[-power] : value * kPowersOf10[power];
  return true;
}

/// For 10^-324 <= value < 10^309. D 10^E = D 5^E 2^E; the power of two only moves the exponent.
double long_value(const Token& token) {
  Big numerator, denominator;
  const std::int64_t power = token.point - read_digits(token, numerator);
  denominator.multiply_add(0, 1);
  if (power >= 0) numerator.multiply_power_of_5(power);
  if (power < 0) denominator.multiply_power_of_5(-power);
  Quotient quotient = divide(numerator, denominator);
  quotient.exponent += static_cast<int>(power);
  constexpr int kMostExponent = 1023;
  if (quotient.exponent > kMostExponent) return std::bit_cast<double>(std::uint64_t{0x7ff} << 52);
  return rounded(quotient);
}

}  // namespace

DecimalResult parse_decimal(std::string_view text) {
  const Token token = scan(text);
  if (token.error != DecimalError::none) return {0, token.error, token.offset};
  double value = 0;
  constexpr std::int64_t kLeastPoint = -323, kMostPoint = 309;  // below 10^-324, and from 10^309 on
  if (token.count > 0 && token.point > kMostPoint) return {0, DecimalError::out_of_range, 0};
  if (token.count > 0 && token.point >= kLeastPoint && !short_value(token, value)) value = long_value(token);
  constexpr double kLargest = 0x1.fffffffffffffp+1023;
  if (value > kLargest) return {0, DecimalError::out_of_range, 0};
  return {token.negative ? -value : value, DecimalError::none, text.size()};
}

bool parse_unsigned(std::string_view token, std::uint32_t& value) {
  if (token.empty()) return false;
  std::uint64_t sum = 0;
  for (const char c : token) {
    if (!is_digit(c)) return false;
    sum = 10 * sum + static_cast<std::uint64_t>(c - '0');
    if (sum > 0xffffffffu) return false;
  }
  value = static_cast<std::uint32_t>(sum);
  return true;
}

}  // namespace shodo
