// Direct illuminance of every sub-patch (paper 2.1), and what the ambient stage needs of it.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"
#include "shodo/status.h"
#include "visibility/intersector.h"

namespace shodo {

struct DirectLight {
  std::span<float> sub_patch_lx;   // [sub_patch * channels + channel], area means; 0 where hidden
  std::span<std::uint8_t> hidden;  // per sub-patch: 1 if inside or under something
  std::span<double> patch_lx;      // [patch * channels + channel]: E0, area-weighted over sub-patches not hidden
  std::span<float> visible_area;   // per patch: the fraction of its area that is not hidden
  std::span<float>
      light_form_factor;  // per patch: the part of its cosine-weighted hemisphere that area lights and openings fill
};

/// Errors: kMemory, kInterrupted.
Status light_directly(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                      const Options& options, Intersector& intersector, const Progress& progress, Arena& arena,
                      DirectLight& direct, Statistics& statistics);

}  // namespace shodo
