#include "scene/optics_statements.h"

#include "scene/values.h"

namespace shodo {

namespace {

constexpr std::string_view kChannels[3] = {"red", "green", "blue"};
constexpr double kLargestExponent = 100000;
// Decimal numbers that add up to 0.9999 exactly may do so as doubles but for an ulp or two.
constexpr double kSumRounding = 0x1p-50;

constexpr std::uint32_t kAlways = 1;

/// A background as its statement is read.
struct BackgroundWords {
  Background background;
  Texture texture;
};

Background& background_of(SceneReading& reading) { return value_of<BackgroundWords>(reading).background; }

bool read_zenith(SceneReading& reading) {
  return read_grey_or_colour(reading.words, {"zenith"}, kNotNegative, background_of(reading).zenith);
}
bool read_horizon(SceneReading& reading) {
  return read_grey_or_colour(reading.words, {"horizon"}, kNotNegative, background_of(reading).horizon);
}
bool read_ground(SceneReading& reading) {
  return read_grey_or_colour(reading.words, {"ground"}, kNotNegative, background_of(reading).ground);
}
bool read_up(SceneReading& reading) {
  return read_direction(reading.words, {"up"}, background_of(reading).up);
}

/// picture FILE towards X Y Z width DEGREES luminance L [around]
bool read_picture(SceneReading& reading) {
  Words& words = reading.words;
  BackgroundWords& value = value_of<BackgroundWords>(reading);
  Background& background = value.background;
  if (!read_picture_path(reading, value.texture)) return false;
  background.picture = static_cast<std::uint32_t>(reading.store.counts().textures);
  constexpr std::string_view kParts[3] = {"towards", "width", "luminance"};
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (!words.at_word() || words.peek().text != kParts[k]) return words.expected(kParts[k]);
    words.take();
    const bool read = k == 0   ? read_direction(words, {"towards"}, background.towards)
                      : k == 1 ? read_number(words, {"width of the picture, degrees"}, {1, 170},
                                             background.width_degrees)
                               : read_number(words, {"luminance of the picture's white, cd/m2"}, kNotNegative,
                                             background.luminance);
    if (!read) return false;
  }
  background.around = words.at_word() && words.peek().text == "around";
  if (background.around) words.take();
  return true;
}

constexpr Key kBackgroundKeys[] = {{"zenith", kAlways, kAlways, read_zenith},
                                   {"horizon", kAlways, kAlways, read_horizon},
                                   {"ground", kAlways, kAlways, read_ground},
                                   {"up", kAlways, 0, read_up},
                                   {"picture", kAlways, 0, read_picture}};

// 2^-40 of a radian: `right` of a picture is the cross product of two directions.
constexpr double kParallel = 0x1p-40;

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

/// background zenith L horizon L ground L [up X Y Z] [picture ...], L in cd/m2, grey or red green blue: once.
bool read_background(SceneReading& reading) {
  if (reading.background_given) return reading.words.expected(reading.statement, "'background' once only");
  BackgroundWords words;
  if (!read_keys(reading, kBackgroundKeys, kAlways, &words)) return false;
  const Background& background = words.background;
  if (background.picture != kNone) {
    if (!(length(cross(background.towards, background.up)) > kParallel)) {
      return reading.words.expected(reading.statement, "a background whose picture doesn't lie along its 'up'");
    }
    words.texture.material = kNone;
    reading.store.add(words.texture);
  }
  reading.store.add(background);
  return reading.background_given = true;
}

/// glass MATERIAL, 4 corners; like a light it doesn't end an object.
bool read_glass(SceneReading& reading) {
  Glass glass;
  const Token name = reading.words.peek();
  if (!read_reference(reading, "the name of a material", &SceneStore::find_material, glass.material)) return false;
  if (reading.store.storing()) {
    const Optics* optics = nullptr;
    for (std::uint64_t k = 0; k < reading.store.counts().optics; ++k) {
      const Optics& known = reading.store.scene().optics[static_cast<std::size_t>(k)];
      if (known.material == glass.material) optics = &known;
    }
    if (optics == nullptr || !(optics->mirrors() || optics->transmits())) {
      return reading.words.expected(name, "a material that reflects or transmits");
    }
  }
  if (!read_plane_quad(reading, glass.corners)) return false;
  reading.store.add(glass);
  return true;
}

}  // namespace shodo
