// Twin: strtod of glibc, which is correctly rounded.
#include "base/decimal.h"

#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <random>
#include <string>
#include <string_view>

namespace {

using shodo::DecimalError;
using shodo::DecimalResult;
using shodo::parse_decimal;
using shodo::parse_unsigned;

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }
double from_bits(std::uint64_t b) { return std::bit_cast<double>(b); }

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text.append(part);
  return text;
}

void expect_as_strtod(const std::string& token) {
  const double truth = std::strtod(token.c_str(), nullptr);
  const DecimalResult result = parse_decimal(token);
  if (std::isinf(truth)) {
    EXPECT_EQ(result.error, DecimalError::out_of_range) << token;
    EXPECT_EQ(result.value, 0) << token;
    return;
  }
  EXPECT_EQ(result.error, DecimalError::none) << token;
  EXPECT_EQ(result.offset, token.size()) << token;
  EXPECT_EQ(bits(result.value), bits(truth)) << token;
}

void expect_refused(std::string_view token, DecimalError error, std::size_t offset) {
  const DecimalResult result = parse_decimal(token);
  EXPECT_EQ(result.error, error) << token;
  EXPECT_EQ(result.offset, offset) << token;
  EXPECT_EQ(result.value, 0) << token;
}

std::string printed(const char* format, int precision, double value) {
  char text[1200];
  std::snprintf(text, sizeof text, format, precision, value);
  return text;
}

/// Any finite double, denormals often.
double any_double(std::mt19937_64& random) {
  for (;;) {
    std::uint64_t b = random();
    if (random() % 8 == 0) b &= 0x800fffffffffffffu >> (random() % 50);
    const double x = from_bits(b);
    if (std::isfinite(x)) return x;
  }
}

/// All the decimal digits; printf of glibc writes them.
std::string exact(long double value) {
  char text[1300];
  std::snprintf(text, sizeof text, "%.1099Le", value);
  return text;
}

/// The point half-way between |x| and the double after it: 54 bits, which long double holds.
std::string half_way(double x) {
  const double size = std::fabs(x);
  return exact(static_cast<long double>(size) / 2 + static_cast<long double>(from_bits(bits(size) + 1)) / 2);
}

/// The same number with its last mantissa digit that is not 0 one higher or lower, and many digits further on.
std::string nudged(const std::string& number, bool up) {
  const std::size_t e = number.find('e');
  std::string mantissa = number.substr(0, e);
  const std::size_t last = mantissa.find_last_not_of("0.");
  if (!up) {
    mantissa[last] = static_cast<char>(mantissa[last] - 1);
    mantissa = mantissa.substr(0, last + 1) + "99999999999999999999";
  } else {
    mantissa += "00000001";
  }
  return mantissa + number.substr(e);
}

TEST(Decimal, OfEveryPrintedDoubleIsThatDouble) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 100'000; ++k) {
    const double x = any_double(random);
    const DecimalResult result = parse_decimal(printed("%.*e", 16, x));
    ASSERT_EQ(bits(result.value), bits(x)) << printed("%.*e", 16, x);
  }
}

TEST(Decimal, AgreesWithStrtodOnRandomTokens) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 200'000; ++k) {
    std::string token = random() % 2 != 0 ? "-" : "";
    const std::uint64_t digits = 1 + random() % (k % 100 == 0 ? 900 : 25);
    const std::uint64_t point = random() % (digits + 1);
    for (std::uint64_t d = 0; d < digits; ++d) {
      if (d == point) token += '.';
      token += static_cast<char>('0' + random() % 10);
    }
    if (random() % 4 != 0) token.append("e").append(std::to_string(static_cast<int>(random() % 660) - 340));
    expect_as_strtod(token);
    if (HasFailure()) return;
  }
}

TEST(Decimal, AgreesWithStrtodOnTheNumbersOfScenes) {
  for (int k = -30'000; k <= 30'000; ++k) {
    expect_as_strtod(printed("%.*f", 3, k * 0.001));
    expect_as_strtod(printed("%.*g", 6, k * 1.7));
  }
  for (int e = -345; e <= 310; ++e) {
    for (const char* digits : {"1", "9.999999999999999", "123456789012345", "1234567890123456", "9007199254740993"}) {
      expect_as_strtod(std::string(digits).append("e").append(std::to_string(e)));
    }
  }
}

