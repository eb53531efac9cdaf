// Illuminance on all measuring planes of a solved scene: direct light, then what the patches send.
#pragma once

#include "ambient/plane_gather.h"
#include "light/plane_light.h"

namespace shodo {

/// Takes and fills the maps of the planes, which stay. What was counted goes to `statistics`, apart from the counts of
/// the light stages. Errors: kMemory, kInterrupted.
Status measure_planes(const SolvedPatches& solved, const Options& options, Intersector& intersector,
                      const Progress& progress, Arena& arena, PlaneMaps& maps, Statistics& statistics);

}  // namespace shodo
