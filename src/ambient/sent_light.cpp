#include "ambient/sent_light.h"

#include <bit>

#include "scene/mesh.h"

namespace shodo {

namespace {

constexpr double kMost = 4294967295.0;
constexpr double kRoom = 4;  // for what is brighter than all that was

}  // namespace

std::uint16_t SentLight::packed(std::uint32_t units) {
  const int width = 32 - std::countl_zero(units), shift = width > kBits ? width - kBits : 0;
  if (shift == 0) return static_cast<std::uint16_t>(units);
  const std::uint32_t half = units >> (shift - 1), kept = (half + 1) >> 1;
  const bool carried = kept >> kBits != 0 && shift < 32 - kBits;
  const std::uint32_t bits = kept >> kBits == 0 ? kept : carried ? kept >> 1 : kept - 1;
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(shift + (carried ? 1 : 0)) << kBits | bits);
}

bool SentLight::take(const Scene& scene, const DirectLight& direct, std::span<const float> ambient_lx, Arena& arena) {
  direct_ = &direct;
  channels_ = scene.channels;
  const std::size_t values = std::size_t{scene.sub_patch_count} * channels_;
  if (!arena.take("light that sub-patches send", values, packed_)) return false;
  double most = 0;
  for (std::size_t k = 0; k < values; ++k) {
    const double here = static_cast<double>(direct.sub_patch_lx[k]) + static_cast<double>(ambient_lx[k]);
    most = here > most ? here : most;
  }
  unit_ = kRoom * most / kMost;
  over_unit_ = most > 0 ? kMost / (kRoom * most) : 0;
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

void SentLight::set(const MeshReflectance& reflectance, const Mesh& mesh, std::uint32_t local,
                    const double (&ambient_lx)[3]) {
  double room[3];
  const double* const rho = reflectance.of(reflectance.even() ? 0 : patch_of_sub_patch(mesh, local), room);
  const std::size_t first = (std::size_t{mesh.first_sub_patch} + local) * channels_;
  for (std::uint32_t c = 0; c < channels_; ++c) {
    const double lx = static_cast<double>(direct_->sub_patch_lx[first + c]) + ambient_lx[c];
    const double units = rho[c] * lx * over_unit_;
    packed_[first + c] = packed(static_cast<std::uint32_t>(units > 0 ? units < kMost ? units : kMost : 0));
  }
}

}  // namespace shodo
