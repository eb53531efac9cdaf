#include "light/sources.h"

#include "light/distribution.h"
#include "light/point_source.h"

namespace shodo {

namespace {

/// A patch is as far from a light as so many of its own radii, or more, if its factors are interpolated.
constexpr double kFieldRadii = 4;
/// A sub-patch likewise, if its centre's factor is taken for its mean: within 1/1000.
constexpr double kCentreRadii = 12;

}  // namespace

Status Sources::prepare(Arena& arena) {
  const EmitterCount total = count_emitters(*scene_);
  if (!arena.take("light sources", count(), sources_) || !arena.take("emitters", total.faces, emitters_.faces) ||
      !arena.take("ends of segments to lights", total.ends, emitters_.ends) ||
      !arena.take("ends on the lattice", total.ends, emitters_.lattice_ends) || !aims_.take(arena, count())) {
    return arena.refused();
  }
  EmitterCount next;
  for (std::uint32_t l = 0; l < count(); ++l) {
    Source& source = sources_[l];
    source = {};
    source.first_emitter = next.faces;
    list_emitters(l, next);
    source.emitter_count = next.faces - source.first_emitter;
    enclose(source);
    if (light(l).kind == LightKind::kArea) {
      const Emitter& emitter = emitters_.faces[source.first_emitter];
      source.grid = EndGrid(emitters_.lattice_ends.subspan(emitter.first_end, kAreaEnds), emitter.box);
    }
    if (light(l).kind == LightKind::kPoint) source.ends.include(geometry_->light_points[l]);
    if (light(l).kind != LightKind::kSun) continue;
    source.to_sun = lattice_direction(-light(l).towards);
    source.to_sun_unit = normalised(vector_of(source.to_sun));
  }
  return {};
}

/// E A / (pi L A_e), or of a polyhedron, for a sphere, E A / (4 pi I).
double Sources::share_squared(std::uint32_t l, const SubPatchView& view, double area,
                              double shared_factor) const {
  const Source& source = sources_[l];
  const double squared = length_squared(source.centre - view.centre);
  const double near = source.radius + (shared_factor > 0 ? kFieldRadii : kCentreRadii) * view.radius;
  if (squared < near * near) return 1;
  // Parts of light and sub-patch are as much higher as half a radius.
  const double above = view.receiver->height(source.centre) + 0.5 * source.radius;
  if (!(above > 0)) return 0;
  const Emitter& face = emitters_.faces[source.first_emitter];
  double share = area * kInversePi / squared;
  if (!face.is_area()) return 0.0625 * share * share * (above * above / squared);
  const double front = face.height(view.centre) + 0.5 * face.radius;
  if (front > 0) share *= above * front / squared;
  return front > 0 ? share * share : 0;
}

double Sources::point_share(std::uint32_t l, const Vec3& centre, double lux, double area) const {
  const Light& point = light(l);
  const double metres = scene_->metres_per_unit;
  if (!inverse_square(point)) lux /= relative_attenuation(point, length(point.position - centre) * metres);
  return lux * area * (metres * metres) / (point.strength * solid_angle_of(point));
}

void Sources::enclose(Source& source) const {
  const std::span<const Emitter> faces = emitters_.faces.subspan(source.first_emitter, source.emitter_count);
  for (const Emitter& face : faces) source.centre = source.centre + (1.0 / source.emitter_count) * face.centre;
  for (const Emitter& face : faces) {
    const double reach = length(face.centre - source.centre) + face.radius;
    if (reach > source.radius) source.radius = reach;
  }
}

void Sources::share_factors(const Receiver& receiver, const Piece& patch) {
  shared_ = true;
  patch_receiver_ = receiver;
  patch_ = patch;
  patch_centre_ = patch.centre();
  patch_radius_ = 0;
  for (const Vec3& corner : patch.corner) {
    const double reach = length(corner - patch_centre_);
    if (reach > patch_radius_) patch_radius_ = reach;
  }
  for (Source& source : sources_) source.field.state = FactorField::State::kNotYet;
}

/// Whether the patch is far enough from the light, and each is on one side of the other's plane.
FactorField::State Sources::field_of(const Source& source) const {
  const Emitter& face = emitters_.faces[source.first_emitter];
  if (!face.is_area()) {
    const double height = patch_receiver_.height(source.centre);
    if (height <= -source.radius) return FactorField::State::kDark;
    if (height < source.radius) return FactorField::State::kNone;
    const double far = length(source.centre - patch_centre_) - source.radius;
    return far >= kFieldRadii * patch_radius_ ? FactorField::State::kUsable : FactorField::State::kNone;
  }
  const Piece light = emitter_piece(*scene_, face);
  std::uint32_t above = 0, front = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (patch_receiver_.height(light.corner[k]) > 0) ++above;
    if (face.height(patch_.corner[k]) > 0) ++front;
  }
  if (above == 0 || front == 0) return FactorField::State::kDark;
  if (above < 4 || front < 4) return FactorField::State::kNone;
  // The light's point next to the patch, as if its sides were square to each other.
  Vec3 nearest = light.corner[0];
  for (const Vec3& side : {light.corner[1] - light.corner[0], light.corner[3] - light.corner[0]}) {
    const double at = dot(patch_centre_ - light.corner[0], side) / length_squared(side);
    nearest = nearest + (at > 1 ? 1 : at > 0 ? at : 0) * side;
  }
  const double reach = kFieldRadii * patch_radius_;
  const bool far = length_squared(nearest - patch_centre_) >= reach * reach;
  return far ? FactorField::State::kUsable : FactorField::State::kNone;
}

