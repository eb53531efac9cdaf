#include "light/emitter.h"

#include "light/piece_grid.h"
#include "scene/quad_shape.h"

namespace shodo {

namespace {

/// A light this many times as long as wide has two rows of ends; one row from the second on.
constexpr double kLong = 3;
constexpr double kVeryLong = 8;
/// Lattice steps, so many at both: ends stand less than that off their points, and so do the corners' own.
constexpr std::int32_t kEndRounding = 2 * kMostMoved;

Emitter emitter_of(const Piece& piece, std::uint32_t light) {
  Emitter emitter;
  const Vec3 vector_area = piece.vector_area();
  emitter.normal = normalised(vector_area);
  emitter.plane = dot(emitter.normal, piece.corner[0]);
  emitter.centre = piece.centre();
  emitter.area = length(vector_area);
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    const double reach = length(piece.corner[k] - emitter.centre);
    if (reach > emitter.radius) emitter.radius = reach;
  }
  emitter.light = light;
  return emitter;
}

/// A quarter's ends by distance from the border: of the few in eighths of the side, of the many in 32nds, odd: every
/// column and every row of a quarter has one, and so has each of its own quarters two.
PieceGrid::Parameter even_end(std::uint32_t quarter, std::uint32_t k) {
  constexpr double kFew[kFewInQuarter][2] = {{1, 3}, {3, 1}};
  constexpr double kMany[kManyInQuarter][2] = {{7, 13}, {13, 7}, {1, 5}, {5, 1}, {3, 9}, {9, 3}, {11, 15}, {15, 11}};
  const bool few = k < kFewInQuarter;
  const double s = few ? kFew[k][0] / 8 : kMany[k - kFewInQuarter][0] / 32;
  const double t = few ? kFew[k][1] / 8 : kMany[k - kFewInQuarter][1] / 32;
  return {(quarter & 1) == 0 ? s : 1 - s, (quarter >> 1) == 0 ? t : 1 - t};
}

/// Of a long one, along the longer side: quarters follow each other, with two rows or, very long, with one. The second
/// half of the light mirrors the first.
PieceGrid::Parameter long_end(std::uint32_t quarter, std::uint32_t k, bool very) {
  constexpr std::uint32_t kOne[kManyInQuarter] = {2, 5, 0, 1, 3, 4, 6, 7};  // the first two are spread, too
  constexpr std::uint32_t kTwo[kManyInQuarter / 2] = {1, 0, 2, 3};
  const bool few = k < kFewInQuarter, mirrored = quarter >= 2;
  const std::uint32_t from_end = mirrored ? 3 - quarter : quarter, count = few ? kFewInQuarter : kManyInQuarter;
  const std::uint32_t columns = very ? count : count / 2;
  const std::uint32_t n = few ? k : very ? kOne[k - kFewInQuarter] : kTwo[(k - kFewInQuarter) / 2];
  const std::uint32_t column = very || !few ? n : 0;
  const double across = very ? 0.5 : k % 2 == 0 ? 0.25 : 0.75;
  const double along = (from_end * columns + column + 0.5) / (4.0 * columns);
  return {mirrored ? 1 - along : along, across};
}

/// End k of an area light: the few of each quarter, then the many of each.
PieceGrid::Parameter area_end(const Piece& piece, std::uint32_t end) {
  const bool few = end < kFewEnds;
  const std::uint32_t in_set = few ? end : end - kFewEnds, in_quarter = few ? kFewInQuarter : kManyInQuarter;
  const std::uint32_t quarter = in_set / in_quarter, k = in_set % in_quarter + (few ? 0 : kFewInQuarter);
  const Vec3* c = piece.corner;
  const double side_s = length(c[1] - c[0]) + length(c[2] - c[3]), side_t = length(c[3] - c[0]) + length(c[2] - c[1]);
  const double longer = side_s > side_t ? side_s : side_t, shorter = side_s > side_t ? side_t : side_s;
  if (longer < kLong * shorter || piece.cut) return even_end(quarter, k);
  const PieceGrid::Parameter at = long_end(quarter, k, longer >= kVeryLong * shorter);
  return side_s > side_t ? at : PieceGrid::Parameter{at.t, at.s};
}

}  // namespace

Emitter area_emitter(const Scene& scene, std::uint32_t light) {
  const Vec3* corner = scene.lights[light].corners;
  Piece piece;
  for (std::uint32_t k = 0; k < 4; ++k) piece.corner[k] = corner[k];
  const QuadShape shape = quad_shape(corner);
  piece.concave = shape == QuadShape::kCut13;
  piece.cut = piece.concave || shape == QuadShape::kCut02;
  Emitter emitter = emitter_of(piece, light);
  emitter.concave = piece.concave ? 1 : 0;
  emitter.cut = piece.cut ? 1 : 0;
  emitter.end_count = kAreaEnds;
  return emitter;
}

