// What every node sends, once the solution is known (ours; final gather).
// Bytes: 4 c a block, 2 a node.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/ambient.h"
#include "ambient/surfaces.h"
#include "base/arena.h"
#include "light/direct.h"

namespace shodo {

class GatherSenders {
 public:
  /// `ambient_lx`: of the sub-patches, so far. Errors: kMemory.
  Status take(Arena& arena, const Surfaces& surfaces, const DirectLight& direct, const AmbientLight& ambient,
              std::span<const float> ambient_lx);
  static std::uint64_t bytes(const Scene& scene, const Rules& rules);

  /// Mean of rho E over a node, lux, by channel.
  void radiosity(std::uint32_t node, double* lx) const;
  /// Mean over channels, of the mean illuminance of the scene.
  double level_of(const double* radiosity) const {
    double sum = 0;
    for (std::uint32_t c = 0; c < channels_; ++c) sum += radiosity[c];
    return sum * scale_;
  }
  /// Standard deviation over the node, the same units.
  double uneven(std::uint32_t node) const { return uneven_[node] * (1.0 / kUnevenSteps); }

 private:
  static constexpr double kUnevenSteps = 1024;  // in the mean illuminance; what is beyond 64 counts as 64

  void note_patch(std::span<const float> ambient_lx, std::uint32_t node);
  void note_block(std::uint32_t node);
  void note_uneven(std::uint32_t node, double mean_square, double mean);

  const Surfaces* surfaces_ = nullptr;
  const DirectLight* direct_ = nullptr;
  const AmbientLight* ambient_ = nullptr;
  std::uint32_t channels_ = 1;
  double scale_ = 0;  // 1 / (channels mean illuminance)
  std::span<float> radiosity_;  // of blocks, by their order
  std::span<std::uint16_t> uneven_;
};

}  // namespace shodo
