#include "picture/ray_tree.h"

#include <bit>

#include "base/sort.h"

namespace shodo {

namespace {

constexpr std::uint32_t kLeafTriangles = 5;  // half the boxes of a room that four take

// Of Slabs, where 2^32 is the whole direction: inverses are off by at most 1, times 2^21 steps.
constexpr std::int64_t kSlack = std::int64_t{1} << 22;

LatticeBox box_of(const DrawnTriangle& triangle) {
  LatticeBox box;
  for (const LatticePoint& p : triangle.vertex) box.include(p);
  return box;
}

/// Half of the surface.
std::int64_t surface_of(const LatticeBox& box) {
  const std::int64_t x = std::int64_t{box.high[0]} - box.low[0], y = std::int64_t{box.high[1]} - box.low[1],
                     z = std::int64_t{box.high[2]} - box.low[2];
  return x * y + y * z + z * x;
}

/// distance / speed in units of Slabs, at least what it is, and by not more than 1/256 of it or so.
std::int64_t limit_of(const RayHit& hit) {
  const int width = 64 - std::countl_zero(static_cast<std::uint64_t>(hit.speed));
  const int right = width > 22 ? width - 22 : 0;
  const std::int64_t far = (hit.distance >> right) + 1;
  if (far >= (std::int64_t{1} << 23)) return INT64_MAX;
  const std::uint32_t fast = static_cast<std::uint32_t>(hit.speed >> right);
  return std::int64_t{(static_cast<std::uint32_t>(far) << 9) / fast + 1} << 23;
}

}  // namespace

std::uint64_t RayTree::bytes(std::uint64_t drawn) {
  return (4 * drawn + 7) / 8 * 8 + sizeof(LatticeBox) * median_nodes(drawn, kLeafTriangles);
}

bool RayTree::build(const Scene& scene, std::span<const DrawnTriangle> drawn, Arena& arena) {
  scene_ = &scene;
  drawn_ = drawn;
  if (!arena.take("triangles in the rays' order", drawn.size(), order_)) return false;
  if (!arena.take("boxes for rays", median_nodes(drawn.size(), kLeafTriangles), nodes_)) return false;
  for (std::uint32_t k = 0; k < order_.size(); ++k) order_[k] = k;
  fill_median_boxes(nodes_, order_.size(), [this](const ItemRange& range, std::uint32_t cut) { split(range, cut); },
                    [this](std::uint32_t k) { return box_of(drawn_[order_[k]]); });
  return true;
}

/// `cut`: the first of the second half.
void RayTree::split(const ItemRange& range, std::uint32_t cut) {
  const auto middle = [this](std::uint32_t t, int axis) {
    const LatticeBox box = box_of(drawn_[t]);
    return box.low[axis] + box.high[axis];
  };
  const std::span<std::uint32_t> order = order_.subspan(range.first, range.end - range.first);
  const auto sort_along = [&](int axis) {
    heap_sort(order, [&](std::uint32_t a, std::uint32_t b) {
      const std::int32_t at_a = middle(a, axis), at_b = middle(b, axis);
      return at_a == at_b ? a < b : at_a < at_b;
    });
  };
  // Of both halves the surfaces, which rays meet in proportion.
  const auto surfaces = [&] {
    LatticeBox half[2];
    for (std::uint32_t k = range.first; k < range.end; ++k) half[k < cut ? 0 : 1].include(box_of(drawn_[order_[k]]));
    return surface_of(half[0]) + surface_of(half[1]);
  };
  int best = 0;
  std::int64_t least = INT64_MAX;
  for (int axis = 0; axis < 3; ++axis) {
    sort_along(axis);
    const std::int64_t here = surfaces();
    if (here >= least) continue;
    least = here;
    best = axis;
  }
  if (best != 2) sort_along(best);
}

RayTree::Slabs RayTree::slabs_of(const Ray& ray) {
  const std::int64_t way[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
  Slabs slabs{{}, {ray.origin.x, ray.origin.y, ray.origin.z}, {}, {}};
  for (int k = 0; k < 3; ++k) {
    slabs.up[k] = way[k] > 0;
    slabs.still[k] = way[k] == 0;
    const std::uint32_t size = static_cast<std::uint32_t>(way[k] < 0 ? -way[k] : way[k]);
    slabs.inverse[k] = size == 0 ? 0 : 0xffffffffu / size;
  }
  return slabs;
}

/// `enters`: where along the ray, at most what it is.
bool RayTree::meets(const LatticeBox& box, const Slabs& slabs, std::int64_t limit, std::int64_t& enters) {
  std::int64_t first = 0, last = limit;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t low = box.low[k] - slabs.origin[k], high = box.high[k] - slabs.origin[k];
    if (slabs.still[k]) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const std::int64_t inverse = slabs.inverse[k];
    const std::int64_t in = (slabs.up[k] ? low : -high) * inverse - kSlack;
    const std::int64_t out = (slabs.up[k] ? high : -low) * inverse + kSlack;
    if (in > first) first = in;
    if (out < last) last = out;
    if (first > last) return false;
  }
  enters = first;
  return true;
}

bool RayTree::invisible(const DrawnTriangle& triangle, bool front) const {
  if (triangle.light >= scene_->lights.size() || !scene_->lights[triangle.light].open) return false;
  return !front || !scene_->background.empty();
}

/// Takes the triangle's hit if it is the best so far.
void RayTree::offer(const Ray& ray, const RayHit& last, std::uint32_t t, RayHit& best, std::int64_t& limit) const {
  RayHit hit;
  if (t == last.triangle || !meet(drawn_[t], t, ray, hit) || invisible(drawn_[t], hit.front)) return;
  if (last.any() && !comes_before(drawn_, last, hit)) return;
  if (best.any() && !comes_before(drawn_, hit, best)) return;
  best = hit;
  limit = limit_of(best);
}

RayHit RayTree::nearest_after(const Ray& ray, const RayHit& last, std::uint32_t hint) const {
  struct Waiting {
    std::int64_t enters;
    std::uint32_t node;
  };
  Waiting stack[33];
  std::uint32_t depth = 0;
  const Slabs slabs = slabs_of(ray);
  RayHit best;
  std::int64_t limit = INT64_MAX;
  Waiting root{0, 0};
  if (hint != kNone) offer(ray, last, hint, best, limit);
  if (!nodes_.empty() && meets(nodes_[0], slabs, limit, root.enters)) stack[depth++] = root;
  while (depth > 0) {
    const Waiting at = stack[--depth];
    if (at.enters > limit) continue;
    if (2 * at.node + 1 < nodes_.size()) {
      Waiting near{0, 2 * at.node + 1}, far{0, 2 * at.node + 2};
      const bool meets_near = meets(nodes_[near.node], slabs, limit, near.enters);
      const bool meets_far = meets(nodes_[far.node], slabs, limit, far.enters);
      if (meets_near && meets_far && far.enters < near.enters) {
        const Waiting swap = near;
        near = far;
        far = swap;
        stack[depth++] = far;
        stack[depth++] = near;
        continue;
      }
      if (meets_far) stack[depth++] = far;
      if (meets_near) stack[depth++] = near;
      continue;
    }
    const ItemRange range = median_range(at.node, order_.size());
    for (std::uint32_t k = range.first; k < range.end; ++k) {
      if (order_[k] != hint) offer(ray, last, order_[k], best, limit);
    }
  }
  return best;
}

}  // namespace shodo
