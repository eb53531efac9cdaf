// What can come between the nodes of a link, and whether a segment of it is free (ours; paper 3.1, 3.2).
//
// visibility/intersector.h answers for any two groups of points, from the root of its tree. Links are so many, and so
// short of segments, that this is worth a structure of its own. Everything rough is in 32-bit integers:
//   - what may meet the hull of two nodes' boxes is found by masks (visibility/facet_masks.h). What can block between
//     them are those that meet the common box of their boxes and aren't beyond a line of their hull
//     (ambient/lean_shaft.h). With flags off there are no masks; whether that list would be empty is found facet by
//     facet, and agrees. Most often it isn't, and what stood between two nodes before tells so.
//   - many links are so dark that one segment or two decide. For them no list is made: a segment is tested with what it
//     may meet.
//   - what blocked a segment to the same mesh last, and the last two facets that blocked anything, are tried first: in
//     the paper's rooms one of them is in the way of a third of all first segments. It shows that something stands
//     between; often it blocks all, and no list is needed.
//   - what a segment passes by (ambient/lean_segment.h) isn't tested.
//   - a facet square to an axis that fills its box is hit if the segment meets its plane within the box: exact with
//     products of two 32-bit numbers.
// Exact: the answer for each segment. Bytes: 15 a facet, and the masks' 24, 2 a mesh (0 with flags off).
#pragma once

#include <cstdint>
#include <span>

#include "ambient/lean_segment.h"
#include "base/arena.h"
#include "visibility/facet_masks.h"
#include "visibility/intersector.h"
#include "shodo/options.h"
#include "visibility/lattice_box.h"

namespace shodo {

class Sight {
 public:
  /// Errors: kMemory.
  Status take(Arena& arena, const Geometry& geometry, const Options& options);
  static std::uint64_t bytes(const Geometry& geometry, const Options& options);
  /// The facets of a started intersector.
  void start(Intersector& intersector);

  /// Goes on to another pair; `place`: of its second mesh in Surfaces::mesh_at.
  void turn_to(const Link& link, std::uint32_t place, const Intersector& intersector) {
    tested_ = !lists_ || intersector.tested(link);
    place_ = place;
  }
  /// Whether nothing can come between two nodes of the pair; boxes hold all ends of segments.
  bool clear(const LatticeBox& a, const LatticeBox& b);
  /// The same, and a list is made of what can.
  bool list(const LatticeBox& a, const LatticeBox& b);
  /// As list(), unless a blocker of late is in the way of the segment: then without a list before one is needed.
  bool list_unless_blocked(const LatticePoint& p, const LatticePoint& q, const LatticeBox& a, const LatticeBox& b);
  /// By what these two found.
  bool blocked(const LatticePoint& p, const LatticePoint& q, const Link& link, Intersector& intersector);

  /// The same without a list.
  bool blocked_alone(const LatticePoint& p, const LatticePoint& q, const Link& link, Intersector& intersector);

 private:
  static constexpr std::uint32_t kRecent = 2;

  bool hits(std::uint32_t facet, const LatticePoint& p, const LatticePoint& q) const;
  std::uint32_t object_of(std::uint32_t facet) const;
  std::uint32_t recent_blocker(const LeanSegment& segment, const LatticePoint& p, const LatticePoint& q,
                               std::uint32_t& tests) const;
  void remember(std::uint32_t facet);

  const Geometry* geometry_ = nullptr;
  std::span<const Facet> facets_;
  /// By facet: 0 tilted; axis + 1; + 4 if its polygon fills its box.
  std::span<std::uint8_t> kinds_;
  std::span<LeanBox> lean_;  // by facet
  FacetMasks masks_;
  std::span<std::uint16_t> pair_;  // the list
  std::uint32_t paired_ = 0;
  LatticeBox from_, to_;          // of the list, if it isn't made yet
  std::uint32_t guess_ = kNone;   // what was in the way then
  std::uint16_t between_ = 0xffff;  // what clear() met last
  std::span<std::uint16_t> last_;  // what blocked a mesh last, by place; 0xffff: nothing
  std::uint32_t place_ = 0;
  std::uint16_t recent_[kRecent];  // blockers, the latest first; 0xffff: none
  bool lists_ = false;
  bool tested_ = true;  // the pair's segments are
};

}  // namespace shodo
