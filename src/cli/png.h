// PNG through stb_image_write: the one file that stands on code from outside.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace shodo {

/// `rgb`: 3 bytes a pixel, rows from the top. `write` is called with the file's bytes, in order. Where memory runs
/// out std::bad_alloc is thrown, and nothing is held any more; false if the encoder gives up otherwise.
bool encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgb,
                void (*write)(void* context, std::string_view bytes), void* context);

/// The most bytes that the frame and its compression take, outside the library's budget.
std::uint64_t png_bytes(std::uint32_t width, std::uint32_t height);

}  // namespace shodo
