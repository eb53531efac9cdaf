#include "scene/mtl_file.h"

#include "scene/model_words.h"
#include "scene/values.h"

namespace shodo {

namespace {

constexpr Interval kReflectances{0, kLargestReflectance};

/// Kd R [G B]
bool read_reflectance(ModelWords& words, Rgb& diffuse) {
  if (!words.read_number({"Kd"}, kReflectances, diffuse.c[0])) return false;
  diffuse.c[1] = diffuse.c[2] = diffuse.c[0];
  if (!starts_number(words.peek())) return true;
  return words.read_number({"green of Kd"}, kReflectances, diffuse.c[1]) &&
         words.read_number({"blue of Kd"}, kReflectances, diffuse.c[2]);
}

bool expected_reflectance(ModelWords& words, const Token& name) {
  return words.expected(name, "a material with a Kd, since a face has it");
}

}  // namespace

ModelMaterial* find_model_material(std::span<ModelMaterial> materials, std::string_view name) {
  std::size_t first = 0, end = materials.size();
  while (first < end) {
    const std::size_t middle = first + (end - first) / 2;
    if (materials[middle].use.text == name) return &materials[middle];
    if (materials[middle].use.text < name) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return nullptr;
}

bool read_mtl_file(Words& words, std::string_view path, std::string_view text, std::span<ModelMaterial> materials) {
  ModelWords file(words, path, text);
  if (!file.countable()) return false;
  ModelMaterial* material = nullptr;  // the one being read, if it is wanted
  Token name;
  while (file.next_statement()) {
    if (!file.at_word()) return file.expected("a word of an MTL file");
    const Token word = file.take();
    if (word.text == "newmtl") {
      if (material != nullptr && !material->found) return expected_reflectance(file, name);
      if (!file.at_word()) return file.expected("the name of a material");
      name = file.take_name();
      material = find_model_material(materials, name.text);
      if (material != nullptr && material->found) material = nullptr;
    } else if (word.text == "Kd" && material != nullptr) {
      if (!read_reflectance(file, material->diffuse)) return false;
      material->found = true;
    } else if (!file.skip_statement()) {
      return false;
    }
    if (!file.end_statement()) return false;
  }
  return material == nullptr || material->found || expected_reflectance(file, name);
}

}  // namespace shodo