std::uint32_t Sources::faces_behind(const Source& source) const {
  std::uint32_t behind = 0;
  for (std::uint32_t e = 0; e < source.emitter_count && e < 32; ++e) {
    const Emitter& face = emitters_.faces[source.first_emitter + e];
    if (face.height(patch_centre_) < -patch_radius_) behind |= std::uint32_t{1} << e;
  }
  return behind;
}

void Sources::fill(std::uint32_t l, Source& source) {
  source.field.state = inverse_square(light(l)) ? field_of(source) : FactorField::State::kNone;
  source.behind = 0;
  if (source.field.state != FactorField::State::kUsable) return;
  if (light(l).kind == LightKind::kPolyhedron) source.behind = faces_behind(source);
  const FaceLight faces = face_light();
  const Vec3 side_s = patch_.corner[1] - patch_.corner[0], side_t = patch_.corner[3] - patch_.corner[0];
  double value[FactorField::kNodes][FactorField::kNodes];
  for (std::uint32_t j = 0; j < FactorField::kNodes; ++j) {
    for (std::uint32_t i = 0; i < FactorField::kNodes; ++i) {
      const double s = FactorField::node(i) + 0.5, t = FactorField::node(j) + 0.5;
      const Vec3 point = patch_.corner[0] + s * side_s + t * side_t;
      const double distance = length(source.centre - point) - source.radius;
      value[j][i] = faces.factor_at(point, patch_receiver_, source.first_emitter, source.emitter_count, source.behind,
                                    distance,
                                    (i + j) % 2 != 0);
    }
  }
  source.field.fit(value);
}

double Sources::shared_factor(std::uint32_t l, const Receiver& receiver) {
  if (!shared_) return -1;
  Source& source = sources_[l];
  if (source.field.state == FactorField::State::kNotYet) fill(l, source);
  if (source.field.state == FactorField::State::kDark) return 0;
  return source.field.state == FactorField::State::kUsable ? source.field.mean(receiver.place) : -1;
}

