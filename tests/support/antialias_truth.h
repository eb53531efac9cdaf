// What antialiasing approaches: the mean of 16 x 16 samples a pixel in linear light, from a picture of one sample a
// pixel and 16 times the size. It shares what one sample shows with the picture, and nothing of how samples are joined.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "model.h"
#include "support/collected_lines.h"

namespace shodo {

inline constexpr std::uint32_t kTruthSamples = 16;

inline double linear_light(int level) {
  const double s = level / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
inline double srgb_level(double v) { return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055); }

/// The model's picture; it must be solved.
inline std::vector<std::uint8_t> antialiased(Model& model, std::uint32_t antialias) {
  const std::uint32_t before = model.options.antialias;
  model.options.antialias = antialias;
  std::vector<std::uint8_t> pixels;
  const LineSink sink = collected_in(pixels);
  if (!draw(model, {}, sink).done()) pixels.clear();
  model.options.antialias = before;
  return pixels;
}

/// Linear light by channel of each pixel.
inline std::vector<double> antialias_truth(Model& model) {
  struct Sum {
    std::vector<double> light;
    double linear[256];
    std::uint32_t width;
  } sum;
  const Options before = model.options;
  sum.light.resize(std::size_t{3} * before.width * before.height);
  sum.width = before.width;
  for (int k = 0; k < 256; ++k) sum.linear[k] = linear_light(k) / (kTruthSamples * kTruthSamples);
  model.options.width *= kTruthSamples;
  model.options.height *= kTruthSamples;
  model.options.antialias = 1;
  const LineSink sink{[](void* context, std::uint32_t y, std::span<const std::uint8_t> line) {
                        Sum& s = *static_cast<Sum*>(context);
                        double* const row = &s.light[std::size_t{3} * s.width * (y / kTruthSamples)];
                        for (std::size_t k = 0; k < line.size(); ++k) {
                          row[k / (3 * kTruthSamples) * 3 + k % 3] += s.linear[line[k]];
                        }
                        return true;
                      },
                      &sum};
  if (!draw(model, {}, sink).done()) sum.light.clear();
  model.options = before;
  return sum.light;
}

}  // namespace shodo
