// A scene from a string, through the real load_scene; for the tests of all stages.
//
//   LoadedScene room("shodo 1\nmaterial white diffuse 0.5\nobject floor\nquad white 0 0 0  0 0 1  1 0 1  1 0 0\n");
//   room.scene ... room.arena has room for what follows.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>

#include "base/arena.h"
#include "scene/scene.h"
#include "scene/scene_file.h"

namespace shodo {

/// Included files by their path relative to the top file's folder.
using TestFiles = std::map<std::string, std::string, std::less<>>;

inline Reader reader_of(TestFiles& files) {
  Reader reader;
  reader.context = &files;
  reader.read = [](void* context, std::string_view path, std::string_view& text) {
    const TestFiles& all = *static_cast<TestFiles*>(context);
    const auto found = all.find(path);
    if (found == all.end()) return false;
    text = found->second;
    return true;
  };
  return reader;
}

/// "top.scn:3:7: expected ...", and for GoogleTest's messages.
inline std::string to_text(const Status& status) {
  if (status.done()) return "done";
  std::string text = status.file;
  if (status.line > 0) text += ":" + std::to_string(status.line) + ":" + std::to_string(status.column);
  return text + ": " + status.message;
}

/// Whether it loaded is in `status`; an error is not a failure of the test.
struct TestScene {
  explicit TestScene(std::string_view text, const Options& options = {}, TestFiles included = {},
                     std::size_t bytes = std::size_t{64} << 20)
      : files(std::move(included)), memory(new std::byte[bytes]), arena(memory.get(), bytes) {
    status = load_scene("top.scn", text, reader_of(files), options, arena, scene);
  }
  TestScene(const TestScene&) = delete;
  TestScene& operator=(const TestScene&) = delete;

  TestFiles files;
  std::unique_ptr<std::byte[]> memory;  // not touched before it is used, so a large one costs nothing
  Arena arena;
  Scene scene;
  Status status;
};

/// Must load.
struct LoadedScene : TestScene {
  explicit LoadedScene(std::string_view text, const Options& options = {}, TestFiles included = {})
      : TestScene(text, options, std::move(included)) {
    EXPECT_TRUE(status.done()) << to_text(status);
  }
};

}  // namespace shodo
