// Files that appear whole or not at all: written under another name beside their own, checked, then renamed.
//
// What is there already and is no regular file (a device, a pipe) can't be replaced and is written straight into.
// "-" is standard output. What a name says is open already (/dev/stdout, /dev/fd/7) is written into from where it
// stands, whatever it is.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace shodo {

/// The one path of a file or folder, links followed; empty if there is none.
std::string real_path(const std::string& name);

/// The descriptor that a name means: "-", /dev/stdout, /dev/stderr, /dev/fd/7, /proc/self/fd/7; -1: none of these.
int named_descriptor(const std::string& name);

/// What went wrong with which file; the first mistake stays. Everything that touches files returns false after one.
struct FileError {
  std::string text;  // "out/day.png: No space left on device"; empty: nothing went wrong

  /// Keeps errno's text; always false.
  bool set(const std::string& name, int error);
};

class OutputFile {
 public:
  explicit OutputFile(std::string name) : name_(std::move(name)) {}
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Whether open() can be expected to work, tried by doing it; leaves nothing behind.
  bool probe(FileError& error);
  bool open(FileError& error);
  bool write(std::string_view bytes, FileError& error);
  /// Everything is with the system afterwards, and the file's name still the temporary one.
  bool close(FileError& error);
  /// Gives the file its name.
  bool commit(FileError& error);

  const std::string& name() const { return name_; }

 private:
  bool write_into(int descriptor, FileError& error);
  bool flush(FileError& error);
  void drop();

  std::string name_;
  std::string target_;     // name_ with symbolic links followed
  std::string temporary_;  // empty: written straight
  std::string buffer_;
  int descriptor_ = -1;
};

/// A folder that is filled beside its name.
class OutputFolder {
 public:
  explicit OutputFolder(std::string name) : name_(std::move(name)) {}
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  bool probe(FileError& error);
  bool open(FileError& error);
  /// A whole file in it.
  bool write_file(const std::string& name, std::string_view bytes, FileError& error);
  bool commit(FileError& error);

 private:
  void drop();

  std::string name_;
  std::string target_;
  std::string temporary_;
  std::vector<std::string> files_;  // their paths
};

}  // namespace shodo
