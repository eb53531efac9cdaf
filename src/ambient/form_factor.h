// The geometry of the exchange between two patches, in three tiers by the error allowed (paper 2.2; design: form
// factors).
//
// G_ij = A_i F_ij = A_j F_ji, scene units squared, without shadows, is found once for the pair:
//
//     far     A_i A_j cos cos / (pi r^2) between centroids     error q, q = (s_i^2 + s_j^2) / (3 d^2)
//     middle  the same on 2 x 2 Gauss points of both           0.25 q^2; with a triangle 0.04 q^(3/2), as its 4 points
//                                                              are exact to degree 2 only
//     near    contour integral (ambient/near_factor.h)         what its last two rules differ by
//
// errors relative to A_i A_j / (pi d^2), s the longest sides; largest met among 6,000 pairs at distances of 1.5 to 20
// sides: 0.92 q, 0.15 q^2 (0.27 at 20), 0.03 q^(3/2). Patches behind each other's plane, and coplanar ones,
// exchange exactly nothing. A patch that crosses the other's plane, and a concave one, always take the near tier.
// Which patch is looked at in the near tier: the larger; of equals the one that stands higher over the other's plane;
// so neither the order of patches nor that of vertices matters. A quadrilateral that isn't planar counts with its mean
// normal, its vector area and the contour of its own edges.
#pragma once

#include "ambient/surfaces.h"

namespace shodo {

/// Errors that `tiers` = 0 (always the contour integral) asks of the near tier.
inline constexpr double kNearTolerance = 1e-4;

/// The receiving patch of a row, with what all its pairs need.
struct RowSide {
  std::uint32_t position = 0;
  const Patch* patch = nullptr;
  const PatchShape* shape = nullptr;
  double side_squared = 0;
  Vec3 gauss[4];      // SampleSet::kGauss, from the centre
  double weight[4];   // of the area, sum 1
  double own[4];      // their heights over the mean plane; 0 of a planar patch
};

/// Good while few other nodes are looked at (ambient/surfaces.h).
RowSide row_side(const Surfaces& surfaces, std::uint32_t position);
/// Good as long as `own`, which gets the geometry where the surfaces don't keep it.
RowSide row_side(const Surfaces& surfaces, std::uint32_t position, NodeGeometry& own);

struct PairExchange {
  double geometric = 0;   // G, scene units squared
  double error = 0;       // of it, estimated
  bool crossing = false;  // a patch crosses the other's plane: some samples may not see each other's front
};

/// A link as a series of second order about the centres.
struct PairSeries {
  bool away = false;        // they don't see each other's front
  bool crossing = false;
  bool found = false;       // else too near, or of shapes that have no series
  double squared = 0;       // of the distance of the centres
  double geometric = 0;
  double error = 0;         // of it, estimated
  // Mean squares of how the kernel varies over i, and over j, relative; not always found where both are patches.
  double vary_i = 0, vary_j = 0;
};

PairSeries series_between(const Surfaces& surfaces, const RowSide& i, std::uint32_t j);

/// `tolerance` of A_i A_j / (pi d^2); 0: near tier always. j's position is above i's.
PairExchange exchange_between(const Surfaces& surfaces, const RowSide& i, std::uint32_t j, double tolerance);

}  // namespace shodo
