#include "ambient/box_factor.h"

#include <bit>

namespace shodo {

namespace {

constexpr double kFarthest = 2500;  // squared distance over squared sides

double term(double x, double root) { return x * root * arctangent(x / root); }

double log_term(double factor, double squared) { return squared > 0 ? factor * logarithm(squared) : 0; }

/// The power of two that brings lengths to about 1: logarithms of their squares then lose no digits, and a scene scaled
/// by a power of two has the same bits. `squared` above 0 and normal.
double to_unit(double squared) {
  const std::int64_t exponent = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(squared) >> 52) - 1023;
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 - (exponent >> 1)) << 52);
}

/// Two bounds in such units.
struct Bounds {
  double of[2];
  Bounds(double scale, double low, double high) : of{scale * low, scale * high} {}
};

/// 2 pi G; the bounds along the two common directions and the distance.
double parallel(const double* i_u, const double* j_u, const double* i_v, const double* j_v, double z) {
  const double z2 = z * z;
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const double u = i_u[k & 1] - j_u[k >> 1], alpha = square_root(u * u + z2);
    for (int l = 0; l < 4; ++l) {
      const double v = i_v[l & 1] - j_v[l >> 1], beta = square_root(v * v + z2);
      const double p = term(v, alpha) + term(u, beta) - log_term(0.5 * z2, u * u + v * v + z2);
      const bool plus = ((k & 1) ^ (k >> 1) ^ (l & 1) ^ (l >> 1)) == 0;
      sum += plus ? p : -p;
    }
  }
  return sum;
}

/// 2 pi G; bounds of one over the other's plane, the same of the other, and both along the common direction.
double square(const double* x, const double* z, const double* i_v, const double* j_v) {
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const double c2 = x[k & 1] * x[k & 1] + z[k >> 1] * z[k >> 1], c = square_root(c2);
    for (int l = 0; l < 4; ++l) {
      const double v = i_v[l & 1] - j_v[l >> 1], v2 = v * v;
      const double p = (c > 0 ? term(v, c) : 0) - log_term(0.25 * (c2 - v2), c2 + v2);
      const bool plus = ((k & 1) ^ (k >> 1) ^ (l & 1) ^ (l >> 1)) == 0;
      sum += plus ? p : -p;
    }
  }
  return sum;
}

/// The bounds of a in front of the plane that b lies in, from that plane on; false: nothing is.
bool in_front(const AxisRectangle& a, const AxisRectangle& b, double* bounds) {
  const double plane = b.low[b.axis];
  bounds[0] = b.up ? a.low[b.axis] - plane : plane - a.high[b.axis];
  bounds[1] = b.up ? a.high[b.axis] - plane : plane - a.low[b.axis];
  if (bounds[0] < 0) bounds[0] = 0;
  return bounds[1] > bounds[0];
}

}  // namespace

AxisRectangle axis_rectangle(const Vec3& centre, const Vec3& normal, const PatchShape& shape, double flat) {
  AxisRectangle box;
  if (shape.outline != Outline::kQuad || shape.even == 0) return box;
  const double middle[3] = {centre.x, centre.y, centre.z};
  const double a[3] = {shape.a.x, shape.a.y, shape.a.z}, b[3] = {shape.b.x, shape.b.y, shape.b.z};
  const double up[3] = {normal.x, normal.y, normal.z};
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    const double of_a = magnitude(a[k]), of_b = magnitude(b[k]);
    if (of_a > flat && of_b > flat) return box;  // slanting
    const double half = of_a > of_b ? of_a : of_b;
    if (half <= flat) {
      if (axis >= 0) return box;
      axis = k;
    }
    box.low[k] = half <= flat ? middle[k] : middle[k] - half;
    box.high[k] = half <= flat ? middle[k] : middle[k] + half;
  }
  box.axis = axis;
  if (axis >= 0) box.up = up[axis] > 0;
  return box;
}

double box_exchange(const AxisRectangle& i, const AxisRectangle& j) {
  if (i.axis < 0 || j.axis < 0) return -1;
  double apart = 0, sides = 0;
  for (int k = 0; k < 3; ++k) {
    const double way = i.low[k] + i.high[k] - j.low[k] - j.high[k];
    const double side_i = i.high[k] - i.low[k], side_j = j.high[k] - j.low[k];
    apart += 0.25 * way * way;
    sides += side_i * side_i + side_j * side_j;
  }
  if (apart > kFarthest * sides) return -1;
  const double scale = to_unit(sides);
  double exchange;
  if (i.axis == j.axis) {
    const int u = (i.axis + 1) % 3, v = (i.axis + 2) % 3;
    const double over = j.low[i.axis] - i.low[i.axis];
    if (i.up == j.up || !(i.up ? over > 0 : over < 0)) return 0;
    const Bounds i_u(scale, i.low[u], i.high[u]), j_u(scale, j.low[u], j.high[u]);
    const Bounds i_v(scale, i.low[v], i.high[v]), j_v(scale, j.low[v], j.high[v]);
    exchange = parallel(i_u.of, j_u.of, i_v.of, j_v.of, scale * over);
  } else {
    const int common = 3 - i.axis - j.axis;
    double x[2], z[2];
    if (!in_front(i, j, x) || !in_front(j, i, z)) return 0;
    const Bounds over_j(scale, x[0], x[1]), over_i(scale, z[0], z[1]);
    const Bounds i_v(scale, i.low[common], i.high[common]), j_v(scale, j.low[common], j.high[common]);
    exchange = square(over_j.of, over_i.of, i_v.of, j_v.of);
  }
  return exchange > 0 ? exchange / (kTwoPi * scale * scale) : 0;
}

}  // namespace shodo
