#include "ambient/visible_fraction.h"

namespace shodo {

namespace {

constexpr std::size_t kMostPairPoints = kMostSamples + kMostSamples / 2;

/// The samples of one patch: lattice points, and the set they belong to.
struct PatchEnds {
  std::uint32_t position;
  std::span<const SamplePoint> set;
  const LatticePoint* at;
};

/// cos cos / r^4 times both distances, and the weights of the samples: 0 where one doesn't see the other's front.
double kernel(const Surfaces& surfaces, const PatchEnds& i, std::size_t k, const PatchEnds& j, std::size_t l) {
  const Patch& from = surfaces.patch(i.position);
  const Patch& to = surfaces.patch(j.position);
  const Vec3 apart = sample_place(surfaces, j.position, j.set[l]) - sample_place(surfaces, i.position, i.set[k]);
  const double cosines = dot(from.normal, apart), other = -dot(to.normal, apart);
  if (!(cosines > 0) || !(other > 0)) return 0;
  const double squared = length_squared(apart);
  const PatchShape& shape_i = surfaces.shape(i.position);
  const PatchShape& shape_j = surfaces.shape(j.position);
  const double weight_i = i.set[k].weight * (1 + (shape_i.alpha * i.set[k].x + shape_i.beta * i.set[k].y));
  const double weight_j = j.set[l].weight * (1 + (shape_j.alpha * j.set[l].x + shape_j.beta * j.set[l].y));
  return weight_i * weight_j * (cosines * other / (squared * squared));
}

Link link_between(const Surfaces& surfaces, std::uint32_t i, std::uint32_t j) {
  return {surfaces.mesh(i).object, surfaces.mesh(j).object, LightSet::kAmbient};
}

/// Tests segments, one way or the other.
struct Tester {
  Intersector& intersector;
  Sight* sight;
  Aim aim;

  bool blocked(const LatticePoint& p, const LatticePoint& q, const Link& link) const {
    return sight != nullptr ? sight->blocked(p, q, link, intersector) : intersector.blocked(p, q, link, aim);
  }
};

/// What the segments of some pairs of samples did.
struct Seen {
  bool free = false, blocked = false;

  bool mixed() const { return free && blocked; }
};

/// Stops as soon as both kinds were met.
void look(const Surfaces& surfaces, const PatchEnds& i, const PatchEnds& j, bool crossing, const Tester& tester,
          Seen& seen) {
  const Link link = link_between(surfaces, i.position, j.position);
  for (std::size_t k = 0; k < i.set.size(); ++k) {
    for (std::size_t l = 0; l < j.set.size(); ++l) {
      if (crossing && !(kernel(surfaces, i, k, j, l) > 0)) continue;
      (tester.blocked(i.at[k], j.at[l], link) ? seen.blocked : seen.free) = true;
      if (seen.mixed()) return;
    }
  }
}

struct Sums {
  double all = 0, free = 0;
  double least = 1, most = 0;  // of what panes let through, 0 where blocked

  bool mixed() const { return least < most; }
};

/// Adds the weights of all pairs of samples, and of those with a free segment, with panes each by what they let
/// through; `alike`: all weights the same.
template <bool kPanes>
void weigh(const Surfaces& surfaces, const PatchEnds& i, const PatchEnds& j, bool alike, const Tester& tester,
           Sums& sums) {
  const Link link = link_between(surfaces, i.position, j.position);
  for (std::size_t k = 0; k < i.set.size(); ++k) {
    for (std::size_t l = 0; l < j.set.size(); ++l) {
      const double weight = alike ? 1 : kernel(surfaces, i, k, j, l);
      if (!(weight > 0)) continue;
      sums.all += weight;
      const bool blocked = tester.blocked(i.at[k], j.at[l], link);
      if constexpr (kPanes) {
        const double part = blocked ? 0 : tester.intersector.panes().pass(i.at[k], j.at[l]);
        sums.free += weight * part;
        if (part < sums.least) sums.least = part;
        if (part > sums.most) sums.most = part;
      } else if (!blocked) {
        sums.free += weight;
      }
    }
  }
}

/// The two sets of both patches. Where they are one set, `many` is empty.
struct PairEnds {
  PatchEnds few_i, few_j, many_i, many_j;

