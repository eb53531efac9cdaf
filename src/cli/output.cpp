#include "cli/output.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace shodo {

namespace {

constexpr std::size_t kBufferBytes = 64 * 1024;

/// The folder part of a path with its last slash, and the rest.
std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

/// Where a name leads; the name itself, or what the link says, if nothing is there yet.
std::string followed(const std::string& name) {
  std::string to = name;
  for (int links = 0; links < 40; ++links) {  // the system follows as many
    const std::string path = real_path(to);
    if (!path.empty()) return path;
    char link[PATH_MAX];
    const ssize_t length = readlink(to.c_str(), link, sizeof link);
    if (length <= 0 || length == sizeof link) break;
    to = (link[0] == '/' ? "" : folder_of(to)) + std::string(link, static_cast<std::size_t>(length));
  }
  return to;
}

/// Standard output or error if that is this file, -1 otherwise.
int open_already(const struct stat& file) {
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat found {};
    if (fstat(descriptor, &found) == 0 && found.st_dev == file.st_dev && found.st_ino == file.st_ino) return descriptor;
  }
  return -1;
}

/// A name beside `path`, hidden, for mkstemp and mkdtemp; short enough for any file system that took the name itself.
std::string pattern_beside(const std::string& path) {
  const std::string folder = folder_of(path);
  return folder + "." + path.substr(folder.size()).substr(0, 200) + ".XXXXXX";
}

mode_t usual_mode(mode_t mode) {
  const mode_t mask = umask(0);
  umask(mask);
  return mode & ~mask;
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// 0: a folder without entries; otherwise an errno.
int empty_folder(const std::string& path) {
  DIR* folder = opendir(path.c_str());
  if (folder == nullptr) return errno;
  int found = 0;
  while (const dirent* entry = readdir(folder)) {
    if (std::strcmp(entry->d_name, ".") != 0 && std::strcmp(entry->d_name, "..") != 0) found = ENOTEMPTY;
  }
  closedir(folder);
  return found;
}

}  // namespace

std::string real_path(const std::string& name) {
  const std::unique_ptr<char, void (*)(void*)> path(realpath(name.c_str(), nullptr), std::free);
  return path == nullptr ? "" : path.get();
}

int named_descriptor(const std::string& name) {
  if (name == "-" || name == "/dev/stdout") return STDOUT_FILENO;
  if (name == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!name.starts_with(folder)) continue;
    int number = 0;
    const char *from = name.data() + folder.size(), *end = name.data() + name.size();
    const auto [stopped, wrong] = std::from_chars(from, end, number);
    if (wrong == std::errc() && stopped == end && *from != '-') return number;
  }
  return -1;
}

bool FileError::set(const std::string& name, int error) {
  if (text.empty()) text = (name == "-" ? "standard output" : name) + ": " + std::strerror(error);
  return false;
}

OutputFile::~OutputFile() { drop(); }

void OutputFile::drop() {
  if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
}

bool OutputFile::probe(FileError& error) {
  if (name_ == "-") return true;
  if (const int own = named_descriptor(name_); own >= 0) {
    const int flags = fcntl(own, F_GETFL);
    return (flags >= 0 && (flags & O_ACCMODE) != O_RDONLY) || error.set(name_, EBADF);
  }
  struct stat found {};
  if (stat(name_.c_str(), &found) == 0 && !S_ISREG(found.st_mode)) {
    if (S_ISDIR(found.st_mode)) return error.set(name_, EISDIR);
    return access(name_.c_str(), W_OK) == 0 || error.set(name_, errno);  // opening a pipe would wait for its reader
  }
  const bool works = open(error);
  drop();
  return works;
}

/// From where it stands; it stays open.
bool OutputFile::write_into(int descriptor, FileError& error) {
  descriptor_ = descriptor == STDOUT_FILENO ? descriptor : fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  return descriptor_ >= 0 || error.set(name_, errno);
}

