#include "ambient/form_factor.h"

#include "ambient/box_factor.h"
#include "ambient/near_factor.h"

namespace shodo {

namespace {

constexpr double kMiddleError = 0.25;           // times q^2
constexpr double kMiddleErrorTriangle = 0.04;  // times q^(3/2)
constexpr double kClosedError = 1e-8;  // relative
constexpr double kRough = 0.01;        // tolerance at which the near tier begins with one point
constexpr double kEqual = 1e-9;  // areas and heights nearer than this count as equal

enum class Facing { kAway, kFully, kCrossing };

/// Where a patch with centre at `height` over a plane stands to it.
Facing facing(const PatchShape& shape, double longest_side, double height, const Vec3& normal, double flat) {
  if (height > longest_side) return Facing::kFully;  // no corner is farther from the centre
  if (height < -longest_side) return Facing::kAway;
  const Extent extent = extent_along(shape, longest_side, normal);
  if (height + extent.high <= flat) return Facing::kAway;
  return height + extent.low >= -flat ? Facing::kFully : Facing::kCrossing;
}

/// Mean of the kernel cos cos / r^2 over the Gauss points of both; the centres are `apart`.
double mean_kernel(const RowSide& i, const RowSide& j, const Vec3& apart) {
  double over_i[4], over_j[4];
  for (int k = 0; k < 4; ++k) {
    over_i[k] = dot(i.patch->normal, apart + j.gauss[k]);
    over_j[k] = dot(j.patch->normal, i.gauss[k] - apart);
  }
  const bool flat = i.own[0] == 0 && j.own[0] == 0;  // then all are
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 from = apart - i.gauss[k];
    double sum_k = 0;
    for (int l = 0; l < 4; ++l) {
      const double squared = length_squared(from + j.gauss[l]);
      const double h = flat ? over_i[l] * over_j[k] : (over_i[l] - i.own[k]) * (over_j[k] - j.own[l]);
      sum_k += j.weight[l] * (h / (squared * squared));
    }
    sum += i.weight[k] * sum_k;
  }
  return sum > 0 ? sum : 0;
}

/// True if `i` is to be looked at from points of j. Heights: of i's centre over j's plane, and the other way.
bool looks_at_first(const Patch& i, const Patch& j, double height_of_i, double height_of_j) {
  if (magnitude(i.area - j.area) > kEqual * (i.area + j.area)) return i.area > j.area;
  return height_of_i >= height_of_j - kEqual * (magnitude(height_of_i) + magnitude(height_of_j));
}

NearFactor near_exchange(const Surfaces& surfaces, std::uint32_t i, std::uint32_t j, bool first, double tolerance,
                         bool crosses, bool rough) {
  const std::uint32_t looking = first ? j : i, seen = first ? i : j;
  NearPatch points, polygon;
  points.piece = surfaces.piece(looking);
  points.normal = surfaces.patch(looking).normal;
  points.area = surfaces.patch(looking).area;
  polygon.piece = surfaces.piece(seen);
  polygon.normal = surfaces.patch(seen).normal;
  polygon.area = surfaces.patch(seen).area;
  return near_factor(points, polygon, tolerance, crosses, surfaces.flat, rough);
}

PairExchange near_pair(const Surfaces& surfaces, const RowSide& i, std::uint32_t j, double over_i, double over_j,
                       double unshaded, double tolerance, bool crossing) {
  const Patch& other = surfaces.patch(j);
  const double least = i.patch->area < other.area ? i.patch->area : other.area;
  const double most = unshaded < least ? unshaded : least;  // G can't be larger, nor need its error be
  const double closed = box_exchange(axis_rectangle(i.patch->centre, i.patch->normal, *i.shape, surfaces.flat),
                                     axis_rectangle(other.centre, other.normal, surfaces.shape(j), surfaces.flat));
  if (closed >= 0) return {closed < least ? closed : least, kClosedError * closed, crossing};
  const bool first = looks_at_first(*i.patch, other, over_j, over_i);
  const NearFactor factor =
      near_exchange(surfaces, i.position, j, first, tolerance * most, crossing, tolerance >= kRough);
  return {factor.exchange < least ? factor.exchange : least, factor.error, crossing};
}

}  // namespace

RowSide row_side(const Surfaces& surfaces, std::uint32_t position, NodeGeometry& own) {
  RowSide side = row_side(surfaces, position);
  if (surfaces.keeps_geometry()) return side;
  own = surfaces.found(position);
  side.patch = &own.patch;
  side.shape = &own.shape;
  return side;
}

RowSide row_side(const Surfaces& surfaces, std::uint32_t position) {
  RowSide side;
  side.position = position;
  side.patch = &surfaces.patch(position);
  side.shape = &surfaces.shape(position);
  side.side_squared = side.patch->longest_side * side.patch->longest_side;
  const PatchShape& shape = *side.shape;
  const std::span<const SamplePoint> set = sample_points(SampleSet::kGauss, shape.outline == Outline::kTriangle);
  const double twist = dot(side.patch->normal, shape.d);
  for (std::size_t k = 0; k < 4; ++k) {
    side.gauss[k] = shape.offset(set[k].x, set[k].y);
    side.weight[k] = set[k].weight * (1 + (shape.alpha * set[k].x + shape.beta * set[k].y));
    side.own[k] = twist * (set[k].x * set[k].y);
  }
  return side;
}

