#include "ambient/lean_segment.h"

namespace shodo {

namespace {

constexpr int kSteps = 5;  // of the lattice in one, log2

std::int32_t magnitude(std::int32_t x) { return x < 0 ? -x : x; }

}  // namespace

LeanBox lean_box(const LatticeBox& box) {
  LeanBox lean;
  for (int k = 0; k < 3; ++k) {
    // Flat ones may be a lattice step too small (visibility/blockers.h).
    const std::int32_t low = (box.low[k] - 1) >> kSteps, high = (box.high[k] + 1 + (1 << kSteps)) >> kSteps;
    lean.middle[k] = static_cast<std::int16_t>((low + high) >> 1);
    lean.half[k] = static_cast<std::int16_t>((high - low + 1) >> 1);
  }
  return lean;
}

LeanSegment::LeanSegment(const LatticePoint& p, const LatticePoint& q) {
  const std::int32_t way[3] = {(q.x - p.x) >> kSteps, (q.y - p.y) >> kSteps, (q.z - p.z) >> kSteps};
  middle_[0] = (p.x + q.x) >> (kSteps + 1);
  middle_[1] = (p.y + q.y) >> (kSteps + 1);
  middle_[2] = (p.z + q.z) >> (kSteps + 1);
  const std::int32_t x = magnitude(way[0]), y = magnitude(way[1]), z = magnitude(way[2]);
  if (y > x || z > x) {
    along_ = y >= z ? 1 : 2;
    u_ = 0;
    v_ = y >= z ? 2 : 1;
  }
  length_ = (magnitude(way[along_]) >> 1) + 2;
  if (way[along_] == 0) return;
  slope_u_ = way[u_] * (1 << kPlaces) / way[along_];
  slope_v_ = way[v_] * (1 << kPlaces) / way[along_];
  steep_u_ = magnitude(slope_u_);
  steep_v_ = magnitude(slope_v_);
}

}  // namespace shodo
