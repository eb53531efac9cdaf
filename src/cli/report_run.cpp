#include "cli/report_run.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <optional>
#include <thread>

#include "cli/memory.h"
#include "cli/scene_files.h"
#include "cli/watch.h"

namespace shodo {

namespace {

/// One line on a terminal, of whichever run reports next: how many are finished, and how far this one is.
class ReportProgress {
 public:
  ReportProgress(std::size_t jobs, bool shown) : jobs_(jobs), shown_(shown) {}
  ~ReportProgress() {
    if (dirty_) std::fprintf(stderr, "\r%-78s\r", "");
  }

  void show(const std::string& label, Stage stage, std::uint64_t done, std::uint64_t total) {
    if (!shown_ || total == 0) return;
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(200)) return;
    last_ = now;
    dirty_ = true;
    const std::string text = std::to_string(finished_) + " of " + std::to_string(jobs_) + " runs; " + label + ": " +
                             stage_name(stage) + " " + std::to_string(100 * done / total) + " %";
    std::fprintf(stderr, "\r%-78.78s", text.c_str());
    std::fflush(stderr);
  }

  void finish_one() { ++finished_; }

 private:
  std::size_t jobs_;
  bool shown_;
  bool dirty_ = false;
  std::atomic<std::size_t> finished_ = 0;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_{};
};

struct Watched {
  ReportProgress& progress;
  const std::string& label;
  const std::atomic<bool>& failed;
};

Progress progress_of(Watched& watched) {
  return {[](void* self, Stage stage, std::uint64_t done, std::uint64_t total) {
            Watched& w = *static_cast<Watched*>(self);
            w.progress.show(w.label, stage, done, total);
            return !interrupt_asked() && !w.failed;
          },
          &watched};
}

Status failure(StatusCode code, const std::string& text) {
  Status status;
  status.code = code;
  std::snprintf(status.message, sizeof status.message, "%s", text.c_str());
  return status;
}

/// A scene loaded into memory of its own.
class LoadedScene {
 public:
  explicit LoadedScene(const ReportJob& job) : job_(job), files_(job.scene) {}

  Status load() {
    if (!job_.takes_more) {
      const Status status = read();
      return status.done() ? load_into(job_.memory) : status;
    }
    const Status status = load_at_any_size();
    if (!status.done()) return status;
    const std::uint64_t wanted = smallest_memory(*model_) + row_bytes();
    return wanted > memory_->size() ? load_into(wanted) : status;
  }

  /// Into the budget, and twice as much until it loads: what the rest takes is known then.
  Status load_at_any_size() {
    Status status = read();
    if (!status.done()) return status;
    status = load_into(job_.memory);
    constexpr std::uint64_t kMost = std::uint64_t{1} << 40;
    for (std::uint64_t bytes = job_.memory; status.code == StatusCode::kMemory && bytes < kMost;) {
      bytes = std::max(2 * bytes, status.bytes_needed);
      status = load_into(bytes);
    }
    return status;
  }

  Model& model() { return *model_; }

 private:
  Status read() {
    FileError error;
    return files_.read_top(text_, error) ? Status{} : failure(StatusCode::kFile, error.text);
  }

  /// The most that the rows of all pairs can take, blocks included: an entry of at most 12 bytes a pair, and a reserve.
  std::uint64_t row_bytes() const {
    const std::uint64_t n = statistics(*model_).patches;
    return 8 * n * n + (std::uint64_t{1} << 20);
  }

  Status load_into(std::uint64_t bytes) {
    model_ = nullptr;
    memory_.emplace(bytes);
    if (memory_->start() == nullptr)
      return failure(StatusCode::kFile, "the system refuses " + std::to_string(bytes) + " bytes of memory");
    Status status = shodo::load(job_.scene, text_, files_.reader(), job_.options, memory_->start(), bytes, model_);
    files_.explain(status);
    return status;
  }

  const ReportJob& job_;
  SceneFiles files_;
  std::string_view text_;
  std::optional<Memory> memory_;
  Model* model_ = nullptr;
};

LineSink sink_of(std::vector<std::uint8_t>& picture) {
  return {[](void* to, std::uint32_t, std::span<const std::uint8_t> rgb) {
            auto& bytes = *static_cast<std::vector<std::uint8_t>*>(to);
            bytes.insert(bytes.end(), rgb.begin(), rgb.end());
            return true;
          },
          &picture};
}

Status run_job(ReportJob& job, const Progress& progress) {
  LoadedScene scene(job);
  Status status = scene.load();
  if (!status.done()) return status;
  status = solve(scene.model(), progress);
  if (!status.done()) return status;
  job.maps = copy_maps(scene.model());
  job.patches = copy_patches(scene.model());
  job.picture.reserve(std::size_t{3} * job.options.width * job.options.height);
  status = draw(scene.model(), progress, sink_of(job.picture));
  if (!status.done()) return status;
  job.statistics = statistics(scene.model());
  return status;
}

}  // namespace

Status smallest_budget(const ReportJob& job, std::uint64_t& bytes) {
  bytes = 0;
  if (job.takes_more) return {};
  LoadedScene scene(job);
  const Status status = scene.load_at_any_size();
  if (status.done()) bytes = smallest_memory(scene.model());
  return status;
}

Status run_jobs(std::vector<ReportJob>& jobs, bool shown) {
  ReportProgress progress(jobs.size(), shown);
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  const auto work = [&] {
    for (std::size_t k = next++; k < jobs.size() && !failed; k = next++) {
      Watched watched{progress, jobs[k].label, failed};
      jobs[k].status = run_job(jobs[k], progress_of(watched));
      progress.finish_one();
      if (!jobs[k].status.done()) failed = true;
    }
  };
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::jthread> helpers;
  for (std::size_t k = 1; k < std::min<std::size_t>(cores, jobs.size()); ++k) helpers.emplace_back(work);
  work();
  helpers.clear();
  // A run that was stopped because another failed says "interrupted": what it was stopped for comes first.
  const auto own = [](const ReportJob& job) {
    return !job.status.done() && job.status.code != StatusCode::kInterrupted;
  };
  const auto any = [](const ReportJob& job) { return !job.status.done(); };
  auto at = std::find_if(jobs.begin(), jobs.end(), own);
  if (at == jobs.end()) at = std::find_if(jobs.begin(), jobs.end(), any);
  return at == jobs.end() ? Status{} : at->status;
}

}  // namespace shodo