TEST(Decimal, RoundsTiesToEvenAndTheirNeighboursToTheirSides) {
  if (LDBL_MANT_DIG < 64) GTEST_SKIP() << "long double holds no half-way points";
  std::mt19937_64 random(3);
  for (int k = 0; k < 10'000; ++k) {
    const double x = k < 2'000 ? from_bits(random() % 4096) : std::fabs(any_double(random));
    if (bits(x) >= 0x7fefffffffffffffu) continue;
    const std::string tie = half_way(x);
    const double even = (bits(x) & 1) == 0 ? x : from_bits(bits(x) + 1);
    ASSERT_EQ(bits(parse_decimal(tie).value), bits(even)) << tie;
    ASSERT_EQ(bits(parse_decimal(nudged(tie, true)).value), bits(x) + 1) << tie;
    ASSERT_EQ(bits(parse_decimal(nudged(tie, false)).value), bits(x)) << tie;
  }
}

TEST(Decimal, SeesOneDigitAThousandPlacesBehindATie) {
  const std::string tie = "9007199254740993";  // 2^53 + 1
  EXPECT_EQ(parse_decimal(tie).value, 9007199254740992.0);
  EXPECT_EQ(parse_decimal(tie + "." + std::string(5000, '0')).value, 9007199254740992.0);
  EXPECT_EQ(parse_decimal(tie + "." + std::string(5000, '0') + "1").value, 9007199254740994.0);
  EXPECT_EQ(parse_decimal(tie + std::string(5000, '0') + "e-5000").value, 9007199254740992.0);
  EXPECT_EQ(parse_decimal(tie + std::string(5000, '0') + "1e-5001").value, 9007199254740994.0);
}

TEST(Decimal, KnowsTheEndsOfTheRange) {
  if (LDBL_MANT_DIG < 64) GTEST_SKIP() << "long double holds no half-way points";
  EXPECT_EQ(parse_decimal("1.7976931348623157e308").value, 0x1.fffffffffffffp+1023);
  EXPECT_EQ(parse_decimal("1.7976931348623158e308").value, 0x1.fffffffffffffp+1023);
  expect_refused("1.7976931348623159e308", DecimalError::out_of_range, 0);
  const std::string tie = exact(std::ldexp(0x1.fffffffffffff8p+0L, 1023));  // half-way to 2^1024, which is even
  expect_refused(tie, DecimalError::out_of_range, 0);
  EXPECT_EQ(parse_decimal(nudged(tie, false)).value, 0x1.fffffffffffffp+1023);
  expect_refused("1e309", DecimalError::out_of_range, 0);
  expect_refused("-1e999", DecimalError::out_of_range, 0);
  expect_refused("1e99999999999999999999999999", DecimalError::out_of_range, 0);
  EXPECT_EQ(parse_decimal("4.9e-324").value, 0x1p-1074);
  EXPECT_EQ(parse_decimal("2.4703282292062328e-324").value, 0x1p-1074);
  EXPECT_EQ(parse_decimal("2.4703282292062327e-324").value, 0);
  EXPECT_EQ(parse_decimal("2.2250738585072014e-308").value, 0x1p-1022);
  EXPECT_EQ(parse_decimal("2.2250738585072011e-308").value, 0x0.fffffffffffffp-1022);
  EXPECT_EQ(parse_decimal("2.2250738585072012e-308").value, 0x1p-1022);
  EXPECT_EQ(parse_decimal("1e-320").value, 2024 * 0x1p-1074);
  EXPECT_EQ(bits(parse_decimal("-1e-400").value), bits(-0.0));
  EXPECT_EQ(bits(parse_decimal("1e-99999999999999999999999999").value), bits(0.0));
}

