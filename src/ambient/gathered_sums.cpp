#include "ambient/gathered_sums.h"

#include <new>

#include "base/finite.h"

namespace shodo {

namespace {

constexpr std::uint64_t block(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

bool GatheredSums::take(const Scene& scene, std::span<float> lx, Arena& arena, Arena& for_lines) {
  static_assert(sizeof(float) == sizeof(std::uint32_t));
  channels_ = scene.channels;
  lx_ = lx;
  words_ = reinterpret_cast<std::uint32_t*>(lx.data());
  const std::size_t count = scene.sub_patch_count;
  if (!for_lines.take("lines of sub-patches", count, lines_) || !for_lines.take("scales of sums", count, scale_) ||
      !arena.take("backs over sub-patches", count, backs_)) {
    return false;
  }
  for (std::uint16_t& lines : lines_) lines = kMost;  // and no backs
  for (std::uint8_t& scale : scale_) scale = kNever;
  return true;
}

GatheredSums::Bytes GatheredSums::bytes(const Scene& scene) {
  const std::uint64_t count = scene.sub_patch_count;
  return {block(2 * count) + block(count), block(2 * count)};
}

void GatheredSums::start(std::uint32_t sub_patch, std::uint32_t lines, double unit) {
  const std::size_t first = std::size_t{sub_patch} * channels_;
  double units[3] = {0, 0, 0}, most = 0;
  for (std::uint32_t c = 0; c < channels_; ++c) {
    units[c] = unit > 0 ? lines * (static_cast<double>(lx_[first + c]) / unit) : 0;
    most = units[c] > most ? units[c] : most;
  }
  std::uint8_t scale = 1;  // so that the brightest light has 31 bits
  double over = 0.5;
  for (; most * over >= 0x1p31; over *= 0.5) ++scale;
  for (std::uint32_t c = 0; c < channels_; ++c) {
    new (&lx_[first + c]) std::uint32_t(static_cast<std::uint32_t>(units[c] > 0 ? units[c] * over : 0));
  }
  scale_[sub_patch] = scale;
  lines_[sub_patch] = static_cast<std::uint16_t>(lines);
}

void GatheredSums::halve(std::uint32_t sub_patch) {
  for (std::uint32_t c = 0; c < channels_; ++c) words_[std::size_t{sub_patch} * channels_ + c] >>= 1;
}

bool GatheredSums::forget_half(std::uint32_t sub_patch) {
  if (!started(sub_patch) || sees_backs(sub_patch)) return false;
  halve(sub_patch);
  lines_[sub_patch] /= 2;
  backs_[sub_patch] /= 2;
  return true;
}

double GatheredSums::mean(std::uint32_t sub_patch, std::uint32_t channel, double unit) const {
  double scale = unit;
  for (std::uint32_t k = 0; k < scale_[sub_patch]; ++k) scale *= 2;
  return scale * words_[std::size_t{sub_patch} * channels_ + channel] / lines_[sub_patch];
}

void GatheredSums::finish(std::uint32_t sub_patch, const double (&lx)[3]) {
  for (std::uint32_t c = 0; c < channels_; ++c) {
    new (&lx_[std::size_t{sub_patch} * channels_ + c]) float(static_cast<float>(finite(lx[c])));
  }
  scale_[sub_patch] = kNever;
  lines_[sub_patch] = kMost;
}

}  // namespace shodo
