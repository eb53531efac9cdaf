// What a link matters to the light of the scene, estimated by direct light alone (ours; paper 3.2 rule 3 carried on).
//
// Errors are over the mean illuminance, in which no patch counts for more than pi MAX lux: a white surface is displayed
// white there. Else a garden in the sun, 4,000 lx and more, would make everything indoors too dark to matter.
// Bytes: 4 a node and 4 a block.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/surfaces.h"
#include "base/arena.h"
#include "light/direct.h"
#include "shodo/options.h"

namespace shodo {

inline constexpr double kBlocksError = 2.3e-4;

class LinkWorth {
 public:
  /// Errors: kMemory.
  Status take(Arena& arena, const Surfaces& surfaces, const DirectLight& direct, const Rules& rules);
  static std::uint64_t bytes(const Scene& scene, const Rules& rules);

  /// Squares of what a node sends, and of how unevenly its parts do: (R B)^2 over (E R of the scene)^2, E as above.
  double sent(std::uint32_t node) const { return static_cast<double>(sent_[node]); }
  double uneven(std::uint32_t node) const {
    if (!surfaces_->is_block(node)) return 0;
    return static_cast<double>(uneven_[surfaces_->patch_at[node] - surfaces_->scene->patch_count]);
  }
  /// REL^2.
  double allowed() const { return allowed_; }

 private:
  void estimate(const Surfaces& surfaces, const DirectLight& direct);

  const Surfaces* surfaces_ = nullptr;
  std::span<float> sent_;    // by node
  std::span<float> uneven_;  // by block: a patch has no parts
  double allowed_ = 0;
};

}  // namespace shodo
