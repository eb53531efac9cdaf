#include "picture/highlight.h"

#include "light/distribution.h"
#include "light/point_source.h"
#include "picture/beam.h"
#include "picture/face_shadow.h"
#include "visibility/shaft.h"

namespace shodo {

namespace {

constexpr double kLobeEnd = 0x1p-20;
constexpr double kWidest = 0.5;          // of a lobe
constexpr double kCell = 1.5;             // of a lobe's width, how wide a cell may look
constexpr std::uint32_t kLeastLines = 32;  // over a face that is partly hidden
constexpr double kShort = 8;  // times a way between samples: the least distance of a light
constexpr std::uint32_t kMostNear = 12;
constexpr std::int32_t kEndMargin = 4;     // lattice steps by which ends of segments may be off
constexpr std::uint32_t kMostCells = 64;  // along a face's side
constexpr std::uint32_t kMostPoints = 17711;
constexpr double kCorner = 1.0 / 64;
constexpr double kSmall = 0.25;           // of a lobe's width
constexpr double kGauss = 0x1.279a74590331cp-2;  // 1 / (2 sqrt(3)) of a cell, from its centre

std::uint32_t emitting_faces(const Scene& scene, const Light& light) {
  if (light.kind == LightKind::kArea) return 1;
  if (light.kind != LightKind::kPolyhedron) return 0;
  const Object& object = scene.objects[light.object];
  std::uint32_t count = 0;
  for (std::uint32_t m = 0; m < object.mesh_count; ++m) count += cell_count(scene.meshes[object.first_mesh + m]);
  return count;
}

bool any_highlight(const Scene& scene) {
  for (const Optics& optics : scene.optics) {
    if (optics.highlight > 0) return true;
  }
  return false;
}

std::uint64_t face_total(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Light& light : scene.lights) count += any_highlight(scene) ? emitting_faces(scene, light) : 0;
  return count;
}

Vec3 vector_of(const LatticeVector& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// c^n, given c^2: by squaring for whole n, which it mostly is; with even n without a root.
double raised(double squared, double n) {
  if (!(n < 65536) || static_cast<double>(static_cast<std::uint32_t>(n)) != n) return power(square_root(squared), n);
  const std::uint32_t whole = static_cast<std::uint32_t>(n);
  double result = (whole & 1) != 0 ? square_root(squared) : 1;
  for (std::uint32_t bits = whole >> 1; bits != 0; bits >>= 1) {
    if ((bits & 1) != 0) result *= squared;
    squared *= squared;
  }
  return result;
}

LatticeBox box_of(const LatticePoint& p, std::int32_t margin) {
  return {{p.x - margin, p.y - margin, p.z - margin}, {p.x + margin, p.y + margin, p.z + margin}};
}

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

/// A triangle as a quadrilateral two corners of which are one.
Piece triangle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  Piece piece;
  piece.corner[0] = a;
  piece.corner[1] = b;
  piece.corner[2] = piece.corner[3] = c;
  return piece;
}

/// An odd point kOff steps in front of the face, on its own: what blocks may be gone when pictures are drawn.
LatticePoint end_at(const Lattice& lattice, const Piece& face, const Vec3& point) {
  constexpr std::int32_t kOff = 16;  // more than mending moves a corner
  Triangle own[2];
  const std::uint32_t count = lattice_quad(lattice, face.corner, own);
  LatticePoint p = sample_point(lattice, std::span<const Triangle>(own, count), point);
  if (count == 0) return p;
  const std::int64_t n[3] = {own[0].n.x, own[0].n.y, own[0].n.z};
  const auto size = [&](int k) { return n[k] < 0 ? -n[k] : n[k]; };
  const int yz = size(2) > size(1) ? 2 : 1, axis = size(yz) > size(0) ? yz : 0;
  (axis == 0 ? p.x : axis == 1 ? p.y : p.z) += n[axis] < 0 ? -kOff : kOff;
  return p;
}

}  // namespace

/// Luminance, and what segments have found.
struct Highlights::Sum {
  double luminance[3] = {0, 0, 0};
  bool free = false, dimmed = false, blocked = false;

