// What the fuzzers share: a scene and the files that it names in one input, memory, and what must hold whatever the
// bytes are. A broken promise traps, as a mistake of ours does anywhere (base/check.h).
//
// An input is the top file; a line "%% PATH" starts a file that it may name, up to the next such line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "base/check.h"
#include "shodo/shodo.h"

namespace shodo::fuzz {

class InputFiles {
 public:
  explicit InputFiles(std::string_view input) {
    std::string_view path;
    std::size_t start = 0;
    while (true) {
      const std::size_t mark = find_mark(input, start);
      const std::string_view text = input.substr(start, mark - start);
      if (path.empty()) {
        top_ = text;
      } else {
        files_.push_back({path, text});
      }
      if (mark == input.size()) return;
      const std::size_t end = std::min(input.find('\n', mark), input.size());
      path = input.substr(mark + 3, end - mark - 3);
      start = std::min(end + 1, input.size());
    }
  }

  std::string_view top() const { return top_; }
  Reader reader() {
    return {[](void* self, std::string_view path, std::string_view& text) {
              for (const File& file : static_cast<InputFiles*>(self)->files_) {
                if (file.path != path) continue;
                text = file.text;
                return true;
              }
              return false;
            },
            this};
  }

 private:
  struct File {
    std::string_view path, text;
  };

  /// The next line "%% ..." at or after `start`; the end of the input if there is none.
  static std::size_t find_mark(std::string_view input, std::size_t start) {
    for (std::size_t at = input.find("%% ", start); at != std::string_view::npos; at = input.find("%% ", at + 1)) {
      if (at == 0 || input[at - 1] == '\n') return at;
    }
    return input.size();
  }

  std::string_view top_;
  std::vector<File> files_;
};

/// Every refusal says what, and a scene's says where.
inline void expect_told(const Status& status) {
  if (status.done() || status.code == StatusCode::kInterrupted) return;
  SHODO_CHECK(std::memchr(status.message, 0, sizeof status.message) != nullptr);
  SHODO_CHECK(std::memchr(status.file, 0, sizeof status.file) != nullptr);
  if (status.code == StatusCode::kMemory) return;
  SHODO_CHECK(status.message[0] != 0);
  if (status.code != StatusCode::kScene) return;
  SHODO_CHECK(status.file[0] != 0 && status.line > 0 && status.column > 0);
}

inline bool same(const Status& a, const Status& b) {
  return a.code == b.code && a.line == b.line && a.column == b.column && std::strcmp(a.file, b.file) == 0 &&
         std::strcmp(a.message, b.message) == 0;
}

}  // namespace shodo::fuzz
