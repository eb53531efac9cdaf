#include "visibility/shaft.h"

#include <utility>

namespace shodo {

Shaft Shaft::along(const LatticeBox& a, const LatticeVector& direction) {
  const std::int64_t way[3] = {direction.x, direction.y, direction.z};
  LatticeBox b;
  for (int k = 0; k < 3; ++k) {
    b.low[k] = static_cast<std::int32_t>(a.low[k] + way[k]);
    b.high[k] = static_cast<std::int32_t>(a.high[k] + way[k]);
  }
  return Shaft(a, b);
}

/// A line through a corner of A and the same corner of B bounds both boxes if this corner is the farthest point of each
/// along the line's normal: the normal's signs must be those of the corner. The normal is square to the way (du, dv)
/// from the one to the other.
void Shaft::add_lines(std::uint32_t u, std::uint32_t v) {
  const auto low = [](std::int32_t x) { return x >> ShaftLine::kSteps; };
  const auto high = [](std::int32_t x) { return (x + (1 << ShaftLine::kSteps) - 1) >> ShaftLine::kSteps; };
  const std::int32_t a_u[2] = {low(a_.low[u]), high(a_.high[u])}, a_v[2] = {low(a_.low[v]), high(a_.high[v])};
  const std::int32_t way_u[2] = {low(b_.low[u]) - a_u[0], high(b_.high[u]) - a_u[1]};
  const std::int32_t way_v[2] = {low(b_.low[v]) - a_v[0], high(b_.high[v]) - a_v[1]};
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const std::uint32_t high_u = corner & 1, high_v = corner >> 1;
    const std::int32_t du = way_u[high_u], dv = way_v[high_v];
    if (du == 0 || dv == 0) continue;  // a side of the common box
    const bool rising = (du > 0) == (dv > 0);
    if (rising == (high_u == high_v)) continue;
    const std::int32_t size_u = dv < 0 ? -dv : dv, size_v = du < 0 ? -du : du;
    ShaftLine& line = lines_[lines_used_++];
    line.u = 4 * (high_u != 0 ? u : 3 + u);
    line.v = 4 * (high_v != 0 ? v : 3 + v);
    line.normal_u = high_u != 0 ? size_u : -size_u;
    line.normal_v = high_v != 0 ? size_v : -size_v;
    // The box's own corner is rounded down, and a flat facet's box may be one step too small: see facet_box().
    line.limit = line.normal_u * a_u[high_u] + line.normal_v * a_v[high_v] + size_u + size_v;
  }
}

void Shaft::find_lines() {
  lines_used_ = 0;
  add_lines(0, 1);
  add_lines(1, 2);
  add_lines(2, 0);
}

bool Shaft::beyond_a_line(const LatticeBox& box) {
  if (lines_used_ == kNotYet) find_lines();
  for (std::uint32_t k = 0; k < lines_used_; ++k) {
    if (!lines_[k].rules_out(box)) continue;
    if (k > 0) std::swap(lines_[k], lines_[0]);
    return true;
  }
  return false;
}

}  // namespace shodo
