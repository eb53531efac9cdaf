#include "ambient/sight.h"

#include "base/check.h"
#include "visibility/triangle_test.h"

namespace shodo {

namespace {

constexpr std::uint32_t kClusterFacets = 6;
constexpr std::int32_t kLarge = kLatticeHalf / 4;  // facets longer than that are clusters of their own
constexpr std::uint8_t kNoBlocker = 8;
constexpr std::uint32_t kShort = 8;  // a list so short isn't narrowed for parts

std::uint32_t facet_count(const Geometry& geometry) { return Blockers::facet_count(geometry); }

/// Whether a polygon square to an axis is the whole rectangle of its box.
bool fills_its_box(std::span<const Triangle> triangles, std::uint32_t axis) {
  LatticeBox box;
  std::int64_t doubled = 0, whole = 1;
  for (const Triangle& triangle : triangles) {
    for (const LatticePoint& corner : {triangle.a, triangle.b, triangle.c}) box.include(corner);
    const std::int64_t n = axis == 0 ? triangle.n.x : axis == 1 ? triangle.n.y : triangle.n.z;
    doubled += n < 0 ? -n : n;
  }
  if (box.low[axis] != box.high[axis]) return false;
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (k != axis) whole *= box.high[k] - box.low[k];
  }
  return doubled == 2 * whole;
}

/// The polygon that holds a triangle; both lists ascend.
PolygonTriangles polygon_of(const Geometry& geometry, std::uint32_t triangle) {
  PolygonTriangles found;
  for (const std::span<PolygonTriangles> polygons : {geometry.cells, geometry.light_triangles}) {
    std::size_t low = 0, high = polygons.size();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      const PolygonTriangles& polygon = polygons[middle];
      if (polygon.first + polygon.count <= triangle) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    if (low < polygons.size() && polygons[low].count > 0 && polygons[low].first <= triangle) found = polygons[low];
  }
  return found;
}

/// 0 tilted; axis + 1; + 4 if the facet belongs to a polygon that fills its box.
std::uint8_t kind_of(const Geometry& geometry, const Facet& facet) {
  if (facet.tilted != 0) return 0;
  const std::uint32_t axis = facet.box.low[0] > facet.box.high[0] ? 0 : facet.box.low[1] > facet.box.high[1] ? 1 : 2;
  const PolygonTriangles polygon = polygon_of(geometry, facet.first);
  const bool full = fills_its_box({geometry.triangles.data() + polygon.first, polygon.count}, axis);
  return static_cast<std::uint8_t>(axis + 1 + (full ? 4 : 0));
}

std::int32_t longest_side(const LatticeBox& box) {
  std::int32_t longest = 0;
  for (int k = 0; k < 3; ++k) {
    if (box.high[k] - box.low[k] > longest) longest = box.high[k] - box.low[k];
  }
  return longest;
}

/// Calls visit(box) for each facet of a scene, without any structure; stops at true.
template <class Visit>
bool any_facet(const Geometry& geometry, Visit visit) {
  for (const std::span<PolygonTriangles> polygons : {geometry.cells, geometry.light_triangles}) {
    for (const PolygonTriangles& polygon : polygons) {
      if (geometry.is_pane(polygon)) continue;
      for (std::uint32_t k = 0; k < polygon.count; k += 2) {
        bool tilted = false;
        const std::uint32_t count = k + 1 < polygon.count ? 2 : 1;
        if (visit(facet_box(geometry.triangles.subspan(polygon.first + k, count), tilted))) return true;
      }
    }
  }
  return false;
}

}  // namespace

LeanShaft::LeanShaft(const LatticeBox& a, const LatticeBox& b) : around_(a) {
  around_.include(b);
  LatticeBox from, to;
  for (int k = 0; k < 3; ++k) {
    from.low[k] = low_of(a.low[k]);
    from.high[k] = high_of(a.high[k]);
    to.low[k] = low_of(b.low[k]);
    to.high[k] = high_of(b.high[k]);
  }
  add_lines(from, to, 0, 1);
  add_lines(from, to, 1, 2);
  add_lines(from, to, 2, 0);
}

/// As Shaft::add_lines.
void LeanShaft::add_lines(const LatticeBox& a, const LatticeBox& b, std::uint32_t u, std::uint32_t v) {
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const bool high_u = (corner & 1) != 0, high_v = (corner & 2) != 0;
    const std::int32_t au = high_u ? a.high[u] : a.low[u], av = high_v ? a.high[v] : a.low[v];
    const std::int32_t du = (high_u ? b.high[u] : b.low[u]) - au, dv = (high_v ? b.high[v] : b.low[v]) - av;
    if (du == 0 || dv == 0) continue;  // a side of the common box
    const bool rising = (du > 0) == (dv > 0);
    if (rising == (high_u == high_v)) continue;
    Line& line = lines_[lines_used_++];
    line.normal_u = (dv > 0) == high_u ? dv : -dv;
    line.normal_v = (du > 0) == high_v ? du : -du;
    line.u = u;
    line.v = v;
    // A box's bounds are rounded down, and flat ones may be a lattice step too small.
    const std::int32_t slack = (dv < 0 ? -dv : dv) + (du < 0 ? -du : du);
    line.limit = line.normal_u * au + line.normal_v * av + 2 * slack;
  }
}

