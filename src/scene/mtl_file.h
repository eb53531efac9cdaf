// Reads the materials of a Wavefront MTL file: their diffuse reflectance, and nothing else of them.
//
// Source: Wavefront Technologies, the Advanced Visualizer, appendix on the material library file format. `newmtl` and
// `Kd` are read; all other words are skipped, `Ke` among them: light comes from the scene's lights. Bytes: none of its
// own; time n log m for a file of n bytes and m materials that are used.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/vector.h"
#include "scene/words.h"

namespace shodo {

/// A material that some face of a model uses. Its name belongs to the model's files, not to the scene.
struct ModelMaterial {
  Token use;                // its name where a face first has it
  Rgb diffuse;
  std::uint32_t index = 0;  // of the scene's materials
  bool found = false;       // in a file, with a Kd
};
static_assert(sizeof(void*) != 8 || sizeof(ModelMaterial) == 64);

/// The material of that name; null if there is none. `materials` ascend by their names, each of which stands once.
ModelMaterial* find_model_material(std::span<ModelMaterial> materials, std::string_view name);

/// Takes the reflectances of those materials that the file has and that no file before had; of two with one name in it
/// the first counts. `path` and `text`: as Words::read_beside() gave them. False, with the place in the status: a name
/// is missing, a Kd isn't one or three numbers from 0 to 0.9999, a material that is used has none, or there is a
/// control character.
bool read_mtl_file(Words& words, std::string_view path, std::string_view text, std::span<ModelMaterial> materials);

}  // namespace shodo