  bool mixed() const { return (free ? 1 : 0) + (dimmed ? 1 : 0) + (blocked ? 1 : 0) > 1; }
};

/// What the light sources are looked at from.
struct Highlights::Look {
  Lobe lobe;
  Receiver receiver;  // its normal and plane
  Vec3 point;
  Vec3 mirrored;      // unit
  LatticePoint from;
  const DrawnTriangle* surface;
};

/// A piece of a face from there: corner + s a + t b + s t d.
struct Highlights::FaceView {
  const Emitter& emitter;
  const Look& look;
  Vec3 corner, a, b, d;
  bool even;          // d = 0
  double area = 0;    // of an even one
  double strength;    // cd/m2, by the light's attenuation

  FaceView(const Scene& scene, const Emitter& from, const Look& at, const Piece& piece)
      : emitter(from), look(at), corner(piece.corner[0] - at.point), a(piece.corner[1] - piece.corner[0]),
        b(piece.corner[3] - piece.corner[0]), d((piece.corner[2] - piece.corner[3]) - a),
        even(length_squared(d) <= 1e-12 * from.radius * from.radius), strength(scene.lights[from.light].strength) {
    const Light& light = scene.lights[from.light];
    if (even) area = length(cross(a, b));
    if (inverse_square(light)) return;
    strength *= relative_attenuation(light, length(light.position - at.point) * scene.metres_per_unit);
  }
  Vec3 way(double s, double t) const { return even ? corner + s * a + t * b : corner + s * a + t * b + (s * t) * d; }
  /// Area over that of the unit square.
  double area_at(double s, double t) const { return even ? area : length(cross(a + t * d, b + s * d)); }
};

/// All that may stand between a point and a face.
struct Highlights::Near {
  std::uint32_t triangle[kMostNear];
  std::uint32_t count = 0;  // above kMostNear: there are more
  bool panes = false;

  bool all() const { return count <= kMostNear; }
};

bool Highlights::start(const Scene& scene, const Geometry& geometry, const RayTree& tree, Arena& arena) {
  scene_ = &scene;
  geometry_ = &geometry;
  tree_ = &tree;
  if (!arena.take("lobes of highlights", scene.optics.size(), lobes_) ||
      !arena.take("faces that highlights show", static_cast<std::size_t>(face_total(scene)), faces_)) {
    return false;
  }
  for (std::size_t k = 0; k < lobes_.size(); ++k) {
    const double n = scene.optics[k].highlight_exponent;
    const double width = 1 / square_root(n);
    lobes_[k] = {scene.optics[k].highlight * (n + 2) / kTwoPi, exponential(logarithm(kLobeEnd) / n),
                 width < kWidest ? width : kWidest, n};
  }
  std::size_t next = 0;
  for (std::uint32_t l = 0; l < scene.lights.size() && next < faces_.size(); ++l) {
    const Light& light = scene.lights[l];
    if (light.kind == LightKind::kArea) faces_[next++] = area_emitter(scene, l);
    if (light.kind != LightKind::kPolyhedron) continue;
    const Object& object = scene.objects[light.object];
    for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
      const std::uint32_t cells = cell_count(scene.meshes[m]);
      for (std::uint32_t cell = 0; cell < cells; ++cell) faces_[next++] = face_emitter(scene, l, m, cell);
    }
  }
  for (Emitter& face : faces_) {
    const Piece piece = emitter_piece(scene, face);
    for (const Vec3& corner : piece.corner) {
      face.whole.include(box_of(end_at(geometry.lattice, piece, corner), kEndMargin));
    }
  }
  return true;
}

std::uint64_t Highlights::bytes(const Scene& scene) {
  return sizeof(Lobe) * scene.optics.size() + sizeof(Emitter) * face_total(scene);
}

Highlights::Look Highlights::look_from(std::uint32_t optics, const HighlightView& view) const {
  const LatticePoint(&corner)[3] = view.drawn->vertex;
  Look look;
  look.lobe = lobes_[optics];
  look.receiver.normal = normalised(vector_of(cross(corner[1] - corner[0], corner[2] - corner[0])));
  look.receiver.anchor = scene_point(geometry_->lattice, corner[0]);
  look.point = scene_point(geometry_->lattice, view.point);
  look.mirrored = normalised(vector_of(view.mirrored));
  look.from = view.point;
  look.surface = view.drawn;
  return look;
}

