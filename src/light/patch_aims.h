// What can come between a patch and each light, found once for all its sub-patches (paper 3.1).
//
// The walk through the tree of facets costs the most of an aim. From a patch to a light it is done once, when a
// sub-patch first asks; what it finds is listed, and a sub-patch's own aim is what remains of the list. Where there is
// no room, or a sub-patch's samples don't lie in the patch's box, the aim is made from the tree: the same facets but
// for order. From a single sample the list itself is the aim: to ask each facet whether it can be in the way costs as
// much as to test it. If nothing is listed, or a single facet hides all of the light from all of the box, no sub-patch
// has to look. Bytes: 12 a light, and 4 for each of kListed facets.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "scene/scene.h"
#include "visibility/intersector.h"

namespace shodo {

/// What a light shows to a patch.
enum class Shown : std::uint8_t { kUnknown, kAll, kNothing };

class PatchAims {
 public:
  explicit PatchAims(Intersector& intersector) : intersector_(&intersector) {}

  bool take(Arena& arena, std::uint32_t lights);
  static std::uint64_t bytes(std::uint32_t lights);

  /// The sub-patches that come next have their samples in this box, surely or mostly; an empty one: nothing is to be
  /// listed.
  void start(const LatticeBox& patch, bool surely);
  /// Ends of segments to light l lie in `whole`.
  Shown shown(std::uint32_t l, const Link& link, const LatticeBox& whole);

  /// The last aim may not be used again: another sub-patch comes, or the intersector's list was used otherwise.
  void forget() { last_light_ = kNone; }

  /// Whether what blocked last on the way to light l, alone, hides all that is in `ends` from all samples in `from`.
  bool hidden(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeBox& ends) const;
  /// The aim, to light l, has been used: its first facet blocked last, if any did, and is tried first from then on.
  void used(std::uint32_t l, const Aim& aim);

  /// Wide aims from samples in `from` to ends of light l in `ends`, a part of `whole`, or along the way to a sun. With
  /// a grid of the ends, those only that it finds.
  Aim towards(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeBox& ends,
              const LatticeBox& whole, const EndGrid* grid = nullptr);
  Aim along(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeVector& direction);

 private:
  static constexpr std::uint32_t kListed = 1024;
  static constexpr std::uint32_t kNotYet = 0xFFFFFFFF, kTooLong = 0xFFFFFFFE, kDark = 0xFFFFFFFD;
  struct List {
    std::uint32_t first = 0, count = kNotYet;  // of facets_; count may be kNotYet, kTooLong or kDark
    std::uint32_t blocker = kNone;             // that blocked last, for whatever patch
  };

  bool usable(const LatticeBox& from) const;
  Aim make(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeBox& ends, const LatticeBox& whole,
           const EndGrid* grid);
  std::span<const std::uint32_t> facets_of(const List& list) const { return facets_.subspan(list.first, list.count); }
  void keep(List& list, const Aim& aim);
  void prefer(List& list);

  Intersector* intersector_;
  std::span<List> lists_;
  std::span<std::uint32_t> facets_;
  std::uint32_t used_ = 0;
  LatticeBox patch_;
  bool surely_ = false;
  // The last aim towards ends, used again from within its boxes.
  std::uint32_t last_light_ = kNone;
  const EndGrid* last_grid_ = nullptr;
  LatticeBox last_from_, last_ends_;
  Aim last_;
};

}  // namespace shodo
