// What of a lamp is seen from a point, past what stands between, and how much of a lobe that fills
// (picture/highlight.h).
//
// From the point a lamp is a convex polygon of directions, and so is each triangle in the way. One by one these are cut
// off the polygon along their sides: what remains is a set of convex polygons, which nobody hides, or which panes
// weaken. So shadows have exact edges, in doubles; penumbrae are areas and no samples of them. Of the pieces that a
// triangle leaves the smallest goes on first, so that few wait at a time. Pieces below 2^-24 of the lamp are left out.
// Which triangles a piece can't meet boxes tell (lamp_frame.h).
//
// Candidates are found once for a lamp, in integers: what meets the hull of the point and the lamp's box
// (visibility/shaft.h) and lies neither behind the surface nor beyond the lamp. A triangle is before a lamp with an
// outline if it is in front of the plane of a face that is seen, and beyond it if it is behind all those, or outside
// one that isn't; if it is neither, or the lamp has no outline, faces are taken one by one, and the triangle counts
// where it is before the face's plane: the plane through the point and the line in which the two planes meet cuts the
// rest off.
// Bytes: 432 times kMostPieces.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/highlight_look.h"
#include "picture/lamp.h"
#include "picture/lamp_frame.h"
#include "picture/ray_tree.h"

namespace shodo {

class LampSight {
  struct Part {
    DirectionPolygon polygon;
    double light[3];     // of the light that arrives
    double size;         // of across(), squared
    std::uint32_t next;  // index of the first near triangle that hasn't been cut off
    CellBox box;
  };

 public:
  static constexpr std::uint32_t kMostPieces = 10;  // that wait at a time

  [[nodiscard]] bool start(const Scene& scene, const Geometry& geometry, const RayTree& tree, const Lamps& lamps,
                           Arena& arena);
  static constexpr std::uint64_t bytes() { return sizeof(Part) * kMostPieces; }

  /// Whether a triangle is in the way of no segment that starts on the surface's front: all of it lies behind, or it is
  /// an opening.
  bool passes_by(std::uint32_t triangle, const DrawnTriangle& surface) const;
  /// What a triangle lets through; false: nothing.
  bool weaken(std::uint32_t triangle, double (&arrives)[3]) const;

  /// All that may stand between a box of points before the surface and the lamp; `seen`: the faces that one of the
  /// points sees from their front, `turned`: those that none does, both of a lamp with an outline.
  void find_near(const Lamp& lamp, const DrawnTriangle& surface, const LatticeBox& from, Lamps::FaceSet seen,
                 Lamps::FaceSet turned, NearTriangles& near) const;

  /// Adds what is seen of a lamp with an outline, or of a face, in the lobe, for luminance 1. False if its pieces have
  /// no room.
  bool add_outline(const Lamp& lamp, const HighlightLook& look, Lamps::FaceSet seen, const NearTriangles& near,
                   double (&sum)[3]) const;
  bool add_face(const Lamp& lamp, const LampFace& face, const HighlightLook& look, const NearTriangles& near,
                double (&sum)[3]) const;

 private:
  struct Screen;
  struct Work;

  bool is_before(const Lamp& lamp, Lamps::FaceSet seen, const Vec3 (&corner)[3]) const;
  bool is_beyond(const Lamp& lamp, Lamps::FaceSet seen, Lamps::FaceSet turned, const Vec3 (&corner)[3]) const;
  bool screen_of(std::uint32_t triangle, const Work& work, Screen& screen) const;
  bool find_cut(const Work& work, Part& piece, Screen& screen) const;
  bool cut(const Screen& screen, const Work& work, std::uint32_t& count) const;
  static Vec3 across(const DirectionPolygon& polygon);
  static bool measure(Part& piece, const Work& work);
  bool add_polygon(Work& work, double (&sum)[3]) const;

  const Scene* scene_ = nullptr;
  const Geometry* geometry_ = nullptr;
  const RayTree* tree_ = nullptr;
  const Lamps* lamps_ = nullptr;
  std::span<Part> pieces_;  // room to work in, nothing is kept there
};

}  // namespace shodo
