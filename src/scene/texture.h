// Textures of materials (beyond the paper; contract 2): patterns whose mean is the material's `diffuse`.
//
// A file is a picture in sRGB. What it shows at a point, over its mean, multiplies the reflectance there, channel by
// channel, in linear light: so the mean reflectance of a textured surface is `diffuse`, and interreflection, which
// knows patches only, has the mean over each patch (patch_reflectance.h). No point may reflect more than everything:
// such a texture is refused.
//
// The library reads PPM and PGM (P6 and P5, 255 levels); the caller's Reader may make them of other files. Each level
// of detail halves the one before, rounded down, by exact area means of linear values, down to 1 x 1; levels are kept
// as 8-bit sRGB, so a level beyond the first is off by half a level of grey. One channel if the picture is grey.
//
// Loading a scene measures its textures and their parts on patches; texels are read again for each picture, so that
// light has the memory.
// Bytes, only for materials that some mesh has, once a file: 96 a texture statement and its path; while a
// picture is drawn 512 for the table of linear values and about 4/3 of width height channels.
#pragma once

#include <cstdint>

#include "base/arena.h"
#include "scene/scene.h"
#include "shodo/callbacks.h"
#include "shodo/status.h"

namespace shodo {

inline constexpr std::uint32_t kLargestTexture = 8192;  // texels along an edge

/// One level of detail.
struct TextureLevel {
  const std::uint8_t* texel = nullptr;  // [(row width + column) channels + channel], the picture's upper row first
  std::uint32_t width = 0, height = 0;
};

/// Level 0 is the picture; levels beyond the last are the last.
TextureLevel texture_level(const Texture& texture, std::uint32_t level);

/// Reads the files of all textures whose material is used, and what is to be known of them; texels aren't kept. On a
/// mistake `at` is the texture, and the status has no place. Errors: kFile, kScene, kMemory.
bool load_textures(Scene& scene, const Reader& reader, Arena& arena, Status& status, std::uint32_t& at);

/// Reads them again and takes their texels, all levels of detail: texel_bytes(). Errors: kFile, if they changed;
/// kMemory.
bool keep_texels(Scene& scene, const Reader& reader, Arena& arena, Status& status);
void forget_texels(Scene& scene);
std::uint64_t texel_bytes(const Scene& scene);

/// The texture of a mesh's material, kNone if it has none.
std::uint32_t texture_of(const Scene& scene, const Mesh& mesh);

/// How often a texture is repeated along a mesh's u and v: lengths of the mesh over `size`, 1 without one.
struct Repeats {
  double u = 1, v = 1;
};
Repeats texture_repeats(const Scene& scene, const Mesh& mesh, const Texture& texture);

}  // namespace shodo
