#include "light/emitter.h"

#include "light/piece_grid.h"
#include "scene/quad_shape.h"

namespace shodo {

namespace {

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

/// A quarter's ends by distance from the border, in 32nds of the side, odd: every column and every row of a quarter has
/// one, and so has each of its own quarters two.
PieceGrid::Parameter even_end(std::uint32_t quarter, std::uint32_t k) {
  constexpr double kPlace[kManyInQuarter][2] = {{5, 11}, {11, 5}, {3, 13}, {13, 3}, {1, 7}, {7, 1}, {9, 15}, {15, 9}};
  const double s = kPlace[k][0] / 32, t = kPlace[k][1] / 32;
  return {(quarter & 1) == 0 ? s : 1 - s, (quarter >> 1) == 0 ? t : 1 - t};
}

/// End k of an area light: two of each quarter at a time.
PieceGrid::Parameter area_end(std::uint32_t end) {
  const std::uint32_t pair = end / kFewEnds, in_pairs = end % kFewEnds;
  return even_end(in_pairs / kFewInQuarter, pair * kFewInQuarter + in_pairs % kFewInQuarter);
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

/// An end is lifted by so many steps at most.
constexpr std::int32_t kLift = 16;

/// Above `height` over the plane, by steps of 2 along the largest component of its normal; false if it takes too many.
bool lift(const Triangle& plane, std::int64_t height, LatticePoint& end) {
  const auto magnitude = [](std::int64_t x) { return x < 0 ? -x : x; };
  const std::int64_t x = magnitude(plane.n.x), y = magnitude(plane.n.y), z = magnitude(plane.n.z);
  std::int32_t& at = x >= y && x >= z ? end.x : y >= z ? end.y : end.z;
  const std::int64_t n = x >= y && x >= z ? plane.n.x : y >= z ? plane.n.y : plane.n.z;
  for (std::int32_t lifted = 0; plane.side(end) <= height; lifted += 2) {
    if (lifted == kLift) return false;
    at += n > 0 ? 2 : -2;
  }
  return true;
}

/// Corners of neighbours may lie a step or two above a face, by rounding: ends are lifted above them.
void find_own_height(const Geometry& geometry, std::span<LatticePoint> ends, std::uint32_t object, Emitter& emitter) {
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
    LatticePoint lifted = end;
    if (!lift(plane, emitter.own_height, lifted)) return;
  }
  emitter.box = {};
  for (LatticePoint& end : ends) {
    lift(plane, emitter.own_height, end);
    emitter.box.include(end);
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

bool own_facets_miss(const Geometry& geometry, const Emitter& emitter, const LatticeBox& samples) {
  if (emitter.own_triangle == kNone) return false;
  const Triangle& plane = geometry.triangles[emitter.own_triangle];
  const LatticePoint lowest{plane.n.x > 0 ? samples.low[0] : samples.high[0],
                            plane.n.y > 0 ? samples.low[1] : samples.high[1],
                            plane.n.z > 0 ? samples.low[2] : samples.high[2]};
  return own_facets_miss(geometry, emitter, lowest);
}

bool own_facets_miss(const Geometry& geometry, const Emitter& emitter, const LatticePoint& sample) {
  if (emitter.own_triangle == kNone) return false;
  return geometry.triangles[emitter.own_triangle].side(sample) > emitter.own_height;
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
    const PieceGrid::Parameter at = emitter.is_area() ? area_end(k) : grid.gauss(k);
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