Shown Sources::shown(std::uint32_t l, const Receiver& receiver) {
  if (light(l).kind == LightKind::kSun) return Shown::kUnknown;
  const LatticeBox& ends = light(l).kind == LightKind::kPoint ? sources_[l].ends : sources_[l].whole;
  const Shown shown = aims_.shown(l, link(l, receiver), ends);
  return shown == Shown::kAll && intersector_->panes().any() ? Shown::kUnknown : shown;
}

Sources::EmitterCount Sources::count_emitters(const Scene& scene) {
  EmitterCount total;
  for (const Light& light : scene.lights) {
    if (light.kind == LightKind::kArea) {
      ++total.faces;
      total.ends += kAreaEnds;
    }
    if (light.kind != LightKind::kPolyhedron) continue;
    const Object& object = scene.objects[light.object];
    for (std::uint32_t m = 0; m < object.mesh_count; ++m) {
      const std::uint32_t cells = cell_count(scene.meshes[object.first_mesh + m]);
      total.faces += cells;
      total.ends += kFaceEnds * cells;
    }
  }
  return total;
}

std::uint64_t Sources::bytes(const Scene& scene) {
  const auto block = [](std::uint64_t size, std::uint64_t count) { return (size * count + 7) / 8 * 8; };
  const EmitterCount total = count_emitters(scene);
  const std::uint64_t ends = total.ends;
  return block(sizeof(Source), scene.lights.size()) + block(sizeof(Emitter), total.faces) +
         block(sizeof(EmitterEnd), ends) + block(sizeof(LatticePoint), ends) +
         PatchAims::bytes(static_cast<std::uint32_t>(scene.lights.size()));
}

void Sources::list_emitters(std::uint32_t l, EmitterCount& next) {
  const auto add = [&](const Emitter& emitter) {
    emitters_.faces[next.faces] = emitter;
    place_ends(*scene_, *geometry_, emitters_, next.faces, next.ends);
    sources_[l].ends.include(emitters_.faces[next.faces].box);
    sources_[l].whole.include(emitters_.faces[next.faces].box);
    sources_[l].whole.include(emitters_.faces[next.faces].whole);
    next.ends += emitter.end_count;
    ++next.faces;
  };
  if (light(l).kind == LightKind::kArea) add(area_emitter(*scene_, l));
  if (light(l).kind != LightKind::kPolyhedron) return;
  const Object& object = scene_->objects[light(l).object];
  for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
    const std::uint32_t cells = cell_count(scene_->meshes[m]);
    for (std::uint32_t cell = 0; cell < cells; ++cell) add(face_emitter(*scene_, l, m, cell));
  }
}

Link Sources::link(std::uint32_t l, const Receiver& receiver) const {
  return {static_cast<std::uint32_t>(scene_->objects.size()) + l, receiver.object, LightSet::kDirect};
}

/// Grown by two steps but where it is flat, as further samples of the same piece are rounded on their own.
void Sources::expect(const LatticeBox& samples) {
  expected_ = samples;
  aimed_ = kNone;
  for (int k = 0; k < 3; ++k) {
    if (samples.low[k] >= samples.high[k]) continue;
    expected_.low[k] -= 2;
    expected_.high[k] += 2;
  }
}

const Aim& Sources::aim_at(std::uint32_t l, const Receiver& receiver, const Sample& sample) {
  if (!intersector_->seeking()) return aim_;
  const bool inside = expected_.contains(sample.lattice, 0);
  if (!inside) expected_.include(sample.lattice);
  if (inside && aimed_ == l && aimed_object_ == receiver.object) return aim_;
  aimed_ = l;
  aimed_object_ = receiver.object;
  aim_ = light(l).kind == LightKind::kSun
             ? aims_.along(l, link(l, receiver), expected_, sources_[l].to_sun)
             : aims_.towards(l, link(l, receiver), expected_, sources_[l].ends, sources_[l].ends);
  return aim_;
}

