#include "cli/picture_file.h"

#include <cerrno>
#include <string_view>

#include "cli/png.h"

namespace shodo {

PictureFile::PictureFile(const std::string& name, std::uint32_t width, std::uint32_t height)
    : file_(name), width_(width), height_(height), png_(name.ends_with(".png")) {}

bool PictureFile::open(FileError& error) {
  if (!file_.open(error)) return false;
  if (png_) {
    frame_.reserve(std::size_t{3} * width_ * height_);
    return true;
  }
  return file_.write("P6\n" + std::to_string(width_) + " " + std::to_string(height_) + "\n255\n", error);
}

LineSink PictureFile::sink(FileError& error) {
  error_ = &error;
  return {[](void* self, std::uint32_t, std::span<const std::uint8_t> rgb) {
            return static_cast<PictureFile*>(self)->take_line(rgb);
          },
          this};
}

bool PictureFile::take_line(std::span<const std::uint8_t> rgb) {
  if (png_) {
    frame_.insert(frame_.end(), rgb.begin(), rgb.end());
    return true;
  }
  return file_.write({reinterpret_cast<const char*>(rgb.data()), rgb.size()}, *error_);
}

bool PictureFile::close(FileError& error) {
  if (png_) {
    struct Context {
      OutputFile& file;
      FileError& error;
    } context{file_, error};
    const auto write = [](void* to, std::string_view bytes) {
      Context& c = *static_cast<Context*>(to);
      if (c.error.text.empty()) c.file.write(bytes, c.error);
    };
    if (!encode_png(width_, height_, frame_, write, &context)) return error.set(file_.name(), ENOMEM);
    if (!error.text.empty()) return false;
  }
  return file_.close(error);
}

}  // namespace shodo