void Highlights::add(std::uint32_t optics, const HighlightView& view, double (&luminance)[3]) const {
  const Look look = look_from(optics, view);
  for (std::uint32_t l = 0; l < scene_->lights.size(); ++l) {
    Sum sum;
    if (scene_->lights[l].kind == LightKind::kPoint) add_point(l, look, sum);
    if (scene_->lights[l].kind == LightKind::kSun) add_sun(l, look, sum);
    for (std::uint32_t c = 0; c < 3; ++c) luminance[c] += sum.luminance[c];
  }
  for (const Emitter& emitter : faces_) add_face(emitter, look, luminance);
}

/// Whether a triangle is in the way of no segment that starts on the surface's front: all of it lies behind, or it is
/// an opening.
bool Highlights::passes_by(std::uint32_t t, const DrawnTriangle& surface) const {
  const DrawnTriangle& drawn = geometry_->drawn[t];
  if (drawn.light != kNone && (drawn.light >= scene_->lights.size() || scene_->lights[drawn.light].open)) return true;
  for (const LatticePoint& p : drawn.vertex) {
    if (side_of(surface, p) > 0) return false;
  }
  return true;
}

bool Highlights::even(std::uint32_t optics, const HighlightView& a, const HighlightView& b) const {
  const Look at_a = look_from(optics, a), at_b = look_from(optics, b);
  const double width = at_a.lobe.width;
  if (!(dot(at_a.mirrored, at_b.mirrored) >= 1 - width * width / 32)) return false;
  for (std::uint32_t l = 0; l < scene_->lights.size(); ++l) {
    if (!light_even(l, at_a, at_b)) return false;
  }
  for (const Emitter& face : faces_) {
    if (!face_even(face, at_a, at_b)) return false;
  }
  return true;
}

/// Whether the way from a to b is short for the distance of a light, so that its light changes little.
bool is_short(const Vec3& a, const Vec3& b, const Vec3& light, double radius) {
  const double away = length(light - a) - radius;
  return away > 0 && length_squared(b - a) * (kShort * kShort) <= away * away;
}

/// Of a point light or a sun: it doesn't show, or nothing is between.
bool Highlights::light_even(std::uint32_t l, const Look& a, const Look& b) const {
  const Light& light = scene_->lights[l];
  LatticePoint end_a, end_b;
  if (light.kind == LightKind::kPoint) {
    if (!(lobe_at(a, light.position - a.point) > 0) && !(lobe_at(b, light.position - b.point) > 0)) return true;
    if (!is_short(a.point, b.point, light.position, 0)) return false;
    end_a = end_b = geometry_->light_points[l];
  } else if (light.kind == LightKind::kSun) {
    const LatticeVector way = lattice_direction(-light.towards);
    if (!(lobe_at(a, vector_of(way)) > 0) && !(lobe_at(b, vector_of(way)) > 0)) return true;
    const auto beyond = [&](const LatticePoint& p) {
      return LatticePoint{static_cast<std::int32_t>(p.x + 2 * way.x), static_cast<std::int32_t>(p.y + 2 * way.y),
                          static_cast<std::int32_t>(p.z + 2 * way.z)};
    };
    end_a = beyond(a.from);
    end_b = beyond(b.from);
  } else {
    return true;
  }
  const Beam beam(a.from, b.from, end_a, end_b);
  return tree_->visit_in(beam, [&](std::uint32_t t) { return passes_by(t, *a.surface); });
}

bool Highlights::face_even(const Emitter& face, const Look& a, const Look& b) const {
  if (!reaches(face, a) && !reaches(face, b)) return true;
  if (!is_short(a.point, b.point, face.centre, face.radius * 0.75)) return false;
  LatticeBox from = box_of(a.from, 0);
  from.include(b.from);
  Near near;
  find_near(face, a, from, near);
  return near.count == 0;
}

