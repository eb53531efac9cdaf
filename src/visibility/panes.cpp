#include "visibility/panes.h"

#include "visibility/half_open.h"
#include "visibility/shaft.h"

namespace shodo {

namespace {

/// Whether the line from p along d passes the triangle, and before p + d if it ends there.
bool passes(const Triangle& triangle, const LatticePoint& p, const LatticeVector& d, bool ends) {
  const std::int64_t side = triangle.side(p), through = dot(triangle.n, d);
  if (side >= 0 ? (side == 0 || through >= 0) : through <= 0) return false;
  if (ends && (side > 0 ? side + through >= 0 : side + through <= 0)) return false;
  const LatticeVector a = triangle.a - p, b = triangle.b - p, c = triangle.c - p;
  const int sign = edge_side(d, a, b).sign;
  return sign != 0 && sign == edge_side(d, b, c).sign && sign == edge_side(d, c, a).sign;
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

bool Panes::along(const LatticeBox& a, const LatticeVector& direction) const {
  Shaft shaft = Shaft::along(a, direction);
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
  return product(box_between(p, q), [&](const Triangle& triangle) { return passes(triangle, p, d, true); });
}

double Panes::pass_along(const LatticePoint& p, const LatticeVector& d) const {
  return product(box_between(p, end_of(p, d)), [&](const Triangle& triangle) { return passes(triangle, p, d, false); });
}

}  // namespace shodo
