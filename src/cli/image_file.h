// Pictures that scenes name, through stb_image: PNG, JPEG and TGA become PPM, which the library reads.
#pragma once

#include <string>
#include <string_view>

namespace shodo {

/// Whether a file of this name is to be decoded: .png, .jpg, .jpeg or .tga.
bool is_image_name(std::string_view path);

inline constexpr int kMostTexels = 8192;  // along a side

/// The picture in `file` as PPM with 255 levels, without its alpha; false if it can't be decoded or has more than
/// `most` texels along a side. What a cut file doesn't tell is black.
bool decode_image(std::string_view file, std::string& ppm, int most = kMostTexels);

}  // namespace shodo
