// No header of ours but self_check.h: this file must also compile where elementary.h refuses to.
#include "base/self_check.h"

#include <bit>
#include <cstddef>
#include <cstdint>

namespace shodo {

namespace {

static_assert(sizeof(float) == 4 && sizeof(double) == 8 && sizeof(std::int64_t) == 8);

// What a compiler can't know it can't compute in advance with its own, right, arithmetic: operands are volatile.
using D = volatile double;
using F = volatile float;
using I64 = volatile std::int64_t;
using U64 = volatile std::uint64_t;

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

struct Sample {
  char operation;  // + - * / and r, the square root of a
  double a, b, answer;
};

/// Answers next to a tie: rounded another way, or first to more digits and then to these, they come out otherwise.
constexpr Sample kRounded[] = {
    {'+', 1, 0x1p-53, 1},
    {'+', 1, 0x1.8p-52, 0x1.0000000000002p+0},
    {'+', 1, 0x1.0000000000001p-53, 0x1.0000000000001p+0},
    {'+', -1, -0x1p-53, -1},
    {'-', 1, 0x1p-54, 1},
    {'-', -1, 0x1.8p-52, -0x1.0000000000002p+0},
    {'*', 0x1.0000001p+0, 0x1.0000001p+0, 0x1.0000002p+0},
    {'*', 0x1.0000004p+0, 0x1.ffffff8000003p-1, 0x1.0000000000001p+0},
    {'*', 0x1.0000000000001p+0, 0x1.8p+0, 0x1.8000000000002p+0},
    {'/', 1, 3, 0x1.5555555555555p-2},
    {'/', 1, 10, 0x1.999999999999ap-4},
    {'/', 1, 0x1.fffffffffffffp-1, 0x1.0000000000001p+0},
    {'+', 0x1.fffffffffffffp+1023, 0x1.fffffffffffffp+969, 0x1.fffffffffffffp+1023},
};

constexpr Sample kRoots[] = {
    {'r', 2, 0, 0x1.6a09e667f3bcdp+0},
    {'r', 3, 0, 0x1.bb67ae8584caap+0},
    {'r', 0x1.fffffffffffffp-1, 0, 0x1.fffffffffffffp-1},
    {'r', 0x1.0000000000001p+0, 0, 1},
    {'r', 0x1.0000000000003p+0, 0, 0x1.0000000000001p+0},
    {'r', 0x1p-1074, 0, 0x1p-537},
    {'r', 0x1.fffffffffffffp+1023, 0, 0x1.fffffffffffffp+511},
};

/// Results, then operands below 2^-1022. The third is just above a tie of the denormal's shorter fraction.
constexpr Sample kDenormal[] = {
    {'*', 0x1p-1022, 0.5, 0x1p-1023},
    {'-', 0x1.0000000000001p-1022, 0x1p-1022, 0x1p-1074},
    {'*', 0x1.0000004p-500, 0x1.ffffff8000004p-524, 0x1.0000000000002p-1023},
    {'*', 0x1p-1074, 0x1p+60, 0x1p-1014},
    {'+', 0x1p-1074, 0x1p-1074, 0x1p-1073},
    {'/', 0x1p-1074, 0x1p-1074, 1},
};

double compute(const Sample& sample) {
  D a = sample.a, b = sample.b;
  D result = 0;
  switch (sample.operation) {
    case '+': result = a + b; break;
    case '-': result = a - b; break;
    case '*': result = a * b; break;
    case '/': result = a / b; break;
    default: result = __builtin_sqrt(a); break;
  }
  return result;
}

template <std::size_t n>
bool right(const Sample (&samples)[n]) {
  for (const Sample& sample : samples) {
    if (!same(compute(sample), sample.answer)) return false;
  }
  return true;
}

/// Two operations in one expression, whose first result has no name: it must be rounded all the same.
bool keeps_no_excess() {
  D one = 1, tiny = 0x1p-60, huge = 0x1p+1023, two = 2;
  F large = 16777216.0f, small = 1.0f;
  const double lost = (one + tiny) - one;
  const double beyond = (huge * two) / two;
  const float lost_too = (large + small) - large;
  return same(lost, 0.0) && beyond > huge && same(lost_too, 0.0f);
}

/// a a = 1 + 2^-26 + 2^-54, of which the last is rounded off before anything is added.
bool fuses_nothing() {
  D a = 0x1.0000002p+0, c = -0x1.0000004p+0;
  F b = 0x1.001p+0f, d = -0x1.002p+0f;
  return same(a * a + c, 0.0) && same(c + a * a, 0.0) && same(b * b + d, 0.0f);
}

bool floats_are_right() {
  F one = 1, half_step = 0x1p-24f, third = 3, least = 0x1p-126f, half = 0.5f, denormal = 0x1p-149f;
  D tie = 1 + 0x1p-24, above = 1 + 0x1p-24 + 0x1p-52, small = 0x1.8p-150;
  return same(one + half_step, 1.0f) && same(one / third, 0x1.555556p-2f) && same(least * half, 0x1p-127f) &&
         same(denormal + denormal, 0x1p-148f) && same(static_cast<float>(tie), 1.0f) &&
         same(static_cast<float>(above), 0x1.000002p+0f) && same(static_cast<float>(small), 0x1p-149f) &&
         same(static_cast<double>(denormal), 0x1p-149);
}

bool conversions_are_right() {
  I64 odd = (std::int64_t{1} << 53) + 1, most = INT64_MAX, minus_odd = -((std::int64_t{1} << 53) + 3);
  U64 above_tie = 0x8000000000000401u, tie = 0xfffffffffffffc00u;
  D minus = -2.75, large = 0x1.fffffffffffffp+62, most32 = 4294967295.75, large_unsigned = 0x1.8p+63;
  return same(static_cast<double>(odd), 0x1p+53) && same(static_cast<double>(most), 0x1p+63) &&
         same(static_cast<double>(minus_odd), -0x1.0000000000002p+53) &&
         same(static_cast<double>(above_tie), 0x1.0000000000001p+63) && same(static_cast<double>(tie), 0x1p+64) &&
         static_cast<std::int64_t>(minus) == -2 && static_cast<std::int32_t>(minus) == -2 &&
         static_cast<std::int64_t>(large) == 0x7ffffffffffffc00 &&
         static_cast<std::uint32_t>(most32) == 0xffffffffu &&
         static_cast<std::uint64_t>(large_unsigned) == 0xc000000000000000u;
}

bool integers_are_right() {
  I64 minus = -7, wide = -0x123456789abcdef;
  U64 factor = 0xfedcba9876543210u, one = 1;
  return minus / 2 == -3 && minus % 2 == -1 && minus >> 1 == -4 && wide >> 40 == -0x12346 &&
         factor * static_cast<std::uint64_t>(wide) == 0xddc927701a9e7310u &&
         factor / 1000000007u == 0x4469ff98fu && std::countl_zero(static_cast<std::uint64_t>(one)) == 63;
}

bool specials_are_right() {
  D zero = 0, minus_zero = -0.0, one = 1;
  D infinity = one / zero, nothing = infinity - infinity;
  return infinity > 0x1.fffffffffffffp+1023 && one / minus_zero < 0 && zero == minus_zero && nothing != nothing &&
         !(nothing >= zero) && !(nothing < zero);
}

}  // namespace

const char* arithmetic_fault() {
  if (!integers_are_right()) return "integers of 64 bits in two's complement";
  if (!right(kRounded)) return "doubles rounded once, to the nearest, ties to even";
  if (!keeps_no_excess()) return "no result kept in a wider register";
  if (!fuses_nothing()) return "products rounded before they are added";
  if (!right(kDenormal)) return "doubles below 2^-1022 kept, not made zero";
  if (!right(kRoots)) return "square roots rounded to the nearest";
  if (!floats_are_right()) return "floats rounded once, to the nearest, those below 2^-126 kept";
  if (!conversions_are_right()) return "exact conversions, or to the nearest, between integers and doubles";
  if (!specials_are_right()) return "infinities, and what is not a number, as in IEEE 754";
  return nullptr;
}

}  // namespace shodo
