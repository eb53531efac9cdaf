// The steps of place(), in the order in which they run. Each returns false if the arena is too small.
#pragma once

#include "visibility/placement.h"
#include "visibility/polygon_tree.h"

namespace shodo {

/// Lexicographic: x, then y, then z.
constexpr bool position_before(const LatticePoint& a, const LatticePoint& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// All of them; the tree is of the polygons as they are in the end.
bool place(const Scene& scene, Arena& arena, Placement& placement, PolygonTree& tree);

/// PolygonTriangles::raise of every polygon, once the triangles are there (raise.cpp).
void find_raises(const Scene& scene, const Placement& placement, const PolygonTree& tree, Geometry& geometry);

bool make_sites(const Scene& scene, Arena& arena, Placement& placement);
bool weld_sites(Arena& arena, Placement& placement);
bool make_rings(const Scene& scene, Arena& arena, Placement& placement);
bool insert_vertices(const PolygonTree& tree, Arena& arena, Placement& placement);
bool move_vertices(PolygonTree& tree, Arena& arena, Placement& placement);
/// `any`: whether there were some.
bool insert_crossings(PolygonTree& tree, Arena& arena, Placement& placement, bool& any);

/// Whether v is within 2 lattice steps, in each coordinate, of the edge from a to b; exact.
bool near_edge(const LatticePoint& a, const LatticePoint& b, const LatticePoint& v);

/// Brings what is inserted in a polygon in order: by edge, and along each edge. The order along an edge depends on its
/// ends and the sites only; polygons that run along it the other way get it reversed.
void sort_insertions(Placement& placement, std::uint32_t polygon);

}  // namespace shodo
