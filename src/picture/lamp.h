// Lamps as highlights show them: area and polyhedral lights, and their outlines from a point (picture/highlight.h).
//
// All faces of a lamp have one luminance, so the inner edges of what is seen of it cancel in a sum over edges (lobe.h):
// of a convex polyhedron only the outline counts, the edges between a face that is seen from its front and one that is
// not. Whether a polyhedron is closed and convex is found once, from the file's coordinates: each edge belongs to
// two faces, each face is flat and all corners lie behind it, to 1e-4 of the radius. Other lamps go face by face.
// Exact: which faces are seen, but for rounding. Bytes: 80 a lamp, 40 a face, and of a polyhedron of up to 64 faces 32
// a face and 48 (corners and edges).
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/emitter.h"
#include "picture/direction_polygon.h"
#include "scene/scene.h"
#include "visibility/geometry.h"

namespace shodo {

inline constexpr std::uint32_t kMostLampFaces = 64;  // of a lamp with an outline

struct LampFace {
  Vec3 normal;       // unit
  double plane = 0;  // normal . corner
  std::uint32_t mesh = kNone, cell = 0;  // kNone: of an area light

  double height(const Vec3& point) const { return dot(normal, point) - plane; }
};

struct Lamp {
  Vec3 centre;
  double radius = 0;  // of the sphere about the centre that holds all corners
  LatticeBox whole;   // all points at which segments end
  std::uint32_t light = 0;
  std::uint32_t first_face = 0, face_count = 0;
  std::uint32_t first_corner = 0, first_edge = 0, edge_count = 0;  // no edges: it has no outline

  bool has_outline() const { return edge_count != 0; }
};

class Lamps {
 public:
  /// Which faces of a lamp with an outline, a bit each.
  using FaceSet = std::uint64_t;

  [[nodiscard]] bool start(const Scene& scene, const Geometry& geometry, Arena& arena);
  static std::uint64_t bytes(const Scene& scene);

  std::span<const Lamp> lamps() const { return lamps_; }
  std::span<const LampFace> faces(const Lamp& lamp) const { return faces_.subspan(lamp.first_face, lamp.face_count); }

  /// Those that are seen from their front, of a lamp with an outline or one face.
  FaceSet seen_from(const Lamp& lamp, const Vec3& point) const;
  /// The polygon that they fill, from there; false if it has too many corners.
  bool outline(const Lamp& lamp, FaceSet seen, const Vec3& point, DirectionPolygon& polygon) const;

 private:
  struct Edge {  // of the face `left` it goes from one corner to the other
    std::uint8_t from, to, left, right;
  };

  void add_face(const Emitter& emitter, Lamp& lamp);
  void find_outline(const Scene& scene, Lamp& lamp);
  bool add_corners(const Piece& piece, std::uint32_t face, Lamp& lamp, std::uint32_t& corners);
  bool add_edge(std::uint32_t from, std::uint32_t to, std::uint32_t face, Lamp& lamp);
  bool closed_and_convex(const Lamp& lamp, std::uint32_t corners) const;

  std::span<Lamp> lamps_;
  std::span<LampFace> faces_;
  std::span<Vec3> corners_;
  std::span<Edge> edges_;
  std::uint32_t faces_used_ = 0, corners_used_ = 0, edges_used_ = 0;
};

/// Of a lamp's face.
Piece lamp_piece(const Scene& scene, const Lamp& lamp, const LampFace& face);

/// The corners of a convex part of it, and whether there is such a part: 0, 1.
struct PiecePart {
  Vec3 corner[4];
  std::uint32_t corners = 0;
};
PiecePart piece_part(const Piece& piece, std::uint32_t part);

}  // namespace shodo
