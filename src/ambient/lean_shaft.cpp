#include "ambient/lean_shaft.h"

namespace shodo {

namespace {

std::int32_t magnitude(std::int32_t x) { return x < 0 ? -x : x; }

}  // namespace

LeanShaft::LeanShaft(const LatticeBox& a, const LatticeBox& b) : around_(a) {
  around_.include(b);
  LatticeBox from, to;
  for (int k = 0; k < 3; ++k) {
    from.low[k] = a.low[k] >> ShaftLine::kSteps;
    from.high[k] = (a.high[k] + (1 << ShaftLine::kSteps) - 1) >> ShaftLine::kSteps;
    to.low[k] = b.low[k] >> ShaftLine::kSteps;
    to.high[k] = (b.high[k] + (1 << ShaftLine::kSteps) - 1) >> ShaftLine::kSteps;
  }
  add_lines(from, to, 0, 1);
  add_lines(from, to, 1, 2);
  add_lines(from, to, 2, 0);
}

/// As Shaft::add_lines: from a corner to the same of the other box, if it is the farthest of both along the line's
/// normal, which then points from the middle to the corner.
void LeanShaft::add_lines(const LatticeBox& a, const LatticeBox& b, std::uint32_t u, std::uint32_t v) {
  const auto add = [&](bool high_u, bool high_v, std::int32_t au, std::int32_t av, std::int32_t du, std::int32_t dv) {
    if (du == 0 || dv == 0 || ((du ^ dv) >= 0) == (high_u == high_v)) return;  // a side of the common box
    const std::int32_t across = magnitude(dv), up = magnitude(du);
    ShaftLine& line = lines_[lines_used_++];
    line.normal_u = high_u ? across : -across;
    line.normal_v = high_v ? up : -up;
    line.u = static_cast<std::uint32_t>(sizeof(std::int32_t)) * (high_u ? u : u + 3);
    line.v = static_cast<std::uint32_t>(sizeof(std::int32_t)) * (high_v ? v : v + 3);
    // A box's bounds are rounded down, and flat ones may be a lattice step too small.
    line.limit = line.normal_u * au + line.normal_v * av + 2 * (across + up);
  };
  const std::int32_t low_u = b.low[u] - a.low[u], high_u = b.high[u] - a.high[u];
  const std::int32_t low_v = b.low[v] - a.low[v], high_v = b.high[v] - a.high[v];
  add(false, false, a.low[u], a.low[v], low_u, low_v);
  add(true, false, a.high[u], a.low[v], high_u, low_v);
  add(false, true, a.low[u], a.high[v], low_u, high_v);
  add(true, true, a.high[u], a.high[v], high_u, high_v);
}

}  // namespace shodo