bool OutputFile::open(FileError& error) {
  if (const int own = named_descriptor(name_); own >= 0) return write_into(own, error);
  target_ = followed(name_);
  struct stat found {};
  const bool exists = stat(target_.c_str(), &found) == 0;
  if (!exists && errno != ENOENT) return error.set(name_, errno);  // too long a name, a link that leads to itself
  if (exists && !S_ISREG(found.st_mode)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    return descriptor_ >= 0 || error.set(name_, errno);
  }
  if (const int own = exists ? open_already(found) : -1; own >= 0) return write_into(own, error);
  if (target_.empty() || target_.back() == '/') return error.set(name_, EISDIR);
  std::string pattern = pattern_beside(target_);
  descriptor_ = mkostemp(pattern.data(), O_CLOEXEC);
  if (descriptor_ < 0) return error.set(name_, errno);
  temporary_ = std::move(pattern);
  const mode_t mode = exists ? found.st_mode & 07777 : usual_mode(0666);
  return fchmod(descriptor_, mode) == 0 || error.set(name_, errno);
}

bool OutputFile::write(std::string_view bytes, FileError& error) {
  buffer_ += bytes;
  return buffer_.size() < kBufferBytes || flush(error);
}

bool OutputFile::flush(FileError& error) {
  const bool written = write_all(descriptor_, buffer_);
  const int reason = errno;
  buffer_.clear();
  return written || error.set(name_, reason);
}

bool OutputFile::close(FileError& error) {
  if (!flush(error)) return false;
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (descriptor == STDOUT_FILENO) return true;
  return ::close(descriptor) == 0 || error.set(name_, errno);
}

bool OutputFile::commit(FileError& error) {
  if (temporary_.empty()) return true;
  if (rename(temporary_.c_str(), target_.c_str()) != 0) return error.set(name_, errno);
  temporary_.clear();
  return true;
}

OutputFolder::~OutputFolder() { drop(); }

/// Takes no memory: it may be what there is none of.
void OutputFolder::drop() {
  if (temporary_.empty()) return;
  for (const std::string& path : files_) unlink(path.c_str());
  rmdir(temporary_.c_str());
  files_.clear();
  temporary_.clear();
}

bool OutputFolder::probe(FileError& error) {
  const bool works = open(error);
  drop();
  return works;
}

bool OutputFolder::open(FileError& error) {
  target_ = name_;
  while (target_.size() > 1 && target_.back() == '/') target_.pop_back();
  struct stat found {};
  if (stat(target_.c_str(), &found) == 0) {
    struct stat here {};
    if (const int reason = empty_folder(target_); reason != 0) return error.set(name_, reason);
    // Replacing the working folder would leave the caller's shell in one that is gone.
    if (stat(".", &here) == 0 && here.st_dev == found.st_dev && here.st_ino == found.st_ino)
      return error.set(name_, EBUSY);
    target_ = followed(target_);
  } else if (const int reason = errno; reason != ENOENT || lstat(target_.c_str(), &found) == 0) {
    return error.set(name_, reason == ENOENT ? ENOTDIR : reason);  // a folder can't take the name of a link to nowhere
  }
  std::string pattern = pattern_beside(target_);
  if (mkdtemp(pattern.data()) == nullptr) return error.set(name_, errno);
  temporary_ = std::move(pattern);
  return chmod(temporary_.c_str(), usual_mode(0777)) == 0 || error.set(name_, errno);
}

bool OutputFolder::write_file(const std::string& name, std::string_view bytes, FileError& error) {
  const std::string shown = name_ + "/" + name;
  files_.push_back(temporary_ + "/" + name);
  const std::string& path = files_.back();
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) return error.set(shown, errno);
  const bool written = write_all(descriptor, bytes);
  const int reason = errno;
  if (::close(descriptor) != 0 && written) return error.set(shown, errno);
  return written || error.set(shown, reason);
}

bool OutputFolder::commit(FileError& error) {
  if (rename(temporary_.c_str(), target_.c_str()) != 0) return error.set(name_, errno);
  temporary_.clear();
  return true;
}

}  // namespace shodo
