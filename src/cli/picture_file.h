// The picture as a file: PPM line by line while it is drawn, PNG from a whole frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/output.h"
#include "shodo/callbacks.h"

namespace shodo {

class PictureFile {
 public:
  /// The name's ending says which kind: .png or .ppm.
  PictureFile(const std::string& name, std::uint32_t width, std::uint32_t height);

  bool probe(FileError& error) { return file_.probe(error); }
  bool open(FileError& error);
  /// Takes the lines; stops the drawing when one can't be written, and `error` then says why.
  LineSink sink(FileError& error);
  /// After the last line; the file still has its temporary name.
  bool close(FileError& error);
  bool commit(FileError& error) { return file_.commit(error); }

 private:
  bool take_line(std::span<const std::uint8_t> rgb);

  OutputFile file_;
  std::uint32_t width_, height_;
  bool png_;
  std::vector<std::uint8_t> frame_;  // PNG only
  FileError* error_ = nullptr;
};

}  // namespace shodo
