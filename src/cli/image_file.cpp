#include "cli/image_file.h"

#include <climits>
#include <memory>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_NO_SIMD  // the same texels on every machine
#define STBI_MAX_DIMENSIONS 8192
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace shodo {

bool is_image_name(std::string_view path) {
  for (const std::string_view ending : {".png", ".jpg", ".jpeg", ".tga"}) {
    if (path.ends_with(ending)) return true;
  }
  return false;
}

bool decode_image(std::string_view file, std::string& ppm) {
  if (file.size() > INT_MAX) return false;
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()), static_cast<int>(file.size()), &width,
                            &height, &channels, 3),
      stbi_image_free);
  if (texels == nullptr) return false;
  ppm = "P6 " + std::to_string(width) + ' ' + std::to_string(height) + " 255\n";
  const std::size_t bytes = std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  ppm.append(reinterpret_cast<const char*>(texels.get()), bytes);
  return true;
}

}  // namespace shodo
