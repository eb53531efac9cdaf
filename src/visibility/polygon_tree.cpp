#include "visibility/polygon_tree.h"

#include <bit>

#include "base/sort.h"

namespace shodo {

namespace {

constexpr std::uint32_t kLeafPolygons = 8;

}  // namespace

bool LatticeBox::contains(const LatticePoint& p, std::int32_t margin) const {
  const std::int32_t at[3] = {p.x, p.y, p.z};
  for (int k = 0; k < 3; ++k) {
    if (std::int64_t{at[k]} + margin < low[k] || std::int64_t{at[k]} - margin > high[k]) return false;
  }
  return true;
}

bool LatticeBox::met_by(const LatticePoint& from, const LatticePoint& to, std::int32_t margin) const {
  constexpr double kSlack = 1e-9;
  const std::int32_t a[3] = {from.x, from.y, from.z}, b[3] = {to.x, to.y, to.z};
  double enter = 0, leave = 1;
  for (int k = 0; k < 3; ++k) {
    const double below = static_cast<double>(low[k]) - margin - a[k];
    const double above = static_cast<double>(high[k]) + margin - a[k];
    const double along = static_cast<double>(b[k]) - a[k];
    if (along == 0) {
      if (below > 0 || above < 0) return false;
      continue;
    }
    const double first = (along > 0 ? below : above) / along, last = (along > 0 ? above : below) / along;
    if (first > enter) enter = first;
    if (last < leave) leave = last;
  }
  return enter <= leave + kSlack;
}

LatticeBox polygon_box(const Placement& placement, std::uint32_t polygon) {
  LatticeBox box;
  const SiteRing& ring = placement.rings[polygon];
  for (std::uint32_t k = 0; k < ring.corners; ++k) box.include(placement.sites[ring.site[k]]);
  if (placement.first_insertion.empty()) return box;
  for (std::uint32_t k = placement.first_insertion[polygon]; k < placement.first_insertion[polygon + 1]; ++k) {
    box.include(placement.sites[placement.insertions[k].site]);
  }
  return box;
}

PolygonTree::Range PolygonTree::range_of(std::uint32_t node) const {
  const std::uint32_t level = static_cast<std::uint32_t>(std::bit_width(node + 1)) - 1;
  const std::uint64_t place = node + 1 - (std::uint32_t{1} << level);
  const std::uint64_t count = order_.size();
  return {static_cast<std::uint32_t>(count * place >> level), static_cast<std::uint32_t>(count * (place + 1) >> level)};
}

void PolygonTree::split(const Placement& placement, const Range& range) {
  LatticeBox box;
  for (std::uint32_t k = range.first; k < range.end; ++k) box.include(polygon_box(placement, order_[k]));
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::int64_t{box.high[k]} - box.low[k] > std::int64_t{box.high[axis]} - box.low[axis]) axis = k;
  }
  const auto middle = [&](std::uint32_t polygon) {
    const LatticeBox b = polygon_box(placement, polygon);
    return std::int64_t{b.low[axis]} + b.high[axis];
  };
  heap_sort(order_.subspan(range.first, range.end - range.first), [&](std::uint32_t a, std::uint32_t b) {
    const std::int64_t at_a = middle(a), at_b = middle(b);
    return at_a == at_b ? a < b : at_a < at_b;
  });
}

bool PolygonTree::build(const Placement& placement, Arena& arena) {
  const std::size_t count = placement.rings.size();
  std::size_t leaves = 1;
  while (leaves * kLeafPolygons < count) leaves *= 2;
  if (!arena.take("order of polygons", count, order_)) return false;
  if (!arena.take("boxes of polygons", 2 * leaves - 1, boxes_)) return false;
  for (std::uint32_t k = 0; k < count; ++k) order_[k] = k;
  for (std::uint32_t node = 0; 2 * node + 1 < boxes_.size(); ++node) split(placement, range_of(node));
  fit(placement);
  return true;
}

void PolygonTree::fit(const Placement& placement) {
  for (std::size_t node = boxes_.size(); node-- > 0;) {
    boxes_[node] = {};
    if (2 * node + 1 < boxes_.size()) {
      boxes_[node].include(boxes_[2 * node + 1]);
      boxes_[node].include(boxes_[2 * node + 2]);
      continue;
    }
    const Range range = range_of(static_cast<std::uint32_t>(node));
    for (std::uint32_t k = range.first; k < range.end; ++k) boxes_[node].include(polygon_box(placement, order_[k]));
  }
}

}  // namespace shodo
