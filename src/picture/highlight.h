// Highlights: what a glossy surface shows of the light sources, besides its map (paper 2.4; doc/optics.md).
//
// The lobe is Phong's, normalised (Lewis 1994): with the mirrored direction of view r, a light in direction l and the
// surface's normal N
//
//     L = k (n + 2) / (2 pi) sum of E (l.r)^n, E = illuminance of the surface by the light (N.l in it)
//
// so that a surface in a furnace sends at most k of what it gets. Point lights and suns are one direction. Area lights
// and faces of polyhedral ones are cut into cells that look smaller than one and a half of the lobe's width 1 / sqrt(n)
// and than 3/4 radian, with 2 x 2 Gauss points each. Whatever may stand between is found once for the point; if that
// is nothing, as mostly, no segment is tested. A few triangles hide parts of a parallelogram that are known exactly
// along 32 lines or more (face_shadow.h), and each Gauss point counts by what is seen of its quarter of a cell. Where
// panes are among them, or the face is no parallelogram, or many stand between, segments go to the points, and if some
// of these are seen and others not, the sum is taken again over 610 or more points of a Fibonacci lattice, no two in
// one row or column, so that an edge's shadow has as many shades.
// Exact: whether something stands between the surface and a light's point, or a pane. Approximate: a lobe ends where it
// is below 2^-20; an area light's sum over points.
// Doubles, as in direct light. Only where a lobe reaches a light. Bytes: 168 a face that emits, 32 an optics.
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
  /// between them and a light that they show, which is 8 times as far away as they are apart, and they are seen
  /// mirrored within a quarter of a lobe's width.
  bool even(std::uint32_t optics, const HighlightView& a, const HighlightView& b) const;

  /// Adds the luminance of a material's highlight, cd/m2.
  void add(std::uint32_t optics, const HighlightView& view, double (&luminance)[3]) const;

 private:
  struct Lobe {
    double strength = 0;   // k (n + 2) / (2 pi)
    double reach = 0;      // cosine of the angle at which it ends
    double width = 0;      // 1 / sqrt(n), at most 1/2
    double exponent = 0;
  };
  struct Look;
  struct Sum;
  struct Near;
  struct FaceView;

  Look look_from(std::uint32_t optics, const HighlightView& view) const;
  static double lobe_of(const Lobe& lobe, double squared);
  static double lobe_at(const Look& look, const Vec3& to_light);
  bool reaches(const Emitter& emitter, const Look& look) const;
  bool light_even(std::uint32_t light, const Look& a, const Look& b) const;
  bool face_even(const Emitter& emitter, const Look& a, const Look& b) const;
  bool passes_by(std::uint32_t triangle, const DrawnTriangle& surface) const;
  void find_near(const Emitter& emitter, const Look& look, const LatticeBox& from, Near& near) const;
  void add_point(std::uint32_t light, const Look& look, Sum& sum) const;
  void add_sun(std::uint32_t light, const Look& look, Sum& sum) const;
  void add_face(const Emitter& emitter, const Look& look, double (&luminance)[3]) const;
  void add_piece(const Emitter& emitter, const Piece& piece, double wanted, const Look& look, const Near& near,
                 double (&luminance)[3]) const;
  void add_cells(const FaceView& face, std::uint32_t cells, const Near& near, double (&luminance)[3]) const;
  double lobe_lux(const FaceView& face, double s, double t, double area) const;
  void add_at(const FaceView& face, double s, double t, double area, const Near& near, Sum& sum) const;
  void add_light(std::uint32_t light, double lx, const Ray& ray, bool ends, Sum& sum) const;
  void add_past(const Near& near, std::uint32_t light, double lx, const Ray& ray, Sum& sum) const;
  bool weaken(std::uint32_t triangle, double (&arrives)[3]) const;

  const Scene* scene_ = nullptr;
  const Geometry* geometry_ = nullptr;
  const RayTree* tree_ = nullptr;
  std::span<Lobe> lobes_;     // per optics
  std::span<Emitter> faces_;  // lights ascending
};

}  // namespace shodo
