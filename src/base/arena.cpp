#include "base/arena.h"

#include "base/check.h"
#include "base/text.h"

namespace shodo {

namespace {
constexpr std::size_t kAlignment = 8;
}

Arena::Arena(void* memory, std::size_t bytes) : memory_(static_cast<std::byte*>(memory)), capacity_(bytes) {
  const std::size_t skew = reinterpret_cast<std::uintptr_t>(memory) % kAlignment;
  const std::size_t skip = skew == 0 ? 0 : kAlignment - skew;
  if (skip > capacity_) {
    capacity_ = 0;
    return;
  }
  memory_ += skip;
  capacity_ = (capacity_ - skip) / kAlignment * kAlignment;
}

void* Arena::take_bytes(const char* name, std::size_t bytes) {
  if (bytes == 0) return nullptr;
  const bool huge = bytes > SIZE_MAX - kAlignment - used_;
  const std::size_t rounded = huge ? 0 : (bytes + kAlignment - 1) / kAlignment * kAlignment;
  if (huge || rounded > capacity_ - used_) {
    wanted_ = huge ? SIZE_MAX : used_ + rounded;
    wanted_name_ = name;
    return nullptr;
  }
  std::byte* block = memory_ + used_;
  used_ += rounded;
  if (used_ > peak_) peak_ = used_;
  for (std::size_t k = 0; k < rounded; ++k) block[k] = std::byte{0};
  return block;
}

void Arena::release(Mark mark) {
  SHODO_CHECK(mark <= used_);
  used_ = mark;
}

Status Arena::refused() const {
  Status status;
  status.code = StatusCode::kMemory;
  status.bytes_needed = wanted_;
  TextBuilder text(status.message, sizeof status.message);
  text.add("the memory budget is too small: ").add(wanted_name_).add(" needs ");
  text.add(static_cast<std::uint64_t>(wanted_)).add(" bytes in all, the budget has ");
  text.add(static_cast<std::uint64_t>(capacity_));
  return status;
}

}  // namespace shodo
