// stb_image_write takes memory as C does and doesn't look whether it got any. So its blocks are counted here: one that
// the system refuses is an exception, and what stb still holds then is given back.
#include "cli/png.h"

#include <cstdlib>
#include <cstring>
#include <new>

namespace shodo {

namespace {

/// Blocks that stb holds, in a ring.
struct alignas(16) Held {
  Held* before = this;
  Held* after = this;
};
thread_local Held t_held;  // stb's macros have no context

void* hold(Held* block) {
  if (block == nullptr) throw std::bad_alloc();
  *block = {t_held.before, &t_held};
  t_held.before->after = block;
  t_held.before = block;
  return block + 1;
}

void let_go(Held* block) {
  block->before->after = block->after;
  block->after->before = block->before;
}

void* take(std::size_t size) { return hold(static_cast<Held*>(std::malloc(sizeof(Held) + size))); }

void give_back(void* memory) {
  if (memory == nullptr) return;
  Held* const block = static_cast<Held*>(memory) - 1;
  let_go(block);
  std::free(block);
}

void* take_more(void* memory, std::size_t old_size, std::size_t size) {
  void* const larger = take(size);
  if (memory != nullptr) std::memcpy(larger, memory, old_size < size ? old_size : size);
  give_back(memory);
  return larger;
}

/// After stb has returned, or not.
struct GiveAllBack {
  ~GiveAllBack() {
    while (t_held.after != &t_held) give_back(t_held.after + 1);
  }
};

}  // namespace

}  // namespace shodo

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_MALLOC(size) ::shodo::take(size)
#define STBIW_REALLOC_SIZED(memory, old_size, size) ::shodo::take_more(memory, old_size, size)
#define STBIW_FREE(memory) ::shodo::give_back(memory)
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
  const GiveAllBack rest;
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
