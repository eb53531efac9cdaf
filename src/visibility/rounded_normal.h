// Normals and determinants in 32 bits: which sign a product with a difference of lattice points has, but near zero.
//
// A component m is 4,096 c + r, 0 <= r < 4,096: m . d lies within 4,096 kDoubt of 4,096 (c . d), as the components of d
// together are kDoubt at most. On a machine of 32 bits c . d takes a third of the instructions of m . d, and where it
// leaves a doubt, within some tens of steps of a plane mostly, m . d tells. Exact: what is said beyond the doubt.
#pragma once

#include <cstdint>

#include "base/lattice.h"

namespace shodo {

struct RoundedNormal {
  static constexpr int kBits = 12;
  static constexpr std::int64_t kDoubt = std::int64_t{3} << 20;

  std::int32_t x, y, z;

  RoundedNormal() = default;
  /// Components within 2^42.6.
  explicit RoundedNormal(const LatticeVector& m)
      : x(static_cast<std::int32_t>(m.x >> kBits)),
        y(static_cast<std::int32_t>(m.y >> kBits)),
        z(static_cast<std::int32_t>(m.z >> kBits)) {}

  /// c . d, components of d within 2^20.
  std::int64_t along(const LatticePoint& d) const { return product(x, d.x) + product(y, d.y) + product(z, d.z); }
};

}  // namespace shodo
