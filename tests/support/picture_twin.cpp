#include "support/picture_twin.h"

#include <algorithm>
#include <tuple>

namespace shodo {

namespace {

__extension__ typedef __int128 Wide;

/// Sign of a / b - c / d for a, c >= 0 and b, d > 0, by continued fractions: nothing grows.
int compare_fractions(Wide a, Wide b, Wide c, Wide d) {
  for (int turn = 1;; turn = -turn) {
    const Wide p = a / b, q = c / d;
    if (p != q) return p < q ? -turn : turn;
    a -= p * b;
    c -= q * d;
    if (a == 0 || c == 0) return a == c ? 0 : (a == 0 ? -turn : turn);
    std::swap(a, b);
    std::swap(c, d);
  }
}

auto key(const LatticePoint& p) { return std::tuple(p.x, p.y, p.z); }

}  // namespace

PictureTwin::Vector PictureTwin::cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

PictureTwin::Wide PictureTwin::dot(const Vector& a, const Vector& b) {
  return Wide{a[0]} * b[0] + Wide{a[1]} * b[1] + Wide{a[2]} * b[2];
}

PictureTwin::Vector PictureTwin::direction(std::int64_t x, std::int64_t y) const {
  const auto& g = grid_;
  const std::int64_t n = std::int64_t{1} << g.split;
  return {n * (g.d0.x + y * g.dy.x) + x * g.dx.x, n * (g.d0.y + y * g.dy.y) + x * g.dx.y,
          n * (g.d0.z + y * g.dy.z) + x * g.dx.z};
}

PictureTwin::PictureTwin(const Scene& scene, const Geometry& geometry, const SampleGrid& grid)
    : drawn_(geometry.drawn.begin(), geometry.drawn.end()), grid_(grid) {
  for (std::uint32_t t = 0; t < drawn_.size(); ++t) {
    const auto from_eye = [&](int k) {
      const LatticePoint& p = drawn_[t].vertex[k];
      return Vector{std::int64_t{p.x} - grid.eye.x, std::int64_t{p.y} - grid.eye.y, std::int64_t{p.z} - grid.eye.z};
    };
    const Vector a = from_eye(0), b = from_eye(1), c = from_eye(2);
    Cone cone;
    cone.triangle = t;
    cone.side[0] = cross(a, b);
    cone.side[1] = cross(b, c);
    cone.side[2] = cross(c, a);
    cone.normal = cross({b[0] - a[0], b[1] - a[1], b[2] - a[2]}, {c[0] - a[0], c[1] - a[1], c[2] - a[2]});
    cone.depth = static_cast<std::int64_t>(dot(cone.normal, a));
    if (cone.depth == 0) continue;
    // The eye in front has normal . (eye - a) > 0.
    if (drawn_[t].light != kNone && cone.depth > 0 && scene.lights[drawn_[t].light].open) continue;
    cones_.push_back(cone);
  }
}

bool PictureTwin::inside(const Cone& cone, const Vector& d, const Vector& dx, const Vector& dy) {
  for (const Vector& side : cone.side) {
    Wide value = dot(side, d);
    if (value == 0) value = dot(side, dx);
    if (value == 0) value = dot(side, dy);
    if (value == 0 || (value > 0) != (cone.depth > 0)) return false;
  }
  return true;
}

/// Positive if a is nearer: the ray meets a plane at depth / normal.d, both of one sign inside.
int PictureTwin::compare_depth(const Cone& a, const Cone& b, const Vector& d) const {
  const auto size = [](Wide value) { return value < 0 ? -value : value; };
  return compare_fractions(size(dot(a.normal, d)), size(a.depth), size(dot(b.normal, d)), size(b.depth));
}

bool PictureTwin::wins_tie(const Cone& a, const Cone& b) const {
  const bool front_a = a.depth < 0, front_b = b.depth < 0;
  if (front_a != front_b) return front_a;
  const Wide area_a = dot(a.normal, a.normal), area_b = dot(b.normal, b.normal);
  if (area_a != area_b) return area_a < area_b;
  const auto sorted = [&](const Cone& cone) {
    const LatticePoint* v = drawn_[cone.triangle].vertex;
    std::array keys{key(v[0]), key(v[1]), key(v[2])};
    std::sort(keys.begin(), keys.end());
    return keys;
  };
  const auto keys_a = sorted(a), keys_b = sorted(b);
  return keys_a != keys_b ? keys_a < keys_b : a.triangle < b.triangle;
}

TwinHit PictureTwin::hit(std::int64_t x, std::int64_t y) const {
  const Vector d = direction(x, y), dx = {grid_.dx.x, grid_.dx.y, grid_.dx.z},
               dy = {grid_.dy.x, grid_.dy.y, grid_.dy.z};
  const Cone* best = nullptr;
  for (const Cone& cone : cones_) {
    if (!inside(cone, d, dx, dy)) continue;
    const int order = best == nullptr ? 1 : compare_depth(cone, *best, d);
    if (order > 0 || (order == 0 && wins_tie(cone, *best))) best = &cone;
  }
  if (best == nullptr) return {};
  return {best->triangle, best->depth < 0};
}

std::uint32_t PictureTwin::cover(std::int64_t x, std::int64_t y) const {
  const Vector d = direction(x, y), dx = {grid_.dx.x, grid_.dx.y, grid_.dx.z},
               dy = {grid_.dy.x, grid_.dy.y, grid_.dy.z};
  std::uint32_t count = 0;
  for (const Cone& cone : cones_) count += inside(cone, d, dx, dy) ? 1 : 0;
  return count;
}

std::array<long double, 2> PictureTwin::map_point(std::uint32_t triangle, std::int64_t x, std::int64_t y) const {
  const Vector d = direction(x, y);
  for (const Cone& cone : cones_) {
    if (cone.triangle != triangle) continue;
    // The weight of corner k is the determinant of the other two and d.
    const Wide weight[3] = {dot(cone.side[1], d), dot(cone.side[2], d), dot(cone.side[0], d)};
    const long double whole = static_cast<long double>(weight[0] + weight[1] + weight[2]);
    std::array<long double, 2> point{};
    for (int k = 0; k < 3; ++k) {
      const long double part = static_cast<long double>(weight[k]) / whole;
      point[0] += part * drawn_[triangle].u[k] / 256;
      point[1] += part * drawn_[triangle].v[k] / 256;
    }
    return point;
  }
  return {};
}

}  // namespace shodo
