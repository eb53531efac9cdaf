// Which segments reach their end: the only door to visibility for the stages below (paper 3.1).
//
// Two ways with the same answers. Flags off: every triangle of every object is tried in file order until the first
// blocker, without any spatial structure: the yardstick. Else a caller first takes aim: between two groups of ends it
// gets the facets that can come between them (visibility/blockers.h), and most often there are none, so that no segment
// is needed. Aims are made from the very points at which segments end, so no facet is missed: exact, whatever the
// order. What blocked last is tried first.
// Bytes: those of visibility/blockers.h, flags.h and, where asked for, facet_masks.h, and two lists of 4 bytes a facet,
// from start() to finish().
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "shodo/options.h"
#include "visibility/blockers.h"
#include "visibility/end_grid.h"
#include "visibility/facet_masks.h"
#include "visibility/flags.h"
#include "visibility/geometry.h"
#include "visibility/panes.h"
#include "visibility/shadow.h"

namespace shodo {

/// What a ray meets first.
struct Hit {
  std::uint32_t triangle = kNone;
  bool front = false;  // seen from its front
  bool near = false;   // within kNearPart of the direction's length
};
inline constexpr int kNearPart = 4;  // bits: 1/16

/// What can block the segments between two groups of ends. Valid until the next wide, or the next narrow, aim.
struct Aim {
  std::span<std::uint32_t> facets;
  bool any_triangle = true;         // nothing is known: flags off
  std::span<std::uint32_t> hides{};  // by facet, the ends that it can hide, a bit each; empty: any
  const EndGrid* grid = nullptr;     // of the ends; it is asked about a facet if there is no `hides`

  /// No segment is blocked: none is needed.
  bool clear() const { return features::kAims && !any_triangle && facets.empty(); }
};

class Intersector {
 public:
  explicit Intersector(const Geometry& geometry) : geometry_(&geometry), panes_(geometry) {}
  Intersector(const Geometry& geometry, const Scene& scene, FlagMode mode)
      : geometry_(&geometry), scene_(&scene), panes_(geometry), mode_(mode) {}

  /// The flags, to outlive the stages; else start() takes them each time. False: the arena is too small.
  bool take_flags(Arena& arena);
  const FlagTables& flags() const { return flags_; }

  /// Builds what finds blockers, as scratch of a stage that calls finish() before the arena is released. False: the
  /// arena is too small.
  bool start(Arena& arena, Rectangles rectangles = Rectangles::kCut);
  void finish();
  /// Whether aims find anything: between start() and finish(), flags not off.
  bool seeking() const { return features::kAims && started_; }
  /// After start(), and after all else that the stage takes: masks find what aims list, not the tree, if there is room
  /// for them and facets aren't too many. False: as start().
  bool take_masks(Arena& arena);
  /// Arena bytes of start() after take_flags().
  static std::uint64_t bytes(const Geometry& geometry, FlagMode mode);

  /// Between any points of two boxes; "wide", since narrower aims can be made of it.
  Aim aim(const LatticeBox& a, const LatticeBox& b, const Link& link);
  /// Between the points of two groups; as narrow as any.
  Aim aim(const Ends& a, const Ends& b, const Link& link);
  /// From any point of the box towards a sun; wide.
  Aim aim_along(const LatticeBox& a, const LatticeVector& direction, const Link& link);
  /// Of a wide aim what remains between the points of two groups that lie in its boxes.
  Aim narrow(const Aim& wide, const Ends& a, const Ends& b);

  /// Of a list of facets (of a wide aim, to ends that hold these) what remains between two boxes; wide again.
  Aim aim_among(std::span<const std::uint32_t> facets, const LatticeBox& a, const LatticeBox& b);
  /// The same to the ends of a grid, which b holds: as sift() leaves it.
  Aim aim_among(std::span<const std::uint32_t> facets, const LatticeBox& a, const LatticeBox& b, const EndGrid& grid);
  Aim aim_along_among(std::span<const std::uint32_t> facets, const LatticeBox& a, const LatticeVector& direction);
  /// Of a wide aim from a box to the ends of a grid what can hide any of them; wide, and no narrower aim while it is
  /// in use.
  Aim sift(const Aim& wide, const LatticeBox& from, const EndGrid& grid);
  /// Sorts the facets of an aim: those of other objects first; returns their number.
  std::size_t others_first(const Aim& aim, std::uint32_t object) const;
  /// Whether this facet blocks, by itself and surely, every segment between two boxes; if so, that is noted.
  bool hides_all(std::uint32_t facet, const LatticeBox& a, const LatticeBox& b, const Link& link);
  /// Everything that rays from the box along `direction` may meet, whatever the flags; wide.
  Aim gather_along(const LatticeBox& a, const LatticeVector& direction);
  /// The same for the first part of the rays only, where a hit is `near`.
  Aim gather_near(const LatticeBox& a, const LatticeVector& direction);

