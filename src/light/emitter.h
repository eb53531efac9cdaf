// Faces that emit: area lights and the faces of polyhedral ones, with the points on them at which segments end (paper
// 2.1).
//
// The points are fixed, so they are placed once and not for each sub-patch. A face of a polyhedron has its four
// Gauss points, lifted above all of the polyhedron if a step or two will do, so that no facet of its own is in the
// way. An area light has 32 ends, eight in each quarter, for the centre of a sub-patch; its other samples look at
// two of each quarter, the first or the second two. No two of them but mirror images share a column or a row: a
// shadow edge along a side is met by the 32 as finely as by 16 x 16 points, along a long light's narrow side too.
// Each set is mapped on itself by every mirror image of the face: a mirrored scene has mirrored light. Bytes: 168 a
// face that emits, and 44 a point: 32 an area light, 4 a face of a polyhedron.
#pragma once

#include <cstdint>
#include <span>

#include "scene/mesh.h"
#include "scene/scene.h"
#include "visibility/geometry.h"
#include "visibility/lattice_box.h"

namespace shodo {

inline constexpr std::uint32_t kQuarters = 4;
inline constexpr std::uint32_t kFewInQuarter = 2;
inline constexpr std::uint32_t kManyInQuarter = 8;
inline constexpr std::uint32_t kFewEnds = kQuarters * kFewInQuarter;
inline constexpr std::uint32_t kAreaEnds = kQuarters * kManyInQuarter;
inline constexpr std::uint32_t kFaceEnds = 4;  // the Gauss points

/// Ends of an area light, a bit each: all 32, the first 8, or the second 8.
using EndSet = std::uint32_t;
inline constexpr EndSet kAllEnds = 0xFFFFFFFF, kFirstEnds = 0xFF, kSecondEnds = 0xFF00;

struct Emitter {
  Vec3 normal;       // unit
  double plane = 0;  // normal . corner
  Vec3 centre;
  double area = 0;
  double radius = 0;  // of the sphere about the centre that holds the corners
  std::uint32_t light = 0;
  std::uint32_t mesh = kNone;  // of a polyhedral light; kNone: the polygon of an area light
  std::uint32_t cell = 0;
  std::uint16_t concave = 0;  // of an area light: Piece::concave and Piece::cut
  std::uint16_t cut = 0;
  std::uint32_t first_end = 0;
  std::uint32_t end_count = 0;
  FlatFront front;  // on the lattice
  // Of a polyhedron's face the plane of one of its triangles, and the height over it, in Triangle::side(), below which
  // all of the polyhedron lies and above which all ends do: then no segment that starts above, too, meets it.
  std::uint32_t own_triangle = kNone;  // kNone: there is no such height
  std::int64_t own_height = 0;
  LatticeBox box;    // around the ends
  LatticeBox whole;  // around all its points, of an area light

  bool is_area() const { return mesh == kNone; }
  /// Scene units; positive in front.
  double height(const Vec3& point) const { return dot(normal, point) - plane; }
};
static_assert(sizeof(Emitter) == 168);

/// Where segments to a face end.
struct EmitterEnd {
  Vec3 point;         // scene units
  double weight = 1;  // share of the area, up to a factor common to the face
};

/// All faces that emit, and their ends.
struct Emitters {
  std::span<Emitter> faces;
  std::span<EmitterEnd> ends;
  std::span<LatticePoint> lattice_ends;  // odd, in front of the face
};

Emitter area_emitter(const Scene& scene, std::uint32_t light);
Emitter face_emitter(const Scene& scene, std::uint32_t light, std::uint32_t mesh, std::uint32_t cell);
Piece emitter_piece(const Scene& scene, const Emitter& emitter);

/// Where the segment to a point of the face ends: odd, in front of the face.
LatticePoint segment_end(const Scene& scene, const Geometry& geometry, const Emitter& emitter, const Vec3& point);

/// Whether no segment from samples in this box to the face's ends is blocked by a facet of the face's own polyhedron.
bool own_facets_miss(const Geometry& geometry, const Emitter& emitter, const LatticeBox& samples);
/// The same for one sample.
bool own_facets_miss(const Geometry& geometry, const Emitter& emitter, const LatticePoint& sample);

/// Fills the ends of emitters.faces[e] from `first_end` on, and its box.
void place_ends(const Scene& scene, const Geometry& geometry, Emitters& emitters, std::uint32_t e,
                std::uint32_t first_end);

}  // namespace shodo
