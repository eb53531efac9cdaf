// Runs the built program in a folder of its own and tells what it did.
#pragma once

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace shodo {

inline std::string program_path() {
  const char* given = std::getenv("SHODO_PROGRAM");
  char* path = realpath(given != nullptr ? given : "build/shodo", nullptr);
  const std::string result = path == nullptr ? "" : path;
  std::free(path);
  return result;
}

/// A scene of tests/cli/scenes or data, by its whole path.
inline std::string source_path(const std::string& name) {
  char* path = realpath(name.c_str(), nullptr);
  const std::string result = path == nullptr ? name : path;
  std::free(path);
  return result;
}

inline std::string test_scene(const std::string& name) { return source_path("tests/cli/scenes/" + name); }

inline std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// A folder that goes away with everything in it.
class TestFolder {
 public:
  TestFolder() {
    char pattern[] = "/tmp/shodo-test-XXXXXX";
    path_ = mkdtemp(pattern);
  }
  ~TestFolder() { static_cast<void>(std::system(("chmod -R u+w " + path_ + "; rm -rf " + path_).c_str())); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(*this / name, std::ios::binary) << text;
  }

  /// Everything in it or in a folder below, hidden names too, sorted.
  std::vector<std::string> entries(const std::string& below = "") const {
    std::vector<std::string> names;
    DIR* folder = opendir((path_ + "/" + below).c_str());
    while (const dirent* entry = folder == nullptr ? nullptr : readdir(folder)) {
      const std::string name = entry->d_name;
      if (name != "." && name != "..") names.push_back(name);
    }
    if (folder != nullptr) closedir(folder);
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::string path_;
};

struct Outcome {
  int status = -1;  // exit status; 1000 + n if signal n ended it
  std::string out, err;
};

/// A run of the program that can be watched while it runs.
class Running {
 public:
  using Words = std::vector<std::string>;

  /// `out`, `err`: files that take standard output and error; "" a file that is read afterwards, "-" closed, "&7"
  /// descriptor 7.
  explicit Running(const Words& words, const std::string& folder = "", const std::string& out = "",
                   const std::string& err = "")
      : out_(out.empty() ? scratch_ / "out" : out), err_(err.empty() ? scratch_ / "err" : err) {
    const std::string program = program_path();
    process_ = fork();
    if (process_ != 0) return;
    signal(SIGINT, SIG_DFL);  // a shell starts background jobs with it ignored, which stays
    if (!folder.empty() && chdir(folder.c_str()) != 0) _exit(126);
    redirect(STDOUT_FILENO, out_);
    redirect(STDERR_FILENO, err_);
    std::vector<char*> arguments{const_cast<char*>("shodo")};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execv(program.c_str(), arguments.data());
    _exit(127);
  }

  pid_t process() const { return process_; }

  Outcome wait() {
    Outcome outcome;
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    if (out_ == scratch_ / "out") outcome.out = file_text(out_);
    if (err_ == scratch_ / "err") outcome.err = file_text(err_);
    return outcome;
  }

 private:
  static void redirect(int descriptor, const std::string& path) {
    if (path == "-") {
      close(descriptor);
      return;
    }
    const int file =
        path[0] == '&' ? std::atoi(path.c_str() + 1) : open(path.c_str(), O_WRONLY | O_CREAT | O_NOCTTY, 0666);
    if (file < 0) _exit(125);
    dup2(file, descriptor);
    if (file != descriptor) close(file);
  }

  TestFolder scratch_;
  std::string out_, err_;
  pid_t process_ = -1;
};

inline Outcome run(const Running::Words& words, const std::string& folder = "") {
  return Running(words, folder).wait();
}

}  // namespace shodo
