// Which sub-patch a point of a surface lies on: what a ray met (ambient/gather.h).
//
// A triangle of the geometry is one of a polygon of the file, found by its number. On a triangle or a parallelogram map
// coordinates are linear in the point; elsewhere the bilinear map is inverted by Newton's steps, a polygon that is cut
// by halves. Approximate: coordinates are known to 1e-3 of a sub-patch and a step of the lattice, and a point that
// rounding puts beyond an edge counts as on it.
// Bytes: 52 a polygon, 4 a triangle.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "scene/scene.h"
#include "visibility/geometry.h"

namespace shodo {

class SubPatchFinder {
 public:
  struct Found {
    std::uint32_t mesh = kNone;       // kNone: an area light
    std::uint32_t sub_patch = kNone;  // counted from the mesh's first
  };

  /// False: the arena is too small.
  bool take(const Scene& scene, const Geometry& geometry, Arena& arena);
  static std::uint64_t bytes(const Geometry& geometry);

  /// At a point of a triangle, or next to it.
  Found find(std::uint32_t triangle, const LatticePoint& at) const;

 private:
  /// u = first_u + along_u . (at - corner) / 2^32, in sub-patches of the mesh, and so v; not if it isn't linear.
  struct Cell {
    LatticePoint corner;
    std::int32_t along_u[3], along_v[3];
    std::uint32_t first_u, first_v;
    std::uint32_t mesh;
    std::uint32_t linear;
  };
  std::uint32_t find_bent(const Mesh& mesh, std::uint32_t cell, const LatticePoint& at) const;
  void fill(std::uint32_t mesh, std::uint32_t number, Cell& cell) const;

  const Scene* scene_ = nullptr;
  const Geometry* geometry_ = nullptr;
  std::span<Cell> cells_;
  std::span<std::uint32_t> cell_of_;  // by triangle; kNone: of an area light
};

}  // namespace shodo
