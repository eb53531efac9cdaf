#include "ambient/block_link.h"

namespace shodo {

namespace {

using Step = LinkWalk::Step;

// Relative errors, chosen on the paper's rooms: errors and costs of others differ by less than a fifth.
constexpr double kOfFour = 0.2, kOfEight = 0.1, kOfSixteen = 0.05;  // of a fraction, where so many segments agree
constexpr double kOfMixed = 0.7;        // of a link as a whole, where some are blocked
constexpr double kOfDisc = 0.25;        // of the disc's form factor between patches
constexpr double kOfDiscBlocks = 0.3;   // the same between blocks
constexpr double kSeriesShare = 0.5;    // the part of REL that a series may use
constexpr double kMostNearError = 0.05;
constexpr double kMostRough = 5e-3;     // error of v beyond which geometry is as exact as --tiers says
constexpr double kDiscError = 0.2;      // of the disc's form factor, for the row's sum

/// Of shapes that have no place on the lattice, in floating point.
LinkSeries odd_series(const Surfaces& s, const RowSide& side, std::uint32_t j) {
  LinkSeries link;
  const PairSeries found = series_between(s, side, j);
  link.kind = LinkKind::kAway;
  if (found.away) return link;
  const double roots = s.root_area[side.position] * s.root_area[j];
  const double area_i = side.patch->area, area_j = s.patch(j).area;
  if (found.found) {
    link.kind = LinkKind::kSeries;
    link.value = found.geometric / roots;
    link.error = found.error / roots;
    link.most = area_i * area_j * kInversePi / (found.squared * roots);
    link.vary_i = found.vary_i;
    link.vary_j = found.vary_j;
    return link;
  }
  // A quarter for both cosines, which differ over patches so near.
  const double larger = area_i < area_j ? area_j : area_i;
  link.kind = found.crossing ? LinkKind::kCrossing : LinkKind::kClose;
  link.most = area_i * area_j / (found.squared * kPi + larger) / roots;
  link.value = 0.25 * link.most;
  return link;
}

}  // namespace

std::uint64_t BlockTools::bytes(const Scene& scene, const Geometry& geometry, const Options& options) {
  if (!features::blocks(options.rules)) return 0;
  return LinkWorth::bytes(scene, options.rules) + Places::bytes(scene, options.rules) +
         Sight::bytes(geometry, options);
}

Status BlockTools::take(Arena& arena, const Surfaces& surfaces, const DirectLight& direct, const Options& options) {
  if (!features::blocks(options.rules)) return {};
  Status status = worth.take(arena, surfaces, direct, options.rules);
  if (status.done()) status = places.take(arena, surfaces, options.rules);
  if (status.done()) status = sight.take(arena, *surfaces.geometry, options);
  return status;
}

void BlockJudge::start(const RowSide& side) {
  node_ = side.position;
  dense_.placed = false;
  place_ = 0;
  while (node_ >= surfaces_.mesh_begin[place_ + 1]) ++place_;
  own_place_ = place_;
  placed_ = tools_.places.side(node_, place_);
  tools_.sight.open(node_, surfaces_.end(node_), tools_.places.box(surfaces_, node_, place_, true));
}

Step BlockJudge::judge(const RowSide& side, std::uint32_t j) {
  if (side.position != node_) start(side);
  while (j >= surfaces_.mesh_begin[place_ + 1]) ++place_;
  const Link link{surfaces_.mesh(node_).object, surfaces_.mesh(j).object, LightSet::kAmbient};
  tools_.sight.turn_to(j, link, intersector_);
  const Step step = decide(side, j);
  if (step == Step::kSplitFirst || step == Step::kSplitSecond) {
    const LatticeBox box = tools_.places.box(surfaces_, j, place_, true);
    tools_.sight.split(j, surfaces_.end(j), box, step == Step::kSplitFirst);
  }
  return step;
}

LinkSeries BlockJudge::series_of(const RowSide& side, std::uint32_t j) const {
  const LinkSeries series = tools_.places.series(placed_, j, place_);
  return series.kind == LinkKind::kOdd ? odd_series(surfaces_, side, j) : series;
}

/// Whether a pair that has a series must be split for its kernel; which end then.
bool BlockJudge::varies_too_much(Pair& pair) const {
  const LinkWorth& worth = tools_.worth;
  const LinkSeries& series = pair.series;
  const double over_i = series.vary_i * (worth.sent(pair.j) + worth.uneven(node_));
  const double over_j = series.vary_j * (worth.sent(node_) + worth.uneven(pair.j));
  if (series.value * series.value * (over_i + over_j) <= worth.allowed()) return false;
  if (surfaces_.is_block(node_) && surfaces_.is_block(pair.j) && over_i != over_j) {
    pair.split = over_i > over_j ? Step::kSplitFirst : Step::kSplitSecond;
  }
  return true;
}

Step BlockJudge::decide(const RowSide& side, std::uint32_t j) {
  const Surfaces& s = surfaces_;
  const LinkWorth& worth = tools_.worth;
  Pair pair;
  pair.j = j;
  pair.series = series_of(side, j);
  const LinkSeries& series = pair.series;
  if (series.kind == LinkKind::kAway) return Step::kNothing;
  const bool i_block = s.is_block(node_), j_block = s.is_block(j), has_series = series.kind == LinkKind::kSeries;
  pair.patches = !i_block && !j_block;
  const bool first = i_block && (!j_block || side.patch->longest_side >= s.patch(j).longest_side);
  pair.split = first ? Step::kSplitFirst : Step::kSplitSecond;
  const double v = has_series ? series.value + series.error : series.most;
  const double power = worth.sent(node_) + worth.sent(j) + worth.uneven(node_) + worth.uneven(j);
  pair.whole = v * v * power;
  pair.slight = pair.whole <= worth.allowed();
  if (!has_series) {
    if (!pair.patches && !within(pair.whole, kOfDiscBlocks)) return pair.split;
    pair.near = pair.patches && !within(pair.whole, kOfDisc);
  } else if (!pair.slight) {
    if (!pair.patches && varies_too_much(pair)) return pair.split;
    pair.near = !within(series.error * series.error * power, 1 / kSeriesShare) &&
                (pair.patches || series.error > options_.tiers * series.most);
    if (pair.near && !pair.patches) return pair.split;
  }
  // However dark it is: rows are to sum to 1.
  pair.near = pair.near || (has_series ? series.error : kDiscError * series.value) > kMostRough;
  return measure(side, pair) ? look(side, pair) : Step::kNothing;
}

/// The exchange without shadows; false: there is none.
bool BlockJudge::measure(const RowSide& side, const Pair& pair) {
  const LinkSeries& series = pair.series;
  const double roots = surfaces_.root_area[node_] * surfaces_.root_area[pair.j];
  const double error = series.kind == LinkKind::kSeries ? series.error : kDiscError * series.value;
  found_.pair = {series.value * roots, error * roots, series.kind == LinkKind::kCrossing};
  const bool always = !(options_.tiers > 0);
  if (pair.near || always) {
    double tolerance = 0;
    if (!always) {
      tolerance = pair.whole > 0 ? kSeriesShare * square_root(tools_.worth.allowed() / pair.whole) : 1;
      if (tolerance > kMostNearError) tolerance = kMostNearError;
      if (tolerance < options_.tiers) tolerance = options_.tiers;
    }
    found_.pair = exchange_between(surfaces_, side, pair.j, tolerance);
  }
  return found_.pair.geometric > 0;
}

struct BlockJudge::Shots {
  const LatticePoint* at_i;
  const LatticePoint* at_j;
  Link link;
  bool front_i[4], front_j[4];  // seen from the other's front
  std::uint32_t free = 0, all = 0;
  bool panes = false;  // may be between
  double passed = 0;   // with panes: of the free ones, what they let through

