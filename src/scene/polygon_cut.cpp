#include "scene/polygon_cut.h"

#include <bit>

#include "base/check.h"

namespace shodo {

namespace {

constexpr int kStepBits = 30;
/// Of the sum of a polygon's triangles, whichever way they turn.
constexpr double kLeastArea = 0x1p-30;

/// Twice the area of a triangle, above 0 if it turns left. Coordinates are from 0 to 2^30: it is below 2^62.
std::int64_t turn(const CutCorner& a, const CutCorner& b, const CutCorner& c) {
  const std::int64_t bu = std::int64_t{b.u} - a.u, bv = std::int64_t{b.v} - a.v;
  const std::int64_t cu = std::int64_t{c.u} - a.u, cv = std::int64_t{c.v} - a.v;
  return bu * cv - bv * cu;
}

bool same_place(const CutCorner& a, const CutCorner& b) { return a.u == b.u && a.v == b.v; }

/// Does the way a, b, c turn back at b, or stand still?
bool turns_back(const CutCorner& a, const CutCorner& b, const CutCorner& c) {
  if (turn(a, b, c) != 0) return false;
  const std::int64_t along = (std::int64_t{b.u} - a.u) * (std::int64_t{c.u} - b.u);
  return along + (std::int64_t{b.v} - a.v) * (std::int64_t{c.v} - b.v) <= 0;
}

double component(const Vec3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// The power of two that makes 2^29 to 2^30 of `extent`; 0 for one that is hardly there.
double steps_per_unit(double extent) {
  if (!(extent > 0x1p-900)) return 0;
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(extent) >> 52;  // of 2, and 1023 more
  return std::bit_cast<double>((kStepBits - 1 + 2 * 1023 - exponent) << 52);
}

/// From 0 to below 2^30, from the lowest to the highest corner.
struct LatticeAxis {
  LatticeAxis(std::span<const Vec3> corners, int along) : axis(along) {
    low = component(corners[0], axis);
    double high = low;
    for (const Vec3& p : corners) {
      const double x = component(p, axis);
      if (x < low) low = x;
      if (x > high) high = x;
    }
    steps = steps_per_unit(high - low);
  }
  std::int32_t place(const Vec3& p) const {
    return static_cast<std::int32_t>((component(p, axis) - low) * steps + 0.5);
  }

  int axis;
  double low = 0, steps = 0;
};

double size(const Vec3& p) { return magnitude(p.x) + magnitude(p.y) + magnitude(p.z); }

/// Twice it, as a sum of triangles; 0 if it is next to nothing beside theirs: a polygon that crosses itself may have
/// none, and what rounding leaves of it says nothing about its plane.
Vec3 vector_area(std::span<const Vec3> corners) {
  Vec3 sum;
  double all = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Vec3 one = cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    sum = sum + one;
    all += size(one);
  }
  return size(sum) > kLeastArea * all ? sum : Vec3{};
}

class Cutting {
 public:
  Cutting(std::span<CutCorner> corners, std::span<CutTriangle> triangles) : corners_(corners), triangles_(triangles) {}

  /// False if there is no plane to see it in.
  bool place(std::span<const Vec3> corners) {
    const Vec3 area = vector_area(corners);
    if (area == Vec3{}) return false;
    int axis = magnitude(area.y) > magnitude(area.x) ? 1 : 0;
    if (magnitude(area.z) > magnitude(component(area, axis))) axis = 2;
    const bool turned = component(area, axis) < 0;
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    const LatticeAxis u(corners, turned ? second : first), v(corners, turned ? first : second);
    const std::uint32_t n = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t k = 0; k < n; ++k) {
      corners_[k] = {u.place(corners[k]), v.place(corners[k]), static_cast<std::uint16_t>((k + n - 1) % n),
                     static_cast<std::uint16_t>((k + 1) % n), false};
    }
    left_ = n;
    return true;
  }

