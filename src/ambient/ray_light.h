// What rays bring: rho E of the sub-patch that each meets first (ambient/gather.h).
//
// Backs are black, and area lights bring nothing: theirs is direct light. Panes weaken what comes through them, channel
// by channel, and bring what their fronts reflect, weakened by the panes before them. All of them are asked for each
// ray, and again for each that it passes: scenes have few.
#pragma once

#include <cstdint>

#include "ambient/sent_light.h"
#include "ambient/sub_patch_finder.h"
#include "visibility/parallel_rays.h"

namespace shodo {

class RayLight {
 public:
  RayLight(const Scene& scene, const Geometry& geometry, Intersector& intersector, const SubPatchFinder& finder,
           const SentLight& sent)
      : scene_(scene), geometry_(geometry), finder_(finder), sent_(sent), rays_(geometry, intersector) {}

  /// As ParallelRays::aim().
  void aim(const LatticeBox& from, const LatticeVector& direction) {
    direction_ = direction;
    rays_.aim(from, direction);
  }
  std::uint64_t tests() const { return rays_.tests(); }
  /// Adds what the ray from a point of the box brings, in units of SentLight.
  void add(const LatticePoint& from, std::uint64_t (&sum)[3]) const;

 private:
  void add_through_panes(const LatticePoint& from, const ParallelRays::First& first, std::uint64_t (&sum)[3]) const;
  void add_part(const double (&part)[3], std::uint32_t triangle, const LatticePoint& at,
                std::uint64_t (&sum)[3]) const;
  const std::uint16_t* sent_at(std::uint32_t triangle, const LatticePoint& at) const;
  void weaken(const LatticePoint& from, double end, double (&part)[3]) const;
  double distance_to(const Triangle& triangle, const LatticePoint& from) const;

  const Scene& scene_;
  const Geometry& geometry_;
  const SubPatchFinder& finder_;
  const SentLight& sent_;
  ParallelRays rays_;
  LatticeVector direction_;
};

}  // namespace shodo
