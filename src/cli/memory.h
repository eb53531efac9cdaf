// The one piece of memory that the library lives in.
#pragma once

#include <cstddef>

namespace shodo {

/// Zero pages from the system, which come into being when they are touched.
class Memory {
 public:
  explicit Memory(std::size_t bytes);
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  /// nullptr if the system refuses so much.
  void* start() const { return start_; }
  std::size_t size() const { return size_; }

 private:
  void* start_;
  std::size_t size_;
};

}  // namespace shodo
