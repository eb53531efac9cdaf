// What can come between the sub-patches of a patch and what sends to them (ours; paper 3.1).
//
// A final gather asks for each patch and each of hundreds of nodes. Lists of facets are narrowed in four steps, each
// from the one before: from a region of the receiving mesh (a block of a few patches) to all of an object that sends
// (by the tree of visibility/blockers.h), from one patch to the object, and from it to the blocks that are split and to
// the node itself (by the lean shaft of ambient/lean_shaft.h). A list that finds no room is found again where it is
// needed. With flags off the same lists are made, since what is clear decides how finely light is gathered; segments
// are then tested against all triangles.
// Bytes: 2 kListedFacets, 4 a facet, 24 + 24 an object; with flags off the tree besides.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/lean_shaft.h"
#include "ambient/surfaces.h"
#include "base/arena.h"
#include "visibility/blockers.h"
#include "visibility/intersector.h"

namespace shodo {

inline constexpr std::uint32_t kListedFacets = 8192;

class GatherLists {
 public:
  /// What the last segment from the group to an object met.
  enum class Seen : std::uint32_t { kNotYet, kFree, kBlocked };

  explicit GatherLists(Intersector& intersector) : intersector_(intersector) {}

  /// After the intersector was started. Errors: kMemory.
  Status take(Arena& arena, const Surfaces& surfaces);
  static std::uint64_t bytes(const Scene& scene, const Geometry& geometry, FlagMode flags);

  /// Patches of this block of mesh_at[place] come next; of the whole mesh, if the node is a patch.
  void start_region(std::uint32_t place, std::uint32_t node);
  /// Segments start in this box.
  void start_group(const LatticeBox& box);
  /// Nodes of a mesh of this object come next, ascending.
  void start_object(std::uint32_t object);

  Seen& seen() { return of_group_[object_].seen; }

  /// A node is split; its parts lie in `box` and before `end`.
  void split(const LatticeBox& box, std::uint32_t j, std::uint32_t end);
  /// Aims from the group to `box`, which is part of node j. True if nothing can come between, nor weaken.
  bool clear(const LatticeBox& box, std::uint32_t j);
  /// Aims from the group to anywhere in node j, without looking closer.
  void aim(std::uint32_t j);
  /// The part of light that panes let through, the mean of the channels.
  double pass(const LatticePoint& p, const LatticePoint& q);
  /// Of what clear() or aim() left.
  bool blocked(const LatticePoint& p, const LatticePoint& q) { return intersector_.blocked(p, q, link_, aim_); }

 private:
  static constexpr std::uint32_t kNotYet = 0xFFFFFFFF, kTooLong = 0xFFFFFFFE;
  struct List {
    std::uint32_t first = 0, count = kNotYet;
    Seen seen = Seen::kNotYet;
  };
  struct Part {
    std::uint32_t end, first, count;
  };
  static constexpr std::uint32_t kDeepest = 24;
  // Parts of `words_`.
  static constexpr std::uint32_t kOfRegion = kListedFacets * 5 / 8, kOfGroup = kListedFacets / 4;

  template <class Visit>
  void visit_all(Visit visit);
  template <class Visit>
  void visit_region_list(Visit visit);
  template <class Visit>
  void visit_group_list(Visit visit);
  std::span<const Facet> facets();
  bool listable() { return facets().size() <= 0x10000; }
  bool narrow(const LatticeBox& box, std::uint32_t j);
  void find_region_list();
  void find_group_list();

  Intersector& intersector_;
  const Surfaces* surfaces_ = nullptr;
  Blockers own_;  // with flags off
  std::span<std::uint16_t> words_;
  std::span<std::uint32_t> pair_;
  std::span<LatticeBox> object_box_;
  std::span<List> of_region_, of_group_;  // by object
  std::uint32_t region_used_ = 0, group_used_ = 0;
  std::uint32_t object_ = 0;
  LatticeBox region_box_, group_box_;
  bool inside_ = false;  // the group's box lies in the region's
  Link link_;
  Aim aim_;
  Part part_[kDeepest];
  std::uint32_t parts_ = 0;
};

}  // namespace shodo
