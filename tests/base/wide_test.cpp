// Twin: the compiler's own 128-bit integers, on machines that have them.
#include "base/wide.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace {

using namespace shodo;

constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

/// Values of every length from 1 to 64 bits.
class AnyLength {
 public:
  std::int64_t operator()() { return static_cast<std::int64_t>(random_()) >> (random_() % 64); }
  Int128 wide_value() {
    const std::int64_t high = static_cast<std::int64_t>(random_());
    const std::uint64_t low = random_();
    return Int128(high, low) >> static_cast<unsigned>(random_() % 128);
  }

 private:
  std::mt19937_64 random_{5};
};

TEST(Division, SaturatesWhereTheQuotientDoesNotFit) {
  EXPECT_EQ(floor_divide(Int128(kLeast), -1), kMost);
  EXPECT_EQ(ceil_divide(Int128(kLeast), -1), kMost);
  EXPECT_EQ(floor_divide(Int128(kLeast), 1), kLeast);
  EXPECT_EQ(floor_divide(Int128(1, 0), 1), kMost);
  EXPECT_EQ(floor_divide(Int128(-2, 0), 1), kLeast);
  EXPECT_EQ(ceil_divide(Int128(1, 0), -1), kLeast);
}

TEST(Fractions, AreComparedExactly) {
  EXPECT_TRUE(less_fraction(kMost - 1, kMost, 1, 1));
  EXPECT_FALSE(less_fraction(1, 1, 1, 1));
  EXPECT_TRUE(less_fraction(kMost - 2, kMost - 1, kMost - 1, kMost));  // they differ by 1e-38
  EXPECT_FALSE(less_fraction(kMost - 1, kMost, kMost - 2, kMost - 1));
  EXPECT_TRUE(less_fraction(kLeast, 1, kLeast, 2));
}

// Where there is no twin, its results: FNV-1a over products and quotients.
TEST(Wide, GivesTheSameResultsEverywhere) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) hash = (hash ^ ((word >> shift) & 0xff)) * 0x100000001b3u;
  };
  AnyLength any;
  for (int k = 0; k < 20'000; ++k) {
    const std::int64_t a = any(), b = any();
    const Int128 c = any.wide_value();
    const Int128 sum = multiply(a, b) + c;
    const Int192 product = multiply(c, b);
    for (const std::int64_t word : {sum.high, product.high}) add(static_cast<std::uint64_t>(word));
    for (const std::uint64_t word : {sum.low, product.middle, product.low}) add(word);
    if (b == 0) continue;
    add(static_cast<std::uint64_t>(floor_divide(c, b)));
    add(static_cast<std::uint64_t>(ceil_divide(multiply(a, b), b)));
  }
  EXPECT_EQ(hash, 0x9aae11e02a8a9477u);
}

#ifdef __SIZEOF_INT128__

__extension__ typedef __int128 Native;
__extension__ typedef unsigned __int128 NativeUnsigned;

Native native(const Int128& a) {
  return static_cast<Native>((static_cast<NativeUnsigned>(static_cast<std::uint64_t>(a.high)) << 64) | a.low);
}
Int128 wide(Native a) {
  return {static_cast<std::int64_t>(a >> 64), static_cast<std::uint64_t>(static_cast<NativeUnsigned>(a))};
}
int sign_of(Native a) { return a < 0 ? -1 : a > 0 ? 1 : 0; }

/// The floor and the ceiling of a / b, cut to 64 bits.
std::int64_t cut(Native a) {
  return a < kLeast ? kLeast : a > kMost ? kMost : static_cast<std::int64_t>(a);
}
std::int64_t true_floor(Native a, std::int64_t b) {
  const Native quotient = a / b, rest = a % b;
  return cut(rest != 0 && (rest < 0) != (b < 0) ? quotient - 1 : quotient);
}
std::int64_t true_ceil(Native a, std::int64_t b) {
  const Native quotient = a / b, rest = a % b;
  return cut(rest != 0 && (rest < 0) == (b < 0) ? quotient + 1 : quotient);
}

/// The ends of the range, powers of two and their neighbours.
std::vector<std::int64_t> extremes() {
  std::vector<std::int64_t> all = {0, kLeast, kLeast + 1, kMost};
  for (int bit = 0; bit < 63; ++bit) {
    for (const int near : {-1, 0, 1}) {
      const std::int64_t value = (std::int64_t{1} << bit) + near;
      all.push_back(value);
      all.push_back(-value);
    }
  }
  return all;
}

void expect_sums(const Int128& a, const Int128& b) {
  const NativeUnsigned x = static_cast<NativeUnsigned>(native(a)), y = static_cast<NativeUnsigned>(native(b));
  ASSERT_EQ(a + b, wide(static_cast<Native>(x + y)));
  ASSERT_EQ(a - b, wide(static_cast<Native>(x - y)));
  ASSERT_EQ(-a, wide(static_cast<Native>(0 - x)));
  ASSERT_EQ(a < b, native(a) < native(b));
  ASSERT_EQ(a == b, native(a) == native(b));
  ASSERT_EQ(a >= b, native(a) >= native(b));
  ASSERT_EQ(sign(a), sign_of(native(a)));
  ASSERT_EQ(fits_64(a), native(a) >= kLeast && native(a) <= kMost);
}

