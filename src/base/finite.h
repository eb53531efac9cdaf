// Light that a map can hold: sources of 1e30 cd are a scene's right, infinity in an output is not.
#pragma once

#include <limits>

namespace shodo {

/// At most the largest number that a float holds, which not a number counts as.
constexpr double finite(double x) {
  return x < std::numeric_limits<float>::max() ? x : std::numeric_limits<float>::max();
}

}  // namespace shodo
