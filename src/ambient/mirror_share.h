// What diffuse surfaces send each other over mirrors (--mirror-light on; doc/optics.md): the mirrors' share in form
// factors, one reflection long.
//
// For a patch i with luminances known everywhere, and every mirror's triangle,
//
//     M_i += reflect F(i, image of j) rho_j E_j,     summed over all patches j,
//
// F by the kernel between 4 points of i and the images of 4 points of j, each of the 16 counted if the way passes the
// triangle and neither leg is blocked; panes weaken both legs. That is a row of form factors times the light, without the
// matrix: the system E = E0 + (F + M) rho E is solved with F as always and M E added to E0, twice; what a third time
// would add is the square of the mirrors' share.
// Exact: what the ways meet. Approximate: 16 points for an integral, as in the middle tier of form factors, also where a
// patch and an image are near each other.
// Bytes: 24 channels a patch while the ambient stage runs; none without mirrors.
#pragma once

#include "ambient/ambient.h"

namespace shodo {

/// As light_ambiently(), through panes and, if the options say so, over mirrors.
Status light_ambiently_with_optics(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                                   const DirectLight& direct, Intersector& intersector, const Options& options,
                                   const Progress& progress, Arena& arena, AmbientLight& ambient,
                                   Statistics& statistics);

/// Arena bytes that it takes besides.
std::uint64_t mirror_share_bytes(const Scene& scene, const Options& options);

}  // namespace shodo
