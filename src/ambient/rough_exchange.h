// The exchange between two near parallelograms, roughly (ours; paper 3.2 rule 3).
//
// Pairs too near for a series, and too dark for a contour integral, get a disc's form factor cos cos A / (pi r^2 + A)
// between the quarters of both ends, 16 terms: of each quarter what is in front of the other's plane. Lengths and
// heights are 32-bit integers as in ambient/link_series.h. Approximate: 18 % in
// the root mean square over all near pairs of a room, where a single disc has 34 %, and 10 % at most in their sum.
#pragma once

#include "ambient/link_series.h"

namespace shodo {

/// v = G / (R_i R_j) between two nodes that have places.
double rough_exchange(const PlacedSide& i, const PlacedSide& j);

}  // namespace shodo
