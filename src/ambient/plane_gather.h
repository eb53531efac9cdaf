// Ambient illuminance on measuring planes: rows of the form-factor matrix that have no column
// (deviation D16).
//
//     E_x = sum over patches j, ascending, of F_xj V_xj rho_j E_j
//
// x is the centre of a sub-patch of a plane, E_j what the solution (gauss_seidel.h) found for patch j, direct and
// ambient. A plane sends nothing, so it is in nobody's row: all that was solved stays as it is without planes, bit by
// bit. F_xj is Lambert's contour integral from the point, exact for plane patches. V_xj is the visible part of 16
// segments to a grid on the patch, each weighted by its kernel; where an aim finds nothing in the way none is sent.
// Panes weaken each segment by what they let through, channel by channel.
//
// Approximate: E_j is one value a patch, so at less than a patch's size from a surface the steps between its patches
// show; V to 1/8 of a patch along a shadow's edge; rows aren't scaled. Bytes: scratch of 44 + 8 c a sub-patch of a
// plane's patch.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/ambient.h"
#include "light/direct.h"
#include "light/plane_light.h"

namespace shodo {

/// What the planes gather from; `patches` may be empty, then each is found again.
struct SolvedPatches {
  const Scene& scene;
  const Geometry& geometry;
  std::span<const Patch> patches;
  const DirectLight& direct;
  const AmbientLight& ambient;
};

/// Fills `ambient_lx` where not hidden; counts segments and tests of planes. Errors: kMemory, kInterrupted.
Status gather_planes(const SolvedPatches& solved, Intersector& intersector, const Progress& progress, Arena& arena,
                     PlaneMaps& maps, Statistics& statistics);

/// Arena bytes of gather_planes at most.
std::uint64_t plane_gather_bytes(const Scene& scene);

}  // namespace shodo
