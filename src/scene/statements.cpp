// The loop over the statements, and those about the scene as a whole: shodo, unit, display, camera, include, material.
#include "scene/statements.h"

#include "scene/optics_statements.h"
#include "scene/values.h"

namespace shodo {

namespace {

struct Statement {
  std::string_view word;
  bool (*read)(SceneReading& reading);
};

constexpr Statement kStatements[] = {
    {"background", read_background}, {"camera", read_camera}, {"display", read_display},   {"grid", read_grid},
    {"glass", read_glass},           {"include", read_include},
    {"light", read_light},           {"material", read_material}, {"obj", read_obj},
    {"object", read_object},         {"plane", read_plane},   {"quad", read_quad},         {"sub", read_sub},
    {"tri", read_tri},
    {"unit", read_unit},
};

bool expected_statement(Words& words) {
  MessageText message = words.mistake(words.peek());
  message.add("expected a statement (");
  std::string_view comma;
  for (const Statement& statement : kStatements) {
    message.add(comma).add(statement.word);
    comma = ", ";
  }
  message.add(')');
  add_found(message, words.peek());
  return false;
}

/// The first statement of the top file, and of it only.
bool read_version(SceneReading& reading) {
  Words& words = reading.words;
  if (reading.started) return words.expected("'shodo' once only, as the first statement of the top file");
  if (!words.at_word() || words.peek().text != "shodo") return words.expected("'shodo 1' as the first statement");
  words.take();
  if (!words.at_word() || words.peek().text != "1") return words.expected("format version 1");
  words.take();
  reading.started = true;
  return true;
}

const Statement* find_statement(const Token& word) {
  for (const Statement& statement : kStatements) {
    if (word.kind == TokenKind::kWord && statement.word == word.text) return &statement;
  }
  return nullptr;
}

bool read_statement(SceneReading& reading) {
  Words& words = reading.words;
  reading.include = {};
  if (!reading.started || (words.at_word() && words.peek().text == "shodo")) {
    if (!read_version(reading)) return false;
  } else {
    const Statement* statement = find_statement(words.peek());
    if (statement == nullptr) return expected_statement(words);
    reading.statement = words.take();
    if (!statement->read(reading)) return false;
  }
  if (!words.at_end()) return words.expected("the end of the line");
  return !features::kIncludes || reading.include.kind != TokenKind::kWord || words.enter(reading.include);
}

/// "expected <the keys that may stand here> or the end of the line"; always false.
bool expected_key(Words& words, std::span<const Key> keys, std::uint32_t kind) {
  MessageText message = words.mistake(words.peek());
  message.add("expected ");
  for (const Key& key : keys) {
    if ((key.kinds & kind) != 0) message.add(key.word).add(", ");
  }
  message.add("or the end of the line");
  add_found(message, words.peek());
  return false;
}

struct Unit {
  std::string_view word;
  double metres;
};

constexpr Unit kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};

constexpr std::uint32_t kAlways = 1;

bool read_eye(SceneReading& reading) {
  return read_point(reading.words, {"eye"}, value_of<Camera>(reading).eye);
}
bool read_look(SceneReading& reading) { return read_point(reading.words, {"look"}, value_of<Camera>(reading).look); }
bool read_up(SceneReading& reading) { return read_direction(reading.words, {"up"}, value_of<Camera>(reading).up); }
bool read_fov(SceneReading& reading) {
  return read_number(reading.words, {"fov"}, {1, 170}, value_of<Camera>(reading).fov_degrees);
}

constexpr Key kCameraKeys[] = {{"eye", kAlways, kAlways, read_eye},
                               {"look", kAlways, kAlways, read_look},
                               {"up", kAlways, kAlways, read_up},
                               {"fov", kAlways, kAlways, read_fov}};

// 2^-40 of a radian moves a picture by less than 10^-8 of a pixel.
constexpr double kParallel = 0x1p-40;

/// A material as its statement is read.
struct MaterialWords {
  Material material;
  Optics optics;
  Texture texture;
  bool textured = false;
};

bool read_diffuse(SceneReading& reading) {
  return read_grey_or_colour(reading.words, {"diffuse"}, {0, kLargestReflectance},
                             value_of<MaterialWords>(reading).material.diffuse);
}
bool read_reflect(SceneReading& reading) {
  return read_grey_or_colour(reading.words, {"reflect"}, {0, kLargestReflectance},
                             value_of<MaterialWords>(reading).optics.reflect);
}
bool read_transmit(SceneReading& reading) {
  return read_grey_or_colour(reading.words, {"transmit"}, {0, kLargestReflectance},
                             value_of<MaterialWords>(reading).optics.transmit);
}
bool read_highlight(SceneReading& reading) {
  return read_highlight(reading.words, value_of<MaterialWords>(reading).optics);
}

/// texture FILE [size W H]; the file itself is read when all meshes are known.
bool read_texture(SceneReading& reading) {
  Words& words = reading.words;
  MaterialWords& material = value_of<MaterialWords>(reading);
  if (!read_picture_path(reading, material.texture)) return false;
  material.textured = true;
  if (!words.at_word() || words.peek().text != "size") return true;
  words.take();
  constexpr Interval kSizes{1e-6, 1e6};
  return read_number(words, {"texture width, scene units"}, kSizes, material.texture.size_u) &&
         read_number(words, {"texture height, scene units"}, kSizes, material.texture.size_v);
}

constexpr Key kMaterialKeys[] = {{"diffuse", kAlways, kAlways, read_diffuse},
                                 {"texture", kAlways, 0, read_texture},
                                 {"reflect", kAlways, 0, read_reflect},
                                 {"transmit", kAlways, 0, read_transmit},
                                 {"highlight", kAlways, 0, read_highlight}};

}  // namespace

