#include "ambient/near_factor.h"

#include "base/check.h"
#include <array>

#include "light/polygon_factor.h"

namespace shodo {

namespace {

constexpr std::uint32_t kDeepest = 4;

struct Node {
  double x, weight;
};

// Gauss-Legendre on [-1, 1].
constexpr std::array<Node, 1> kGauss1{{{0, 2}}};
constexpr std::array<Node, 2> kGauss2{{{-0.57735026918962576, 1}, {0.57735026918962576, 1}}};
constexpr std::array<Node, 3> kGauss3{
    {{-0.77459666924148338, 5.0 / 9}, {0, 8.0 / 9}, {0.77459666924148338, 5.0 / 9}}};
constexpr std::array<Node, 4> kGauss4{{{-0.86113631159405258, 0.34785484513745386},
                                       {-0.33998104358485626, 0.65214515486254614},
                                       {0.33998104358485626, 0.65214515486254614},
                                       {0.86113631159405258, 0.34785484513745386}}};

/// Barycentric (1 - 2 t, t, t) and its turns.
struct Orbit {
  double t, weight;
};
constexpr std::array<Orbit, 1> kTriangle3{{{1.0 / 6, 1.0 / 3}}};                          // degree 2
constexpr std::array<Orbit, 2> kTriangle7{{{0.10128650732345634, 0.12593918054482715},   // degree 5 (Radon 1948),
                                           {0.47014206410511509, 0.13239415278850618}}};  // and 0.225 at the centroid

/// What is looked at, and the tilt of the surface that looks.
struct Look {
  const Piece* polygon;
  Vec3 normal;
  std::uint32_t first_rule;

