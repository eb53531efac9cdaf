#include "light/sources.h"

#include "light/distribution.h"
#include "light/point_source.h"
#include "light/polygon_factor.h"

namespace shodo {

namespace {

Vec3 unit_of(const LatticeVector& v) {
  return normalised({static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
}

}  // namespace

Status Sources::prepare(Arena& arena) {
  const std::uint32_t emitters = count_emitters(*scene_);
  if (!arena.take("light sources", count(), sources_) || !arena.take("emitters", emitters, emitters_) ||
      !arena.take("emitters' ends", emitters, emitter_ends_)) {
    return arena.refused();
  }
  std::uint32_t next = 0;
  for (std::uint32_t l = 0; l < count(); ++l) {
    sources_[l].first_emitter = next;
    list_emitters(l, next);
    sources_[l].emitter_count = next - sources_[l].first_emitter;
    if (intersector_->seeking()) prepare_ends(l);
    if (light(l).kind != LightKind::kSun) continue;
    sources_[l].to_sun = lattice_direction(-light(l).towards);
    sources_[l].to_sun_unit = unit_of(sources_[l].to_sun);
  }
  return {};
}

std::uint32_t Sources::count_emitters(const Scene& scene) {
  std::uint32_t total = 0;
  for (const Light& light : scene.lights) {
    if (light.kind == LightKind::kArea) ++total;
    if (light.kind != LightKind::kPolyhedron) continue;
    const Object& object = scene.objects[light.object];
    for (std::uint32_t m = 0; m < object.mesh_count; ++m) total += cell_count(scene.meshes[object.first_mesh + m]);
  }
  return total;
}

std::uint64_t Sources::bytes(const Scene& scene) {
  static_assert(sizeof(Source) % 8 == 0 && sizeof(Emitter) % 8 == 0 && sizeof(LatticeBox) % 8 == 0);
  const std::uint64_t a_face = sizeof(Emitter) + sizeof(LatticeBox);
  return sizeof(Source) * scene.lights.size() + a_face * count_emitters(scene);
}

void Sources::list_emitters(std::uint32_t l, std::uint32_t& next) {
  if (light(l).kind == LightKind::kArea) emitters_[next++] = area_emitter(*scene_, l);
  if (light(l).kind != LightKind::kPolyhedron) return;
  const Object& object = scene_->objects[light(l).object];
  for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
    const std::uint32_t cells = cell_count(scene_->meshes[m]);
    for (std::uint32_t cell = 0; cell < cells; ++cell) emitters_[next++] = face_emitter(*scene_, l, m, cell);
  }
}

Link Sources::link(std::uint32_t l, const Receiver& receiver) const {
  return {static_cast<std::uint32_t>(scene_->objects.size()) + l, receiver.object, LightSet::kDirect};
}

void Sources::prepare_ends(std::uint32_t l) {
  Source& source = sources_[l];
  source.ends = {};
  if (light(l).kind == LightKind::kPoint) source.ends.include(geometry_->light_points[l]);
  for (std::uint32_t e = source.first_emitter; e < source.first_emitter + source.emitter_count; ++e) {
    emitter_ends_[e] = ends_box(*scene_, *geometry_, emitters_[e]);
    source.ends.include(emitter_ends_[e]);
  }
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
             ? intersector_->aim_along(expected_, sources_[l].to_sun, link(l, receiver))
             : intersector_->aim(expected_, sources_[l].ends, link(l, receiver));
  return aim_;
}

Received Sources::receive(std::uint32_t l, const Receiver& receiver, const Sample& sample, bool trace_dark) {
  switch (light(l).kind) {
    case LightKind::kPoint:
      return receive_point(l, receiver, sample, trace_dark);
    case LightKind::kSun:
      return receive_sun(l, receiver, sample);
    case LightKind::kArea:
    case LightKind::kPolyhedron:
      return receive_faces(l, receiver, sample);
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
  return received;
}

/// Faces ascending; `finer` times as many cuts as at first. A face the tried points of which all lie below the horizon
/// is taken to be as visible as the rest.
Sources::Faces Sources::look_at_faces(std::uint32_t l, const Receiver& receiver, const Sample& sample,
                                      std::uint32_t finer) {
  const Source& source = sources_[l];
  Faces faces;
  for (std::uint32_t e = source.first_emitter; e < source.first_emitter + source.emitter_count; ++e) {
    const Emitter& emitter = emitters_[e];
    if (!(emitter.height(sample.point) > 0)) continue;
    const Piece piece = emitter_piece(*scene_, emitter);
    const double f = point_to_polygon(sample.point, receiver.normal, piece.corner, piece.corners);
    if (!(f > 0)) continue;
    faces.factor += f;
    const Aim aim = intersector_->narrow(aim_at(l, receiver, sample), sample.lattice, emitter_ends_[e]);
    const Seen seen = look(*scene_, *geometry_, *intersector_, emitter, piece, receiver, sample,
                           finer * first_cuts(emitter, f, source.emitter_count), aim);
    if (!(seen.all > 0)) continue;
    faces.tested += f;
    faces.arrives += f * (seen.arrives / seen.all);
    faces.some_blocked = faces.some_blocked || seen.some_blocked;
  }
  return faces;
}

/// E = pi L times the sum of F over the faces; visible: the mean of the faces' visible parts, weighted by F.
Received Sources::receive_faces(std::uint32_t l, const Receiver& receiver, const Sample& sample) {
  Faces faces = look_at_faces(l, receiver, sample, 1);
  if (!(faces.factor > 0)) return {};
  const bool mixed = faces.some_blocked && faces.arrives > 0;
  if (mixed || !(faces.tested > 0)) faces = look_at_faces(l, receiver, sample, 2);
  const double step = geometry_->lattice.step();
  const double distance = length(light(l).position - sample.point);
  const double metres = (distance > step ? distance : step) * scene_->metres_per_unit;
  Received received;
  received.lux = kPi * light(l).strength * faces.factor * relative_attenuation(light(l), metres);
  received.visible = faces.tested > 0 ? faces.arrives / faces.tested : 0;
  if (light(l).kind == LightKind::kArea) received.factor = faces.factor;
  return received;
}

}  // namespace shodo
