// `--flags off`: every triangle in file order until the first blocker. Bytes: none but the triangles'.
#include "visibility/intersector.h"

#include "base/wide.h"
#include "visibility/triangle_test.h"

namespace shodo {

bool Intersector::blocked(const LatticePoint& p, const LatticePoint& q, const Link& link) {
  const Triangle* const first = geometry_->triangles.data();
  const Triangle* const end = first + geometry_->triangles.size();
  const Triangle* triangle = first;
  while (triangle != end && !blocks_segment(*triangle, p, q)) ++triangle;
  const bool hit = triangle != end;
  ++segments_[index(link.set)];
  tests_[index(link.set)] += static_cast<std::uint64_t>(triangle - first) + (hit ? 1 : 0);
  return hit;
}

bool Intersector::ray_blocked(const LatticePoint& p, const LatticeVector& direction, const Link& link) {
  const Triangle* const first = geometry_->triangles.data();
  const Triangle* const end = first + geometry_->triangles.size();
  const Triangle* triangle = first;
  while (triangle != end && !blocks_ray(*triangle, p, direction)) ++triangle;
  const bool hit = triangle != end;
  ++segments_[index(link.set)];
  tests_[index(link.set)] += static_cast<std::uint64_t>(triangle - first) + (hit ? 1 : 0);
  return hit;
}

/// A hit lies at the fraction |s(P)| / |N.d| of the direction; two are compared by cross products of 128 bits.
Hit Intersector::nearest(const LatticePoint& p, const LatticeVector& direction) const {
  Hit best;
  std::int64_t best_distance = 0, best_speed = 1;
  for (std::uint32_t k = 0; k < geometry_->triangles.size(); ++k) {
    const Triangle& triangle = geometry_->triangles[k];
    if (!blocks_ray(triangle, p, direction)) continue;
    const std::int64_t side = triangle.side(p);
    const std::int64_t through = dot(triangle.n, direction);
    const std::int64_t distance = side < 0 ? -side : side;
    const std::int64_t speed = through < 0 ? -through : through;
    const Hit hit{k, side > 0};
    bool nearer = best.triangle == kNone || less_fraction(distance, speed, best_distance, best_speed);
    // Ties: front before back; ascending order keeps the lower index.
    if (!nearer && hit.front && !best.front) nearer = !less_fraction(best_distance, best_speed, distance, speed);
    if (!nearer) continue;
    best = hit;
    best_distance = distance;
    best_speed = speed;
  }
  return best;
}

}  // namespace shodo
