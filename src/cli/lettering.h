// Numbers in pictures: our own letters of 5 x 7 points, digits and what lux needs.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "cli/lux_scale.h"

namespace shodo {

/// A picture in memory, sRGB, rows from the top.
struct Canvas {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  /// Points outside are left out.
  void set(std::int64_t x, std::int64_t y, const Rgb8& colour);
  void fill(std::int64_t x, std::int64_t y, std::int64_t w, std::int64_t h, const Rgb8& colour);
};

inline constexpr std::uint32_t kLetterWidth = 6, kLetterHeight = 7;  // with a column between letters

/// Pixels that a text is wide, a letter's point being `size` x `size` pixels.
std::uint32_t text_width(std::string_view text, std::uint32_t size);
/// From its upper left corner. Letters there are none of stay blank.
void draw_text(Canvas& canvas, std::int64_t x, std::int64_t y, std::string_view text, std::uint32_t size,
               const Rgb8& colour);

}  // namespace shodo
