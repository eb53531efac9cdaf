#include "support/decoded_picture.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_PNM
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace shodo {

DecodedPicture decoded_picture(std::string_view file) {
  int width = 0, height = 0, channels = 0;
  const auto* bytes = reinterpret_cast<const stbi_uc*>(file.data());
  stbi_uc* pixels = stbi_load_from_memory(bytes, static_cast<int>(file.size()), &width, &height, &channels, 3);
  if (pixels == nullptr) return {};
  DecodedPicture picture{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  picture.rgb.assign(pixels, pixels + std::size_t{3} * picture.width * picture.height);
  stbi_image_free(pixels);
  return picture;
}

}  // namespace shodo
