// The ambient stage's two steps in one, as the pipeline takes them where neither panes nor mirrors ask for more.
#pragma once

#include "ambient/ambient.h"

namespace shodo {

/// Errors: kMemory, kInterrupted. `ambient` stays in the arena.
inline Status light_ambiently(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                              const DirectLight& direct, Intersector& intersector, const Options& options,
                              const Progress& progress, Arena& arena, AmbientLight& ambient, Statistics& statistics) {
  AmbientWork* work = nullptr;
  const IntersectorScratch seeking(intersector);
  Status status = prepare_ambient(scene, geometry, patches, direct, intersector, options, arena, ambient, work);
  if (status.done()) status = solve_prepared(direct, intersector, progress, *work, statistics);
  if (work != nullptr) arena.release(work->after_result);
  return status;
}

}  // namespace shodo