  bool mixed() const { return free > 0 && free < all; }
};

BlockJudge::Shots BlockJudge::shots_of(const RowSide& side, const Pair& pair) const {
  const Surfaces& s = surfaces_;
  const std::uint32_t points = s.cached_points, j = pair.j;
  Shots shots{s.samples(node_), s.samples(j),
              {s.mesh(node_).object, s.mesh(j).object, LightSet::kAmbient}, {}, {}};
  const std::span<const SamplePoint> set_i = sample_points(s.cached_set, s.triangular(node_));
  const std::span<const SamplePoint> set_j = sample_points(s.cached_set, s.triangular(j));
  for (std::uint32_t k = 0; k < points; ++k) {
    shots.front_i[k] = shots.front_j[k] = true;
    if (!found_.pair.crossing) continue;
    const Patch& other = s.patch(j);
    shots.front_i[k] = dot(other.normal, sample_place(s, node_, set_i[k]) - other.centre) > s.flat;
    shots.front_j[k] = dot(side.patch->normal, sample_place(s, j, set_j[k]) - side.patch->centre) > s.flat;
  }
  return shots;
}

void BlockJudge::shoot(Shots& shots, std::uint32_t k, std::uint32_t l) {
  if (!shots.front_i[k] || !shots.front_j[l]) return;
  ++shots.all;
  if (!tools_.sight.blocked(shots.at_i[k], shots.at_j[l], shots.link, intersector_)) {
    ++shots.free;
    if (shots.panes) shots.passed += intersector_.panes().pass(shots.at_i[k], shots.at_j[l]);
  }
}

/// The visible fraction, or the order to split. Segment (k, k ^ m ^ turn) is the k-th of round m: each round meets
/// every sample of both ends once. `turn` differs from pair to pair, so that one segment a pair isn't always the same
/// corner.
Step BlockJudge::look(const RowSide& side, const Pair& pair) {
  const std::uint32_t j = pair.j, points = surfaces_.cached_points, last = points - 1;
  const bool by_sixteen = within(pair.whole, kOfSixteen), full = pair.patches && !by_sixteen;
  found_.visible = {1, 0};
  const LatticeBox& box_i = tools_.places.box(surfaces_, node_, own_place_, full);
  const LatticeBox& box_j = tools_.places.box(surfaces_, j, place_, full);
  const bool panes = intersector_.panes().any() && intersector_.panes().between(box_i, box_j);
  if (tools_.sight.clear(box_i, box_j) && !panes) return Step::kLink;
  if (full) {
    found_.visible = visible_fraction(surfaces_, node_, j, found_.pair.crossing, options_, intersector_,
                                      &tools_.sight, {}, dense_);
    return Step::kLink;
  }
  if (!by_sixteen) return pair.split;
  const std::uint32_t hash = (node_ * 0x9E3779B1u + j * 0x85EBCA77u) >> 20, turn = hash & last;
  Shots shots = shots_of(side, pair);
  shots.panes = panes;
  if (pair.slight && !found_.pair.crossing) {
    shoot(shots, turn, hash >> 2 & last);
  } else {
    const bool mixed_splits = !pair.patches && !within(pair.whole, kOfMixed);
    const bool by_four = within(pair.whole, kOfFour) && !found_.pair.crossing;
    const bool by_eight = within(pair.whole, kOfEight) && !found_.pair.crossing;
    const std::uint32_t rounds = by_four ? 1 : by_eight ? 2 : points;
    for (std::uint32_t m = 0; m < points && (m < rounds || shots.mixed()); ++m) {
      for (std::uint32_t k = 0; k < points; ++k) {
        if (pair.slight && shots.all > 0) break;
        shoot(shots, k, (k ^ m ^ turn) & last);
        if (mixed_splits && !pair.slight && shots.mixed()) return pair.split;
      }
    }
  }
  // (f + 1/2) / (n + 1) after Jeffreys: that all agree doesn't make them certain.
  const double n = shots.all, f = shots.free;
  found_.visible = n > 0 ? VisibleFraction{f / n, (f + 0.5) * (n - f + 0.5) / ((n + 1) * (n + 1) * (n + 2))}
                         : VisibleFraction{0, 0};
  if (panes && n > 0) found_.visible.value = shots.passed / n;
  return Step::kLink;
}

}  // namespace shodo
