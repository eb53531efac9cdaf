// Reads the values of a scene file's statements: numbers, points, colours, counts, names (contract 2).
//
// All return false after leaving a message with the Words. Numbers are decimal and correctly rounded (base/decimal.h),
// within +-10^30, so that products of four coordinates stay finite; -0 and denormals are numbers.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/vector.h"
#include "scene/words.h"

namespace shodo {

/// What a value means, for messages: "x of corner 2" is {"corner", 2, "x"}.
struct What {
  std::string_view name;
  std::uint32_t number = 0;  // 0: none
  std::string_view part = {};
};

/// Closed.
struct Interval {
  double low = 0, high = 0;
};

inline constexpr double kLargestNumber = 1e30;
inline constexpr Interval kAnyNumber{-kLargestNumber, kLargestNumber};
inline constexpr Interval kNotNegative{0, kLargestNumber};
inline constexpr double kLargestReflectance = 0.9999;  // contract 2: nearer to 1 light would never end
inline constexpr std::uint32_t kMostPieces = 65535;   // patches along an edge, sub-patches along a patch's edge
inline constexpr std::size_t kLongestName = 63;

/// What read_number() does without the words: a word's value, and a message's "expected a number ...".
bool number_of(const Token& at, const Interval& allowed, double& value);
void add_expected_number(MessageText& message, const Token& at, const What& what, const Interval& allowed);
bool read_number(Words& words, const What& what, const Interval& allowed, double& value);
bool read_point(Words& words, const What& what, Vec3& point);
/// A vector other than zero, made a unit vector.
bool read_direction(Words& words, const What& what, Vec3& unit);
/// Red, green, blue.
bool read_colour(Words& words, const What& what, const Interval& allowed, Rgb& colour);
/// One number for all three channels, or three.
bool read_grey_or_colour(Words& words, const What& what, const Interval& allowed, Rgb& colour);
/// A whole number without sign, point or exponent.
bool read_count(Words& words, const What& what, std::uint32_t low, std::uint32_t high, std::uint32_t& count);
/// Letters, digits, '_', '-'; `what` as in "the name of a material".
bool read_name(Words& words, std::string_view what, Token& name);

/// Does a word look like the start of a number (digit, sign, point)?
bool starts_number(const Token& token);

/// v / |v| without overflow or underflow on the way; zero stays zero.
Vec3 unit_vector(const Vec3& v);

}  // namespace shodo
