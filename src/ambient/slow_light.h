// Conjugate gradients for light that sweeps follow too slowly: along corridors, between plates near each other, where
// reflectance is nearly 1 (ours; design: solution; deviation D5). Rooms never get here.
//
// With y_i = rho_i R_i a_i and t_i^2 = rho_i R_i f_i (ambient/matrix.h) the equations of the patches that receive,
// send, and have light already are
//     y_i / t_i^2 - sum_j v_ij y_j = sum_j v_ij rho_j R_j E0_j + sum over others of v_ij rho_j R_j E_j,
// symmetric, and positive definite if row sums of F rho are below 1. Conjugate gradients (Hestenes and Stiefel 1952)
// need one pass over the upper triangle a step, and no estimate of any eigenvalue. They are preconditioned by the sum
// of
//     - two patches that are each other's greatest v, at least 1/4, solved as one; other patches alone: between near
//       plates light goes to and fro in pairs;
//     - the coarse correction's matrix (ambient/coarse.h): what goes far.
// One channel at a time, so that colours need no memory beside the fluxes; in grey scenes two vectors more.
//
// What comes out is where sweeps go on: their bound, not the residual here, tells how good it is.
// Bytes: 16 a node in grey scenes.
#pragma once

#include <cstdint>

#include "ambient/gauss_seidel.h"

namespace shodo {

/// Changes ambient_lx of one channel until no row asks for more than `allowed_lx` else, or it gets no better. Sums run
/// by ascending node, so every budget gives the same bits. Leaves fluxes in disorder. A pass counts as a sweep. Errors:
/// kInterrupted.
Status solve_slow_light(const SolverRun& run, std::uint32_t channel, double allowed_lx, Statistics& statistics);

}  // namespace shodo
