// Area and polyhedral lights: Lambertian faces (paper 2.1).
//
// E = pi L F: the form factor F to a face is Lambert's contour integral, exact at any distance; the part of it that
// arrives is that of fixed segments to points on the face, each weighted by its kernel cos cos / r^2, so that a point
// near the horizon counts little and penumbrae are smooth. Where some but not all segments to the light are blocked,
// four times as many take their place. Bytes: 72 a face that emits, one for an area light.
#pragma once

#include <cstdint>

#include "light/receiver.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "visibility/geometry.h"
#include "visibility/intersector.h"

namespace shodo {

/// A face that emits.
struct Emitter {
  Vec3 normal;       // unit
  double plane = 0;  // normal . corner
  std::uint32_t light = 0;
  std::uint32_t mesh = kNone;  // of a polyhedral light; kNone: the polygon of an area light
  std::uint32_t cell = 0;
  std::uint16_t concave = 0;  // of an area light: Piece::concave and Piece::cut
  std::uint16_t cut = 0;

  /// Scene units; positive in front.
  double height(const Vec3& point) const { return dot(normal, point) - plane; }
};
static_assert(sizeof(Emitter) == 48);

Emitter area_emitter(const Scene& scene, std::uint32_t light);
Emitter face_emitter(const Scene& scene, std::uint32_t light, std::uint32_t mesh, std::uint32_t cell);
Piece emitter_piece(const Scene& scene, const Emitter& emitter);

/// Around the ends of all segments that may be sent to the face.
LatticeBox ends_box(const Scene& scene, const Geometry& geometry, const Emitter& emitter);

/// Cuts of a face along an edge for the first segments, so that a light gets about 16: 4 for an area light; 2 for a
/// face of a polyhedron, 1 if it has many, twice that for a face that fills more than 1 % of the receiver's hemisphere.
std::uint32_t first_cuts(const Emitter& emitter, double factor, std::uint32_t faces);

/// What the segments to a face found.
struct Seen {
  double all = 0;      // sum of kernels; 0 if every point tried lies below the horizon
  double arrives = 0;  // of the segments not blocked
  bool some_blocked = false;
};

/// Sends cuts^2 segments, or as many fewer as end below the receiver's horizon; none if the aim is clear. `aim`: from
/// the sample to ends_box().
Seen look(const Scene& scene, const Geometry& geometry, Intersector& intersector, const Emitter& emitter,
          const Piece& piece, const Receiver& receiver, const Sample& sample, std::uint32_t cuts, const Aim& aim);

}  // namespace shodo
