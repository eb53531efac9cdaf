#include "ambient/sight.h"

#include "ambient/lean_shaft.h"
#include "visibility/triangle_test.h"

namespace shodo {

namespace {

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

LatticeBox box_of(const LatticePoint& p) { return {{p.x, p.y, p.z}, {p.x, p.y, p.z}}; }

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

std::uint64_t Sight::bytes(const Geometry& geometry, const Options& options) {
  if (!features::aims(options.flags)) return 0;
  const std::uint32_t facets = facet_count(geometry);
  return (std::uint64_t{facets} + 7) / 8 * 8 + (2 * std::uint64_t{facets} + 7) / 8 * 8 +
         (sizeof(LeanBox) * std::uint64_t{facets} + 7) / 8 * 8 + FacetMasks::bytes(facets) +
         (2 * std::uint64_t{geometry.first_cell.size()} + 7) / 8 * 8;
}

Status Sight::take(Arena& arena, const Geometry& geometry, const Options& options) {
  geometry_ = &geometry;
  lists_ = false;
  if (!features::aims(options.flags)) return {};
  const std::uint32_t facets = facet_count(geometry);
  const std::size_t meshes = geometry.first_cell.size();
  const bool taken = arena.take("kinds of blockers", facets, kinds_) && masks_.take(arena, facets) &&
                     arena.take("boxes of blockers, rounded", facets, lean_) &&
                     arena.take("blockers of a link", facets, pair_) &&
                     arena.take("last blockers of meshes", meshes, last_);
  return taken ? Status{} : arena.refused();
}

void Sight::start(Intersector& intersector) {
  lists_ = intersector.seeking() && intersector.facets().size() <= 0xffff;
  facets_ = intersector.facets();
  for (std::uint16_t& facet : recent_) facet = 0xffff;
  for (std::uint16_t& facet : last_) facet = 0xffff;
  guess_ = kNone;
  between_ = 0xffff;
  if (!lists_) return;
  LatticeBox around;
  for (const Facet& facet : facets_) around.include(facet.box);
  masks_.start(static_cast<std::uint32_t>(facets_.size()), around);
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    if (!intersector.blocks(f, LightSet::kAmbient)) continue;
    kinds_[f] = kind_of(*geometry_, facets_[f]);
    masks_.add(f, facets_[f].box);
    lean_[f] = lean_box(facets_[f].box);
  }
}

/// What stood between two nodes of late is tried first.
bool Sight::clear(const LatticeBox& a, const LatticeBox& b) {
  if (!tested_) return true;
  LeanShaft shaft(a, b);
  if (!lists_) return !any_facet(*geometry_, [&](const LatticeBox& facet) { return !shaft.misses(facet); });
  const auto stands = [&](std::uint32_t f) { return !shaft.misses(facets_[f].box); };
  if (between_ < facets_.size() && stands(between_)) return false;
  for (const std::uint32_t f : recent_) {
    if (f < facets_.size() && stands(f)) return false;
  }
  return !masks_.visit(a, b, [&](std::uint32_t f) {
    if (!stands(f)) return false;
    between_ = static_cast<std::uint16_t>(f);
    return true;
  });
}

bool Sight::list(const LatticeBox& a, const LatticeBox& b) {
  if (!lists_) return clear(a, b);
  guess_ = kNone;
  paired_ = 0;
  if (!tested_) return true;
  LeanShaft shaft(a, b);
  masks_.visit(a, b, [&](std::uint32_t f) {
    if (!shaft.misses(facets_[f].box)) pair_[paired_++] = static_cast<std::uint16_t>(f);
    return false;
  });
  return paired_ == 0;
}

bool Sight::list_unless_blocked(const LatticePoint& p, const LatticePoint& q, const LatticeBox& a,
                                const LatticeBox& b) {
  if (!lists_ || !tested_) return list(a, b);
  std::uint32_t tests = 0;
  guess_ = recent_blocker(LeanSegment(p, q), p, q, tests);
  if (guess_ == kNone) return list(a, b);
  from_ = a;
  to_ = b;
  return false;
}

bool Sight::hits(std::uint32_t f, const LatticePoint& p, const LatticePoint& q) const {
  const Facet& facet = facets_[f];
  const std::uint32_t kind = kinds_[f];
  if (kind != 0) {
    const std::uint32_t axis = (kind & 3) - 1, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    const std::int32_t from[3] = {p.x, p.y, p.z}, to[3] = {q.x, q.y, q.z};
    const std::int32_t whole = to[axis] - from[axis], part = facet.box.low[axis] - 1 - from[axis];
    // The ends must be on opposite sides of its plane.
    if (whole > 0 ? part <= 0 || part >= whole : part >= 0 || part <= whole) return false;
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

std::uint32_t Sight::object_of(std::uint32_t facet) const {
  return facet == kNone ? kNone : geometry_->triangles[facets_[facet].first].object;
}

/// One of the last blockers that blocks the segment, or kNone.
std::uint32_t Sight::recent_blocker(const LeanSegment& segment, const LatticePoint& p, const LatticePoint& q,
                                    std::uint32_t& tests) const {
  const std::uint32_t last = last_[place_];
  if (last < facets_.size() && segment.may_meet(lean_[last])) {
    tests += facets_[last].count;
    if (hits(last, p, q)) return last;
  }
  for (const std::uint32_t f : recent_) {
    if (f >= facets_.size() || f == last || !segment.may_meet(lean_[f])) continue;
    tests += facets_[f].count;
    if (hits(f, p, q)) return f;
  }
  return kNone;
}

void Sight::remember(std::uint32_t facet) {
  last_[place_] = static_cast<std::uint16_t>(facet);
  std::uint32_t k = 0;
  while (k + 1 < kRecent && recent_[k] != facet) ++k;
  for (; k > 0; --k) recent_[k] = recent_[k - 1];
  recent_[0] = static_cast<std::uint16_t>(facet);
}

bool Sight::blocked_alone(const LatticePoint& p, const LatticePoint& q, const Link& link, Intersector& intersector) {
  if (!lists_) return intersector.blocked(p, q, link, Aim{});
  std::uint32_t tests = 0, found = kNone;
  if (tested_) {
    const LeanSegment segment(p, q);
    found = recent_blocker(segment, p, q, tests);
    if (found == kNone) {
      masks_.visit(box_of(p), box_of(q), [&](std::uint32_t f) {
        if (!segment.may_meet(lean_[f])) return false;
        tests += facets_[f].count;
        if (!hits(f, p, q)) return false;
        found = f;
        return true;
      });
    }
  }
  intersector.count(link, tests, object_of(found));
  if (found != kNone) remember(found);
  return found != kNone;
}

bool Sight::blocked(const LatticePoint& p, const LatticePoint& q, const Link& link, Intersector& intersector) {
  if (!lists_) return intersector.blocked(p, q, link, Aim{});
  const LeanSegment segment(p, q);
  std::uint32_t tests = 0, found = kNone;
  const auto blocks = [&](std::uint32_t f) {
    if (!segment.may_meet(lean_[f])) return false;
    tests += facets_[f].count;
    return hits(f, p, q);
  };
  if (guess_ != kNone) {
    if (blocks(guess_)) {
      found = guess_;
    } else {
      list(from_, to_);
    }
  }
  for (std::uint32_t k = 0; found == kNone && k < paired_; ++k) {
    const std::uint16_t f = pair_[k];
    if (!blocks(f)) continue;
    found = f;
    pair_[k] = pair_[0];
    pair_[0] = f;
  }
  intersector.count(link, tests, object_of(found));
  if (found != kNone) remember(found);
  return found != kNone;
}

}  // namespace shodo
