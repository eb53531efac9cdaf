#include "scene/values.h"

#include "base/decimal.h"

namespace shodo {

namespace {

constexpr std::string_view kAxes[3] = {"x", "y", "z"};
constexpr std::string_view kChannels[3] = {"red", "green", "blue"};

void add_what(MessageText& message, const What& what) {
  message.add(" (");
  if (!what.part.empty()) message.add(what.part).add(" of ");
  message.add(what.name);
  if (what.number != 0) message.add(' ').add(what.number);
  message.add(')');
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

}  // namespace

bool number_of(const Token& at, const Interval& allowed, double& value) {
  if (at.kind != TokenKind::kWord) return false;
  const DecimalResult number = parse_decimal(at.text);
  const bool within = number.value >= allowed.low && number.value <= allowed.high;
  if (number.error != DecimalError::none || !within) return false;
  value = number.value;
  return true;
}

void add_expected_number(MessageText& message, const Token& at, const What& what, const Interval& allowed) {
  const DecimalError error = at.kind == TokenKind::kWord ? parse_decimal(at.text).error : DecimalError::empty;
  message.add("expected a number");
  if (error == DecimalError::none || error == DecimalError::out_of_range) {
    message.add(" from ").add(allowed.low).add(" to ").add(allowed.high);
  }
  add_what(message, what);
  add_found(message, at);
}

bool read_number(Words& words, const What& what, const Interval& allowed, double& value) {
  const Token at = words.peek();
  if (number_of(at, allowed, value)) {
    words.take();
    return true;
  }
  MessageText message = words.mistake(at);
  add_expected_number(message, at, what, allowed);
  return false;
}

bool read_point(Words& words, const What& what, Vec3& point) {
  double value[3] = {};
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (!read_number(words, {what.name, what.number, kAxes[k]}, kAnyNumber, value[k])) return false;
  }
  point = {value[0], value[1], value[2]};
  return true;
}

bool read_direction(Words& words, const What& what, Vec3& unit) {
  const Token at = words.peek();
  if (!read_point(words, what, unit)) return false;
  if (unit.x == 0 && unit.y == 0 && unit.z == 0) {
    MessageText message = words.mistake(at);
    message.add("expected a direction other than 0 0 0");
    add_what(message, what);
    add_found(message, at);
    return false;
  }
  unit = unit_vector(unit);
  return true;
}

bool read_colour(Words& words, const What& what, const Interval& allowed, Rgb& colour) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (!read_number(words, {what.name, what.number, kChannels[k]}, allowed, colour.c[k])) return false;
  }
  return true;
}

bool read_grey_or_colour(Words& words, const What& what, const Interval& allowed, Rgb& colour) {
  if (!read_number(words, what, allowed, colour.c[0])) return false;
  colour.c[1] = colour.c[2] = colour.c[0];
  if (!starts_number(words.peek())) return true;
  return read_number(words, {what.name, what.number, kChannels[1]}, allowed, colour.c[1]) &&
         read_number(words, {what.name, what.number, kChannels[2]}, allowed, colour.c[2]);
}

bool read_count(Words& words, const What& what, std::uint32_t low, std::uint32_t high, std::uint32_t& count) {
  const Token at = words.peek();
  std::uint32_t value = 0;
  if (at.kind == TokenKind::kWord && parse_unsigned(at.text, value) && value >= low && value <= high) {
    count = value;
    words.take();
    return true;
  }
  MessageText message = words.mistake(at);
  message.add("expected a whole number from ").add(low).add(" to ").add(high);
  add_what(message, what);
  add_found(message, at);
  return false;
}

bool read_name(Words& words, std::string_view what, Token& name) {
  const Token at = words.peek();
  bool good = at.kind == TokenKind::kWord && at.text.size() <= kLongestName;
  for (const char c : at.text) good = good && is_name_character(c);
  if (good) {
    name = words.take();
    return true;
  }
  MessageText message = words.mistake(at);
  message.add("expected ").add(what);
  if (at.kind == TokenKind::kWord) message.add(" (letters, digits, '_', '-', at most 63)");
  add_found(message, at);
  return false;
}

bool starts_number(const Token& token) {
  if (token.kind != TokenKind::kWord) return false;
  const char c = token.text[0];
  return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
}

Vec3 unit_vector(const Vec3& v) {
  double largest = magnitude(v.x);
  if (magnitude(v.y) > largest) largest = magnitude(v.y);
  if (magnitude(v.z) > largest) largest = magnitude(v.z);
  if (!(largest > 0)) return v;
  return normalised({v.x / largest, v.y / largest, v.z / largest});
}

}  // namespace shodo
