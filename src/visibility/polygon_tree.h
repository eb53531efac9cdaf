// Finding the polygons near a point or along a segment: a balanced tree of boxes over the polygons of a placement.
//
// Node k has the children 2 k + 1 and 2 k + 2; the nodes of a level share the polygons evenly, in an order found by
// sorting along the longest axis at each node. The shape depends on the number of polygons only, so that boxes can be
// fitted anew when vertices have moved. Bytes: 4 a polygon and 24 a node, about 10 a polygon. n log^2 n time.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "visibility/lattice_box.h"
#include "visibility/placement.h"

namespace shodo {

/// Around corners and inserted vertices.
LatticeBox polygon_box(const Placement& placement, std::uint32_t polygon);

class PolygonTree {
 public:
  /// False: the arena is too small.
  bool build(const Placement& placement, Arena& arena);
  /// After vertices moved or were inserted.
  void fit(const Placement& placement);

  /// Visits the polygons, by number, in all leaves whose boxes are `near`: near(box) -> bool, visit(polygon).
  template <class Near, class Visit>
  void visit(Near near, Visit visit) const {
    if (order_.empty()) return;
    std::uint32_t stack[32];  // one waiting node a level
    std::uint32_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t node = stack[--depth];
      if (!near(boxes_[node])) continue;
      if (2 * node + 1 < boxes_.size()) {
        stack[depth++] = 2 * node + 2;
        stack[depth++] = 2 * node + 1;
        continue;
      }
      const Range range = range_of(node);
      for (std::uint32_t k = range.first; k < range.end; ++k) visit(order_[k]);
    }
  }

 private:
  struct Range {
    std::uint32_t first, end;
  };
  Range range_of(std::uint32_t node) const;
  void split(const Placement& placement, const Range& range);

  std::span<std::uint32_t> order_;
  std::span<LatticeBox> boxes_;
};

}  // namespace shodo
