// Samples of a sub-patch that look at lights together: one aim for all, one look at each face.
//
// The four Gauss points find the mean over a sub-patch that is lit evenly enough, together with the centre, which sees
// how much of a large light is covered. The 16 samples of the 4 x 4 grid resolve a sub-patch that is lit unevenly: they
// come as two groups of 8 (upright and inverted, 10 and 6, on a triangle), each mapped on itself by every mirror image
// of the sub-patch: corner and middle cells, and those between.
#pragma once

#include <cstdint>
#include <span>

#include "light/emitter.h"
#include "light/piece_grid.h"
#include "light/receiver.h"
#include "scene/mesh.h"
#include "visibility/blockers.h"
#include "visibility/geometry.h"

namespace shodo {

inline constexpr std::uint32_t kGridCuts = 4;
inline constexpr std::uint32_t kGridSamples = kGridCuts * kGridCuts;
inline constexpr std::uint32_t kGaussSamples = 4;
inline constexpr std::uint32_t kMostInGroup = 10;

struct ReceiverGroup {
  std::uint32_t count = 0;
  EndSet ends_of_area = kFirstEnds;  // which ends of an area light it looks at
  Vec3 point[kMostInGroup];    // scene units
  LatticePoint lattice[kMostInGroup];
  std::uint8_t grid_index[kMostInGroup] = {};  // of PieceGrid
  LatticeBox box;                              // around `lattice`

  Ends ends() const { return {std::span(lattice, count), box}; }
};

/// Where on its cell a sample's segments start.
Sample sample_at(const Scene& scene, const Geometry& geometry, const Receiver& receiver, const Vec3& point);

/// The fifth-degree points of PieceGrid::fine(); no segments start from them, so they have no lattice points.
ReceiverGroup fine_group(const PieceGrid& grid);
/// Nor have these: half (0 or 1) of the grid.
ReceiverGroup grid_half(const PieceGrid& grid, std::uint32_t half);
ReceiverGroup gauss_group(const Scene& scene, const Geometry& geometry, const Receiver& receiver,
                          const PieceGrid& grid);
/// The centre alone.
ReceiverGroup centre_group(const Scene& scene, const Geometry& geometry, const Receiver& receiver, const Piece& piece);
/// half: 0 or 1.
ReceiverGroup grid_group(const Scene& scene, const Geometry& geometry, const Receiver& receiver, const PieceGrid& grid,
                         std::uint32_t half);

}  // namespace shodo
