// Which sub-patch a point of a surface lies on: what a line crosses (ambient/gather.h).
//
// A triangle of the geometry is one of a polygon of the file, found by its number. On a triangle or a parallelogram map
// coordinates are linear in the point; elsewhere the bilinear map is inverted, as seen along an axis, or a polygon that
// is cut by halves. Approximate: coordinates are known to 1e-3 of a sub-patch and a step of the lattice, and a point
// that rounding puts beyond an edge counts as on it.
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

  /// Whether a triangle is a mesh's, not an area light's.
  bool is_of_mesh(std::uint32_t triangle) const { return cell_of_[triangle] != kNone; }
  /// At a point of a triangle, or next to it.
  Found find(std::uint32_t triangle, const LatticePoint& at) const;

  /// Points of one polygon that follow each other evenly along a line, and the sub-patches on which they lie.
  class Walk {
   public:
    /// Counted from the scene's first; each call is for the next point.
    std::uint32_t next() {
      const std::uint32_t column = part(u_, in_u_), row = part(v_, in_v_);
      u_ = wrapped_sum(u_, along_u_);
      v_ = wrapped_sum(v_, along_v_);
      return first_ + row * width_ + column;
    }

   private:
    friend class SubPatchFinder;
    static constexpr int kBits = 16;  // of a sub-patch
    static std::uint32_t part(std::int32_t at, std::uint32_t count) {
      const std::uint32_t whole = static_cast<std::uint32_t>(at >> kBits);
      return whole < count ? whole : at < 0 ? 0 : count - 1;
    }
    /// After the last point it may be anything.
    static std::int32_t wrapped_sum(std::int32_t a, std::int32_t b) {
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
    }

    std::int32_t u_ = 0, v_ = 0, along_u_ = 0, along_v_ = 0;
    std::uint32_t first_ = 0, width_ = 0;
    std::uint16_t in_u_ = 1, in_v_ = 1;
  };
  /// From a point of a triangle on; `way`: from point to point, in 2^-kWayBits of a step. False: map coordinates there
  /// aren't linear, ask find() for each point.
  bool start(std::uint32_t triangle, const LatticePoint& at, const LatticePoint& way, Walk& walk) const;
  static constexpr int kWayBits = 10;
  /// From another point of the same polygon, the same way; of a walk that started.
  void go_on(std::uint32_t triangle, const LatticePoint& at, Walk& walk) const;

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
