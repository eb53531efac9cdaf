#include "ambient/sub_patch_finder.h"

#include "base/elementary.h"
#include "scene/mesh.h"

namespace shodo {

namespace {

constexpr double kFlat = 1e-6;  // of a side: a parallelogram but for so much

/// Parameters on a piece, as Piece::point() takes them.
struct Parameters {
  double s, t;
};

/// Seen along an axis.
struct Flat {
  double y, z;
};
double area(const Flat& a, const Flat& b) { return a.y * b.z - a.z * b.y; }

/// Of a point in the plane of corner, corner + s, corner + t.
Parameters affine_parameters(const Vec3& off, const Vec3& s, const Vec3& t) {
  const Vec3 n = cross(s, t);
  const double squared = length_squared(n);
  if (!(squared > 0)) return {0.5, 1};  // a half without an area: on the other one
  return {dot(off, cross(t, n)) / squared, dot(off, cross(n, s)) / squared};
}

/// On a piece that is cut into two halves, each affine.
Parameters cut_parameters(const Piece& piece, const Vec3& at) {
  const Vec3* c = piece.corner;
  if (piece.concave) {
    const Parameters p = affine_parameters(at - c[0], c[1] - c[0], c[3] - c[0]);
    if (p.s + p.t <= 1) return p;
    const Parameters q = affine_parameters(at - c[2], c[3] - c[2], c[1] - c[2]);
    return {1 - q.s, 1 - q.t};
  }
  const Parameters p = affine_parameters(at - c[0], c[1] - c[0], c[2] - c[1]);
  if (p.s >= p.t) return p;
  return affine_parameters(at - c[0], c[2] - c[3], c[3] - c[0]);
}

/// As seen along the axis to which the piece is most nearly square; of a plane one that is exact.
Parameters bilinear_parameters(const Piece& piece, const Vec3& at) {
  const Vec3* c = piece.corner;
  const Vec3 front = piece.vector_area();
  const double x = magnitude(front.x), y = magnitude(front.y), z = magnitude(front.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const auto seen = [&](const Vec3& v) {
    if (axis == 0) return Flat{v.y, front.x < 0 ? -v.z : v.z};
    if (axis == 1) return Flat{v.z, front.y < 0 ? -v.x : v.x};
    return Flat{v.x, front.z < 0 ? -v.y : v.y};
  };
  // off = s along_s + t along_t + s t bend: without s a quadratic equation for t, of which the first root is on the
  // piece.
  const Flat along_s = seen(c[1] - c[0]), along_t = seen(c[3] - c[0]), off = seen(at - c[0]);
  const Flat bend = seen((c[2] - c[3]) - (c[1] - c[0]));
  const double whole = area(along_s, along_t), bent = area(bend, along_t);
  const double linear = area(off, bend) + whole, constant = area(along_s, off);
  const double square = linear * linear + 4 * bent * constant;
  const double t = 2 * constant / (linear + square_root(square > 0 ? square : 0));
  return {area(off, along_t) / (whole + t * bent), t};
}

bool is_linear(const Piece& piece) {
  if (piece.corners == 3) return true;
  const Vec3 gap = (piece.corner[0] - piece.corner[1]) + (piece.corner[2] - piece.corner[3]);
  const double least = kFlat * piece.longest_side();
  return length_squared(gap) <= least * least;
}

/// Map coordinates, 32.32.
struct MapPoint {
  std::int64_t u, v;
};

/// Sub-patch of a row or column.
std::uint32_t part(std::int64_t at, std::uint32_t count) {
  const std::int32_t whole = static_cast<std::int32_t>(at >> 32);
  if (whole < 0) return 0;
  return static_cast<std::uint32_t>(whole) < count ? static_cast<std::uint32_t>(whole) : count - 1;
}

std::uint32_t sub_patch_at(const Mesh& mesh, const MapPoint& at) {
  const std::uint32_t width = mesh.map_width();
  if (mesh.kind != MeshKind::kTriangle) return part(at.v, mesh.map_height()) * width + part(at.u, width);
  const std::uint32_t row = part(at.v, width), column = part(at.u, width - row);
  const std::int64_t beyond = at.u + at.v - (std::int64_t{column + row + 1} << 32);
  return triangle_piece_order(width, {column, row, beyond > 0 && column + row + 1 < width});
}

/// In 2^-32, within what 32 bits hold.
std::int32_t scaled_slope(double slope) {
  const double scaled = slope * 0x1p32;
  return scaled >= 0x1p31 ? INT32_MAX : scaled <= -0x1p31 ? INT32_MIN : static_cast<std::int32_t>(scaled);
}

/// Of 2^right. Sums wrap around where parts of them don't fit; they themselves do.
std::int32_t wrapped_dot(const std::int32_t (&slope)[3], std::int32_t x, std::int32_t y, std::int32_t z, int right) {
  const std::uint64_t all = static_cast<std::uint64_t>(product(slope[0], x)) +
                            static_cast<std::uint64_t>(product(slope[1], y)) +
                            static_cast<std::uint64_t>(product(slope[2], z));
  return static_cast<std::int32_t>(static_cast<std::int64_t>(all) >> right);
}

/// Of a mesh: sub-patches in one of its cells, and the cell's first.
struct CellPlace {
  std::uint32_t in_u, in_v, first_u, first_v;
  bool turned;  // the cell's first edge runs along v

  CellPlace(const Mesh& mesh, std::uint32_t cell) {
    turned = mesh.kind == MeshKind::kGrid;
    const std::uint32_t width = mesh.nu * mesh.su, height = mesh.nv * mesh.sv;
    const std::uint32_t columns = turned ? mesh.cells_u : 1, rows = turned ? mesh.cells_v : 1;
    in_u = width / columns;
    in_v = height / rows;
    first_u = in_u * (cell % columns);
    first_v = in_v * (cell / columns);
  }
};

}  // namespace

std::uint64_t SubPatchFinder::bytes(const Geometry& geometry) {
  return (sizeof(Cell) * geometry.cells.size() + 7) / 8 * 8 + (4 * geometry.triangles.size() + 7) / 8 * 8;
}

bool SubPatchFinder::take(const Scene& scene, const Geometry& geometry, Arena& arena) {
  scene_ = &scene;
  geometry_ = &geometry;
  if (!arena.take("polygons that lines cross", geometry.cells.size(), cells_) ||
      !arena.take("polygons of triangles", geometry.triangles.size(), cell_of_)) {
    return false;
  }
  for (std::uint32_t& cell : cell_of_) cell = kNone;
  for (std::uint32_t k = 0; k < geometry.cells.size(); ++k) {
    const PolygonTriangles& polygon = geometry.cells[k];
    for (std::uint32_t t = 0; t < polygon.count; ++t) cell_of_[polygon.first + t] = k;
  }
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    for (std::uint32_t k = 0; k < cell_count(scene.meshes[m]); ++k) fill(m, k, cells_[geometry.first_cell[m] + k]);
  }
  return true;
}

void SubPatchFinder::fill(std::uint32_t m, std::uint32_t number, Cell& cell) const {
  const Mesh& mesh = scene_->meshes[m];
  const Piece piece = cell_piece(*scene_, mesh, number);
  cell.mesh = m;
  cell.linear = is_linear(piece) ? 1 : 0;
  if (cell.linear == 0) return;
  const Vec3 s = piece.corner[1] - piece.corner[0], t = piece.corner[piece.corners == 3 ? 2 : 3] - piece.corner[0];
  const Vec3 n = cross(s, t);
  const double squared = length_squared(n), over = squared > 0 ? geometry_->lattice.step() / squared : 0;
  const Vec3 along_s = over * cross(t, n), along_t = over * cross(n, s);
  const CellPlace place(mesh, number);
  const auto set = [](std::uint32_t count, const Vec3& along, std::int32_t (&slope)[3]) {
    slope[0] = scaled_slope(count * along.x);
    slope[1] = scaled_slope(count * along.y);
    slope[2] = scaled_slope(count * along.z);
  };
  set(place.in_u, place.turned ? along_t : along_s, cell.along_u);
  set(place.in_v, place.turned ? along_s : along_t, cell.along_v);
  cell.corner = even_point(geometry_->lattice, piece.corner[0]);
  cell.first_u = place.first_u;
  cell.first_v = place.first_v;
}

SubPatchFinder::Found SubPatchFinder::find(std::uint32_t triangle, const LatticePoint& at) const {
  const std::uint32_t number = cell_of_[triangle];
  if (number == kNone) return {};
  const Cell& cell = cells_[number];
  const Mesh& mesh = scene_->meshes[cell.mesh];
  if (cell.linear == 0) return {cell.mesh, find_bent(mesh, number - geometry_->first_cell[cell.mesh], at)};
  const std::int32_t x = at.x - cell.corner.x, y = at.y - cell.corner.y, z = at.z - cell.corner.z;
  const auto along = [&](const std::int32_t (&slope)[3], std::uint32_t first) {
    return product(slope[0], x) + product(slope[1], y) + product(slope[2], z) + (std::int64_t{first} << 32);
  };
  return {cell.mesh, sub_patch_at(mesh, {along(cell.along_u, cell.first_u), along(cell.along_v, cell.first_v)})};
}

bool SubPatchFinder::start(std::uint32_t triangle, const LatticePoint& at, const LatticePoint& way, Walk& walk) const {
  const std::uint32_t number = cell_of_[triangle];
  if (number == kNone) return false;
  const Cell& cell = cells_[number];
  const Mesh& mesh = scene_->meshes[cell.mesh];
  const CellPlace place(mesh, number - geometry_->first_cell[cell.mesh]);
  walk = {};
  if (place.in_u == 1 && place.in_v == 1) {
    walk.first_ = mesh.first_sub_patch + place.first_v * mesh.map_width() + place.first_u;
    return true;
  }
  constexpr std::uint32_t kMost = 1 << 14;  // 16.16
  if (cell.linear == 0 || mesh.kind == MeshKind::kTriangle || place.in_u > kMost || place.in_v > kMost) return false;
  walk.along_u_ = wrapped_dot(cell.along_u, way.x, way.y, way.z, 32 - Walk::kBits + kWayBits);
  walk.along_v_ = wrapped_dot(cell.along_v, way.x, way.y, way.z, 32 - Walk::kBits + kWayBits);
  walk.in_u_ = static_cast<std::uint16_t>(place.in_u);
  walk.in_v_ = static_cast<std::uint16_t>(place.in_v);
  walk.width_ = mesh.map_width();
  walk.first_ = mesh.first_sub_patch + place.first_v * walk.width_ + place.first_u;
  go_on(triangle, at, walk);
  return true;
}

void SubPatchFinder::go_on(std::uint32_t triangle, const LatticePoint& at, Walk& walk) const {
  if (walk.in_u_ == 1 && walk.in_v_ == 1) return;
  const Cell& cell = cells_[cell_of_[triangle]];
  const std::int32_t x = at.x - cell.corner.x, y = at.y - cell.corner.y, z = at.z - cell.corner.z;
  walk.u_ = wrapped_dot(cell.along_u, x, y, z, 32 - Walk::kBits);
  walk.v_ = wrapped_dot(cell.along_v, x, y, z, 32 - Walk::kBits);
}

std::uint32_t SubPatchFinder::find_bent(const Mesh& mesh, std::uint32_t number, const LatticePoint& at) const {
  const Piece piece = cell_piece(*scene_, mesh, number);
  const Vec3 point = scene_point(geometry_->lattice, at);
  const Parameters p = piece.cut || piece.concave ? cut_parameters(piece, point) : bilinear_parameters(piece, point);
  const CellPlace place(mesh, number);
  const auto along = [](double parameter, std::uint32_t count, std::uint32_t first) {
    const double inside = parameter > 0 ? parameter < 1 ? parameter * count : count : 0;  // not a number: 0
    return static_cast<std::int64_t>((inside + first) * 0x1p32);
  };
  return sub_patch_at(mesh, {along(place.turned ? p.t : p.s, place.in_u, place.first_u),
                             along(place.turned ? p.s : p.t, place.in_v, place.first_v)});
}

}  // namespace shodo
