#include "base/text.h"

namespace shodo {

namespace {

constexpr int kDigits = 6;

/// value = 0.d1 d2 d3 d4 d5 d6 10^(exponent + 1), d1 not 0.
struct Rounded {
  std::uint32_t digits;  // 100,000 to 999,999
  int exponent;
};

/// A positive finite value to 6 digits, to even in a tie.
Rounded round_to_digits(double value) {
  int exponent = kDigits - 1;
  for (; value >= 1e28; exponent += 22) value /= 1e22;  // 10^22 is the largest power of ten that is an exact double
  for (; value < 1e-17; exponent -= 22) value *= 1e22;
  double power = 1;
  if (value >= 1e6) {
    for (; value / power >= 1e6; ++exponent) power *= 10;
    value /= power;
  } else {
    for (; value * power < 1e5; --exponent) power *= 10;
    value *= power;
  }
  std::uint32_t digits = static_cast<std::uint32_t>(value);
  const double rest = value - digits;
  if (rest > 0.5 || (rest == 0.5 && (digits & 1) != 0)) ++digits;
  if (digits == 1'000'000) return {100'000, exponent + 1};
  return {digits, exponent};
}

/// Up to 13 characters: "-1.23457e-308".
class ShortText {
 public:
  void put(char c) { characters_[size_++] = c; }
  std::string_view view() const { return {characters_, size_}; }

 private:
  char characters_[16];
  std::size_t size_ = 0;
};

char digit(int value) { return static_cast<char>('0' + value); }

/// The digits with a point after the first `before` of them, zeros in front if `before` is below 1; no trailing zeros.
void put_digits(const Rounded& number, int before, ShortText& out) {
  char digits[kDigits];
  std::uint32_t rest = number.digits;
  int count = 0;  // up to the last digit that is not 0
  for (int k = kDigits - 1; k >= 0; --k, rest /= 10) {
    digits[k] = digit(static_cast<int>(rest % 10));
    if (count == 0 && digits[k] != '0') count = k + 1;
  }
  for (int k = before < 1 ? before - 1 : 0; k < count || k < before; ++k) {
    if (k == before) out.put('.');
    out.put(k < 0 ? '0' : digits[k]);
  }
}

void put_exponent(int exponent, ShortText& out) {
  out.put('e');
  out.put(exponent < 0 ? '-' : '+');
  const int size = exponent < 0 ? -exponent : exponent;
  if (size >= 100) out.put(digit(size / 100));
  out.put(digit(size / 10 % 10));
  out.put(digit(size % 10));
}

}  // namespace

TextBuilder::TextBuilder(char* buffer, std::size_t capacity) : buffer_(buffer), capacity_(capacity) {
  if (capacity_ > 0) buffer_[0] = '\0';
}

TextBuilder& TextBuilder::add(std::string_view text) {
  for (const char c : text) {
    if (size_ + 1 >= capacity_) {
      truncated_ = true;
      for (std::size_t back = 1; back <= 3 && back <= size_; ++back) buffer_[size_ - back] = '.';
      break;
    }
    buffer_[size_++] = c;
  }
  if (capacity_ > 0) buffer_[size_] = '\0';
  return *this;
}

TextBuilder& TextBuilder::add(const char* text) { return add(std::string_view(text)); }

TextBuilder& TextBuilder::add_integer(std::uint64_t magnitude, bool negative) {
  char characters[20];  // 2^64 - 1 has 20 digits, -2^63 a sign and 19
  std::size_t start = sizeof characters;
  do {
    characters[--start] = digit(static_cast<int>(magnitude % 10));
    magnitude /= 10;
  } while (magnitude != 0);
  if (negative) characters[--start] = '-';
  return add(std::string_view(characters + start, sizeof characters - start));
}

TextBuilder& TextBuilder::add(double value) {
  if (value != value) return add("nan");
  ShortText out;
  if (value < 0) out.put('-');
  const double size = value < 0 ? 0.0 - value : value;
  if (size == 0) return add("0");
  if (size - size != 0) return add(value < 0 ? "-inf" : "inf");
  const Rounded number = round_to_digits(size);
  if (number.exponent < -4 || number.exponent >= kDigits) {
    put_digits(number, 1, out);
    put_exponent(number.exponent, out);
  } else {
    put_digits(number, number.exponent + 1, out);
  }
  return add(out.view());
}

}  // namespace shodo
