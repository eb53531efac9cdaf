// How much of a sub-patch isn't inside or under something (visibility/hidden.h): of sixteen points of it, Sobol's first
// in the unit square (1967), turned over from sub-patch to sub-patch, none on a border (ambient/gather.h).
#pragma once

#include <cstdint>

#include "scene/mesh.h"
#include "visibility/intersector.h"

namespace shodo {

/// In sixteenths; of a sub-patch counted from the mesh's first, 16 of one without an area. Wide aims of the intersector
/// are not valid afterwards.
std::uint32_t visible_sixteenths(const Scene& scene, const Geometry& geometry, Intersector& intersector,
                                 std::uint32_t mesh, std::uint32_t local);

}  // namespace shodo
