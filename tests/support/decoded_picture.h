// PNG and PPM files as pixels, through stb_image: nothing of the program's own.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace shodo {

struct DecodedPicture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Empty if `file` is neither.
DecodedPicture decoded_picture(std::string_view file);

}  // namespace shodo
