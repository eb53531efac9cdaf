#include "picture/lamp.h"

namespace shodo {

namespace {

constexpr double kFlat = 1e-4;            // of a lamp's radius
constexpr double kPlane = 1e-9;           // of a quadrilateral's diagonals, how far from flat it may be
constexpr std::int32_t kEndMargin = 4;    // lattice steps by which ends of segments may be off
constexpr std::int32_t kEndOff = 16;      // more than mending moves a corner
constexpr std::uint32_t kMostOutline = 16;
constexpr std::uint8_t kOpen = 255;

std::uint32_t face_count_of(const Scene& scene, const Light& light) {
  if (light.kind == LightKind::kArea) return 1;
  if (light.kind != LightKind::kPolyhedron) return 0;
  const Object& object = scene.objects[light.object];
  std::uint32_t count = 0;
  for (std::uint32_t m = 0; m < object.mesh_count; ++m) count += cell_count(scene.meshes[object.first_mesh + m]);
  return count;
}

struct Counts {
  std::size_t lamps = 0, faces = 0, corners = 0, edges = 0;
};

Counts counts_of(const Scene& scene) {
  Counts counts;
  bool any = false;
  for (const Optics& optics : scene.optics) any = any || optics.highlight > 0;
  if (!any) return counts;
  for (const Light& light : scene.lights) {
    const std::uint32_t faces = face_count_of(scene, light);
    if (faces == 0) continue;
    ++counts.lamps;
    counts.faces += faces;
    if (light.kind != LightKind::kPolyhedron || faces > kMostLampFaces) continue;
    counts.corners += faces + 2;
    counts.edges += 2 * faces;
  }
  return counts;
}

LatticeBox around(const LatticePoint& p) {
  return {{p.x - kEndMargin - kEndOff, p.y - kEndMargin - kEndOff, p.z - kEndMargin - kEndOff},
          {p.x + kEndMargin + kEndOff, p.y + kEndMargin + kEndOff, p.z + kEndMargin + kEndOff}};
}

/// The sphere and the box.
void find_bounds(const Scene& scene, const Geometry& geometry, std::span<const LampFace> faces, Lamp& lamp) {
  Vec3 sum;
  for (const LampFace& face : faces) sum = sum + lamp_piece(scene, lamp, face).centre();
  lamp.centre = (1.0 / lamp.face_count) * sum;
  for (const LampFace& face : faces) {
    const Piece piece = lamp_piece(scene, lamp, face);
    for (std::uint32_t k = 0; k < piece.corners; ++k) {
      const double reach = length(piece.corner[k] - lamp.centre);
      if (reach > lamp.radius) lamp.radius = reach;
      lamp.whole.include(around(odd_point(geometry.lattice, piece.corner[k])));
    }
  }
}

}  // namespace

Piece lamp_piece(const Scene& scene, const Lamp& lamp, const LampFace& face) {
  if (face.mesh != kNone) return cell_piece(scene, scene.meshes[face.mesh], face.cell);
  return emitter_piece(scene, area_emitter(scene, lamp.light));
}

/// A quadrilateral is cut where it is concave, or not flat.
PiecePart piece_part(const Piece& piece, std::uint32_t part) {
  const Vec3* const c = piece.corner;
  if (piece.corners == 3) return part == 0 ? PiecePart{{c[0], c[1], c[2]}, 3} : PiecePart{};
  const Vec3 across = c[2] - c[0], other = c[3] - c[1], normal = cross(across, other);
  const bool flat = magnitude(dot(normal, c[1] - c[0])) <= kPlane * length(normal) * (length(across) + length(other));
  if (flat && !piece.concave && !piece.cut) {
    return part == 0 ? PiecePart{{c[0], c[1], c[2], c[3]}, 4} : PiecePart{};
  }
  const std::uint32_t k = piece.concave ? 1 : 0;
  if (part == 0) return {{c[k], c[k + 1], c[k + 2]}, 3};
  return {{c[k], c[k + 2], c[(k + 3) % 4]}, 3};
}

bool Lamps::start(const Scene& scene, const Geometry& geometry, Arena& arena) {
  const Counts counts = counts_of(scene);
  if (!arena.take("lamps that highlights show", counts.lamps, lamps_) ||
      !arena.take("faces of lamps", counts.faces, faces_) ||
      !arena.take("corners of lamps", counts.corners, corners_) ||
      !arena.take("edges of lamps", counts.edges, edges_)) {
    return false;
  }
  faces_used_ = corners_used_ = edges_used_ = 0;
  std::size_t next = 0;
  for (std::uint32_t l = 0; l < scene.lights.size() && next < lamps_.size(); ++l) {
    const Light& light = scene.lights[l];
    if (face_count_of(scene, light) == 0) continue;
    Lamp& lamp = lamps_[next++] = {};
    lamp.light = l;
    lamp.first_face = faces_used_;
    if (light.kind == LightKind::kArea) {
      add_face(area_emitter(scene, l), lamp);
    } else {
      const Object& object = scene.objects[light.object];
      for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
        const std::uint32_t cells = cell_count(scene.meshes[m]);
        for (std::uint32_t cell = 0; cell < cells; ++cell) add_face(face_emitter(scene, l, m, cell), lamp);
      }
    }
    find_bounds(scene, geometry, faces(lamp), lamp);
    if (light.kind == LightKind::kPolyhedron) find_outline(scene, lamp);
  }
  return true;
}

