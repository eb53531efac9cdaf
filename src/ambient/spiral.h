// Directions over a surface, even by cosine: the points of a spiral on the disc, even by area (Vogel 1979), lifted to
// the hemisphere above it. Each is turned against the one before by the golden angle.
#pragma once

#include <cstdint>

#include "base/lattice.h"

namespace shodo {

class Spiral {
 public:
  /// Of the whole hemisphere over a unit normal; `turn`: of all of it, from 0 to 1.
  Spiral(const Vec3& normal, std::uint32_t count, double turn);

  /// From the normal outwards, on the lattice.
  LatticeVector next();

 private:
  Vec3 normal_, tangent_, bitangent_;
  double over_count_, cosine_, sine_;
  std::uint32_t number_ = 0;
};

}  // namespace shodo
