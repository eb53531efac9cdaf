// Who receives light: a sub-patch, and the samples on it.
//
// Illuminance is computed from original coordinates, visibility from lattice points: a sample has both. The height of a
// light over the receiver's plane is taken from the plane of the file's polygon and not from the sample, whose own
// coordinates are rounded: a light in the plane has height exactly 0 where the plane is exact in double.
#pragma once

#include <cstdint>

#include "base/lattice.h"
#include "base/vector.h"
#include "light/factor_field.h"
#include "visibility/geometry.h"

namespace shodo {

/// What the samples of a sub-patch share.
struct Receiver {
  std::uint32_t mesh = 0;
  std::uint32_t cell = 0;
  std::uint32_t object = 0;
  Vec3 normal;  // unit
  Vec3 anchor;  // a point of the plane
  FlatFront front;  // of the cell on the lattice
  std::span<const Triangle> own;  // a measuring plane's, which is no cell of a mesh; else none
  PatchPlace place;  // on the patch, if that is a parallelogram

  /// Scene units; positive in front.
  double height(const Vec3& point) const { return dot(normal, point - anchor); }
};

struct Sample {
  Vec3 point;            // scene units
  LatticePoint lattice;  // odd, in front of the polygon
};

/// What one light sends to one sample.
struct Received {
  double lux = 0;      // nothing in the way, before the light's colour
  double visible = 0;  // the part of it that arrives, 0 .. 1; 0 where lux is 0
  double factor = 0;   // the form factor to an area light, nothing in the way
};

}  // namespace shodo
