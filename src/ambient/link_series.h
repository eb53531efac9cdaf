// The exchange over a link of parallelograms, and how much it varies there, in integers (ours; paper 3.2 rule 3).
//
// The kernel h_i h_j / r^4 between two points (h: heights over each other's plane) is developed to second order about
// the centres, along the half axes of both patches. With u = (axis . way) / r^2, p = the height that the axis climbs,
// over h, and w = axis^2 / r^2, one axis changes the kernel's mean by (12 u^2 - 4 u p - 2 w) / 3 of it, and the mean
// square of its variation is (p - 4 u)^2 / 3, and about 0.1 q^2 more from the second order.
// The first makes the exchange, the second tells which end to split.
//
// Everything is a 32-bit integer: coordinates are lattice steps shifted right until 14 bits hold them, ratios have 14
// binary places. A floating-point operation costs the paper's workstation nine integer ones. Heights have so an error
// of 2^-14 of the distance at most; the series' own is kSeriesError q^2, relative to A_i A_j / (pi r^2), with q = 4/3
// of the sum of the squares of all half axes over r^2.
//
// A triangle counts as the parallelogram that has its moments: with edges a and b from corner 0, half axes
// (a - b / 2) / sqrt 6 and b / sqrt 8. Other quadrilaterals do so too, each node by itself, about its centroid: with
// the area element 1 + alpha x + beta y, half axes a sqrt((1 + beta^2) (1 - alpha^2 / 3)) and the like for b, which a
// trapezoid has exactly; how far their corners are from the parallelogram's is known, and what it leaves open is kOdd.
// Concave and much twisted ones have no place here, nor have pairs so near to each other's plane that rounding hides on
// which side they are (kOdd).
// Bytes: 16 a node, 40 a mesh, and 40 a node of meshes whose patches aren't parallelograms or triangles.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/surfaces.h"
#include "base/arena.h"
#include "visibility/lattice_box.h"

namespace shodo {

inline constexpr double kMostSeries = 0.5;    // the largest q for which there is a series
inline constexpr double kSeriesError = 0.5;   // times q^2

/// kOwn: a node with half axes of its own.
enum class PlaceKind : std::uint8_t { kOdd, kQuad, kTriangle, kOwn };

/// One mesh, or one node: half axes of a patch in 1/16 lattice steps, normal in 1/2^14.
struct MeshPlace {
  std::int32_t a[3] = {0, 0, 0}, b[3] = {0, 0, 0};
  std::int16_t normal[3] = {0, 0, 0};  // 0 unless planar
  PlaceKind kind = PlaceKind::kOdd;
  std::uint8_t flat = 0;  // bit k: all samples have the same coordinate along axis k
  std::uint32_t own = kNone;  // of a mesh: the first of its nodes' places, if they have their own
  std::int32_t extra = 0;     // of a node: no corner is farther from the parallelogram's, lattice steps
};

/// One node: centre in lattice steps; A / (R sqrt(pi)) in lattice steps.
struct NodePlace {
  std::int32_t centre[3] = {0, 0, 0};
  float weight = 0;
};
static_assert(sizeof(NodePlace) == 16 && sizeof(MeshPlace) == 40, "memory_plan.cpp");

/// The receiving end of a row.
struct PlacedSide {
  std::int32_t centre[3], a[3], b[3], normal[3];  // lattice steps; normal in 1/2^14
  std::uint32_t reach;  // as many bits as the way from the centre to the farthest corner along any axis
  std::int32_t extra;                             // MeshPlace
  double weight;
  PlaceKind kind;
};

enum class LinkKind : std::uint8_t { kAway, kOdd, kCrossing, kClose, kSeries };

struct LinkSeries {
  LinkKind kind = LinkKind::kOdd;
  double value = 0;        // v = G / (R_i R_j); unless kSeries a rough one
  double most = 0;         // what it would be with both cosines 1
  double error = 0;        // of v, estimated (kSeries)
  double vary_i = 0, vary_j = 0;  // mean squares of the variation over i, and over j, relative (kSeries)
};

/// Mean of the part of a height that is positive, where corners are `extent` above and below the centre's.
std::int32_t mean_in_front(std::int32_t height, std::int32_t extent);

class Places {
 public:
  /// Errors: kMemory.
  Status take(Arena& arena, const Surfaces& surfaces, const Rules& rules);
  static std::uint64_t bytes(const Scene& scene, const Rules& rules);

  /// Around all of a node where segments may end, boxes of its parts inside; or around its cached samples.
  LatticeBox box(const Surfaces& surfaces, std::uint32_t node, std::uint32_t place, bool whole) const;
  PlacedSide side(std::uint32_t node, std::uint32_t mesh_place) const;
  /// Where a sample's lattice point is to the plane of a node, whose mesh has this place: 1 in front, -1 behind, 0 too
  /// near to tell.
  int sign_over(std::uint32_t node, std::uint32_t place, const LatticePoint& point) const;
  /// `place`: of j's mesh in Surfaces::mesh_at.
  LinkSeries series(const PlacedSide& i, std::uint32_t j, std::uint32_t place) const;

 private:
  const MeshPlace& place_of(std::uint32_t node, std::uint32_t place) const {
    const MeshPlace& mesh = meshes_[place];
    return mesh.own == kNone ? mesh : own_[mesh.own + (node - surfaces_->mesh_begin[place])];
  }
  /// Half axes of a node of the mesh, in lattice steps.
  void half_axes(std::uint32_t node, const MeshPlace& mesh, std::int32_t* a, std::int32_t* b) const;

  const Surfaces* surfaces_ = nullptr;
  std::span<NodePlace> nodes_;
  std::span<MeshPlace> meshes_;
  std::span<MeshPlace> own_;
};

}  // namespace shodo