TEST(Int128, AddsSubtractsAndComparesAsTheCompilersOwn) {
  for (const std::int64_t a : extremes()) {
    for (const std::int64_t b : extremes()) {
      expect_sums(Int128(a, static_cast<std::uint64_t>(b)), Int128(b, static_cast<std::uint64_t>(a)));
      expect_sums(Int128(a), Int128(b));
    }
  }
  AnyLength any;
  for (int k = 0; k < 200'000; ++k) expect_sums(any.wide_value(), any.wide_value());
}

TEST(Int128, ShiftsAsTheCompilersOwn) {
  AnyLength any;
  for (int k = 0; k < 2'000; ++k) {
    const Int128 a = any.wide_value();
    for (unsigned n = 0; n < 128; ++n) {
      ASSERT_EQ(a << n, wide(static_cast<Native>(static_cast<NativeUnsigned>(native(a)) << n))) << n;
      ASSERT_EQ(a >> n, wide(native(a) >> n)) << n;
    }
  }
}

TEST(Int128, IsTheExactProduct) {
  for (const std::int64_t a : extremes()) {
    for (const std::int64_t b : extremes()) {
      ASSERT_EQ(multiply(a, b), wide(static_cast<Native>(a) * b)) << a << " " << b;
    }
  }
  AnyLength any;
  for (int k = 0; k < 1'000'000; ++k) {
    const std::int64_t a = any(), b = any();
    ASSERT_EQ(multiply(a, b), wide(static_cast<Native>(a) * b)) << a << " " << b;
  }
}

/// Schoolbook product in two's complement of 192 bits, by 64 shifted sums: slow and obvious.
Int192 slow_product(const Int128& a, std::int64_t b) {
  std::uint64_t sum[3] = {0, 0, 0};
  std::uint64_t term[3] = {a.low, static_cast<std::uint64_t>(a.high), static_cast<std::uint64_t>(a.high >> 63)};
  for (int bit = 0; bit < 192; ++bit) {
    if (((bit < 64 ? b >> bit : b >> 63) & 1) != 0) {
      NativeUnsigned carry = 0;
      for (int k = 0; k < 3; ++k) {
        carry += static_cast<NativeUnsigned>(sum[k]) + term[k];
        sum[k] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
      }
    }
    term[2] = (term[2] << 1) | (term[1] >> 63);
    term[1] = (term[1] << 1) | (term[0] >> 63);
    term[0] <<= 1;
  }
  return {static_cast<std::int64_t>(sum[2]), sum[1], sum[0]};
}

TEST(Int192, IsTheExactProduct) {
  for (const std::int64_t a : extremes()) {
    for (const std::int64_t b : extremes()) {
      for (const Int128& wide_a : {Int128(a), Int128(a, static_cast<std::uint64_t>(b))}) {
        ASSERT_EQ(multiply(wide_a, b), slow_product(wide_a, b)) << a << " " << b;
      }
    }
  }
  AnyLength any;
  for (int k = 0; k < 100'000; ++k) {
    const Int128 a = any.wide_value();
    const std::int64_t b = any();
    const Int192 product = multiply(a, b);
    ASSERT_EQ(product, slow_product(a, b));
    ASSERT_EQ(sign(product), sign(a) * (b < 0 ? -1 : b > 0 ? 1 : 0));
  }
}

TEST(Int192, IsOrderedAsItsFactorsAre) {
  AnyLength any;
  for (int k = 0; k < 100'000; ++k) {
    const Int128 a = any.wide_value(), b = any.wide_value();
    const std::int64_t factor = any();
    if (factor == 0) continue;
    ASSERT_EQ(multiply(a, factor) < multiply(b, factor), factor > 0 ? a < b : b < a);
    ASSERT_EQ(multiply(a, factor) == multiply(b, factor), a == b);
  }
}

void expect_quotients(const Int128& a, std::int64_t b) {
  if (b == 0) return;
  const Native n = native(a);
  if (n == native(Int128(kLeast, 0)) && b == -1) {  // 2^127: the twin overflows
    ASSERT_EQ(floor_divide(a, b), kMost);
    ASSERT_EQ(ceil_divide(a, b), kMost);
    return;
  }
  ASSERT_EQ(floor_divide(a, b), true_floor(n, b)) << a.high << " " << a.low << " / " << b;
  ASSERT_EQ(ceil_divide(a, b), true_ceil(n, b)) << a.high << " " << a.low << " / " << b;
}

TEST(Division, IsTheFloorAndTheCeilingOfTheTruth) {
  for (const std::int64_t a : extremes()) {
    for (const std::int64_t b : extremes()) {
      expect_quotients(Int128(a), b);
      expect_quotients(Int128(a, static_cast<std::uint64_t>(b)), b);
      expect_quotients(Int128(b, static_cast<std::uint64_t>(a)), a);
      if (HasFatalFailure()) return;
    }
  }
  AnyLength any;
  for (int k = 0; k < 500'000; ++k) {
    expect_quotients(any.wide_value(), any());
    if (HasFatalFailure()) return;
  }
}

TEST(Division, IsRightNextToWholeQuotientsAndAtTheLimits) {
  AnyLength any;
  for (int k = 0; k < 500'000; ++k) {
    const std::int64_t quotient = k % 5 == 0 ? kMost : k % 5 == 1 ? kLeast : any();
    const std::int64_t b = any();
    for (const int near : {-1, 0, 1}) expect_quotients(multiply(quotient, b) + Int128(near), b);
    if (HasFatalFailure()) return;
  }
}

TEST(Fractions, AreComparedAsTheirProducts) {
  for (const std::int64_t a : extremes()) {
    for (const std::int64_t b : extremes()) {
      const std::int64_t da = b > 0 ? b : kMost, db = a > 0 ? a : 1;
      ASSERT_EQ(less_fraction(a, da, b, db), static_cast<Native>(a) * db < static_cast<Native>(b) * da);
    }
  }
}

#endif

}  // namespace
