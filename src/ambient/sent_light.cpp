#include "ambient/sent_light.h"

#include <bit>

#include "light/point_source.h"
#include "scene/mesh.h"

namespace shodo {

namespace {

constexpr double kMost = 4294967295.0;
constexpr double kRoom = 4;  // for what is brighter than all that was
/// Of what a sub-patch gets directly: a light that brings less may be uneven; one that would bring more is hidden from
/// a part.
constexpr double kLeastShare = 0.5, kMostShare = 1.05;

std::uint32_t units_of(double units) {
  return static_cast<std::uint32_t>(units > 0 ? units < kMost ? units : kMost : 0);
}

}  // namespace

std::uint16_t SentLight::packed(std::uint32_t units) {
  const int width = 32 - std::countl_zero(units), shift = width > kBits ? width - kBits : 0;
  if (shift == 0) return static_cast<std::uint16_t>(units);
  const std::uint32_t half = units >> (shift - 1), kept = (half + 1) >> 1;
  const bool carried = kept >> kBits != 0 && shift < 32 - kBits;
  const std::uint32_t bits = kept >> kBits == 0 ? kept : carried ? kept >> 1 : kept - 1;
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(shift + (carried ? 1 : 0)) << kBits | bits);
}

std::uint32_t SentLight::uneven_count(const Scene& scene, double step) {
  std::uint32_t count = 0;
  for_near_lights(scene, step, [&](std::uint32_t, std::uint32_t, std::uint32_t, const NearLight&) { ++count; });
  return count < kMostUneven ? count : kMostUneven;
}

bool SentLight::take(const Scene& scene, double step, std::uint32_t uneven, const DirectLight& direct,
                     std::span<const float> ambient_lx, Arena& arena) {
  scene_ = &scene;
  step_ = step;
  direct_ = &direct;
  channels_ = scene.channels;
  const std::size_t values = std::size_t{scene.sub_patch_count} * channels_;
  if (!arena.take("light that sub-patches send", values, packed_) ||
      !arena.take("sub-patches near to lights", uneven, uneven_)) {
    return false;
  }
  double most = 0;
  for (std::size_t k = 0; k < values; ++k) {
    const double here = static_cast<double>(direct.sub_patch_lx[k]) + static_cast<double>(ambient_lx[k]);
    most = here > most ? here : most;
  }
  unit_ = kRoom * most / kMost;
  over_unit_ = most > 0 ? kMost / (kRoom * most) : 0;
  find_uneven();
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const MeshReflectance reflectance(scene, m);
    const std::uint32_t count = mesh.sub_patch_count();
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::size_t first = (std::size_t{mesh.first_sub_patch} + k) * channels_;
      double lx[3] = {0, 0, 0};
      for (std::uint32_t c = 0; c < channels_; ++c) lx[c] = static_cast<double>(ambient_lx[first + c]);
      set(reflectance, mesh, k, lx);
    }
  }
  return true;
}

/// Which of those that are near to a light have most of theirs from it, and it reaches all of them.
void SentLight::find_uneven() {
  std::uint32_t used = 0;
  for_near_lights(*scene_, step_, [&](std::uint32_t l, std::uint32_t m, std::uint32_t k, const NearLight& where) {
    const Mesh& mesh = scene_->meshes[m];
    const Light& light = scene_->lights[l];
    const std::size_t first = (std::size_t{mesh.first_sub_patch} + k) * channels_;
    if (used == uneven_.size()) return;
    const double mean = near_point_mean(*scene_, light, sub_patch_piece(*scene_, mesh, k), step_);
    double all = 0, near = 0;
    for (std::uint32_t c = 0; c < channels_; ++c) {
      all += static_cast<double>(direct_->sub_patch_lx[first + c]);
      near += light.colour.c[c] * mean;
    }
    if (!(near > kLeastShare * all && near < kMostShare * all)) return;
    Uneven& uneven = uneven_[used];
    uneven = {where, static_cast<float>(mean), {0, 0, 0}, l, 0};
    double room[3];
    const MeshReflectance reflectance(*scene_, m);
    const double* const rho = reflectance.of(reflectance.even() ? 0 : patch_of_sub_patch(mesh, k), room);
    for (std::uint32_t c = 0; c < channels_; ++c) {
      uneven.units[c] = static_cast<float>(rho[c] * light.colour.c[c] * over_unit_);
    }
    packed_[first] = static_cast<std::uint16_t>(kUneven + used++);
  });
}

void SentLight::set(const MeshReflectance& reflectance, const Mesh& mesh, std::uint32_t local,
                    const double (&ambient_lx)[3]) {
  double room[3];
  const double* const rho = reflectance.of(reflectance.even() ? 0 : patch_of_sub_patch(mesh, local), room);
  const std::size_t first = (std::size_t{mesh.first_sub_patch} + local) * channels_;
  std::uint16_t sent[3] = {0, 0, 0};
  for (std::uint32_t c = 0; c < channels_; ++c) {
    const double lx = static_cast<double>(direct_->sub_patch_lx[first + c]) + ambient_lx[c];
    sent[c] = packed(units_of(rho[c] * lx * over_unit_));
  }
  if (is_uneven(&packed_[first])) {
    uneven_[packed_[first] - kUneven].first = sent[0];
  } else {
    packed_[first] = sent[0];
  }
  for (std::uint32_t c = 1; c < channels_; ++c) packed_[first + c] = sent[c];
}

void SentLight::from(const std::uint16_t* sent, const Vec3& point, std::uint32_t (&units)[3]) const {
  const Uneven& uneven = uneven_[*sent - kUneven];
  const double more = uneven.where.lux(*scene_, scene_->lights[uneven.light], point, step_) -
                      static_cast<double>(uneven.mean);
  for (std::uint32_t c = 0; c < channels_; ++c) {
    const std::uint32_t mean = unpacked(c == 0 ? static_cast<std::uint16_t>(uneven.first) : sent[c]);
    units[c] = units_of(mean + static_cast<double>(uneven.units[c]) * more);
  }
}

}  // namespace shodo
