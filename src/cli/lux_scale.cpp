#include "cli/lux_scale.h"

#include <algorithm>
#include <cstdio>

#include "base/elementary.h"

namespace shodo {

namespace {

constexpr std::size_t kColours = 17;
constexpr Rgb8 kColour[kColours] = {{45, 13, 103},  {40, 34, 120},  {29, 52, 134},  {1, 71, 142},   {0, 89, 139},
                                    {1, 104, 142},  {2, 119, 146},  {0, 134, 150},  {5, 150, 153},  {2, 166, 154},
                                    {2, 182, 150},  {60, 196, 143}, {106, 207, 135}, {145, 217, 128}, {181, 226, 122},
                                    {216, 233, 120}, {249, 240, 123}};

constexpr std::size_t kMostLevels = 14;
constexpr double kMostContrast = 1000;  // of a scale that finds its own ends
constexpr int kLeastDecade = -3, kMostDecade = 9;

double power_of_ten(int k) {
  double power = 1;
  for (int n = 0; n < (k < 0 ? -k : k); ++n) power *= 10;
  return power;
}

/// The nearest double to a round value.
double round_value(double mantissa, int decade) {
  return decade < 0 ? mantissa / power_of_ten(-decade) : mantissa * power_of_ten(decade);
}

std::vector<double> levels_of(const std::vector<double>& mantissas, double low, double high) {
  std::vector<double> levels;
  for (int decade = kLeastDecade; decade <= kMostDecade; ++decade) {
    for (const double mantissa : mantissas) {
      const double level = round_value(mantissa, decade);
      if (level >= low && level <= high) levels.push_back(level);
    }
  }
  return levels;
}

const std::vector<double>& finest() {
  static const std::vector<double> mantissas{1, 1.5, 2, 3, 5, 7.5};
  return mantissas;
}

}  // namespace

double LuxScale::place(double lux) const {
  if (!(lux > low)) return 0;
  if (lux >= high) return 1;
  return low > 0 ? logarithm(lux / low) / logarithm(high / low) : lux / high;
}

Rgb8 LuxScale::colour(double lux) const { return scale_colour(place(lux)); }

Rgb8 scale_colour(double place) {
  const std::uint32_t whole = static_cast<std::uint32_t>(place * 256 * (kColours - 1) + 0.5);
  const std::size_t k = std::min<std::size_t>(whole / 256, kColours - 2);
  const std::uint32_t part = whole - 256 * static_cast<std::uint32_t>(k);
  Rgb8 colour;
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] = static_cast<std::uint8_t>((kColour[k][c] * (256 - part) + kColour[k + 1][c] * part + 128) / 256);
  }
  return colour;
}

std::vector<double> round_levels(double low, double high) {
  std::vector<double> levels = levels_of(finest(), low, high);
  if (levels.size() > kMostLevels) levels = levels_of({1, 2, 5}, low, high);
  if (levels.size() > kMostLevels) levels = levels_of({1}, low, high);
  return levels;
}

LuxScale scale_for(std::vector<float> lux) {
  std::erase_if(lux, [](float value) { return !(value > 0); });
  if (lux.empty()) return {1, 1000};
  std::sort(lux.begin(), lux.end());
  const double least = static_cast<double>(lux[lux.size() / 100]);
  const double most = static_cast<double>(lux[lux.size() - 1 - lux.size() / 100]);
  const std::vector<double> all = levels_of(finest(), 0, power_of_ten(kMostDecade + 1));
  std::size_t high = 1;
  while (high + 1 < all.size() && all[high] < most) ++high;
  std::size_t low = high - 1;
  while (low > 0 && all[low] > least && all[low - 1] * kMostContrast >= all[high]) --low;
  return {all[low], all[high]};
}

std::string lux_text(double lux) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", lux);
  return text;
}

}  // namespace shodo
