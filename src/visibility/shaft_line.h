// A line of a shaft's hull, in the plane of two axes: what lies beyond it no segment of the shaft meets. In 32 bits,
// with the lattice 2^6 times coarser, so that no product overflows (visibility/shaft.h, ambient/lean_shaft.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "visibility/lattice_box.h"

namespace shodo {

/// Beyond: normal_u u + normal_v v > limit, u and v of the box's nearest corner.
struct ShaftLine {
  static constexpr int kSteps = 6;  // of the lattice in one, log2

  std::int32_t normal_u, normal_v, limit;
  std::uint32_t u, v;  // bounds of a box, by their offset in it

  static std::int32_t bound(const LatticeBox& box, std::uint32_t offset) {
    const auto* byte = reinterpret_cast<const unsigned char*>(&box) + offset;
    return *reinterpret_cast<const std::int32_t*>(byte) >> kSteps;
  }
  bool rules_out(const LatticeBox& box) const { return normal_u * bound(box, u) + normal_v * bound(box, v) > limit; }
};
static_assert(offsetof(LatticeBox, low) == 0 && offsetof(LatticeBox, high) == 12 && sizeof(LatticeBox) == 24);

}  // namespace shodo
