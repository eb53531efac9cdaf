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
  enum class Kind : std::uint8_t { kNothing, kMesh, kCamera, kPlane, kTexture, kLuminaire };
  Kind kind = Kind::kNothing;
  std::uint32_t index = 0;
};

/// One reading of a scene file.
struct SceneReading {
  SceneReading(Words& all_words, SceneStore& a_store, Arena& an_arena, Status& a_status)
      : words(all_words), store(a_store), arena(an_arena), status(a_status) {}

  Words& words;
  SceneStore& store;
  Arena& arena;     // for scratch, which is given back with each statement
  Status& status;   // the one of `words`
  Wanted wanted;
  Token statement;  // its first word
  Token key;        // the word whose values are being read
  void* value = nullptr;  // what they are read into
  Token include;    // a path to go on with after the statement
  bool started = false;
  bool unit_given = false;
  bool display_given = false;
  bool background_given = false;
  std::uint32_t models = 0;            // `obj` so far
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
// optics_statements.cpp
bool read_background(SceneReading& reading);
bool read_glass(SceneReading& reading);
// mesh_statements.cpp
bool read_object(SceneReading& reading);
bool read_quad(SceneReading& reading);
bool read_tri(SceneReading& reading);
bool read_grid(SceneReading& reading);
bool read_sub(SceneReading& reading);
bool read_plane(SceneReading& reading);
// obj_statement.cpp
bool read_obj(SceneReading& reading);
// light_statements.cpp
bool read_light(SceneReading& reading);
/// Four different corners of a convex quad, in one plane as nearly as it matters.
bool read_plane_quad(SceneReading& reading, Vec3* corners);

/// A word that values follow, inside a statement; `kinds` and `required` are sets of bits, one a kind of statement.
struct Key {
  std::string_view word;
  std::uint32_t kinds;     // where it may stand
  std::uint32_t required;  // where it must
  bool (*read)(SceneReading& reading);
};

/// Reads keys with their values up to the end of the line, in any order, each at most once, none that is required
/// missing. The keys' functions find `value` in the reading: it must be what they take it for (value_of).
bool read_keys(SceneReading& reading, std::span<const Key> keys, std::uint32_t kind, void* value);
template <class T>
T& value_of(SceneReading& reading) {
  return *static_cast<T*>(reading.value);
}

/// A lookup of SceneStore's.
using FindName = std::uint32_t (SceneStore::*)(std::string_view) const;

/// The path of a picture, to be read when all meshes are known.
bool read_picture_path(SceneReading& reading, Texture& texture);
/// The path of a file that is read when everything has been counted; `what` as in "the path of a picture". False too if
/// it is the one that is wanted.
bool read_later_path(SceneReading& reading, std::string_view what, const Wanted& here, std::string_view& path);
/// The name of something that is defined above: its index, 0 while counting. `what` as in "the name of a material".
bool read_reference(SceneReading& reading, std::string_view what, FindName find, std::uint32_t& index);
/// A name that nothing of its kind has yet.
bool read_new_name(SceneReading& reading, std::string_view what, FindName find, Token& name);
/// One or more of +blocks, -blocks, +shadowed_towards and so on, each once.
bool read_flags(SceneReading& reading, GivenFlags& flags);
/// "this library is built without <the word>"; always false.
bool left_out(SceneReading& reading, const Token& at);

}  // namespace shodo