std::uint64_t Lamps::bytes(const Scene& scene) {
  const Counts counts = counts_of(scene);
  const auto block = [](std::uint64_t bytes) { return (bytes + 7) / 8 * 8; };
  return sizeof(Lamp) * counts.lamps + sizeof(LampFace) * counts.faces + sizeof(Vec3) * counts.corners +
         block(sizeof(Edge) * counts.edges);
}

void Lamps::add_face(const Emitter& emitter, Lamp& lamp) {
  faces_[faces_used_++] = {emitter.normal, emitter.plane, emitter.mesh, emitter.cell};
  ++lamp.face_count;
}

/// Leaves the lamp without edges if it isn't closed and convex.
void Lamps::find_outline(const Scene& scene, Lamp& lamp) {
  if (lamp.face_count > kMostLampFaces) return;
  lamp.first_corner = corners_used_;
  lamp.first_edge = edges_used_;
  std::uint32_t corners = 0;
  bool fits = true;
  for (std::uint32_t f = 0; f < lamp.face_count && fits; ++f) {
    fits = add_corners(lamp_piece(scene, lamp, faces(lamp)[f]), f, lamp, corners);
  }
  if (!fits || !closed_and_convex(lamp, corners)) {
    lamp.edge_count = 0;
    return;
  }
  corners_used_ += corners;
  edges_used_ += lamp.edge_count;
}

/// A face's corners that weren't there yet, and its edges.
bool Lamps::add_corners(const Piece& piece, std::uint32_t face, Lamp& lamp, std::uint32_t& corners) {
  if (piece.concave || piece.cut) return false;
  std::uint32_t at[4];
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    if (!(magnitude(faces(lamp)[face].height(piece.corner[k])) <= kFlat * lamp.radius)) return false;
    Vec3* const known = &corners_[lamp.first_corner];
    for (at[k] = 0; at[k] < corners && known[at[k]] != piece.corner[k]; ++at[k]) {
    }
    if (at[k] < corners) continue;
    if (corners == lamp.face_count + 2) return false;  // Euler: of a closed one with faces of up to 4 corners
    known[corners++] = piece.corner[k];
  }
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    if (!add_edge(at[k], at[(k + 1) % piece.corners], face, lamp)) return false;
  }
  return true;
}

bool Lamps::add_edge(std::uint32_t from, std::uint32_t to, std::uint32_t face, Lamp& lamp) {
  if (from == to) return false;
  for (Edge& edge : edges_.subspan(lamp.first_edge, lamp.edge_count)) {
    if (edge.from == from && edge.to == to) return false;
    if (edge.from != to || edge.to != from) continue;
    if (edge.right != kOpen) return false;
    edge.right = static_cast<std::uint8_t>(face);
    return true;
  }
  if (lamp.edge_count == 2 * lamp.face_count) return false;
  edges_[lamp.first_edge + lamp.edge_count++] = {static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(to),
                                                 static_cast<std::uint8_t>(face), kOpen};
  return true;
}

bool Lamps::closed_and_convex(const Lamp& lamp, std::uint32_t corners) const {
  for (const Edge& edge : edges_.subspan(lamp.first_edge, lamp.edge_count)) {
    if (edge.right == kOpen) return false;
  }
  for (const LampFace& face : faces(lamp)) {
    for (const Vec3& corner : corners_.subspan(lamp.first_corner, corners)) {
      if (!(face.height(corner) <= kFlat * lamp.radius)) return false;
    }
  }
  return true;
}

Lamps::FaceSet Lamps::seen_from(const Lamp& lamp, const Vec3& point) const {
  FaceSet seen = 0;
  if (!lamp.has_outline() && lamp.face_count != 1) return seen;
  const std::span<const LampFace> all = faces(lamp);
  for (std::size_t f = 0; f < all.size(); ++f) {
    if (all[f].height(point) > 0) seen |= FaceSet{1} << f;
  }
  return seen;
}

/// Edges one after another: each begins where one ends. From its front a face goes counter-clockwise, which from the
/// point is clockwise, so edges go from end to start.
bool Lamps::outline(const Lamp& lamp, FaceSet seen, const Vec3& point, DirectionPolygon& polygon) const {
  polygon.count = 0;
  std::uint8_t from[kMostOutline], to[kMostOutline];
  std::uint32_t count = 0;
  for (const Edge& edge : edges_.subspan(lamp.first_edge, lamp.edge_count)) {
    const bool left = (seen >> edge.left & 1) != 0, right = (seen >> edge.right & 1) != 0;
    if (left == right) continue;
    if (count == kMostOutline) return false;
    from[count] = left ? edge.to : edge.from;
    to[count++] = left ? edge.from : edge.to;
  }
  if (count == 0) return true;
  std::uint8_t at = from[0];
  for (std::uint32_t used = 0; used < count; ++used) {
    std::uint32_t k = 0;
    while (k < count && from[k] != at) ++k;
    if (k == count || !polygon.push(corners_[lamp.first_corner + at] - point)) return false;
    at = to[k];
    if (at == from[0] && used + 1 < count) return false;  // two outlines, by rounding
  }
  return at == from[0];
}

}  // namespace shodo
