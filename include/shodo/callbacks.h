// How the library reaches the outside: it does no I/O itself.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace shodo {

/// Gives the text of a file that a scene names. `path` is relative to the top file's folder, with '/' between folders,
/// and never leaves it. The text must stay until load() or draw() has returned; both ask for pictures (PPM, P6 or P5),
/// load() for all other files.
struct Reader {
  /// False if the file can't be read.
  bool (*read)(void* context, std::string_view path, std::string_view& text) = nullptr;
  void* context = nullptr;
};

/// Takes the lines of a picture as they are finished, from the top; returning false stops the run (kInterrupted).
struct LineSink {
  /// `rgb`: 3 bytes a pixel, sRGB, left to right; valid during the call only.
  bool (*line)(void* context, std::uint32_t y, std::span<const std::uint8_t> rgb) = nullptr;
  void* context = nullptr;
};

/// The stages in the order in which they run; the program's statistics name them so.
enum class Stage : std::uint8_t { kLoad, kDirect, kFormFactors, kSolution, kMap, kPicture };
inline constexpr std::uint32_t kStageCount = 6;

/// Told from time to time how far a stage is; returning false stops the run with StatusCode::kInterrupted.
struct Progress {
  bool (*report)(void* context, Stage stage, std::uint64_t done, std::uint64_t total) = nullptr;
  void* context = nullptr;

  bool go_on(Stage stage, std::uint64_t done, std::uint64_t total) const {
    return report == nullptr || report(context, stage, done, total);
  }
};

}  // namespace shodo