bool read_later_path(SceneReading& reading, std::string_view what, const Wanted& here, std::string_view& path) {
  Words& words = reading.words;
  if (!words.at_word()) return words.expected(what);
  const Token file = words.take();
  if (reading.wanted.kind == here.kind && reading.wanted.index == here.index) {
    words.place(file);
    return false;
  }
  std::string_view resolved;
  if (!words.resolve(file, resolved)) return false;
  path = reading.store.add_name(resolved);
  return true;
}

bool read_picture_path(SceneReading& reading, Texture& texture) {
  const auto index = static_cast<std::uint32_t>(reading.store.counts().textures);
  return read_later_path(reading, "the path of a picture", {Wanted::Kind::kTexture, index}, texture.path);
}

bool read_keys(SceneReading& reading, std::span<const Key> keys, std::uint32_t kind, void* value) {
  Words& words = reading.words;
  std::uint32_t seen = 0;
  reading.value = value;
  while (words.at_word()) {
    std::uint32_t k = 0;
    while (k < keys.size() && ((keys[k].kinds & kind) == 0 || keys[k].word != words.peek().text)) ++k;
    if (k == keys.size()) return expected_key(words, keys, kind);
    if ((seen >> k & 1) != 0) return words.expected("this word once only");
    seen |= std::uint32_t{1} << k;
    reading.key = words.take();
    if (!keys[k].read(reading)) return false;
  }
  for (std::uint32_t k = 0; k < keys.size(); ++k) {
    if ((keys[k].required & kind) != 0 && (seen >> k & 1) == 0) return words.expected(keys[k].word);
  }
  return true;
}

bool read_statements(SceneReading& reading) {
  Words& words = reading.words;
  if (!words.restart()) return false;
  while (true) {
    if (words.peek().kind == TokenKind::kEndOfLine) {
      words.take();
    } else if (words.peek().kind == TokenKind::kEndOfFile && words.included()) {
      words.leave();
    } else if (words.peek().kind == TokenKind::kEndOfFile && reading.started) {
      return true;
    } else {
      if (!read_statement(reading)) return false;
      if (reading.store.overflowed()) return changed_while_reading(reading);
    }
  }
}

bool changed_while_reading(SceneReading& reading) {
  reading.words.mistake(reading.statement, StatusCode::kFile)
      .add("expected the files of the scene to stay the same while they are read");
  return false;
}

bool read_reference(SceneReading& reading, std::string_view what, FindName find, std::uint32_t& index) {
  Token name;
  if (!read_name(reading.words, what, name)) return false;
  index = (reading.store.*find)(name.text);
  if (index != kNone) return true;
  index = 0;
  if (!reading.store.storing()) return true;
  MessageText message = reading.words.mistake(name);
  message.add("expected ").add(what).add(" defined above");
  add_found(message, name);
  return false;
}

