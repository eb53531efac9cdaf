// The coarse correction: one value a mesh, so that light which goes round a room many times is found at once (design:
// solution; deviation D5).
//
// Let every patch of a group g change by the same delta_g. Weighted with A_i / s_i (s_i: the row's scale) the
// equations of a group's patches add up to
//     a_g delta_g - sum over h of T_gh rho_h delta_h = r_g,   a_g = sum of A_i / s_i,   T_gh = sum of G_ij V_ij,
// r_g the weighted residual. T is symmetric and the same for all channels; with u = rho delta the matrix is symmetric
// and positive definite, and a few steps of conjugate gradients solve it. After a sweep the residual of patch i is
// sum over j > i of M_ij (new_j - old_j); the mean change of each group stands for those of its patches. That, single
// precision and the few steps cost speed of convergence only: sweeps decide what the solution is.
//
// A group is a mesh. More than kMostGroups meshes share values, neighbours in the order of ambient/surfaces.h; where
// there are few and no blocks, meshes are cut into parts of e x e patches, e the least with which there are at most
// kMostParts, and four patches for each: long or near walls exchange light in more ways than one value can follow.
// Rules that don't look at the memory, so that a smaller budget sweeps the same way. Bytes: 4 g (g + 1) / 2 + 8 g (4 +
// channels), g <= 96: 23 KiB; and 1 a patch where meshes are cut.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/surfaces.h"
#include "base/arena.h"

namespace shodo {

inline constexpr std::uint32_t kMostGroups = 96, kMostParts = 64;

class Coarse {
 public:
  /// Errors: kMemory.
  Status take(Arena& arena, const Surfaces& surfaces, const Rules& rules);
  static std::uint64_t bytes(const Scene& scene, const Rules& rules);
  static std::uint32_t group_count(const Scene& scene, const Rules& rules);

  /// Starts over with the sums.
  void forget();
  std::uint32_t groups() const { return groups_; }
  /// Of mesh_at[k], where meshes aren't cut.
  std::uint32_t group_of_mesh(std::uint32_t k) const {
    return static_cast<std::uint32_t>(std::uint64_t{k} * groups_ / meshes_);
  }
  /// Of a node, given group_of_mesh() of its mesh.
  std::uint32_t group(std::uint32_t node, std::uint32_t of_mesh) const { return part_.empty() ? of_mesh : part_[node]; }
  std::uint32_t group_at(std::uint32_t node, std::uint32_t k) const { return group(node, group_of_mesh(k)); }

  /// Adds G_ij V_ij of a pair.
  void add_exchange(std::uint32_t g, std::uint32_t h, double exchange) {
    exchange_[g < h ? at(g, h) : at(h, g)] += static_cast<float>(exchange);
  }
  void add_row(std::uint32_t g, double area_over_scale) { weight_[g] += area_over_scale; }

  /// Forgets the last sweep's changes.
  void start_sweep();
  /// Patch of group g changed by `change`; `area` is its visible area. By channel: sums for means.
  void add_change(std::uint32_t g, std::uint32_t channel, double area, double change) {
    change_[g * channels_ + channel] += area * change;
  }
  /// delta of each group after a sweep, given each group's area and mean reflectance.
  void correct(std::uint32_t channel, std::span<const double> area, std::span<const double> reflectance,
               std::span<double> delta);

  /// Where solve() finds the right side, by group, and leaves what remains of it.
  std::span<double> residual() { return residual_; }
  /// u = rho delta of each group, to that part of the first squared residual, weighted.
  void solve(std::span<const double> reflectance, std::uint32_t most_steps, double reduction, std::span<double> u);

 private:
  /// Packed upper triangle, g <= h.
  std::size_t at(std::uint32_t g, std::uint32_t h) const {
    return std::size_t{g} * groups_ - std::size_t{g} * (g + 1) / 2 + h;
  }
  /// to = (diag(a / rho) - T) from, over groups that reflect.
  void apply(std::span<const double> reflectance, std::span<const double> from, std::span<double> to) const;
  void cut_meshes(const Surfaces& surfaces, std::uint32_t edge);

  std::uint32_t groups_ = 0, meshes_ = 0, channels_ = 1;
  std::span<float> exchange_;   // the diagonal holds half: pairs i < j only
  std::span<double> weight_;    // a_g
  std::span<double> change_;    // [g * channels + c]
  std::span<double> residual_, direction_, image_;
  std::span<std::uint8_t> part_;  // group of a patch by its position; empty: groups are meshes, or share some
};

}  // namespace shodo
