// What each stage needs of the arena, known before anything is lit (design: promise 2; doc/memory.md).
#pragma once

#include <cstdint>

namespace shodo {

struct Model;

/// The most bytes of the arena in use at any time in each stage, what earlier stages left included and spare blocks
/// not: with exactly so many, everything that can be found again is.
struct MemoryPlan {
  std::uint64_t load = 0;
  std::uint64_t direct = 0;        // the first time; what stays of it are patches
  std::uint64_t ambient = 0;       // with no row held
  std::uint64_t direct_again = 0;  // for the sub-patches
  std::uint64_t map = 0;
  std::uint64_t picture = 0;       // 0 if no picture is asked for

  std::uint64_t peak() const;
};

/// Of a loaded model; `picture`: whether the picture is drawn too.
MemoryPlan plan_memory(const Model& model, bool picture);

/// Arena bytes of drawing without the drawn triangles at hand.
std::uint64_t drawn_and_picture_bytes(const Model& model);

}  // namespace shodo
