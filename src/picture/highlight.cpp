#include "picture/highlight.h"

#include "light/distribution.h"
#include "light/point_source.h"
#include "picture/beam.h"
#include "picture/display.h"

namespace shodo {

namespace {

constexpr double kLobeEnd = 0x1p-20;
constexpr double kLeastShown = 0.25;  // display steps
constexpr double kEvenWidth = 0.5;    // of a lobe, radians, at most: how even it is
constexpr double kMostSteps = 0x1p21;  // more than from one end of the lattice to the other
constexpr double kShort = 8;          // times a way between samples: the least distance of a light
constexpr NearTriangles kNothingNear{};
constexpr std::uint32_t kPoints = 610, kPointStep = 377;  // neighbours of Fibonacci's

LatticeBox box_of(const LatticePoint& p) { return {{p.x, p.y, p.z}, {p.x, p.y, p.z}}; }

/// An odd point 16 steps, more than mending moves a corner, in front of a face, on its own: what blocks may be gone
/// when pictures are drawn.
LatticePoint end_at(const Lattice& lattice, const Piece& face, const Vec3& point) {
  constexpr std::int32_t kOff = 16;
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

/// The square of the least distance between a box and that around a triangle, lattice steps.
double gap_squared(const LatticeBox& box, const DrawnTriangle& triangle) {
  LatticeBox around;
  for (const LatticePoint& p : triangle.vertex) around.include(p);
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t above = around.low[k] - box.high[k], below = box.low[k] - around.high[k];
    const double gap = above > below ? above : below;
    if (gap > 0) sum += gap * gap;
  }
  return sum;
}

double largest_colour(const Scene& scene, const Light& light) {
  double most = light.colour.c[0];
  for (std::uint32_t c = 1; c < scene.channels; ++c) most = light.colour.c[c] > most ? light.colour.c[c] : most;
  return most;
}

/// The luminance of the brightest lamp, in any channel and from anywhere: what attenuation makes of it grows with the
/// distance.
double brightest(const Scene& scene, const Lattice& lattice) {
  const double metres = kMostSteps * lattice.step() * scene.metres_per_unit;
  double most = 0;
  for (const Light& light : scene.lights) {
    if (light.kind != LightKind::kArea && light.kind != LightKind::kPolyhedron) continue;
    const double here = largest_colour(scene, light) * light.strength * relative_attenuation(light, metres);
    if (here > most) most = here;
  }
  return most;
}

Lobe lobe_of(const Optics& optics, double brightest_lamp, double least_shown) {
  Lobe lobe;
  lobe.exponent = optics.highlight_exponent;
  lobe.strength = optics.highlight * (lobe.exponent + 2) / kTwoPi;
  lobe.width = 1 / square_root(lobe.exponent);
  lobe.reach = exponential(logarithm(kLobeEnd) / lobe.exponent);
  // A lamp all round, as bright as the lobe is at its end.
  const double end = least_shown / (lobe.strength * kTwoPi * brightest_lamp);
  lobe.ends = end > kLobeEnd ? exponential(logarithm(end < 0.5 ? end : 0.5) / lobe.exponent) : lobe.reach;
  return lobe;
}

}  // namespace

bool Highlights::start(const Scene& scene, const Geometry& geometry, const RayTree& tree, Arena& arena) {
  scene_ = &scene;
  geometry_ = &geometry;
  tree_ = &tree;
  if (!arena.take("lobes of highlights", scene.optics.size(), lobes_) || !lamps_.start(scene, geometry, arena) ||
      !sight_.start(scene, geometry, tree, lamps_, arena)) {
    return false;
  }
  const double most = brightest(scene, geometry.lattice);
  for (std::size_t k = 0; k < lobes_.size(); ++k) {
    lobes_[k] = scene.optics[k].highlight > 0
                    ? lobe_of(scene.optics[k], most, kLeastShown * scene.display.max_cd_m2 / kWhite)
                    : Lobe{};
  }
  return true;
}

std::uint64_t Highlights::bytes(const Scene& scene) {
  const std::uint64_t lamps = Lamps::bytes(scene);
  return sizeof(Lobe) * scene.optics.size() + lamps + (lamps == 0 ? 0 : LampSight::bytes());
}

HighlightLook Highlights::look_from(std::uint32_t optics, const HighlightView& view) const {
  const LatticePoint(&corner)[3] = view.drawn->vertex;
  HighlightLook look;
  look.lobe = lobes_[optics];
  look.normal = normalised(vector_of(cross(corner[1] - corner[0], corner[2] - corner[0])));
  look.anchor = scene_point(geometry_->lattice, corner[0]);
  look.point = scene_point(geometry_->lattice, view.point);
  look.mirrored = normalised(vector_of(view.mirrored));
  look.from = view.point;
  look.surface = view.drawn;
  return look;
}

bool Highlights::add(std::uint32_t optics, const HighlightView& view, double (&luminance)[3]) const {
  const HighlightLook look = look_from(optics, view);
  for (std::uint32_t l = 0; l < scene_->lights.size(); ++l) {
    if (scene_->lights[l].kind == LightKind::kPoint) add_point(l, look, luminance);
    if (scene_->lights[l].kind == LightKind::kSun) add_sun(l, look, luminance);
  }
  bool lamps = false;
  for (const Lamp& lamp : lamps_.lamps()) lamps = add_lamp(lamp, look, luminance) || lamps;
  return lamps;
}

bool Highlights::even(std::uint32_t optics, const HighlightView& a, const HighlightView& b, bool lamps) const {
  const HighlightLook at_a = look_from(optics, a), at_b = look_from(optics, b);
  const double width = at_a.lobe.width < kEvenWidth ? at_a.lobe.width : kEvenWidth;
  if (!(dot(at_a.mirrored, at_b.mirrored) >= 1 - width * width / 32)) return false;
  for (std::uint32_t l = 0; l < scene_->lights.size(); ++l) {
    if (!light_even(l, at_a, at_b)) return false;
  }
  if (!lamps) return true;
  for (const Lamp& lamp : lamps_.lamps()) {
    if (!lamp_even(lamp, at_a, at_b)) return false;
  }
  return true;
}

/// Whether the way from a to b is short for the distance of a light, so that its light changes little.
bool is_short(const Vec3& a, const Vec3& b, const Vec3& light, double radius) {
  const double away = length(light - a) - radius;
  return away > 0 && length_squared(b - a) * (kShort * kShort) <= away * away;
}

/// Of a point light or a sun: it doesn't show, or nothing is between.
bool Highlights::light_even(std::uint32_t l, const HighlightLook& a, const HighlightLook& b) const {
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
  return tree_->visit_in(beam, [&](std::uint32_t t) { return sight_.passes_by(t, *a.surface); });
}

bool Highlights::lamp_even(const Lamp& lamp, const HighlightLook& a, const HighlightLook& b) const {
  const Lamps::FaceSet seen_a = lamps_.seen_from(lamp, a.point), seen_b = lamps_.seen_from(lamp, b.point);
  if (!(unshadowed(lamp, a, seen_a) > 0) && !(unshadowed(lamp, b, seen_b) > 0)) return true;
  if (!is_short(a.point, b.point, lamp.centre, lamp.radius * 0.75)) return false;
  const Lamps::FaceSet seen = seen_a | seen_b;
  LatticeBox from = box_of(a.from);
  from.include(b.from);
  NearTriangles near;
  sight_.find_near(lamp, *a.surface, from, seen, ~seen, near);
  if (!near.all()) return false;
  const double apart = length(b.point - a.point) * geometry_->lattice.steps_per_unit;
  const double width = a.lobe.width < kEvenWidth ? a.lobe.width : kEvenWidth, least = 4 * apart / width;
  for (std::uint32_t k = 0; k < near.count; ++k) {
    if (!(gap_squared(from, geometry_->drawn[near.triangle[k]]) >= least * least)) return false;
  }
  return true;
}

/// The lobe in the direction of a vector; 0 where it has ended.
double Highlights::lobe_at(const HighlightLook& look, const Vec3& to_light) {
  const double along = dot(look.mirrored, to_light);
  return along > 0 ? look.lobe.at(along * along / length_squared(to_light)) : 0;
}

/// `shown`: illuminance times lobe, if nothing stands in the way.
void Highlights::add_segment(std::uint32_t light, double shown, const Ray& ray, bool ends, Sum& sum) const {
  double arrives[3] = {shown, shown, shown};
  bool blocked = false;
  tree_->visit_blockers(ray, ends, [&](const RayHit& hit) {
    const DrawnTriangle& drawn = geometry_->drawn[hit.triangle];
    if (drawn.light != kNone && (drawn.light >= scene_->lights.size() || scene_->lights[drawn.light].open)) return true;
    blocked = !sight_.weaken(hit.triangle, arrives);
    return !blocked;
  });
  const Rgb& colour = scene_->lights[light].colour;
  for (std::uint32_t c = 0; c < 3 && !blocked; ++c) sum[c] += colour.c[c] * arrives[c];
}

void Highlights::add_point(std::uint32_t l, const HighlightLook& look, Sum& sum) const {
  const Light& light = scene_->lights[l];
  const double lobe = lobe_at(look, light.position - look.point);
  if (!(lobe > 0)) return;
  Receiver receiver;
  receiver.normal = look.normal;
  receiver.anchor = look.anchor;
  const double lx = point_lux(*scene_, light, receiver, look.point, geometry_->lattice.step()).lux;
  if (lx > 0) add_segment(l, lobe * lx, {look.from, geometry_->light_points[l] - look.from}, true, sum);
}

void Highlights::add_sun(std::uint32_t l, const HighlightLook& look, Sum& sum) const {
  const Light& light = scene_->lights[l];
  const LatticeVector to_sun = lattice_direction(-light.towards);
  const Vec3 way = normalised(vector_of(to_sun));
  const double cosine = dot(look.normal, way), lobe = lobe_at(look, way);
  if (!(cosine > 0) || !(lobe > 0)) return;
  add_segment(l, lobe * light.strength * cosine, {look.from, to_sun}, false, sum);
}

/// cd/m2, by the light's attenuation; before its colour.
double Highlights::luminance_of(const Lamp& lamp, const Vec3& point) const {
  const Light& light = scene_->lights[lamp.light];
  if (inverse_square(light)) return light.strength;
  return light.strength * relative_attenuation(light, length(light.position - point) * scene_->metres_per_unit);
}

/// In the channel in which it is brightest.
double Highlights::most_luminance_of(const Lamp& lamp, const Vec3& point) const {
  return largest_colour(*scene_, scene_->lights[lamp.light]) * luminance_of(lamp, point);
}

/// Whether the lobe shows anything of a lamp: its sphere is seen at a sine of radius / distance around its centre, and
/// no point of it shows more than the nearest to r, over the sphere's solid angle (below 2 pi sine^2).
bool Highlights::reaches(const Lamp& lamp, const HighlightLook& look) const {
  const Vec3 away = lamp.centre - look.point;
  if (!(dot(look.normal, away) > -lamp.radius)) return false;
  if (lamp.face_count == 1 && !(lamps_.faces(lamp)[0].height(look.point) > 0)) return false;
  const double squared = length_squared(away), radius_squared = lamp.radius * lamp.radius;
  if (!(squared > radius_squared)) return true;
  const double along = dot(look.mirrored, away), reach = look.lobe.ends;
  // The cosine of what is left of the angle between r and the centre: cos(a - b) = cos a cos b + sin a sin b.
  const double across = square_root(squared - (along * along < squared ? along * along : squared));
  const double nearest = along * square_root(squared - radius_squared) + across * lamp.radius;
  const bool inside = across * square_root(squared - radius_squared) <= along * lamp.radius;
  if (inside) return true;
  if (!(nearest > reach * squared)) return false;
  const double cosine = nearest / squared;
  const double lobe = look.lobe.strength * look.lobe.raised(cosine < 1 ? cosine * cosine : 1);
  const double most = lobe * kTwoPi * radius_squared * most_luminance_of(lamp, look.point);
  return most * kWhite >= kLeastShown * scene_->display.max_cd_m2 * squared;
}

/// What it shows if nothing stands between, for luminance 1, in the first channel; 0 where that is too little to see.
double Highlights::unshadowed(const Lamp& lamp, const HighlightLook& look, Lamps::FaceSet seen) const {
  Sum sum = {0, 0, 0};
  if (!reaches(lamp, look) || !add_seen(lamp, look, seen, kNothingNear, sum)) return 0;
  const double shown = most_luminance_of(lamp, look.point) * sum[0];
  return shown * kWhite >= kLeastShown * scene_->display.max_cd_m2 ? sum[0] : 0;
}

/// Whether it would show if nothing stood between.
bool Highlights::add_lamp(const Lamp& lamp, const HighlightLook& look, Sum& luminance) const {
  const Lamps::FaceSet seen = lamps_.seen_from(lamp, look.point);
  const double most = unshadowed(lamp, look, seen);
  if (!(most > 0)) return false;
  const Light& light = scene_->lights[lamp.light];
  NearTriangles near;
  sight_.find_near(lamp, *look.surface, box_of(look.from), seen, ~seen, near);
  Sum sum = {most, most, most};
  if (near.count > 0) {
    for (double& s : sum) s = 0;
    if (!near.all() || !add_seen(lamp, look, seen, near, sum)) {
      add_points(lamp, look, luminance);
      return true;
    }
  }
  const double shines = luminance_of(lamp, look.point);
  for (std::uint32_t c = 0; c < 3; ++c) luminance[c] += light.colour.c[c] * shines * sum[c];
  return true;
}

/// For luminance 1; false if the pieces of what is seen have no room.
bool Highlights::add_seen(const Lamp& lamp, const HighlightLook& look, Lamps::FaceSet seen, const NearTriangles& near,
                          Sum& sum) const {
  if (lamp.has_outline() && !near.crossing && sight_.add_outline(lamp, look, seen, near, sum)) return true;
  for (const LampFace& face : lamps_.faces(lamp)) {
    if (face.height(look.point) > 0 && !sight_.add_face(lamp, face, look, near, sum)) return false;
  }
  return true;
}

void Highlights::add_points(const Lamp& lamp, const HighlightLook& look, Sum& luminance) const {
  for (const LampFace& face : lamps_.faces(lamp)) {
    if (face.height(look.point) > 0) add_points(lamp, face, look, luminance);
  }
}

/// By segments to points of a face.
void Highlights::add_points(const Lamp& lamp, const LampFace& face, const HighlightLook& look, Sum& sum) const {
  const Piece whole = lamp_piece(*scene_, lamp, face);
  const double strength = luminance_of(lamp, look.point) / kPoints;
  for (std::uint32_t half = 0; half < 2; ++half) {
    const PiecePart part = piece_part(whole, half);
    if (part.corners == 0) return;
    // A triangle is a quadrilateral two corners of which are one.
    const Vec3 &corner = part.corner[0], &last = part.corner[part.corners - 1];
    const Vec3 a = part.corner[1] - corner, b = last - corner, bend = (part.corner[2] - last) - a;
    for (std::uint32_t k = 0; k < kPoints; ++k) {
      const double s = (k + 0.5) / kPoints, t = (k * kPointStep % kPoints + 0.5) / kPoints;
      const Vec3 point = corner + s * a + t * b + (s * t) * bend, way = point - look.point;
      const double squared = length_squared(way), cosine = dot(look.normal, way), other = -dot(face.normal, way);
      if (!(cosine > 0) || !(other > 0)) continue;
      const double lux = strength * cosine * other / (squared * squared) * length(cross(a + t * bend, b + s * bend));
      const double shown = lux * lobe_at(look, way);
      const LatticePoint end = end_at(geometry_->lattice, whole, point);
      if (shown > 0) add_segment(lamp.light, shown, {look.from, end - look.from}, true, sum);
    }
  }
}

}  // namespace shodo
