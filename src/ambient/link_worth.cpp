#include "ambient/link_worth.h"

namespace shodo {

std::uint64_t LinkWorth::bytes(const Scene& scene, const Rules& rules) {
  if (!rules.blocks) return 0;
  const std::uint64_t blocks = block_count(scene, rules), nodes = scene.patch_count + blocks;
  return (4 * nodes + 7) / 8 * 8 + (4 * blocks + 7) / 8 * 8;
}

Status LinkWorth::take(Arena& arena, const Surfaces& surfaces, const DirectLight& direct, const Rules& rules) {
  if (!rules.blocks) return {};
  const double error = rules.blocks_error > 0 ? rules.blocks_error : kBlocksError;
  allowed_ = error * error;
  surfaces_ = &surfaces;
  if (!arena.take("light sent", surfaces.size(), sent_) || !arena.take("unevenness", surfaces.blocks.size(), uneven_)) {
    return arena.refused();
  }
  estimate(surfaces, direct);
  return {};
}

void LinkWorth::estimate(const Surfaces& s, const DirectLight& direct) {
  const std::uint32_t channels = s.scene->channels;
  double area = 0, mean = 0, ambient[3] = {0, 0, 0};
  // White, on a white surface: what is brighter is displayed no brighter.
  const double shown_lx = kPi * s.scene->display.max_cd_m2;
  double room[3];
  const auto reflectance = [&](std::uint32_t node) { return s.reflectance(node, room); };
  for (std::uint32_t node = 0; node < s.size(); ++node) {
    if (!s.is_block(node)) area += s.root_area[node] * s.root_area[node];
  }
  if (!(area > 0)) return;
  for (std::uint32_t c = 0; c < channels; ++c) {
    double absorbing = 0, reflected = 0, direct_light = 0;
    for (std::uint32_t node = 0; node < s.size(); ++node) {
      if (s.is_block(node) || !(s.root_area[node] > 0)) continue;
      const double part = s.root_area[node] * s.root_area[node], rho = reflectance(node)[c];
      const double lx = direct.patch_lx[std::size_t{s.patch_at[node]} * channels + c];
      absorbing += part * (1 - rho);
      reflected += part * rho * lx;
      direct_light += part * (lx < shown_lx ? lx : shown_lx);
    }
    ambient[c] = reflected / absorbing;
    mean += direct_light / area + (ambient[c] < shown_lx ? ambient[c] : shown_lx);
  }
  const double scale = mean > 0 ? 1 / (mean * square_root(area)) : 0;
  for (std::uint32_t node = s.size(); node-- > 0;) {
    if (!(s.root_area[node] > 0)) continue;
    const double own = s.root_area[node] * s.root_area[node];
    if (s.is_block(node)) {  // its parts are numbered after it
      double sum = 0, squares = 0;
      for (std::uint32_t child = node + 1; child < s.end(node); child = s.end(child)) {
        const double part = s.root_area[child] * s.root_area[child], of_child = sent(child);
        sum += square_root(of_child * part);
        squares += of_child + uneven(child);
      }
      const double mean_square = sum * sum / own, rest = squares - mean_square;
      sent_[node] = static_cast<float>(mean_square);
      uneven_[s.patch_at[node] - s.scene->patch_count] = rest > 0 ? static_cast<float>(rest) : 0.0f;
      continue;
    }
    double sum = 0;
    for (std::uint32_t c = 0; c < channels; ++c) {
      sum += reflectance(node)[c] * (direct.patch_lx[std::size_t{s.patch_at[node]} * channels + c] + ambient[c]);
    }
    sent_[node] = static_cast<float>(sum * scale * (sum * scale) * own);
  }
}

}  // namespace shodo