bool Sources::may_shine_on(std::uint32_t l, const Receiver& receiver) const {
  if (light(l).kind == LightKind::kSun) return dot(receiver.normal, sources_[l].to_sun_unit) > 0;
  return receiver.height(light(l).position) > 0;
}

Received Sources::receive(std::uint32_t l, const Receiver& receiver, const Sample& sample, bool trace_dark) {
  switch (light(l).kind) {
    case LightKind::kPoint:
      return receive_point(l, receiver, sample, trace_dark);
    case LightKind::kSun:
      return receive_sun(l, receiver, sample);
    case LightKind::kArea:
    case LightKind::kPolyhedron:
      break;
  }
  return {};
}

Received Sources::receive_point(std::uint32_t l, const Receiver& receiver, const Sample& sample, bool trace_dark) {
  const PointLux direct = point_lux(*scene_, light(l), receiver, sample.point, geometry_->lattice.step());
  if (direct.clamped) ++clamped_;
  Received received;
  received.lux = direct.lux;
  if (!(direct.lux > 0) && !trace_dark) return received;
  const Aim& aim = aim_at(l, receiver, sample);
  const bool blocked =
      !aim.clear() && intersector_->blocked(sample.lattice, geometry_->light_points[l], link(l, receiver), aim);
  if (!blocked) received.visible = 1;
  const Panes& panes = intersector_->panes();
  if (!blocked && panes.any()) received.visible = panes.pass(sample.lattice, geometry_->light_points[l]);
  return received;
}

Received Sources::receive_sun(std::uint32_t l, const Receiver& receiver, const Sample& sample) {
  const double cosine = dot(receiver.normal, sources_[l].to_sun_unit);
  if (!(cosine > 0)) return {};
  Received received;
  received.lux = light(l).strength * cosine;
  const Aim& aim = aim_at(l, receiver, sample);
  const bool blocked =
      !aim.clear() && intersector_->ray_blocked(sample.lattice, sources_[l].to_sun, link(l, receiver), aim);
  if (!blocked) received.visible = 1;
  const Panes& panes = intersector_->panes();
  if (!blocked && panes.any()) received.visible = panes.pass_along(sample.lattice, sources_[l].to_sun);
  return received;
}

FaceLook Sources::look(std::uint32_t l, const SubPatchView& view, const ReceiverGroup& group, double shared_factor) {
  const Source& source = sources_[l];
  aimed_ = kNone;  // another wide aim follows
  const EndGrid* const grid = light(l).kind == LightKind::kArea ? &source.grid : nullptr;
  return face_light().look(view, group, link(l, *view.receiver), source.first_emitter, source.emitter_count,
                           source.ends, source.whole, grid, shared_factor, source.behind);
}

FaceLook Sources::factors(std::uint32_t l, const SubPatchView& view, const ReceiverGroup& group, FaceReach reach) {
  return face_light().factors(view, group, reach, sources_[l].first_emitter, sources_[l].emitter_count);
}

/// E = pi L times the sum of F over the faces; visible: the mean of the faces' visible parts, weighted by F.
Received Sources::received(std::uint32_t l, const ReceiverGroup& group, const FaceLook& look, std::uint32_t k) const {
  Received received;
  received.lux = kPi * light(l).strength * look.factor[k];
  if (!inverse_square(light(l))) {
    const double step = geometry_->lattice.step();
    const double distance = length(light(l).position - group.point[k]);
    const double metres = (distance > step ? distance : step) * scene_->metres_per_unit;
    received.lux *= relative_attenuation(light(l), metres);
  }
  received.visible = look.visible(k);
  if (light(l).kind == LightKind::kArea) received.factor = look.factor[k];
  return received;
}

Received Sources::all_of(std::uint32_t l, double shared_factor) const {
  Received received;
  received.lux = kPi * light(l).strength * shared_factor;
  received.visible = 1;
  if (light(l).kind == LightKind::kArea) received.factor = shared_factor;
  return received;
}

}  // namespace shodo
