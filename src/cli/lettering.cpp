#include "cli/lettering.h"

namespace shodo {

namespace {

struct Letter {
  char letter;
  const char* points;  // row by row
};

constexpr Letter kLetters[] = {
    {'0', " ### #   ##  ### # ###  ##   # ### "}, {'1', "  #   ##    #    #    #    #   ### "},
    {'2', " ### #   #    #   #   #   #   #####"}, {'3', "#####   #   #     #     ##   # ### "},
    {'4', "   #   ##  # # #  # #####   #    # "}, {'5', "######    ####     #    ##   # ### "},
    {'6', "  ##  #   #    #### #   ##   # ### "}, {'7', "#####    #   #   #   #    #    #   "},
    {'8', " ### #   ##   # ### #   ##   # ### "}, {'9', " ### #   ##   # ####    #   #  ##  "},
    {'.', "                          ##   ##  "}, {'-', "               #####               "},
    {'+', "       #    #  #####  #    #       "}, {'e', "           ### #   #######     ### "},
    {'l', " ##    #    #    #    #    #   ### "}, {'x', "          #   # # #   #   # # #   #"},
};

const char* points_of(char letter) {
  for (const Letter& known : kLetters) {
    if (known.letter == letter) return known.points;
  }
  return nullptr;
}

}  // namespace

void Canvas::set(std::int64_t x, std::int64_t y, const Rgb8& colour) {
  if (x < 0 || y < 0 || x >= width || y >= height) return;
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x));
  for (std::size_t c = 0; c < 3; ++c) rgb[at + c] = colour[c];
}

void Canvas::fill(std::int64_t x, std::int64_t y, std::int64_t w, std::int64_t h, const Rgb8& colour) {
  for (std::int64_t row = y; row < y + h; ++row) {
    for (std::int64_t column = x; column < x + w; ++column) set(column, row, colour);
  }
}

std::uint32_t text_width(std::string_view text, std::uint32_t size) {
  return text.empty() ? 0 : size * (static_cast<std::uint32_t>(text.size()) * kLetterWidth - 1);
}

void draw_text(Canvas& canvas, std::int64_t x, std::int64_t y, std::string_view text, std::uint32_t size,
               const Rgb8& colour) {
  for (const char letter : text) {
    const char* points = points_of(letter);
    for (std::uint32_t k = 0; points != nullptr && k < 35; ++k) {
      if (points[k] == '#') canvas.fill(x + size * (k % 5), y + size * (k / 5), size, size, colour);
    }
    x += size * kLetterWidth;
  }
}

}  // namespace shodo
