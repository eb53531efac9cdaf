// One row of the exchange matrix: all nodes after i that node i is linked to (paper 2.2, 3.2).
//
// Whole meshes go first: those behind i's plane, those from whose plane i is behind, and i's own if it is planar. What
// remains goes link by link (ambient/link_walk.h): geometry (ambient/form_factor.h), then segments. The same bits
// whenever it is called.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/block_link.h"
#include "ambient/link_walk.h"
#include "ambient/row_store.h"
#include "ambient/sparsity.h"
#include "ambient/surfaces.h"
#include "shodo/options.h"
#include "visibility/intersector.h"

namespace shodo {

/// What the first pass learns of the errors of row sums, by node: what blocks are told holds for all their patches.
struct RowErrors {
  std::span<double> geometry;    // sum of the tiers' errors of F
  std::span<double> visibility;  // variance of the visible fractions, in F^2
  std::uint64_t computed = 0;    // pairs whose geometric factor was needed
};

/// Row i of a generation (ambient/sparsity.h) into `writer`; `errors` may be null.
void compute_row(const Surfaces& surfaces, const Sparsity& sparsity, LinkWalk& walk, BlockTools& tools,
                 std::uint32_t i, std::uint8_t generation, const Options& options, Intersector& intersector,
                 RowWriter& writer, RowErrors* errors);

}  // namespace shodo
