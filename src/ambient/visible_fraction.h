// The visible fraction of a pair of patches, by fixed segments (paper 2.2, 3.1; design: form factors).
//
// First the segments between all points of a small set of both patches. All free or all blocked: that is the answer.
// Mixed: the fraction of a denser set, weighted by the kernels cos cos / r^2 of the ends; the first set then only
// told that it is needed, and stops at the first disagreement. Ends inside something are blocked by themselves, so
// what comes out is the exchange between the parts that are not hidden. Points whose kernel is not positive have no
// weight, and cost no segment; if none has one although the exchange isn't zero (a sliver in front of the other's
// plane), all count the same. Where nothing can come between (visibility/intersector.h), the answer is 1 without a
// segment, as all would say. Exact: each segment. Approximate: a shadow's edge between samples, standard error about
// sqrt(V (1 - V) / N).
#pragma once

#include "ambient/sight.h"
#include "ambient/surfaces.h"
#include "visibility/intersector.h"

namespace shodo {

/// The denser sets of the receiving patch, placed when a pair of its row first needs them.
struct DenseSamples {
  LatticePoint few[kMostSamples / 2];
  LatticePoint many[kMostSamples];
  bool placed = false;
};

struct VisibleFraction {
  double value = 1;
  double variance = 0;  // estimated
};

/// `sight` has the list of the pair, or is null. Then `wide` is aimed between
/// boxes that hold the cached samples of i and of j (ambient/surfaces.h).
VisibleFraction visible_fraction(const Surfaces& surfaces, std::uint32_t i, std::uint32_t j, bool crossing,
                                 const Options& options, Intersector& intersector, Sight* sight, const Aim& wide,
                                 DenseSamples& dense_i);

}  // namespace shodo
