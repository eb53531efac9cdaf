#include "cli/run.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/clashes.h"
#include "cli/luminaires.h"
#include "cli/overlaps.h"

namespace shodo {

namespace {

/// Half of the machine's memory: past it, finding out what a scene needs would hurt more than not knowing.
std::size_t largest_trial() {
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || bytes <= 0) return std::size_t{1} << 30;
  return static_cast<std::size_t>(pages) / 2 * static_cast<std::size_t>(bytes);
}

std::string plural(std::uint64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

Run::Run(const Arguments& arguments)
    : arguments_(arguments),
      draws_(arguments.command != Command::kMap),
      watch_(!arguments.quiet && isatty(STDERR_FILENO) != 0),
      files_(arguments.scene) {}

int Run::read_scene() {
  FileError error;
  return files_.read_top(text_, error) ? 0 : tell(error);
}

Status Run::load_into(std::size_t bytes) {
  model_ = nullptr;
  memory_.emplace(bytes);
  if (memory_->start() == nullptr) {
    Status status;
    status.code = StatusCode::kFile;
    std::snprintf(status.message, sizeof status.message, "the system refuses %s of memory", size_text(bytes).c_str());
    return status;
  }
  Status status =
      shodo::load(arguments_.scene, text_, files_.reader(), arguments_.options, memory_->start(), bytes, model_);
  files_.explain(status);
  std::string mistake;
  if (status.done() && !outputs_apart(arguments_, files_.paths(), mistake)) {
    status.code = StatusCode::kUsage;
    std::snprintf(status.message, sizeof status.message, "%s", mistake.c_str());
  }
  return status;
}

int Run::load_in_budget() {
  if (const int status = read_scene(); status != 0) return status;
  const Status status = load_into(arguments_.memory);
  if (status.code == StatusCode::kMemory) {
    if (const int other = load_at_any_size(); other != 0) return other;
    return refuse_budget(smallest_memory(*model_, draws_));
  }
  if (!status.done()) return tell(status);
  const std::uint64_t needed = smallest_memory(*model_, draws_);
  if (needed > arguments_.memory) return refuse_budget(needed);
  if (!arguments_.statistics.empty()) merged_plates_ = shodo::merged_plates(*model_);
  return tell_interrupt();
}

int Run::load_at_any_size() {
  if (text_.data() == nullptr) {
    if (const int status = read_scene(); status != 0) return status;
  }
  const std::size_t most = std::max<std::size_t>(largest_trial(), arguments_.memory);
  for (std::size_t bytes = std::min<std::size_t>(8 << 20, most);;) {
    Status status = load_into(bytes);
    if (status.done()) return tell_interrupt();
    if (status.code != StatusCode::kMemory) return tell(status);
    if (bytes == most) return refuse_scene(status.bytes_needed, most);
    bytes = std::min(most, std::max<std::size_t>(2 * bytes, status.bytes_needed));
  }
}

int Run::refuse_budget(std::uint64_t needed) {
  const std::uint64_t rounded = (needed + 1023) / 1024 * 1024;
  std::fprintf(stderr, "shodo: the memory budget of %s is too small: expected at least %llu bytes (--memory %s)\n",
               size_text(arguments_.memory).c_str(), static_cast<unsigned long long>(needed),
               size_text(rounded).c_str());
  return static_cast<int>(StatusCode::kMemory);
}

int Run::refuse_scene(std::uint64_t needed, std::uint64_t tried) {
  watch_.finish();
  std::fprintf(stderr,
               "shodo: the memory budget of %s is too small: expected at least %llu bytes; how many is not tried past "
               "%llu, half of this machine's memory or --memory\n",
               size_text(arguments_.memory).c_str(), static_cast<unsigned long long>(needed),
               static_cast<unsigned long long>(tried));
  return static_cast<int>(StatusCode::kMemory);
}

int Run::solve() {
  watch_.enter(Stage::kDirect);
  const Status status = shodo::solve(*model_, watch_.progress());
  watch_.finish();
  return status.done() ? 0 : tell(status);
}

int Run::draw(const LineSink& sink, const FileError& error) {
  watch_.enter(Stage::kPicture);
  const Status status = shodo::draw(*model_, watch_.progress(), sink);
  watch_.finish();
  if (!error.text.empty()) return tell(error);
  return status.done() ? 0 : tell(status);
}

int Run::see(const SeenSink& sink) {
  watch_.enter(Stage::kPicture);
  const Status status = shodo::see(*model_, watch_.progress(), sink);
  watch_.finish();
  return status.done() ? 0 : tell(status);
}

int Run::find_camera() {
  std::string names;
  for (const Camera& camera : model_->scene.cameras) {
    if (arguments_.options.camera.empty() || arguments_.options.camera == camera.name) return 0;
    names += (names.empty() ? "" : ", ") + std::string(camera.name);
  }
  if (names.empty()) {
    std::fprintf(stderr, "%s: expected a camera, found none\n", arguments_.scene.c_str());
    return static_cast<int>(StatusCode::kScene);
  }
  std::fprintf(stderr, "shodo: --camera: expected one of the scene's (%s), found '%s'\n", names.c_str(),
               std::string(arguments_.options.camera).c_str());
  return static_cast<int>(StatusCode::kUsage);
}

int Run::tell(const Status& status) {
  watch_.finish();
  if (status.code == StatusCode::kInterrupted) {
    std::fprintf(stderr, "shodo: interrupted, nothing was written\n");
  } else if (status.file[0] == '\0') {
    std::fprintf(stderr, "shodo: %s\n", status.message);
  } else if (status.line == 0) {
    std::fprintf(stderr, "%s: %s\n", status.file, status.message);
  } else {
    std::fprintf(stderr, "%s:%u:%u: %s\n", status.file, status.line, status.column, status.message);
  }
  return static_cast<int>(status.code);
}

int Run::tell_interrupt() {
  if (!interrupt_asked()) return 0;
  Status status;
  status.code = StatusCode::kInterrupted;
  return tell(status);
}

int Run::tell(const FileError& error) {
  watch_.finish();
  std::fprintf(stderr, "shodo: %s\n", error.text.c_str());
  return static_cast<int>(StatusCode::kFile);
}

void Run::warn(const std::string& text) {
  if (arguments_.quiet) return;
  watch_.finish();
  std::fprintf(stderr, "shodo: %s\n", text.c_str());
}

void Run::warn_of_changes() {
  for (const std::string& line : luminaire_warnings(model_->scene)) warn(line);
  const Statistics& counted = model_->statistics;
  if (counted.polygons_dropped != 0) {
    warn(plural(counted.polygons_dropped, "polygon without area was", "polygons without area were") + " dropped");
  }
  if (counted.patches_dropped != 0) {
    warn(plural(counted.patches_dropped, "patch", "patches") +
         " under 4 lattice steps wide neither send nor receive light, they only block it");
  }
  if (counted.lights_clamped != 0) {
    warn(plural(counted.lights_clamped, "distance", "distances") +
         " to a point light under one lattice step counted as one step");
  }
}

}  // namespace shodo
