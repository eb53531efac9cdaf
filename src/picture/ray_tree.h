// The drawn triangles in a tree of boxes, for rays (paper 2.4; only for scenes with mirrors, glass or highlights).
//
// Median cuts along the axis that leaves both halves' boxes the least surface (MacDonald and Booth 1990); children of node k are 2 k + 1 and 2 k + 2, leaves hold up to five
// triangles. A ray's nearest hit is sought near boxes first; a box that begins beyond the nearest hit so far is left
// out. Boxes are tested with 2^32 / |d| rounded down, and as much to spare as that can be off, so none that is met is
// left out.
// Exact: the answers. Bytes: 4 a drawn triangle, 24 a node (about one for each two triangles).
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/ray.h"
#include "scene/scene.h"
#include "visibility/lattice_box.h"

namespace shodo {

class RayTree {
 public:
  [[nodiscard]] bool build(const Scene& scene, std::span<const DrawnTriangle> drawn, Arena& arena);
  static std::uint64_t bytes(std::uint64_t drawn);

  /// The first hit of the ray, or the first after another one of its hits. `hint`: a triangle that may well be it, or
  /// kNone; it changes no answer.
  RayHit nearest(const Ray& ray, std::uint32_t hint) const { return nearest_after(ray, {}, hint); }
  RayHit nearest_after(const Ray& ray, const RayHit& last, std::uint32_t hint) const;

  /// visit(hit) for what stands between p and q, or in the way of the ray without `ends`, in an order that the tree
  /// fixes, until it returns false.
  template <class Visit>
  void visit_blockers(const Ray& ray, bool ends, Visit visit) const;

  /// visit(triangle) for all that `hull` doesn't miss, boxes first, until it returns false; whether it never did.
  template <class Hull, class Visit>
  bool visit_in(Hull& hull, Visit visit) const;

  /// Whether light goes by as if nothing were there: openings from behind, and from both sides if what stands outside
  /// is to be seen.
  bool invisible(const DrawnTriangle& triangle, bool front) const;

 private:
  struct Range {
    std::uint32_t first, end;
  };
  struct Slabs {  // 2^32 / |d| an axis
    std::uint32_t inverse[3];
    std::int32_t origin[3];
    bool up[3], still[3];
  };
  static Slabs slabs_of(const Ray& ray);
  static bool meets(const LatticeBox& box, const Slabs& slabs, std::int64_t limit, std::int64_t& enters);
  void offer(const Ray& ray, const RayHit& last, std::uint32_t triangle, RayHit& best, std::int64_t& limit) const;
  Range range_of(std::uint32_t node) const;
  void split(const Range& range, std::uint32_t cut);

  const Scene* scene_ = nullptr;
  std::span<const DrawnTriangle> drawn_;
  std::span<std::uint32_t> order_;
  std::span<LatticeBox> nodes_;
};

template <class Hull, class Visit>
bool RayTree::visit_in(Hull& hull, Visit visit) const {
  std::uint32_t stack[33];
  std::uint32_t depth = 0;
  if (!nodes_.empty()) stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t node = stack[--depth];
    if (hull.misses(nodes_[node])) continue;
    if (2 * node + 1 < nodes_.size()) {
      stack[depth++] = 2 * node + 2;
      stack[depth++] = 2 * node + 1;
      continue;
    }
    const Range range = range_of(node);
    for (std::uint32_t k = range.first; k < range.end; ++k) {
      if (!hull.misses(drawn_[order_[k]]) && !visit(order_[k])) return false;
    }
  }
  return true;
}

template <class Visit>
void RayTree::visit_blockers(const Ray& ray, bool ends, Visit visit) const {
  std::uint32_t stack[33];
  std::uint32_t depth = 0;
  const Slabs slabs = slabs_of(ray);
  const std::int64_t limit = ends ? (std::int64_t{1} << 32) + 1 : INT64_MAX;
  if (!nodes_.empty()) stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t node = stack[--depth];
    std::int64_t enters;
    if (!meets(nodes_[node], slabs, limit, enters)) continue;
    if (2 * node + 1 < nodes_.size()) {
      stack[depth++] = 2 * node + 2;
      stack[depth++] = 2 * node + 1;
      continue;
    }
    const Range range = range_of(node);
    for (std::uint32_t k = range.first; k < range.end; ++k) {
      RayHit hit;
      const std::uint32_t t = order_[k];
      if (!meet(drawn_[t], t, ray, hit) || (ends && hit.distance >= hit.speed)) continue;
      if (invisible(drawn_[t], hit.front)) continue;
      if (!visit(hit)) return;
    }
  }
}

}  // namespace shodo
