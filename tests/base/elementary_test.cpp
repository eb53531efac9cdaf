// Against long double, whose functions are good to 1e-19, in ulps of the result: an ulp is at least 1.1e-16 of it.
#include "base/elementary.h"

#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace {

using namespace shodo;
using Real = long double;

constexpr Real kRealPi = 3.14159265358979323846264338327950288L;

// Where long double is double there is no truth to compare with; the bits are compared everywhere.
#define NEEDS_LONG_DOUBLE() \
  if (LDBL_MANT_DIG < 64) GTEST_SKIP() << "long double is no wider than double"

Real relative_error(double value, Real truth) {
  if (truth == 0) return value == 0 ? 0 : HUGE_VALL;
  return std::fabs((static_cast<Real>(value) - truth) / truth);
}

/// |value - truth| in units of 2^-52 of the truth's power of two.
Real ulps(double value, Real truth) {
  int e = 0;
  std::frexp(truth, &e);
  return std::fabs(static_cast<Real>(value) - truth) / std::ldexp(1.0L, e - 53);
}

class Largest {
 public:
  void see(Real error, double at) {
    if (error > error_ || std::isnan(error)) {
      error_ = error;
      at_ = at;
    }
  }
  double error() const { return static_cast<double>(error_); }
  double at() const { return at_; }

 private:
  Real error_ = 0;
  double at_ = 0;
};

void expect_below(const Largest& largest, double limit) {
  EXPECT_LT(largest.error(), limit) << "at " << largest.at();
  ::testing::Test::RecordProperty("attoparts", std::to_string(largest.error() * 1e18));
}

/// Doubles of any magnitude from 2^-e to 2^e.
class AnyMagnitude {
 public:
  explicit AnyMagnitude(int e) : exponent_(-e, e) {}
  double operator()() { return std::ldexp(mantissa_(random_), exponent_(random_)); }

 private:
  std::mt19937_64 random_{20};
  std::uniform_real_distribution<double> mantissa_{1, 2};
  std::uniform_int_distribution<int> exponent_;
};

TEST(SquareRoot, IsTheNearestDouble) {
  EXPECT_EQ(square_root(2), 0x1.6a09e667f3bcdp+0);
  EXPECT_EQ(square_root(0x1p-1074), 0x1p-537);
  EXPECT_EQ(square_root(9), 3);
}

TEST(Constants, AreTheNearestDoubles) {
  EXPECT_EQ(kPi, static_cast<double>(kRealPi));
  EXPECT_EQ(kTwoPi, static_cast<double>(2 * kRealPi));
  EXPECT_EQ(kHalfPi, static_cast<double>(kRealPi / 2));
  EXPECT_EQ(kInversePi, static_cast<double>(1 / kRealPi));
  EXPECT_EQ(kRadiansPerDegree, static_cast<double>(kRealPi / 180));
}

TEST(Arctangent, IsWithinTenToMinusFifteenOfTheTruth) {
  NEEDS_LONG_DOUBLE();
  Largest largest;
  for (int k = 1; k <= 2'000'000; ++k) {  // over [0, 2], and the inverses of it
    const double x = k * 1e-6;
    largest.see(relative_error(arctangent(x), std::atan(static_cast<Real>(x))), x);
    const double inverse = 1 / x;
    largest.see(relative_error(arctangent(inverse), std::atan(static_cast<Real>(inverse))), inverse);
  }
  AnyMagnitude any(1000);
  for (int k = 0; k < 200'000; ++k) {
    const double x = any();
    largest.see(relative_error(arctangent(x), std::atan(static_cast<Real>(x))), x);
  }
  expect_below(largest, 3e-16);  // what the header says; the design allows 1e-15
}

