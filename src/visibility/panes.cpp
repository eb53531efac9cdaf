#include "visibility/panes.h"

#include "visibility/half_open.h"
#include "visibility/shaft.h"

namespace shodo {

namespace {

/// Whether p and q lie on the same side, or one of them in the plane.
bool misses(const Triangle& triangle, const LatticePoint& p, const LatticePoint& q) {
  const std::int64_t a = triangle.side(p), b = triangle.side(q);
  return a > 0 ? b >= 0 : a == 0 || b <= 0;
}

LatticeBox box_between(const LatticePoint& p, const LatticePoint& q) {
  LatticeBox box;
  box.include(p);
  box.include(q);
  return box;
}

LatticePoint end_of(const LatticePoint& p, const LatticeVector& d) {
  return {static_cast<std::int32_t>(p.x + d.x), static_cast<std::int32_t>(p.y + d.y),
          static_cast<std::int32_t>(p.z + d.z)};
}

}  // namespace

bool Panes::coloured() const {
  for (const Pane& pane : geometry_->panes) {
    if (!pane.transmit.grey()) return true;
  }
  return false;
}

bool Panes::between(const LatticeBox& a, const LatticeBox& b) const {
  Shaft shaft(a, b);
  for (const Pane& pane : geometry_->panes) {
    if (!shaft.misses(pane.box)) return true;
  }
  return false;
}

template <class Passes>
double Panes::product(const LatticeBox& around, Passes passes_one) const {
  double part = 1;
  for (const Pane& pane : geometry_->panes) {
    if (apart(around, pane.box)) continue;
    for (std::uint32_t t = pane.first; t < pane.first + pane.count; ++t) {
      if (passes_one(geometry_->triangles[t])) part *= pane.transmit.c[channel_];
    }
  }
  return part;
}

double Panes::pass(const LatticePoint& p, const LatticePoint& q) const {
  const LatticeVector d = q - p;
  return product(box_between(p, q),
                 [&](const Triangle& triangle) { return !misses(triangle, p, q) && passes(triangle, p, d); });
}

double Panes::pass_along(const LatticePoint& p, const LatticeVector& d) const {
  const LatticeBox around = box_between(p, end_of(p, d));
  return product(around, [&](const Triangle& triangle) { return passes(triangle, p, d); });
}

}  // namespace shodo
