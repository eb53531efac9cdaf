// Polygons that lie in one plane, face the same way and share area: they receive and send twice (design: pictures).
#pragma once

#include <cstdint>

#include "model.h"

namespace shodo {

/// Pairs of polygons of the scene's meshes, decided exactly on the lattice; polygons that touch along an edge don't
/// count.
std::uint64_t coplanar_overlaps(const Model& model);

}  // namespace shodo
