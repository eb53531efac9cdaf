// What the scanline's spans say of a row, sample by sample, as the twin says it.
#pragma once

#include <cstdint>
#include <vector>

#include "picture/visible_lines.h"
#include "support/picture_twin.h"

namespace shodo {

inline std::vector<TwinHit> seen_row(VisibleLines& lines, const SampleGrid& grid, std::uint32_t y) {
  std::vector<TwinHit> seen(grid.columns);
  lines.begin_row(y);
  for (VisibleSpan span; lines.next(span);) {
    for (std::int32_t x = span.x0; x < span.x1; ++x) seen[static_cast<std::uint32_t>(x)] = {span.triangle, span.front};
  }
  return seen;
}

}  // namespace shodo
