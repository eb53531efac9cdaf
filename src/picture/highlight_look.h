// A point of a glossy surface that is looked at, and what stands between it and a lamp (picture/highlight.h).
#pragma once

#include <cstdint>

#include "base/vector.h"
#include "picture/lobe.h"
#include "visibility/geometry.h"

namespace shodo {

/// What the light sources are looked at from.
struct HighlightLook {
  Lobe lobe;
  Vec3 normal;     // of the surface, unit
  Vec3 anchor;     // a point of its plane
  Vec3 point;
  Vec3 mirrored;   // direction of view after reflection, unit
  LatticePoint from;
  const DrawnTriangle* surface;
};

inline constexpr std::uint32_t kMostNear = 160;

/// All triangles that may stand between a point and a lamp.
struct NearTriangles {
  std::uint32_t triangle[kMostNear];
  std::uint32_t count = 0;  // above kMostNear: there are more
  bool crossing = false;    // some are before one part of the lamp and beyond or inside another

  bool all() const { return count <= kMostNear; }
};

}  // namespace shodo
