// Which triangles of the picture lie on one plane and carry one map (paper 2.3, 2.4).
//
// Polygons are drawn as triangles, many where T-junctions were mended, but the map of a parallelogram is affine. A
// triangle in exactly the plane of an earlier one of its mesh, whose corners have the coordinates that the earlier
// one's map gives there, takes that map: adjacent spans of both are then one to shade.
//
// Approximate: the coordinates agree to kPlaneTolerance at the corners, so all over the triangle. Planes are compared
// exactly. Bytes: 4 a drawn triangle.
#pragma once

#include <cstdint>
#include <span>

#include "visibility/geometry.h"

namespace shodo {

inline constexpr double kPlaneTolerance = 4;  // 1/256 sub-patch

/// map_of[t]: the triangle whose map t takes, t itself or an earlier one.
void find_map_planes(std::span<const DrawnTriangle> drawn, std::span<std::uint32_t> map_of);

}  // namespace shodo
