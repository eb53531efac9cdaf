#include "scene/mesh.h"

#include "scene/quad_shape.h"

namespace shodo {

namespace {

/// a at t = 0 and b at t = 1, both exactly.
Vec3 mix(const Vec3& a, const Vec3& b, double t) { return (1 - t) * a + t * b; }

Vec3 bilinear(const Vec3* corner, double s, double t) {
  return mix(mix(corner[0], corner[1], s), mix(corner[3], corner[2], s), t);
}

/// Affine on the two triangles 0-1-2 and 0-2-3; exact at the corners, and on edges the same bits as bilinear().
Vec3 cut_from_0_to_2(const Vec3* corner, double s, double t) {
  if (s >= t) return (1 - s) * corner[0] + (s - t) * corner[1] + t * corner[2];
  return (1 - t) * corner[0] + s * corner[2] + (t - s) * corner[3];
}

/// Affine on the two triangles 0-1-3 and 1-2-3; as above.
Vec3 cut_from_1_to_3(const Vec3* corner, double s, double t) {
  if (s + t <= 1) return (1 - s - t) * corner[0] + s * corner[1] + t * corner[3];
  return (1 - t) * corner[1] + (s + t - 1) * corner[2] + (1 - s) * corner[3];
}

double ratio(std::uint32_t part, std::uint32_t whole) { return static_cast<double>(part) / static_cast<double>(whole); }

/// Piece (u, v) of a cell divided du x dv times.
Piece part_of(const Piece& cell, std::uint32_t u, std::uint32_t v, std::uint32_t du, std::uint32_t dv) {
  const double s0 = ratio(u, du), s1 = ratio(u + 1, du), t0 = ratio(v, dv), t1 = ratio(v + 1, dv);
  Piece part;
  part.concave = cell.concave;
  part.cut = cell.cut;
  part.corner[0] = cell.point(s0, t0);
  part.corner[1] = cell.point(s1, t0);
  part.corner[2] = cell.point(s1, t1);
  part.corner[3] = cell.point(s0, t1);
  return part;
}

Piece part_of_triangle(const Piece& whole, std::uint32_t k, const PieceIndex& index) {
  const auto at = [&](std::uint32_t u, std::uint32_t v) { return whole.point(ratio(u, k), ratio(v, k)); };
  const std::uint32_t u = index.u, v = index.v;
  Piece part;
  part.corners = 3;
  part.corner[0] = index.inverted ? at(u + 1, v + 1) : at(u, v);
  part.corner[1] = index.inverted ? at(u, v + 1) : at(u + 1, v);
  part.corner[2] = index.inverted ? at(u + 1, v) : at(u, v + 1);
  part.corner[3] = part.corner[2];
  return part;
}

Piece piece_of(const Scene& scene, const Mesh& mesh, const PieceIndex& index, std::uint32_t width,
               std::uint32_t height) {
  const std::uint32_t per_cell_u = width / mesh.cells_u, per_cell_v = height / mesh.cells_v;
  const std::uint32_t cell = (index.v / per_cell_v) * mesh.cells_u + index.u / per_cell_u;
  const Piece whole = cell_piece(scene, mesh, cell);
  if (mesh.kind == MeshKind::kTriangle) return part_of_triangle(whole, width, index);
  // A grid's cell runs v(c,r), v(c,r+1), v(c+1,r+1), v(c+1,r): its first parameter is the mesh's v.
  if (mesh.kind == MeshKind::kGrid) {
    return part_of(whole, index.v % per_cell_v, index.u % per_cell_u, per_cell_v, per_cell_u);
  }
  return part_of(whole, index.u, index.v, per_cell_u, per_cell_v);
}

}  // namespace

Vec3 Piece::point(double s, double t) const {
  if (corners == 3) return (1 - s - t) * corner[0] + s * corner[1] + t * corner[2];
  if (concave) return cut_from_1_to_3(corner, s, t);
  return cut ? cut_from_0_to_2(corner, s, t) : bilinear(corner, s, t);
}

Vec3 Piece::centre() const { return corners == 3 ? point(1.0 / 3, 1.0 / 3) : point(0.5, 0.5); }

Vec3 Piece::vector_area() const {
  if (corners == 3) return 0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]);
  return 0.5 * cross(corner[2] - corner[0], corner[3] - corner[1]);
}

double Piece::longest_side() const {
  double longest = 0;
  for (std::uint32_t k = 0; k < corners; ++k) {
    const double side = length(corner[(k + 1) % corners] - corner[k]);
    if (side > longest) longest = side;
  }
  return longest;
}