/// The lobe in the direction of a vector; 0 where it has ended.
double Highlights::lobe_at(const Look& look, const Vec3& to_light) {
  const double along = dot(look.mirrored, to_light);
  if (!(along > 0)) return 0;
  return lobe_of(look.lobe, along * along / length_squared(to_light));
}

/// Given the square of the cosine.
double Highlights::lobe_of(const Lobe& lobe, double squared) {
  if (!(squared > lobe.reach * lobe.reach)) return 0;
  return lobe.strength * raised(squared < 1 ? squared : 1, lobe.exponent);
}

/// What a triangle lets through; false: nothing.
bool Highlights::weaken(std::uint32_t t, double (&arrives)[3]) const {
  const DrawnTriangle& drawn = geometry_->drawn[t];
  const Optics* const optics =
      drawn.mesh == kNone ? nullptr : scene_->optics_of(scene_->meshes[drawn.mesh].material);
  if (optics == nullptr || !optics->transmits()) return false;
  for (std::uint32_t c = 0; c < 3; ++c) arrives[c] *= optics->transmit.c[c];
  return true;
}

/// `lx`: illuminance times lobe, if nothing stands in the way.
void Highlights::add_light(std::uint32_t light, double lx, const Ray& ray, bool ends, Sum& sum) const {
  double arrives[3] = {lx, lx, lx};
  bool blocked = false, dimmed = false;
  tree_->visit_blockers(ray, ends, [&](const RayHit& hit) {
    const DrawnTriangle& drawn = geometry_->drawn[hit.triangle];
    if (drawn.light != kNone && (drawn.light >= scene_->lights.size() || scene_->lights[drawn.light].open)) return true;
    dimmed = true;
    blocked = !weaken(hit.triangle, arrives);
    return !blocked;
  });
  (blocked ? sum.blocked : dimmed ? sum.dimmed : sum.free) = true;
  const Rgb& colour = scene_->lights[light].colour;
  for (std::uint32_t c = 0; c < 3 && !blocked; ++c) sum.luminance[c] += colour.c[c] * arrives[c];
}

/// The same past what is near, which is all there can be.
void Highlights::add_past(const Near& near, std::uint32_t light, double lx, const Ray& ray, Sum& sum) const {
  if (!near.all()) return add_light(light, lx, ray, true, sum);
  double arrives[3] = {lx, lx, lx};
  bool blocked = false, dimmed = false;
  for (std::uint32_t k = 0; k < near.count && !blocked; ++k) {
    RayHit hit;
    if (!meet(geometry_->drawn[near.triangle[k]], near.triangle[k], ray, hit) || hit.distance >= hit.speed) continue;
    dimmed = true;
    blocked = !weaken(near.triangle[k], arrives);
  }
  (blocked ? sum.blocked : dimmed ? sum.dimmed : sum.free) = true;
  const Rgb& colour = scene_->lights[light].colour;
  for (std::uint32_t c = 0; c < 3 && !blocked; ++c) sum.luminance[c] += colour.c[c] * arrives[c];
}

void Highlights::add_point(std::uint32_t l, const Look& look, Sum& sum) const {
  const Light& light = scene_->lights[l];
  const double lobe = lobe_at(look, light.position - look.point);
  if (!(lobe > 0)) return;
  const double lx = point_lux(*scene_, light, look.receiver, look.point, geometry_->lattice.step()).lux;
  if (lx > 0) add_light(l, lobe * lx, {look.from, geometry_->light_points[l] - look.from}, true, sum);
}

void Highlights::add_sun(std::uint32_t l, const Look& look, Sum& sum) const {
  const Light& light = scene_->lights[l];
  const LatticeVector to_sun = lattice_direction(-light.towards);
  const Vec3 way = normalised(vector_of(to_sun));
  const double cosine = dot(look.receiver.normal, way), lobe = lobe_at(look, way);
  if (!(cosine > 0) || !(lobe > 0)) return;
  add_light(l, lobe * light.strength * cosine, {look.from, to_sun}, false, sum);
}

