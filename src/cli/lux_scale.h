// Lux as colours, and round values of lux (contract 1: --false-colour, --isolux).
//
// The colours are our own: in OKLab (Ottosson 2020) the lightness rises evenly from 0.28 to 0.94, the hue turns from
// violet-blue (290 degrees) by teal and green to yellow (105), with a chroma of 0.14 or what sRGB has there. So equal
// steps look equal, the order shows in a grey copy, and with any kind of colour blindness: lightness alone tells it.
// Seventeen entries, between them linear in sRGB codes.
//
// The round values are those in which EN 12464-1 states illuminances: 1, 1.5, 2, 3, 5, 7.5, 10 and so on, each about
// the least step that one notices.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace shodo {

using Rgb8 = std::array<std::uint8_t, 3>;

/// Logarithmic, or linear if it starts at 0.
struct LuxScale {
  double low = 0, high = 0;  // low < high

  /// 0 at `low`, 1 at `high`, and not beyond.
  double place(double lux) const;
  Rgb8 colour(double lux) const;
};

/// 0 .. 1.
Rgb8 scale_colour(double place);

/// Round values from `low` to `high`, both included, ascending; at most 14: fewer a decade where there would be more.
std::vector<double> round_levels(double low, double high);

/// Round ends of a scale for these values, of which the lowest and highest hundredth may lie beyond. Zeros don't count.
LuxScale scale_for(std::vector<float> lux);

/// "750", "0.15".
std::string lux_text(double lux);

}  // namespace shodo
