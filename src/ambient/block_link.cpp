#include "ambient/block_link.h"

#include "ambient/rough_exchange.h"

namespace shodo {

namespace {

using Step = LinkWalk::Step;

// Relative errors, chosen on the paper's rooms: errors and costs of others differ by less than a fifth.
// Of a fraction, by so many segments.
constexpr double kOfTwo = 0.37, kOfFour = 0.14, kOfEight = 0.07, kOfSixteen = 0.05;
constexpr double kOfMixed = 0.7;        // of a link as a whole, where some are blocked
constexpr double kOfDisc = 0.3;         // of the discs' form factors between patches
constexpr double kOfQuarters = 1.5;     // of a single disc instead of one for each pair of quarters
constexpr double kOfDiscBlocks = 0.3;   // the same between blocks
constexpr double kSeriesShare = 0.5;    // the part of REL that a series may use
constexpr double kMostNearError = 0.15;
constexpr double kMostRough = 5e-3;     // error of v beyond which geometry is as exact as --tiers says
constexpr double kDiscError = 0.2;      // of the disc's form factor, for the row's sum
constexpr double kDiscVaries = 0.5;     // d^2 of blocks so near to each other

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

/// The visible fraction where `free` of `all` segments are: (f + 1/2) / (n + 1) after Jeffreys, since that all agree
/// doesn't make them certain; half of that of independent ones, as their ends are spread evenly.
VisibleFraction fraction_of(std::uint32_t free, std::uint32_t all) {
  const double n = all, f = free;
  if (!(n > 0)) return {0, 0};
  return {f / n, 0.5 * (f + 0.5) * (n - f + 0.5) / ((n + 1) * (n + 1) * (n + 2))};
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
  const std::uint32_t root = surfaces_.mesh_begin[place_];
  own_block_ = surfaces_.is_block(node_);
  top_ = node_ == root || !surfaces_.is_block(root);
  asked_ = kNone;
  own_sent_ = tools_.worth.sent(node_);
  own_uneven_ = tools_.worth.uneven(node_);
  link_ = {surfaces_.scene->meshes[surfaces_.mesh_at[place_]].object, kNone, LightSet::kAmbient};
  own_boxes_[0] = tools_.places.box(surfaces_, node_, place_, false);
  own_boxes_[1] = tools_.places.box(surfaces_, node_, place_, true);
}

Step BlockJudge::judge(const RowSide& side, std::uint32_t j) {
  if (side.position != node_) start(side);
  if (link_.to == kNone || j >= surfaces_.mesh_begin[place_ + 1]) {
    while (j >= surfaces_.mesh_begin[place_ + 1]) ++place_;
    link_.to = surfaces_.scene->meshes[surfaces_.mesh_at[place_]].object;
    tools_.sight.turn_to(link_, place_, intersector_);
  }
  return decide(side, j);
}

/// Of the mesh at work, where integers didn't tell.
bool BlockJudge::out_of_sight(const RowSide& side) {
  if (!top_ || place_ == own_place_) return false;
  if (asked_ != place_) away_ = walk_.out_of_sight(side, place_);
  asked_ = place_;
  return away_;
}

LinkSeries BlockJudge::series_of(const RowSide& side, std::uint32_t j) {
  LinkSeries series = tools_.places.series(placed_, j, place_);
  if (series.kind != LinkKind::kOdd) return series;
  if (!out_of_sight(side)) return odd_series(surfaces_, side, j);
  series.kind = LinkKind::kAway;
  return series;
}

/// Whether a pair that has a series must be split for its kernel; which end then.
bool BlockJudge::varies_too_much(Pair& pair) const {
  const LinkWorth& worth = tools_.worth;
  const LinkSeries& series = pair.series;
  const double over_i = series.vary_i * (worth.sent(pair.j) + own_uneven_);
  const double over_j = series.vary_j * (own_sent_ + worth.uneven(pair.j));
  if (series.value * series.value * (over_i + over_j) <= worth.allowed()) return false;
  if (own_block_ && surfaces_.is_block(pair.j) && over_i != over_j) {
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
  const bool i_block = own_block_, j_block = s.is_block(j), has_series = series.kind == LinkKind::kSeries;
  pair.patches = !i_block && !j_block;
  const bool first = i_block && (!j_block || side.patch->longest_side >= s.patch(j).longest_side);
  pair.split = first ? Step::kSplitFirst : Step::kSplitSecond;
  const double v = has_series ? series.value + series.error : series.most;
  double power = own_sent_ + worth.sent(j);
  if (i_block) power += own_uneven_;
  if (j_block) power += worth.uneven(j);
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
  found_.vary_i = !i_block ? 0 : has_series ? series.vary_i : kDiscVaries;
  found_.vary_j = !j_block ? 0 : has_series ? series.vary_j : kDiscVaries;
  // However dark it is: rows are to sum to 1.
  pair.near = pair.near || (has_series ? series.error : kDiscError * series.value) > kMostRough;
  return measure(side, pair) ? look(pair) : Step::kNothing;
}

/// The exchange without shadows; false: there is none.
bool BlockJudge::measure(const RowSide& side, const Pair& pair) {
  LinkSeries series = pair.series;
  const double roots = surfaces_.root_area[node_] * surfaces_.root_area[pair.j];
  const bool rough = series.kind != LinkKind::kSeries && !pair.near && !within(pair.whole, kOfQuarters);
  if (rough && placed_.kind != PlaceKind::kOdd) {
    const PlacedSide other = tools_.places.side(pair.j, place_);
    if (other.kind != PlaceKind::kOdd) series.value = rough_exchange(placed_, other);
  }
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

/// Whether a pair in half shade must be split.
bool BlockJudge::mixed_splits(const Pair& pair) const { return !pair.patches && !within(pair.whole, kOfMixed); }

struct BlockJudge::Shots {
  Shots(const LatticePoint* i, const LatticePoint* j) : at_i(i), at_j(j) {}

  const LatticePoint* at_i;
  const LatticePoint* at_j;
  bool front_i[4], front_j[4];  // seen from the other's front
  std::uint32_t free = 0, all = 0;
  bool panes = false;  // may be between
  double passed = 0;   // with panes: of the free ones, what they let through

  bool mixed() const { return free > 0 && free < all; }
  bool faces(std::uint32_t k, std::uint32_t l) const { return front_i[k] && front_j[l]; }
};

/// Whether a sample of a node is in front of another node, exactly where integers don't tell.
bool BlockJudge::in_front(std::uint32_t node, std::uint32_t sample, std::uint32_t other, std::uint32_t place) const {
  const Surfaces& s = surfaces_;
  const int sign = tools_.places.sign_over(other, place, s.samples(node)[sample]);
  if (sign != 0) return sign > 0;
  const Patch& plane = s.patch(other);
  const SamplePoint& at = sample_points(s.cached_set, s.triangular(node))[sample];
  return dot(plane.normal, sample_place(s, node, at) - plane.centre) > s.flat;
}

BlockJudge::Shots BlockJudge::shots_of(const Pair& pair) const {
  const std::uint32_t j = pair.j;
  Shots shots(surfaces_.samples(node_), surfaces_.samples(j));
  for (std::uint32_t k = 0; k < surfaces_.cached_points; ++k) {
    shots.front_i[k] = !found_.pair.crossing || in_front(node_, k, j, place_);
    shots.front_j[k] = !found_.pair.crossing || in_front(j, k, node_, own_place_);
  }
  return shots;
}

void BlockJudge::shoot(Shots& shots, std::uint32_t k, std::uint32_t l) {
  if (!shots.faces(k, l)) return;
  ++shots.all;
  if (tools_.sight.blocked(shots.at_i[k], shots.at_j[l], link_, intersector_)) return;
  ++shots.free;
  if (shots.panes) shots.passed += intersector_.panes().pass(shots.at_i[k], shots.at_j[l]);
}

/// The visible fraction by one segment: a shadow, or nothing, is as far as the pair matters.
void BlockJudge::look_once(std::uint32_t k, std::uint32_t j, std::uint32_t l) {
  const LatticePoint &p = surfaces_.samples(node_)[k], &q = surfaces_.samples(j)[l];
  const bool blocked = tools_.sight.blocked_alone(p, q, link_, intersector_);
  found_.visible = fraction_of(blocked ? 0 : 1, 1);
}

/// By two segments, or the order to split.
Step BlockJudge::look_twice(const Pair& pair, const Ends& first, const Ends& second) {
  std::uint32_t free = 0;
  for (const Ends* ends : {&first, &second}) {
    const LatticePoint &p = surfaces_.samples(node_)[ends->i], &q = surfaces_.samples(pair.j)[ends->j];
    free += tools_.sight.blocked_alone(p, q, link_, intersector_) ? 0 : 1;
  }
  if (free == 1 && mixed_splits(pair)) return pair.split;
  found_.visible = fraction_of(free, 2);
  return Step::kLink;
}

/// The same, and what panes between the two let through.
Step BlockJudge::look_through_panes(const Pair& pair, std::uint32_t hash) {
  const std::uint32_t last = surfaces_.cached_points - 1, turn = hash & last;
  tools_.sight.list(own_box(false), box_of(pair.j, false));
  Shots shots = shots_of(pair);
  shots.panes = true;
  if (pair.slight && !found_.pair.crossing) {
    shoot(shots, turn, hash >> 2 & last);
    found_.visible = fraction_of(shots.free, shots.all);
  } else if (!shoot_all(pair, turn, shots)) {
    return pair.split;
  }
  if (shots.all > 0) found_.visible.value = shots.passed / shots.all;
  return Step::kLink;
}

/// The visible fraction, or the order to split. Segment (k, k ^ m ^ turn) is the k-th of round m: each round meets
/// every sample of both ends once. `turn` differs from pair to pair, so that one segment a pair isn't always the same
/// corner.
Step BlockJudge::look(const Pair& pair) {
  const std::uint32_t j = pair.j, points = surfaces_.cached_points, last = points - 1;
  const bool by_sixteen = within(pair.whole, kOfSixteen), crossing = found_.pair.crossing;
  Sight& sight = tools_.sight;
  found_.visible = {1, 0};
  const bool full = pair.patches && !by_sixteen;
  const bool panes = intersector_.panes().any() && intersector_.panes().between(own_box(full), box_of(j, full));
  if (full) {
    if (sight.list(own_box(true), box_of(j, true)) && !panes) return Step::kLink;
    found_.visible = visible_fraction(surfaces_, node_, j, crossing, options_, intersector_, &sight, {}, dense_);
    return Step::kLink;
  }
  if (!by_sixteen) return sight.clear(own_box(false), box_of(j, false)) && !panes ? Step::kLink : pair.split;
  const std::uint32_t hash = (node_ * 0x9E3779B1u + j * 0x85EBCA77u) >> 20, turn = hash & last;
  if (panes) return look_through_panes(pair, hash);
  if (pair.slight && !crossing) {
    look_once(turn, j, hash >> 2 & last);
    return Step::kLink;
  }
  const bool by_two = points > 1 && within(pair.whole, kOfTwo);
  if (by_two && !crossing) return look_twice(pair, {0, turn}, {last, last ^ turn});
  Shots shots = shots_of(pair);
  std::uint32_t first = 0;
  const auto ends = [&](std::uint32_t n) { return Ends{n & last, (n ^ n / points ^ turn) & last}; };
  while (first < points * points && !shots.faces(ends(first).i, ends(first).j)) ++first;
  if (first == points * points) {
    if (!sight.clear(own_box(false), box_of(j, false))) found_.visible = {0, 0};
    return Step::kLink;
  }
  const Ends from = ends(first);
  if (pair.slight) {
    look_once(from.i, j, from.j);
    return Step::kLink;
  }
  if (by_two) {
    std::uint32_t end = points * points - 1;
    while (!shots.faces(ends(end).i, ends(end).j)) --end;
    return look_twice(pair, from, ends(end));
  }
  if (sight.list_unless_blocked(shots.at_i[from.i], shots.at_j[from.j], own_box(false), box_of(j, false))) {
    return Step::kLink;
  }
  return shoot_all(pair, turn, shots) ? Step::kLink : pair.split;
}

/// All rounds that the pair is worth; false if it is to be split.
bool BlockJudge::shoot_all(const Pair& pair, std::uint32_t turn, Shots& shots) {
  const std::uint32_t points = surfaces_.cached_points, last = points - 1;
  const bool splits = mixed_splits(pair);
  const bool by_four = within(pair.whole, kOfFour), by_eight = within(pair.whole, kOfEight);
  const std::uint32_t rounds = by_four ? 1 : by_eight ? 2 : points;
  for (std::uint32_t m = 0; m < rounds; ++m) {
    for (std::uint32_t k = 0; k < points; ++k) {
      shoot(shots, k, (k ^ m ^ turn) & last);
      if (splits && shots.mixed()) return false;
    }
  }
  found_.visible = fraction_of(shots.free, shots.all);
  return true;
}

}  // namespace shodo
