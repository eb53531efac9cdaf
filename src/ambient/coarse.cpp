#include "ambient/coarse.h"

namespace shodo {

namespace {

constexpr std::uint32_t kMostSteps = 32;
constexpr double kReduction = 0x1p-20;  // of the squared residual: a thousandth is enough for a correction

double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

std::uint32_t Coarse::group_count(const Scene& scene) {
  const std::size_t meshes = scene.meshes.size();
  return meshes < kMostGroups ? static_cast<std::uint32_t>(meshes) : kMostGroups;
}

Status Coarse::take(Arena& arena, const Surfaces& surfaces) {
  meshes_ = static_cast<std::uint32_t>(surfaces.mesh_at.size());
  groups_ = group_count(*surfaces.scene);
  channels_ = surfaces.scene->channels;
  const std::size_t g = groups_;
  const bool taken = arena.take("coarse exchange", g * (g + 1) / 2, exchange_) &&
                     arena.take("coarse weights", g, weight_) && arena.take("coarse changes", g * channels_, change_) &&
                     arena.take("coarse residual", g, residual_) && arena.take("coarse direction", g, direction_) &&
                     arena.take("coarse image", g, image_);
  return taken ? Status{} : arena.refused();
}

std::uint64_t Coarse::bytes(const Scene& scene) {
  const std::uint64_t g = group_count(scene);
  return (4 * (g * (g + 1) / 2) + 7) / 8 * 8 + 8 * g * (4 + scene.channels);
}

std::uint32_t Coarse::group_of_mesh(std::uint32_t k) const {
  return static_cast<std::uint32_t>(std::uint64_t{k} * groups_ / meshes_);
}

void Coarse::forget() {
  for (float& exchange : exchange_) exchange = 0;
  for (double& weight : weight_) weight = 0;
}

void Coarse::start_sweep() {
  for (double& change : change_) change = 0;
}

void Coarse::apply(std::span<const double> reflectance, std::span<const double> from, std::span<double> to) const {
  for (std::uint32_t g = 0; g < groups_; ++g) {
    const double own = 2 * static_cast<double>(exchange_[at(g, g)]);
    to[g] = reflectance[g] > 0 ? (weight_[g] / reflectance[g] - own) * from[g] : 0;
  }
  for (std::uint32_t g = 0; g < groups_; ++g) {
    if (!(reflectance[g] > 0)) continue;
    for (std::uint32_t h = g + 1; h < groups_; ++h) {
      if (!(reflectance[h] > 0)) continue;
      const double t = static_cast<double>(exchange_[at(g, h)]);
      to[g] -= t * from[h];
      to[h] -= t * from[g];
    }
  }
}

void Coarse::solve(std::uint32_t channel, double relaxation, std::span<const double> area, std::span<const double> reflectance,
                   std::span<double> delta) {
  // Residual: changes of patches after i, by mean change of their group; half of its own group lies after a patch.
  for (std::uint32_t g = 0; g < groups_; ++g) {
    residual_[g] = delta[g] = direction_[g] = 0;
    if (!(reflectance[g] > 0)) continue;
    if (relaxation > 1 && area[g] > 0) {
      residual_[g] = (1 / relaxation - 1) * weight_[g] * (change_[g * channels_ + channel] / area[g]);
    }
    for (std::uint32_t h = g; h < groups_; ++h) {
      if (!(area[h] > 0)) continue;
      const double mean = change_[h * channels_ + channel] / area[h];
      residual_[g] += static_cast<double>(exchange_[at(g, h)]) * (reflectance[h] * mean);
    }
  }
  // Conjugate gradients (Hestenes and Stiefel 1952) on u = rho delta, preconditioned with the diagonal weight / rho.
  const auto preconditioned = [&](std::uint32_t g) {
    return reflectance[g] > 0 && weight_[g] > 0 ? residual_[g] * (reflectance[g] / weight_[g]) : 0;
  };
  double size = 0, first = 0;
  for (std::uint32_t step = 0; step < kMostSteps; ++step) {
    double next = 0;
    for (std::uint32_t g = 0; g < groups_; ++g) next += residual_[g] * preconditioned(g);
    if (step == 0) first = next;
    if (!(next > kReduction * first)) break;
    const double keep = step == 0 ? 0 : next / size;
    size = next;
    for (std::uint32_t g = 0; g < groups_; ++g) direction_[g] = preconditioned(g) + keep * direction_[g];
    apply(reflectance, direction_, image_);
    const double curvature = product(direction_, image_);
    if (!(curvature > 0)) break;  // rows that sum to more than 1, not scaled
    const double length = size / curvature;
    for (std::uint32_t g = 0; g < groups_; ++g) {
      delta[g] += length * direction_[g];
      residual_[g] -= length * image_[g];
    }
  }
  for (std::uint32_t g = 0; g < groups_; ++g) delta[g] = reflectance[g] > 0 ? delta[g] / reflectance[g] : 0;
}

}  // namespace shodo
