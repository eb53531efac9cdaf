// A final gather: the ambient illuminance of every sub-patch, once the patches' is known (ours, beyond paper 2.3;
// deviation D19; doc/gather.md).
//
//     E_x = mean over rays of rho E of the sub-patch that is met first,     E direct and ambient
//
// over N rays from 16 places of the sub-patch x, in directions even by cosine (ambient/spiral.h). The sub-patches of a
// patch share their directions, so that what parallel rays can meet is listed once for all of them
// (visibility/parallel_rays.h). A pilot of up to 32 rays, whose light isn't used, tells how much light varies over the
// directions of a patch; of the others a quarter are shared out evenly, three quarters by that and by area, so that
// N is the mean over the scene.
//
// No form factor, no segment, nothing is scaled: what is left is noise, and that the sub-patches that are met are one
// value each. Values that are new already are used, meshes ascending. Rays know nothing of the flags that a scene
// gives: they meet what is there. Exact: what a ray meets. Approximate: the mean, to about N^-0.6 of its spread; a
// twisted patch has its mean normal.
// Bytes: those of the intersector, 52 a polygon, 4 a triangle, 2 a sub-patch and channel, 4 a patch, 3,584.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/direct.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"
#include "shodo/status.h"
#include "visibility/intersector.h"

namespace shodo {

/// Rays of a sub-patch, on average.
inline constexpr std::uint32_t kGatherRays = 256;

/// `ambient_lx` holds what was interpolated, [sub_patch * channels + channel], and gets what is gathered by every
/// sub-patch that is not hidden and whose patch wasn't dropped. Errors: kMemory, kInterrupted.
Status gather_illuminance(const Scene& scene, const Geometry& geometry, const DirectLight& direct,
                          Intersector& intersector, const Options& options, const Progress& progress, Arena& arena,
                          std::span<float> ambient_lx, Statistics& statistics);

/// Arena bytes of it, all of which it gives back.
std::uint64_t gather_bytes(const Scene& scene, const Geometry& geometry, const Options& options);

}  // namespace shodo