  /// True if any triangle blocks the open segment from p to q. Counts a segment and its tests.
  bool blocked(const LatticePoint& p, const LatticePoint& q, const Link& link);
  bool blocked(const LatticePoint& p, const LatticePoint& q, const Link& link, const Aim& aim);
  /// Those of `wanted` (bit k: segments.ends[k]) that are blocked; counts them and their tests. Facets of the aim from
  /// `others` on are asked about `own_wanted` only.
  std::uint32_t shadow(const Segments& segments, std::uint32_t wanted, const Link& link, const Aim& aim);
  std::uint32_t shadow(const Segments& segments, std::uint32_t wanted, const Link& link, const Aim& aim,
                       std::size_t others, std::uint32_t own_wanted);
  /// The same towards a sun: a ray from p along `direction` (lattice_direction, the way from p to the sun).
  bool ray_blocked(const LatticePoint& p, const LatticeVector& direction, const Link& link);
  bool ray_blocked(const LatticePoint& p, const LatticeVector& direction, const Link& link, const Aim& aim);
  /// The nearest triangle along a ray, exactly; ties: front before back, then the lower index. Not counted.
  Hit nearest(const LatticePoint& p, const LatticeVector& direction) const;
  /// The same, given what gather_along() found for a box that holds p and this direction.
  Hit nearest(const LatticePoint& p, const LatticeVector& direction, const Aim& gathered) const;

  /// What weakens the light of a segment that isn't blocked.
  const Panes& panes() const { return panes_; }
  void set_channel(std::uint32_t channel) { panes_.set_channel(channel); }

  std::uint64_t segments(LightSet set) const { return segments_[index(set)]; }
  std::uint64_t tests(LightSet set) const { return tests_[index(set)]; }

  /// For those who look for blockers in their own way (ambient/sight.h): all facets; whether one blocks in a set;
  /// whether a link is tested; the count of a segment, its tests, and the object that blocks it (or kNone).
  std::span<const Facet> facets() { return blockers_.facets(); }
  bool blocks(std::uint32_t facet, LightSet set) const {
    return (blockers_.facets()[facet].blocks >> index(set) & 1) != 0;
  }
  bool tested(const Link& link) const { return flags_.tested(link); }
  void count(const Link& link, std::uint64_t tests, std::uint32_t object) {
    ++segments_[index(link.set)];
    tests_[index(link.set)] += tests;
    if (object != kNone) flags_.note_blocked(link, object);
  }

 private:
  static constexpr std::uint32_t index(LightSet set) { return static_cast<std::uint32_t>(set); }

  struct Nearest;
  void offer(const Facet& facet, const LatticePoint& p, const LatticeVector& direction, Nearest& best) const;
  template <class Try>
  bool any_triangle(Try attempt) const;
  template <class Blocks>
  bool any_blocks(Blocks blocks, const LatticePoint& p, const LatticeVector& d, const Link& link, const Aim& aim);
  std::uint32_t shadow_among(const Segments& segments, std::uint32_t wanted, const Link& link,
                             std::span<std::uint32_t> facets, const Aim& aim);
  template <class Miss>
  Aim keep(const Aim& wide, Shaft shaft, Miss misses);
  template <class Visit>
  void visit(const Shaft& shaft, Visit visit) const;
  Aim aim_in(const Shaft& shaft, const Link& link, std::span<std::uint32_t> list);
  Aim keep_wide(std::span<const std::uint32_t> facets, Shaft shaft);
  std::span<const Triangle> triangles_of(const Facet& facet) const {
    return {geometry_->triangles.data() + facet.first, facet.count};
  }

  const Geometry* geometry_;
  const Scene* scene_ = nullptr;
  Panes panes_;
  FlagMode mode_ = FlagMode::kOff;
  bool started_ = false;
  bool flags_stay_ = false;
  Blockers blockers_;
  FacetMasks masks_;
  FlagTables flags_;
  std::span<std::uint32_t> wide_, narrow_;
  std::uint64_t segments_[2] = {0, 0};
  std::uint64_t tests_[2] = {0, 0};
};

/// Ends what start() built, at the end of a stage.
class IntersectorScratch {
 public:
  explicit IntersectorScratch(Intersector& intersector) : intersector_(intersector) {}
  ~IntersectorScratch() { intersector_.finish(); }
  IntersectorScratch(const IntersectorScratch&) = delete;
  IntersectorScratch& operator=(const IntersectorScratch&) = delete;

 private:
  Intersector& intersector_;
};

}  // namespace shodo