Emitter face_emitter(const Scene& scene, std::uint32_t light, std::uint32_t mesh, std::uint32_t cell) {
  Emitter emitter = emitter_of(cell_piece(scene, scene.meshes[mesh], cell), light);
  emitter.mesh = mesh;
  emitter.cell = cell;
  emitter.end_count = kFaceEnds;
  return emitter;
}

Piece emitter_piece(const Scene& scene, const Emitter& emitter) {
  if (!emitter.is_area()) return cell_piece(scene, scene.meshes[emitter.mesh], emitter.cell);
  Piece piece;
  piece.concave = emitter.concave != 0;
  piece.cut = emitter.cut != 0;
  for (std::uint32_t k = 0; k < 4; ++k) piece.corner[k] = scene.lights[emitter.light].corners[k];
  return piece;
}

LatticePoint segment_end(const Scene& scene, const Geometry& geometry, const Emitter& emitter, const Vec3& point) {
  if (emitter.front.flat()) return emitter.front.move(odd_point(geometry.lattice, point));
  if (emitter.is_area()) return light_sample_point(scene, geometry, emitter.light, point);
  return sample_point(scene, geometry, emitter.mesh, emitter.cell, point);
}

namespace {

/// Of larger polyhedra finding the heights takes longer than they save.
constexpr std::uint32_t kMostTriangles = 512;

void find_own_height(const Geometry& geometry, std::span<const LatticePoint> ends, std::uint32_t object,
                     Emitter& emitter) {
  const std::uint32_t triangle = geometry.cells[geometry.first_cell[emitter.mesh] + emitter.cell].first;
  const Triangle& plane = geometry.triangles[triangle];
  if (plane.object != object || plane.n == LatticeVector{}) return;
  std::uint32_t count = 0;
  for (const Triangle& t : geometry.triangles) {
    if (t.object != object) continue;
    if (++count > kMostTriangles) return;
    for (const LatticePoint* corner : {&t.a, &t.b, &t.c}) {
      const std::int64_t height = plane.side(*corner);
      if (height > emitter.own_height) emitter.own_height = height;
    }
  }
  for (const LatticePoint& end : ends) {
    if (plane.side(end) <= emitter.own_height) return;
  }
  emitter.own_triangle = triangle;
}

/// Any point of the face may be an end: see FaceLight. Each is rounded and moved in front of the face on its own, so
/// the box grows by that but where it is flat.
void include_corners(const Scene& scene, const Geometry& geometry, const Piece& piece, Emitter& emitter) {
  LatticeBox& whole = emitter.whole;
  whole = emitter.box;
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    whole.include(segment_end(scene, geometry, emitter, piece.corner[k]));
  }
  for (int k = 0; k < 3; ++k) {
    if (whole.low[k] >= whole.high[k]) continue;
    whole.low[k] -= kEndRounding;
    whole.high[k] += kEndRounding;
  }
}

}  // namespace

bool own_facets_miss(const Geometry& geometry, const Emitter& emitter, std::span<const LatticePoint> samples) {
  if (emitter.own_triangle == kNone) return false;
  const Triangle& plane = geometry.triangles[emitter.own_triangle];
  for (const LatticePoint& sample : samples) {
    if (plane.side(sample) <= emitter.own_height) return false;
  }
  return true;
}

void place_ends(const Scene& scene, const Geometry& geometry, Emitters& emitters, std::uint32_t e,
                std::uint32_t first_end) {
  Emitter& emitter = emitters.faces[e];
  emitter.first_end = first_end;
  emitter.front = emitter.is_area() ? flat_front(scene, geometry, emitter.light)
                                    : flat_front(geometry, emitter.mesh, emitter.cell);
  const Piece piece = emitter_piece(scene, emitter);
  const PieceGrid grid(piece, 1);
  for (std::uint32_t k = 0; k < emitter.end_count; ++k) {
    const PieceGrid::Parameter at = emitter.is_area() ? area_end(piece, k)
                                    : k > 0           ? grid.gauss(k - 1)
                                    : piece.corners == 3 ? PieceGrid::Parameter{1.0 / 3, 1.0 / 3}
                                                         : PieceGrid::Parameter{0.5, 0.5};
    EmitterEnd& end = emitters.ends[first_end + k];
    end = {grid.point_at(at), grid.weight_at(at)};
    emitters.lattice_ends[first_end + k] = segment_end(scene, geometry, emitter, end.point);
    emitter.box.include(emitters.lattice_ends[first_end + k]);
  }
  if (emitter.is_area()) {
    include_corners(scene, geometry, piece, emitter);
  } else if (geometry.cells[geometry.first_cell[emitter.mesh] + emitter.cell].count > 0) {
    const std::uint32_t object = scene.meshes[emitter.mesh].object;
    find_own_height(geometry, emitters.lattice_ends.subspan(first_end, emitter.end_count), object, emitter);
  }
}

}  // namespace shodo
