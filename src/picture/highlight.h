// Highlights: what a glossy surface shows of the light sources, besides its map (paper 2.4; doc/optics.md).
//
// The lobe is Phong's, normalised (lobe.h): with the mirrored direction of view r, a light in direction l and the
// surface's normal N
//
//     L = k (n + 2) / (2 pi) sum of E (l.r)^n, E = illuminance of the surface by the light (N.l in it)
//
// so that a surface in a furnace sends at most k of what it gets. Point lights and suns are one direction. Lamps, that
// is area lights and polyhedra, are polygons of directions, over which the lobe is summed along their edges: convex
// polyhedra by their outline, others face by face (lamp.h). What stands between is cut off the polygon or, a pane,
// weakens a part of it (lamp_sight.h); where more stands between than has room there, 610 segments or more go to points
// of the faces, those of a Fibonacci lattice, no two in one row or column, so that an edge's shadow has as many shades.
// Whether the lobe reaches a lamp at all, the sphere around it tells first, and what a lamp can show at most.
// Exact: what can stand between the surface and a lamp or a point; what does between it and a point light or a sun.
// Approximate: lobe.h's sums; a lobe ends where it is below 2^-20, or a lamp would show as less than 1/4 display step.
// Doubles, as in direct light. Only where a lobe reaches a light. Bytes: 40 an optics, lamp.h's, lamp_sight.h's.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/highlight_look.h"
#include "picture/lamp.h"
#include "picture/lamp_sight.h"
#include "picture/ray_tree.h"
#include "scene/scene.h"
#include "visibility/geometry.h"

namespace shodo {

/// A point of a surface that is looked at.
struct HighlightView {
  const DrawnTriangle* drawn;
  LatticePoint point;      // in front of it
  LatticeVector mirrored;  // direction of view after reflection
};

class Highlights {
 public:
  /// `scene` is on the display of PictureOptics::display_of().
  [[nodiscard]] bool start(const Scene& scene, const Geometry& geometry, const RayTree& tree, Arena& arena);
  static std::uint64_t bytes(const Scene& scene);

  /// Whether highlights at points between two of a plane go on as between two lobes of neighbours: nothing comes
  /// between them and a point light or sun that they show; a light is 8 times as far away as they are apart; what may
  /// come between them and a lamp is so far away that from one to the other it moves by a quarter of a lobe's width
  /// at most, and so does the mirrored direction of view.
  /// `lamps`: what add() said of one of them.
  bool even(std::uint32_t optics, const HighlightView& a, const HighlightView& b, bool lamps) const;

  /// Adds the luminance of a material's highlight, cd/m2; whether a lamp would show if nothing stood between.
  bool add(std::uint32_t optics, const HighlightView& view, double (&luminance)[3]) const;

 private:
  /// Luminance, while segments find what arrives.
  using Sum = double[3];

  HighlightLook look_from(std::uint32_t optics, const HighlightView& view) const;
  static double lobe_at(const HighlightLook& look, const Vec3& to_light);
  double luminance_of(const Lamp& lamp, const Vec3& point) const;
  double most_luminance_of(const Lamp& lamp, const Vec3& point) const;
  bool reaches(const Lamp& lamp, const HighlightLook& look) const;
  bool light_even(std::uint32_t light, const HighlightLook& a, const HighlightLook& b) const;
  bool lamp_even(const Lamp& lamp, const HighlightLook& a, const HighlightLook& b) const;
  void add_point(std::uint32_t light, const HighlightLook& look, Sum& sum) const;
  void add_sun(std::uint32_t light, const HighlightLook& look, Sum& sum) const;
  bool add_lamp(const Lamp& lamp, const HighlightLook& look, Sum& luminance) const;
  double unshadowed(const Lamp& lamp, const HighlightLook& look, Lamps::FaceSet seen) const;
  bool add_seen(const Lamp& lamp, const HighlightLook& look, Lamps::FaceSet seen, const NearTriangles& near,
                Sum& sum) const;
  void add_points(const Lamp& lamp, const HighlightLook& look, Sum& luminance) const;
  void add_points(const Lamp& lamp, const LampFace& face, const HighlightLook& look, Sum& sum) const;
  void add_segment(std::uint32_t light, double shown, const Ray& ray, bool ends, Sum& sum) const;

  const Scene* scene_ = nullptr;
  const Geometry* geometry_ = nullptr;
  const RayTree* tree_ = nullptr;
  std::span<Lobe> lobes_;  // per optics
  Lamps lamps_;
  LampSight sight_;
};

}  // namespace shodo
