// Geometry of a scene: the lattice, and the triangles that block and that are drawn (design: exact visibility).
//
// What to mend is found in scratch, counted, and found again once the results have their exact size: twice the time,
// and not a byte of slack. Bytes left: 72 a blocking triangle, 56 a pane, 8 a polygon, 4 a mesh, 20 a light; and 68 a
// drawn one, in a spare block. If the light takes that, drawn triangles are found once more before the picture.
#include "visibility/drawn.h"
#include "visibility/geometry.h"
#include "visibility/mending.h"
#include "visibility/placement.h"
#include "visibility/ring.h"

namespace shodo {

namespace {

constexpr std::uint32_t kMostTriangles = (1u << 27) - 1;  // of a polygon

/// Where triangles go; with empty spans they are counted only.
struct Output {
  std::span<Triangle> triangles;
  std::span<DrawnTriangle> drawn;
  std::uint32_t triangle_count = 0;
  std::uint32_t drawn_count = 0;
  std::uint32_t pane_count = 0;
  std::uint32_t object = 0;  // of the polygon at work
  std::uint32_t mesh = kNone;
  std::uint32_t light = kNone;
};

bool has_area(const RingVertex& a, const RingVertex& b, const RingVertex& c) {
  return !(cross(b.point - a.point, c.point - a.point) == LatticeVector{});
}

void take_blocking(void* context, const RingVertex& a, const RingVertex& b, const RingVertex& c) {
  if (!has_area(a, b, c)) return;
  Output& output = *static_cast<Output*>(context);
  const std::uint32_t k = output.triangle_count++;
  if (k >= output.triangles.size()) return;
  Triangle& triangle = output.triangles[k];
  triangle.a = a.point;
  triangle.b = b.point;
  triangle.c = c.point;
  triangle.object = output.object;
  triangle.n = cross(b.point - a.point, c.point - a.point);
  triangle.d = triangle.n.x * a.point.x + triangle.n.y * a.point.y + triangle.n.z * a.point.z;
}

void take_drawn(void* context, const RingVertex& a, const RingVertex& b, const RingVertex& c) {
  if (!has_area(a, b, c)) return;
  Output& output = *static_cast<Output*>(context);
  const std::uint32_t k = output.drawn_count++;
  if (k >= output.drawn.size()) return;
  const RingVertex* corner[3] = {&a, &b, &c};
  DrawnTriangle& triangle = output.drawn[k];
  for (int i = 0; i < 3; ++i) {
    triangle.vertex[i] = corner[i]->point;
    triangle.u[i] = corner[i]->u;
    triangle.v[i] = corner[i]->v;
  }
  triangle.mesh = output.mesh;
  triangle.light = output.light;
}

Pane pane_of(const Scene& scene, const Geometry& geometry, const PolygonTriangles& range, std::uint32_t mesh) {
  Pane pane{{}, range.first, range.count, scene.optics_of(scene.meshes[mesh].material)->transmit};
  for (const Triangle& triangle : geometry.triangles.subspan(range.first, range.count)) {
    pane.box.include(triangle.a);
    pane.box.include(triangle.b);
    pane.box.include(triangle.c);
  }
  return pane;
}

/// Glass is drawn after everything else, where it is: it is not mended and mends nothing, so that light doesn't know
/// it.
void cut_glass(const Scene& scene, const Lattice& lattice, Output& output) {
  output.mesh = kNone;
  for (std::uint32_t g = 0; g < scene.glass.size(); ++g) {
    RingVertex corner[4];
    for (std::uint32_t k = 0; k < 4; ++k) corner[k].point = even_point(lattice, scene.glass[g].corners[k]);
    output.light = static_cast<std::uint32_t>(scene.lights.size()) + g;
    take_drawn(&output, corner[0], corner[1], corner[2]);
    take_drawn(&output, corner[0], corner[2], corner[3]);
  }
}

void cut_polygons(const Scene& scene, const Placement& placement, Output& output, Geometry* geometry) {
  PolygonWalk walk(scene, placement);
  Polygon polygon;
  std::uint32_t panes = 0;
  for (std::uint32_t p = 0; walk.next(polygon); ++p) {
    const std::uint32_t before = output.triangle_count;
    const bool is_light = polygon.light != kNone;
    output.object =
        is_light ? static_cast<std::uint32_t>(scene.objects.size()) + polygon.light : scene.meshes[polygon.mesh].object;
    output.mesh = polygon.mesh;
    output.light = polygon.light;
    if (polygon.blocks) {
      cut_ring(polygon_ring(scene, placement, p, polygon), placement.sites, false, {take_blocking, &output});
    }
    cut_drawn(scene, placement, p, polygon, {take_drawn, &output});
    if (geometry == nullptr) {
      const bool pane = !is_light && output.triangle_count > before &&
                        scene.transmits(scene.meshes[polygon.mesh].material);
      output.pane_count += pane ? 1 : 0;
      continue;
    }
    PolygonTriangles range;
    range.first = before;
    range.count = (output.triangle_count - before) & kMostTriangles;
    if (range.count > 0 && !is_light && scene.transmits(scene.meshes[polygon.mesh].material)) {
      geometry->panes[panes++] = pane_of(scene, *geometry, range, polygon.mesh);
    }
    if (is_light) {
      geometry->light_triangles[polygon.light] = range;
    } else {
      geometry->cells[geometry->first_cell[polygon.mesh] + polygon.cell] = range;
    }
  }
  cut_glass(scene, placement.lattice, output);
}

bool take_results(const Scene& scene, Arena& arena, const Output& counted, Geometry& geometry) {
  std::uint32_t cells = 0;
  for (const Mesh& mesh : scene.meshes) cells += cell_count(mesh);
  if (!arena.take("lights' points", scene.lights.size(), geometry.light_points)) return false;
  geometry.before_triangles = arena.mark();
  if (!arena.take("triangles", counted.triangle_count, geometry.triangles)) return false;
  if (!arena.take("panes", counted.pane_count, geometry.panes)) return false;
  if (!arena.take_spare("drawn triangles", counted.drawn_count, geometry.drawn)) return false;
  arena.pin_spares(arena.spares());
  geometry.drawn_count = counted.drawn_count;
  if (!arena.take("polygons' triangles", cells, geometry.cells)) return false;
  if (!arena.take("lights' triangles", scene.lights.size(), geometry.light_triangles)) return false;
  if (!arena.take("meshes' cells", scene.meshes.size(), geometry.first_cell)) return false;
  std::uint32_t first = 0;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    geometry.first_cell[m] = first;
    first += cell_count(scene.meshes[m]);
  }
  return true;
}

}  // namespace

