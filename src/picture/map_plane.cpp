#include "picture/map_plane.h"

namespace shodo {

namespace {

/// A triangle's plane, and its map seen along the axis nearest to the normal: u = u0 + s u_s + t u_t.
class MapPlane {
 public:
  explicit MapPlane(const DrawnTriangle& of) : of_(&of) {
    const LatticeVector b = of.vertex[1] - of.vertex[0], c = of.vertex[2] - of.vertex[0];
    normal_ = cross(b, c);
    const auto size = [](std::int64_t a) { return a < 0 ? -a : a; };
    const std::int64_t x = size(normal_.x), y = size(normal_.y), z = size(normal_.z);
    axis_ = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const double area = axis_ == 0 ? static_cast<double>(normal_.x)
                        : axis_ == 1 ? static_cast<double>(normal_.y) : static_cast<double>(normal_.z);
    set_slopes(along(b), along(c), area, of.u, u_);
    set_slopes(along(b), along(c), area, of.v, v_);
  }

  bool carries(const DrawnTriangle& other) const {
    if (other.mesh != of_->mesh || of_->mesh == kNone) return false;
    for (int k = 0; k < 3; ++k) {
      const LatticeVector p = other.vertex[k] - of_->vertex[0];
      if (dot(normal_, p) != 0) return false;
      const Pair at = along(p);
      if (off(u_, at, of_->u[0], other.u[k]) || off(v_, at, of_->v[0], other.v[k])) return false;
    }
    return true;
  }

 private:
  struct Pair {
    double s, t;
  };

  /// The two components that the axis leaves, in the order that gives the normal's as their determinant.
  Pair along(const LatticeVector& p) const {
    if (axis_ == 0) return {static_cast<double>(p.y), static_cast<double>(p.z)};
    if (axis_ == 1) return {static_cast<double>(p.z), static_cast<double>(p.x)};
    return {static_cast<double>(p.x), static_cast<double>(p.y)};
  }

  static void set_slopes(const Pair& b, const Pair& c, double area, const std::int32_t* at, Pair& slope) {
    const double to_b = static_cast<double>(at[1]) - at[0], to_c = static_cast<double>(at[2]) - at[0];
    slope = {(to_b * c.t - to_c * b.t) / area, (to_c * b.s - to_b * c.s) / area};
  }

  static bool off(const Pair& slope, const Pair& at, std::int32_t first, std::int32_t here) {
    const double by = first + slope.s * at.s + slope.t * at.t - here;
    return !(by <= kPlaneTolerance && by >= -kPlaneTolerance);
  }

  const DrawnTriangle* of_;
  LatticeVector normal_;
  int axis_;
  Pair u_, v_;
};

}  // namespace

void find_map_planes(std::span<const DrawnTriangle> drawn, std::span<std::uint32_t> map_of) {
  for (std::size_t first = 0; first < drawn.size();) {
    const MapPlane plane(drawn[first]);
    std::size_t t = first;
    do {
      map_of[t] = static_cast<std::uint32_t>(first);
      ++t;
    } while (t < drawn.size() && plane.carries(drawn[t]));
    first = t;
  }
}

}  // namespace shodo
