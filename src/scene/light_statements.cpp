// The statement `light` (paper 2.1: points, surfaces, polyhedra and the sun), and the flags of paper 3.1.
//
// The centres of area and polyhedral lights are found when everything has been read (finish.cpp).
#include "base/elementary.h"
#include "scene/quad_shape.h"
#include "scene/slice.h"
#include "scene/statements.h"
#include "scene/values.h"

namespace shodo {

namespace {

struct Kind {
  std::string_view word;
  LightKind kind;
  std::uint32_t bit;
};

constexpr std::uint32_t kPoint = 1, kArea = 2, kPolyhedron = 4, kSun = 8, kAny = 15;
constexpr Kind kKinds[] = {{"point", LightKind::kPoint, kPoint},
                           {"area", LightKind::kArea, kArea},
                           {"polyhedron", LightKind::kPolyhedron, kPolyhedron},
                           {"sun", LightKind::kSun, kSun}};

constexpr double kLargestExponent = 1e6;
constexpr Interval kAnyTurn{-1e6, 1e6};
// The axis of a light is along x, but for rounding.
constexpr double kAlongX = 0x1p-40;
// The diagonals of a light may pass each other at this part of the longer one.
constexpr double kFlat = 1e-3;

/// A light as its statement is read.
struct LightWords {
  Light light;
  Luminaire luminaire;
  bool strength_given = false, has_luminaire = false;
  Token turned;  // the word `turn`
  double turn_degrees = 0;
};

Light& light_of(SceneReading& reading) { return value_of<LightWords>(reading).light; }

bool read_at(SceneReading& reading) { return read_point(reading.words, {"at"}, light_of(reading).position); }

bool read_towards(SceneReading& reading) {
  return read_direction(reading.words, {"towards"}, light_of(reading).towards);
}

bool read_strength(SceneReading& reading) {
  value_of<LightWords>(reading).strength_given = true;
  return read_number(reading.words, {reading.key.text}, kNotNegative, light_of(reading).strength);
}

bool read_cosine(SceneReading& reading) {
  Light& light = light_of(reading);
  light.aimed = true;
  return read_number(reading.words, {"exponent of the cosine"}, {0, kLargestExponent}, light.cosine_exponent);
}

bool read_open(SceneReading& reading) { return light_of(reading).open = true; }

bool read_light_colour(SceneReading& reading) {
  return read_colour(reading.words, {"colour"}, kNotNegative, light_of(reading).colour);
}

bool read_attenuation(SceneReading& reading) {
  Light& light = light_of(reading);
  constexpr std::string_view kParts[3] = {"C", "L", "Q"};
  const Token at = reading.words.peek();
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (!read_number(reading.words, {"attenuation", 0, kParts[k]}, kNotNegative, light.attenuation[k])) return false;
  }
  if (light.attenuation[0] > 0 || light.attenuation[1] > 0 || light.attenuation[2] > 0) return true;
  return reading.words.expected(at, "an attenuation that is not 0 0 0");
}

/// A light that nobody sees behind.
bool read_light_quad(SceneReading& reading) { return read_plane_quad(reading, light_of(reading).corners); }

/// Only an object with faces can shine, and only as one light.
bool read_light_object(SceneReading& reading) {
  Light& light = light_of(reading);
  const Token at = reading.words.peek();
  if (!read_reference(reading, "the name of an object", &SceneStore::find_object, light.object)) return false;
  if (!reading.store.storing()) return true;
  const Object& object = reading.store.scene().objects[light.object];
  if (object.mesh_count == 0) return reading.words.expected(at, "an object that has surfaces above this line");
  if (object.light != kNone) return reading.words.expected(at, "an object that isn't a light already");
  return true;
}

/// ies FILE; the file itself is read when everything has been counted.
bool read_ies(SceneReading& reading) {
  if constexpr (!features::kLuminaires) return left_out(reading, reading.key);
  LightWords& words = value_of<LightWords>(reading);
  words.has_luminaire = true;
  const auto index = static_cast<std::uint32_t>(reading.store.counts().luminaires);
  return read_later_path(reading, "the path of an IES file", {Wanted::Kind::kLuminaire, index}, words.luminaire.path);
}

bool read_turn(SceneReading& reading) {
  LightWords& words = value_of<LightWords>(reading);
  words.turned = reading.key;
  return read_number(reading.words, {"degrees of the turn"}, kAnyTurn, words.turn_degrees);
}

bool read_direct_flags(SceneReading& reading) {
  return read_flags(reading, light_of(reading).direct);
}
bool read_ambient_flags(SceneReading& reading) { return read_flags(reading, light_of(reading).ambient); }

constexpr Key kLightKeys[] = {{"quad", kArea, kArea, read_light_quad},
                              {"object", kPolyhedron, kPolyhedron, read_light_object},
                              {"at", kPoint, kPoint, read_at},
                              {"towards", kPoint | kSun, kSun, read_towards},
                              {"intensity", kPoint, 0, read_strength},
                              {"luminance", kArea | kPolyhedron, kArea | kPolyhedron, read_strength},
                              {"illuminance", kSun, kSun, read_strength},
                              {"cosine", kPoint, 0, read_cosine},
                              {"ies", kPoint, 0, read_ies},
                              {"turn", kPoint, 0, read_turn},
                              {"open", kArea, 0, read_open},
                              {"colour", kAny, 0, read_light_colour},
                              {"attenuation", kPoint | kArea | kPolyhedron, 0, read_attenuation},
                              {"direct", kAny, 0, read_direct_flags},
                              {"ambient", kAny, 0, read_ambient_flags}};

const Kind* read_kind(Words& words) {
  for (const Kind& kind : kKinds) {
    if (!words.at_word() || kind.word != words.peek().text) continue;
    words.take();
    return &kind;
  }
  words.expected("point, area, polyhedron or sun");
  return nullptr;
}

/// What a point light's words must be together.
bool check_point(SceneReading& reading, const LightWords& given) {
  Words& words = reading.words;
  if (given.strength_given == given.has_luminaire) {
    return words.expected(given.has_luminaire ? "an intensity or an IES file, not both" : "intensity or ies");
  }
  const bool aims = given.light.towards != Vec3{};
  if (given.light.aimed && !aims) return words.expected("'towards', since there is a 'cosine'");
  if (given.has_luminaire && !aims) return words.expected("'towards', since there is an 'ies'");
  if (given.has_luminaire && given.light.aimed) return words.expected("an IES file without a 'cosine'");
  if (given.turned.kind == TokenKind::kWord && !given.has_luminaire) {
    return words.expected(given.turned, "an IES file to turn");
  }
  return true;
}

/// C is 0 towards +x, +z for a light along x, then turned about `towards`; it grows the other way round (LM-63: as seen
/// from above, of a light that shines down, counter-clockwise).
void aim(const Vec3& towards, double turn_degrees, Luminaire& luminaire) {
  const Vec3 x{1, 0, 0}, z{0, 0, 1};
  const Vec3& side = length(cross(towards, x)) > kAlongX ? x : z;
  const Vec3 zero = unit_vector(side - dot(side, towards) * towards), quarter = cross(towards, zero);
  luminaire.along = unit_vector(cosine_degrees(turn_degrees) * zero + sine_degrees(turn_degrees) * quarter);
  luminaire.across = cross(luminaire.along, towards);
}

struct Flag {
  std::string_view word;
  std::int8_t GivenFlags::*flag;
};

constexpr Flag kFlags[] = {{"blocks", &GivenFlags::blocks},
                           {"shadowed_towards", &GivenFlags::shadowed_towards},
                           {"shadowed_leaving", &GivenFlags::shadowed_leaving}};

bool starts_flag(const Words& words) {
  return words.at_word() && (words.peek().text[0] == '+' || words.peek().text[0] == '-');
}

}  // namespace

