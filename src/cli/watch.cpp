#include "cli/watch.h"

#include <csignal>
#include <cstdio>

#include "shodo/shodo.h"

namespace shodo {

namespace {

volatile std::sig_atomic_t g_interrupted = 0;  // the only way a signal can tell

extern "C" void note_interrupt(int) { g_interrupted = 1; }

const char* shown_name(Stage stage) { return stage == Stage::kFormFactors ? "form factors" : stage_name(stage); }

}  // namespace

void listen_for_interrupts() {
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // A shell starts background jobs with SIGINT ignored; that stays so.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

bool interrupt_asked() { return g_interrupted != 0; }

Progress Watch::progress() {
  return {[](void* self, Stage stage, std::uint64_t done, std::uint64_t total) {
            Watch& watch = *static_cast<Watch*>(self);
            watch.enter(stage);
            watch.show(stage, done, total);
            return !interrupt_asked();
          },
          this};
}

void Watch::enter(Stage stage) {
  if (stage == stage_) return;
  const Clock::time_point now = Clock::now();
  seconds_[static_cast<std::size_t>(stage_)] += std::chrono::duration<double>(now - start_).count();
  start_ = now;
  stage_ = stage;
}

void Watch::finish() {
  const Clock::time_point now = Clock::now();
  seconds_[static_cast<std::size_t>(stage_)] += std::chrono::duration<double>(now - start_).count();
  start_ = now;
  wipe();
}

void Watch::show(Stage stage, std::uint64_t done, std::uint64_t total) {
  if (!shown_ || total == 0) return;
  const Clock::time_point now = Clock::now();
  if (now - last_shown_ < std::chrono::milliseconds(100)) return;
  last_shown_ = now;
  line_is_dirty_ = true;
  const double part = static_cast<double>(done) / static_cast<double>(total);
  std::fprintf(stderr, "\r%-12s %3.0f %%", shown_name(stage), 100 * (part > 1 ? 1 : part));
  std::fflush(stderr);
}

void Watch::wipe() {
  if (!line_is_dirty_) return;
  std::fprintf(stderr, "\r%-20s\r", "");
  std::fflush(stderr);
  line_is_dirty_ = false;
}

}  // namespace shodo
