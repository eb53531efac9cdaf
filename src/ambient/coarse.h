// The coarse correction: one value a mesh, so that light which goes round a room many times is found at once (design:
// solution; deviation D5).
//
// Let every patch of a mesh g change by the same delta_g. Weighted with A_i / s_i (s_i: the row's scale) the
// equations of a mesh's patches add up to
//     a_g delta_g - sum over h of T_gh rho_h delta_h = r_g,   a_g = sum of A_i / s_i,   T_gh = sum of G_ij V_ij,
// r_g the weighted residual. T is symmetric and the same for all channels; with u = rho delta the matrix is symmetric
// and positive definite, and a few steps of conjugate gradients solve it. After a sweep the residual of patch i is
// sum over j > i of M_ij (new_j - old_j), and with a relaxation w (1 / w - 1) (new_i - old_i); the mean change of each mesh stands for those of its patches. That, single
// precision and the few steps cost speed of convergence only: sweeps decide what the solution is.
//
// More than kMostGroups meshes share values, neighbours in the order of ambient/surfaces.h: a rule that doesn't look at
// the memory, so that a smaller budget sweeps the same way. Bytes: 4 g (g + 1) / 2 + 8 g (5 + channels), g <= 96: 23
// KiB.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/surfaces.h"
#include "base/arena.h"

namespace shodo {

inline constexpr std::uint32_t kMostGroups = 96;

class Coarse {
 public:
  /// Errors: kMemory.
  Status take(Arena& arena, const Surfaces& surfaces);
  static std::uint64_t bytes(const Scene& scene);
  static std::uint32_t group_count(const Scene& scene);

  /// Starts over with the sums.
  void forget();
  std::uint32_t groups() const { return groups_; }
  /// Of mesh_at[k].
  std::uint32_t group_of_mesh(std::uint32_t k) const;

  /// Adds G_ij V_ij of a pair, i's group first (i < j).
  void add_exchange(std::uint32_t g, std::uint32_t h, double exchange) {
    exchange_[at(g, h)] += static_cast<float>(exchange);
  }
  void add_row(std::uint32_t g, double area_over_scale) { weight_[g] += area_over_scale; }

  /// Forgets the last sweep's changes.
  void start_sweep();
  /// Patch of group g changed by `change`; `area` is its visible area. By channel: sums for means.
  void add_change(std::uint32_t g, std::uint32_t channel, double area, double change) {
    change_[g * channels_ + channel] += area * change;
  }
  /// delta of each group, given each group's area and mean reflectance, after a sweep with that relaxation.
  void solve(std::uint32_t channel, double relaxation, std::span<const double> area, std::span<const double> reflectance,
             std::span<double> delta);

 private:
  /// Packed upper triangle, g <= h.
  std::size_t at(std::uint32_t g, std::uint32_t h) const {
    return std::size_t{g} * groups_ - std::size_t{g} * (g + 1) / 2 + h;
  }
  /// to = (diag(a / rho) - T) from, over groups that reflect.
  void apply(std::span<const double> reflectance, std::span<const double> from, std::span<double> to) const;

  std::uint32_t groups_ = 0, meshes_ = 0, channels_ = 1;
  std::span<float> exchange_;   // the diagonal holds half: pairs i < j only
  std::span<double> weight_;    // a_g
  std::span<double> change_;    // [g * channels + c]
  std::span<double> residual_, direction_, image_;
};

}  // namespace shodo
