// The paper's flags (paper 3.1): every object, lights included, carries three, one set for direct and one for ambient
// light: whether it blocks rays, whether any object blocks rays that go to it, whether any blocks rays that leave it.
//
// Deviation D12: a ray goes the way of the light: from a light to a surface. Between two surfaces light goes both
// ways and one visible fraction serves both, so that a pair is left untested only if neither way would be tested.
// Found flags. While flags are on, every blocked segment leaves its mark: on the object that was found to block it
// and on both of its ends. What is never marked could be cleared in the scene file, all of it together, and no bit
// would change: every blocked segment still has the blocker that was found. They are the lossless flags of paper 3.1.
// Bytes: 2 an object or light.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "scene/scene.h"

namespace shodo {

/// The paper's two sets of flags.
enum class LightSet : std::uint8_t { kDirect, kAmbient };

/// The objects at the two ends (lights: objects.size() + light), the way the light goes, and for which purpose.
struct Link {
  std::uint32_t from = kNone;
  std::uint32_t to = kNone;
  LightSet set = LightSet::kDirect;
};

class FlagTables {
 public:
  /// All flags set; with `given`, those that the scene file clears are cleared. False: the arena is too small.
  bool fill(const Scene& scene, bool given, Arena& arena);
  static std::uint64_t bytes(const Scene& scene);

  bool blocks(std::uint32_t object, LightSet set) const { return has(object, set, kBlocks); }
  bool shadowed_towards(std::uint32_t object, LightSet set) const { return has(object, set, kTowards); }
  bool shadowed_leaving(std::uint32_t object, LightSet set) const { return has(object, set, kLeaving); }
  /// Whether segments between these two are tested.
  bool tested(const Link& link) const;

  /// A triangle of `object` blocks a segment of this link.
  void note_blocked(const Link& link, std::uint32_t object);
  bool found_blocking(std::uint32_t object, LightSet set) const { return has(object, set, kFound * kBlocks); }
  bool found_shadowed_towards(std::uint32_t object, LightSet set) const { return has(object, set, kFound * kTowards); }
  bool found_shadowed_leaving(std::uint32_t object, LightSet set) const { return has(object, set, kFound * kLeaving); }
  /// Objects and lights; 0 with flags off.
  std::uint32_t size() const { return static_cast<std::uint32_t>(flags_.size() / 2); }

 private:
  static constexpr std::uint8_t kBlocks = 1, kTowards = 2, kLeaving = 4, kFound = 8;

  bool has(std::uint32_t object, LightSet set, std::uint8_t flag) const {
    return (flags_[2 * object + static_cast<std::uint32_t>(set)] & flag) != 0;
  }
  void take_given(std::uint32_t object, LightSet set, const GivenFlags& given, const GivenFlags& fallback);

  std::uint8_t& at(std::uint32_t object, LightSet set) { return flags_[2 * object + static_cast<std::uint32_t>(set)]; }

  std::span<std::uint8_t> flags_;  // [2 * object + set]: kBlocks ..., and what was found, times kFound
};

}  // namespace shodo
