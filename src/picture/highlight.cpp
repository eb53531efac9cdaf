#include "picture/highlight.h"

#include "light/distribution.h"
#include "light/point_source.h"

namespace shodo {

namespace {

constexpr double kLobeEnd = 0x1p-20;
constexpr double kWidest = 0.5;          // radians, of a cell
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

/// A bilinear piece's area element at (s, t).
double jacobian(const Piece& piece, double s, double t) {
  const Vec3 along_s = (1 - t) * (piece.corner[1] - piece.corner[0]) + t * (piece.corner[2] - piece.corner[3]);
  const Vec3 along_t = (1 - s) * (piece.corner[3] - piece.corner[0]) + s * (piece.corner[2] - piece.corner[1]);
  return length(cross(along_s, along_t));
}

/// A triangle as a quadrilateral two corners of which are one.
Piece triangle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  Piece piece;
  piece.corner[0] = a;
  piece.corner[1] = b;
  piece.corner[2] = piece.corner[3] = c;
  return piece;
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
  double exponent;
  Receiver receiver;  // its normal and plane
  Vec3 point;
  Vec3 mirrored;      // unit
  LatticePoint from;
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
                 width < kWidest ? width : kWidest};
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
  return true;
}

std::uint64_t Highlights::bytes(const Scene& scene) {
  return sizeof(Lobe) * scene.optics.size() + sizeof(Emitter) * face_total(scene);
}

void Highlights::add(std::uint32_t optics, const HighlightView& view, double (&luminance)[3]) const {
  const LatticePoint(&corner)[3] = view.drawn->vertex;
  Look look;
  look.lobe = lobes_[optics];
  look.exponent = scene_->optics[optics].highlight_exponent;
  look.receiver.normal = normalised(vector_of(cross(corner[1] - corner[0], corner[2] - corner[0])));
  look.receiver.anchor = scene_point(geometry_->lattice, corner[0]);
  look.point = scene_point(geometry_->lattice, view.point);
  look.mirrored = normalised(vector_of(view.mirrored));
  look.from = view.point;
  for (std::uint32_t l = 0; l < scene_->lights.size(); ++l) {
    Sum sum;
    if (scene_->lights[l].kind == LightKind::kPoint) add_point(l, look, sum);
    if (scene_->lights[l].kind == LightKind::kSun) add_sun(l, look, sum);
    for (std::uint32_t c = 0; c < 3; ++c) luminance[c] += sum.luminance[c];
  }
  for (const Emitter& emitter : faces_) add_face(emitter, look, luminance);
}

bool Highlights::even(std::uint32_t, const HighlightView&, const HighlightView&) const { return false; }

/// The lobe in the direction of a vector; 0 where it has ended.
double Highlights::lobe_at(const Look& look, const Vec3& to_light) const {
  const double along = dot(look.mirrored, to_light);
  if (!(along > 0)) return 0;
  const double cosine = along / length(to_light);
  if (!(cosine > look.lobe.reach)) return 0;
  return look.lobe.strength * power(cosine < 1 ? cosine : 1, look.exponent);
}

