// The drawn triangles in a tree of boxes, for rays (paper 2.4; only for scenes with mirrors, glass or highlights).
//
// Median cuts (visibility/median_boxes.h) along the axis that leaves both halves' boxes the least surface (MacDonald
// and Booth 1990). A ray's nearest hit is sought near boxes first; a box that begins beyond the nearest hit so far is
// left out. Boxes are tested with 2^32 / |d| rounded down, and as much to spare as that can be off, so none that is met
// is left out.
// Exact: the answers. Bytes: 4 a drawn triangle, 24 a node (about one for each two triangles).
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/ray.h"
#include "scene/scene.h"
#include "visibility/lattice_box.h"
#include "visibility/median_boxes.h"

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
  struct Slabs {  // 2^32 / |d| an axis
    std::uint32_t inverse[3];
    std::int32_t origin[3];
    bool up[3], still[3];
  };
  static Slabs slabs_of(const Ray& ray);
  static bool meets(const LatticeBox& box, const Slabs& slabs, std::int64_t limit, std::int64_t& enters);
  void offer(const Ray& ray, const RayHit& last, std::uint32_t triangle, RayHit& best, std::int64_t& limit) const;
  void split(const ItemRange& range, std::uint32_t cut);

  const Scene* scene_ = nullptr;
  std::span<const DrawnTriangle> drawn_;
  std::span<std::uint32_t> order_;
  std::span<LatticeBox> nodes_;
};

template <class Hull, class Visit>
bool RayTree::visit_in(Hull& hull, Visit visit) const {
  return walk_medians(
      nodes_.size(), order_.size(), [&](std::uint32_t node) { return !hull.misses(nodes_[node]); },
      [&](std::uint32_t k) { return hull.misses(drawn_[order_[k]]) || visit(order_[k]); });
}

template <class Visit>
void RayTree::visit_blockers(const Ray& ray, bool ends, Visit visit) const {
  const Slabs slabs = slabs_of(ray);
  const std::int64_t limit = ends ? (std::int64_t{1} << 32) + 1 : INT64_MAX;
  const auto enters = [&](std::uint32_t node) {
    std::int64_t at;
    return meets(nodes_[node], slabs, limit, at);
  };
  walk_medians(nodes_.size(), order_.size(), enters, [&](std::uint32_t k) {
    RayHit hit;
    const std::uint32_t t = order_[k];
    if (!meet(drawn_[t], t, ray, hit) || (ends && hit.distance >= hit.speed)) return true;
    return invisible(drawn_[t], hit.front) || visit(hit);
  });
}

}  // namespace shodo
