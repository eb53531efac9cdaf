#include "picture/lamp_sight.h"

#include "visibility/shaft.h"

namespace shodo {

namespace {

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
  Vec3 side[4];
  std::uint32_t count = 0;
};

struct LampSight::Work {
  const HighlightLook& look;
  const NearTriangles& near;
  const LampFace* face;  // null: all triangles are before the lamp
};

bool LampSight::start(const Scene& scene, const Geometry& geometry, const RayTree& tree, const Lamps& lamps,
                      Arena& arena) {
  scene_ = &scene;
  geometry_ = &geometry;
  tree_ = &tree;
  lamps_ = &lamps;
  return lamps.lamps().empty() || arena.take("pieces of lamps", kMostDepth, pieces_);
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
  Vec3 v[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const LatticeVector way = drawn.vertex[k] - work.look.from;
    v[k] = {step * static_cast<double>(way.x), step * static_cast<double>(way.y), step * static_cast<double>(way.z)};
  }
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

/// From piece `depth` on, which near triangles up to `next` have been cut off. At most kMostDepth deep.
bool LampSight::add_seen(std::uint32_t depth, std::uint32_t next, const double (&part)[3], const Work& work,
                         double (&sum)[3]) const {
  DirectionPolygon& here = pieces_[depth];
  double left[3] = {part[0], part[1], part[2]};
  for (; next < work.near.count; ++next) {
    Screen screen;
    if (!screen_of(work.near.triangle[next], work, screen)) continue;
    bool beside = false;
    for (std::uint32_t k = 0; k < screen.count && !beside; ++k) beside = beyond(here, screen.side[k]);
    if (beside) continue;
    if (depth + 1 == kMostDepth) return false;
    for (std::uint32_t k = 0; k < screen.count; ++k) {
      DirectionPolygon& outside = pieces_[depth + 1];
      if (!split(here, screen.side[k], outside)) return false;
      if (outside.count > 0 && !add_seen(depth + 1, next + 1, left, work, sum)) return false;
    }
    if (!weaken(work.near.triangle[next], left)) return true;
  }
  const HighlightLook& look = work.look;
  const double shown = lobe_over(look.lobe, look.mirrored, look.normal, here);
  for (std::uint32_t c = 0; c < 3; ++c) sum[c] += left[c] * shown;
  return true;
}

/// Of pieces_[0], which the surface's plane may cut.
bool LampSight::add_polygon(const Work& work, double (&sum)[3]) const {
  if (!split(pieces_[0], work.look.normal, pieces_[1])) return false;
  if (pieces_[0].count < 3) return true;
  const double whole[3] = {1, 1, 1};
  double seen[3] = {0, 0, 0};
  if (!add_seen(0, 0, whole, work, seen)) return false;
  for (std::uint32_t c = 0; c < 3; ++c) sum[c] += seen[c];
  return true;
}

bool LampSight::add_outline(const Lamp& lamp, const HighlightLook& look, Lamps::FaceSet seen,
                            const NearTriangles& near, double (&sum)[3]) const {
  return lamps_->outline(lamp, seen, look.point, pieces_[0]) && add_polygon({look, near, nullptr}, sum);
}

bool LampSight::add_face(const Lamp& lamp, const LampFace& face, const HighlightLook& look, const NearTriangles& near,
                         double (&sum)[3]) const {
  const Piece piece = lamp_piece(*scene_, lamp, face);
  double all[3] = {0, 0, 0};
  for (std::uint32_t k = 0; k < 2; ++k) {
    const PiecePart part = piece_part(piece, k);
    pieces_[0].count = 0;
    // From its front it goes counter-clockwise, from the point clockwise.
    for (std::uint32_t c = part.corners; c-- > 0;) {
      if (!pieces_[0].push(part.corner[c] - look.point)) return false;
    }
    if (part.corners != 0 && !add_polygon({look, near, &face}, all)) return false;
  }
  for (std::uint32_t c = 0; c < 3; ++c) sum[c] += all[c];
  return true;
}

}  // namespace shodo
