// Gauss-Seidel on the ambient equations (paper 2.2, 3.2; design: solution).
//
//     a_i = sum_j F_ij rho_j (E0_j + a_j),   E_i = E0_i + a_i,   in ascending order of positions
//
// One pass over the upper triangle is one sweep: when row i is at hand, the flux that the patches before it send (with
// their new values) has been gathered for it already, its own entries bring that of the patches after it (old values),
// and then it sends its new value to those. All channels go in one pass. After a sweep each mesh is corrected by one
// value (ambient/coarse.h).
//
// Blocks send and gather like patches (ambient/matrix.h): before the patches of a mesh get their new values, what its
// blocks have gathered is handed down to them; after the last of them, what they send is summed up to the blocks, which
// then send it on. No link has both ends in one mesh unless both are patches, so this is still Gauss-Seidel, mesh by
// mesh.
//
// Certified bound. After a sweep, before a correction, the residual of patch i is sum over j > i of M_ij (new_j -
// old_j), M = F rho, hence at most U max|new - old|, U the largest upper row sum of M; rounding adds at most (n + 16)
// 2^-52 max E. With q the largest row sum of M the error of every a_i is at most
//     (U max|new - old| + (n + 16) 2^-52 max E) / (1 - q).
// With blocks U is q, and n counts them too. It bounds the error against the exact solution of the stored system.
// Sweeps end when it is within the tolerance, when rounding is all that is left of it, or when nothing gets better any
// more in 30 sweeps (rows that sum to more than 1 / rho, possible only without scaling: the bound is then kNoBound).
// Where after the 6th sweep twelve more a channel are not likely to do, conjugate gradients (ambient/slow_light.h) go
// most of the way, and sweeps tell how far. Bytes: 16 channels a node for the fluxes (32 in grey scenes), 8 g (2 +
// channels) for means of the g groups.
#pragma once

#include <span>

#include "ambient/matrix.h"
#include "base/arena.h"
#include "light/direct.h"
#include "shodo/callbacks.h"
#include "shodo/statistics.h"

namespace shodo {

/// Reported where no bound is known.
inline constexpr double kNoBound = 1e30;

/// What a solution needs besides the matrix; everything by node but `ambient_lx`.
struct Solver {
  std::span<double> ambient_lx;  // [patch * channels + c], the answer; at first where to start from
  std::span<double> sent;        // [node * channels + c]: rho_i R_i E_i, of blocks sum of R_j / R_b times that
  std::span<double> gathered;    // [node * channels + c]: sum over earlier i of v_ij sent_i
  std::span<double> group_area;
  std::span<double> group_reflectance;  // [c * groups + g]: mean by area
  std::span<double> group_delta;
  std::span<double> row_errors;         // rule 2+: two a node, which stay from round to round
  std::span<double> spare;              // one channel: two a node, for the first pass and ambient/slow_light.h
};

/// A solution at work.
struct SolverRun {
  const DirectLight& direct;
  const Intersector& intersector;
  const Progress& progress;
  Matrix& matrix;
  Solver& solver;
};

/// Solves; `solver.gathered` is zero, the rest is filled here. Errors: kInterrupted.
Status solve_rows(const DirectLight& direct, const Intersector& intersector, const Progress& progress, Matrix& matrix,
                  Solver& solver, Statistics& statistics);

}  // namespace shodo
