#include "picture/lamp_sight.h"

#include "visibility/shaft.h"

namespace shodo {

namespace {

constexpr double kLeastPiece = 0x1p-24;  // of the whole: what is smaller is left out
constexpr double kPoint = 1e-12;         // of the square of an angle
constexpr std::int32_t kMargin = 4;  // lattice steps by which corners on the lattice are off the file's

/// The hull of two boxes, against triangles too.
struct Hull {
  Shaft shaft;
  bool misses(const LatticeBox& box) { return shaft.misses(box); }
  bool misses(const DrawnTriangle& triangle) {
    LatticeBox box;
    for (const LatticePoint& p : triangle.vertex) box.include(p);
    return shaft.misses(box);
  }
};

}  // namespace

/// The directions in which a triangle stands in the way: those with side[k].u > 0 for all k.
struct LampSight::Screen {
  Vec3 corner[3];
  Vec3 side[4];
  std::uint32_t count = 0;

  /// Whether a side of one has all of the other beyond it.
  bool is_beside(const DirectionPolygon& polygon) const {
    for (std::uint32_t k = 0; k < count; ++k) {
      if (beyond(polygon, side[k])) return true;
    }
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
      const Vec3 &a = polygon.corner[k], &b = polygon.corner[k + 1 < polygon.count ? k + 1 : 0], inner = cross(a, b);
      if (dot(inner, corner[0]) > 0 || dot(inner, corner[1]) > 0 || dot(inner, corner[2]) > 0) continue;
      // The plane of an edge that is nearly a point, as cuts leave them, is mere rounding.
      if (length_squared(inner) > kPoint * (length_squared(a) * length_squared(b))) return true;
    }
    return false;
  }
};

struct LampSight::Work {
  Work(const HighlightLook& look, const NearTriangles& near, const LampFace* face)
      : look(look), near(near), face(face) {}

  const HighlightLook& look;
  NearTriangles near;
  const LampFace* face;  // null: all triangles are before the lamp
  double least_size = 0;  // of a piece
  LampFrame frame;
  CellBox box[kMostNear];  // of triangles
};

bool LampSight::start(const Scene& scene, const Geometry& geometry, const RayTree& tree, const Lamps& lamps,
                      Arena& arena) {
  scene_ = &scene;
  geometry_ = &geometry;
  tree_ = &tree;
  lamps_ = &lamps;
  return lamps.lamps().empty() || arena.take("pieces of lamps", kMostPieces, pieces_);
}

bool LampSight::passes_by(std::uint32_t t, const DrawnTriangle& surface) const {
  const DrawnTriangle& drawn = geometry_->drawn[t];
  if (drawn.light != kNone && (drawn.light >= scene_->lights.size() || scene_->lights[drawn.light].open)) return true;
  for (const LatticePoint& p : drawn.vertex) {
    if (side_of(surface, p) > 0) return false;
  }
  return true;
}

bool LampSight::weaken(std::uint32_t t, double (&arrives)[3]) const {
  const DrawnTriangle& drawn = geometry_->drawn[t];
  const Optics* const optics =
      drawn.mesh == kNone ? nullptr : scene_->optics_of(scene_->meshes[drawn.mesh].material);
  if (optics == nullptr || !optics->transmits()) return false;
  for (std::uint32_t c = 0; c < 3; ++c) arrives[c] *= optics->transmit.c[c];
  return true;
}

bool LampSight::is_before(const Lamp& lamp, Lamps::FaceSet seen, const Vec3 (&corner)[3]) const {
  const double margin = kMargin * geometry_->lattice.step();
  const std::span<const LampFace> faces = lamps_->faces(lamp);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if ((seen >> f & 1) == 0) continue;
    bool before = true;
    for (const Vec3& p : corner) before = before && faces[f].height(p) >= -margin;
    if (before) return true;
  }
  return false;
}

bool LampSight::is_beyond(const Lamp& lamp, Lamps::FaceSet seen, Lamps::FaceSet turned, const Vec3 (&corner)[3]) const {
  const double margin = kMargin * geometry_->lattice.step();
  const std::span<const LampFace> faces = lamps_->faces(lamp);
  bool behind_all = true;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    bool behind = true, outside = true;
    for (const Vec3& p : corner) {
      const double height = faces[f].height(p);
      behind = behind && height <= margin;
      outside = outside && height >= -margin;
    }
    if (outside && (turned >> f & 1) != 0) return true;
    behind_all = behind_all && (behind || (seen >> f & 1) == 0);
  }
  return behind_all;
}

