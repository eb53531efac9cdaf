// The bytes of the ambient stage (design: promise 2: less memory costs time, never pixels).
#pragma once

#include <cstdint>

#include "ambient/surfaces.h"
#include "scene/scene.h"
#include "shodo/options.h"
#include "visibility/geometry.h"

namespace shodo {

/// Stays in the arena when the stage is done: AmbientLight.
std::uint64_t ambient_result_bytes(const Scene& scene);

/// The least the stage needs of the arena, AmbientLight included, with no row kept:
///   8 n c (result) + 16 n c (fluxes; 32 n if c = 1) + 8 n (factors) + 4 n (one row; 10 n with double values) + the
///   coarse correction, at most 23 KiB + n, + link_bytes() + surfaces_bytes(): 64 n with 4 samples each + 96 a shape
///   where geometry is kept, else 12 n.
/// n patches, c channels; with blocks n counts nodes in all but the result.
/// Everything that the arena has beyond it goes to rows, and is given back at the end of the stage: what follows can
/// use all but AmbientLight, so no reserve is kept for it.
std::uint64_t smallest_ambient_bytes(const Scene& scene, const Geometry& geometry, const Options& options,
                                     SurfacesKeep keep = SurfacesKeep::kGeometry);

/// Of these: what tells which nodes are linked (ambient/link_walk.h, ambient/block_link.h). Nothing without rule 3 and
/// blocks.
std::uint64_t link_bytes(const Scene& scene, const Geometry& geometry, const Options& options);

/// What rows are expected to take, to judge whether geometry should make room for them; 0: no guess. Blocks have some
/// 21 links a node, at 4 bytes, and 4 to 8 bytes a row.
std::uint64_t expected_row_bytes(const Scene& scene, const Options& options);

}  // namespace shodo
