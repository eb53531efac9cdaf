// The library's only memory: one piece that the caller gives, handed out in named blocks from its start.
//
// A block stays until the arena is released to a mark taken before it, so a stage's scratch lies above what it leaves.
// Nothing is ever freed one by one, nothing is taken from anywhere else. Blocks are aligned to 8 bytes and zeroed.
// The arena keeps its peak, and when it refuses a block it keeps the size at which it would not have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "shodo/status.h"

namespace shodo {

class Arena {
 public:
  /// The memory stays the caller's and must outlive every block.
  Arena(void* memory, std::size_t bytes);

  /// A zeroed block of `count` T; false, and `block` empty, if it doesn't fit.
  template <class T>
  [[nodiscard]] bool take(const char* name, std::size_t count, std::span<T>& block) {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= 8);
    block = {};
    if (count > SIZE_MAX / sizeof(T)) return false;
    void* memory = take_bytes(name, count * sizeof(T));
    if (memory == nullptr) return count == 0;
    block = std::span<T>(static_cast<T*>(memory), count);
    return true;
  }

  using Mark = std::size_t;
  Mark mark() const { return used_; }
  void release(Mark mark);

  std::size_t capacity() const { return capacity_; }
  std::size_t used() const { return used_; }
  std::size_t left() const { return capacity_ - used_; }
  std::size_t peak() const { return peak_; }
  /// kMemory, naming the block that was refused last and the arena size at which it would have fitted.
  Status refused() const;

 private:
  void* take_bytes(const char* name, std::size_t bytes);

  std::byte* memory_;
  std::size_t capacity_;
  std::size_t used_ = 0;
  std::size_t peak_ = 0;
  std::size_t wanted_ = 0;
  const char* wanted_name_ = "";
};

/// Gives an arena back to where it was, at the end of a stage.
class ArenaScratch {
 public:
  explicit ArenaScratch(Arena& arena) : arena_(arena), mark_(arena.mark()) {}
  ~ArenaScratch() { arena_.release(mark_); }
  ArenaScratch(const ArenaScratch&) = delete;
  ArenaScratch& operator=(const ArenaScratch&) = delete;

 private:
  Arena& arena_;
  Arena::Mark mark_;
};

}  // namespace shodo
