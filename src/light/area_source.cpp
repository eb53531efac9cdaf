#include "light/area_source.h"

#include "light/piece_grid.h"
#include "scene/quad_shape.h"

namespace shodo {

namespace {

constexpr double kLargeFactor = 0.01;
constexpr std::uint32_t kManyFaces = 12;
constexpr std::uint32_t kMostCuts = 8;  // first_cuts(), and twice that

Emitter emitter_of(const Piece& piece, std::uint32_t light) {
  Emitter emitter;
  emitter.normal = normalised(piece.vector_area());
  emitter.plane = dot(emitter.normal, piece.corner[0]);
  emitter.light = light;
  return emitter;
}

/// Where the segment to a point of the face ends: odd, in front of the face.
LatticePoint segment_end(const Scene& scene, const Geometry& geometry, const Emitter& emitter, const Vec3& point) {
  if (emitter.mesh == kNone) return light_sample_point(scene, geometry, emitter.light, point);
  return sample_point(scene, geometry, emitter.mesh, emitter.cell, point);
}

Link link_to(const Scene& scene, const Receiver& receiver, const Emitter& emitter) {
  const std::uint32_t light = static_cast<std::uint32_t>(scene.objects.size()) + emitter.light;
  return {light, receiver.object, LightSet::kDirect};
}

}  // namespace

Emitter area_emitter(const Scene& scene, std::uint32_t light) {
  const Vec3* corner = scene.lights[light].corners;
  Piece piece;
  for (std::uint32_t k = 0; k < 4; ++k) piece.corner[k] = corner[k];
  Emitter emitter = emitter_of(piece, light);
  const QuadShape shape = quad_shape(corner);
  emitter.concave = shape == QuadShape::kCut13 ? 1 : 0;
  emitter.cut = shape == QuadShape::kCut13 || shape == QuadShape::kCut02 ? 1 : 0;
  return emitter;
}

Emitter face_emitter(const Scene& scene, std::uint32_t light, std::uint32_t mesh, std::uint32_t cell) {
  Emitter emitter = emitter_of(cell_piece(scene, scene.meshes[mesh], cell), light);
  emitter.mesh = mesh;
  emitter.cell = cell;
  return emitter;
}

Piece emitter_piece(const Scene& scene, const Emitter& emitter) {
  if (emitter.mesh != kNone) return cell_piece(scene, scene.meshes[emitter.mesh], emitter.cell);
  Piece piece;
  piece.concave = emitter.concave != 0;
  piece.cut = emitter.cut != 0;
  for (std::uint32_t k = 0; k < 4; ++k) piece.corner[k] = scene.lights[emitter.light].corners[k];
  return piece;
}

LatticeBox ends_box(const Scene& scene, const Geometry& geometry, const Emitter& emitter) {
  const Piece piece = emitter_piece(scene, emitter);
  LatticeBox box;
  for (std::uint32_t cuts = emitter.mesh == kNone ? 4 : 1; cuts <= kMostCuts; cuts *= 2) {
    const PieceGrid grid(piece, cuts);
    for (std::uint32_t k = 0; k < grid.count(); ++k) {
      box.include(segment_end(scene, geometry, emitter, grid.point(k)));
    }
  }
  return box;
}

std::uint32_t first_cuts(const Emitter& emitter, double factor, std::uint32_t faces) {
  if (emitter.mesh == kNone) return 4;
  return (faces >= kManyFaces ? 1 : 2) * (factor > kLargeFactor ? 2 : 1);
}

Seen look(const Scene& scene, const Geometry& geometry, Intersector& intersector, const Emitter& emitter,
          const Piece& piece, const Receiver& receiver, const Sample& sample, std::uint32_t cuts, const Aim& aim) {
  const PieceGrid grid(piece, cuts);
  const Link link = link_to(scene, receiver, emitter);
  Seen seen;
  for (std::uint32_t k = 0; k < grid.count(); ++k) {
    const Vec3 point = grid.point(k);
    const Vec3 way = point - sample.point;
    const double above = dot(receiver.normal, way);
    if (!(above > 0)) continue;
    const double squared = length_squared(way);
    const double kernel = grid.weight(k) * above * -dot(emitter.normal, way) / (squared * squared);
    if (!(kernel > 0)) continue;
    if (aim.clear()) return {kernel, kernel, false};  // all arrives, whatever the other kernels
    seen.all += kernel;
    if (intersector.blocked(sample.lattice, segment_end(scene, geometry, emitter, point), link, aim)) {
      seen.some_blocked = true;
    } else {
      seen.arrives += kernel;
    }
  }
  return seen;
}

}  // namespace shodo
