// Elementary functions whose results have the same bits with every compiler, processor and C library.
//
// Libraries agree on + - * / and the square root, which IEEE 754 rounds correctly, and on nothing else. So every
// function here is built of those five alone, in a stated order: an exact reduction of the argument to a small
// interval, then a Taylor series there, cut where its remainder is below 2^-56 of the result. Taylor's coefficients
// (1/3, 1/5, 1/5!) can be checked by eye, and on intervals this small the best polynomial would save a term or two.
// Where a rounding would be multiplied later (the logarithm inside a power), it is carried along as a second double.
//
// Exact: the square root (to the nearest), sine, cosine and tangent at multiples of 90 degrees, power(x, 0),
// power(x, 1) and small products. Approximate: all else, with the error that stands at each function; an ulp is 2^-52
// of the result's power of two. Accuracy ends where results are denormal. Nothing is stored but constants.
#pragma once

#include <cfloat>
#include <limits>

namespace shodo {

static_assert(std::numeric_limits<double>::is_iec559 && FLT_RADIX == 2 && DBL_MANT_DIG == 53);
static_assert(FLT_EVAL_METHOD == 0, "sums in wider registers (x87) change pixels: use -msse2 -mfpmath=sse or the like");
#ifdef __FAST_MATH__
#error "-ffast-math reorders sums and changes pixels"
#endif

inline constexpr double kPi = 0x1.921fb54442d18p+1;
inline constexpr double kTwoPi = 0x1.921fb54442d18p+2;
inline constexpr double kHalfPi = 0x1.921fb54442d18p+0;
inline constexpr double kInversePi = 0x1.45f306dc9c883p-2;
inline constexpr double kRadiansPerDegree = 0x1.1df46a2529d39p-6;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Correctly rounded by IEEE 754; not a number below 0.
inline double square_root(double x) { return __builtin_sqrt(x); }

/// |x|: the sign bit cleared, no comparison.
constexpr double magnitude(double x) { return __builtin_fabs(x); }

/// Radians in [-pi/2, pi/2]; relative error below 3e-16.
double arctangent(double x);

/// The angle of the vector (x, y) from the x axis, radians in (-pi, pi]; relative error below 4e-16.
/// arctangent2(|a x b|, a.b) is the angle between a and b. The zero vector has angle 0; a zero has no sign.
double arctangent2(double y, double x);

/// Of an angle in degrees of any size; error below 1 ulp, the tangent's below 3. Exact at multiples of 90, at sine 30
/// and 150, cosine 60 and 120, tangent 45; the tangent is +-infinity where the cosine is 0. An infinite angle gives
/// not a number.
double sine_degrees(double x);
double cosine_degrees(double x);
double tangent_degrees(double x);

/// e^x; relative error below 2e-16. 0 or infinity where a double ends.
double exponential(double x);

/// The natural logarithm; relative error below 2e-16. -infinity at 0, not a number below.
double logarithm(double x);

/// base^exponent for base >= 0 (not a number below 0); relative error below 1e-14, typically 3e-16.
/// power(x, 0) = 1, also for x = 0; power(0, n) = 0 for n > 0, infinity for n < 0.
/// Integers from 1 to 90 go by repeated squaring, and are exact as long as the products are.
double power(double base, double exponent);

}  // namespace shodo