/// Whether the lobe shows anything of the face.
bool Highlights::reaches(const Emitter& emitter, const Look& look) const {
  if (!(emitter.height(look.point) > 0)) return false;
  const Vec3 away = emitter.centre - look.point;
  const double distance = length(away);
  if (!(distance > emitter.radius)) return true;
  // Nothing of the face is nearer to r than its sphere's edge, at an angle the sine of which is radius / distance.
  const double sine = emitter.radius / distance, cosine = square_root(1 - sine * sine);
  const double reach = look.lobe.reach, beyond = square_root(1 - reach * reach);
  return dot(look.mirrored, away) >= distance * (reach * cosine - beyond * sine);
}

/// All that is between a box of points before the surface and the face.
void Highlights::find_near(const Emitter& emitter, const Look& look, const LatticeBox& from, Near& near) const {
  Hull hull{Shaft(from, emitter.whole)};
  const double margin = kEndMargin * geometry_->lattice.step();
  tree_->visit_in(hull, [&](std::uint32_t t) {
    const DrawnTriangle& drawn = geometry_->drawn[t];
    if (emitter.is_area() && drawn.light == emitter.light) return true;
    if (passes_by(t, *look.surface)) return true;
    bool beyond = true;  // the face
    for (const LatticePoint& p : drawn.vertex) {
      beyond = beyond && emitter.height(scene_point(geometry_->lattice, p)) <= margin;
    }
    if (beyond) return true;
    if (near.count < kMostNear) near.triangle[near.count] = t;
    double part[3] = {1, 1, 1};
    near.panes = near.panes || weaken(t, part);
    return ++near.count <= kMostNear;
  });
}

void Highlights::add_face(const Emitter& emitter, const Look& look, double (&luminance)[3]) const {
  if (!reaches(emitter, look)) return;
  const double distance = length(emitter.centre - look.point);
  double nearest = distance - emitter.radius;
  if (!(nearest > emitter.radius / 16)) nearest = emitter.radius / 16;
  const double angle = 2 * emitter.radius / nearest, wanted = angle / (kCell * look.lobe.width);
  Near near;
  find_near(emitter, look, box_of(look.from, 0), near);
  const Piece piece = emitter_piece(*scene_, emitter);
  const Vec3* const c = piece.corner;
  if (piece.corners == 3) {
    add_piece(emitter, triangle_of(c[0], c[1], c[2]), wanted, look, near, luminance);
  } else if (piece.concave || piece.cut) {
    const std::uint32_t k = piece.concave ? 1 : 0;
    add_piece(emitter, triangle_of(c[k], c[k + 1], c[k + 2]), wanted, look, near, luminance);
    add_piece(emitter, triangle_of(c[k], c[k + 2], c[(k + 3) % 4]), wanted, look, near, luminance);
  } else {
    add_piece(emitter, piece, wanted, look, near, luminance);
  }
}

/// The k-th Gauss point's place along a side of `cells` cells.
double gauss_place(std::uint32_t k, std::uint32_t cells) {
  return (k / 2 + 0.5 + (k % 2 == 0 ? -kGauss : kGauss)) / cells;
}

