// The statements of a scene file (contract 2): one function each, found by its first word.
//
// A statement's function reads the words after the first up to the end of the line and hands what it has read to the
// SceneStore; all statements are read alike when counting and when storing, except that names can be looked up only
// when storing. Values that belong to a word ("fov 65") may come in any order, each once.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "scene/scene_store.h"
#include "scene/words.h"

namespace shodo {

/// Something whose place in the file is asked for afterwards: a mistake that shows only when the whole scene is known.
struct Wanted {
  enum class Kind : std::uint8_t { kNothing, kMesh, kCamera, kTexture };
  Kind kind = Kind::kNothing;
  std::uint32_t index = 0;
};

/// One reading of a scene file.
struct SceneReading {
  SceneReading(Words& all_words, SceneStore& a_store) : words(all_words), store(a_store) {}

  Words& words;
  SceneStore& store;
  Wanted wanted;
  Token statement;  // its first word
  Token key;        // the word whose values are being read
  Token include;    // a path to go on with after the statement
  bool started = false;
  bool unit_given = false;
  bool display_given = false;
  std::uint32_t sub_u = 0, sub_v = 0;  // `sub` of the object that the next mesh belongs to; 0: not given
};

/// Reads the file from the start to its end, includes in place. When something is wanted, stops there (false), its
/// place in the status.
bool read_statements(SceneReading& reading);

/// The mistake of files that change while they are read; always false.
bool changed_while_reading(SceneReading& reading);

// statements.cpp
bool read_unit(SceneReading& reading);
bool read_display(SceneReading& reading);
bool read_camera(SceneReading& reading);
bool read_include(SceneReading& reading);
bool read_material(SceneReading& reading);
// mesh_statements.cpp
bool read_object(SceneReading& reading);
bool read_quad(SceneReading& reading);
bool read_tri(SceneReading& reading);
bool read_grid(SceneReading& reading);
bool read_obj(SceneReading& reading);
bool read_sub(SceneReading& reading);
// light_statements.cpp
bool read_light(SceneReading& reading);

/// A word that values follow, inside a statement; `kinds` and `required` are sets of bits, one a kind of statement.
template <class T>
struct Key {
  std::string_view word;
  std::uint32_t kinds;     // where it may stand
  std::uint32_t required;  // where it must
  bool (*read)(SceneReading& reading, T& value);
};

/// "expected <the keys that may stand here> or the end of the line"; always false.
template <class T>
bool expected_key(Words& words, std::span<const Key<T>> keys, std::uint32_t kind) {
  TextBuilder message = words.mistake(words.peek());
  message.add("expected ");
  for (const Key<T>& key : keys) {
    if ((key.kinds & kind) != 0) message.add(key.word).add(", ");
  }
  message.add("or the end of the line");
  add_found(message, words.peek());
  return false;
}

/// Reads keys with their values up to the end of the line, in any order, each at most once, none that is required
/// missing.
template <class T>
bool read_keys(SceneReading& reading, std::span<const Key<T>> keys, std::uint32_t kind, T& value) {
  Words& words = reading.words;
  std::uint32_t seen = 0;
  while (words.at_word()) {
    std::uint32_t k = 0;
    while (k < keys.size() && ((keys[k].kinds & kind) == 0 || keys[k].word != words.peek().text)) ++k;
    if (k == keys.size()) return expected_key(words, keys, kind);
    if ((seen >> k & 1) != 0) return words.expected("this word once only");
    seen |= std::uint32_t{1} << k;
    reading.key = words.take();
    if (!keys[k].read(reading, value)) return false;
  }
  for (std::uint32_t k = 0; k < keys.size(); ++k) {
    if ((keys[k].required & kind) != 0 && (seen >> k & 1) == 0) return words.expected(keys[k].word);
  }
  return true;
}

/// A lookup of SceneStore's.
using FindName = std::uint32_t (SceneStore::*)(std::string_view) const;

/// The name of something that is defined above: its index, 0 while counting. `what` as in "the name of a material".
bool read_reference(SceneReading& reading, std::string_view what, FindName find, std::uint32_t& index);
/// A name that nothing of its kind has yet.
bool read_new_name(SceneReading& reading, std::string_view what, FindName find, Token& name);
/// One or more of +blocks, -blocks, +shadowed_towards and so on, each once.
bool read_flags(SceneReading& reading, GivenFlags& flags);
/// "<the word> is not supported yet"; always false.
bool not_supported_yet(SceneReading& reading, const Token& at);

}  // namespace shodo