TEST(Arctangent, IsGoodOnBothSidesOfEveryPieceOfItsReduction) {
  NEEDS_LONG_DOUBLE();
  Largest largest;
  for (int k = 1; k <= 16; ++k) {
    for (int side = -100; side <= 100; ++side) {
      const double x = k / 16.0 * (1 + side * 0x1p-52);
      largest.see(relative_error(arctangent(x), std::atan(static_cast<Real>(x))), x);
    }
  }
  expect_below(largest, 3e-16);
}

TEST(Arctangent, IsOddAndEndsAtHalfPi) {
  for (const double x : {0.0, 1e-300, 0.01, 0.3, 1.0, 7.0, 1e300}) EXPECT_EQ(arctangent(-x), -arctangent(x)) << x;
  EXPECT_EQ(arctangent(1), kPi / 4);
  EXPECT_EQ(arctangent(kInfinity), kHalfPi);
  EXPECT_EQ(arctangent(-kInfinity), -kHalfPi);
  EXPECT_EQ(arctangent(1e-310), 1e-310);
  EXPECT_TRUE(std::isnan(arctangent(std::nan(""))));
}

TEST(Arctangent2, IsWithinTenToMinusFifteenOfTheTruthAllRound) {
  NEEDS_LONG_DOUBLE();
  Largest largest;
  AnyMagnitude any(60);
  for (int k = 0; k < 500'000; ++k) {
    const double y = (k & 1) != 0 ? any() : -any(), x = (k & 2) != 0 ? any() : -any();
    largest.see(relative_error(arctangent2(y, x), std::atan2(static_cast<Real>(y), static_cast<Real>(x))), y / x);
  }
  for (int k = 1; k < 1'000'000; ++k) {  // a dense half turn, both coordinates inexact
    const double turn = k * 1e-6 * kPi, y = std::sin(turn), x = std::cos(turn);
    largest.see(relative_error(arctangent2(y, x), std::atan2(static_cast<Real>(y), static_cast<Real>(x))), turn);
  }
  expect_below(largest, 4e-16);
}

TEST(Arctangent2, IsExactOnAxesAndDiagonals) {
  EXPECT_EQ(arctangent2(0, 2), 0);
  EXPECT_EQ(arctangent2(3, 0), kHalfPi);
  EXPECT_EQ(arctangent2(0, -2), kPi);
  EXPECT_EQ(arctangent2(-0.0, -2), kPi);  // the interval is open at -pi
  EXPECT_EQ(arctangent2(-3, 0), -kHalfPi);
  EXPECT_EQ(arctangent2(5, 5), kPi / 4);
  EXPECT_EQ(arctangent2(5, -5), static_cast<double>(3 * kRealPi / 4));
  EXPECT_EQ(arctangent2(-5, -5), -static_cast<double>(3 * kRealPi / 4));
  EXPECT_EQ(arctangent2(0, 0), 0);
  EXPECT_EQ(arctangent2(-0.0, -0.0), 0);
  EXPECT_EQ(arctangent2(kInfinity, kInfinity), kPi / 4);
  EXPECT_EQ(arctangent2(1, kInfinity), 0);
  EXPECT_EQ(arctangent2(1, -kInfinity), kPi);
  EXPECT_EQ(arctangent2(1e308, 1e-308), kHalfPi);
  EXPECT_EQ(arctangent2(0x1p-1074, 0x1p-1074), kPi / 4);
  EXPECT_TRUE(std::isnan(arctangent2(std::nan(""), 1)));
}

TEST(Degrees, AreExactAtMultiplesOf90) {
  for (int quarter = -4000; quarter <= 4000; ++quarter) {
    const double sines[4] = {0, 1, 0, -1};
    const double x = 90.0 * quarter;
    EXPECT_EQ(sine_degrees(x), sines[quarter & 3]) << x;
    EXPECT_EQ(cosine_degrees(x), sines[(quarter + 1) & 3]) << x;
    EXPECT_FALSE(std::signbit(sine_degrees(x)) && sine_degrees(x) == 0) << x;
    EXPECT_EQ(tangent_degrees(x), (quarter & 1) == 0 ? 0 : sines[quarter & 3] * kInfinity) << x;
  }
}