/// `wanted`: how many cells the face looks wide.
void Highlights::add_piece(const Emitter& emitter, const Piece& piece, double wanted, const Look& look,
                           const Near& near, double (&luminance)[3]) const {
  const FaceView face(*scene_, emitter, look, piece);
  // Two at least but for faces that look small, so that hardly a shadow falls between the points.
  const std::uint32_t more = wanted < kSmall ? 1 : 2;
  const std::uint32_t cells = wanted < kMostCells ? static_cast<std::uint32_t>(wanted) + more : kMostCells;
  const bool few = near.count <= FaceShadow::kMost && !near.panes && face.even;
  if (near.count == 0 || few) return add_cells(face, cells, near, luminance);
  Sum sum;
  const double share = 0.25 / (cells * cells);
  for (std::uint32_t row = 0; row < 2 * cells; ++row) {
    for (std::uint32_t column = 0; column < 2 * cells; ++column) {
      add_at(face, gauss_place(column, cells), gauss_place(row, cells), share, near, sum);
    }
  }
  // Slivers beside all points are noticed from the corners, which count nothing.
  for (std::uint32_t k = 0; k < 4 && wanted >= kSmall && !sum.mixed(); ++k) {
    add_at(face, k % 2 == 0 ? kCorner : 1 - kCorner, k < 2 ? kCorner : 1 - kCorner, 0, near, sum);
  }
  if (sum.mixed()) {
    sum = {};
    std::uint32_t points = 610, step = 377;  // neighbours of Fibonacci's
    while (points < 68 * cells * cells && points < kMostPoints) {
      const std::uint32_t next = points + step;
      step = points;
      points = next;
    }
    const double part = 1.0 / points;
    for (std::uint32_t k = 0; k < points; ++k) {
      const std::uint32_t row = static_cast<std::uint32_t>(std::uint64_t{k} * step % points);
      add_at(face, (k + 0.5) * part, (row + 0.5) * part, part, near, sum);
    }
  }
  for (std::uint32_t c = 0; c < 3; ++c) luminance[c] += sum.luminance[c];
}

/// Nothing stands between, or a few triangles: each Gauss point by the part of its quarter of a cell that is seen.
void Highlights::add_cells(const FaceView& face, std::uint32_t cells, const Near& near,
                           double (&luminance)[3]) const {
  FaceShadow shadow(face.corner, face.a, face.b);
  for (std::uint32_t k = 0; k < near.count; ++k) {
    const LatticePoint(&vertex)[3] = geometry_->drawn[near.triangle[k]].vertex;
    const auto from_point = [&](const LatticePoint& p) { return scene_point(geometry_->lattice, p) - face.look.point; };
    shadow.add({from_point(vertex[0]), from_point(vertex[1]), from_point(vertex[2])});
  }
  const std::uint32_t columns = 2 * cells, lines = (kLeastLines + columns - 1) / columns;  // of a row of quarters
  const double share = 0.25 / (cells * cells), share_of_line = share / lines;
  double seen[2 * kMostCells], sum = 0;
  for (std::uint32_t row = 0; row < columns; ++row) {
    if (near.count > 0) {
      for (std::uint32_t j = 0; j < columns; ++j) seen[j] = 0;
      for (std::uint32_t k = row * lines; k < (row + 1) * lines; ++k) {
        shadow.add_seen(k, columns * lines, {seen, columns});
      }
    }
    const double t = gauss_place(row, cells);
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double part = near.count > 0 ? seen[j] * share_of_line : share;
      if (!(part > 0)) continue;
      const double lx = lobe_lux(face, gauss_place(j, cells), t, part);
      if (lx > 0) sum += lx;
    }
  }
  for (std::uint32_t c = 0; c < 3; ++c) luminance[c] += scene_->lights[face.emitter.light].colour.c[c] * sum;
}

/// Lobe times illuminance by the point (s, t) for its `area`, a part of the unit square; below 0 where there is none.
double Highlights::lobe_lux(const FaceView& face, double s, double t, double area) const {
  const Vec3 way = face.way(s, t);
  const double along = dot(face.look.mirrored, way), squared = length_squared(way);
  const double reach = face.look.lobe.reach;
  if (!(along > 0) || !(along * along > reach * reach * squared)) return -1;
  const double cosine = dot(face.look.receiver.normal, way), other = -dot(face.emitter.normal, way);
  if (!(cosine > 0) || !(other > 0)) return -1;
  const double over = 1 / squared;
  const double lux = face.strength * cosine * other * (over * over) * (area * face.area_at(s, t));
  return lobe_of(face.look.lobe, along * along * over) * lux;
}

void Highlights::add_at(const FaceView& face, double s, double t, double area, const Near& near, Sum& sum) const {
  const double lx = lobe_lux(face, s, t, area);
  if (!(lx >= 0)) return;
  const LatticePoint end =
      end_at(geometry_->lattice, emitter_piece(*scene_, face.emitter), face.look.point + face.way(s, t));
  add_past(near, face.emitter.light, lx, {face.look.from, end - face.look.from}, sum);
}

}  // namespace shodo
