// Illuminance at any point of a surface, from its map: bilinear between the centres of sub-patches, as the picture
// shows it.
//
// Hidden sub-patches have no share. A triangle's map is a square here as in its PFM file: a cell has the mean of its
// upright and its inverted sub-patch. Approximate there: within a sub-patch of the hypotenuse.
#pragma once

#include <cstdint>

#include "model.h"

namespace shodo {

/// Lux at (u, v) of mesh m, sub-patches 20.12; 0 where all around is hidden.
double surface_lux(const Model& model, std::uint32_t m, std::int32_t u, std::int32_t v);

/// The sub-patch that holds (u, v), counted from the mesh's first.
std::uint32_t sub_patch_at(const Mesh& mesh, std::int32_t u, std::int32_t v);

}  // namespace shodo
