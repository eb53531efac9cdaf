// Ambient illuminance: form factors, sparse rows, Gauss-Seidel (paper 2.2, 3.2).
#pragma once

#include <cstdint>
#include <span>

#include "ambient/gauss_seidel.h"
#include "ambient/matrix.h"
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

/// What stands in the arena between the two steps.
struct AmbientWork {
  AmbientWork(Arena& arena, Arena::Mark mark) : matrix(arena), after_result(mark) {}

  Matrix matrix;
  Solver solver;
  Arena::Mark after_result;  // where the caller gives back what the steps took, but AmbientLight
};

/// The first step to solve E_i = E0_i + sum_j rho_j F_ij E_j, F_ij the fraction of the flux leaving i that reaches j
/// (deviation D1): surfaces, rules, what may stand between. Without `patches` their geometry, and that of blocks, is
/// found again whenever it is looked at. `work` is null if its memory was refused; `intersector` is the caller's to
/// finish(). Errors: kMemory.
Status prepare_ambient(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                       const DirectLight& direct, Intersector& intersector, const Options& options, Arena& arena,
                       AmbientLight& ambient, AmbientWork*& work);

/// The second: rows and solution, into the AmbientLight that was given first. Errors: kMemory, kInterrupted.
Status solve_prepared(const DirectLight& direct, Intersector& intersector, const Progress& progress, AmbientWork& work,
                      Statistics& statistics);

}  // namespace shodo
