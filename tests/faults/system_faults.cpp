// Preloaded into the program by tests/faults/io_faults_test.cpp: makes a chosen call to the system fail, and tells what
// the program called and what it left behind.
//
//     SHODO_FAULT   "NAME:K:WHAT" or "NAME:K-:WHAT": the K-th call of NAME (from 1), or that and all that follow, does
//                   WHAT: an errno's number; "short" (a write takes one byte); "interrupt" (SIGINT arrives first)
//     SHODO_LOG     a file for one line "NAME COUNT" a call, and the lines "blocks N", "descriptors N", "maps N",
//                   "peak_kib N": heap blocks, descriptors and mapped pieces not given back, and the largest resident
//                   size
//
// Calls that the C library makes inside itself (messages on standard error) are not seen.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum Call { kOpen, kRead, kWrite, kClose, kRename, kMkostemp, kMkdtemp, kChmod, kOpendir, kMmap, kMalloc, kCalls };
const char* const kNames[kCalls] = {"open",  "read",  "write",   "close", "rename", "mkostemp",
                                    "mkdtemp", "chmod", "opendir", "mmap",  "malloc"};

struct State {
  std::atomic<long> count[kCalls];  // a report runs on several cores
  int call;  // kCalls: none
  long first, last;
  int error;  // 0: no failure
  bool is_short, interrupts;
  std::atomic<long> blocks, descriptors, maps;
};
State g;
bool g_ready = false;

template <class F>
F next(const char* name, F) {
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

/// An errno, -1 for a short write, or 0: the call goes on.
int fault(Call call) {
  if (!g_ready) return 0;
  const long k = ++g.count[call];
  if (call != g.call || k < g.first || k > g.last) return 0;
  if (g.interrupts) raise(SIGINT);
  return g.is_short ? -1 : g.error;
}

__attribute__((constructor)) void start() {
  g.call = kCalls;
  if (const char* text = getenv("SHODO_FAULT")) {
    char name[16] = {}, what[16] = {}, range[2] = {};
    if (sscanf(text, "%15[a-z]:%ld:%15s", name, &g.first, what) == 3) {
      g.last = g.first;
    } else if (sscanf(text, "%15[a-z]:%ld%1[-]:%15s", name, &g.first, range, what) == 4) {
      g.last = 1L << 40;
    }
    for (int call = 0; call < kCalls; ++call) {
      if (strcmp(name, kNames[call]) == 0) g.call = call;
    }
    g.is_short = strcmp(what, "short") == 0;
    g.interrupts = strcmp(what, "interrupt") == 0;
    g.error = g.is_short || g.interrupts ? 0 : atoi(what);
  }
  g_ready = true;
}

/// The number in a line of /proc/self/status.
long status_number(const char* key) {
  static char text[8192];
  const int file = next("open", &open)("/proc/self/status", O_RDONLY);
  const ssize_t size = next("read", &read)(file, text, sizeof text - 1);
  next("close", &close)(file);
  if (size <= 0) return -1;
  text[size] = 0;
  const char* at = strstr(text, key);
  return at == nullptr ? -1 : atol(at + strlen(key));
}

__attribute__((destructor)) void finish() {
  g_ready = false;
  const char* path = getenv("SHODO_LOG");
  if (path == nullptr) return;
  const long peak = status_number("VmHWM:");
  char text[1024];
  int size = 0;
  const auto add = [&](const char* name, long value) {
    size += snprintf(text + size, sizeof text - static_cast<size_t>(size), "%s %ld\n", name, value);
  };
  for (int call = 0; call < kCalls; ++call) add(kNames[call], g.count[call].load());
  add("blocks", g.blocks.load());
  add("descriptors", g.descriptors.load());
  add("maps", g.maps.load());
  add("peak_kib", peak);
  const int file = next("open", &open)(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (next("write", &write)(file, text, static_cast<size_t>(size)) != size) abort();
  next("close", &close)(file);
}

int fail(int error) {
  errno = error;
  return -1;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if (const int error = fault(kOpen); error > 0) return fail(error);
  const int file = next("open", &open)(path, flags, mode);
  if (file >= 0) ++g.descriptors;
  return file;
}

ssize_t read(int file, void* to, size_t size) {
  const int error = fault(kRead);
  if (error > 0) return fail(error);
  return next("read", &read)(file, to, error < 0 && size > 1 ? 1 : size);
}

ssize_t write(int file, const void* from, size_t size) {
  const int error = fault(kWrite);
  if (error > 0) return fail(error);
  return next("write", &write)(file, from, error < 0 && size > 1 ? 1 : size);
}

/// As Linux does: the descriptor is gone, whatever close() returns.
int close(int file) {
  const int error = fault(kClose);
  const int result = next("close", &close)(file);
  if (result == 0) --g.descriptors;
  return error > 0 ? fail(error) : result;
}

int rename(const char* from, const char* to) {
  if (const int error = fault(kRename); error > 0) return fail(error);
  return next("rename", &rename)(from, to);
}

int mkostemp(char* pattern, int flags) {
  if (const int error = fault(kMkostemp); error > 0) return fail(error);
  const int file = next("mkostemp", &mkostemp)(pattern, flags);
  if (file >= 0) ++g.descriptors;
  return file;
}

char* mkdtemp(char* pattern) {
  if (const int error = fault(kMkdtemp); error > 0) {
    errno = error;
    return nullptr;
  }
  return next("mkdtemp", &mkdtemp)(pattern);
}

int chmod(const char* path, mode_t mode) {
  if (const int error = fault(kChmod); error > 0) return fail(error);
  return next("chmod", &chmod)(path, mode);
}

int fchmod(int file, mode_t mode) {
  if (const int error = fault(kChmod); error > 0) return fail(error);
  return next("fchmod", &fchmod)(file, mode);
}

DIR* opendir(const char* path) {
  if (const int error = fault(kOpendir); error > 0) {
    errno = error;
    return nullptr;
  }
  return next("opendir", &opendir)(path);
}

void* mmap(void* at, size_t size, int protection, int flags, int file, off_t offset) {
  if (const int error = fault(kMmap); error > 0) {
    errno = error;
    return MAP_FAILED;
  }
  void* const piece = next("mmap", &mmap)(at, size, protection, flags, file, offset);
  if (piece != MAP_FAILED) ++g.maps;
  return piece;
}

int munmap(void* at, size_t size) {
  --g.maps;
  return next("munmap", &munmap)(at, size);
}

void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void __libc_free(void*);

void* malloc(size_t size) {
  if (const int error = fault(kMalloc); error > 0) {
    errno = error;
    return nullptr;
  }
  ++g.blocks;
  return __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
  ++g.blocks;
  return __libc_calloc(count, size);
}

void* realloc(void* block, size_t size) {
  if (const int error = fault(kMalloc); error > 0) {
    errno = error;
    return nullptr;
  }
  if (block == nullptr) ++g.blocks;
  return __libc_realloc(block, size);
}

void free(void* block) {
  if (block != nullptr) --g.blocks;
  __libc_free(block);
}

}  // extern "C"
