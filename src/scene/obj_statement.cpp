// obj FILE [scale S] [turn X Y Z] [at X Y Z] [material NAME]
#include "scene/faces.h"
#include "scene/obj_file.h"
#include "scene/statements.h"
#include "scene/values.h"

namespace shodo {

namespace {

// As many as files may be included, and for the same reason: many times many statements would never end.
constexpr std::uint32_t kMostModels = 1000;

struct ModelWordsGiven {
  ModelPlace place;
  std::uint32_t material = kNone;
};

bool read_scale(SceneReading& reading) {
  return read_number(reading.words, {"scale"}, {1e-30, kLargestNumber}, value_of<ModelWordsGiven>(reading).place.scale);
}
bool read_turn(SceneReading& reading) {
  return read_point(reading.words, {"turn, degrees"}, value_of<ModelWordsGiven>(reading).place.turn);
}
bool read_at(SceneReading& reading) {
  return read_point(reading.words, {"at"}, value_of<ModelWordsGiven>(reading).place.at);
}
bool read_material_name(SceneReading& reading) {
  return read_reference(reading, "the name of a material", &SceneStore::find_material,
                        value_of<ModelWordsGiven>(reading).material);
}

constexpr Key kModelKeys[] = {{"scale", 1, 0, read_scale},
                              {"turn", 1, 0, read_turn},
                              {"at", 1, 0, read_at},
                              {"material", 1, 0, read_material_name}};

}  // namespace

bool read_obj(SceneReading& reading) {
  if constexpr (!features::kModels) {
    return left_out(reading, reading.statement);
  } else {
    Words& words = reading.words;
    if (reading.models++ == kMostModels) return words.expected(reading.statement, "at most 1000 'obj' in all");
    Mesh mesh;
    if (!begin_mesh(reading, mesh)) return false;
    if (!words.at_word()) return words.expected("the path of a file");
    const Token file = words.take();
    ModelWordsGiven given;
    if (!read_keys(reading, kModelKeys, 1, &given)) return false;
    std::string_view path, text;
    return words.read(file, path, text) && read_obj_file(reading, path, text, given.place, given.material);
  }
}

}  // namespace shodo
