#include "cli/image_file.h"

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace {

/// The largest block that stb_image may have: what its file and its picture can need, so that a few wrong bytes (a
/// chunk said to be longer than the file) can't ask for much.
thread_local std::size_t t_largest_block = 0;

/// The compressed bytes stand once, doubled while they are collected; a texel takes up to 4 values of 2 bytes, doubled
/// while they are inflated, and JPEG rounds each side up to whole blocks.
std::size_t largest_block(std::size_t file, int width, int height) {
  return 2 * file + 16 * static_cast<std::size_t>(width + 64) * static_cast<std::size_t>(height + 64) + 65536;
}

/// Memory for stb_image: zeros, since it leaves what a cut file doesn't tell as it was.
void* zeroed(std::size_t bytes) { return bytes <= t_largest_block ? std::calloc(1, bytes) : nullptr; }

void* zeroed_again(void* block, std::size_t before, std::size_t bytes) {
  if (bytes > t_largest_block) return nullptr;
  auto* moved = static_cast<char*>(std::realloc(block, bytes));
  if (moved != nullptr && bytes > before) std::memset(moved + before, 0, bytes - before);
  return moved;
}

}  // namespace

#define STBI_MALLOC(bytes) zeroed(bytes)
#define STBI_REALLOC_SIZED(block, before, bytes) zeroed_again(block, before, bytes)
#define STBI_FREE(block) std::free(block)

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
#define STBI_MAX_DIMENSIONS shodo::kMostTexels
#ifdef __clang__  // what it does with null pointers and shifts is its own
#pragma clang attribute push(__attribute__((no_sanitize("undefined"))), apply_to = function)
#endif
#include <stb/stb_image.h>
#ifdef __clang__
#pragma clang attribute pop
#endif
#pragma GCC diagnostic pop

namespace shodo {

bool is_image_name(std::string_view path) {
  std::string ending(path.substr(std::min(path.rfind('.'), path.size())));
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".tga";
}

bool decode_image(std::string_view file, std::string& ppm, int most) {
  if (file.size() > INT_MAX) return false;
  const auto* bytes_of_file = reinterpret_cast<const stbi_uc*>(file.data());
  const int size = static_cast<int>(file.size());
  int width = 0, height = 0, channels = 0;
  t_largest_block = largest_block(file.size(), 0, 0);
  if (stbi_info_from_memory(bytes_of_file, size, &width, &height, &channels) == 0) return false;
  if (width > most || height > most) return false;
  t_largest_block = largest_block(file.size(), width, height);
  const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
      stbi_load_from_memory(bytes_of_file, size, &width, &height, &channels, 3), stbi_image_free);
  if (texels == nullptr) return false;
  ppm = "P6 " + std::to_string(width) + ' ' + std::to_string(height) + " 255\n";
  const std::size_t bytes = std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  ppm.append(reinterpret_cast<const char*>(texels.get()), bytes);
  return true;
}

}  // namespace shodo
