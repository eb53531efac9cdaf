#include "ambient/sparsity.h"

namespace shodo {

namespace {

bool judges(const Rules& rules) {
  return features::kRules && (rules.rule1 || rules.rule2 || rules.rule2_repeated);
}

/// The largest channel of rho E / pi, cd/m2; `ambient_lx` empty: of direct light alone.
double largest_luminance(const Surfaces& surfaces, const DirectLight& direct, std::span<const double> ambient_lx,
                         std::uint32_t node) {
  const std::uint32_t channels = surfaces.scene->channels;
  double room[3];
  const double* rho = surfaces.reflectance(node, room);
  double largest = 0;
  for (std::uint32_t c = 0; c < channels; ++c) {
    const std::size_t at = std::size_t{surfaces.patch_at[node]} * channels + c;
    const double total = direct.patch_lx[at] + (ambient_lx.empty() ? 0 : ambient_lx[at]);
    const double luminance = rho[c] * total * kInversePi;
    if (luminance > largest) largest = luminance;
  }
  return largest;
}

bool takes_part(const Surfaces& surfaces, std::uint32_t node) {
  return !surfaces.is_block(node) && surfaces.root_area[node] > 0;
}

}  // namespace

std::uint64_t Sparsity::bytes(const Scene& scene, const Rules& rules) {
  if (!judges(rules)) return 0;
  return 2 * ((std::uint64_t{node_count(scene, rules)} + 7) / 8 * 8);
}

Status Sparsity::take(Arena& arena, Surfaces& surfaces, const DirectLight& direct, const Rules& rules) {
  if (!judges(rules)) return {};
  const std::size_t nodes = surfaces.size();
  if (!arena.take("rows kept", nodes, receives_) || !arena.take("columns kept", nodes, born_)) return arena.refused();
  const Display& display = surfaces.scene->display;
  const bool rule2 = rules.rule2 || rules.rule2_repeated;
  for (std::uint32_t node = 0; node < nodes; ++node) {
    if (!takes_part(surfaces, node)) continue;
    const double luminance = largest_luminance(surfaces, direct, {}, node);
    const bool bright = rules.rule1 && luminance > display.max_cd_m2, dark = rule2 && luminance < display.min_cd_m2;
    receives_[node] = bright ? 0 : 1;
    born_[node] = dark ? kNever : 0;
    if (bright) ++rows_emptied_;
    if (dark) ++columns_dropped_;
  }
  gather_blocks(surfaces);
  return {};
}

/// A block receives if a patch in it does, and sends from when the first of them does.
void Sparsity::gather_blocks(Surfaces& surfaces) {
  for (std::uint32_t node = surfaces.size(); node-- > 0;) {
    if (!surfaces.is_block(node)) continue;
    Block& block = surfaces.block(node);
    block.senders = block.receivers = 0;
    receives_[node] = 0;
    born_[node] = kNever;
    double sending = 0;
    for (std::uint32_t child = node + 1; child < block.end; child = surfaces.end(child)) {
      if (!(surfaces.root_area[child] > 0)) continue;
      const bool inner = surfaces.is_block(child);
      block.senders += inner ? surfaces.block(child).senders : sends(child) ? 1 : 0;
      block.receivers += inner ? surfaces.block(child).receivers : receives_[child];
      sending += surfaces.root_area[child] *
                 (inner ? surfaces.block(child).sending_root : sends(child) ? surfaces.root_area[child] : 0);
      if (receives_[child] != 0) receives_[node] = 1;
      if (born_[child] < born_[node]) born_[node] = born_[child];
    }
    block.sending_root = surfaces.root_area[node] > 0 ? sending / surfaces.root_area[node] : 0;
  }
}

bool Sparsity::restore(Surfaces& surfaces, const DirectLight& direct, std::span<const double> ambient_lx) {
  if (!drops_columns() || now_ + 1u >= kGenerations) return false;
  const bool all = now_ + 2u == kGenerations;
  const double least = surfaces.scene->display.min_cd_m2;
  std::uint32_t restored = 0;
  for (std::uint32_t node = 0; node < surfaces.size(); ++node) {
    if (!takes_part(surfaces, node) || sends(node)) continue;
    if (largest_luminance(surfaces, direct, ambient_lx, node) >= least) {
      ++restored;
      born_[node] = static_cast<std::uint8_t>(now_ + 1);
    }
  }
  if (restored == 0) return false;
  for (std::uint32_t node = 0; all && node < surfaces.size(); ++node) {
    if (!takes_part(surfaces, node) || sends(node)) continue;
    ++restored;
    born_[node] = static_cast<std::uint8_t>(now_ + 1);
  }
  ++now_;
  columns_restored_ += restored;
  columns_dropped_ -= restored;
  gather_blocks(surfaces);
  return true;
}

double Sparsity::loss_bound(const Surfaces& surfaces, const DirectLight& direct,
                            std::span<const double> ambient_lx) const {
  if (!drops_columns()) return 0;
  const std::uint32_t channels = surfaces.scene->channels;
  double bound = 0, room[3];
  for (std::uint32_t c = 0; c < channels; ++c) {
    double most_reflecting = 0, lost = 0;
    for (std::uint32_t node = 0; node < surfaces.size(); ++node) {
      if (!takes_part(surfaces, node)) continue;
      const double rho = surfaces.reflectance(node, room)[c];
      if (rho > most_reflecting) most_reflecting = rho;
      const std::size_t at = std::size_t{surfaces.patch_at[node]} * channels + c;
      const double sent = rho * (direct.patch_lx[at] + ambient_lx[at]);
      if (!sends(node) && sent > lost) lost = sent;
    }
    const double of_channel = lost / (1 - most_reflecting);
    if (of_channel > bound) bound = of_channel;
  }
  return bound;
}

void Sparsity::count(Statistics& statistics) const {
  statistics.rows_emptied = rows_emptied_;
  statistics.columns_emptied = columns_dropped_;
  statistics.columns_restored = columns_restored_;
  statistics.rule2_rounds = now_;
}

}  // namespace shodo
