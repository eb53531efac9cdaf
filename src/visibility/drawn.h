// What is drawn of a polygon: its own triangles, or, if its map is not affine on them, those of its patches.
#pragma once

#include "visibility/placement.h"
#include "visibility/ring.h"

namespace shodo {

/// The polygon with what is inserted in its edges; `p` is its number in the order of the walk.
Ring polygon_ring(const Scene& scene, const Placement& placement, std::uint32_t p, const Polygon& polygon);

/// The point between patches k - 1 and k on an edge of a polygon that is drawn patch by patch.
Vec3 edge_point(const Scene& scene, const Polygon& polygon, std::uint32_t edge, std::uint32_t k);

/// Hands on the triangles of the picture.
void cut_drawn(const Scene& scene, const Placement& placement, std::uint32_t p, const Polygon& polygon,
               const TriangleSink& sink);

}  // namespace shodo