TEST(Decimal, AcceptsEveryFormOfItsGrammar) {
  EXPECT_EQ(parse_decimal("0").value, 0);
  EXPECT_EQ(bits(parse_decimal("-0").value), bits(-0.0));
  EXPECT_EQ(bits(parse_decimal("-0.000e5").value), bits(-0.0));
  EXPECT_EQ(parse_decimal("+7").value, 7);
  EXPECT_EQ(parse_decimal("5.").value, 5);
  EXPECT_EQ(parse_decimal(".5").value, 0.5);
  EXPECT_EQ(parse_decimal("-.5E+1").value, -5);
  EXPECT_EQ(parse_decimal("00000000000000000000000012.50").value, 12.5);
  EXPECT_EQ(parse_decimal("1E-2").value, 0.01);
  EXPECT_EQ(parse_decimal("0e99999999999999999999").value, 0);
  EXPECT_EQ(parse_decimal("0.0e-99999999999999999999").value, 0);
  EXPECT_EQ(parse_decimal(joined({"7.", std::string(399, '7')})).value, 7.0 + 7.0 / 9);
  expect_as_strtod(std::string(308, '7'));
  expect_as_strtod(std::string(400, '7'));
  expect_as_strtod(joined({std::string(1500, '7'), "e-1820"}));
  EXPECT_EQ(parse_decimal(joined({"0.", std::string(999, '0'), "1e1000"})).value, 1);
  EXPECT_EQ(parse_decimal(joined({"1", std::string(1000, '0'), "e-1000"})).value, 1);
  EXPECT_EQ(parse_decimal("12345").offset, 5u);
}

TEST(Decimal, SaysWhatIsWrongAndWhere) {
  expect_refused("", DecimalError::empty, 0);
  for (const char* word : {"nan", "NaN", "inf", "Infinity", "abc", "e5", " 1"}) {
    expect_refused(word, DecimalError::not_a_number, 0);
  }
  expect_refused(".", DecimalError::not_a_number, 1);
  expect_refused("-", DecimalError::not_a_number, 1);
  expect_refused("-inf", DecimalError::not_a_number, 1);
  expect_refused("+.", DecimalError::not_a_number, 2);
  expect_refused("--1", DecimalError::not_a_number, 1);
  expect_refused("..5", DecimalError::not_a_number, 1);
  expect_refused(".e5", DecimalError::not_a_number, 1);
  expect_refused("1e", DecimalError::not_a_number, 2);
  expect_refused("1e+", DecimalError::not_a_number, 3);
  expect_refused("1ex", DecimalError::not_a_number, 2);
  expect_refused("1,5", DecimalError::trailing, 1);
  expect_refused("0x1p3", DecimalError::trailing, 1);
  expect_refused("1.5.2", DecimalError::trailing, 3);
  expect_refused("1 ", DecimalError::trailing, 1);
  expect_refused("1e5.0", DecimalError::trailing, 3);
  expect_refused("2m", DecimalError::trailing, 1);
  expect_refused(std::string_view("1\0", 2), DecimalError::trailing, 1);
}

// A reader that stops at the token's end, not at a zero byte.
TEST(Decimal, ReadsNothingBeyondItsToken) {
  const std::string line = "1.25e1 7";
  EXPECT_EQ(parse_decimal(std::string_view(line).substr(0, 6)).value, 12.5);
  EXPECT_EQ(parse_decimal(std::string_view(line).substr(0, 4)).value, 1.25);
}

TEST(Unsigned, IsDigitsOnlyWithin32Bits) {
  std::uint32_t value = 77;
  for (const char* token : {"", "-1", "+1", "1.0", "1e3", " 1", "0x10", "4294967296", "99999999999999999999999", "a"}) {
    EXPECT_FALSE(parse_unsigned(token, value)) << token;
    EXPECT_EQ(value, 77u) << token;
  }
  EXPECT_TRUE(parse_unsigned("4294967295", value));
  EXPECT_EQ(value, 4294967295u);
  EXPECT_TRUE(parse_unsigned("0", value));
  EXPECT_EQ(value, 0u);
  EXPECT_TRUE(parse_unsigned("000000000000000000000000012", value));
  EXPECT_EQ(value, 12u);
}

}  // namespace
