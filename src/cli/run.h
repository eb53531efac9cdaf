// One run of the program on one scene: what the commands share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "cli/memory.h"
#include "cli/scene_files.h"
#include "cli/watch.h"
#include "model.h"

namespace shodo {

class Run {
 public:
  explicit Run(const Arguments& arguments);

  /// Loads the scene into the budget; exit status, 0 if it is loaded and all that follows fits.
  int load_in_budget();
  /// Loads the scene into as much memory as it takes.
  int load_at_any_size();
  /// Direct and ambient light and the maps.
  int solve();
  /// `error`: what the sink stopped for, if it did.
  int draw(const LineSink& sink, const FileError& error);
  /// What each sample of the picture sees.
  int see(const SeenSink& sink);
  /// Whether the camera asked for is there, before minutes are spent.
  int find_camera();

  const Model& model() const { return *model_; }
  Watch& watch() { return watch_; }
  const Watch& watch() const { return watch_; }
  const Arguments& arguments() const { return arguments_; }
  bool draws() const { return draws_; }
  /// As of cli/overlaps.h, counted as soon as the scene is loaded: later its triangles may have made room. 0 without
  /// --stats.
  std::uint64_t merged_plates() const { return merged_plates_; }

  /// Says what went wrong; the exit status.
  int tell(const Status& status);
  int tell(const FileError& error);
  /// 0 if the user didn't ask to stop.
  int tell_interrupt();
  /// A line on standard error, unless --quiet.
  void warn(const std::string& text);
  /// What the program did otherwise than the scene says: dropped, moved.
  void warn_of_changes();
  /// Says how much the budget must be; the exit status.
  int refuse_budget(std::uint64_t needed);

 private:
  int read_scene();
  Status load_into(std::size_t bytes);
  /// Says that more is needed than what was tried; the exit status.
  int refuse_scene(std::uint64_t needed, std::uint64_t tried);

  const Arguments& arguments_;
  bool draws_;  // whether the picture's memory counts
  Watch watch_;
  SceneFiles files_;
  std::string_view text_;
  std::optional<Memory> memory_;
  Model* model_ = nullptr;
  std::uint64_t merged_plates_ = 0;
};

}  // namespace shodo
