// Rules 1 and 2: which rows and columns are left out (paper 3.2 rules 1, 2).
//
//     rule 1    largest channel of rho_i E0_i / pi above the display's MAX: row i is empty, the patch gets no
//               ambient light
//     rule 2    largest channel of rho_j E0_j / pi below its MIN: column j is empty, the patch sends nothing, whatever
//               light it gets
//     rule 2+   ours: rule 2; then columns whose *total* luminance came out at MIN or more are put back, the rows are
//               completed and solved again, until none is left
//
// What each round of 2+ adds is a *generation*: rows of generation g hold the pairs that are first needed then, so no
// pair is computed twice and rows already stored stay. A pair is needed if one of the two receives from the other; a
// link between blocks if any of their patches does. The last of kGenerations rounds puts every column back, which
// ends it.
//
// Loss. Rule 2 leaves out at most sum over dropped j of rho_j F_ij E_j of row i; rows sum to at most 1, and
// what is lost goes round like all light, so no E is too small by more than max over dropped j of rho_j E_j / (1 -
// max rho), E_j as solved (loss_bound). Bytes: 2 a node.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/surfaces.h"
#include "base/arena.h"
#include "light/direct.h"
#include "shodo/options.h"
#include "shodo/statistics.h"

namespace shodo {

inline constexpr std::uint32_t kGenerations = 6;
inline constexpr std::uint8_t kNever = 255;

class Sparsity {
 public:
  /// Judges all patches by their direct light. Errors: kMemory.
  Status take(Arena& arena, Surfaces& surfaces, const DirectLight& direct, const Rules& rules);
  static std::uint64_t bytes(const Scene& scene, const Rules& rules);

  bool receives(std::uint32_t node) const { return !features::kRules || receives_.empty() || receives_[node] != 0; }
  bool sends(std::uint32_t node) const { return !features::kRules || born_.empty() || born_[node] != kNever; }
  /// Rows of this generation are the last there are.
  std::uint8_t now() const { return features::kRules ? now_ : std::uint8_t{0}; }
  /// The generation whose rows hold the pair, or link; kNever if neither needs the other.
  std::uint8_t generation(std::uint32_t a, std::uint32_t b) const {
    if (!features::kRules || born_.empty()) return 0;
    const std::uint8_t from_b = receives_[a] != 0 ? born_[b] : kNever, from_a = receives_[b] != 0 ? born_[a] : kNever;
    return from_b < from_a ? from_b : from_a;
  }
  /// Some column is left out: rows may rightly sum to less than 1.
  bool drops_columns() const { return features::kRules && columns_dropped_ > 0; }

  /// Puts back what became bright (rule 2+); false if there is nothing to do. `ambient_lx` by patch and channel.
  bool restore(Surfaces& surfaces, const DirectLight& direct, std::span<const double> ambient_lx);

  /// Rule 2's bound on the loss of any illuminance, lux, largest channel.
  double loss_bound(const Surfaces& surfaces, const DirectLight& direct, std::span<const double> ambient_lx) const;
  void count(Statistics& statistics) const;

 private:
  void gather_blocks(Surfaces& surfaces);

  std::span<std::uint8_t> receives_;  // by node; empty: all do
  std::span<std::uint8_t> born_;      // by node: generation in which its column came; empty: all 0
  std::uint8_t now_ = 0;
  std::uint32_t rows_emptied_ = 0, columns_dropped_ = 0, columns_restored_ = 0;
};

}  // namespace shodo
