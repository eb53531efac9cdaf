// Stands between Arena::take() and the arena, so that tests see every block that the library takes and can refuse any
// of them. The linker puts it there (--wrap in the Makefile): the library itself is the one that ships.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shodo {

/// One at a time; what it says holds from its construction to its end. Blocks of no bytes are not counted.
class ArenaHook {
 public:
  ArenaHook();
  ~ArenaHook();
  ArenaHook(const ArenaHook&) = delete;
  ArenaHook& operator=(const ArenaHook&) = delete;

  /// Refuse the k-th block from now (from 1), and with `on` all that follow.
  void refuse(std::uint64_t k, bool on);
  std::uint64_t taken() const { return taken_; }
  std::uint64_t refused() const { return refused_; }

  /// Told of every block that was taken.
  void (*watch)(void* context, const char* name, std::size_t bytes) = nullptr;
  void* context = nullptr;

  /// For the hook itself: whether the next block is to be refused.
  bool refuses_next();

 private:
  std::uint64_t taken_ = 0, refused_ = 0;
  std::uint64_t first_ = 0, last_ = 0;  // of taken_ + refused_, refused if within; 0: none
};

}  // namespace shodo