/// `lx`: illuminance times lobe, if nothing stands in the way.
void Highlights::add_light(std::uint32_t light, double lx, const Ray& ray, bool ends, Sum& sum) const {
  double arrives[3] = {lx, lx, lx};
  bool blocked = false, dimmed = false;
  tree_->visit_blockers(ray, ends, [&](const RayHit& hit) {
    const DrawnTriangle& drawn = geometry_->drawn[hit.triangle];
    if (drawn.light != kNone && scene_->lights[drawn.light].open) return true;
    const Optics* const optics =
        drawn.mesh == kNone ? nullptr : scene_->optics_of(scene_->meshes[drawn.mesh].material);
    blocked = optics == nullptr || !optics->transmits();
    dimmed = true;
    for (std::uint32_t c = 0; c < 3 && !blocked; ++c) arrives[c] *= optics->transmit.c[c];
    return !blocked;
  });
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

void Highlights::add_face(const Emitter& emitter, const Look& look, double (&luminance)[3]) const {
  if (!(emitter.height(look.point) > 0)) return;
  const Vec3 away = emitter.centre - look.point;
  const double distance = length(away);
  if (distance > emitter.radius) {
    // Nothing of the face is nearer to r than its sphere's edge, at an angle the sine of which is radius / distance.
    const double sine = emitter.radius / distance, cosine = square_root(1 - sine * sine);
    const double reach = look.lobe.reach, beyond = square_root(1 - reach * reach);
    if (dot(look.mirrored, away) < distance * (reach * cosine - beyond * sine)) return;
  }
  double nearest = distance - emitter.radius;
  if (!(nearest > emitter.radius / 16)) nearest = emitter.radius / 16;
  const double angle = 2 * emitter.radius / nearest, wanted = angle / look.lobe.width;
  const Piece piece = emitter_piece(*scene_, emitter);
  const Vec3* const c = piece.corner;
  if (piece.corners == 3) {
    add_piece(emitter, triangle_of(c[0], c[1], c[2]), wanted, look, luminance);
  } else if (piece.concave || piece.cut) {
    const std::uint32_t k = piece.concave ? 1 : 0;
    add_piece(emitter, triangle_of(c[k], c[k + 1], c[k + 2]), wanted, look, luminance);
    add_piece(emitter, triangle_of(c[k], c[k + 2], c[(k + 3) % 4]), wanted, look, luminance);
  } else {
    add_piece(emitter, piece, wanted, look, luminance);
  }
}

/// `wanted`: how many times a lobe's width the face looks.
void Highlights::add_piece(const Emitter& emitter, const Piece& piece, double wanted, const Look& look,
                           double (&luminance)[3]) const {
  Sum sum;
  // Two at least but for faces that look small, so that hardly a shadow falls between the points.
  const std::uint32_t more = wanted < kSmall ? 1 : 2;
  const std::uint32_t cells = wanted < kMostCells ? static_cast<std::uint32_t>(wanted) + more : kMostCells;
  const double size = 1.0 / cells;
  const auto place = [&](std::uint32_t k) { return (k / 2 + 0.5 + (k % 2 == 0 ? -kGauss : kGauss)) * size; };
  for (std::uint32_t row = 0; row < 2 * cells; ++row) {
    for (std::uint32_t column = 0; column < 2 * cells; ++column) {
      add_at(emitter, piece, place(column), place(row), size * size / 4, look, sum);
    }
  }
  // Slivers beside all points are noticed from the corners, which count nothing.
  for (std::uint32_t k = 0; k < 4 && wanted >= kSmall && !sum.mixed(); ++k) {
    add_at(emitter, piece, k % 2 == 0 ? kCorner : 1 - kCorner, k < 2 ? kCorner : 1 - kCorner, 0, look, sum);
  }
  if (sum.mixed()) {
    sum = {};
    std::uint32_t points = 610, step = 377;  // neighbours of Fibonacci's
    while (points < 68 * cells * cells && points < kMostPoints) {
      const std::uint32_t next = points + step;
      step = points;
      points = next;
    }
    const double share = 1.0 / points;
    for (std::uint32_t k = 0; k < points; ++k) {
      const std::uint32_t row = static_cast<std::uint32_t>(std::uint64_t{k} * step % points);
      add_at(emitter, piece, (k + 0.5) * share, (row + 0.5) * share, share, look, sum);
    }
  }
  for (std::uint32_t c = 0; c < 3; ++c) luminance[c] += sum.luminance[c];
}

/// The point (s, t) of a bilinear piece for its `area`, a part of the unit square.
void Highlights::add_at(const Emitter& emitter, const Piece& piece, double s, double t, double area, const Look& look,
                        Sum& sum) const {
  const Light& light = scene_->lights[emitter.light];
  const Vec3 point = piece.point(s, t), away = point - look.point;
  const double lobe = lobe_at(look, away), cosine = dot(look.receiver.normal, away), other = -dot(emitter.normal, away);
  if (!(lobe > 0) || !(cosine > 0) || !(other > 0)) return;
  const double squared = length_squared(away);
  double lx = light.strength * cosine * other / (squared * squared) * (area * jacobian(piece, s, t));
  if (!inverse_square(light)) {
    lx *= relative_attenuation(light, length(light.position - look.point) * scene_->metres_per_unit);
  }
  const LatticePoint end = segment_end(*scene_, *geometry_, emitter, point);
  add_light(emitter.light, lobe * lx, {look.from, end - look.from}, true, sum);
}

}  // namespace shodo