PieceIndex triangle_piece(std::uint32_t k, std::uint32_t local) {
  std::uint32_t v = 0;
  while (local >= 2 * (k - v) - 1) {
    local -= 2 * (k - v) - 1;
    ++v;
  }
  return {local / 2, v, local % 2 == 1};
}

std::uint32_t triangle_piece_order(std::uint32_t k, const PieceIndex& index) {
  return index.v * (2 * k - index.v) + 2 * index.u + (index.inverted ? 1 : 0);
}

PieceIndex patch_index(const Mesh& mesh, std::uint32_t local) {
  if (mesh.kind == MeshKind::kTriangle) return triangle_piece(mesh.nu, local);
  return {local % mesh.nu, local / mesh.nu, false};
}

PieceIndex sub_patch_index(const Mesh& mesh, std::uint32_t local) {
  const std::uint32_t width = mesh.map_width();
  if (mesh.kind == MeshKind::kTriangle) return triangle_piece(width, local);
  return {local % width, local / width, false};
}

Piece patch_piece(const Scene& scene, const Mesh& mesh, std::uint32_t local) {
  return piece_of(scene, mesh, patch_index(mesh, local), mesh.nu, mesh.nv);
}

Piece sub_patch_piece(const Scene& scene, const Mesh& mesh, std::uint32_t local) {
  return piece_of(scene, mesh, sub_patch_index(mesh, local), mesh.map_width(), mesh.map_height());
}

std::uint32_t patch_of_sub_patch(const Mesh& mesh, std::uint32_t local_sub_patch) {
  const PieceIndex sub = sub_patch_index(mesh, local_sub_patch);
  if (mesh.kind != MeshKind::kTriangle) return (sub.v / mesh.sv) * mesh.nu + sub.u / mesh.su;
  const std::uint32_t in_u = sub.u % mesh.su, in_v = sub.v % mesh.su;
  // Above the hypotenuse of its upright patch a piece belongs to the inverted one.
  const bool beyond = in_u + in_v + (sub.inverted ? 1 : 0) >= mesh.su;
  return triangle_piece_order(mesh.nu, {sub.u / mesh.su, sub.v / mesh.su, beyond});
}

std::uint32_t cell_count(const Mesh& mesh) { return mesh.cells_u * mesh.cells_v; }

Piece cell_piece(const Scene& scene, const Mesh& mesh, std::uint32_t cell) {
  const Vec3* vertex = &scene.vertices[mesh.first_vertex];
  Piece piece;
  if (mesh.kind == MeshKind::kGrid) {
    const std::uint32_t columns = mesh.cells_u + 1;
    const Vec3* v = vertex + (cell / mesh.cells_u) * columns + cell % mesh.cells_u;
    piece.corner[0] = v[0];
    piece.corner[1] = v[columns];
    piece.corner[2] = v[columns + 1];
    piece.corner[3] = v[1];
    if (mesh.cut) {
      const QuadShape shape = quad_shape(piece.corner);
      piece.concave = shape == QuadShape::kCut13;
      piece.cut = piece.concave || shape == QuadShape::kCut02;
    }
    return piece;
  }
  piece.corners = mesh.kind == MeshKind::kTriangle ? 3 : 4;
  piece.concave = mesh.concave;
  piece.cut = mesh.cut;
  for (std::uint32_t k = 0; k < 4; ++k) piece.corner[k] = vertex[k < piece.corners ? k : 2];
  return piece;
}

std::uint32_t cell_of_patch(const Mesh& mesh, std::uint32_t local_patch) {
  if (mesh.kind != MeshKind::kGrid) return 0;
  const PieceIndex index = patch_index(mesh, local_patch);
  return index.v / (mesh.nv / mesh.cells_v) * mesh.cells_u + index.u / (mesh.nu / mesh.cells_u);
}

Piece plane_piece(const Plane& plane) {
  Piece piece;
  for (std::uint32_t k = 0; k < 4; ++k) piece.corner[k] = plane.corners[k];
  return piece;
}

Piece plane_sub_patch(const Plane& plane, std::uint32_t local) {
  const Piece whole = plane_piece(plane);
  const std::uint32_t u = local % plane.width(), v = local / plane.width();
  Piece piece;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t i = u + (k == 1 || k == 2 ? 1 : 0), j = v + (k >= 2 ? 1 : 0);
    piece.corner[k] = whole.point(static_cast<double>(i) / plane.width(), static_cast<double>(j) / plane.height());
  }
  return piece;
}

}  // namespace shodo
