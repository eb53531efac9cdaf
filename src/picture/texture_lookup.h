// Values of a texture at a place, mixed of two levels of detail, bilinear in each (textured.h).
#pragma once

#include <bit>
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

  /// Linear, of 65535, by channel of the texture; s and t are 1/2^32 of a repeat, t downwards. `step`: texels of level
  /// 0 a sample, 16.16.
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

// What every sample of a textured surface runs through.

inline TextureLookup::Axis TextureLookup::axis_at(std::uint32_t at, std::uint32_t count) const {
  const std::int64_t place = static_cast<std::int64_t>(std::uint64_t{at} * count >> 16) - 32768;
  const std::int32_t low = static_cast<std::int32_t>(place >> 16), last = static_cast<std::int32_t>(count) - 1;
  const std::uint32_t weight = static_cast<std::uint32_t>(place >> 8 & 255);
  const auto texel = [&](std::int32_t k) {
    if (k < 0) return static_cast<std::uint32_t>(repeats_ ? last : 0);
    if (k > last) return static_cast<std::uint32_t>(repeats_ ? 0 : last);
    return static_cast<std::uint32_t>(k);
  };
  return {texel(low), texel(low + 1), weight};
}

inline void TextureLookup::bilinear(const TextureLevel& level, std::uint32_t s, std::uint32_t t,
                             std::uint32_t (&value)[3]) const {
  const Axis x = axis_at(s, level.width), y = axis_at(t, level.height);
  const std::uint8_t* const low = level.texel + std::size_t{y.low} * level.width * channels_;
  const std::uint8_t* const high = level.texel + std::size_t{y.high} * level.width * channels_;
  for (std::uint32_t c = 0; c < channels_; ++c) {
    const auto along = [&](const std::uint8_t* row) {
      return linear_[row[x.low * channels_ + c]] * (256 - x.weight) + linear_[row[x.high * channels_ + c]] * x.weight;
    };
    value[c] = (along(low) * (256 - y.weight) + along(high) * y.weight) >> 16;
  }
}

inline void TextureLookup::look_up(std::uint32_t s, std::uint32_t t, std::uint32_t step,
                                   std::uint32_t (&value)[3]) const {
  std::uint32_t level = 0, weight = 0;
  if (step > 65536) {
    level = static_cast<std::uint32_t>(std::bit_width(step)) - 17;
    weight = step >> (level + 8) & 255;
  }
  if (level >= count_ - 1) level = count_ - 1, weight = 0;
  bilinear(level_[level], s, t, value);
  if (weight == 0) return;
  std::uint32_t coarse[3];
  bilinear(level_[level + 1], s, t, coarse);
  for (std::uint32_t c = 0; c < channels_; ++c) value[c] = (value[c] * (256 - weight) + coarse[c] * weight) >> 8;
}

}  // namespace shodo
