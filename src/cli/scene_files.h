// The scene's file and those that it names, read whole and kept until loading has returned. Pictures become PPM.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "cli/output.h"
#include "shodo/callbacks.h"
#include "shodo/status.h"

namespace shodo {

class SceneFiles {
 public:
  /// `scene`: the top file's path; what it names is sought in its folder.
  explicit SceneFiles(std::string scene);

  bool read_top(std::string_view& text, FileError& error);
  Reader reader();
  /// Says more than the library can: an included file's path from the working folder, and of a picture that couldn't be
  /// decoded, for which the library asks for a PPM, what the program takes.
  void explain(Status& status) const;
  /// All files that were read.
  const std::vector<std::string>& paths() const { return paths_; }

 private:
  bool read(const std::string& path, std::string_view& text, FileError& error);

  std::string scene_;
  std::string folder_;             // with its slash; empty: the working folder
  std::deque<std::string> texts_;  // addresses stay
  std::vector<std::string> paths_;
  std::string undecoded_;          // the picture read last, if it couldn't be decoded
};

}  // namespace shodo
