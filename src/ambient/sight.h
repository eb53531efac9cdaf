// What can come between the nodes of a link, and whether a segment of it is free (ours; paper 3.1, 3.2).
//
// visibility/intersector.h answers for any two groups of points. Here links come in the order of two block trees, and
// that is worth a structure of its own:
//   - what can block between parts of two nodes is a part of what can between the nodes: each pair that is split keeps
//     its list for its parts, as long as lists fit into kListWords. A block hands the lists on with the nodes that it
//     leaves to its parts (ambient/link_walk.h). Whole meshes, and parts whose list didn't fit, start with all
//     facets, in clusters: what follows each other in the tree of visibility/blockers.h, up to 6, but large ones alone,
//     since a wall in it spoils the box of a cluster. There are half as many clusters as facets at most, and the
//     last takes what is left: lists are the same however facets are clustered.
//   - between two nodes the list is narrowed by the hull of their boxes, seen along the three axes as in
//     visibility/shaft.h, but in steps of 64 of the lattice, so that every product fits 32 bits. Boxes are rounded
//     outwards: no blocker is missed. The hull of parts lies in that of the whole, so the list of a pair doesn't depend
//     on where it was narrowed from. With flags off there are no lists; whether one would be empty is found facet by
//     facet, and agrees.
//   - a facet square to an axis that fills its box is hit if the segment meets its plane within the box: exact with
//     products of two 32-bit numbers.
// Exact: the answer for each segment. Bytes: 4 kListWords and 17 a facet (0 with flags off).
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "visibility/intersector.h"
#include "shodo/options.h"
#include "visibility/lattice_box.h"

namespace shodo {

/// The hull of two boxes in steps of 64 of the lattice.
class LeanShaft {
 public:
  LeanShaft(const LatticeBox& a, const LatticeBox& b);
  /// True if no segment between the boxes meets this one; it may be flat (visibility/blockers.h).
  bool misses(const LatticeBox& box) const {
    if (apart(around_, box)) return true;
    for (std::uint32_t k = 0; k < lines_used_; ++k) {
      const Line& line = lines_[k];
      const std::int32_t u = (line.normal_u > 0 ? box.low : box.high)[line.u] >> kSteps;
      const std::int32_t v = (line.normal_v > 0 ? box.low : box.high)[line.v] >> kSteps;
      if (line.normal_u * u + line.normal_v * v > line.limit) return true;
    }
    return false;
  }

 private:
  static constexpr int kSteps = 6;  // of the lattice in one, log2
  /// Beyond: normal_u u + normal_v v > limit, u and v of the box's nearest corner.
  struct Line {
    std::int32_t normal_u, normal_v, limit;
    std::uint32_t u, v;  // axes
  };
  static std::int32_t low_of(std::int32_t x) { return x >> kSteps; }
  static std::int32_t high_of(std::int32_t x) { return (x + (1 << kSteps) - 1) >> kSteps; }
  void add_lines(const LatticeBox& a, const LatticeBox& b, std::uint32_t u, std::uint32_t v);

  LatticeBox around_;
  Line lines_[12];
  std::uint32_t lines_used_ = 0;
};

inline constexpr std::uint32_t kListWords = 3072;

class Sight {
 public:
  /// Errors: kMemory.
  Status take(Arena& arena, const Geometry& geometry, const Options& options);
  static std::uint64_t bytes(const Geometry& geometry, const Options& options);
  /// The facets of a started intersector.
  void start(Intersector& intersector);

  /// Starts on a node; `end` is the node after the last that is part of it.
  void open(std::uint32_t node, std::uint32_t end, const LatticeBox& box);
  /// Goes on to node j, which is part of one that was split for the node, or whole.
  void turn_to(std::uint32_t j, const Link& link, const Intersector& intersector);
  /// The pair is split; `leave`: parts of the node will look at j, else the node at parts of j.
  void split(std::uint32_t j, std::uint32_t end_j, const LatticeBox& box_j, bool leave);
  /// Whether nothing can come between a part of the node and a part of j.
  bool clear(const LatticeBox& a, const LatticeBox& b);
  /// Of what clear() left.
  bool blocked(const LatticePoint& p, const LatticePoint& q, const Link& link, Intersector& intersector);

 private:
  /// A block whose parts are at work; its lists are left_[first] to left_[last]: j (two words), count, facets.
  struct Level {
    std::uint32_t node, end;
    std::uint32_t first, last;
    std::uint32_t read;  // for the node at work: the last list that isn't beyond j
  };
  struct Cluster {
    LatticeBox box;
    std::uint16_t first = 0, end = 0;  // facets
  };
  static_assert(sizeof(Cluster) == 28, "memory_plan.cpp");
  static std::uint32_t most_clusters(std::uint32_t facets) { return facets / 2 + 1; }
  /// A node that was split for the node at work: list of row_.
  struct Part {
    std::uint32_t end;  // the node after its last
    std::uint32_t first, count;
  };
  static constexpr std::uint32_t kDeepest = 64;

  bool hits(std::uint32_t facet, const LatticePoint& p, const LatticePoint& q) const;
  std::uint32_t collect(const LeanShaft& shaft, std::uint16_t* to) const;
  const std::uint16_t* inherited(std::uint32_t j, std::uint32_t& count);

  const Geometry* geometry_ = nullptr;
  std::span<const Facet> facets_;
  /// By facet: 0 tilted; axis + 1; + 4 if its polygon fills its box; 8: never blocks.
  std::span<std::uint8_t> kinds_;
  std::span<Cluster> clusters_;
  std::uint32_t clusters_used_ = 0;
  std::span<std::uint16_t> left_, row_;
  std::span<std::uint16_t> pair_;         // of the pair
  const std::uint16_t* list_ = nullptr;   // of j, or what holds it; null: all facets
  std::uint32_t listed_ = 0, paired_ = 0;
  LatticeBox box_;
  Level level_[kDeepest];
  Part part_[kDeepest];
  std::uint32_t levels_ = 0, above_ = 0;  // level_[above_ - 1] holds the node
  std::uint32_t parts_ = 0;
  bool lists_ = false;
};

}  // namespace shodo
