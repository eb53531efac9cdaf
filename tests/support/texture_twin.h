// The filter of textures in doubles, as doc/textures.md says it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/texture.h"

namespace shodo {

/// Bilinear between the centres of a grid's values.
template <class At>
double bilinear_twin(double u, double v, const At& at) {
  const double x = std::floor(u - 0.5), y = std::floor(v - 0.5), s = u - 0.5 - x, t = v - 0.5 - y;
  const std::int64_t i = static_cast<std::int64_t>(x), j = static_cast<std::int64_t>(y);
  return (1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) + t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
}

/// Linear light of 65535 at texel coordinates of the finest level, `step` texels from sample to sample.
inline double filtered_twin(const Texture& texture, double s, double t, double step, std::uint32_t c) {
  const auto linear = [](std::uint8_t level) {
    const double v = level / 255.0;
    return 65535 * (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  };
  std::uint32_t level = 0;
  while (step >= std::exp2(level + 1)) ++level;
  const double weight = step <= 1 ? 0 : step / std::exp2(level) - 1;
  const auto value = [&](std::uint32_t of) {
    const TextureLevel l = texture_level(texture, of);
    const std::int64_t w = l.width, h = l.height;
    const auto kept = [&](std::int64_t k, std::int64_t n) {
      return texture.size_u != 0 ? (k % n + n) % n : std::clamp<std::int64_t>(k, 0, n - 1);
    };
    return bilinear_twin(s * l.width / texture.width, t * l.height / texture.height,
                         [&](std::int64_t x, std::int64_t y) {
                           const std::size_t at = static_cast<std::size_t>(kept(y, h) * w + kept(x, w));
                           return linear(l.texel[at * texture.channels + (texture.channels == 1 ? 0 : c)]);
                         });
  };
  return (1 - weight) * value(level) + weight * value(level + 1);
}

}  // namespace shodo
