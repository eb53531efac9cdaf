#include "visibility/placement.h"

namespace shodo {

namespace {

/// Whether a cell is a parallelogram to one lattice step.
bool is_parallelogram(const Piece& cell, const Lattice& lattice) {
  const Vec3 gap = lattice.steps_per_unit * ((cell.corner[0] - cell.corner[1]) + (cell.corner[2] - cell.corner[3]));
  const double largest[3] = {magnitude(gap.x), magnitude(gap.y), magnitude(gap.z)};
  return largest[0] <= 1 && largest[1] <= 1 && largest[2] <= 1;
}

/// A bilinear cell that is no parallelogram is drawn patch by patch; one that is cut is affine on both halves already.
void count_drawn_patches(const Mesh& mesh, const Piece& cell, const Lattice& lattice, Polygon& polygon) {
  polygon.along[0] = polygon.along[1] = 0;
  if (cell.corners == 3 || cell.concave || cell.cut || is_parallelogram(cell, lattice)) return;
  const bool grid = mesh.kind == MeshKind::kGrid;
  // A grid's cell has its first edge along the mesh's v.
  polygon.along[grid ? 1 : 0] = mesh.nu / mesh.cells_u;
  polygon.along[grid ? 0 : 1] = mesh.nv / mesh.cells_v;
}

/// The site of a vertex; none while they are being made.
std::uint32_t site_of(const Placement& placement, std::size_t entry) {
  return placement.site_of.empty() ? kNone : placement.site_of[entry];
}

void fill_cell(const Scene& scene, const Placement& placement, std::uint32_t m, Polygon& polygon) {
  const Mesh& mesh = scene.meshes[m];
  const Piece cell = cell_piece(scene, mesh, polygon.cell);
  polygon.mesh = m;
  polygon.light = kNone;
  polygon.corners = cell.corners;
  polygon.cut_from_1 = cell.concave;
  polygon.blocks = true;
  count_drawn_patches(mesh, cell, placement.lattice, polygon);
  std::uint32_t local[4] = {0, 1, 2, cell.corners == 3 ? 2u : 3u};
  if (mesh.kind == MeshKind::kGrid) {
    const std::uint32_t columns = mesh.cells_u + 1;
    local[0] = (polygon.cell / mesh.cells_u) * columns + polygon.cell % mesh.cells_u;
    local[1] = local[0] + columns;
    local[2] = local[0] + columns + 1;
    local[3] = local[0] + 1;
  }
  for (std::uint32_t k = 0; k < 4; ++k) polygon.site[k] = site_of(placement, mesh.first_vertex + local[k]);
}

}  // namespace

bool PolygonWalk::next(Polygon& polygon) {
  while (mesh_ < scene_->meshes.size() && cell_ >= cell_count(scene_->meshes[mesh_])) {
    ++mesh_;
    cell_ = 0;
  }
  if (mesh_ < scene_->meshes.size()) {
    polygon.cell = cell_++;
    fill_cell(*scene_, *placement_, mesh_, polygon);
    polygon.first_extra = extra_;
    if (polygon.along[0] != 0) extra_ += 2 * (polygon.along[0] - 1) + 2 * (polygon.along[1] - 1);
    return true;
  }
  while (light_ < scene_->lights.size() && scene_->lights[light_].kind != LightKind::kArea) ++light_;
  if (light_ >= scene_->lights.size()) return false;
  polygon = {};
  polygon.light = light_;
  polygon.blocks = !scene_->lights[light_].open;
  const std::size_t first = scene_->vertices.size() + 4 * std::size_t{light_};
  for (std::uint32_t k = 0; k < 4; ++k) polygon.site[k] = site_of(*placement_, first + k);
  ++light_;
  return true;
}

std::uint32_t polygon_count(const Scene& scene) {
  std::uint32_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += cell_count(mesh);
  for (const Light& light : scene.lights) count += light.kind == LightKind::kArea ? 1 : 0;
  return count;
}

}  // namespace shodo
