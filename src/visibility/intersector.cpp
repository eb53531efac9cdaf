#include "visibility/intersector.h"

#include <utility>

#include "base/bits.h"
#include "base/wide.h"
#include "visibility/triangle_test.h"

namespace shodo {

namespace {

/// Masks ask all facets, 32 at a time; a tree asks few of many.
constexpr std::uint32_t kMostMasked = 4096;

LatticeBox box_of(const LatticePoint& p) {
  LatticeBox box;
  box.include(p);
  return box;
}

/// The other end of a segment; for a sun out of the lattice's cube.
LatticePoint operator+(const LatticePoint& p, const LatticeVector& direction) {
  return {static_cast<std::int32_t>(p.x + direction.x), static_cast<std::int32_t>(p.y + direction.y),
          static_cast<std::int32_t>(p.z + direction.z)};
}

/// Whether the line from p along d passes the box of a facet square to an axis, given that p and p + d are on opposite
/// sides of it; exact, products within 2^42. Where it does not, neither triangle blocks; where it does and they fill
/// the box, one of them does: 6 small products instead of 36 large ones.
bool passes_flat(const Facet& facet, const LatticePoint& p, const LatticePoint& d) {
  const LatticeBox& box = facet.box;
  const std::int32_t at[3] = {p.x, p.y, p.z}, way[3] = {d.x, d.y, d.z};
  const int axis = box.low[0] > box.high[0] ? 0 : box.low[1] > box.high[1] ? 1 : 2;
  const std::int32_t whole = way[axis], part = box.low[axis] - 1 - at[axis];
  for (int k = 0; k < 3; ++k) {
    if (k == axis) continue;
    const std::int64_t run = product(part, way[k]);
    const std::int64_t low = product(box.low[k] - at[k], whole), high = product(box.high[k] - at[k], whole);
    if (whole > 0 ? run < low || run > high : run > low || run < high) return false;
  }
  return true;
}

}  // namespace

/// The nearest hit so far: at the fraction `distance` / `speed` of the direction, |s(P)| / |N.d|.
struct Intersector::Nearest {
  Hit hit;
  std::int64_t distance = 0, speed = 1;