  bool one_set() const { return many_i.set.empty(); }
};

PatchEnds ends_of(const Surfaces& surfaces, std::uint32_t position, SampleSet set, const LatticePoint* at) {
  return {position, sample_points(set, surfaces.triangular(position)), at};
}

/// Places what isn't placed yet; a set that is cached isn't placed again.
PairEnds place_ends(const Surfaces& surfaces, std::uint32_t i, std::uint32_t j, const SegmentSets& sets,
                    DenseSamples& at_i, DenseSamples& at_j) {
  if (sets.few == surfaces.cached_set) {
    const PatchEnds ends_i = ends_of(surfaces, i, sets.few, surfaces.samples(i));
    return {ends_i, ends_of(surfaces, j, sets.few, surfaces.samples(j)), {}, {}};
  }
  for (DenseSamples* at : {&at_i, &at_j}) {
    if (at->placed) continue;
    const std::uint32_t position = at == &at_i ? i : j;
    place_samples(surfaces, position, sets.few, at->few);
    if (sets.many != sets.few) place_samples(surfaces, position, sets.many, at->many);
    at->placed = true;
  }
  PairEnds ends{ends_of(surfaces, i, sets.few, at_i.few), ends_of(surfaces, j, sets.few, at_j.few), {}, {}};
  if (sets.many != sets.few) {
    ends.many_i = ends_of(surfaces, i, sets.many, at_i.many);
    ends.many_j = ends_of(surfaces, j, sets.many, at_j.many);
  }
  return ends;
}

/// The points of both sets of a patch and the box around them.
Ends all_ends(const PatchEnds& few, const PatchEnds& many, LatticePoint* points) {
  Ends ends;
  std::size_t count = 0;
  for (const PatchEnds* set : {&few, &many}) {
    for (std::size_t k = 0; k < set->set.size(); ++k) {
      points[count++] = set->at[k];
      ends.box.include(set->at[k]);
    }
  }
  ends.points = {points, count};
  return ends;
}

/// Narrowed from a wide aim that holds for these ends, or else found anew.
Aim aim_between(const Surfaces& surfaces, const PairEnds& ends, const Aim* wide, Intersector& intersector) {
  if (surfaces.mesh_box.empty()) return {};  // flags off
  LatticePoint points_i[kMostPairPoints], points_j[kMostPairPoints];
  const Ends i = all_ends(ends.few_i, ends.many_i, points_i), j = all_ends(ends.few_j, ends.many_j, points_j);
  if (wide != nullptr) return intersector.narrow(*wide, i, j);
  return intersector.aim(i, j, link_between(surfaces, ends.few_i.position, ends.few_j.position));
}

double segments_between(const PairEnds& ends) {
  return static_cast<double>(ends.one_set() ? ends.few_i.set.size() * ends.few_j.set.size()
                                            : ends.few_i.set.size() * ends.many_j.set.size() * 2);
}

/// Of both sets; where no kernel is positive all count the same.
template <bool kPanes>
Sums weigh_both(const Surfaces& surfaces, const PairEnds& ends, const Tester& tester) {
  Sums sums;
  for (bool alike = false; !(sums.all > 0); alike = true) {
    if (ends.one_set()) {
      weigh<kPanes>(surfaces, ends.few_i, ends.few_j, alike, tester, sums);
    } else {
      weigh<kPanes>(surfaces, ends.few_i, ends.many_j, alike, tester, sums);
      weigh<kPanes>(surfaces, ends.many_i, ends.few_j, alike, tester, sums);
    }
  }
  return sums;
}

VisibleFraction weighted_fraction(const Surfaces& surfaces, const PairEnds& ends, const Tester& tester) {
  const Sums sums = weigh_both<false>(surfaces, ends, tester);
  const double value = sums.free / sums.all;
  return {value, value * (1 - value) / segments_between(ends)};
}

LatticeBox box_of(const PatchEnds& ends) {
  LatticeBox box;
  for (std::size_t k = 0; k < ends.set.size(); ++k) box.include(ends.at[k]);
  return box;
}

/// Whether panes may weaken a segment: asked of the points, so that the answer is the same with any aims.
bool panes_between(const PairEnds& ends, const Intersector& intersector) {
  if (!intersector.panes().any()) return false;
  LatticeBox i = box_of(ends.few_i), j = box_of(ends.few_j);
  if (!ends.one_set()) {
    i.include(box_of(ends.many_i));
    j.include(box_of(ends.many_j));
  }
  return intersector.panes().between(i, j);
}

/// The weighted mean of what arrives; `mixed` if segments differ.
VisibleFraction fraction_through_panes(const Surfaces& surfaces, const PairEnds& ends, const Tester& tester,
                                       bool& mixed) {
  const Sums sums = weigh_both<true>(surfaces, ends, tester);
  mixed = sums.mixed();
  const double value = mixed ? sums.free / sums.all : sums.most;
  return {value, mixed ? value * (1 - value) / segments_between(ends) : 0};
}

}  // namespace

VisibleFraction visible_fraction(const Surfaces& surfaces, std::uint32_t i, std::uint32_t j, bool crossing,
                                 const Options& options, Intersector& intersector, Sight* sight, const Aim& wide,
                                 DenseSamples& dense_i) {
  DenseSamples at_i, at_j;
  const bool densify = options.segments_mixed > options.segments_first;
  const SegmentSets first = segment_sets(options.segments_first);
  // The row's samples are those of the denser sets if there are any, else of the first.
  const PairEnds ends = place_ends(surfaces, i, j, first, densify ? at_i : dense_i, at_j);
  Tester tester{intersector, sight, {}};
  const bool panes = panes_between(ends, intersector);
  if (sight == nullptr) {
    tester.aim = aim_between(surfaces, ends, first.few == surfaces.cached_set ? &wide : nullptr, intersector);
    if (tester.aim.clear() && !panes && !crossing) return {1, 0};
  }
  if (panes) {
    bool mixed;
    const VisibleFraction found = fraction_through_panes(surfaces, ends, tester, mixed);
    if (!mixed || !densify) return found;
  }
  Seen seen;
  if (panes) {
    seen.free = seen.blocked = true;
  } else if (ends.one_set()) {
    look(surfaces, ends.few_i, ends.few_j, crossing, tester, seen);
  } else {
    look(surfaces, ends.few_i, ends.many_j, crossing, tester, seen);
    if (!seen.mixed()) look(surfaces, ends.many_i, ends.few_j, crossing, tester, seen);
  }
  if (seen.free && !seen.blocked) return {1, 0};
  if (seen.blocked && !seen.free) return {0, 0};
  // Mixed, or no pair of samples with a positive kernel.
  if (!densify) return weighted_fraction(surfaces, ends, tester);
  DenseSamples dense_j;
  const SegmentSets dense = segment_sets(options.segments_mixed);
  const PairEnds dense_ends = place_ends(surfaces, i, j, dense, dense_i, dense_j);
  if (sight == nullptr) tester.aim = aim_between(surfaces, dense_ends, nullptr, intersector);
  if (bool mixed; panes) return fraction_through_panes(surfaces, dense_ends, tester, mixed);
  return weighted_fraction(surfaces, dense_ends, tester);
}

}  // namespace shodo
