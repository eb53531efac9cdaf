// An implicit tree of boxes over items that are cut at their median: what rays and segments look for items in
// (visibility/blockers.h, picture/ray_tree.h).
//
// Node 0 holds all items; children of node k are 2 k + 1 and 2 k + 2, and the items of a level are shared out evenly,
// so that a node's range follows from its number. How a range is sorted before it is cut is the caller's.
// Bytes: 24 a node, 1 to 2 nodes for each two items.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "visibility/lattice_box.h"

namespace shodo {

inline constexpr std::uint32_t kLeafItems = 4;

/// Nodes over so many items.
constexpr std::uint32_t median_nodes(std::uint64_t items, std::uint32_t leaf_items = kLeafItems) {
  if (items == 0) return 0;
  std::uint64_t leaves = 1;
  while (items > leaf_items * leaves) leaves *= 2;
  return static_cast<std::uint32_t>(2 * leaves - 1);
}

struct ItemRange {
  std::uint32_t first, end;
};

inline ItemRange median_range(std::uint32_t node, std::uint64_t items) {
  const std::uint32_t level = static_cast<std::uint32_t>(std::bit_width(node + 1)) - 1;
  const std::uint64_t place = node + 1 - (std::uint32_t{1} << level);
  return {static_cast<std::uint32_t>(items * place >> level), static_cast<std::uint32_t>(items * (place + 1) >> level)};
}

/// sort(range, cut) orders the items of a node, `cut` the first of the second half; box(k): of the k-th item then.
template <class Sort, class BoxOf>
void fill_median_boxes(std::span<LatticeBox> nodes, std::uint64_t items, Sort sort, BoxOf box_of) {
  const std::uint32_t count = static_cast<std::uint32_t>(nodes.size());
  for (std::uint32_t node = 0; 2 * node + 1 < count; ++node) {
    sort(median_range(node, items), median_range(2 * node + 2, items).first);
  }
  for (std::uint32_t node = count; node-- > 0;) {
    LatticeBox box;
    if (2 * node + 1 < count) {
      box.include(nodes[2 * node + 1]);
      box.include(nodes[2 * node + 2]);
    } else {
      const ItemRange range = median_range(node, items);
      for (std::uint32_t k = range.first; k < range.end; ++k) box.include(box_of(k));
    }
    nodes[node] = box;
  }
}

/// Goes down a tree of `nodes` nodes over `items` items where enters(node) says so; visit(item) is called for those in
/// its leaves, ascending in each, until it returns false; whether it never did.
template <class Enters, class Visit>
[[gnu::always_inline]] inline bool walk_medians(std::size_t nodes, std::size_t items, Enters enters, Visit visit) {
  std::uint32_t stack[33];  // one waiting node a level, and the last
  std::uint32_t depth = 0;
  if (nodes > 0) stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t node = stack[--depth];
    if (!enters(node)) continue;
    if (2 * node + 1 < nodes) {
      stack[depth++] = 2 * node + 2;
      stack[depth++] = 2 * node + 1;
      continue;
    }
    const ItemRange range = median_range(node, items);
    for (std::uint32_t k = range.first; k < range.end; ++k) {
      if (!visit(k)) return false;
    }
  }
  return true;
}

}  // namespace shodo