TEST(Degrees, AreExactWhereTheResultIsAHalfOrOne) {
  for (int turn = -360000; turn <= 360000; turn += 360) {
    EXPECT_EQ(sine_degrees(turn + 30), 0.5);
    EXPECT_EQ(sine_degrees(turn + 150), 0.5);
    EXPECT_EQ(sine_degrees(turn - 30), -0.5);
    EXPECT_EQ(cosine_degrees(turn + 60), 0.5);
    EXPECT_EQ(cosine_degrees(turn - 60), 0.5);
    EXPECT_EQ(cosine_degrees(turn + 120), -0.5);
    EXPECT_EQ(tangent_degrees(turn + 45), 1);
    EXPECT_EQ(tangent_degrees(turn - 45), -1);
    EXPECT_EQ(tangent_degrees(turn + 135), -1);
  }
  EXPECT_FALSE(std::signbit(sine_degrees(-0.0)));
  EXPECT_EQ(sine_degrees(45), 0x1.6a09e667f3bcdp-1);
  EXPECT_EQ(cosine_degrees(45), 0x1.6a09e667f3bcdp-1);
  EXPECT_EQ(cosine_degrees(30), 0x1.bb67ae8584caap-1);
  EXPECT_EQ(sine_degrees(60), 0x1.bb67ae8584caap-1);
}

/// x, which is within +-2^50, less the nearest multiple of 90; exact.
struct Turned {
  Real radians;
  int quadrant;
};
Turned turned(double x) {
  const double quarters = std::nearbyint(x / 90);
  const double rest = x - 90 * quarters;
  return {static_cast<Real>(rest) * kRealPi / 180, static_cast<int>(static_cast<long long>(quarters) & 3)};
}
Real true_sine(double x, int add) {
  const Turned t = turned(x);
  const int quadrant = (t.quadrant + add) & 3;
  const Real value = (quadrant & 1) != 0 ? std::cos(t.radians) : std::sin(t.radians);
  return (quadrant & 2) != 0 ? -value : value;
}

TEST(Degrees, AreWithinAnUlpUpToAThousandTurns) {
  NEEDS_LONG_DOUBLE();
  Largest sine, cosine, tangent;
  std::mt19937_64 random(7);
  for (int k = 0; k < 600'000; ++k) {
    const double limit = k % 3 == 0 ? 1 : k % 3 == 1 ? 360 : 360000;
    const double x = std::uniform_real_distribution<double>(-limit, limit)(random);
    sine.see(ulps(sine_degrees(x), true_sine(x, 0)), x);
    cosine.see(ulps(cosine_degrees(x), true_sine(x, 1)), x);
    tangent.see(ulps(tangent_degrees(x), true_sine(x, 0) / true_sine(x, 1)), x);
  }
  for (int k = -3600; k < 3600; ++k) {
    if (k % 900 == 0) continue;
    const double x = k * 0.1;
    sine.see(ulps(sine_degrees(x), true_sine(x, 0)), x);
    cosine.see(ulps(cosine_degrees(x), true_sine(x, 1)), x);
  }
  EXPECT_LT(sine.error(), 1) << "ulps, at " << sine.at();
  EXPECT_LT(cosine.error(), 1) << "ulps, at " << cosine.at();
  EXPECT_LT(tangent.error(), 3) << "ulps, at " << tangent.at();
}

TEST(Degrees, ReduceHugeAnglesExactly) {
  for (const double x : {0x1p+50, 0x1.23456789abcdep+60, 0x1.fffffffffffffp+200, 1e22, -1e100, 1.7e308}) {
    const double rest = std::fmod(x, 360.0);
    EXPECT_EQ(sine_degrees(x), sine_degrees(rest)) << x;
    EXPECT_EQ(cosine_degrees(x), cosine_degrees(rest)) << x;
  }
  EXPECT_EQ(sine_degrees(360 * 0x1p+60 + 0x1p+59 * 180), 0);
  EXPECT_TRUE(std::isnan(sine_degrees(kInfinity)));
  EXPECT_TRUE(std::isnan(cosine_degrees(-kInfinity)));
  EXPECT_TRUE(std::isnan(tangent_degrees(std::nan(""))));
}

