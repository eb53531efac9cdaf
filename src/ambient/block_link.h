// `blocks`: which pairs of nodes are good enough for one link, and how much work each is worth (ours, beyond paper 3.2
// rule 3; doc/rules.md).
//
// The error of a link is what it makes wrong of the light that its ends gather. In the symmetric form that is stored
// (ambient/row_store.h) row i sums v_ij s_j, with s_j = R_j rho_j E_j what j sends; both ends together are wrong by
//     e^2 = v^2 (d_i^2 (s_j^2 + t_i^2) + d_j^2 (s_i^2 + t_j^2)),
// d_i the relative variation of the kernel over i (ambient/link_series.h), t_i how unevenly the parts of i send (an
// uneven sender and a kernel that varies over it make an error together). All s and t are over the norm of all rows'
// sums, E R of the whole scene as far as it is displayed (ambient/link_worth.h): so a link's e is its part of the error
// of the solution, root mean square over the mean illuminance, and REL is the most it may be (deviation D15).
// With w = v sqrt(s_i^2 + s_j^2 + t_i^2 + t_j^2), the error of a link that is wholly wrong:
//     w <= REL             a link, whatever it is like, with one segment
//     e <= REL             a link if all segments agree: 2 while 0.37 w <= REL, 4 while 0.14 w <= REL, 8 while
//                          0.07 w <= REL, 16 while 0.05 w <= REL, beyond that only if nothing stands between the two
//     both, and mixed      a link with its visible fraction, by as many, if 0.7 w <= REL
// Whatever isn't a link is split: the end over which the kernel varies more, or the larger. Patches are never split;
// the dearest of them get the segments of `--segments`, all others 1 to 16, mixed or not: what few segments may make
// wrong of a fraction is in the grade. Too near for a series: blocks are split until 0.3 w <= REL, patches take the
// near tier until 0.3 w <= REL; then discs' form factors serve (ambient/rough_exchange.h), one at 1.5 w <= REL.
//
// The decision needs nothing but the two nodes and segments between them, so that rows can be found again.
// Bytes: those of ambient/link_worth.h, link_series.h and sight.h.
#pragma once

#include <cstdint>

#include "ambient/link_series.h"
#include "ambient/link_walk.h"
#include "ambient/link_worth.h"
#include "ambient/sight.h"
#include "ambient/visible_fraction.h"

namespace shodo {

/// What blocks need besides the tree; nothing without them.
struct BlockTools {
  LinkWorth worth;
  Places places;
  Sight sight;

  /// Errors: kMemory.
  Status take(Arena& arena, const Surfaces& surfaces, const DirectLight& direct, const Options& options);
  static std::uint64_t bytes(const Scene& scene, const Geometry& geometry, const Options& options);
};

/// A link as it is found.
struct BlockLink {
  PairExchange pair;
  VisibleFraction visible;
  double vary_i = 0, vary_j = 0;  // d^2 of an end that is a block: its parts get the mean, and miss so much
};

/// Judges the pairs of one node after the other.
class BlockJudge {
 public:
  BlockJudge(const Surfaces& surfaces, const Options& options, const LinkWalk& walk, BlockTools& tools,
             Intersector& intersector)
      : surfaces_(surfaces), options_(options), walk_(walk), tools_(tools), intersector_(intersector) {}

  /// Pairs of one side, j ascending; a block's parts after it.
  LinkWalk::Step judge(const RowSide& side, std::uint32_t j);
  /// Of the last pair that was judged to be a link.
  const BlockLink& found() const { return found_; }

 private:
  /// A pair at work: what is known of it before segments.
  struct Pair {
    std::uint32_t j = 0;
    LinkSeries series;
    double whole = 0;      // w^2
    bool patches = false;  // both ends are
    bool slight = false;   // w <= REL
    bool near = false;     // the near tier is needed
    LinkWalk::Step split = LinkWalk::Step::kSplitFirst;
  };
  /// A segment, by the numbers of its cached samples.
  struct Ends {
    std::uint32_t i, j;
  };
  /// Ends of segments between cached samples, and what they met.
  struct Shots;

  void start(const RowSide& side);
  LinkWalk::Step decide(const RowSide& side, std::uint32_t j);
  LinkSeries series_of(const RowSide& side, std::uint32_t j);
  bool out_of_sight(const RowSide& side);
  const LatticeBox& own_box(bool whole) const { return own_boxes_[whole ? 1 : 0]; }
  LatticeBox box_of(std::uint32_t j, bool whole) const { return tools_.places.box(surfaces_, j, place_, whole); }
  bool within(double squared, double part) const { return squared * (part * part) <= tools_.worth.allowed(); }
  bool varies_too_much(Pair& pair) const;
  bool measure(const RowSide& side, const Pair& pair);
  LinkWalk::Step look(const Pair& pair);
  LinkWalk::Step look_twice(const Pair& pair, const Ends& first, const Ends& second);
  void look_once(std::uint32_t k, std::uint32_t j, std::uint32_t l);
  LinkWalk::Step look_through_panes(const Pair& pair, std::uint32_t hash);
  bool in_front(std::uint32_t node, std::uint32_t sample, std::uint32_t other, std::uint32_t place) const;
  Shots shots_of(const Pair& pair) const;
  bool mixed_splits(const Pair& pair) const;
  bool shoot_all(const Pair& pair, std::uint32_t turn, Shots& shots);
  void shoot(Shots& shots, std::uint32_t k, std::uint32_t l);

  const Surfaces& surfaces_;
  const Options& options_;
  const LinkWalk& walk_;
  BlockTools& tools_;
  Intersector& intersector_;
  std::uint32_t node_ = kNone;   // of the side at work
  std::uint32_t own_place_ = 0;  // of its mesh
  std::uint32_t place_ = 0;      // of j's mesh
  PlacedSide placed_ = {};
  double own_sent_ = 0, own_uneven_ = 0;
  bool own_block_ = false, top_ = false;  // it is one; no block holds it
  bool away_ = false;                     // nothing of the mesh at asked_ can see it
  std::uint32_t asked_ = kNone;
  Link link_;  // to j
  LatticeBox own_boxes_[2];  // around the cached samples; around all
  DenseSamples dense_;
  BlockLink found_;
};

}  // namespace shodo
