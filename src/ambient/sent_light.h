// What sub-patches send, rho E, in integers: sums of what rays meet take no floating point (ambient/gather.h).
//
// A unit is 4 / (2^32 - 1) of the brightest illuminance at the start; 11 bits of a value are kept, and how far it is
// shifted. Approximate: to 2^-11 of itself and a unit; what becomes more than four times as bright as all that was at
// the start counts as that. Bytes: 2 a sub-patch and channel.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/direct.h"
#include "scene/patch_reflectance.h"

namespace shodo {

class SentLight {
 public:
  /// `ambient_lx` as gather_illuminance() has it. False: the arena is too small.
  bool take(const Scene& scene, const DirectLight& direct, std::span<const float> ambient_lx, Arena& arena);
  static std::uint64_t bytes(const Scene& scene) {
    return (2 * std::uint64_t{scene.sub_patch_count} * scene.channels + 7) / 8 * 8;
  }

  /// Of a mesh's sub-patch, by channel; packed.
  const std::uint16_t* of(const Mesh& mesh, std::uint32_t local) const {
    return &packed_[(std::size_t{mesh.first_sub_patch} + local) * channels_];
  }
  /// Units.
  static std::uint32_t unpacked(std::uint16_t packed) {
    return static_cast<std::uint32_t>(packed & ((1u << kBits) - 1)) << (packed >> kBits);
  }
  /// To the nearest.
  static std::uint16_t packed(std::uint32_t units);
  /// Anew, from what arrives at it.
  void set(const MeshReflectance& reflectance, const Mesh& mesh, std::uint32_t local,
           std::span<const float> ambient_lx);
  /// Lux.
  double unit() const { return unit_; }

 private:
  static constexpr int kBits = 11;

  double lx(std::size_t value, std::span<const float> ambient_lx) const {
    return static_cast<double>(direct_->sub_patch_lx[value]) + static_cast<double>(ambient_lx[value]);
  }

  const DirectLight* direct_ = nullptr;
  std::uint32_t channels_ = 1;
  std::span<std::uint16_t> packed_;  // [sub_patch * channels + channel]
  double unit_ = 0, over_unit_ = 0;  // lux, 1 / lux
};

}  // namespace shodo
