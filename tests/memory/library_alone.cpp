// The library with nothing but the C library beside it: no C++ library is linked, so `new` and exceptions can't even be
// named, and every malloc and every system call that a run makes is counted. Prints a line for each scene.
//
//     library_alone SCENE...
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "shodo/shodo.h"

namespace {

long g_mallocs = 0;

constexpr std::size_t kBytes = 4 << 20;
alignas(16) unsigned char g_memory[kBytes];
char g_text[1 << 16];

/// What the scenes name.
struct Named {
  const char* path;
  char buffer[1 << 16];
  std::string_view text;
} g_named[] = {{"tiles.ppm", {}, {}}, {"model.obj", {}, {}}, {"model.mtl", {}, {}},
             {"spread.ies", {}, {}}};

template <std::size_t kSize>
std::string_view read_text(const char* path, char (&buffer)[kSize]) {
  std::FILE* file = std::fopen(path, "rb");
  if (file == nullptr) std::exit(2);
  const std::size_t size = std::fread(buffer, 1, kSize, file);
  std::fclose(file);
  return {buffer, size};
}

bool give(void*, std::string_view path, std::string_view& text) {
  for (const Named& named : g_named) {
    if (path == named.path) text = named.text;
  }
  return !text.empty();
}

/// Load, solve, draw. 0, or a line of this file.
int run(std::string_view text) {
  using namespace shodo;
  Options options;
  options.width = 40;
  options.height = 30;
  options.rules.blocks = true;
  Model* model = nullptr;
  if (!load("scene", text, {give, nullptr}, options, g_memory, kBytes, model).done()) return __LINE__;
  if (!solve(*model, {}).done()) return __LINE__;
  long lines = 0;
  const LineSink sink{[](void* count, std::uint32_t, std::span<const std::uint8_t>) {
                        ++*static_cast<long*>(count);
                        return true;
                      },
                      &lines};
  if (!draw(*model, {}, sink).done() || lines != 30) return __LINE__;
  return 0;
}

/// Stops twice; what it calls in between is counted by who traces it. Every byte of memory was touched before.
[[noreturn]] void be_traced(std::string_view text, int calls) {
  std::memset(g_memory, 1, kBytes);
  const bool traced = ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0;
  if (traced) raise(SIGSTOP);
  const long before = g_mallocs;
  int wrong = calls < 0 ? run(text) : 0;
  for (int k = 0; k < calls; ++k) getppid();
  if (g_mallocs != before) wrong = 255;
  if (traced) raise(SIGSTOP);
  _exit(wrong == 0 ? 0 : 1);
}

struct Counted {
  long calls = -1;  // -1: this system doesn't let a process be traced
  int status = -1;
};

/// `calls`: so many system calls, to see that they are counted; below 0: the library.
Counted count_calls(std::string_view text, int calls) {
  Counted counted;
  const pid_t child = fork();
  if (child == 0) be_traced(text, calls);
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFSTOPPED(status)) {
    counted.status = WIFEXITED(status) ? WEXITSTATUS(status) : 255;
    return counted;
  }
  int stops = 0;
  for (;;) {
    if (ptrace(PTRACE_SYSCALL, child, nullptr, nullptr) != 0) return counted;
    waitpid(child, &status, 0);
    if (!WIFSTOPPED(status) || WSTOPSIG(status) == SIGSTOP) break;
    ++stops;
  }
  // The end of the first raise(), and the calls that the second makes before its signal comes: found with no call.
  counted.calls = stops;
  ptrace(PTRACE_CONT, child, nullptr, nullptr);
  waitpid(child, &status, 0);
  counted.status = WIFEXITED(status) ? WEXITSTATUS(status) : 255;
  return counted;
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* malloc(std::size_t size) { return ++g_mallocs, __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return ++g_mallocs, __libc_calloc(count, size); }
void* realloc(void* block, std::size_t size) { return ++g_mallocs, __libc_realloc(block, size); }
}

int main(int count, char** words) {
  const Counted none = count_calls({}, 0), three = count_calls({}, 3);
  const bool traces = none.calls >= 0;
  if (traces && three.calls != none.calls + 2 * 3) {
    std::printf("failed: three system calls are counted as three, found %ld stops after %ld\n", three.calls,
                none.calls);
    return 1;
  }
  int failures = 0;
  for (Named& named : g_named) {
    char path[40];
    std::snprintf(path, sizeof path, "tests/cli/scenes/%s", named.path);
    named.text = read_text(path, named.buffer);
  }
  for (int k = 1; k < count; ++k) {
    const Counted counted = count_calls(read_text(words[k], g_text), -1);
    const bool right = counted.status == 0 && counted.calls == none.calls;
    std::printf("%s: load, solve and draw of %s make no malloc%s (exit status %d)\n", right ? "passed" : "failed",
                words[k], traces ? " and no system call" : "; system calls can't be counted here", counted.status);
    failures += right ? 0 : 1;
  }
  return failures == 0 ? 0 : 1;
}
