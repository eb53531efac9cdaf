// One row of the exchange matrix: all patches after i that patch i sees (paper 2.2, 3.2).
//
// Whole meshes go first: those behind i's plane, those from whose plane i is behind, and i's own if it is planar. What
// remains goes pair by pair: geometry (ambient/form_factor.h), then segments. The same bits whenever it is called.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/row_store.h"
#include "ambient/surfaces.h"
#include "shodo/options.h"
#include "visibility/intersector.h"

namespace shodo {

/// What the first pass learns of the errors of row sums, by position.
struct RowErrors {
  std::span<double> geometry;    // sum of the tiers' errors of F
  std::span<double> visibility;  // variance of the visible fractions, in F^2
  std::uint64_t computed = 0;    // pairs whose geometric factor was needed
};

/// Row i into `writer`; `errors` may be null.
void compute_row(const Surfaces& surfaces, std::uint32_t i, const Options& options, Intersector& intersector,
                 RowWriter& writer, RowErrors* errors);

}  // namespace shodo
