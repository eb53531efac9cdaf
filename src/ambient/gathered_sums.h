// Sums of what lines bring to each sub-patch, in integers, where its ambient illuminance stands (ambient/gather.h).
//
// A sum has 31 bits and a scale of its own: when one channel's would overflow all are halved, so that a line loses less
// than a part in 2^30 of the brightest channel's sum, or a unit where that is more. Light is counted in units of
// SentLight.
// Bytes: 5 a sub-patch.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/sent_light.h"
#include "base/arena.h"

namespace shodo {

class GatheredSums {
 public:
  /// Lines that are counted. Of a sub-patch that has more, those before count half as much; one over which something
  /// may stand takes no more, so that what it had before is known.
  static constexpr std::uint32_t kMost = 65535;
  /// Backs are seen along more than one in so many lines: something may stand over a sub-patch.
  static constexpr std::uint32_t kBacksOneIn = 50;

  /// What it takes of an arena: a part that may come from elsewhere, and the rest.
  struct Bytes {
    std::uint64_t lines = 0, rest = 0;
  };
  static Bytes bytes(const Scene& scene);
  /// False: an arena is too small.
  bool take(const Scene& scene, std::span<float> lx, Arena& arena, Arena& for_lines);

  /// A sub-patch's illuminance becomes a sum to which it has brought as much as `lines` of such light do. Those for
  /// which it isn't called keep theirs, and take no lines.
  void start(std::uint32_t sub_patch, std::uint32_t lines, double unit);
  bool started(std::uint32_t sub_patch) const { return scale_[sub_patch] != kNever; }

  /// A line more that ends on the sub-patch. False: it takes none.
  bool count(std::uint32_t sub_patch) {
    if (lines_[sub_patch] == kMost && !forget_half(sub_patch)) return false;
    ++lines_[sub_patch];
    return true;
  }
  /// It brings nothing but a back: something may stand over the sub-patch.
  void count_back(std::uint32_t sub_patch) { ++backs_[sub_patch]; }
  /// It brings light, units(c) units of channel c.
  template <std::uint32_t kChannels, class Units>
  void add(std::uint32_t sub_patch, Units units) {
    std::uint32_t* const sum = words_ + std::size_t{sub_patch} * kChannels;
    const std::uint32_t scale = scale_[sub_patch];
    std::uint32_t all = 0;
    for (std::uint32_t c = 0; c < kChannels; ++c) {
      sum[c] += units(c) >> scale;
      all |= sum[c];
    }
    if (all >> 31 == 0) return;
    halve(sub_patch);
    ++scale_[sub_patch];
  }

  /// With those that start() counted; and those of them that aren't known to have brought a back.
  std::uint32_t lines(std::uint32_t sub_patch) const { return lines_[sub_patch]; }
  std::uint32_t not_backs(std::uint32_t sub_patch) const { return lines_[sub_patch] - backs_[sub_patch]; }
  bool sees_backs(std::uint32_t sub_patch) const {
    return backs_[sub_patch] * kBacksOneIn > lines_[sub_patch];
  }
  /// The mean over its lines, lux.
  double mean(std::uint32_t sub_patch, std::uint32_t channel, double unit) const;
  /// A sub-patch that has started has this illuminance again, by channel; no more lines then.
  void finish(std::uint32_t sub_patch, const double (&lx)[3]);

 private:
  static constexpr std::uint8_t kNever = 255;

  void halve(std::uint32_t sub_patch);
  bool forget_half(std::uint32_t sub_patch);

  std::uint32_t channels_ = 1;
  std::span<float> lx_;
  std::uint32_t* words_ = nullptr;  // where lx_ is
  std::span<std::uint16_t> lines_;  // per sub-patch
  std::span<std::uint8_t> scale_;   // sums are in units times 2^scale; kNever: not started
  std::span<std::uint16_t> backs_;
};

}  // namespace shodo
