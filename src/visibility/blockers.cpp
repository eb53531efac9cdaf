#include "visibility/blockers.h"

#include "base/sort.h"

namespace shodo {

namespace {

std::uint32_t facets_of(const PolygonTriangles& polygon) { return (polygon.count + 1) / 2; }

bool is_parallelogram(std::span<const Triangle> triangles) {
  if (triangles.size() != 2) return false;
  const Triangle &first = triangles[0], &second = triangles[1];
  return first.a == second.c && first.c == second.a && first.b - first.a == first.c - second.b;
}

/// Where a point is: both, if in the plane.
struct Sides {
  bool front = false, behind = false;

  void add(std::int64_t side) {
    front = front || side > 0;
    behind = behind || side < 0;
  }
  bool both() const { return front && behind; }
};

}  // namespace

LatticeBox facet_box(std::span<const Triangle> triangles, bool& tilted) {
  LatticeBox box;
  for (const Triangle& triangle : triangles) {
    box.include(triangle.a);
    box.include(triangle.b);
    box.include(triangle.c);
  }
  tilted = true;
  for (int k = 0; k < 3; ++k) {
    if (box.low[k] != box.high[k]) continue;
    ++box.low[k];
    --box.high[k];
    tilted = false;
  }
  return box;
}

bool fill_box(std::span<const Triangle> triangles, const LatticeBox& box) {
  if (triangles.size() != 2) return false;
  const int axis = box.low[0] > box.high[0] ? 0 : box.low[1] > box.high[1] ? 1 : 2;
  const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  std::uint32_t corners[2] = {0, 0};  // bit 0 .. 3: low or high along u and v
  for (std::uint32_t k = 0; k < 2; ++k) {
    for (const LatticePoint* corner : {&triangles[k].a, &triangles[k].b, &triangles[k].c}) {
      const std::int32_t at[3] = {corner->x, corner->y, corner->z};
      const bool low_u = at[u] == box.low[u], low_v = at[v] == box.low[v];
      if (!(low_u || at[u] == box.high[u]) || !(low_v || at[v] == box.high[v])) return false;
      corners[k] |= std::uint32_t{1} << ((low_u ? 0 : 1) + (low_v ? 0 : 2));
    }
  }
  // Two opposite corners are left out, and neither triangle leaves out both.
  const std::uint32_t first = ~corners[0] & 15, second = ~corners[1] & 15, both = first | second;
  return (both == 6 || both == 9) && first != both && second != both;
}

bool cover_box(std::span<const Triangle> polygon, const LatticeBox& box) {
  const int axis = box.low[0] > box.high[0] ? 0 : box.low[1] > box.high[1] ? 1 : 2;
  const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  std::int64_t area = 0;  // twice, both
  bool up = false, down = false;
  for (const Triangle& triangle : polygon) {
    const std::int64_t n = triangle.n.x + triangle.n.y + triangle.n.z;  // two are zero
    up = up || n > 0;
    down = down || n < 0;
    area += n < 0 ? -n : n;
  }
  return !(up && down) && area == 2 * product(box.high[u] - box.low[u], box.high[v] - box.low[v]);
}

std::uint32_t Blockers::facet_count(const Geometry& geometry) {
  std::uint32_t count = 0;
  for (const PolygonTriangles& polygon : geometry.cells) count += geometry.is_pane(polygon) ? 0 : facets_of(polygon);
  for (const PolygonTriangles& polygon : geometry.light_triangles) count += facets_of(polygon);
  return count;
}

std::uint32_t Blockers::add_facets(const Geometry& geometry, const PolygonTriangles& polygon, Rectangles rectangles,
                                   std::uint32_t next) {
  const std::span<const Triangle> all = geometry.triangles.subspan(polygon.first, polygon.count);
  const auto add = [&](std::uint32_t first, std::uint32_t count) {
    Facet& facet = facets_[next];
    const std::span<const Triangle> triangles = all.subspan(first, count);
    facet.first = polygon.first + first;
    facet.count = static_cast<std::uint8_t>(count);
    bool tilted = false;
    facet.box = facet_box(triangles, tilted);
    facet.tilted = !tilted ? 0 : is_parallelogram(triangles) ? 2 : 1;
    facet.rectangle = !tilted && (count > 2 ? cover_box : fill_box)(triangles, facet.box) ? 1 : 0;
    facet.blocks = 3;
    return facet.rectangle != 0;
  };
  if (rectangles == Rectangles::kWhole && polygon.count > 2 && polygon.count <= UINT8_MAX && add(0, polygon.count)) {
    return next + 1;
  }
  for (std::uint32_t k = 0; k < polygon.count; k += 2, ++next) add(k, k + 1 < polygon.count ? 2 : 1);
  return next;
}

bool Blockers::build(const Geometry& geometry, Arena& arena, Rectangles rectangles) {
  const std::uint32_t most = facet_count(geometry);
  if (!arena.take("blockers", most, facets_)) return false;
  if (!arena.take("blockers' boxes", median_nodes(most), nodes_)) return false;
  std::uint32_t count = 0;
  for (const std::span<PolygonTriangles> polygons : {geometry.cells, geometry.light_triangles}) {
    for (const PolygonTriangles& polygon : polygons) {
      if (!geometry.is_pane(polygon)) count = add_facets(geometry, polygon, rectangles, count);
    }
  }
  facets_ = facets_.first(count);
  nodes_ = nodes_.first(median_nodes(count));
  fill_median_boxes(nodes_, facets_.size(), [this](const ItemRange& range, std::uint32_t) { split(range); },
                    [this](std::uint32_t k) { return facets_[k].box; });
  return true;
}

std::uint64_t Blockers::bytes(const Geometry& geometry) {
  const std::uint64_t facets = facet_count(geometry);
  return sizeof(Facet) * facets + sizeof(LatticeBox) * median_nodes(facets);
}

/// Sorts a node's facets along the axis on which their centres are widest apart.
void Blockers::split(const ItemRange& range) {
  const std::span<Facet> facets = facets_.subspan(range.first, range.end - range.first);
  LatticeBox centres;  // times 2
  for (const Facet& facet : facets) {
    const LatticeBox& box = facet.box;
    centres.include(LatticePoint{box.low[0] + box.high[0], box.low[1] + box.high[1], box.low[2] + box.high[2]});
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (centres.high[k] - centres.low[k] > centres.high[axis] - centres.low[axis]) axis = k;
  }
  heap_sort(facets, [axis](const Facet& a, const Facet& b) {
    const std::int32_t at_a = a.box.low[axis] + a.box.high[axis], at_b = b.box.low[axis] + b.box.high[axis];
    return at_a == at_b ? a.first < b.first : at_a < at_b;
  });
}

namespace {

struct Range {
  std::int32_t least, most;
};

/// Whether x db + y da >= 0 for all distances da and db, above 0.
bool never_below(std::int32_t x, std::int32_t y, const Range& da, const Range& db) {
  return product(x, x < 0 ? db.most : db.least) + product(y, y < 0 ? da.most : da.least) >= 0;
}

}  // namespace

/// A segment from P, da before the plane, to Q, db behind it, passes it at (P db + Q da) / (da + db).
bool hides_all(const LatticeBox& rectangle, const LatticeBox& a, const LatticeBox& b) {
  const int axis = rectangle.low[0] > rectangle.high[0] ? 0 : rectangle.low[1] > rectangle.high[1] ? 1 : 2;
  const std::int32_t plane = rectangle.low[axis] - 1;
  const bool up = b.low[axis] > plane;
  if (up ? a.high[axis] >= plane : a.low[axis] <= plane || b.high[axis] >= plane) return false;
  const auto distance = [&](const LatticeBox& box) {
    const bool above = box.low[axis] > plane;
    return above ? Range{box.low[axis] - plane, box.high[axis] - plane}
                 : Range{plane - box.high[axis], plane - box.low[axis]};
  };
  const Range da = distance(a), db = distance(b);
  for (int u = 0; u < 3; ++u) {
    if (u == axis) continue;
    if (!never_below(a.low[u] - rectangle.low[u], b.low[u] - rectangle.low[u], da, db) ||
        !never_below(rectangle.high[u] - a.high[u], rectangle.high[u] - b.high[u], da, db)) {
      return false;
    }
  }
  return true;
}

bool misses_side(std::span<const Triangle> triangles, std::span<const LatticePoint> a,
                 std::span<const LatticePoint> b) {
  for (const Triangle& triangle : triangles) {
    Sides sides;
    for (const std::span<const LatticePoint> points : {a, b}) {
      for (const LatticePoint& point : points) {
        sides.add(triangle.side(point));
        if (sides.both()) return false;
      }
    }
  }
  return true;
}

}  // namespace shodo