namespace {

/// Mean squares and means of a kernel's series over one side.
struct SeriesSide {
  double mean = 0, vary = 0;
};

/// `way`: from the other side to this; h: this side's height over the other's plane; 1 / r^2, 1 / h.
SeriesSide series_over(const PatchShape& shape, const Vec3& way, const Vec3& other_normal, double over_squared,
                       double over_height) {
  SeriesSide side;
  double g[2];
  int k = 0;
  for (const Vec3* axis : {&shape.a, &shape.b}) {
    const double u = dot(way, *axis) * over_squared, p = dot(other_normal, *axis) * over_height;
    const double w = dot(*axis, *axis) * over_squared;
    g[k++] = p - 4 * u;
    side.mean += 12 * u * u - 2 * w - 4 * u * p;
  }
  side.mean *= 1.0 / 3;
  side.vary = shape.outline == Outline::kTriangle ? (g[0] * g[0] + g[1] * g[1] - g[0] * g[1]) * (1.0 / 18)
                                                  : (g[0] * g[0] + g[1] * g[1]) * (1.0 / 3);
  return side;
}

constexpr double kMostQ = 0.45;            // beyond that there is no series
constexpr double kSeriesShareError = 0.6;  // times q^2
constexpr double kCurved = 0.1;            // times q^2, of what the kernel varies

}  // namespace

PairSeries series_between(const Surfaces& surfaces, const RowSide& i, std::uint32_t j) {
  PairSeries series;
  const Patch& other = surfaces.patch(j);
  const PatchShape& shape = surfaces.shape(j);
  const Vec3 apart = other.centre - i.patch->centre;
  const double over_i = dot(i.patch->normal, apart), over_j = -dot(other.normal, apart);
  const Facing j_front = facing(shape, other.longest_side, over_i, i.patch->normal, surfaces.flat);
  series.away = j_front == Facing::kAway;
  if (series.away) return series;
  const Facing i_front = facing(*i.shape, i.patch->longest_side, over_j, other.normal, surfaces.flat);
  series.away = i_front == Facing::kAway;
  if (series.away) return series;
  series.crossing = j_front == Facing::kCrossing || i_front == Facing::kCrossing;
  series.squared = length_squared(apart);
  const double sides = i.side_squared + other.longest_side * other.longest_side;
  if (series.crossing || sides > 3 * kMostQ * series.squared) return series;
  if (shape.outline == Outline::kConcave || i.shape->outline == Outline::kConcave) return series;
  series.found = true;
  const double over_squared = 1 / series.squared;
  const double areas = i.patch->area * other.area * kInversePi;
  const double q = sides * over_squared * (1.0 / 3);
  const bool triangular = shape.outline == Outline::kTriangle || i.shape->outline == Outline::kTriangle;
  const bool by_points = triangular || (shape.even & i.shape->even) == 0;
  const bool patches = !surfaces.is_block(i.position) && !surfaces.is_block(j);  // aren't split, however it varies
  if (!by_points || !patches) {
    const SeriesSide of_j = series_over(shape, apart, i.patch->normal, over_squared, 1 / over_i);
    const SeriesSide of_i = series_over(*i.shape, -apart, other.normal, over_squared, 1 / over_j);
    series.vary_i = of_i.vary + kCurved * q * q;
    series.vary_j = of_j.vary + kCurved * q * q;
    const double kernel = areas * over_squared * over_squared * over_i * over_j;
    series.geometric = kernel * (1 + (of_i.mean + of_j.mean));
  }
  if (by_points) series.geometric = areas * mean_kernel(i, row_side(surfaces, j), apart);
  series.error = kSeriesShareError * q * q * areas * over_squared;
  return series;
}

PairExchange exchange_between(const Surfaces& surfaces, const RowSide& i, std::uint32_t j, double tolerance) {
  const Patch& other = surfaces.patch(j);
  const PatchShape& shape = surfaces.shape(j);
  const Vec3 apart = other.centre - i.patch->centre;
  const double over_i = dot(i.patch->normal, apart);  // height of j's centre over i's plane
  const double over_j = -dot(other.normal, apart);
  const Facing j_front = facing(shape, other.longest_side, over_i, i.patch->normal, surfaces.flat);
  if (j_front == Facing::kAway) return {};
  const Facing i_front = facing(*i.shape, i.patch->longest_side, over_j, other.normal, surfaces.flat);
  if (i_front == Facing::kAway) return {};

  const bool crossing = j_front == Facing::kCrossing || i_front == Facing::kCrossing;
  const bool concave = shape.outline == Outline::kConcave || i.shape->outline == Outline::kConcave;
  const double squared = length_squared(apart);
  const double sides = i.side_squared + other.longest_side * other.longest_side;
  const double areas = i.patch->area * other.area * kInversePi;
  if (tolerance > 0 && !crossing && !concave) {
    // The centre of an uneven quadrilateral isn't its centroid: the far kernel would be wrong to first order.
    if (sides <= 3 * tolerance * squared && (shape.even & i.shape->even) != 0) {
      const double over_fourth = areas / (squared * squared);
      return {over_fourth * (over_i * over_j), over_fourth * sides / 3, false};
    }
    const double q = sides / (3 * squared);
    const bool triangular = shape.outline == Outline::kTriangle || i.shape->outline == Outline::kTriangle;
    const double error = triangular ? kMiddleErrorTriangle * q * square_root(q) : kMiddleError * q * q;
    if (error <= tolerance) {
      return {areas * mean_kernel(i, row_side(surfaces, j), apart), error * areas / squared, false};
    }
  }
  const double unshaded = squared > 0 ? areas / squared : kInfinity;
  return near_pair(surfaces, i, j, over_i, over_j, unshaded, tolerance > 0 ? tolerance : kNearTolerance, crossing);
}

}  // namespace shodo