bool read_flags(SceneReading& reading, GivenFlags& flags) {
  Words& words = reading.words;
  bool any = false;
  while (starts_flag(words)) {
    const Flag* found = nullptr;
    for (const Flag& flag : kFlags) {
      if (slice(words.peek().text, 1) == flag.word) found = &flag;
    }
    if (found == nullptr) break;
    if (flags.*found->flag != 0) return words.expected("each flag once only");
    flags.*found->flag = words.take().text[0] == '+' ? 1 : -1;
    any = true;
  }
  if (any && !starts_flag(words)) return true;
  return words.expected("+ or - before blocks, shadowed_towards or shadowed_leaving");
}

bool read_plane_quad(SceneReading& reading, Vec3* corners) {
  const Token at = reading.words.peek();
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (!read_point(reading.words, {"corner", k + 1}, corners[k])) return false;
  }
  const Vec3* c = corners;
  bool good = quad_shape(c) == QuadShape::kConvex;
  for (std::uint32_t k = 0; k < 4; ++k) good = good && c[k] != c[(k + 3) % 4];
  const double a = length(c[2] - c[0]), b = length(c[3] - c[1]);
  const double off = dot(c[1] - c[0], unit_vector(cross(c[2] - c[0], c[3] - c[1])));  // between the diagonals
  const double most = kFlat * (a > b ? a : b);
  if (good && off <= most && off >= -most) return true;
  reading.words.mistake(at).add("expected the four corners of a plane convex quad with an area");
  return false;
}

/// light NAME point|area|polyhedron|sun, then its values
bool read_light(SceneReading& reading) {
  Words& words = reading.words;
  Token name;
  if (!read_new_name(reading, "the name of a light", &SceneStore::find_light, name)) return false;
  const Kind* kind = read_kind(words);
  if (kind == nullptr) return false;
  LightWords given;
  Light& light = given.light;
  light.kind = kind->kind;
  if (!read_keys(reading, kLightKeys, kind->bit, &given)) return false;
  if (light.kind == LightKind::kPoint && !check_point(reading, given)) return false;
  if (reading.store.storing() && light.object != kNone) {
    reading.store.scene().objects[light.object].light = static_cast<std::uint32_t>(reading.store.counts().lights);
  }
  light.name = reading.store.add_name(name.text);
  if (features::kLuminaires && given.has_luminaire) {
    aim(light.towards, given.turn_degrees, given.luminaire);
    given.luminaire.light = static_cast<std::uint32_t>(reading.store.counts().lights);
    light.luminaire = static_cast<std::uint32_t>(reading.store.counts().luminaires);
    reading.store.add(given.luminaire);
  }
  reading.store.add(light);
  return true;
}

}  // namespace shodo