void LampSight::find_near(const Lamp& lamp, const DrawnTriangle& surface, const LatticeBox& from, Lamps::FaceSet seen,
                          Lamps::FaceSet turned, NearTriangles& near) const {
  Hull hull{Shaft(from, lamp.whole)};
  const Light& light = scene_->lights[lamp.light];
  const bool area = light.kind == LightKind::kArea, outline = area || lamp.has_outline();
  tree_->visit_in(hull, [&](std::uint32_t t) {
    const DrawnTriangle& drawn = geometry_->drawn[t];
    if (area && drawn.light == lamp.light) return true;
    if (lamp.has_outline() && drawn.mesh != kNone && scene_->meshes[drawn.mesh].object == light.object) return true;
    if (passes_by(t, surface)) return true;
    if (outline) {
      Vec3 corner[3];
      for (std::size_t k = 0; k < 3; ++k) corner[k] = scene_point(geometry_->lattice, drawn.vertex[k]);
      if (is_beyond(lamp, seen, turned, corner)) return true;
      near.crossing = near.crossing || !is_before(lamp, seen, corner);
    }
    if (near.count < kMostNear) near.triangle[near.count] = t;
    return ++near.count <= kMostNear;
  });
}

/// False if it hides nothing. Corners from the point, in scene units.
bool LampSight::screen_of(std::uint32_t t, const Work& work, Screen& screen) const {
  const DrawnTriangle& drawn = geometry_->drawn[t];
  const std::int64_t side = side_of(drawn, work.look.from);
  if (side == 0) return false;  // from its edge
  const double step = geometry_->lattice.step(), sign = side > 0 ? -1 : 1;
  Vec3(&v)[3] = screen.corner;
  for (std::size_t k = 0; k < 3; ++k) v[k] = step * vector_of(drawn.vertex[k] - work.look.from);
  for (std::size_t k = 0; k < 3; ++k) screen.side[k] = sign * cross(v[k], v[(k + 1) % 3]);
  screen.count = 3;
  if (work.face == nullptr) return true;
  const LampFace& face = *work.face;
  const double above = face.height(work.look.point), margin = kMargin * step;
  bool before = true, behind = true;
  for (const Vec3& p : v) {
    const double height = dot(face.normal, p) + above;
    before = before && height >= -margin;
    behind = behind && height <= margin;
  }
  if (behind) return false;
  if (before) return true;
  // u meets the triangle's plane n.x = h first, the face's f.x = -above after it: above n.u + h f.u > 0.
  const Vec3 n = sign * cross(v[1] - v[0], v[2] - v[0]);
  screen.side[screen.count++] = above * n + dot(n, v[0]) * face.normal;
  return true;
}

/// The next triangle that cuts a piece; false if nothing does any more.
bool LampSight::find_cut(const Work& work, Part& piece, Screen& screen) const {
  for (; piece.next < work.near.count; ++piece.next) {
    if (piece.box.apart(work.box[piece.next])) continue;
    if (screen_of(work.near.triangle[piece.next], work, screen) && !screen.is_beside(piece.polygon)) return true;
  }
  return false;
}

/// Puts what a screen leaves of the last piece in its place, the largest part first; `count` follows. False if there is
/// no room.
bool LampSight::cut(const Screen& screen, const Work& work, std::uint32_t& count) const {
  const std::uint32_t first = count - 1;
  Part& here = pieces_[first];
  double behind[3] = {here.light[0], here.light[1], here.light[2]};
  const bool opaque = !weaken(work.near.triangle[here.next++], behind);
  for (std::uint32_t k = 0; k < screen.count; ++k) {
    if (count == kMostPieces) return false;
    Part& outside = pieces_[count];
    // Of what is opaque only the outside of the last side is left.
    const bool last = opaque && k + 1 == screen.count;
    if (!split(here.polygon, last ? -screen.side[k] : screen.side[k], outside.polygon)) return false;
    if (last) break;
    outside.next = here.next;
    for (std::uint32_t c = 0; c < 3; ++c) outside.light[c] = here.light[c];
    if (measure(outside, work)) ++count;
  }
  for (std::uint32_t c = 0; c < 3 && !opaque; ++c) here.light[c] = behind[c];
  if (!measure(here, work)) here = pieces_[--count];
  for (std::uint32_t k = first + 1; k < count; ++k) {
    for (std::uint32_t at = k; at > first && pieces_[at].size > pieces_[at - 1].size; --at) {
      const Part other = pieces_[at];
      pieces_[at] = pieces_[at - 1];
      pieces_[at - 1] = other;
    }
  }
  return true;
}