  double from(const Vec3& point) const { return point_to_polygon(point, normal, polygon->corner, polygon->corners); }
};

/// A part of the looking patch: four corners (bilinear) or three.
struct Cell {
  Vec3 corner[4];
  std::uint32_t corners;
};

/// Integral of the factor over a bilinear cell; the area element is projected on the normal.
double over_quad(const Look& look, const Cell& cell, std::span<const Node> rule) {
  const Vec3* c = cell.corner;
  const Vec3 a = 0.25 * ((c[1] - c[0]) + (c[2] - c[3])), b = 0.25 * ((c[3] - c[0]) + (c[2] - c[1]));
  const Vec3 d = 0.25 * ((c[0] - c[1]) + (c[2] - c[3])), centre = 0.25 * ((c[0] + c[2]) + (c[1] + c[3]));
  double sum = 0;
  for (const Node& v : rule) {
    for (const Node& u : rule) {
      const double element = dot(look.normal, cross(a + v.x * d, b + u.x * d));
      const Vec3 point = centre + ((u.x * a + v.x * b) + (u.x * v.x) * d);
      sum += u.weight * v.weight * element * look.from(point);
    }
  }
  return sum;
}

double over_triangle(const Look& look, const Cell& cell, std::span<const Orbit> rule, double centroid_weight) {
  const Vec3* c = cell.corner;
  const double area = 0.5 * dot(look.normal, cross(c[1] - c[0], c[2] - c[0]));
  const Vec3 centroid = (1.0 / 3) * (c[0] + c[1] + c[2]);
  double sum = centroid_weight > 0 ? centroid_weight * look.from(centroid) : 0;
  for (const Orbit& orbit : rule) {
    // (1 - 3 t) of the way from the centroid to each corner.
    for (std::uint32_t k = 0; k < 3; ++k) {
      sum += orbit.weight * look.from(centroid + (1 - 3 * orbit.t) * (c[k] - centroid));
    }
  }
  return area * sum;
}

/// Child `which` of four.
Cell quarter(const Cell& cell, std::uint32_t which) {
  const Vec3* c = cell.corner;
  Cell part;
  part.corners = cell.corners;
  if (cell.corners == 3) {
    const Vec3 middle[3] = {0.5 * (c[1] + c[2]), 0.5 * (c[2] + c[0]), 0.5 * (c[0] + c[1])};
    for (std::uint32_t k = 0; k < 3; ++k) {
      part.corner[k] = which == 3 ? middle[k] : k == which ? c[k] : middle[3 - which - k];
    }
    part.corner[3] = part.corner[2];
    return part;
  }
  const Vec3 centre = 0.25 * ((c[0] + c[2]) + (c[1] + c[3]));
  const std::uint32_t next = (which + 1) % 4, last = (which + 3) % 4;
  part.corner[which] = c[which];
  part.corner[next] = 0.5 * (c[which] + c[next]);
  part.corner[(which + 2) % 4] = centre;
  part.corner[last] = 0.5 * (c[which] + c[last]);
  return part;
}

/// The cell that a path of `depth` digits to base 4 leads to.
Cell descend(const Cell& root, std::uint32_t path, std::uint32_t depth) {
  Cell cell = root;
  for (std::uint32_t level = depth; level-- > 0;) cell = quarter(cell, (path >> (2 * level)) & 3);
  return cell;
}

/// The integral by one of the rules, each finer than the last.
double by_rule(const Look& look, const Cell& cell, std::uint32_t rule) {
  if (cell.corners == 3) {
    return rule == 0   ? over_triangle(look, cell, {}, 1)
           : rule == 1 ? over_triangle(look, cell, kTriangle3, 0)
                       : over_triangle(look, cell, kTriangle7, 0.225);
  }
  constexpr std::span<const Node> kRules[] = {kGauss1, kGauss2, kGauss3, kGauss4};
  return over_quad(look, cell, kRules[rule]);
}

/// The best value of a cell that two rules agree on, or the best there is; the difference is the error.
NearFactor measure(const Look& look, const Cell& cell, double tolerance) {
  const std::uint32_t last = cell.corners == 3 ? 2 : 3;
  NearFactor part{by_rule(look, cell, look.first_rule), 0};
  for (std::uint32_t rule = look.first_rule + 1; rule <= last; ++rule) {
    const double finer = by_rule(look, cell, rule);
    part = {finer, magnitude(finer - part.exchange)};
    if (part.error <= tolerance) break;
  }
  return part;
}

/// Adds the integral over a cell, refined to the tolerance; a cell of each level may use half of its parent's, since
/// few of its siblings need theirs (the rest lies at an edge that both patches touch).
void add_refined(const Look& look, const Cell& root, double tolerance, NearFactor& sum) {
  std::uint32_t path = 0, depth = 0;
  double allowed = tolerance;
  for (;;) {
    const NearFactor part = measure(look, descend(root, path, depth), allowed);
    if (part.error > allowed && depth < kDeepest) {
      path <<= 2;
      ++depth;
      allowed *= 0.5;
      continue;
    }
    sum.exchange += part.exchange;
    sum.error += part.error;
    for (; depth > 0 && (path & 3) == 3; --depth, allowed *= 2) path >>= 2;
    if (depth == 0) return;
    ++path;
  }
}

/// A plane cuts two corners off a saddle, each on its own: two are left, and four cuts.
constexpr std::uint32_t kMostCut = 6;

/// The part of a cell in front of a plane (Sutherland and Hodgman 1974); returns its corners.
std::uint32_t cut(const Cell& cell, const Vec3& on_plane, const Vec3& normal, double flat, Vec3* to) {
  double height[4];
  for (std::uint32_t k = 0; k < cell.corners; ++k) {
    height[k] = dot(normal, cell.corner[k] - on_plane);
    if (height[k] < flat && height[k] > -flat) height[k] = 0;
  }
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < cell.corners; ++k) {
    const std::uint32_t next = (k + 1) % cell.corners;
    if (height[k] >= 0) to[count++] = cell.corner[k];
    if ((height[k] > 0 && height[next] < 0) || (height[k] < 0 && height[next] > 0)) {
      const double part = height[k] / (height[k] - height[next]);
      to[count++] = cell.corner[k] + part * (cell.corner[next] - cell.corner[k]);
    }
  }
  SHODO_CHECK(count <= kMostCut);
  return count;
}

void add_cut(const Look& look, const Cell& cell, const NearPatch& polygon, double tolerance, double flat,
             NearFactor& sum) {
  Vec3 corner[kMostCut];
  const std::uint32_t count = cut(cell, polygon.piece.corner[0], polygon.normal, flat, corner);
  if (count < 3) return;
  if (count <= 4) {
    Cell part{{corner[0], corner[1], corner[2], corner[count - 1]}, count};
    add_refined(look, part, tolerance, sum);
    return;
  }
  Vec3 middle = corner[0];
  for (std::uint32_t k = 1; k < count; ++k) middle = middle + corner[k];
  middle = (1.0 / count) * middle;
  for (std::uint32_t k = 0; k < count; ++k) {
    const Vec3& next = corner[(k + 1) % count];
    add_refined(look, Cell{{corner[k], next, middle, middle}, 3}, tolerance / count, sum);
  }
}

}  // namespace

NearFactor near_factor(const NearPatch& points, const NearPatch& polygon, double tolerance, bool crosses, double flat,
                       bool rough) {
  const Look look{&polygon.piece, points.normal, rough ? 0u : 1u};
  const Vec3* c = points.piece.corner;
  Cell cells[2];
  std::uint32_t count = 1;
  cells[0] = {{c[0], c[1], c[2], c[3]}, points.piece.corners};
  if (points.piece.concave) {
    cells[0] = {{c[0], c[1], c[3], c[3]}, 3};
    cells[1] = {{c[1], c[2], c[3], c[3]}, 3};
    count = 2;
  }
  NearFactor sum;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (crosses) {
      add_cut(look, cells[k], polygon, tolerance / count, flat, sum);
    } else {
      add_refined(look, cells[k], tolerance / count, sum);
    }
  }
  if (sum.exchange < 0) sum.exchange = 0;
  return sum;
}

}  // namespace shodo