std::uint64_t Sight::bytes(const Geometry& geometry, const Options& options) {
  if (!features::aims(options.flags)) return 0;
  const std::uint32_t facets = facet_count(geometry);
  return 4 * std::uint64_t{kListWords} + (std::uint64_t{facets} + 7) / 8 * 8 + (2 * std::uint64_t{facets} + 7) / 8 * 8 +
         (sizeof(Cluster) * std::uint64_t{most_clusters(facets)} + 7) / 8 * 8;
}

Status Sight::take(Arena& arena, const Geometry& geometry, const Options& options) {
  geometry_ = &geometry;
  lists_ = false;
  if (!features::aims(options.flags)) return {};
  const std::uint32_t facets = facet_count(geometry);
  const bool taken = arena.take("blockers left to parts", kListWords, left_) &&
                     arena.take("blockers of a row", kListWords, row_) &&
                     arena.take("kinds of blockers", facets, kinds_) &&
                     arena.take("clusters of blockers", most_clusters(facets), clusters_) &&
                     arena.take("blockers of a link", facets, pair_);
  return taken ? Status{} : arena.refused();
}

void Sight::start(Intersector& intersector) {
  lists_ = intersector.seeking() && intersector.facets().size() <= 0xffff;
  facets_ = intersector.facets();
  clusters_used_ = 0;
  bool open = false;
  for (std::uint32_t f = 0; lists_ && f < facets_.size(); ++f) {
    const Facet& facet = facets_[f];
    const bool blocks = intersector.blocks(f, LightSet::kAmbient), alone = longest_side(facet.box) > kLarge;
    kinds_[f] = blocks ? kind_of(*geometry_, facet) : kNoBlocker;
    if (open && (!blocks || alone || f - clusters_[clusters_used_ - 1].first == kClusterFacets)) open = false;
    if (!blocks) continue;
    const std::uint16_t here = static_cast<std::uint16_t>(f);
    if (!open && clusters_used_ < clusters_.size()) clusters_[clusters_used_++] = {{}, here, here};
    open = !alone;
    Cluster& cluster = clusters_[clusters_used_ - 1];
    cluster.end = static_cast<std::uint16_t>(f + 1);
    cluster.box.include(facet.box);
  }
}

/// Of the list, or of all facets, those in the shaft.
std::uint32_t Sight::collect(const LeanShaft& shaft, std::uint16_t* to) const {
  std::uint32_t count = 0;
  if (list_ == nullptr) {
    for (const Cluster& cluster : clusters_.first(clusters_used_)) {
      if (shaft.misses(cluster.box)) continue;
      for (std::uint32_t f = cluster.first; f < cluster.end; ++f) {
        if (kinds_[f] != kNoBlocker && !shaft.misses(facets_[f].box)) to[count++] = static_cast<std::uint16_t>(f);
      }
    }
    return count;
  }
  for (std::uint32_t k = 0; k < listed_; ++k) {
    if (!shaft.misses(facets_[list_[k]].box)) to[count++] = list_[k];
  }
  return count;
}

void Sight::open(std::uint32_t node, std::uint32_t end, const LatticeBox& box) {
  box_ = box;
  parts_ = 0;
  while (levels_ > 0 && (node <= level_[levels_ - 1].node || node >= level_[levels_ - 1].end)) --levels_;
  above_ = levels_;
  for (std::uint32_t k = 0; k < levels_; ++k) level_[k].read = level_[k].first;
  if (end == node + 1) return;
  SHODO_CHECK(levels_ < kDeepest);
  const std::uint32_t first = levels_ > 0 ? level_[levels_ - 1].last : 0;
  level_[levels_++] = {node, end, first, first, first};
}

/// The list that the blocks above have for j or for a node that holds it, the nearest first; null if there is none.
const std::uint16_t* Sight::inherited(std::uint32_t j, std::uint32_t& count) {
  for (std::uint32_t k = above_; k-- > 0;) {
    Level& level = level_[k];
    const auto node_at = [&](std::uint32_t at) { return left_[at] | std::uint32_t{left_[at + 1]} << 16; };
    // Lists ascend by the nodes whose they are.
    for (std::uint32_t at = level.read; at < level.last && node_at(at) <= j; at += 4u + left_[at + 3]) level.read = at;
    if (level.read == level.last) continue;
    const std::uint32_t first = node_at(level.read);
    if (first > j || j >= first + left_[level.read + 2]) continue;
    count = left_[level.read + 3];
    return left_.data() + level.read + 4;
  }
  return nullptr;
}

