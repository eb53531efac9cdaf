// Short texts in a buffer of the caller's: messages need no memory of their own, and the same bytes everywhere.
//
// What doesn't fit is cut, and the text then ends in "..."; nothing is ever written beyond the buffer, and the text
// always ends in a zero byte. Integers are exact. A double is written with 6 digits as printf's "%.6g" does, scaled by
// powers of ten in double precision: the last digit may be one off where the value is within 2e-15 of a tie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "base/features.h"

namespace shodo {

class TextBuilder {
 public:
  /// The buffer stays the caller's. With a capacity of 0 nothing is written at all.
  TextBuilder(char* buffer, std::size_t capacity);

  TextBuilder& add(std::string_view text);
  /// Not inline: a literal's length, computed at each of a hundred calls, is what small machines have no room for.
  TextBuilder& add(const char* text);
  TextBuilder& add(char character) { return add(std::string_view(&character, 1)); }
  /// Any integer, decimal.
  template <class T>
    requires(std::is_integral_v<T> && !std::is_same_v<T, bool> && !std::is_same_v<T, char>)
  TextBuilder& add(T value) {
    if constexpr (std::is_signed_v<T>) {
      if (value < 0) return add_integer(0 - static_cast<std::uint64_t>(value), true);
    }
    return add_integer(static_cast<std::uint64_t>(value), false);
  }
  /// 6 significant digits, no trailing zeros: 0.25, 1e+09, -3.14159, inf, nan; both zeros are 0.
  TextBuilder& add(double value);

  std::string_view text() const { return {buffer_, size_}; }
  bool truncated() const { return truncated_; }

 private:
  TextBuilder& add_integer(std::uint64_t magnitude, bool negative);

  char* buffer_;
  std::size_t capacity_;
  std::size_t size_ = 0;  // without the zero byte
  bool truncated_ = false;
};

/// Takes any text and drops it.
class NoText {
 public:
  NoText(char*, std::size_t) {}
  template <class T>
  NoText& add(const T&) {
    return *this;
  }
};

/// What a Status says is wrong, where the library is built with messages.
using MessageText = std::conditional_t<features::kMessages, TextBuilder, NoText>;

}  // namespace shodo
