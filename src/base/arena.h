// The library's only memory: one piece that the caller gives, handed out in named blocks from its start.
//
// A block stays until the arena is released to a mark taken before it, so a stage's scratch lies above what it leaves.
// Nothing is ever freed one by one, nothing is taken from anywhere else. Blocks are aligned to 8 bytes and zeroed.
// The arena keeps its peak, and when it refuses a block it keeps the size at which it would not have.
//
// From its end the arena hands out *spare* blocks: what a later stage needs and could be found again. One that is in
// the way of a block is given up, the one taken last first; who took it asks holds() before he looks at it. So less
// memory costs time. Pinned ones stay.
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
  /// Moves everything from `from` on down to `to`; what lay between is gone. Returns by how many bytes.
  std::size_t lower(Mark from, Mark to);

  /// As take(), from the end; no other spare block is given up for it.
  template <class T>
  [[nodiscard]] bool take_spare(const char* name, std::size_t count, std::span<T>& block) {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= 8);
    block = {};
    if (count > SIZE_MAX / sizeof(T)) return false;
    void* memory = take_spare_bytes(name, count * sizeof(T));
    if (memory == nullptr) return count == 0;
    block = std::span<T>(static_cast<T*>(memory), count);
    return true;
  }
  /// Whether a spare block is still there; one of no bytes always is.
  template <class T>
  bool holds(std::span<T> block) const {
    return block.empty() || reinterpret_cast<const std::byte*>(block.data()) >= memory_ + spare_begin();
  }
  std::uint32_t spares() const { return spares_; }
  /// Gives up all but the first so many.
  void release_spares(std::uint32_t keep);
  /// The first so many stay, whatever is wanted.
  void pin_spares(std::uint32_t count) { pinned_ = count < spares_ ? count : spares_; }

  std::size_t capacity() const { return capacity_; }
  std::size_t used() const { return used_; }
  /// What a block can have.
  std::size_t left() const { return pinned_begin() - used_; }
  /// The most bytes in use at any time, spare ones included; since start_stage().
  std::size_t peak() const { return peak_; }
  std::size_t stage_peak() const { return stage_peak_; }
  void start_stage() { stage_peak_ = in_use(); }
  std::size_t in_use() const { return used_ + capacity_ - spare_begin(); }
  /// kMemory, naming the block that was refused last and the arena size at which it would have fitted.
  Status refused() const;

 private:
  static constexpr std::uint32_t kMostSpares = 4;

  void* take_bytes(const char* name, std::size_t bytes);
  void* take_spare_bytes(const char* name, std::size_t bytes);
  /// Rounded up, if it fits in `room`; 0 and the refusal noted, if not.
  std::size_t fitting(const char* name, std::size_t bytes, std::size_t room);
  void* handed_out(std::byte* block, std::size_t bytes);
  std::size_t spare_begin() const { return spares_ == 0 ? capacity_ : spare_at_[spares_ - 1]; }
  std::size_t pinned_begin() const { return pinned_ == 0 ? capacity_ : spare_at_[pinned_ - 1]; }

  std::byte* memory_;
  std::size_t capacity_;
  std::size_t used_ = 0;
  std::size_t peak_ = 0;
  std::size_t stage_peak_ = 0;
  std::size_t spare_at_[kMostSpares] = {};  // where they start, descending
  std::uint32_t spares_ = 0;
  std::uint32_t pinned_ = 0;  // of spares_, the first
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
