#include "ambient/gather_senders.h"

#include "scene/sub_patches.h"

namespace shodo {

std::uint64_t GatherSenders::bytes(const Scene& scene, const Rules& rules) {
  const std::uint64_t blocks = block_count(scene, rules), nodes = scene.patch_count + blocks;
  return (4 * blocks * scene.channels + 7) / 8 * 8 + (2 * nodes + 7) / 8 * 8;
}

Status GatherSenders::take(Arena& arena, const Surfaces& s, const DirectLight& direct, const AmbientLight& ambient,
                           std::span<const float> ambient_lx) {
  surfaces_ = &s;
  direct_ = &direct;
  ambient_ = &ambient;
  channels_ = s.scene->channels;
  if (!arena.take("light that blocks send", s.blocks.size() * channels_, radiosity_) ||
      !arena.take("unevenness", s.size(), uneven_)) {
    return arena.refused();
  }
  double area = 0, light = 0;
  for (std::uint32_t node = 0; node < s.size(); ++node) {
    if (s.is_block(node) || !(s.root_area[node] > 0)) continue;
    const double part = s.root_area[node] * s.root_area[node];
    area += part;
    for (std::uint32_t c = 0; c < channels_; ++c) {
      const std::size_t at = std::size_t{s.patch_at[node]} * channels_ + c;
      light += part * (direct.patch_lx[at] + ambient.patch_lx[at]);
    }
  }
  scale_ = light > 0 ? area / light : 0;
  for (std::uint32_t node = s.size(); node-- > 0;) {  // parts are numbered after what holds them
    if (!(s.root_area[node] > 0)) continue;
    if (s.is_block(node)) {
      note_block(node);
    } else {
      note_patch(ambient_lx, node);
    }
  }
  return {};
}

void GatherSenders::radiosity(std::uint32_t node, double* lx) const {
  const Surfaces& s = *surfaces_;
  if (s.is_block(node)) {
    const float* const mean = &radiosity_[std::size_t{s.patch_at[node] - s.scene->patch_count} * channels_];
    for (std::uint32_t c = 0; c < channels_; ++c) lx[c] = static_cast<double>(mean[c]);
    return;
  }
  double room[3];
  const double* const rho = s.reflectance(node, room);
  const std::size_t at = std::size_t{s.patch_at[node]} * channels_;
  for (std::uint32_t c = 0; c < channels_; ++c) {
    lx[c] = rho[c] * (direct_->patch_lx[at + c] + ambient_->patch_lx[at + c]);
  }
}

void GatherSenders::note_uneven(std::uint32_t node, double mean_square, double mean) {
  const double variance = mean_square - mean * mean;
  const double steps = variance > 0 ? square_root(variance) * kUnevenSteps : 0;
  uneven_[node] = static_cast<std::uint16_t>(steps < 65535 ? steps + 0.5 : 65535);
}

/// From what its visible sub-patches send.
void GatherSenders::note_patch(std::span<const float> ambient_lx, std::uint32_t node) {
  const Surfaces& s = *surfaces_;
  const Mesh& mesh = s.mesh(node);
  if (mesh.su * mesh.sv == 1) return;
  double room[3];
  const double* const rho = s.reflectance(node, room);
  double sum = 0, squares = 0;
  std::uint32_t count = 0;
  SubPatchesOfPatch parts(mesh, s.local(node));
  for (std::uint32_t k = parts.next(); k != kNone; k = parts.next()) {
    const std::size_t at = mesh.first_sub_patch + std::size_t{k};
    if (!direct_->hidden.empty() && direct_->hidden[at] != 0) continue;
    double sends[3] = {0, 0, 0};
    for (std::uint32_t c = 0; c < channels_; ++c) {
      const std::size_t value = at * channels_ + c;
      sends[c] =
          rho[c] * (static_cast<double>(direct_->sub_patch_lx[value]) + static_cast<double>(ambient_lx[value]));
    }
    const double level = level_of(sends);
    sum += level;
    squares += level * level;
    ++count;
  }
  if (count > 0) note_uneven(node, squares / count, sum / count);
}

void GatherSenders::note_block(std::uint32_t node) {
  const Surfaces& s = *surfaces_;
  const double over_area = 1 / (s.root_area[node] * s.root_area[node]);
  double sums[3] = {0, 0, 0}, squares = 0;
  for (std::uint32_t child = node + 1; child < s.end(node); child = s.end(child)) {
    if (!(s.root_area[child] > 0)) continue;
    double lx[3] = {0, 0, 0};
    radiosity(child, lx);
    const double part = s.root_area[child] * s.root_area[child] * over_area, own = level_of(lx), spread = uneven(child);
    for (std::uint32_t c = 0; c < channels_; ++c) sums[c] += part * lx[c];
    squares += part * (own * own + spread * spread);
  }
  const std::size_t at = std::size_t{s.patch_at[node] - s.scene->patch_count} * channels_;
  for (std::uint32_t c = 0; c < channels_; ++c) radiosity_[at + c] = static_cast<float>(sums[c]);
  note_uneven(node, squares, level_of(sums));
}

}  // namespace shodo
