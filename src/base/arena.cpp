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

std::size_t Arena::fitting(const char* name, std::size_t bytes, std::size_t room) {
  const std::size_t others = capacity_ - room;
  const bool huge = bytes > SIZE_MAX - kAlignment - others;
  const std::size_t rounded = huge ? 0 : (bytes + kAlignment - 1) / kAlignment * kAlignment;
  if (!huge && rounded <= room) return rounded;
  wanted_ = huge ? SIZE_MAX : others + rounded;
  wanted_name_ = name;
  return 0;
}

void* Arena::handed_out(std::byte* block, std::size_t bytes) {
  if (in_use() > peak_) peak_ = in_use();
  if (in_use() > stage_peak_) stage_peak_ = in_use();
  for (std::size_t k = 0; k < bytes; ++k) block[k] = std::byte{0};
  return block;
}

void* Arena::take_bytes(const char* name, std::size_t bytes) {
  if (bytes == 0) return nullptr;
  const std::size_t rounded = fitting(name, bytes, left());
  if (rounded == 0) return nullptr;
  while (used_ + rounded > spare_begin()) --spares_;
  used_ += rounded;
  return handed_out(memory_ + used_ - rounded, rounded);
}

void* Arena::take_spare_bytes(const char* name, std::size_t bytes) {
  if (bytes == 0) return nullptr;
  SHODO_CHECK(spares_ < kMostSpares);
  const std::size_t rounded = fitting(name, bytes, spare_begin() - used_);
  if (rounded == 0) return nullptr;
  spare_at_[spares_] = spare_begin() - rounded;
  ++spares_;
  return handed_out(memory_ + spare_begin(), rounded);
}

void Arena::release_spares(std::uint32_t keep) {
  if (spares_ > keep) spares_ = keep;
  pin_spares(pinned_);
}

void Arena::release(Mark mark) {
  SHODO_CHECK(mark <= used_);
  used_ = mark;
}

std::size_t Arena::lower(Mark from, Mark to) {
  SHODO_CHECK(to <= from && from <= used_);
  for (std::size_t k = from; k < used_; ++k) memory_[k - from + to] = memory_[k];
  used_ -= from - to;
  return from - to;
}

Status Arena::refused() const {
  Status status;
  status.code = StatusCode::kMemory;
  status.bytes_needed = wanted_;
  MessageText text(status.message, sizeof status.message);
  text.add("the memory budget is too small: ").add(wanted_name_).add(" needs ");
  text.add(static_cast<std::uint64_t>(wanted_)).add(" bytes in all, the budget has ");
  text.add(static_cast<std::uint64_t>(capacity_));
  return status;
}

}  // namespace shodo
