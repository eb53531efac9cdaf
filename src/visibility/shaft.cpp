#include "visibility/shaft.h"

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
void Shaft::add_lines(std::uint8_t u, std::uint8_t v) {
  const LatticeBox &a = a_, &b = b_;
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const bool high_u = (corner & 1) != 0, high_v = (corner & 2) != 0;
    const std::int32_t au = high_u ? a.high[u] : a.low[u], av = high_v ? a.high[v] : a.low[v];
    const std::int32_t du = (high_u ? b.high[u] : b.low[u]) - au, dv = (high_v ? b.high[v] : b.low[v]) - av;
    if (du == 0 || dv == 0) continue;  // a side of the common box
    const bool rising = (du > 0) == (dv > 0);
    if (rising == (high_u == high_v)) continue;
    Line& line = lines_[lines_used_];
    line.normal_u = (dv > 0) == high_u ? dv : -dv;
    line.normal_v = (du > 0) == high_v ? du : -du;
    line.u = u;
    line.v = v;
    // A flat facet's box may be one step too small: see facet_box().
    const std::int64_t slack = (dv < 0 ? -dv : dv) + (du < 0 ? -du : du);
    line.limit = std::int64_t{line.normal_u} * au + std::int64_t{line.normal_v} * av + slack;
    ++lines_used_;
  }
}

bool Shaft::beyond_a_line(const LatticeBox& box) {
  if (lines_used_ == kNotYet) {
    lines_used_ = 0;
    add_lines(0, 1);
    add_lines(1, 2);
    add_lines(2, 0);
  }
  for (std::uint32_t k = 0; k < lines_used_; ++k) {
    const Line& line = lines_[k];
    const std::int32_t u = line.normal_u > 0 ? box.low[line.u] : box.high[line.u];
    const std::int32_t v = line.normal_v > 0 ? box.low[line.v] : box.high[line.v];
    if (std::int64_t{line.normal_u} * u + std::int64_t{line.normal_v} * v > line.limit) return true;
  }
  return false;
}

}  // namespace shodo
