#include "light/mirror_light.h"

#include "light/distribution.h"
#include "light/piece_grid.h"
#include "light/receiver_group.h"
#include "visibility/half_open.h"

namespace shodo {

namespace {

/// visit(triangle, mesh, cell, optics) for all triangles of mirrors.
template <class Visit>
void for_mirrors(const Scene& scene, const Geometry& geometry, Visit visit) {
  for (std::uint32_t m = 0; m < scene.meshes.size() && !scene.optics.empty(); ++m) {
    const Optics* const optics = scene.optics_of(scene.meshes[m].material);
    if (optics == nullptr || !optics->mirrors()) continue;
    const std::uint32_t cells = cell_count(scene.meshes[m]);
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
      const PolygonTriangles range = geometry.cells[geometry.first_cell[m] + cell];
      for (std::uint32_t t = range.first; t < range.first + range.count; ++t) {
        visit(t, m, cell, static_cast<std::uint32_t>(optics - scene.optics.data()));
      }
    }
  }
}

}  // namespace

/// From a light's point, or a sun, over a mirror.
struct MirrorLight::Way {
  std::uint32_t light;
  Vec3 to_image;       // from the sample; of a sun its mirrored direction
  Vec3 on_mirror;
  bool sun;
  LatticePoint end;    // at the light
  LatticeVector to_sun;
  double lux;          // nothing in the way
};

bool MirrorLight::take(Arena& arena) {
  const Scene& scene = sources_->scene();
  const Geometry& geometry = sources_->geometry();
  std::size_t count = 0;
  for_mirrors(scene, geometry, [&](std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t) { ++count; });
  if (!arena.take("mirrors", count, mirrors_)) return false;
  std::size_t next = 0;
  for_mirrors(scene, geometry, [&](std::uint32_t t, std::uint32_t mesh, std::uint32_t cell, std::uint32_t optics) {
    const Triangle& triangle = geometry.triangles[t];
    Mirror& mirror = mirrors_[next++];
    mirror.normal = normalised(vector_of(triangle.n));
    mirror.plane = dot(mirror.normal, scene_point(geometry.lattice, triangle.a));
    mirror.triangle = t;
    mirror.mesh = mesh;
    mirror.cell = cell;
    mirror.optics = optics;
  });
  return true;
}

std::uint64_t MirrorLight::bytes(const Scene& scene, const Geometry& geometry) {
  static_assert(sizeof(Mirror) == 48);
  std::uint64_t count = 0;
  for_mirrors(scene, geometry, [&](std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t) { ++count; });
  return sizeof(Mirror) * count;
}

void MirrorLight::add(const Receiver& receiver, const Piece& piece, bool thin, double (&lux)[3]) {
  const PieceGrid grid(piece, kGridCuts, thin);
  double total = 0;
  for (std::uint32_t k = 0; k < grid.count(); ++k) total += grid.weight(k);
  for (std::uint32_t k = 0; k < grid.count() && total > 0; ++k) {
    const Sample sample = sample_at(sources_->scene(), sources_->geometry(), receiver, grid.point(k));
    for (const Mirror& mirror : mirrors_) {
      if (mirror.height(sample.point) > 0) add_sample(receiver, sample, mirror, grid.weight(k) / total, lux);
    }
  }
}

