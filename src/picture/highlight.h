// Highlights: what a glossy surface shows of the light sources, besides its map (paper 2.4; doc/optics.md).
//
// The lobe is Phong's, normalised (Lewis 1994): with the mirrored direction of view r, a light in direction l and the
// surface's normal N
//
//     L = k (n + 2) / (2 pi) sum of E (l.r)^n, E = illuminance of the surface by the light (N.l in it)
//
// so that a surface in a furnace sends at most k of what it gets. Point lights and suns are one direction. Area lights
// and faces of polyhedral ones are cut into cells that look smaller than the lobe's width 1 / sqrt(n) and than half a
// radian, with 2 x 2 Gauss points each. Where some of these are seen and others not, the sum is taken again over 610 or
// more points of a Fibonacci lattice, no two in one row or column, so that an edge's shadow has as many shades.
// Exact: whether something stands between the surface and a light's point, or a pane. Approximate: a lobe ends where it
// is below 2^-20; an area light's sum over points.
// Doubles, as in direct light. Only where a lobe reaches a light. Bytes: 168 a face that emits, 24 an optics.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/emitter.h"
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
  [[nodiscard]] bool start(const Scene& scene, const Geometry& geometry, const RayTree& tree, Arena& arena);
  static std::uint64_t bytes(const Scene& scene);

  /// Whether highlights at points between two of a plane go on as between two lobes of neighbours: nothing comes
  /// between them and a light that they show, and they are seen mirrored within a quarter of a lobe's width.
  bool even(std::uint32_t optics, const HighlightView& a, const HighlightView& b) const;

  /// Adds the luminance of a material's highlight, cd/m2.
  void add(std::uint32_t optics, const HighlightView& view, double (&luminance)[3]) const;

 private:
  struct Lobe {
    double strength = 0;   // k (n + 2) / (2 pi)
    double reach = 0;      // cosine of the angle at which it ends
    double width = 0;      // 1 / sqrt(n), at most 1/2
  };
  struct Look;
  struct Sum;

  double lobe_at(const Look& look, const Vec3& to_light) const;
  void add_point(std::uint32_t light, const Look& look, Sum& sum) const;
  void add_sun(std::uint32_t light, const Look& look, Sum& sum) const;
  void add_face(const Emitter& emitter, const Look& look, double (&luminance)[3]) const;
  void add_piece(const Emitter& emitter, const Piece& piece, double wanted, const Look& look,
                 double (&luminance)[3]) const;
  void add_at(const Emitter& emitter, const Piece& piece, double s, double t, double area, const Look& look,
              Sum& sum) const;
  void add_light(std::uint32_t light, double lx, const Ray& ray, bool ends, Sum& sum) const;

  const Scene* scene_ = nullptr;
  const Geometry* geometry_ = nullptr;
  const RayTree* tree_ = nullptr;
  std::span<Lobe> lobes_;     // per optics
  std::span<Emitter> faces_;  // lights ascending
};

}  // namespace shodo
