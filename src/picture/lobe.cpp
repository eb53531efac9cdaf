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

/// An edge and its plane.
struct Edge {
  const Vec3 &a, &b;
  Vec3 m;
  double d = 0, size;  // size: |a x b| squared

  Edge(const Vec3& from, const Vec3& to, const Vec3& r) : a(from), b(to), m(cross(from, to)), size(length_squared(m)) {
    if (!(size > 0)) return;
    m = (1 / square_root(size)) * m;
    d = dot(m, r);
  }
};

/// What an edge adds to (n + 2) M.
double edge_part(const Lobe& lobe, const Vec3& r, const Vec3& normal, const Edge& edge) {
  const Vec3 &m = edge.m, &a = edge.a, &b = edge.b;
  const double d = edge.d, nearest = 1 - d * d, end = lobe.ends * lobe.ends, at_a = dot(a, r), at_b = dot(b, r);
  if (!(edge.size > 0) || !(nearest > end) || (!(at_a > 0) && !(at_b > 0))) return 0;
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

/// How often the edges of a polygon, one after the other, go round r, by where they cross half of a plane through it.
/// Each corner is on one side of the plane, the same for both of its edges; on which half an edge crosses, d tells, so
/// that this and J change together. The plane of an edge that is nearly a point, as cuts leave them, is mere
/// rounding: then the point where it crosses tells.
class Winding {
 public:
  explicit Winding(const Vec3& r) {
    const double x = magnitude(r.x), y = magnitude(r.y), z = magnitude(r.z);
    x_ = cross(r, x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
    y_ = cross(r, x_);
  }
  void add(const Edge& edge) {
    const double a = dot(y_, edge.a), b = dot(y_, edge.b);
    if ((a < 0) == (b < 0)) return;
    const bool up = a < 0, long_enough = edge.size > kPoint * (length_squared(edge.a) * length_squared(edge.b));
    const double crossing = long_enough ? edge.d : b * dot(x_, edge.a) - a * dot(x_, edge.b);
    if (up) turns_ += crossing >= 0 ? 1 : 0;  // as J does with d = 0
    if (!up) turns_ -= crossing < 0 ? 1 : 0;
  }
  bool around() const { return turns_ > 0; }

 private:
  static constexpr double kPoint = 1e-12;  // of an angle's square
  Vec3 x_, y_;
  int turns_ = 0;
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
  Winding winding(mirrored);
  for (std::uint32_t k = 0; k < polygon.count; ++k) {
    const Edge edge(polygon.corner[k], polygon.corner[k + 1 < polygon.count ? k + 1 : 0], mirrored);
    winding.add(edge);
    sum += edge_part(lobe, mirrored, normal, edge);
  }
  if (winding.around()) sum += kTwoPi * dot(normal, mirrored);
  return sum > 0 ? lobe.strength / (lobe.exponent + 2) * sum : 0;
}

}  // namespace shodo