/// Twice the area's vector of what it is a piece of, seen from the point.
Vec3 LampSight::across(const DirectionPolygon& polygon) {
  Vec3 sum;
  for (std::uint32_t k = 0; k < polygon.count; ++k) {
    sum = sum + cross(polygon.corner[k], polygon.corner[k + 1 < polygon.count ? k + 1 : 0]);
  }
  return sum;
}

/// Whether it is large enough to be looked at.
bool LampSight::measure(Part& piece, const Work& work) {
  piece.size = length_squared(across(piece.polygon));
  if (!(piece.size > work.least_size)) return false;
  piece.box = work.frame.box({piece.polygon.corner, piece.polygon.count});
  return true;
}

/// Of the polygon of pieces_[0], which the surface's plane may cut.
bool LampSight::add_polygon(Work& work, double (&sum)[3]) const {
  Part& whole = pieces_[0];
  if (!split(whole.polygon, work.look.normal, pieces_[1].polygon)) return false;
  if (whole.polygon.count < 3) return true;
  for (double& light : whole.light) light = 1;
  whole.next = 0;
  whole.box = CellBox::all();
  const Vec3 view = across(whole.polygon);
  work.least_size = kLeastPiece * kLeastPiece * (whole.size = length_squared(view));
  // Those that cut the whole: of the hull of a point and a box most lies beside the lamp.
  std::uint32_t cutting = 0;
  for (std::uint32_t k = 0; k < work.near.count; ++k) {
    Screen screen;
    if (!screen_of(work.near.triangle[k], work, screen) || screen.is_beside(whole.polygon)) continue;
    if (cutting == 0) work.frame.start(whole.polygon, view);
    work.box[cutting] = work.frame.box(screen.corner);
    work.near.triangle[cutting++] = work.near.triangle[k];
  }
  work.near.count = cutting;
  double seen[3] = {0, 0, 0};
  const HighlightLook& look = work.look;
  for (std::uint32_t count = 1; count > 0;) {
    Part& last = pieces_[count - 1];
    Screen screen;
    if (find_cut(work, last, screen)) {
      if (!cut(screen, work, count)) return false;
      continue;
    }
    const double shown = lobe_over(look.lobe, look.mirrored, look.normal, last.polygon);
    for (std::uint32_t c = 0; c < 3; ++c) seen[c] += last.light[c] * shown;
    --count;
  }
  for (std::uint32_t c = 0; c < 3; ++c) sum[c] += seen[c];
  return true;
}

bool LampSight::add_outline(const Lamp& lamp, const HighlightLook& look, Lamps::FaceSet seen,
                            const NearTriangles& near, double (&sum)[3]) const {
  Work work(look, near, nullptr);
  return lamps_->outline(lamp, seen, look.point, pieces_[0].polygon) && add_polygon(work, sum);
}

bool LampSight::add_face(const Lamp& lamp, const LampFace& face, const HighlightLook& look, const NearTriangles& near,
                         double (&sum)[3]) const {
  const Piece piece = lamp_piece(*scene_, lamp, face);
  double all[3] = {0, 0, 0};
  for (std::uint32_t k = 0; k < 2; ++k) {
    const PiecePart part = piece_part(piece, k);
    pieces_[0].polygon.count = 0;
    // From its front it goes counter-clockwise, from the point clockwise.
    for (std::uint32_t c = part.corners; c-- > 0;) {
      if (!pieces_[0].polygon.push(part.corner[c] - look.point)) return false;
    }
    Work work(look, near, &face);
    if (part.corners != 0 && !add_polygon(work, all)) return false;
  }
  for (std::uint32_t c = 0; c < 3; ++c) sum[c] += all[c];
  return true;
}

}  // namespace shodo
