#include "base/elementary.h"

#include <bit>
#include <cstddef>
#include <cstdint>

namespace shodo {

namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// c0 + c1 z + c2 z^2 + ..., from the last coefficient down.
template <class... Rest>
inline double polynomial(double z, double c0, Rest... rest) {
  if constexpr (sizeof...(rest) == 0) {
    return c0;
  } else {
    return c0 + z * polynomial(z, rest...);
  }
}

/// 1/n!; n! is exact up to 18, so that the quotient is the nearest double.
constexpr double inverse_factorial(int n) {
  double product = 1;
  for (int k = 2; k <= n; ++k) product *= k;
  return 1 / product;
}
template <int n>
inline constexpr double kInverseFactorial = inverse_factorial(n);

// ---- numbers as sums of two doubles

/// high + low, low at most half an ulp of high.
struct Pair {
  double high;
  double low;
};

/// a + b exactly, if |a| >= |b| or a = 0.
Pair exact_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// The upper 26 bits of a; |a| < 2^996 (Veltkamp 1968).
double upper_half(double a) {
  const double scaled = 0x1.0000002p+27 * a;
  return scaled - (scaled - a);
}

/// a b exactly, while nothing overflows or gets denormal (Dekker 1971).
Pair exact_product(double a, double b) {
  const double product = a * b;
  const double a1 = upper_half(a), a2 = a - a1;
  const double b1 = upper_half(b), b2 = b - b1;
  return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

// ---- arctangent

// arctan(k/8), to the nearest, and what that leaves, computed to 300 bits. The last is pi/4.
constexpr Pair kArctangentOfEighths[9] = {
    {0, 0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};
constexpr double kHalfPiLow = 0x1.1a62633145c07p-54;
constexpr double kPiLow = 0x1.1a62633145c07p-53;

/// arctan q for 0 <= q <= 1. With c the nearest eighth, arctan q = arctan c + arctan t, t = (q - c) / (1 + c q),
/// |t| <= 1/16: the first term left out of the series is t^15/15, 2^-59 of t.
Pair first_octant(double q) {
  const int eighths = static_cast<int>(8 * q + 0.5);
  const double c = 0.125 * eighths;
  const double t = eighths == 0 ? q : (q - c) / (1 + c * q);
  const double z = t * t;
  const double series = t * z * polynomial(z, -1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13);
  const Pair sum = exact_sum(kArctangentOfEighths[eighths].high, t);
  return {sum.high, sum.low + (series + kArctangentOfEighths[eighths].low)};
}

/// The angle of (x, y), both at least 0 and not both 0, in [0, pi/2].
Pair first_quadrant(double y, double x) {
  if (y <= x) return first_octant(y / x);
  const Pair rest = first_octant(x / y);
  const Pair angle = exact_sum(kHalfPi, 0.0 - rest.high);
  return {angle.high, angle.low + (kHalfPiLow - rest.low)};
}

// ---- sine and cosine

/// x = 90 quadrant + the angle, which is within +-45 degrees and here in radians.
struct Reduced {
  Pair radians;
  unsigned quadrant;  // 0..3
};

/// Exact but for the last step: 90 n is an integer, and the difference a multiple of x's ulp not larger than x.
Reduced reduce_degrees(double x) {
  double rest = x;
  if (magnitude(x) >= 0x1p+50) {  // whole turns off, the largest power of two of them first; every difference is exact
    double turns = 360;
    while (turns <= 0.5 * magnitude(x)) turns *= 2;
    for (; turns >= 360; turns *= 0.5) {
      if (magnitude(rest) >= turns) rest -= rest < 0 ? 0.0 - turns : turns;
    }
  }
  const std::int64_t quarters = static_cast<std::int64_t>(rest / 90 + (rest < 0 ? -0.5 : 0.5));
  rest -= 90.0 * static_cast<double>(quarters);
  constexpr double kRadiansPerDegreeLow = 0x1.5c1d8becdd291p-62;
  Pair radians = exact_product(rest, kRadiansPerDegree);
  radians.low += rest * kRadiansPerDegreeLow;
  return {radians, static_cast<unsigned>(quarters & 3)};
}

/// |a| <= pi/4: the first term left out is a^19/19!, 2^-63 of a.
double sine_of(const Pair& a) {
  const double z = a.high * a.high;
  const double series =
      polynomial(z, -kInverseFactorial<3>, kInverseFactorial<5>, -kInverseFactorial<7>, kInverseFactorial<9>,
                 -kInverseFactorial<11>, kInverseFactorial<13>, -kInverseFactorial<15>, kInverseFactorial<17>);
  return a.high + (a.high * z * series + a.low * (1 - 0.5 * z));
}

/// |a| <= pi/4: the first term left out is a^18/18!, 2^-58. What 1 - z/2 loses in rounding is put back.
double cosine_of(const Pair& a) {
  const double z = a.high * a.high;
  const Pair head = exact_sum(1, -0.5 * z);
  const double series =
      polynomial(z, kInverseFactorial<4>, -kInverseFactorial<6>, kInverseFactorial<8>, -kInverseFactorial<10>,
                 kInverseFactorial<12>, -kInverseFactorial<14>, kInverseFactorial<16>);
  return head.high + (head.low + (z * z * series - a.high * a.low));
}

/// The sine of `quadrant` right angles plus a. 0 - s and s + 0 leave no negative zeros.
double sine_in_quadrant(const Pair& a, unsigned quadrant) {
  const double s = (quadrant & 1) != 0 ? cosine_of(a) : sine_of(a);
  return (quadrant & 2) != 0 ? 0.0 - s : s + 0.0;
}

bool finite(double x) { return x - x == 0; }

// ---- exponential and logarithm

constexpr double kLog2 = 0x1.62e42fefa3800p-1;     // log 2 cut to 42 bits: times an exponent, it is exact
constexpr double kLog2Low = 0x1.ef35793c76730p-45;  // the rest, to the nearest; what is lost is below 2^-97
constexpr double kInverseLog2 = 0x1.71547652b82fep+0;
constexpr double kSquareRootOf2 = 0x1.6a09e667f3bcdp+0;

/// 2^e for a normal result.
double power_of_two(int e) { return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52); }

/// e^(x.high + x.low) = 2^k e^r, |r| <= log 2 / 2: the first term left out is r^14/14!, 2^-57.
double exponential_of(const Pair& x) {
  if (x.high > 710) return kInfinity;
  if (x.high < -746) return 0;
  const int k = static_cast<int>(x.high * kInverseLog2 + (x.high < 0 ? -0.5 : 0.5));
  const double high = x.high - k * kLog2;
  const double low = x.low - k * kLog2Low;
  const double r = high + low;
  const double lost = low - (r - high);
  const double series =
      polynomial(r, kInverseFactorial<2>, kInverseFactorial<3>, kInverseFactorial<4>, kInverseFactorial<5>,
                 kInverseFactorial<6>, kInverseFactorial<7>, kInverseFactorial<8>, kInverseFactorial<9>,
                 kInverseFactorial<10>, kInverseFactorial<11>, kInverseFactorial<12>, kInverseFactorial<13>);
  const double value = 1 + (r + (r * r * series + lost));
  // In two steps, as k runs from -1076 to 1024; only the second can round.
  return value * power_of_two(k / 2) * power_of_two(k - k / 2);
}

/// x = 2^e m with sqrt(1/2) <= m <= sqrt(2), for a positive finite x.
struct Split {
  int e;
  double m;
};

Split split(double x) {
  const bool denormal = x < 0x1p-1022;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(denormal ? x * 0x1p+54 : x);
  int e = static_cast<int>(bits >> 52) - 1023 - (denormal ? 54 : 0);
  double m = std::bit_cast<double>((bits & 0xfffffffffffffu) | 0x3ff0000000000000u);
  if (m > kSquareRootOf2) {
    m *= 0.5;
    ++e;
  }
  return {e, m};
}

/// log x = e log 2 + 2 (s + s^3/3 + s^5/5 + ...), s = (m - 1) / (m + 1), |s| < 0.172: the first term left out is
/// s^23/23, 2^-60 of s. s is kept to twice the precision, its powers (at most 1 % of it) are not: relative error
/// about 5e-18 of the pair.
Pair logarithm_of(double x) {
  const Split parts = split(x);
  const double above = parts.m - 1;
  const double below = parts.m + 1;
  const double below_low = parts.m - (below - 1);
  const double s = above / below;
  const Pair product = exact_product(s, below);
  const double s_low = (((above - product.high) - product.low) - s * below_low) / below;
  const double z = s * s;
  const double series = s * z * polynomial(z, 1.0 / 3, 1.0 / 5, 1.0 / 7, 1.0 / 9, 1.0 / 11, 1.0 / 13, 1.0 / 15,
                                           1.0 / 17, 1.0 / 19, 1.0 / 21);
  const Pair sum = exact_sum(parts.e * kLog2, 2 * s);
  return exact_sum(sum.high, sum.low + (2 * (s_low + series) + parts.e * kLog2Low));
}

// Each product of a repeated squaring adds 2^-53: n <= 90 keeps the sum under 1e-14.
constexpr double kLargestSquaredExponent = 90;

/// base^n, n from 1, by squaring; no square is taken that the result doesn't use.
double integer_power(double base, unsigned n) {
  double square = base;
  while ((n & 1) == 0) {
    square *= square;
    n >>= 1;
  }
  double product = square;
  while ((n >>= 1) != 0) {
    square *= square;
    if ((n & 1) != 0) product *= square;
  }
  return product;
}

}  // namespace

double arctangent(double x) {
  if (x != x) return x;
  const Pair angle = first_quadrant(magnitude(x), 1);
  const double sum = angle.high + angle.low;
  return x < 0 ? 0.0 - sum : sum;
}

double arctangent2(double y, double x) {
  if (x != x || y != y) return kNotANumber;
  if (y == 0 && x == 0) return 0;
  if (!finite(x) && !finite(y)) return arctangent2(y < 0 ? -1 : 1, x < 0 ? -1 : 1);
  Pair angle = first_quadrant(magnitude(y), magnitude(x));
  if (x < 0) {
    const Pair rest = exact_sum(kPi, 0.0 - angle.high);
    angle = {rest.high, rest.low + (kPiLow - angle.low)};
  }
  const double sum = angle.high + angle.low;
  return y < 0 ? 0.0 - sum : sum;
}

double sine_degrees(double x) {
  if (!finite(x)) return kNotANumber;
  const Reduced a = reduce_degrees(x);
  return sine_in_quadrant(a.radians, a.quadrant);
}

double cosine_degrees(double x) {
  if (!finite(x)) return kNotANumber;
  const Reduced a = reduce_degrees(x);
  return sine_in_quadrant(a.radians, a.quadrant + 1);
}

double tangent_degrees(double x) {
  if (!finite(x)) return kNotANumber;
  const Reduced a = reduce_degrees(x);
  return sine_in_quadrant(a.radians, a.quadrant) / sine_in_quadrant(a.radians, a.quadrant + 1);
}

double exponential(double x) { return x != x ? x : exponential_of({x, 0}); }

double logarithm(double x) {
  if (!(x >= 0)) return kNotANumber;
  if (x == 0) return -kInfinity;
  return x == kInfinity ? x : logarithm_of(x).high;
}

double power(double base, double exponent) {
  if (!(base >= 0) || exponent != exponent) return kNotANumber;
  if (exponent == 0 || base == 1) return 1;
  if (base == 0 || base == kInfinity) return (base == 0) == (exponent > 0) ? 0 : kInfinity;
  if (exponent >= 1 && exponent <= kLargestSquaredExponent) {
    const unsigned n = static_cast<unsigned>(exponent);
    if (exponent == n) return integer_power(base, n);
  }
  const Pair log = logarithm_of(base);
  const double estimate = exponent * log.high;
  if (estimate > 710) return kInfinity;
  if (estimate < -746) return 0;
  const Pair product = exact_product(exponent, log.high);
  return exponential_of({product.high, product.low + exponent * log.low});
}

}  // namespace shodo
