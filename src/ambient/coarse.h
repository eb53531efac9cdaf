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
// What is a group:
//     - in a scene more than four times as long as wide or high (a corridor, plates near each other): what lies in a
//       cell of space. Light goes along it in small steps, and a ring of walls has one value there;
//     - else where there are few meshes and no blocks: e x e patches of a mesh, e the least with which there are at
//       most kMostParts;
//     - else a mesh; more than kMostGroups meshes share values, neighbours in the order of ambient/surfaces.h.
// In the first two a group has four patches at least on the average. A block that reaches over several cells has its
// share of exchange in each, by area. Rules that don't look at the memory, so that a smaller budget sweeps the same
// way. Bytes: 4 g (g + 1) / 2 + 8 g (4 + channels), g <= 96: 23 KiB; and 1 a node where groups aren't meshes.
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
  /// Of mesh_at[k], where groups are meshes.
  std::uint32_t group_of_mesh(std::uint32_t k) const {
    return static_cast<std::uint32_t>(std::uint64_t{k} * groups_ / meshes_);
  }
  /// Of a node, given group_of_mesh() of its mesh.
  std::uint32_t group(std::uint32_t node, std::uint32_t of_mesh) const {
    return group_of_.empty() ? of_mesh : group_of_[node];
  }
  std::uint32_t group_at(std::uint32_t node, std::uint32_t k) const { return group(node, group_of_mesh(k)); }

  /// Adds G_ij V_ij of a pair.
  void add_exchange(std::uint32_t g, std::uint32_t h, double exchange) {
    exchange_[g < h ? at(g, h) : at(h, g)] += static_cast<float>(exchange);
  }
  /// The same, of nodes of which some may be blocks; of_mesh: group_of_mesh() of theirs.
  void add_exchange(const Surfaces& surfaces, std::uint32_t i, std::uint32_t of_mesh_i, std::uint32_t j,
                    std::uint32_t of_mesh_j, double exchange) {
    if (group_of_.empty() || (!surfaces.is_block(i) && !surfaces.is_block(j))) {
      add_exchange(group(i, of_mesh_i), group(j, of_mesh_j), exchange);
    } else {
      add_exchange_of_blocks(surfaces, i, j, exchange);
    }
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
  void add_exchange_of_blocks(const Surfaces& surfaces, std::uint32_t i, std::uint32_t j, double exchange);
  /// The part of a node's area that lies in each group.
  void share_out(const Surfaces& surfaces, std::uint32_t node, double (&share)[kMostGroups]) const;

  std::uint32_t groups_ = 0, meshes_ = 0, channels_ = 1;
  std::span<float> exchange_;   // the diagonal holds half: pairs i < j only
  std::span<double> weight_;    // a_g
  std::span<double> change_;    // [g * channels + c]
  std::span<double> residual_, direction_, image_;
  std::span<std::uint8_t> group_of_;  // a patch, by its position; empty: groups are meshes, or share some
  bool by_place_ = false;             // groups are cells of space
};

}  // namespace shodo
