#include "base/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace {

using shodo::TextBuilder;

template <class T>
std::string written(T value) {
  char buffer[64];
  return std::string(TextBuilder(buffer, sizeof buffer).add(value).text());
}

std::string printed(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

TEST(Text, JoinsItsParts) {
  char buffer[64];
  TextBuilder text(buffer, sizeof buffer);
  text.add("line ").add(12).add(':').add(' ').add(std::size_t{7}).add(" of ").add(-0.5);
  EXPECT_STREQ(buffer, "line 12: 7 of -0.5");
  EXPECT_EQ(text.text(), buffer);
  EXPECT_FALSE(text.truncated());
}

TEST(Text, WritesIntegersToTheirLimits) {
  EXPECT_EQ(written(0), "0");
  EXPECT_EQ(written(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(written(std::numeric_limits<std::int64_t>::max()), "9223372036854775807");
  EXPECT_EQ(written(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(written(std::numeric_limits<std::int32_t>::min()), "-2147483648");
  EXPECT_EQ(written(std::uint8_t{200}), "200");
  EXPECT_EQ(written(std::int16_t{-3}), "-3");
}

// Every capacity, and behind it bytes that must stay as they were.
TEST(Text, IsCutWithDotsAndNeverLeavesItsBuffer) {
  const std::string whole = "expected a number";
  for (std::size_t capacity = 0; capacity <= whole.size() + 2; ++capacity) {
    char buffer[32];
    std::memset(buffer, '#', sizeof buffer);
    TextBuilder text(buffer, capacity);
    text.add("expected ").add("").add('a').add(" number");
    for (std::size_t k = capacity; k < sizeof buffer; ++k) ASSERT_EQ(buffer[k], '#') << capacity;
    if (capacity == 0) continue;
    std::string wanted = whole;
    if (capacity <= whole.size()) {
      const std::size_t kept = capacity - 1, dots = kept < 3 ? kept : 3;
      wanted = whole.substr(0, kept - dots) + std::string(dots, '.');
    }
    ASSERT_EQ(buffer, wanted) << capacity;
    ASSERT_EQ(text.text(), wanted);
    ASSERT_EQ(text.truncated(), capacity <= whole.size());
  }
}

TEST(Text, StaysAsItIsOnceItIsCut) {
  char buffer[8];
  TextBuilder text(buffer, sizeof buffer);
  text.add("0123456789");
  EXPECT_STREQ(buffer, "0123...");
  text.add("more").add(1).add(2.5).add('c');
  EXPECT_STREQ(buffer, "0123...");
}

TEST(Text, OfNothingIsEmpty) {
  char buffer[4] = {'x', 'x', 'x', 'x'};
  TextBuilder text(buffer, sizeof buffer);
  EXPECT_STREQ(buffer, "");
  EXPECT_TRUE(text.text().empty());
  TextBuilder nowhere(nullptr, 0);
  nowhere.add("text").add(1).add(1.5);
  EXPECT_TRUE(nowhere.text().empty());
}

TEST(Text, WritesDoublesShortAndReadable) {
  EXPECT_EQ(written(0.0), "0");
  EXPECT_EQ(written(-0.0), "0");  // a reader of messages has no use for the sign
  EXPECT_EQ(written(1.0), "1");
  EXPECT_EQ(written(2.5f), "2.5");
  EXPECT_EQ(written(-3.14159265), "-3.14159");
  EXPECT_EQ(written(0.1), "0.1");
  EXPECT_EQ(written(1e-4), "0.0001");
  EXPECT_EQ(written(1.5e-5), "1.5e-05");
  EXPECT_EQ(written(100000.0), "100000");
  EXPECT_EQ(written(999999.5), "1e+06");
  EXPECT_EQ(written(0.00099999996), "0.001");
  EXPECT_EQ(written(1e9), "1e+09");
  EXPECT_EQ(written(-1.7976931348623157e308), "-1.79769e+308");
  EXPECT_EQ(written(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(written(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(written(std::nan("")), "nan");
}

TEST(Text, WritesDoublesAsPrintfDoes) {
  for (int k = -20'000; k <= 20'000; ++k) {
    if (k == 0) continue;
    for (const double x : {k * 0.001, k * 0.5, k * 1234.5, k * 1e-9, static_cast<double>(k)}) {
      ASSERT_EQ(written(x), printed(x));
    }
  }
  for (int e = -307; e <= 307; ++e) {
    for (const char* digits : {"1", "1.5", "9.99999", "1.23456"}) {
      const double x = std::strtod(std::string(digits).append("e").append(std::to_string(e)).c_str(), nullptr);
      ASSERT_EQ(written(x), printed(x));
    }
  }
}

// Scaling takes up to 17 roundings: a relative error of 2e-15, up to 2e-9 of the last digit. One text in some hundred
// millions may end in a digit one off; of these 300,000 none does.
TEST(Text, WritesDoublesOfAnyMagnitudeAsPrintfDoes) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> mantissa(1, 2);
  std::uniform_int_distribution<int> exponent(-1074, 1023);
  for (int k = 0; k < 300'000; ++k) {
    const double x = std::ldexp(mantissa(random), exponent(random));
    if (x == 0) continue;
    ASSERT_EQ(written(x), printed(x));
  }
}

}  // namespace
