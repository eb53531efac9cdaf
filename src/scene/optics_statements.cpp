#include "scene/optics_statements.h"

#include "scene/values.h"

namespace shodo {

namespace {

constexpr std::string_view kChannels[3] = {"red", "green", "blue"};
constexpr double kLargestExponent = 100000;
// Decimal numbers that add up to 0.9999 exactly may do so as doubles but for an ulp or two.
constexpr double kSumRounding = 0x1p-50;

constexpr std::uint32_t kAlways = 1;

bool read_zenith(SceneReading& reading) {
  return read_grey_or_colour(reading.words, {"zenith"}, kNotNegative, value_of<Background>(reading).zenith);
}
bool read_horizon(SceneReading& reading) {
  return read_grey_or_colour(reading.words, {"horizon"}, kNotNegative, value_of<Background>(reading).horizon);
}
bool read_ground(SceneReading& reading) {
  return read_grey_or_colour(reading.words, {"ground"}, kNotNegative, value_of<Background>(reading).ground);
}
bool read_up(SceneReading& reading) {
  return read_direction(reading.words, {"up"}, value_of<Background>(reading).up);
}

constexpr Key kBackgroundKeys[] = {{"zenith", kAlways, kAlways, read_zenith},
                                   {"horizon", kAlways, kAlways, read_horizon},
                                   {"ground", kAlways, kAlways, read_ground},
                                   {"up", kAlways, 0, read_up}};

}  // namespace

bool read_highlight(Words& words, Optics& optics) {
  return read_number(words, {"coefficient of the highlight"}, {0, 1}, optics.highlight) &&
         read_number(words, {"exponent of the highlight"}, {1, kLargestExponent}, optics.highlight_exponent);
}

bool keep_energy(SceneReading& reading, const Token& name, const Material& material, Optics& optics) {
  double most = 0;
  for (std::uint32_t c = 0; c < 3; ++c) {
    const double sum = material.diffuse.c[c] + optics.reflect.c[c] + optics.transmit.c[c];
    if (sum > most) most = sum;
    if (!(sum > kLargestReflectance + kSumRounding)) continue;
    reading.words.mistake(name)
        .add("expected diffuse + reflect + transmit of at most ")
        .add(kLargestReflectance)
        .add(" (")
        .add(kChannels[c])
        .add("), found ")
        .add(sum);
    return false;
  }
  const double left = kLargestReflectance > most ? kLargestReflectance - most : 0;
  if (optics.highlight > left) optics.highlight = left;
  return true;
}

bool does_anything(const Optics& optics) { return optics.mirrors() || optics.transmits() || optics.highlight > 0; }

/// background zenith L horizon L ground L [up X Y Z], L in cd/m2, grey or red green blue: once.
bool read_background(SceneReading& reading) {
  if (reading.background_given) return reading.words.expected(reading.statement, "'background' once only");
  Background background;
  if (!read_keys(reading, kBackgroundKeys, kAlways, &background)) return false;
  reading.store.add(background);
  return reading.background_given = true;
}

}  // namespace shodo
