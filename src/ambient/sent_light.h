// What sub-patches send, rho E, in integers: sums of what lines bring take no floating point (ambient/gather.h).
//
// A unit is 4 / (2^32 - 1) of the brightest illuminance at the start; 11 bits of a value are kept, and how far it is
// shifted. Approximate: to 2^-11 of itself and a unit; what becomes more than four times as bright as all that was at
// the start counts as that. A sub-patch that a point light is near to, which has most of its direct light from it and
// all that there is, sends unevenly: what the light brings where a line leaves instead of its mean, in floating point.
// Bytes: 2 a sub-patch and channel, 72 one that may send unevenly.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/near_light.h"
#include "base/arena.h"
#include "light/direct.h"
#include "scene/patch_reflectance.h"

namespace shodo {

class SentLight {
 public:
  /// Sub-patches that may send unevenly; `step`: of the lattice.
  static std::uint32_t uneven_count(const Scene& scene, double step);
  /// `uneven`: as many; `ambient_lx` as gather_illuminance() has it. False: the arena is too small.
  bool take(const Scene& scene, double step, std::uint32_t uneven, const DirectLight& direct,
            std::span<const float> ambient_lx, Arena& arena);
  static std::uint64_t bytes(const Scene& scene, std::uint32_t uneven) {
    static_assert(sizeof(Uneven) == 72);  // as src/memory_plan.cpp tells
    return (2 * std::uint64_t{scene.sub_patch_count} * scene.channels + 7) / 8 * 8 + sizeof(Uneven) * uneven;
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
  /// One that a light is near to sends unevenly: so much from a point of it.
  static bool is_uneven(const std::uint16_t* sent) { return *sent >= kUneven; }
  void from(const std::uint16_t* sent, const Vec3& point, std::uint32_t (&units)[3]) const;
  /// Anew, from the ambient illuminance by channel.
  void set(const MeshReflectance& reflectance, const Mesh& mesh, std::uint32_t local, const double (&ambient_lx)[3]);
  /// Lux.
  double unit() const { return unit_; }

 private:
  static constexpr int kBits = 11;
  /// No value is packed so: with the number of one that sends unevenly.
  static constexpr std::uint32_t kUneven = (32u - kBits + 1) << kBits, kMostUneven = (1u << 16) - kUneven;

  /// A sub-patch to which a light is near.
  struct Uneven {
    NearLight where;
    float mean;           // lux, of the light, white
    float units[3];       // of each lux more, by channel
    std::uint32_t light;
    std::uint32_t first;  // what packed_ would have
  };

  void find_uneven();

  const Scene* scene_ = nullptr;
  double step_ = 0;  // of the lattice
  std::span<Uneven> uneven_;
  const DirectLight* direct_ = nullptr;
  std::uint32_t channels_ = 1;
  std::span<std::uint16_t> packed_;  // [sub_patch * channels + channel]
  double unit_ = 0, over_unit_ = 0;  // lux, 1 / lux
};

}  // namespace shodo
