// What each stage needs of the arena, known before anything is lit (design: promise 2).
#pragma once

#include <cstdint>

namespace shodo {

struct Model;

/// The most bytes of the arena in use at any time in each stage, what earlier stages left included.
struct MemoryPlan {
  std::uint64_t load = 0;
  std::uint64_t direct = 0;
  std::uint64_t ambient = 0;  // with as few rows held as possible
  std::uint64_t map = 0;
  std::uint64_t picture = 0;  // 0 if no picture is asked for

  std::uint64_t peak() const;
};

/// Of a loaded model; `picture`: whether the picture is drawn too.
MemoryPlan plan_memory(const Model& model, bool picture);

}  // namespace shodo
