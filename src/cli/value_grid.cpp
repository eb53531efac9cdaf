#include "cli/value_grid.h"

#include <bit>

#include "base/decimal.h"

namespace shodo {

namespace {

constexpr std::uint32_t kLargestSide = 65535;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The words of a header; a comment goes from # to the end of the line.
class Header {
 public:
  explicit Header(std::string_view bytes) : rest_(bytes) {}

  std::string_view word() {
    while (!rest_.empty() && (is_blank(rest_[0]) || rest_[0] == '#')) {
      const bool comment = rest_[0] == '#';
      const std::size_t end = comment ? rest_.find('\n') : 1;
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end);
    }
    std::size_t length = 0;
    while (length < rest_.size() && !is_blank(rest_[length])) ++length;
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }
  /// What comes after the header and the one blank that ends it.
  std::string_view body() const { return rest_.empty() ? rest_ : rest_.substr(1); }

 private:
  std::string_view rest_;
};

bool side(std::string_view word, std::uint32_t& pixels) {
  const DecimalResult number = parse_decimal(word);
  if (number.error != DecimalError::none || !(number.value >= 1 && number.value <= kLargestSide)) return false;
  pixels = static_cast<std::uint32_t>(number.value);
  return static_cast<double>(pixels) == number.value;
}

float float_at(std::string_view body, std::size_t index, bool little) {
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint32_t byte = static_cast<unsigned char>(body[4 * index + k]);
    bits |= byte << (8 * (little ? k : 3 - k));
  }
  return std::bit_cast<float>(bits);
}

bool read_values(std::string_view body, bool little, ValueGrid& grid, std::string& mistake) {
  const std::size_t row = std::size_t{grid.width} * grid.channels, count = row * grid.height;
  const std::size_t bytes = grid.map ? 4 * count : count;
  if (body.size() != bytes) {
    mistake = "expected " + std::to_string(bytes) + " bytes after the header, found " + std::to_string(body.size());
    return false;
  }
  grid.value.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    // A PFM file starts with the bottom row.
    const std::size_t to = grid.map ? (grid.height - 1 - k / row) * row + k % row : k;
    grid.value[to] = grid.map ? float_at(body, k, little) : static_cast<float>(static_cast<unsigned char>(body[k]));
    if (grid.value[to] - grid.value[to] == 0) continue;
    mistake = "expected finite numbers";
    return false;
  }
  return true;
}

}  // namespace

bool read_grid(std::string_view bytes, ValueGrid& grid, std::string& mistake) {
  Header header(bytes);
  const std::string_view kind = header.word();
  grid.map = kind == "PF" || kind == "Pf";
  grid.channels = kind == "Pf" ? 1 : 3;
  if (!grid.map && kind != "P6") {
    mistake = "expected a picture (PPM, P6; PNG) or a map (PFM)";
    return false;
  }
  if (!side(header.word(), grid.width) || !side(header.word(), grid.height)) {
    mistake = "expected a width and a height from 1 to " + std::to_string(kLargestSide);
    return false;
  }
  const std::string_view last = header.word();
  const DecimalResult scale = parse_decimal(last);
  const bool known = scale.error == DecimalError::none && (grid.map ? scale.value != 0 : scale.value == 255);
  if (!known) {
    mistake = grid.map ? "expected a scale other than 0" : "expected 255 as the largest value";
    return false;
  }
  return read_values(header.body(), scale.value < 0, grid, mistake);
}

}  // namespace shodo
