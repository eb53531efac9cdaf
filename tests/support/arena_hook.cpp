#include "support/arena_hook.h"

#include "base/arena.h"

namespace shodo {

namespace {
ArenaHook* g_hook = nullptr;  // the linker's hook has no parameter of its own
}

ArenaHook::ArenaHook() { g_hook = this; }
ArenaHook::~ArenaHook() { g_hook = nullptr; }

void ArenaHook::refuse(std::uint64_t k, bool on) {
  first_ = taken_ + refused_ + k;
  last_ = on ? UINT64_MAX : first_;
}

bool ArenaHook::refuses_next() {
  const std::uint64_t number = taken_ + refused_ + 1;
  const bool refuses = first_ != 0 && number >= first_ && number <= last_;
  ++(refuses ? refused_ : taken_);
  return refuses;
}

}  // namespace shodo

// Arena::take_bytes and Arena::take_spare_bytes (const char*, std::size_t), std::size_t being unsigned long.
extern "C" void* __real__ZN5shodo5Arena10take_bytesEPKcm(shodo::Arena* arena, const char* name, std::size_t bytes);
extern "C" void* __real__ZN5shodo5Arena16take_spare_bytesEPKcm(shodo::Arena* arena, const char* name,
                                                               std::size_t bytes);

namespace {

using Take = void* (*)(shodo::Arena* arena, const char* name, std::size_t bytes);

void* hooked(Take take, shodo::Arena* arena, const char* name, std::size_t bytes) {
  shodo::ArenaHook* const hook = shodo::g_hook;
  if (hook == nullptr || bytes == 0) return take(arena, name, bytes);
  // A block larger than any arena is refused as a small one is in an arena that is full.
  if (hook->refuses_next()) return take(arena, name, SIZE_MAX);
  void* const block = take(arena, name, bytes);
  if (hook->watch != nullptr && block != nullptr) hook->watch(hook->context, name, bytes);
  return block;
}

}  // namespace

extern "C" void* __wrap__ZN5shodo5Arena10take_bytesEPKcm(shodo::Arena* arena, const char* name, std::size_t bytes) {
  return hooked(__real__ZN5shodo5Arena10take_bytesEPKcm, arena, name, bytes);
}

extern "C" void* __wrap__ZN5shodo5Arena16take_spare_bytesEPKcm(shodo::Arena* arena, const char* name,
                                                               std::size_t bytes) {
  return hooked(__real__ZN5shodo5Arena16take_spare_bytesEPKcm, arena, name, bytes);
}
