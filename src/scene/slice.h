// A part of a text. std::string_view::substr can throw, and the library throws nothing.
#pragma once

#include <cstddef>
#include <string_view>

namespace shodo {

/// Up to `size` bytes from `from`, as far as there are any.
constexpr std::string_view slice(std::string_view text, std::size_t from, std::size_t size = std::string_view::npos) {
  if (from > text.size()) return {};
  const std::size_t left = text.size() - from;
  return {text.data() + from, size < left ? size : left};
}

static_assert(slice("abc", 1) == "bc" && slice("abc", 1, 1) == "b" &&
              slice("abc", 3).empty() && slice("abc", 4).empty());

}  // namespace shodo