Status place_scene(const Scene& scene, Arena& arena, Geometry& geometry) {
  geometry.lattice = lattice_for(scene.largest_half_extent());
  Output counted;
  {
    ArenaScratch scratch(arena);
    Placement placement;
    placement.lattice = geometry.lattice;
    if (!place(scene, arena, placement)) return arena.refused();
    cut_polygons(scene, placement, counted, nullptr);
  }
  if (!take_results(scene, arena, counted, geometry)) return arena.refused();
  ArenaScratch scratch(arena);
  Placement placement;
  placement.lattice = geometry.lattice;
  arena.start_stage();
  const std::size_t before = arena.in_use();
  PolygonTree tree;
  if (!place(scene, arena, placement, tree)) return arena.refused();
  geometry.placing_bytes = arena.stage_peak() - before;
  Output output;
  output.triangles = geometry.triangles;
  output.drawn = geometry.drawn;
  cut_polygons(scene, placement, output, &geometry);
  find_raises(scene, placement, tree, geometry);
  geometry.inserted = placement.inserted;
  geometry.moved = placement.moved;
  if (!place_point_lights(scene, arena, geometry)) return arena.refused();
  return {};
}

bool place_drawn(const Scene& scene, Arena& arena, Geometry& geometry) {
  if (!arena.take("drawn triangles", geometry.drawn_count, geometry.drawn)) return false;
  const ArenaScratch scratch(arena);
  Placement placement;
  placement.lattice = geometry.lattice;
  if (!place(scene, arena, placement)) return false;
  Output output;
  output.drawn = geometry.drawn;
  cut_polygons(scene, placement, output, nullptr);
  return true;
}

}  // namespace shodo
