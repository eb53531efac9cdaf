// Textured surfaces in the picture (beyond the paper; scene/texture.h): the map's value times the texture's, over its
// mean.
//
// Texture coordinates are map coordinates times a factor of the mesh. As in shade.h they are quotients at the ends of
// pieces, of at most 8 samples, and linear between, to 1/256 texel of the level that is looked at. A texture is looked
// up in two levels of detail, bilinearly in each, and the two are mixed: levels follow the widest of the steps from a
// sample to the next one and to the one below, in texels, so that texels in between are never left out: nothing
// shimmers, and what lies flat to the eye is blurred along with what it is seen through. Values are linear light.
//
// Approximate: between levels the logarithm of the step is taken as a straight line. Weights have 8 bits, coordinates
// 1/2^32 of a repeat. Ends of pieces are computed in doubles and become integers in fixed_point() alone. A span that
// fixed point doesn't hold (the eye a hair off the plane) shows the mean.
//
// The map of a textured mesh holds its reflected light above 0 cd/m2, not above MIN, which is taken off after the
// product; what a light's faces emit is added as it is. Cost: some 700 instructions a sample, only where a texture is
// seen. Bytes: 32 a mesh, in scenes with textures.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/active_triangle.h"
#include "picture/texels.h"
#include "scene/texture.h"

namespace shodo {

/// How a mesh shows its texture.
struct MeshTexture {
  std::uint32_t texture = kNone;
  bool repeats = false;           // else it ends at the mesh's borders
  double s = 0, t = 0;            // repeats a sub-patch along u and v; t runs upwards in the picture
};

/// One for each mesh; none and no bytes if the scene has no textures. False if the arena is too small.
[[nodiscard]] bool find_mesh_textures(const Scene& scene, Arena& arena, std::span<MeshTexture>& textures);
std::uint64_t mesh_texture_bytes(const Scene& scene);

/// A span of a textured mesh.
struct TexturedSpan {
  const Scene& scene;
  const Mesh& mesh;
  const MeshTexture& texture;
  MapTexels map;
  const ActiveTriangle& active;  // settled for the row
  const DrawnTriangle& carrier;
  const SampleGrid& grid;
  std::int32_t row, x0, x1;
};
void show_textured(const TexturedSpan& span, const SampleRow& samples);

}  // namespace shodo
