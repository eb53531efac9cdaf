// Textured surfaces along a scanline (beyond the paper; picture/texture_shade.h).
//
// Texture coordinates are map coordinates times a factor of the mesh. As in shade.h they are quotients at the ends of
// pieces, of at most 8 samples, and linear between, to 1/256 texel of the level that is looked at. Levels follow the
// widest of the steps from a sample to the next one and to the one below, in texels, so that texels in between are
// never left out: nothing shimmers, and what lies flat to the eye is blurred along with what it is seen through.
//
// Approximate: ends of pieces are computed in doubles. A span that fixed point doesn't hold (the eye a hair off the
// plane) shows the mean.
//
// The map of a textured mesh holds its reflected light above 0 cd/m2, not above MIN, which is taken off after the
// product; what a light's faces emit is added as it is. Cost: some 700 instructions a sample, only where a texture is
// seen.
#pragma once

#include <cstdint>

#include "picture/active_triangle.h"
#include "picture/texture_shade.h"

namespace shodo {

/// A span of a textured mesh.
struct TexturedSpan {
  const Scene& scene;
  const Mesh& mesh;
  const MeshTexture& texture;
  MapTexels map;
  const ActiveTriangle& active;  // settled for the row
  const DrawnTriangle& carrier;
  const SampleGrid& grid;
  std::int32_t row, x0, x1;      // columns
};
void show_textured(const TexturedSpan& span, const SampleRow& samples);

}  // namespace shodo
