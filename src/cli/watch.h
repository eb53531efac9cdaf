// Watches a run: how long each stage takes, how far it is, and whether the user wants it to stop.
#pragma once

#include <chrono>

#include "shodo/callbacks.h"

namespace shodo {

/// From here on SIGINT and SIGTERM ask the run to stop; a second one ends the program at once.
void listen_for_interrupts();
bool interrupt_asked();

class Watch {
 public:
  /// `shown`: whether progress is written to standard error.
  explicit Watch(bool shown) : shown_(shown), start_(Clock::now()) {}

  Progress progress();
  /// From now on time belongs to `stage`; progress() calls it too.
  void enter(Stage stage);
  /// Ends the last stage and wipes the progress line.
  void finish();
  bool shown() const { return shown_; }
  double seconds(Stage stage) const { return seconds_[static_cast<std::size_t>(stage)]; }

 private:
  using Clock = std::chrono::steady_clock;

  void show(Stage stage, std::uint64_t done, std::uint64_t total);
  void wipe();

  bool shown_;
  bool line_is_dirty_ = false;
  Stage stage_ = Stage::kLoad;
  Clock::time_point start_;  // of the time not yet given to a stage
  Clock::time_point last_shown_{};
  double seconds_[kStageCount] = {};
};

}  // namespace shodo
