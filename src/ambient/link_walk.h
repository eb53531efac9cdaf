// Which nodes exchange light with which, and in which order rows list them (paper 3.2 rule 3; design: blocks).
//
// A pair of meshes is taken as a whole, or one of the two is replaced by its parts, and so on: every pair of patches is
// covered by exactly one *link*, of two nodes. What is split depends on the two nodes and on the segments between them
// only, never on what else was computed before, so any row can be found again:
//
//     rule 3    (deviation D13) links are patch to patch or patch to mesh. A patch is linked to a whole mesh if their
//               centres are more than D diameters of the mesh apart. Where that would do in both directions between two
//               meshes, the one is taken as a whole that saves more links; of equals the second.
//     blocks    ambient/block_link.h judges.
//
// Row a lists the links from node a to later ones, ascending. A block hands on to its parts the nodes for which it must
// be split itself, so a pair of ancestors is judged once for all the rows below it. Rows may be asked for in any order;
// ascending is fast. Meshes that are out of a row's sight are left out first; with blocks the judge asks for it, as its
// integers tell most often. Bytes: 2 times the patches for each level of blocks, 4 with more than 65,536 nodes.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/form_factor.h"
#include "ambient/sparsity.h"
#include "ambient/surfaces.h"
#include "base/arena.h"
#include "shodo/options.h"

namespace shodo {

inline constexpr double kRule3Diameters = 1.0;

class LinkWalk {
 public:
  /// Errors: kMemory.
  Status take(Arena& arena, const Surfaces& surfaces, const Sparsity& sparsity, const Options& options);
  static std::uint64_t bytes(const Scene& scene, const Options& options);

  enum class Step : std::uint8_t { kNothing, kLink, kSplitFirst, kSplitSecond };

  /// Without rules, and with rule 3: nothing, a link, or which of the two is split.
  Step judge(std::uint32_t a, std::uint32_t b) const;

  /// True if nothing of mesh_at[k] can see the node; decided by the mesh's corners, which hold all its patches.
  bool out_of_sight(const RowSide& side, std::uint32_t k) const;

  /// Calls link(b) for every link from a to b > a that any generation has; `side` is a's. judge(side, b) says what
  /// becomes of a pair; when it says kLink, and the pair is of row a, link(b) follows at once.
  template <class Judge, class Link>
  void visit(const RowSide& side, Judge&& judge, Link&& link) {
    go_to(side.position, judge);
    expand(side, judge, link);
  }

 private:
  /// The nodes that a block leaves to its parts, in `left_`.
  struct Level {
    std::uint32_t block, end;    // nodes
    std::uint32_t first, last;   // of left_
  };
  static constexpr std::uint32_t kDeepest = 64;

  Step judge_rule3(std::uint32_t a, std::uint32_t b) const;
  bool far_from(std::uint32_t patch, std::uint32_t mesh) const;
  std::uint32_t far_links(std::uint32_t parts_of, std::uint32_t whole) const;
  std::uint32_t mesh_of(std::uint32_t node) const;
  void open_level(std::uint32_t a);

  /// Closes the levels that don't hold node a; returns the first node to look at below the last one.
  std::uint32_t close_levels(std::uint32_t a);

  /// Prepares the levels above node a.
  template <class Judge>
  void go_to(std::uint32_t a, Judge&& judge) {
    for (std::uint32_t node = close_levels(a);; ++node) {
      while (surfaces_->end(node) <= a) node = surfaces_->end(node);
      if (node == a) return;
      NodeGeometry own;
      expand(row_side(*surfaces_, node, own), judge, [](std::uint32_t) {});
    }
  }

  template <class Judge, class Link>
  void expand(const RowSide& side, Judge&& judge, Link&& link) {
    const std::uint32_t a = side.position;
    const bool top = !features::kTrees || levels_ == 0;
    const Level above = top ? Level{} : level_[levels_ - 1];
    if (surfaces_->is_block(a)) open_level(a);
    if (!top) {
      for (std::uint32_t k = above.first; k < above.last; ++k) {
        const std::uint32_t node = left(k);
        descend(side, node, surfaces_->end(node), judge, link);
      }
      return;
    }
    const std::uint32_t own = mesh_of(a), meshes = static_cast<std::uint32_t>(surfaces_->mesh_at.size());
    for (std::uint32_t k = own; k < meshes; ++k) {
      if (k == own ? surfaces_->planar[k] != 0 : looks_ && out_of_sight(side, k)) continue;
      descend(side, k == own ? a + 1 : surfaces_->mesh_begin[k], surfaces_->mesh_begin[k + 1], judge, link);
    }
  }

  template <class Judge, class Link>
  void descend(const RowSide& side, std::uint32_t b, std::uint32_t limit, Judge&& judge, Link&& link) {
    while (b < limit) {
      Step step = Step::kNothing;
      if (surfaces_->root_area[b] > 0 && sparsity_->generation(side.position, b) <= sparsity_->now()) {
        step = judge(side, b);
      }
      if (step == Step::kLink) link(b);
      if (step == Step::kSplitFirst) leave(b);
      b = step == Step::kSplitSecond ? b + 1 : surfaces_->end(b);
    }
  }
  void leave(std::uint32_t b);
  std::uint32_t left(std::uint32_t k) const {
    return wide_ ? left_[2 * k] | std::uint32_t{left_[2 * k + 1]} << 16 : left_[k];
  }

  const Surfaces* surfaces_ = nullptr;
  const Sparsity* sparsity_ = nullptr;
  double diameters_squared_ = 0;
  bool looks_ = false;             // else the judge asks, where its integers don't tell
  std::span<std::uint16_t> left_;  // a node in one word, or two
  bool wide_ = false;              // two
  Level level_[kDeepest];
  std::uint32_t levels_ = 0;
};

}  // namespace shodo
