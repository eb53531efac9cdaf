// What pictures that measure are asked to show.
#pragma once

#include <cstdint>
#include <vector>

#include "cli/lux_scale.h"

namespace shodo {

/// What the command line asked for.
struct MeasuredOptions {
  enum class Show : std::uint8_t { kNothing, kPatches, kSubPatches };

  bool false_colour = false;
  LuxScale scale;              // high 0: found from the picture
  bool isolux = false;
  std::vector<double> levels;  // none: round values in the scale's range
  Show show = Show::kNothing;

  bool any() const { return false_colour || isolux || show != Show::kNothing; }
};

}  // namespace shodo
