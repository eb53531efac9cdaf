// Triangles are sorted by plane, then by their least x, y and z; within a plane a triangle is compared with those that
// start before it ends along its first axis, by separating edges. All numbers are integers of the lattice.
#include "cli/overlaps.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace shodo {

namespace {

/// A triangle in its plane's own two coordinates, counter-clockwise.
struct FlatTriangle {
  std::array<std::int64_t, 4> plane;  // N and D without their common divisor: equal for equal planes with equal fronts
  std::array<std::int64_t, 3> u, v;
  std::uint32_t polygon = 0;

  std::int64_t least_u() const { return std::min({u[0], u[1], u[2]}); }
  std::int64_t most_u() const { return std::max({u[0], u[1], u[2]}); }
};

std::int64_t size(std::int64_t x) { return x < 0 ? -x : x; }

FlatTriangle flatten(const Triangle& t, std::uint32_t polygon) {
  const std::int64_t common = std::gcd(std::gcd(t.n.x, t.n.y), std::gcd(t.n.z, t.d));
  FlatTriangle flat{
      .plane = {t.n.x / common, t.n.y / common, t.n.z / common, t.d / common}, .u = {}, .v = {}, .polygon = polygon};
  const bool along_x = size(t.n.x) >= size(t.n.y) && size(t.n.x) >= size(t.n.z);
  const bool along_y = !along_x && size(t.n.y) >= size(t.n.z);
  const LatticePoint* corner[3] = {&t.a, &t.b, &t.c};
  const bool turned = (along_x ? t.n.x : along_y ? t.n.y : t.n.z) < 0;
  if (turned) std::swap(corner[1], corner[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    const LatticePoint& p = *corner[k];
    flat.u[k] = along_x ? p.y : along_y ? p.z : p.x;
    flat.v[k] = along_x ? p.z : along_y ? p.x : p.y;
  }
  return flat;
}

/// Whether an edge of `a` has all of `b` on its outer side or on it.
bool separated_by_edge_of(const FlatTriangle& a, const FlatTriangle& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const std::int64_t du = a.u[next] - a.u[k], dv = a.v[next] - a.v[k];
    bool outside = true;
    for (std::size_t q = 0; q < 3; ++q) {
      if (du * (b.v[q] - a.v[k]) - dv * (b.u[q] - a.u[k]) > 0) outside = false;
    }
    if (outside) return true;
  }
  return false;
}

bool share_area(const FlatTriangle& a, const FlatTriangle& b) {
  return !separated_by_edge_of(a, b) && !separated_by_edge_of(b, a);
}

std::vector<FlatTriangle> flat_triangles(const Geometry& geometry) {
  std::vector<FlatTriangle> flat;
  for (std::uint32_t polygon = 0; polygon < geometry.cells.size(); ++polygon) {
    const PolygonTriangles& cell = geometry.cells[polygon];
    for (std::uint32_t k = 0; k < cell.count; ++k) {
      const Triangle& triangle = geometry.triangles[cell.first + k];
      if (triangle.n != LatticeVector{}) flat.push_back(flatten(triangle, polygon));
    }
  }
  return flat;
}

}  // namespace

std::uint64_t coplanar_overlaps(const Model& model) {
  std::vector<FlatTriangle> flat = flat_triangles(model.geometry);
  std::sort(flat.begin(), flat.end(), [](const FlatTriangle& a, const FlatTriangle& b) {
    return std::pair(a.plane, a.least_u()) < std::pair(b.plane, b.least_u());
  });
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const std::int64_t end = flat[i].most_u();
    for (std::size_t j = i + 1; j < flat.size() && flat[j].plane == flat[i].plane && flat[j].least_u() < end; ++j) {
      if (flat[i].polygon == flat[j].polygon || !share_area(flat[i], flat[j])) continue;
      pairs.insert(std::minmax(flat[i].polygon, flat[j].polygon));
    }
  }
  return pairs.size();
}

}  // namespace shodo
