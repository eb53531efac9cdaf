// Files for tests: whole files as text, and a Reader over a folder.
#pragma once

#include <deque>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "shodo/callbacks.h"

namespace shodo {

/// Where the sources stand: the build says so, or the working folder is it.
inline std::string source_folder() {
#ifdef SHODO_SOURCE_DIR
  return SHODO_SOURCE_DIR;
#else
  return ".";
#endif
}

/// Reads the files that a scene names, and keeps their texts.
class FolderReader {
 public:
  explicit FolderReader(std::string folder) : folder_(std::move(folder)) {}

  bool read(std::string_view path, std::string_view& text) {
    std::ifstream file(folder_ + "/" + std::string(path), std::ios::binary);
    if (!file) return false;
    texts_.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    text = texts_.back();
    return true;
  }

  Reader reader() {
    return {[](void* self, std::string_view path, std::string_view& text) {
              return static_cast<FolderReader*>(self)->read(path, text);
            },
            this};
  }

 private:
  std::string folder_;
  std::deque<std::string> texts_;
};

}  // namespace shodo
