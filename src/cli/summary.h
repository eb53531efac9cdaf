// Illuminance statistics (contract 1: --summary): a line an object and a measuring plane.
//
// mean: over the area that isn't hidden; least and greatest: of its sub-patches; uniformity Uo = least / mean and
// Ud = least / greatest (EN 12665). In a scene of three channels the illuminance is 0.2126 R + 0.7152 G + 0.0722 B, as
// sRGB weighs its primaries: white light of 1,000 lx has 1,000 in each channel, and is 1,000 here.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "model.h"

namespace shodo {

struct IlluminanceStatistics {
  double area = 0;         // of what isn't hidden, square metres
  double hidden_area = 0;  // or dropped
  double mean = 0, least = 0, greatest = 0;  // lux; 0 if all is hidden

  double overall_uniformity() const { return mean > 0 ? least / mean : 0; }
  double diversity() const { return greatest > 0 ? least / greatest : 0; }
};

/// Illuminance of a sub-patch of a map, lux; `index` counts sub-patches.
double illuminance(std::span<const float> direct_lx, std::span<const float> ambient_lx, std::size_t index,
                   std::uint32_t channels);

IlluminanceStatistics object_statistics(const Model& model, std::uint32_t object);
IlluminanceStatistics plane_statistics(const Model& model, std::uint32_t plane);

/// "kind,name,area_m2,hidden_m2,mean_lx,least_lx,greatest_lx,uo,ud" and a line each; objects without a surface have
/// none.
std::string summary_table(const Model& model);

}  // namespace shodo
