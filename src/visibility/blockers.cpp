#include "visibility/blockers.h"

#include "visibility/sort.h"

namespace shodo {

namespace {

std::uint32_t facets_of(const PolygonTriangles& polygon) { return (polygon.count + 1) / 2; }

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

std::uint32_t Blockers::facet_count(const Geometry& geometry) {
  std::uint32_t count = 0;
  for (const PolygonTriangles& polygon : geometry.cells) count += geometry.is_pane(polygon) ? 0 : facets_of(polygon);
  for (const PolygonTriangles& polygon : geometry.light_triangles) count += facets_of(polygon);
  return count;
}

bool Blockers::build(const Geometry& geometry, Arena& arena) {
  const std::uint32_t count = facet_count(geometry);
  if (!arena.take("blockers", count, facets_)) return false;
  if (!arena.take("blockers' boxes", median_nodes(count), nodes_)) return false;
  std::uint32_t next = 0;
  for (const std::span<PolygonTriangles> polygons : {geometry.cells, geometry.light_triangles}) {
    for (const PolygonTriangles& polygon : polygons) {
      if (geometry.is_pane(polygon)) continue;
      for (std::uint32_t k = 0; k < polygon.count; k += 2) {
        Facet& facet = facets_[next++];
        facet.first = polygon.first + k;
        facet.count = k + 1 < polygon.count ? 2 : 1;
        bool tilted = false;
        facet.box = facet_box(geometry.triangles.subspan(facet.first, facet.count), tilted);
        facet.tilted = tilted ? 1 : 0;
        facet.rectangle = !tilted && fill_box(geometry.triangles.subspan(facet.first, facet.count), facet.box) ? 1 : 0;
        facet.blocks = 3;
      }
    }
  }
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
