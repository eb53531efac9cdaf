#include "cli/memory.h"

#include <sys/mman.h>

namespace shodo {

Memory::Memory(std::size_t bytes) : size_(bytes) {
  start_ = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (start_ == MAP_FAILED) start_ = nullptr;
}

Memory::~Memory() {
  if (start_ != nullptr) munmap(start_, size_);
}

}  // namespace shodo