void Sight::turn_to(std::uint32_t j, const Link& link, const Intersector& intersector) {
  if (!lists_) return;
  while (parts_ > 0 && j >= part_[parts_ - 1].end) --parts_;
  listed_ = 0;
  if (!intersector.tested(link)) {
    list_ = row_.data();
  } else if (parts_ > 0) {
    list_ = row_.data() + part_[parts_ - 1].first;
    listed_ = part_[parts_ - 1].count;
  } else {
    list_ = inherited(j, listed_);
    if (list_ == nullptr) listed_ = static_cast<std::uint32_t>(facets_.size());
  }
}

void Sight::split(std::uint32_t j, std::uint32_t end_j, const LatticeBox& box_j, bool leave) {
  if (!lists_) return;
  const std::uint32_t nodes = end_j - j;
  if (leave) {
    Level& level = level_[above_];
    if ((list_ != nullptr && listed_ <= kShort) || level.last + 4 + listed_ > kListWords || nodes > 0xffff) return;
    std::uint16_t* to = left_.data() + level.last;
    to[0] = static_cast<std::uint16_t>(j);
    to[1] = static_cast<std::uint16_t>(j >> 16);
    to[2] = static_cast<std::uint16_t>(nodes);
    to[3] = static_cast<std::uint16_t>(collect(LeanShaft(box_, box_j), to + 4));
    if (list_ == nullptr || 4u * to[3] <= 3 * listed_) level.last += 4u + to[3];  // else parts do as well with this one
    return;
  }
  const std::uint32_t first = parts_ > 0 ? part_[parts_ - 1].first + part_[parts_ - 1].count : 0;
  if (listed_ <= kShort || first + listed_ > kListWords || parts_ == kDeepest) return;
  const std::uint32_t count = collect(LeanShaft(box_, box_j), row_.data() + first);
  if (list_ == nullptr || 4 * count <= 3 * listed_) part_[parts_++] = {end_j, first, count};
}

bool Sight::clear(const LatticeBox& a, const LatticeBox& b) {
  if (!lists_) {
    const LeanShaft shaft(a, b);
    return !any_facet(*geometry_, [&](const LatticeBox& facet) { return !shaft.misses(facet); });
  }
  paired_ = listed_ == 0 ? 0 : collect(LeanShaft(a, b), pair_.data());
  return paired_ == 0;
}

/// Ends are on opposite sides of a flat facet's plane.
bool Sight::hits(std::uint32_t f, const LatticePoint& p, const LatticePoint& q) const {
  const Facet& facet = facets_[f];
  const std::uint32_t kind = kinds_[f];
  if (kind != 0) {
    const std::uint32_t axis = (kind & 3) - 1, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    const std::int32_t from[3] = {p.x, p.y, p.z}, to[3] = {q.x, q.y, q.z};
    const std::int32_t whole = to[axis] - from[axis], part = facet.box.low[axis] - 1 - from[axis];
    for (const std::uint32_t k : {u, v}) {
      const std::int64_t run = std::int64_t{part} * (to[k] - from[k]);
      const std::int64_t low = std::int64_t{facet.box.low[k] - from[k]} * whole;
      const std::int64_t high = std::int64_t{facet.box.high[k] - from[k]} * whole;
      if (whole > 0 ? run < low || run > high : run > low || run < high) return false;
    }
    if ((kind & 4) != 0) return true;
  }
  for (std::uint32_t k = 0; k < facet.count; ++k) {
    if (blocks_segment(geometry_->triangles[facet.first + k], p, q)) return true;
  }
  return false;
}

bool Sight::blocked(const LatticePoint& p, const LatticePoint& q, const Link& link, Intersector& intersector) {
  if (!lists_) return intersector.blocked(p, q, link, Aim{});
  LatticeBox around;
  around.include(p);
  around.include(q);
  std::uint32_t tests = 0, found = kNone;
  for (std::uint32_t k = 0; k < paired_ && found == kNone; ++k) {
    const std::uint16_t f = pair_[k];
    tests += facets_[f].count;
    if (apart(around, facets_[f].box) || !hits(f, p, q)) continue;
    found = f;
    pair_[k] = pair_[0];
    pair_[0] = f;
  }
  intersector.count(link, tests, found == kNone ? kNone : geometry_->triangles[facets_[found].first].object);
  return found != kNone;
}

}  // namespace shodo
