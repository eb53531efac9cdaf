#include "cli/scene_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "cli/image_file.h"

namespace shodo {

namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20;

/// Open for reading, and closed whatever happens.
struct InputFile {
  explicit InputFile(const std::string& path) : descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~InputFile() {
    if (descriptor >= 0) close(descriptor);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const int descriptor;
};

/// 0, or an errno.
int read_whole(const std::string& path, std::string& text) {
  const InputFile file(path);
  if (file.descriptor < 0) return errno;
  int error = 0;
  for (;;) {
    constexpr std::size_t kStep = 16 * 1024;
    const std::size_t size = text.size();
    text.resize(size + kStep);
    const ssize_t got = ::read(file.descriptor, text.data() + size, kStep);
    if (got < 0) error = errno;
    text.resize(size + (got > 0 ? static_cast<std::size_t>(got) : 0));
    if (got < 0 && error == EINTR) {
      error = 0;
      continue;
    }
    if (text.size() > kLargestFile) error = EFBIG;
    if (got <= 0 || error != 0) break;
  }
  return error;
}

}  // namespace

SceneFiles::SceneFiles(std::string scene) : scene_(std::move(scene)) {
  const std::size_t slash = scene_.rfind('/');
  if (slash != std::string::npos) folder_ = scene_.substr(0, slash + 1);
}

bool SceneFiles::read_top(std::string_view& text, FileError& error) { return read(scene_, text, error); }

Reader SceneFiles::reader() {
  return {[](void* self, std::string_view path, std::string_view& text) {
            SceneFiles& files = *static_cast<SceneFiles*>(self);
            FileError error;  // the library says which statement named the file
            return files.read(files.folder_ + std::string(path), text, error);
          },
          this};
}

void SceneFiles::explain(Status& status) const {
  const std::string file = status.file;
  constexpr std::size_t kMost = sizeof status.file - 1;  // of a longer name it is the end
  const bool top = file == scene_ || (file.size() == kMost && scene_.ends_with(file));
  if (!file.empty() && !top) {
    const std::string path = folder_ + file;
    const std::size_t first = path.size() > kMost ? path.size() - kMost : 0;
    std::snprintf(status.file, sizeof status.file, "%s", path.c_str() + first);
  }
  if (status.code != StatusCode::kScene || undecoded_.empty()) return;
  std::snprintf(status.message, sizeof status.message,
                "expected a PNG, JPEG or TGA that can be decoded, of 1 to %d texels each way, found %s", kMostTexels,
                undecoded_.c_str());
}

bool SceneFiles::read(const std::string& path, std::string_view& text, FileError& error) {
  std::string whole;
  if (const int reason = read_whole(path, whole); reason != 0) return error.set(path, reason);
  if (std::find(paths_.begin(), paths_.end(), path) == paths_.end()) paths_.push_back(path);
  undecoded_.clear();
  if (is_image_name(path)) {
    std::string ppm;
    if (decode_image(whole, ppm)) {
      whole = std::move(ppm);
    } else if (!whole.starts_with("P5") && !whole.starts_with("P6")) {  // those the library reads whatever their name
      undecoded_ = path.substr(folder_.size());
    }
  }
  text = texts_.emplace_back(std::move(whole));
  return true;
}

}  // namespace shodo