void MirrorLight::add_sample(const Receiver& receiver, const Sample& sample, const Mirror& mirror, double weight,
                             double (&lux)[3]) {
  const Scene& scene = sources_->scene();
  const double height = mirror.height(sample.point);
  const auto image_way = [&](std::uint32_t l, const Vec3& source, Way& way) {
    const double other = mirror.height(source);
    if (!(other > 0)) return false;
    way.light = l;
    way.sun = false;
    way.to_image = source - (2 * other) * mirror.normal - sample.point;
    way.on_mirror = sample.point + (height / (height + other)) * way.to_image;
    return dot(receiver.normal, way.to_image) > 0;
  };
  Way way;
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    if (light.kind == LightKind::kPoint && image_way(l, light.position, way)) {
      const double far = length(way.to_image);
      way.lux = weight * intensity(scene, light, way.on_mirror - light.position) *
                (dot(receiver.normal, way.to_image) / far) * attenuation(light, far * scene.metres_per_unit);
      way.end = sources_->geometry().light_points[l];
      add_way(receiver, sample, mirror, way, lux);
    }
    if (light.kind != LightKind::kSun) continue;
    way.to_image = mirror.turned(-light.towards);
    const double down = -dot(mirror.normal, way.to_image), cosine = dot(receiver.normal, way.to_image);
    if (!(down > 0) || !(cosine > 0)) continue;
    way.light = l;
    way.sun = true;
    way.on_mirror = sample.point + (height / down) * way.to_image;
    way.to_sun = lattice_direction(-light.towards);
    way.lux = weight * light.strength * cosine;
    add_way(receiver, sample, mirror, way, lux);
  }
  const Emitters& emitters = sources_->emitters();
  for (const Emitter& face : emitters.faces) {
    const Light& light = scene.lights[face.light];
    const std::uint32_t first = face.first_end;
    const std::uint32_t count = face.is_area() ? kFewEnds : kFaceEnds;
    double shares = 0;
    for (std::uint32_t e = first; e < first + count; ++e) shares += emitters.ends[e].weight;
    for (std::uint32_t e = first; e < first + count && shares > 0; ++e) {
      const Vec3& source = emitters.ends[e].point;
      if (!image_way(face.light, source, way)) continue;
      const Vec3 leaves = way.on_mirror - source;
      const double out = dot(face.normal, leaves);
      if (!(out > 0)) continue;
      const double squared = length_squared(way.to_image);
      way.lux = weight * light.strength * face.area * (emitters.ends[e].weight / shares) *
                dot(receiver.normal, way.to_image) * (out / length(leaves)) / (squared * square_root(squared));
      if (!inverse_square(light)) {
        way.lux *= relative_attenuation(light, square_root(squared) * scene.metres_per_unit);
      }
      way.end = emitters.lattice_ends[e];
      add_way(receiver, sample, mirror, way, lux);
    }
  }
}

/// Both legs.
void MirrorLight::add_way(const Receiver& receiver, const Sample& sample, const Mirror& mirror, const Way& way,
                          double (&lux)[3]) {
  const Scene& scene = sources_->scene();
  const Geometry& geometry = sources_->geometry();
  Intersector& intersector = sources_->intersector();
  if (!(way.lux > 0)) return;
  if (!passes(geometry.triangles[mirror.triangle], sample.lattice, lattice_direction(way.to_image))) return;
  const std::uint32_t object = scene.meshes[mirror.mesh].object;
  const std::uint32_t light = static_cast<std::uint32_t>(scene.objects.size()) + way.light;
  const LatticePoint at = sample_point(scene, geometry, mirror.mesh, mirror.cell, way.on_mirror);
  const Link near{object, receiver.object, LightSet::kDirect}, far{light, object, LightSet::kDirect};
  if (intersector.blocked(sample.lattice, at, near)) return;
  if (way.sun ? intersector.ray_blocked(at, way.to_sun, far) : intersector.blocked(at, way.end, far)) return;
  const Rgb& reflect = scene.optics[mirror.optics].reflect;
  const Rgb& colour = scene.lights[way.light].colour;
  for (std::uint32_t c = 0; c < scene.channels; ++c) {
    double part = 1;
    if (intersector.panes().any()) {
      intersector.set_channel(c);
      const Panes& panes = intersector.panes();
      part = panes.pass(sample.lattice, at) * (way.sun ? panes.pass_along(at, way.to_sun) : panes.pass(at, way.end));
    }
    lux[c] += colour.c[c] * reflect.c[c] * part * way.lux;
  }
  intersector.set_channel(0);
}

}  // namespace shodo
