// What every call of the library returns: done, or what went wrong and where.
//
// Two channels never mix: a mistake of the user's (a wrong scene, a budget that is too small) is a Status, always on;
// a mistake of ours is a SHODO_CHECK (base/check.h), which stops the program.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shodo {

/// The value is the program's exit status.
enum class StatusCode : std::uint8_t {
  kDone = 0,
  kFile = 1,            // what the run stands on fails: a file could not be read or written, or this machine's
                        // arithmetic is not the one expected (self_check)
  kUsage = 2,           // an option or an argument that the call doesn't take
  kScene = 3,           // the scene is wrong: file, line and column say where
  kMemory = 4,          // the arena is too small: bytes_needed says for what
  kInterrupted = 130,   // the progress callback asked to stop
};

/// Fixed size, so that an error needs no memory to be told.
struct [[nodiscard]] Status {
  Status();  // done; not inline, since it is made in a hundred places

  StatusCode code;
  std::uint32_t line;          // 1-based; 0: no position
  std::uint32_t column;        // 1-based, in bytes
  std::uint64_t bytes_needed;  // kMemory: the arena's smallest size for the call that failed, 0 if not known
  char file[128];              // name as the scene or the caller gave it; the end of it if it is longer
  char message[256];           // "expected ..., found ..."; none if the caller stopped the run

  bool done() const { return code == StatusCode::kDone; }
};

}  // namespace shodo
