#include "picture/ray_tree.h"

#include <bit>

#include "visibility/sort.h"

namespace shodo {

namespace {

constexpr std::uint64_t kLeaf = 4;
constexpr std::int64_t kOne = std::int64_t{1} << 40;   // of Slabs: the whole direction
constexpr std::int64_t kSlack = std::int64_t{3} << 20;  // rounding of inverses, times 2^21 steps at most, and one more

std::uint64_t count_nodes(std::uint64_t triangles) {
  if (triangles == 0) return 0;
  std::uint64_t leaves = 1;
  while (triangles > kLeaf * leaves) leaves *= 2;
  return 2 * leaves - 1;
}

LatticeBox box_of(const DrawnTriangle& triangle) {
  LatticeBox box;
  for (const LatticePoint& p : triangle.vertex) box.include(p);
  return box;
}

/// distance / speed in units of Slabs, at least what it is.
std::int64_t limit_of(const RayHit& hit) {
  if (hit.distance >= hit.speed && hit.distance / hit.speed >= (1 << 20)) return INT64_MAX;
  const int width = 64 - std::countl_zero(static_cast<std::uint64_t>(hit.speed));
  const int right = width > 22 ? width - 22 : 0;  // 20 more than the distance may have, and 40 to come
  const std::int64_t far = (hit.distance >> right) + 1, fast = hit.speed >> right;
  return far >= (std::int64_t{1} << 23) ? INT64_MAX : (far << 40) / fast + kSlack;
}

}  // namespace

std::uint64_t RayTree::bytes(std::uint64_t drawn) {
  return (4 * drawn + 7) / 8 * 8 + sizeof(LatticeBox) * count_nodes(drawn);
}

bool RayTree::build(const Scene& scene, std::span<const DrawnTriangle> drawn, Arena& arena) {
  scene_ = &scene;
  drawn_ = drawn;
  if (!arena.take("triangles in the rays' order", drawn.size(), order_)) return false;
  if (!arena.take("boxes for rays", static_cast<std::size_t>(count_nodes(drawn.size())), nodes_)) return false;
  for (std::uint32_t k = 0; k < order_.size(); ++k) order_[k] = k;
  const std::uint32_t nodes = static_cast<std::uint32_t>(nodes_.size());
  for (std::uint32_t node = 0; 2 * node + 1 < nodes; ++node) split(range_of(node));
  for (std::uint32_t node = nodes; node-- > 0;) {
    LatticeBox box;
    if (2 * node + 1 < nodes) {
      box.include(nodes_[2 * node + 1]);
      box.include(nodes_[2 * node + 2]);
    } else {
      const Range range = range_of(node);
      for (std::uint32_t k = range.first; k < range.end; ++k) box.include(box_of(drawn_[order_[k]]));
    }
    nodes_[node] = box;
  }
  return true;
}

RayTree::Range RayTree::range_of(std::uint32_t node) const {
  const std::uint32_t level = static_cast<std::uint32_t>(std::bit_width(node + 1)) - 1;
  const std::uint64_t place = node + 1 - (std::uint32_t{1} << level);
  const std::uint64_t count = order_.size();
  return {static_cast<std::uint32_t>(count * place >> level), static_cast<std::uint32_t>(count * (place + 1) >> level)};
}

void RayTree::split(const Range& range) {
  const auto middle = [this](std::uint32_t t, int axis) {
    const LatticeBox box = box_of(drawn_[t]);
    return box.low[axis] + box.high[axis];
  };
  LatticeBox middles;
  const std::span<std::uint32_t> order = order_.subspan(range.first, range.end - range.first);
  for (const std::uint32_t t : order) middles.include(LatticePoint{middle(t, 0), middle(t, 1), middle(t, 2)});
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (middles.high[k] - middles.low[k] > middles.high[axis] - middles.low[axis]) axis = k;
  }
  heap_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const std::int32_t at_a = middle(a, axis), at_b = middle(b, axis);
    return at_a == at_b ? a < b : at_a < at_b;
  });
}

RayTree::Slabs RayTree::slabs_of(const Ray& ray) {
  const std::int64_t way[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
  Slabs slabs{{}, {ray.origin.x, ray.origin.y, ray.origin.z}, {}, {}};
  for (int k = 0; k < 3; ++k) {
    slabs.up[k] = way[k] > 0;
    slabs.still[k] = way[k] == 0;
    slabs.inverse[k] = way[k] == 0 ? 0 : kOne / (way[k] < 0 ? -way[k] : way[k]);
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
    const std::int64_t in = (slabs.up[k] ? low : -high) * slabs.inverse[k] - kSlack;
    const std::int64_t out = (slabs.up[k] ? high : -low) * slabs.inverse[k] + kSlack;
    if (in > first) first = in;
    if (out < last) last = out;
    if (first > last) return false;
  }
  enters = first;
  return true;
}

bool RayTree::invisible(const DrawnTriangle& triangle, bool front) const {
  if (triangle.light == kNone || !scene_->lights[triangle.light].open) return false;
  return !front || !scene_->background.empty();
}

RayHit RayTree::nearest_after(const Ray& ray, const RayHit& last) const {
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
    const Range range = range_of(at.node);
    for (std::uint32_t k = range.first; k < range.end; ++k) {
      RayHit hit;
      const std::uint32_t t = order_[k];
      if (t == last.triangle || !meet(drawn_[t], t, ray, hit) || invisible(drawn_[t], hit.front)) continue;
      if (last.any() && !comes_before(drawn_, last, hit)) continue;
      if (best.any() && !comes_before(drawn_, hit, best)) continue;
      best = hit;
      limit = limit_of(best);
    }
  }
  return best;
}

}  // namespace shodo
