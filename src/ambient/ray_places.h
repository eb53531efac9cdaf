// Places of a sub-patch from which its rays start (ambient/gather.h): Sobol's points in the unit square, turned over
// from sub-patch to sub-patch, none on a border. Those that are inside something are left out (visibility/hidden.h).
#pragma once

#include <cstdint>

#include "scene/mesh.h"
#include "visibility/hidden.h"

namespace shodo {

/// Those of a sub-patch that are seen.
struct RayPlaces {
  static constexpr std::uint32_t kMost = 16;
  LatticePoint from[kMost];
  std::uint32_t count = 0;

  const LatticePoint& of_ray(std::uint32_t ray) const { return from[ray % count]; }
};
static_assert(RayPlaces::kMost <= kMostHiddenSamples);

/// Where sub-patches of one cell have theirs.
class RayStarts {
 public:
  RayStarts(const Scene& scene, const Geometry& geometry, Intersector& intersector, std::uint32_t mesh,
            std::uint32_t cell)
      : scene_(scene), geometry_(geometry), intersector_(intersector), mesh_(mesh), cell_(cell),
        front_(flat_front(geometry, mesh, cell)) {}

  /// Of the places of a sub-patch (counted from the mesh's first) `count` from `first` on, beginning anew after the
  /// last; none if it has no area. Wide aims of the intersector are not valid afterwards.
  void find(std::uint32_t local, std::uint32_t first, std::uint32_t count, RayPlaces& places) const;

 private:
  const Scene& scene_;
  const Geometry& geometry_;
  Intersector& intersector_;
  std::uint32_t mesh_, cell_;
  FlatFront front_;
};

}  // namespace shodo
