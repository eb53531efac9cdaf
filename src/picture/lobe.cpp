#include "picture/lobe.h"

namespace shodo {

namespace {

constexpr double kPieceWidths = 1.5;  // lobe's widths
constexpr double kSteep = 0.7;        // lobe's widths: how near r lies to an edge of which J is steep
constexpr double kNode[4] = {-0.86113631159405258, -0.33998104358485626, 0.33998104358485626, 0.86113631159405258};
constexpr double kWeight[4] = {0.34785484513745386, 0.65214515486254614, 0.65214515486254614, 0.34785484513745386};

/// Where the piece that begins at `at` ends at the latest.
double piece_end(double at, double first) {
  double end = first;
  if (at >= 0) {
    while (end <= at) end *= 2;
    return end;
  }
  if (-at <= first) return 0;
  while (2 * end < -at) end *= 2;
  return -end;
}

/// I, and J over d, from one tangent to another.
struct EdgeSums {
  double i = 0, j_over_d = 0;

  void add(const Lobe& lobe, double d, double off_power, double from, double to) {
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    double sum_i = 0, sum_j = 0;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const double t = middle + half * kNode[k], squared = t * t, cosine_squared = 1 / (1 + squared);
      const double power = lobe.raised(cosine_squared);
      sum_i += kWeight[k] * (power * cosine_squared);
      sum_j += kWeight[k] * ((power - off_power) / (d * d + squared));
    }
    i += half * sum_i;
    j_over_d += half * sum_j;
  }
};

/// What an edge adds to (n + 2) M.
double edge_part(const Lobe& lobe, const Vec3& r, const Vec3& normal, const Vec3& a, const Vec3& b) {
  const Vec3 across = cross(a, b);
  const double size = length_squared(across);
  if (!(size > 0)) return 0;
  const Vec3 m = (1 / square_root(size)) * across;
  const double d = dot(m, r);
  const double nearest = 1 - d * d, end = lobe.ends * lobe.ends, at_a = dot(a, r), at_b = dot(b, r);
  if (!(nearest > end) || (!(at_a > 0) && !(at_b > 0))) return 0;
  const Vec3 along = cross(m, r);
  double to = square_root(nearest / end - 1), from = -to;
  if (at_a > 0 && dot(a, along) > from * at_a) from = dot(a, along) / at_a;
  if (at_b > 0 && dot(b, along) < to * at_b) to = dot(b, along) / at_b;
  if (!(from < to)) return 0;
  const bool steep = magnitude(d) < kSteep * lobe.width;
  EdgeSums sums;
  for (double at = from; at < to;) {
    const double next = piece_end(at, kPieceWidths * lobe.width), stop = next < to ? next : to;
    sums.add(lobe, d, steep ? 1 : 0, at, stop);
    at = stop;
  }
  double j = d * sums.j_over_d;
  if (steep) j += arctangent2(d * (to - from), d * d + from * to);
  return lobe.raised(nearest) * (dot(normal, m) * sums.i - dot(normal, r) * j);
}

/// Whether r lies in a polygon: how often its sides, one after the other, go round it, by where they cross half of a
/// plane through r. Only signs count, and each corner's are the same for both of its edges, so slivers that cuts
/// leave, whose edges have directions of mere rounding, are not mistaken for what lies around r.
class Winding {
 public:
  explicit Winding(const Vec3& r) {
    const double x = magnitude(r.x), y = magnitude(r.y), z = magnitude(r.z);
    x_ = cross(r, x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
    y_ = cross(r, x_);
  }
  bool holds(const DirectionPolygon& polygon) const {
    int turns = 0;
    const Vec3& last = polygon.corner[polygon.count - 1];
    double x = dot(x_, last), y = dot(y_, last);
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
      const double next_x = dot(x_, polygon.corner[k]), next_y = dot(y_, polygon.corner[k]);
      if (y < 0 && next_y >= 0) turns += next_y * x - y * next_x > 0 ? 1 : 0;
      if (y >= 0 && next_y < 0) turns -= y * next_x - next_y * x > 0 ? 1 : 0;
      x = next_x;
      y = next_y;
    }
    return turns > 0;
  }

 private:
  Vec3 x_, y_;
};

}  // namespace

/// By squaring for whole n, which it mostly is; with even n without a root.
double Lobe::raised(double squared) const {
  if (!(exponent < 65536) || static_cast<double>(static_cast<std::uint32_t>(exponent)) != exponent) {
    return power(square_root(squared), exponent);
  }
  const std::uint32_t whole = static_cast<std::uint32_t>(exponent);
  double result = (whole & 1) != 0 ? square_root(squared) : 1;
  for (std::uint32_t bits = whole >> 1; bits != 0; bits >>= 1) {
    if ((bits & 1) != 0) result *= squared;
    squared *= squared;
  }
  return result;
}

double lobe_over(const Lobe& lobe, const Vec3& mirrored, const Vec3& normal, const DirectionPolygon& polygon) {
  if (polygon.count < 3) return 0;
  double sum = 0;
  for (std::uint32_t k = 0; k < polygon.count; ++k) {
    const Vec3& next = polygon.corner[k + 1 < polygon.count ? k + 1 : 0];
    sum += edge_part(lobe, mirrored, normal, polygon.corner[k], next);
  }
  if (Winding(mirrored).holds(polygon)) sum += kTwoPi * dot(normal, mirrored);
  return sum > 0 ? lobe.strength / (lobe.exponent + 2) * sum : 0;
}

}  // namespace shodo