  /// False if it comes to an end before the polygon does. Cutting off an ear makes ears of its neighbours only: what
  /// stays in the way of another corner is a corner that turns right, and no ear itself.
  bool clip() {
    std::uint32_t at = pass_over_folds(0, left_);
    for (std::uint32_t passed = 0; left_ >= 3;) {
      CutCorner& corner = corners_[at];
      if (!corner.tried && is_ear(corner)) {
        triangles_[count_++] = {{corner.previous, static_cast<std::uint16_t>(at), corner.next}};
        remove(corner);
        // Every other corner first: a round piece isn't cut into a fan.
        at = pass_over_folds(corner.previous, 2);
        passed = 0;
      } else {
        corner.tried = true;
        at = corner.next;
        if (++passed == left_) return false;
      }
    }
    return true;
  }

  bool overlap() const {
    for (std::uint32_t a = 1; a < count_; ++a) {
      for (std::uint32_t b = 0; b < a; ++b) {
        if (!parted(triangles_[a], triangles_[b]) && !parted(triangles_[b], triangles_[a])) return true;
      }
    }
    return false;
  }

  std::uint32_t count() const { return count_; }

 private:
  const CutCorner& previous(const CutCorner& corner) const { return corners_[corner.previous]; }
  const CutCorner& next(const CutCorner& corner) const { return corners_[corner.next]; }

  void remove(const CutCorner& corner) {
    corners_[corner.previous].next = corner.next;
    corners_[corner.next].previous = corner.previous;
    corners_[corner.previous].tried = corners_[corner.next].tried = false;
    --left_;
  }

  /// Removes corners where the polygon turns back, from `at` on until `most` in a row don't; returns where it ends.
  std::uint32_t pass_over_folds(std::uint32_t at, std::uint32_t most) {
    for (std::uint32_t passed = 0; left_ >= 3 && passed < most;) {
      const CutCorner& corner = corners_[at];
      const bool folds = turns_back(previous(corner), corner, next(corner));
      if (folds) remove(corner);
      at = folds ? corner.previous : corner.next;
      passed = folds ? 0 : passed + 1;
    }
    return at;
  }

  bool is_ear(const CutCorner& b) const {
    const CutCorner &a = previous(b), &c = next(b);
    if (turn(a, b, c) <= 0) return false;
    for (const CutCorner* other = &next(c); other != &a; other = &next(*other)) {
      if (same_place(*other, a) ? enters(*other, a, b, c)
          : same_place(*other, b) ? enters(*other, b, c, a)
          : same_place(*other, c) ? enters(*other, c, a, b)
                                  : turn(a, b, *other) >= 0 && turn(b, c, *other) >= 0 && turn(c, a, *other) >= 0) {
        return false;
      }
    }
    return true;
  }

  /// Does an edge of a corner that lies on `at` go from there into the triangle at, first, second?
  bool enters(const CutCorner& corner, const CutCorner& at, const CutCorner& first, const CutCorner& second) const {
    for (const CutCorner* end : {&previous(corner), &next(corner)}) {
      if (turn(at, first, *end) > 0 && turn(at, *end, second) > 0) return true;
    }
    return false;
  }

  /// Does a line along an edge of `a` have all of `b` on its right?
  bool parted(const CutTriangle& a, const CutTriangle& b) const {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const CutCorner &from = corners_[a.corner[k]], &to = corners_[a.corner[(k + 1) % 3]];
      bool right = true;
      for (const std::uint16_t corner : b.corner) right = right && turn(from, to, corners_[corner]) <= 0;
      if (right) return true;
    }
    return false;
  }

  std::span<CutCorner> corners_;
  std::span<CutTriangle> triangles_;
  std::uint32_t left_ = 0, count_ = 0;
};

}  // namespace

std::uint32_t cut_polygon(std::span<const Vec3> corners, std::span<CutCorner> scratch,
                          std::span<CutTriangle> triangles) {
  SHODO_CHECK(corners.size() >= 3 && corners.size() <= kMostCorners && scratch.size() >= corners.size());
  SHODO_CHECK(triangles.size() + 2 >= corners.size());
  Cutting cutting(scratch, triangles);
  return cutting.place(corners) && cutting.clip() && !cutting.overlap() ? cutting.count() : 0;
}

}  // namespace shodo
