// What sub-patches send, rho E, in integers: sums of what lines bring take no floating point (ambient/gather.h).
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

  /// Units.
  static std::uint32_t unpacked(std::uint16_t packed) {
    return static_cast<std::uint32_t>(packed & ((1u << kBits) - 1)) << (packed >> kBits);
  }
  /// To the nearest.
  static std::uint16_t packed(std::uint32_t units);
  /// Of a sub-patch counted from the scene's first, by channel; packed.
  template <std::uint32_t kChannels>
  const std::uint16_t* of(std::uint32_t sub_patch) const {
    return packed_.data() + std::size_t{sub_patch} * kChannels;
  }
  /// Anew, from the ambient illuminance by channel.
  void set(const MeshReflectance& reflectance, const Mesh& mesh, std::uint32_t local, const double (&ambient_lx)[3]);
  /// Lux.
  double unit() const { return unit_; }

 private:
  static constexpr int kBits = 11;

  const DirectLight* direct_ = nullptr;
  std::uint32_t channels_ = 1;
  std::span<std::uint16_t> packed_;  // [sub_patch * channels + channel]
  double unit_ = 0, over_unit_ = 0;  // lux, 1 / lux
};

}  // namespace shodo
