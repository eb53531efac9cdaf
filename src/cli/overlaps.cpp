// Triangles are sorted by plane, then by their least x, y and z; within a plane a triangle is compared with those that
// start before it ends along its first axis, by separating edges. All numbers are integers of the lattice.
#include "cli/overlaps.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace shodo {

namespace {

constexpr double kFlat = 0x1p-31;  // of the scene: heights below it are rounding

/// A triangle in its plane's own two coordinates, counter-clockwise.
struct FlatTriangle {
  std::array<std::int64_t, 4> plane;  // N and D without their common divisor: equal for equal planes with equal fronts
  std::array<std::int64_t, 3> u, v;
  std::uint32_t polygon = 0;
  bool turned = false;  // faces down its axis

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

/// All that have an area; with `unsided`, those that lie in one plane are equal whichever way they face.
std::vector<FlatTriangle> flat_triangles(const Geometry& geometry, bool unsided) {
  std::vector<FlatTriangle> flat;
  for (std::uint32_t polygon = 0; polygon < geometry.cells.size(); ++polygon) {
    const PolygonTriangles& cell = geometry.cells[polygon];
    for (std::uint32_t k = 0; k < cell.count; ++k) {
      const Triangle& triangle = geometry.triangles[cell.first + k];
      if (triangle.n == LatticeVector{}) continue;
      FlatTriangle found = flatten(triangle, polygon);
      const bool turned = found.plane < std::array<std::int64_t, 4>{};
      if (unsided && turned) std::ranges::transform(found.plane, found.plane.begin(), std::negate{});
      found.turned = turned;
      flat.push_back(found);
    }
  }
  std::ranges::sort(flat, [](const FlatTriangle& a, const FlatTriangle& b) {
    return std::pair(a.plane, a.least_u()) < std::pair(b.plane, b.least_u());
  });
  return flat;
}

/// Pairs of polygons of which two triangles share area in a plane and `counts` says so.
template <class Counts>
std::uint64_t pairs_in_one_plane(const std::vector<FlatTriangle>& flat, Counts counts) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const std::int64_t end = flat[i].most_u();
    for (std::size_t j = i + 1; j < flat.size() && flat[j].plane == flat[i].plane && flat[j].least_u() < end; ++j) {
      if (flat[i].polygon == flat[j].polygon || !counts(flat[i], flat[j]) || !share_area(flat[i], flat[j])) continue;
      pairs.insert(std::minmax(flat[i].polygon, flat[j].polygon));
    }
  }
  return pairs.size();
}

/// A polygon as the file has it.
Piece piece_in_file(const Model& model, std::uint32_t polygon) {
  const Scene& scene = model.scene;
  const std::span<const std::uint32_t> first = model.geometry.first_cell;
  std::uint32_t m = static_cast<std::uint32_t>(scene.meshes.size()) - 1;
  while (first[m] > polygon) --m;
  return cell_piece(scene, scene.meshes[m], polygon - first[m]);
}

/// Whether b lies in front of a by more than rounding.
bool in_front(const Model& model, std::uint32_t a, std::uint32_t b) {
  const Piece piece = piece_in_file(model, a);
  const double height = dot(normalised(piece.vector_area()), piece_in_file(model, b).point(0.5, 0.5) - piece.corner[0]);
  return height > kFlat * model.scene.largest_half_extent();
}

}  // namespace

std::uint64_t coplanar_overlaps(const Model& model) {
  return pairs_in_one_plane(flat_triangles(model.geometry, false),
                            [](const FlatTriangle&, const FlatTriangle&) { return true; });
}

std::uint64_t merged_plates(const Model& model) {
  return pairs_in_one_plane(flat_triangles(model.geometry, true), [&](const FlatTriangle& a, const FlatTriangle& b) {
    return a.turned != b.turned && in_front(model, a.polygon, b.polygon) && in_front(model, b.polygon, a.polygon);
  });
}

}  // namespace shodo
