// Pictures and maps read back: PPM (P6, 8 bits) and PFM (Pf, PF, either byte order), as rows of numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace shodo {

struct ValueGrid {
  bool map = false;            // lux; else display levels, 0 .. 255
  std::uint32_t width = 0, height = 0, channels = 1;
  std::vector<float> value;    // rows from the top, channels together
};

/// False, and what is wrong, if the bytes are neither; a map must hold finite numbers.
bool read_grid(std::string_view bytes, ValueGrid& grid, std::string& mistake);

}  // namespace shodo
