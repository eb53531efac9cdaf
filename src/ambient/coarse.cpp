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

std::uint32_t parts(std::uint32_t count, std::uint32_t edge) { return (count + edge - 1) / edge; }

/// Parts of e x e patches that the meshes have.
std::uint64_t parts_of_meshes(const Scene& scene, std::uint32_t edge) {
  std::uint64_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += std::uint64_t{parts(mesh.nu, edge)} * parts(mesh.nv, edge);
  return count;
}

/// e; 0: meshes stay whole.
std::uint32_t edge_of_parts(const Scene& scene, const Rules& rules) {
  const std::uint32_t wanted = scene.patch_count / 4, most = wanted < kMostParts ? wanted : kMostParts;
  if (node_count(scene, rules) > scene.patch_count || scene.meshes.size() >= most) return 0;
  std::uint32_t edge = 1;
  while (parts_of_meshes(scene, edge) > most) ++edge;
  return edge;
}

}  // namespace

std::uint32_t Coarse::group_count(const Scene& scene, const Rules& rules) {
  const std::uint32_t edge = edge_of_parts(scene, rules);
  if (edge > 0) return static_cast<std::uint32_t>(parts_of_meshes(scene, edge));
  const std::size_t meshes = scene.meshes.size();
  return meshes < kMostGroups ? static_cast<std::uint32_t>(meshes) : kMostGroups;
}

Status Coarse::take(Arena& arena, const Surfaces& surfaces, const Rules& rules) {
  const Scene& scene = *surfaces.scene;
  const std::uint32_t edge = edge_of_parts(scene, rules);
  meshes_ = static_cast<std::uint32_t>(surfaces.mesh_at.size());
  groups_ = group_count(scene, rules);
  channels_ = scene.channels;
  const std::size_t g = groups_;
  const bool taken = arena.take("coarse exchange", g * (g + 1) / 2, exchange_) &&
                     arena.take("coarse weights", g, weight_) && arena.take("coarse changes", g * channels_, change_) &&
                     arena.take("coarse residual", g, residual_) && arena.take("coarse direction", g, direction_) &&
                     arena.take("coarse image", g, image_) &&
                     arena.take("parts of meshes", edge > 0 ? surfaces.size() : 0, part_);
  if (!taken) return arena.refused();
  if (edge > 0) cut_meshes(surfaces, edge);
  return {};
}

void Coarse::cut_meshes(const Surfaces& surfaces, std::uint32_t edge) {
  std::uint32_t first = 0;
  for (std::uint32_t k = 0; k < meshes_; ++k) {
    const Mesh& mesh = surfaces.scene->meshes[surfaces.mesh_at[k]];
    const std::uint32_t width = parts(mesh.nu, edge);
    for (std::uint32_t i = surfaces.mesh_begin[k]; i < surfaces.mesh_begin[k + 1]; ++i) {
      const PieceIndex at = patch_index(mesh, surfaces.patch_at[i] - mesh.first_patch);
      part_[i] = static_cast<std::uint8_t>(first + at.v / edge * width + at.u / edge);
    }
    first += width * parts(mesh.nv, edge);
  }
}

std::uint64_t Coarse::bytes(const Scene& scene, const Rules& rules) {
  const std::uint64_t g = group_count(scene, rules);
  const std::uint64_t part = edge_of_parts(scene, rules) > 0 ? scene.patch_count : 0;
  return (4 * (g * (g + 1) / 2) + 7) / 8 * 8 + 8 * g * (4 + scene.channels) + (part + 7) / 8 * 8;
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

void Coarse::correct(std::uint32_t channel, std::span<const double> area, std::span<const double> reflectance,
                     std::span<double> delta) {
  // Residual: changes of patches after i, by mean change of their group; half of its own group lies after a patch.
  for (std::uint32_t g = 0; g < groups_; ++g) {
    residual_[g] = 0;
    if (!(reflectance[g] > 0)) continue;
    for (std::uint32_t h = g; h < groups_; ++h) {
      if (!(area[h] > 0)) continue;
      const double mean = change_[h * channels_ + channel] / area[h];
      residual_[g] += static_cast<double>(exchange_[at(g, h)]) * (reflectance[h] * mean);
    }
  }
  solve(reflectance, kMostSteps, kReduction, delta);
  for (std::uint32_t g = 0; g < groups_; ++g) delta[g] = reflectance[g] > 0 ? delta[g] / reflectance[g] : 0;
}

void Coarse::solve(std::span<const double> reflectance, std::uint32_t most_steps, double reduction,
                   std::span<double> u) {
  for (std::uint32_t g = 0; g < groups_; ++g) u[g] = direction_[g] = 0;
  // Conjugate gradients (Hestenes and Stiefel 1952), preconditioned with the diagonal weight / rho.
  const auto preconditioned = [&](std::uint32_t g) {
    return reflectance[g] > 0 && weight_[g] > 0 ? residual_[g] * (reflectance[g] / weight_[g]) : 0;
  };
  double size = 0, first = 0;
  for (std::uint32_t step = 0; step < most_steps; ++step) {
    double next = 0;
    for (std::uint32_t g = 0; g < groups_; ++g) next += residual_[g] * preconditioned(g);
    if (step == 0) first = next;
    if (!(next > reduction * first)) break;
    const double keep = step == 0 ? 0 : next / size;
    size = next;
    for (std::uint32_t g = 0; g < groups_; ++g) direction_[g] = preconditioned(g) + keep * direction_[g];
    apply(reflectance, direction_, image_);
    const double curvature = product(direction_, image_);
    if (!(curvature > 0)) break;  // rows that sum to more than 1, not scaled
    const double length = size / curvature;
    for (std::uint32_t g = 0; g < groups_; ++g) {
      u[g] += length * direction_[g];
      residual_[g] -= length * image_[g];
    }
  }
}

}  // namespace shodo