TEST(Exponential, IsWithin2e16OfTheTruth) {
  NEEDS_LONG_DOUBLE();
  Largest largest;
  std::mt19937_64 random(8);
  for (int k = 0; k < 600'000; ++k) {
    const double limit = k % 3 == 0 ? 1e-3 : k % 3 == 1 ? 2 : 708;
    const double x = std::uniform_real_distribution<double>(-limit, limit)(random);
    largest.see(relative_error(exponential(x), std::exp(static_cast<Real>(x))), x);
  }
  expect_below(largest, 2e-16);
}

TEST(Exponential, EndsWhereDoublesEnd) {
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(709.79), kInfinity);
  EXPECT_LT(exponential(709.78), kInfinity);
  EXPECT_GT(exponential(709.78), 1.79e308);
  EXPECT_EQ(exponential(-745), 0x1p-1074);
  EXPECT_EQ(exponential(-746), 0);
  EXPECT_EQ(exponential(kInfinity), kInfinity);
  EXPECT_EQ(exponential(-kInfinity), 0);
  EXPECT_TRUE(std::isnan(exponential(std::nan(""))));
  EXPECT_NEAR(exponential(-740) / 0x1p-1074, 84.8, 0.5);  // denormal: a whole number of the least ones
}

TEST(Logarithm, IsWithin2e16OfTheTruth) {
  NEEDS_LONG_DOUBLE();
  Largest largest;
  AnyMagnitude any(1000);
  std::mt19937_64 random(9);
  for (int k = 0; k < 600'000; ++k) {
    const double near_one = std::uniform_real_distribution<double>(0.5, 2)(random);
    for (const double x : {any(), near_one, 1 + (near_one - 1) * 1e-6}) {
      largest.see(relative_error(logarithm(x), std::log(static_cast<Real>(x))), x);
    }
  }
  expect_below(largest, 2e-16);
  EXPECT_EQ(logarithm(0x1p-1074), static_cast<double>(-1074 * std::log(2.0L)));
}

