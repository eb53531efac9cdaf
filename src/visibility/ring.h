// Cutting a polygon with vertices inserted in its edges into triangles.
//
// A triangle whose edges carry further vertices becomes a fan over those of one edge from the corner opposite, and what
// stands on the two other edges fans from the first and last of them. The triangles' boundary is exactly the chain of
// vertices, whatever their place, so that neighbours along a chain leave no gap and don't overlap (topologically
// watertight); an edge without insertions costs nothing. Triangles without area come out too; callers drop them.
#pragma once

#include <cstdint>
#include <span>

#include "base/lattice.h"
#include "visibility/placement.h"

namespace shodo {

/// A vertex of a triangle to be, with its map coordinates, sub-patches in 24.8 fixed point.
struct RingVertex {
  LatticePoint point;
  std::int32_t u = 0, v = 0;
};

/// An edge from `from` to `to` and the sites inserted between, in that order.
struct RingEdge {
  RingVertex from, to;
  std::span<const Insertion> inserted;
};

/// Up to four edges, counter-clockwise; each ends where the next begins.
struct Ring {
  RingEdge edge[4];
  std::uint32_t edges = 4;
  bool cut_from_1 = false;
};

/// Takes the triangles one by one.
struct TriangleSink {
  void (*take)(void* context, const RingVertex& a, const RingVertex& b, const RingVertex& c) = nullptr;
  void* context = nullptr;
};

/// `with_drawn`: insert corners of drawn patches too.
void cut_ring(const Ring& ring, std::span<const LatticePoint> sites, bool with_drawn, const TriangleSink& sink);

}  // namespace shodo
