// Triangles of the picture and their map coordinates (paper 2.3, 2.4; design: pictures).
//
// A parallelogram's map is affine, so its own triangles do. Any other bilinear cell is drawn patch by patch, two
// triangles each, corners rounded to even lattice points. Patch corners on the cell's border are sites of their own,
// inserted in the lattice edges of this cell and its neighbours like any T-junction, so that no crack opens there.
#include "visibility/drawn.h"

namespace shodo {

namespace {

/// Map coordinates of patch corner (i, j) of a cell, counted along the cell's first and fourth edge.
void set_map(const Mesh& mesh, std::uint32_t cell, std::uint32_t i, std::uint32_t j, RingVertex& vertex) {
  std::uint32_t u = i, v = j;
  if (mesh.kind == MeshKind::kGrid) {
    u = (cell % mesh.cells_u) * (mesh.nu / mesh.cells_u) + j;
    v = (cell / mesh.cells_u) * (mesh.nv / mesh.cells_v) + i;
  }
  vertex.u = static_cast<std::int32_t>(u * mesh.su * 256);
  vertex.v = static_cast<std::int32_t>(v * mesh.sv * 256);
}

/// Patches along a cell's first and second edge.
void patches_along(const Mesh& mesh, std::uint32_t (&along)[2]) {
  const std::uint32_t u = mesh.nu / mesh.cells_u, v = mesh.nv / mesh.cells_v;
  along[0] = mesh.kind == MeshKind::kGrid ? v : u;
  along[1] = mesh.kind == MeshKind::kGrid ? u : v;
}

/// Sites inserted in an edge of polygon p.
std::span<const Insertion> inserted_in(const Placement& placement, std::uint32_t p, std::uint32_t edge) {
  std::uint32_t first = placement.first_insertion[p], end = placement.first_insertion[p + 1];
  while (first < end && placement.insertions[first].edge < edge) ++first;
  while (first < end && placement.insertions[end - 1].edge > edge) --end;
  return placement.insertions.subspan(first, end - first);
}

/// A polygon drawn patch by patch.
struct PatchedCell {
  const Scene& scene;
  const Placement& placement;
  const Polygon& polygon;
  std::uint32_t p;
  Piece cell;

  /// Site of the point between pieces k - 1 and k of an edge.
  std::uint32_t edge_site(std::uint32_t edge, std::uint32_t k) const {
    const std::uint32_t count = polygon.along[edge % 2];
    if (k == 0) return polygon.site[edge];
    if (k == count) return polygon.site[(edge + 1) % 4];
    std::uint32_t entry = polygon.first_extra + k - 1;
    for (std::uint32_t e = 0; e < edge; ++e) entry += polygon.along[e % 2] - 1;
    return placement.site_of[entry];
  }

  LatticePoint corner(std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t n = polygon.along[0], m = polygon.along[1];
    const auto site = [&](std::uint32_t edge, std::uint32_t k) { return placement.sites[edge_site(edge, k)]; };
    if (j == 0) return site(0, i);
    if (i == n) return site(1, j);
    if (j == m) return site(2, n - i);
    if (i == 0) return site(3, m - j);
    const double s = static_cast<double>(i) / static_cast<double>(n),
                 t = static_cast<double>(j) / static_cast<double>(m);
    return even_point(placement.lattice, cell.point(s, t));
  }

  RingVertex vertex(std::uint32_t i, std::uint32_t j) const {
    RingVertex result;
    result.point = corner(i, j);
    set_map(scene.meshes[polygon.mesh], polygon.cell, i, j, result);
    return result;
  }

  /// What is inserted in piece k of an edge. Patch corners stand in the chain themselves, unless they fell on one of
  /// the edge's ends: then what is left of the chain comes before the end, and nothing after the start.
  std::span<const Insertion> inserted(std::uint32_t edge, std::uint32_t k) const {
    const std::span<const Insertion> chain = inserted_in(placement, p, edge);
    const std::uint32_t end = edge_site(edge, polygon.along[edge % 2]);
    std::size_t first = 0, last = 0, next = 0;
    for (std::uint32_t piece = 0; piece <= k; ++piece) {
      const std::uint32_t site = edge_site(edge, piece + 1);
      first = next;
      last = first;
      while (last < chain.size() && chain[last].site != site) ++last;
      next = last < chain.size() ? last + 1 : last;
      if (last == chain.size() && site != end) last = next = first;
    }
    return chain.subspan(first, last - first);
  }
};

}  // namespace

Ring polygon_ring(const Scene& scene, const Placement& placement, std::uint32_t p, const Polygon& polygon) {
  Ring ring;
  ring.edges = polygon.corners;
  ring.cut_from_1 = polygon.cut_from_1;
  RingVertex vertex[4];
  for (std::uint32_t k = 0; k < polygon.corners; ++k) {
    vertex[k].point = placement.sites[polygon.site[k]];
    if (polygon.mesh == kNone) continue;
    const Mesh& mesh = scene.meshes[polygon.mesh];
    std::uint32_t along[2];
    patches_along(mesh, along);
    if (polygon.corners == 3) {
      set_map(mesh, 0, k == 1 ? along[0] : 0, k == 2 ? along[1] : 0, vertex[k]);
    } else {
      set_map(mesh, polygon.cell, k == 1 || k == 2 ? along[0] : 0, k >= 2 ? along[1] : 0, vertex[k]);
    }
  }
  for (std::uint32_t k = 0; k < polygon.corners; ++k) {
    ring.edge[k].from = vertex[k];
    ring.edge[k].to = vertex[(k + 1) % polygon.corners];
    ring.edge[k].inserted = inserted_in(placement, p, k);
  }
  return ring;
}

Vec3 edge_point(const Scene& scene, const Polygon& polygon, std::uint32_t edge, std::uint32_t k) {
  const Piece cell = cell_piece(scene, scene.meshes[polygon.mesh], polygon.cell);
  const double f = static_cast<double>(k) / static_cast<double>(polygon.along[edge % 2]);
  if (edge == 0) return cell.point(f, 0);
  if (edge == 1) return cell.point(1, f);
  if (edge == 2) return cell.point(1 - f, 1);
  return cell.point(0, 1 - f);
}

void cut_drawn(const Scene& scene, const Placement& placement, std::uint32_t p, const Polygon& polygon,
               const TriangleSink& sink) {
  if (polygon.along[0] == 0) {
    return cut_ring(polygon_ring(scene, placement, p, polygon), placement.sites, true, sink);
  }
  const PatchedCell patched{scene, placement, polygon, p, cell_piece(scene, scene.meshes[polygon.mesh], polygon.cell)};
  const std::uint32_t n = polygon.along[0], m = polygon.along[1];
  for (std::uint32_t j = 0; j < m; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      Ring ring;
      const RingVertex corner[4] = {patched.vertex(i, j), patched.vertex(i + 1, j), patched.vertex(i + 1, j + 1),
                                    patched.vertex(i, j + 1)};
      for (std::uint32_t k = 0; k < 4; ++k) {
        ring.edge[k].from = corner[k];
        ring.edge[k].to = corner[(k + 1) % 4];
      }
      if (j == 0) ring.edge[0].inserted = patched.inserted(0, i);
      if (i + 1 == n) ring.edge[1].inserted = patched.inserted(1, j);
      if (j + 1 == m) ring.edge[2].inserted = patched.inserted(2, n - 1 - i);
      if (i == 0) ring.edge[3].inserted = patched.inserted(3, m - 1 - j);
      cut_ring(ring, placement.sites, true, sink);
    }
  }
}

}  // namespace shodo
