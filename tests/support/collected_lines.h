// A picture's lines as they are finished, one after the other in a vector.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shodo/callbacks.h"

namespace shodo {

/// Good while `pixels` lives.
inline LineSink collected_in(std::vector<std::uint8_t>& pixels) {
  return {[](void* to, std::uint32_t, std::span<const std::uint8_t> rgb) {
            auto& all = *static_cast<std::vector<std::uint8_t>*>(to);
            all.insert(all.end(), rgb.begin(), rgb.end());
            return true;
          },
          &pixels};
}

}  // namespace shodo
