// The bytes of the ambient stage (design: promise 2: less memory costs time, never pixels).
#pragma once

#include <cstdint>

#include "scene/scene.h"
#include "shodo/options.h"
#include "visibility/geometry.h"

namespace shodo {

/// Stays in the arena when the stage is done: AmbientLight.
std::uint64_t ambient_result_bytes(const Scene& scene);

/// The least the stage needs of the arena, AmbientLight included, with no row kept:
///   8 n c (result) + 16 n c (fluxes) + 8 n (factors) + 64 n (surfaces, 4 samples each) + 96 a shape + 4 n (one row;
///   10 n with double values) + the coarse correction, at most 23 KiB, n patches, c channels;
/// with blocks besides what block_tree.h, link_worth.h, link_series.h and sight.h say.
/// Everything that the arena has beyond it goes to rows, and is given back at the end of the stage: what follows can
/// use all but AmbientLight, so no reserve is kept for it.
std::uint64_t smallest_ambient_bytes(const Scene& scene, const Geometry& geometry, const Options& options);

}  // namespace shodo