  /// Two are compared by cross products of 128 bits. Ties: front before back, then the lower index.
  void meet(const Triangle& triangle, std::uint32_t k, const LatticePoint& p, const LatticeVector& direction) {
    const std::int64_t side = triangle.side(p);
    const std::int64_t through = dot(triangle.n, direction);
    const std::int64_t far = side < 0 ? -side : side;
    const std::int64_t fast = through < 0 ? -through : through;
    const Hit other{k, side > 0};
    if (hit.triangle != kNone && !less_fraction(far, fast, distance, speed)) {
      if (less_fraction(distance, speed, far, fast)) return;
      if (other.front != hit.front ? hit.front : hit.triangle < k) return;
    }
    hit = other;
    distance = far;
    speed = fast;
  }
  void offer(const Triangle& triangle, std::uint32_t k, const LatticePoint& p, const LatticeVector& direction) {
    if (blocks_ray(triangle, p, direction)) meet(triangle, k, p, direction);
  }
};

bool Intersector::take_flags(Arena& arena) {
  flags_stay_ = features::aims(mode_);
  return !features::aims(mode_) || flags_.fill(*scene_, mode_ == FlagMode::kScene, arena);
}

bool Intersector::start(Arena& arena, Rectangles rectangles) {
  if (!features::aims(mode_)) return true;
  if (!flags_stay_ && !flags_.fill(*scene_, mode_ == FlagMode::kScene, arena)) return false;
  if (!blockers_.build(*geometry_, arena, rectangles)) return false;
  const std::size_t count = blockers_.facets().size();
  if (!arena.take("possible blockers", count, wide_)) return false;
  if (!arena.take("possible blockers of a pair", count, narrow_)) return false;
  started_ = true;
  for (Facet& facet : blockers_.facets()) {
    const std::uint32_t object = geometry_->triangles[facet.first].object;
    facet.blocks = static_cast<std::uint8_t>((flags_.blocks(object, LightSet::kDirect) ? 1 : 0) +
                                             (flags_.blocks(object, LightSet::kAmbient) ? 2 : 0));
  }
  return true;
}

bool Intersector::take_masks(Arena& arena) {
  const std::uint32_t most = Blockers::facet_count(*geometry_);
  if (!seeking() || most > kMostMasked || arena.capacity() - arena.in_use() < FacetMasks::bytes(most)) return true;
  if (!masks_.take(arena, most)) return false;
  const std::span<const Facet> facets = blockers_.facets();
  LatticeBox around;
  for (const Facet& facet : facets) around.include(facet.box);
  masks_.start(static_cast<std::uint32_t>(facets.size()), around);
  for (std::uint32_t k = 0; k < facets.size(); ++k) masks_.add(k, facets[k].box);
  return true;
}

void Intersector::finish() {
  blockers_ = {};
  masks_ = {};
  if (!flags_stay_) flags_ = {};
  wide_ = narrow_ = {};
  started_ = false;
}

std::uint64_t Intersector::bytes(const Geometry& geometry, FlagMode mode) {
  if (!features::aims(mode)) return 0;
  const std::uint64_t facets = Blockers::facet_count(geometry);
  return Blockers::bytes(geometry) + 2 * ((4 * facets + 7) / 8 * 8);
}

/// visit(facet) for all in the shaft, in an order that the geometry fixes.
template <class Visit>
void Intersector::visit(const Shaft& shaft, Visit visit) const {
  if (!masks_.taken()) return blockers_.visit(shaft, visit);
  Shaft narrow = shaft;
  masks_.visit(shaft.from(), shaft.to(), [&](std::uint32_t k) {
    if (!narrow.misses(blockers_.facets()[k].box)) visit(k);
    return false;
  });
}

Aim Intersector::aim_in(const Shaft& shaft, const Link& link, std::span<std::uint32_t> list) {
  std::uint32_t count = 0;
  const std::uint32_t set = index(link.set);
  visit(shaft, [&](std::uint32_t k) {
    if ((blockers_.facets()[k].blocks >> set & 1) != 0) list[count++] = k;
  });
  return {list.first(count), false};
}

std::size_t Intersector::others_first(const Aim& aim, std::uint32_t object) const {
  std::size_t others = 0;
  for (std::uint32_t& facet : aim.facets) {
    if (geometry_->triangles[blockers_.facets()[facet].first].object == object) continue;
    const std::uint32_t moved = aim.facets[others];
    aim.facets[others++] = facet;
    facet = moved;
  }
  return others;
}

Aim Intersector::keep_wide(std::span<const std::uint32_t> facets, Shaft shaft) {
  std::uint32_t count = 0;
  for (const std::uint32_t k : facets) {
    if (!shaft.misses(blockers_.facets()[k].box)) wide_[count++] = k;
  }
  return {wide_.first(count), false};
}

Aim Intersector::aim_among(std::span<const std::uint32_t> facets, const LatticeBox& a, const LatticeBox& b) {
  return keep_wide(facets, Shaft(a, b));
}

Aim Intersector::aim_among(std::span<const std::uint32_t> facets, const LatticeBox& a, const LatticeBox& b,
                           const EndGrid& grid) {
  LatticeBox around = a;
  around.include(b);
  std::uint32_t count = 0;
  for (const std::uint32_t k : facets) {
    const LatticeBox& box = blockers_.facets()[k].box;
    if (apart(around, box)) continue;
    const std::uint32_t hides = grid.shadow(box, a);
    if (hides == 0) continue;
    narrow_[count] = hides;
    wide_[count++] = k;
  }
  return {wide_.first(count), false, narrow_.first(count), &grid};
}

Aim Intersector::sift(const Aim& wide, const LatticeBox& from, const EndGrid& grid) {
  if (wide.any_triangle) return wide;
  std::uint32_t count = 0;
  for (const std::uint32_t k : wide.facets) {
    const std::uint32_t hides = grid.shadow(blockers_.facets()[k].box, from);
    if (hides == 0) continue;
    narrow_[count] = hides;
    wide.facets[count++] = k;
  }
  return {wide.facets.first(count), false, narrow_.first(count), &grid};
}

Aim Intersector::aim_along_among(std::span<const std::uint32_t> facets, const LatticeBox& a,
                                 const LatticeVector& direction) {
  return keep_wide(facets, Shaft::along(a, direction));
}

bool Intersector::hides_all(std::uint32_t k, const LatticeBox& a, const LatticeBox& b, const Link& link) {
  const Facet& facet = blockers_.facets()[k];
  if (facet.rectangle == 0 || !shodo::hides_all(facet.box, a, b)) return false;
  flags_.note_blocked(link, geometry_->triangles[facet.first].object);
  return true;
}

Aim Intersector::gather_along(const LatticeBox& a, const LatticeVector& direction) {
  if (!seeking()) return {};
  std::uint32_t count = 0;
  visit(Shaft::along(a, direction), [&](std::uint32_t k) { wide_[count++] = k; });
  return {wide_.first(count), false};
}

Aim Intersector::gather_near(const LatticeBox& a, const LatticeVector& direction) {
  constexpr std::int64_t kRounding = (1 << kNearPart) - 1;
  const auto part = [](std::int64_t x) {
    return x < 0 ? -((kRounding - x) >> kNearPart) : (x + kRounding) >> kNearPart;
  };
  return gather_along(a, {part(direction.x), part(direction.y), part(direction.z)});
}

template <class Miss>
Aim Intersector::keep(const Aim& wide, Shaft shaft, Miss misses) {
  std::uint32_t count = 0;
  for (const std::uint32_t k : wide.facets) {
    const Facet& facet = blockers_.facets()[k];
    if (shaft.misses(facet.box) || (facet.tilted != 0 && misses(triangles_of(facet)))) continue;
    narrow_[count++] = k;
  }
  return {narrow_.first(count), false};
}

Aim Intersector::aim(const LatticeBox& a, const LatticeBox& b, const Link& link) {
  if (!seeking()) return {};
  if (!flags_.tested(link)) return {{}, false};
  return aim_in(Shaft(a, b), link, wide_);
}

Aim Intersector::aim(const Ends& a, const Ends& b, const Link& link) {
  if (!seeking()) return {};
  if (!flags_.tested(link)) return {{}, false};
  const Shaft shaft(a.box, b.box);
  return keep(aim_in(shaft, link, narrow_), shaft,
              [&](std::span<const Triangle> triangles) { return misses_side(triangles, a.points, b.points); });
}

Aim Intersector::aim_along(const LatticeBox& a, const LatticeVector& direction, const Link& link) {
  if (!seeking()) return {};
  if (!flags_.tested(link)) return {{}, false};
  return aim_in(Shaft::along(a, direction), link, wide_);
}

Aim Intersector::narrow(const Aim& wide, const Ends& a, const Ends& b) {
  if (!features::kAims || wide.any_triangle || wide.facets.empty()) return wide;
  return keep(wide, Shaft(a.box, b.box),
              [&](std::span<const Triangle> triangles) { return misses_side(triangles, a.points, b.points); });
}

/// attempt(triangle) for all that block, ascending, until one says true.
template <class Try>
bool Intersector::any_triangle(Try attempt) const {
  const std::uint32_t count = static_cast<std::uint32_t>(geometry_->triangles.size());
  std::uint32_t k = 0;
  for (const Pane& pane : geometry_->panes) {
    for (; k < pane.first; ++k) {
      if (attempt(k)) return true;
    }
    k += pane.count;
  }
  for (; k < count; ++k) {
    if (attempt(k)) return true;
  }
  return false;
}

/// Flags off: file order. Else the aim's order, in which a blocker comes to the front. From p along d.
template <class Blocks>
bool Intersector::any_blocks(Blocks blocks, const LatticePoint& p, const LatticeVector& d, const Link& link,
                             const Aim& aim) {
  ++segments_[index(link.set)];
  std::uint64_t& tests = tests_[index(link.set)];
  if (!features::kAims || aim.any_triangle) {
    return any_triangle([&](std::uint32_t k) {
      ++tests;
      return blocks(geometry_->triangles[k]);
    });
  }
  LatticeBox around = box_of(p);
  around.include(p + d);
  const LatticePoint way{static_cast<std::int32_t>(d.x), static_cast<std::int32_t>(d.y),
                         static_cast<std::int32_t>(d.z)};
  for (std::uint32_t& k : aim.facets) {
    const Facet& facet = blockers_.facets()[k];
    tests += facet.count;
    if (apart(around, facet.box) || (facet.tilted == 0 && !passes_flat(facet, p, way))) continue;
    const std::span<const Triangle> triangles = triangles_of(facet);
    if (facet.rectangle == 0 && !blocks(triangles[0]) && (facet.count == 1 || !blocks(triangles[1]))) continue;
    flags_.note_blocked(link, triangles[0].object);
    const std::uint32_t found = k;
    k = aim.facets[0];
    aim.facets[0] = found;
    return true;
  }
  return false;
}

bool Intersector::blocked(const LatticePoint& p, const LatticePoint& q, const Link& link, const Aim& aim) {
  return any_blocks([&](const Triangle& triangle) { return blocks_segment(triangle, p, q); }, p, q - p, link, aim);
}

bool Intersector::ray_blocked(const LatticePoint& p, const LatticeVector& direction, const Link& link, const Aim& aim) {
  return any_blocks([&](const Triangle& triangle) { return blocks_ray(triangle, p, direction); }, p, direction, link,
                    aim);
}

/// `facets`: the aim's or a part of them; `hides` goes with all of them only. Blockers come to the front.
std::uint32_t Intersector::shadow_among(const Segments& segments, std::uint32_t wanted, const Link& link,
                                        std::span<std::uint32_t> facets, const Aim& aim) {
  std::uint32_t shadow = 0, first = 0;
  std::uint64_t tests = 0;
  const LatticeBox from = box_of(segments.from);
  LatticeBox around = from;
  around.include(segments.box);
  const bool sifted = !aim.hides.empty();
  for (std::uint32_t k = 0; k < facets.size() && shadow != wanted; ++k) {
    std::uint32_t open = wanted & ~shadow;
    if (sifted) open &= aim.hides[k];
    if (open == 0) continue;
    const Facet& facet = blockers_.facets()[facets[k]];
    if (!sifted && apart(around, facet.box)) continue;
    // Of sifted facets a rectangle is as soon tested.
    if (aim.grid != nullptr && (!sifted || facet.rectangle == 0)) open &= aim.grid->shadow(facet.box, from);
    if (open == 0) continue;
    tests += facet.count * count_bits(open);
    const std::span<const Triangle> triangles = triangles_of(facet);
    const std::uint32_t more = shadow_of(facet, triangles, segments, open);
    if (more == 0) continue;
    shadow |= more;
    flags_.note_blocked(link, triangles[0].object);
    std::swap(facets[k], facets[first]);
    if (sifted) std::swap(aim.hides[k], aim.hides[first]);
    ++first;
  }
  tests_[index(link.set)] += tests;
  return shadow;
}

std::uint32_t Intersector::shadow(const Segments& segments, std::uint32_t wanted, const Link& link, const Aim& aim) {
  return shadow(segments, wanted, link, aim, aim.facets.size(), 0);
}

std::uint32_t Intersector::shadow(const Segments& segments, std::uint32_t wanted, const Link& link, const Aim& aim,
                                  std::size_t others, std::uint32_t own_wanted) {
  std::uint32_t shadow = 0;
  if (!features::kAims || aim.any_triangle) {
    for_each_bit(wanted, [&](std::uint32_t k, std::uint32_t bit) {
      if (blocked(segments.from, segments.ends[k], link, aim)) shadow |= bit;
    });
    return shadow;
  }
  segments_[index(link.set)] += count_bits(wanted);
  shadow = shadow_among(segments, wanted, link, aim.facets.first(others), aim);
  if ((own_wanted & ~shadow) == 0) return shadow;
  return shadow | shadow_among(segments, own_wanted & ~shadow, link, aim.facets.subspan(others), aim);
}

bool Intersector::blocked(const LatticePoint& p, const LatticePoint& q, const Link& link) {
  return blocked(p, q, link, aim({{&p, 1}, box_of(p)}, {{&q, 1}, box_of(q)}, link));
}

bool Intersector::ray_blocked(const LatticePoint& p, const LatticeVector& direction, const Link& link) {
  return ray_blocked(p, direction, link, aim_along(box_of(p), direction, link));
}

Hit Intersector::nearest(const LatticePoint& p, const LatticeVector& direction) const {
  Nearest best;
  if (!features::kAims || !blockers_.built()) {
    any_triangle([&](std::uint32_t k) {
      best.offer(geometry_->triangles[k], k, p, direction);
      return false;
    });
    return best.hit;
  }
  blockers_.visit(Shaft::along(box_of(p), direction),
                  [&](std::uint32_t k) { offer(blockers_.facets()[k], p, direction, best); });
  return best.hit;
}

Hit Intersector::nearest(const LatticePoint& p, const LatticeVector& direction, const Aim& gathered) const {
  if (!features::kAims || gathered.any_triangle) return nearest(p, direction);
  Nearest best;
  for (const std::uint32_t k : gathered.facets) offer(blockers_.facets()[k], p, direction, best);
  best.hit.near = best.hit.triangle != kNone && best.distance <= best.speed >> kNearPart;
  return best.hit;
}

void Intersector::offer(const Facet& facet, const LatticePoint& p, const LatticeVector& direction,
                        Nearest& best) const {
  const LatticePoint end = p + direction;
  LatticeBox around = box_of(p);
  around.include(end);
  if (apart(around, facet.box)) return;
  if (facet.tilted == 0 && !passes_flat(facet, p, {end.x - p.x, end.y - p.y, end.z - p.z})) return;
  std::uint32_t t = facet.first;
  if (facet.rectangle != 0 && facet.count > 2) {  // one of its triangles, all in one plane
    while (geometry_->triangles[t].n == LatticeVector{}) ++t;
    return best.meet(geometry_->triangles[t], t, p, direction);
  }
  for (; t < facet.first + facet.count; ++t) {
    best.offer(geometry_->triangles[t], t, p, direction);
  }
}

}  // namespace shodo