bool read_new_name(SceneReading& reading, std::string_view what, FindName find, Token& name) {
  if (!read_name(reading.words, what, name)) return false;
  if ((reading.store.*find)(name.text) == kNone) return true;
  MessageText message = reading.words.mistake(name);
  message.add("expected ").add(what).add(" not used before");
  add_found(message, name);
  return false;
}

bool left_out(SceneReading& reading, const Token& at) {
  reading.words.mistake(at).add("this library is built without '").add(at.text).add('\'');
  return false;
}

/// unit m|cm|mm|in|ft: once, in the top file.
bool read_unit(SceneReading& reading) {
  Words& words = reading.words;
  if (words.included()) return words.expected(reading.statement, "'unit' in the top file only");
  if (reading.unit_given) return words.expected(reading.statement, "'unit' once only");
  for (const Unit& unit : kUnits) {
    if (!words.at_word() || unit.word != words.peek().text) continue;
    words.take();
    reading.store.scene().metres_per_unit = unit.metres;
    return reading.unit_given = true;
  }
  return words.expected("m, cm, mm, in or ft");
}

/// display MIN MAX [clip|roll]: once.
bool read_display(SceneReading& reading) {
  Words& words = reading.words;
  if (reading.display_given) return words.expected(reading.statement, "'display' once only");
  Display& display = reading.store.scene().display;
  if (!read_number(words, {"display minimum, cd/m2"}, kNotNegative, display.min_cd_m2)) return false;
  const Token at = words.peek();
  if (!read_number(words, {"display maximum, cd/m2"}, kNotNegative, display.max_cd_m2)) return false;
  if (!(display.max_cd_m2 > display.min_cd_m2)) return words.expected(at, "a display maximum above the minimum");
  if (words.at_word()) {
    display.roll = words.peek().text == "roll";
    if (!display.roll && words.peek().text != "clip") return words.expected("clip, roll or the end of the line");
    words.take();
  }
  return reading.display_given = true;
}

/// camera NAME eye X Y Z look X Y Z up X Y Z fov DEGREES
bool read_camera(SceneReading& reading) {
  Words& words = reading.words;
  Token name;
  if (!read_new_name(reading, "the name of a camera", &SceneStore::find_camera, name)) return false;
  Camera camera;
  if (!read_keys(reading, kCameraKeys, kAlways, &camera)) return false;
  if (camera.look == camera.eye) {
    words.mistake(name).add("expected a camera that looks at another point than its eye");
    return false;
  }
  if (!(length(cross(unit_vector(camera.look - camera.eye), camera.up)) > kParallel)) {
    words.mistake(name).add("expected a camera whose 'up' is not parallel to its view");
    return false;
  }
  if (reading.wanted.kind == Wanted::Kind::kCamera && reading.wanted.index == reading.store.counts().cameras) {
    words.place(name);
    return false;
  }
  camera.name = reading.store.add_name(name.text);
  reading.store.add(camera);
  return true;
}

/// include PATH; the file is entered when the statement has ended.
bool read_include(SceneReading& reading) {
  if constexpr (!features::kIncludes) return left_out(reading, reading.statement);
  if (!reading.words.at_word()) return reading.words.expected("the path of a file");
  reading.include = reading.words.take();
  return true;
}

/// material NAME diffuse RHO | R G B, and more: texture, reflect, transmit, highlight
bool read_material(SceneReading& reading) {
  Token name;
  if (!read_new_name(reading, "the name of a material", &SceneStore::find_material, name)) return false;
  MaterialWords words;
  if (!read_keys(reading, kMaterialKeys, kAlways, &words)) return false;
  if (!keep_energy(reading, name, words.material, words.optics)) return false;
  words.optics.material = words.texture.material = static_cast<std::uint32_t>(reading.store.counts().materials);
  words.material.name = reading.store.add_name(name.text);
  reading.store.add(words.material);
  if (does_anything(words.optics)) reading.store.add(words.optics);
  if (words.textured) reading.store.add(words.texture);
  return true;
}

}  // namespace shodo
