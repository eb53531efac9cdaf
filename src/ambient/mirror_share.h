// What diffuse surfaces send each other over mirrors (--mirror-light on; doc/optics.md): the mirrors' share in form
// factors, one reflection long.
//
// For a patch i with luminances known everywhere, and every mirror's triangle,
//
//     M_i += reflect F(i, image of j) rho_j E_j,     summed over all patches j,
//
// F by the kernel between 4 points of i and the images of 4 points of j, each of the 16 counted if the way passes the
// triangle and neither leg is blocked; panes weaken both legs. That is a row of form factors times the light, without
// the matrix: the system E = E0 + (F + M) rho E is solved with F as always and M E added to E0 (ambient/rounds.h).
// Exact: what the ways meet. Approximate: 16 points for an integral, as in the middle tier of form factors, also where
// a patch and an image are near each other.
#pragma once

#include "ambient/ambient.h"

namespace shodo {

/// Whether there is any: mirrors, and the options ask for it.
bool mirrors_share(const Scene& scene, const Options& options);

/// What the mirrors send on of the light found so far, into `share_lx`, [patch * channels + channel]. Errors: kMemory,
/// kInterrupted.
Status share_over_mirrors(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                          const DirectLight& direct, const AmbientLight& ambient, Intersector& intersector,
                          const Progress& progress, Arena& arena, std::span<double> share_lx);

}  // namespace shodo
