// Polygons that lie in one plane and share area: those that face the same way receive and send twice (design:
// pictures), those that face each other, though the file has them apart, are nearer than the lattice tells.
#pragma once

#include <cstdint>

#include "model.h"

namespace shodo {

/// Pairs of polygons of the scene's meshes, decided exactly on the lattice; polygons that touch along an edge don't
/// count.
std::uint64_t coplanar_overlaps(const Model& model);

/// The same of polygons that face each other in the file and lie in one plane on the lattice: nearer than two steps.
/// They exchange no light. The two sides of a thin wall, back to back, don't count.
std::uint64_t merged_plates(const Model& model);

}  // namespace shodo
