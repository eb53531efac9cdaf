// A final gather: the ambient illuminance of every sub-patch, once the patches' is known (ours, beyond paper 2.3;
// deviation D19; doc/gather.md).
#pragma once

#include <cstdint>
#include <span>

#include "ambient/ambient.h"
#include "ambient/surfaces.h"
#include "base/arena.h"
#include "light/direct.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"
#include "shodo/status.h"
#include "visibility/intersector.h"

namespace shodo {

/// What one node may make wrong of a sub-patch's illuminance, of the scene's mean.
inline constexpr double kGatherError = 1e-3;

/// `ambient_lx` holds what was interpolated, [sub_patch * channels + channel], and gets what is gathered by every
/// sub-patch that is not hidden and whose patch wasn't dropped. Errors: kMemory, kInterrupted.
Status gather_illuminance(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                          const DirectLight& direct, const AmbientLight& ambient, Intersector& intersector,
                          const Options& options, const Progress& progress, Arena& arena, std::span<float> ambient_lx,
                          Statistics& statistics);

/// Arena bytes of it, all of which it gives back.
std::uint64_t gather_bytes(const Scene& scene, const Geometry& geometry, const Options& options, SurfacesKeep keep);

}  // namespace shodo
