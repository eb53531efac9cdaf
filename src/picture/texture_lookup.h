// Values of a texture at a place, mixed of two levels of detail, bilinear in each (textured.h).
#pragma once

#include <cstdint>
#include <span>

#include "scene/texture.h"

namespace shodo {

class TextureLookup {
 public:
  static constexpr std::uint32_t kMostLevels = 14;  // 8192 halves to 1 in 13 steps

  /// `repeats`: else it ends at its borders.
  TextureLookup(const Scene& scene, const Texture& texture, bool repeats);
  TextureLookup() = default;

  /// Linear, of 65535, by channel of the texture; s and t are 1/2^32 of a repeat, t downwards. `step`: texels of level 0
  /// a sample, 16.16.
  void look_up(std::uint32_t s, std::uint32_t t, std::uint32_t step, std::uint32_t (&value)[3]) const;
  std::uint32_t channels() const { return channels_; }

 private:
  struct Axis {
    std::uint32_t low, high, weight;
  };

  Axis axis_at(std::uint32_t at, std::uint32_t count) const;
  void bilinear(const TextureLevel& level, std::uint32_t s, std::uint32_t t, std::uint32_t (&value)[3]) const;

  std::span<const std::uint16_t> linear_;
  TextureLevel level_[kMostLevels];
  std::uint32_t count_ = 0, channels_ = 1;
  bool repeats_ = false;
};

}  // namespace shodo
