// What parallel rays meet first: the light that comes from one direction (ambient/gather.h).
//
// What all of them may meet is listed once (visibility/sweep.h). Then each ray asks: of facets square to an axis, which
// are most of a room's, the nearest is found by products of 32 bits; the others are tested exactly, in 64, if the ray
// doesn't surely pass by their boxes and they don't surely lie behind it.
// Exact: what is met, as Intersector::nearest() tells it; ties too. Approximate: where, to a step of the lattice.
// Bytes: none; it uses the intersector's list of a wide aim.
#pragma once

#include <cstdint>

#include "visibility/intersector.h"

namespace shodo {

class ParallelRays {
 public:
  /// What a ray meets.
  struct First {
    std::uint32_t triangle = kNone;  // of the geometry, or another of its polygon
    bool front = false;              // seen from its front
    LatticePoint at;                 // to a step
  };

  /// Between start() and finish() of the intersector.
  ParallelRays(const Geometry& geometry, Intersector& intersector);

  /// From points of a box along a direction of lattice_direction(). Wide aims of the intersector are not valid
  /// afterwards.
  void aim(const LatticeBox& from, const LatticeVector& direction);
  /// Of the ray from a point of the box.
  First first(const LatticePoint& from) const;
  /// Triangles that one ray is tested against.
  std::uint64_t tests() const { return intersector_.tests_of(listed_); }

 private:
  struct Nearest;
  void offer_flat(const Facet& facet, const LatticePoint& from, Nearest& best) const;
  void offer_tilted(const Facet& facet, const LatticePoint& from, Nearest& best) const;
  bool passes_by(const LatticeBox& box, const LatticePoint& from) const;
  First settled(const LatticePoint& from, const Nearest& best) const;
  First met(const LatticePoint& from, std::uint32_t triangle, bool front, std::int64_t far, std::int64_t fast) const;
  std::int32_t way_out(const LatticeBox& from) const;
  LatticePoint reached(const LatticePoint& from, std::uint32_t part) const;

  const Geometry& geometry_;
  Intersector& intersector_;
  LatticeBox around_;  // all facets
  LatticeVector direction_;
  LatticePoint way_;  // the same
  std::int32_t coarse_[3], doubt_[3];  // of the direction, in steps of 64, and of a linear form square to it
  Aim listed_;  // facets square to an axis first
  std::size_t flat_ = 0;  // of them
};

}  // namespace shodo