TEST(Logarithm, HasItsLimits) {
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(logarithm(0), -kInfinity);
  EXPECT_EQ(logarithm(-0.0), -kInfinity);
  EXPECT_EQ(logarithm(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(logarithm(-1)));
  EXPECT_TRUE(std::isnan(logarithm(std::nan(""))));
}

TEST(Power, IsWithin1e14OfTheTruthInTheWholeNormalRange) {
  NEEDS_LONG_DOUBLE();
  Largest largest;
  AnyMagnitude any(1000);
  std::mt19937_64 random(10);
  for (int k = 0; k < 1'000'000; ++k) {
    const double base = (k & 1) != 0 ? any() : std::uniform_real_distribution<double>(0, 3)(random);
    const double limit = 708 / std::fabs(std::log(base));  // |exponent log base| < 708: the result is normal
    const double exponent = std::uniform_real_distribution<double>(-limit, limit)(random);
    largest.see(relative_error(power(base, exponent), std::pow(static_cast<Real>(base), static_cast<Real>(exponent))),
                base);
  }
  expect_below(largest, 1e-14);
}

TEST(Power, IsWithin4e16ForTheDisplayCurveAndForCosines) {
  NEEDS_LONG_DOUBLE();
  Largest largest;
  std::mt19937_64 random(11);
  for (int k = 1; k <= 300'000; ++k) {
    const double base = k / 300'000.0;
    const double n = std::uniform_real_distribution<double>(0.01, 5)(random);
    for (const double exponent : {2.4, 1 / 2.4, n}) {
      const Real truth = std::pow(static_cast<Real>(base), static_cast<Real>(exponent));
      largest.see(relative_error(power(base, exponent), truth), base);
    }
  }
  expect_below(largest, 4e-16);
}

TEST(Power, StaysWithin1e14ForIntegersSquaredOrNot) {
  NEEDS_LONG_DOUBLE();
  Largest largest;
  std::mt19937_64 random(12);
  for (int n = 1; n <= 200; ++n) {
    for (int k = 0; k < 3'000; ++k) {
      const double base = std::uniform_real_distribution<double>(0.01, 4)(random);
      const Real truth = std::pow(static_cast<Real>(base), static_cast<Real>(n));
      if (truth < static_cast<Real>(DBL_MIN)) continue;
      largest.see(relative_error(power(base, n), truth), base);
    }
  }
  expect_below(largest, 1e-14);
}

TEST(Power, IsExactForSmallIntegersAndHasItsLimits) {
  EXPECT_EQ(power(3, 4), 81);
  EXPECT_EQ(power(1.5, 3), 3.375);
  EXPECT_EQ(power(0.7, 1), 0.7);
  EXPECT_EQ(power(0.7, 2), 0.7 * 0.7);
  EXPECT_EQ(power(2, 64), 0x1p+64);
  EXPECT_EQ(power(0x1p-500, 2), 0x1p-1000);
  EXPECT_EQ(power(5, 0), 1);
  EXPECT_EQ(power(0, 0), 1);
  EXPECT_EQ(power(0, 0.3), 0);
  EXPECT_EQ(power(0, 7), 0);
  EXPECT_EQ(power(0, -1), kInfinity);
  EXPECT_EQ(power(1, 1e300), 1);
  EXPECT_EQ(power(0.5, 1e300), 0);
  EXPECT_EQ(power(2, 1e300), kInfinity);
  EXPECT_EQ(power(kInfinity, -2), 0);
  EXPECT_EQ(power(kInfinity, 2), kInfinity);
  EXPECT_EQ(power(0.5, kInfinity), 0);
  EXPECT_EQ(power(1 + 0x1p-52, -kInfinity), 0);
  EXPECT_EQ(power(10, 400), kInfinity);
  EXPECT_EQ(power(10, -400), 0);
  EXPECT_TRUE(std::isnan(power(-0.5, 2)));
  EXPECT_TRUE(std::isnan(power(0.5, std::nan(""))));
}

TEST(Power, OfADenormalIsTakenFromItsTrueValue) {
  EXPECT_EQ(power(0x1p-1074, 0.5), 0x1p-537);
  EXPECT_EQ(power(0x1p-1074, -0.5), 0x1p+537);
}

/// FNV-1a of the bits, byte order aside.
class BitHash {
 public:
  void add(double x) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    for (int shift = 0; shift < 64; shift += 8) hash_ = (hash_ ^ ((bits >> shift) & 0xff)) * 0x100000001b3u;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

// Change the constant only in a commit that means to change results.
TEST(Elementary, GivesTheSameBitsEverywhere) {
  BitHash hash;
  for (int k = -20'000; k <= 20'000; ++k) {
    const double x = k * 0x1.999999999999ap-9;
    hash.add(arctangent(x));
    hash.add(arctangent2(x, 1 - x));
    hash.add(sine_degrees(17 * x));
    hash.add(cosine_degrees(17 * x));
    hash.add(tangent_degrees(17 * x));
    hash.add(exponential(x));
    if (k <= 0) continue;
    hash.add(square_root(x));
    hash.add(logarithm(x));
    hash.add(power(x, 2.4));
    hash.add(power(x, 1 / 2.4));
    hash.add(power(x, k % 100));
  }
  EXPECT_EQ(hash.value(), 0xcdb0454cc4277b26u);
}

}  // namespace
