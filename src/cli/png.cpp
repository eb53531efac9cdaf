#include "cli/png.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace shodo {

namespace {

struct Receiver {
  void (*write)(void* context, std::string_view bytes);
  void* context;
};

void receive(void* receiver, void* data, int size) {
  const Receiver& to = *static_cast<const Receiver*>(receiver);
  to.write(to.context, {static_cast<const char*>(data), static_cast<std::size_t>(size)});
}

}  // namespace

bool encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgb,
                void (*write)(void* context, std::string_view bytes), void* context) {
  Receiver receiver{write, context};
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  return stbi_write_png_to_func(receive, &receiver, w, h, 3, rgb.data(), 3 * w) != 0;
}

std::uint64_t png_bytes(std::uint32_t width, std::uint32_t height) {
  // The frame, its filtered rows, and twice the compressed bytes: their buffer doubles, and the file is a copy of them.
  // What doesn't compress is stored, so it is hardly longer than the rows; the hash table is 16,384 short lists.
  const std::uint64_t frame = std::uint64_t{3} * width * height;
  const std::uint64_t rows = frame + height;
  constexpr std::uint64_t kHashTable = 16384 * (8 + 8 + 32 * 8);
  return frame + rows + 3 * rows + kHashTable;
}

}  // namespace shodo
