// What looks at area lights (light/face_light.cpp) and at polyhedra (light/polyhedron_light.cpp) share: a face at work,
// and the kernel between two points.
#pragma once

#include <cstdint>

#include "light/face_light.h"

namespace shodo {

/// So many faces of a polyhedron are looked at together.
inline constexpr std::uint32_t kFacesAtOnce = 16;

/// cos cos / r^2 from a sample to a point of a face; 0 or less where one lies behind the other.
inline double kernel(const Vec3& from, const Vec3& normal, const Vec3& to, const Vec3& emitter_normal) {
  const Vec3 way = to - from;
  const double above = dot(normal, way);
  if (!(above > 0)) return 0;
  const double squared = length_squared(way);
  return above * -dot(emitter_normal, way) / (squared * squared);
}

/// One face at work.
struct FaceLight::Face {
  const Emitter* emitter = nullptr;
  Tier tier = Tier::kNear;
  bool below = true;    // a part may lie below the receiver's horizon
  bool panes = false;   // a pane may be between
  double factor[kMostInGroup];  // filled as far as the group goes
};

/// Faces of a polyhedron that are looked at together.
struct FaceLight::Batch {
  Face face[kFacesAtOnce];
  std::uint32_t count = 0;
  double given = -1;     // as in look(): shares are found when they are needed
  LatticeBox box;        // around the ends
  std::uint32_t own = 0;  // faces (a bit each) whose own polyhedron may be in the way of some sample
  Aim aim;
  std::size_t others = 0;  // facets of the aim that are not the polyhedron's own
  std::uint32_t wanted[kMostInGroup], shadow[kMostInGroup];  // faces, where shares are found later
};

}  // namespace shodo
