// Ambient illuminance: form factors, sparse rows, Gauss-Seidel (paper 2.2, 3.2).
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/direct.h"
#include "scene/mesh.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"
#include "shodo/status.h"
#include "visibility/intersector.h"

namespace shodo {

/// Per patch and channel: the total illuminance less the direct, lux. Patches dropped or wholly hidden have 0.
struct AmbientLight {
  std::span<double> patch_lx;  // [patch * channels + channel]
};

/// Solves E_i = E0_i + sum_j rho_j F_ij E_j, F_ij the fraction of the flux leaving i that reaches j (deviation D1).
/// Without `patches` their geometry, and that of blocks, is found again whenever it is looked at. Errors: kMemory,
/// kInterrupted.
Status light_ambiently(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                       const DirectLight& direct, Intersector& intersector, const Options& options,
                       const Progress& progress, Arena& arena, AmbientLight& ambient, Statistics& statistics);

}  // namespace shodo
