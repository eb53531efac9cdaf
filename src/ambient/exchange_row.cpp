#include "ambient/exchange_row.h"

#include "ambient/form_factor.h"
#include "ambient/visible_fraction.h"

namespace shodo {

namespace {

/// True if nothing of mesh_at[k] can see patch i; decided by the mesh's corners, which hold all its patches.
bool out_of_sight(const Surfaces& surfaces, const RowSide& i, std::uint32_t k) {
  const Mesh& mesh = surfaces.scene->meshes[surfaces.mesh_at[k]];
  if (mesh.kind == MeshKind::kGrid) return false;
  const Vec3* vertex = &surfaces.scene->vertices[mesh.first_vertex];
  const std::uint32_t vertices = mesh.kind == MeshKind::kTriangle ? 3 : 4;
  bool all_behind = true;
  for (std::uint32_t v = 0; v < vertices && all_behind; ++v) {
    all_behind = dot(i.patch->normal, vertex[v] - i.patch->centre) <= surfaces.flat;
  }
  if (all_behind) return true;
  if (surfaces.planar[k] == 0) return false;
  const Vec3& normal = surfaces.patches[mesh.first_patch].normal;
  const double height = dot(normal, i.patch->centre - vertex[0]);
  return height + extent_along(*i.shape, i.patch->longest_side, normal).high <= surfaces.flat;
}

/// The errors of F_ij and F_ji that come with a pair.
void note_errors(const PairExchange& pair, const VisibleFraction& visible, double area_i, double area_j,
                 std::uint32_t i, std::uint32_t j, RowErrors& errors) {
  const double geometry = pair.error * visible.value;
  errors.geometry[i] += geometry / area_i;
  errors.geometry[j] += geometry / area_j;
  if (!(visible.variance > 0)) return;
  const double squared = pair.geometric * pair.geometric * visible.variance;
  errors.visibility[i] += squared / (area_i * area_i);
  errors.visibility[j] += squared / (area_j * area_j);
}

struct RowContext {
  const Surfaces& surfaces;
  const Options& options;
  Intersector& intersector;
  RowErrors* errors;
  RowSide side;
  double root_area;
  DenseSamples dense;
};

void add_pair(RowContext& row, std::uint32_t j, RowWriter& writer) {
  const double root_j = row.surfaces.root_area[j];
  if (!(root_j > 0)) return;
  const PairExchange pair = exchange_between(row.surfaces, row.side, j, row.options.tiers);
  if (!(pair.geometric > 0)) return;
  if (row.errors != nullptr) ++row.errors->computed;
  const std::uint32_t i = row.side.position;
  const VisibleFraction visible =
      visible_fraction(row.surfaces, i, j, pair.crossing, row.options, row.intersector, row.dense);
  if (row.errors != nullptr) {
    note_errors(pair, visible, row.root_area * row.root_area, root_j * root_j, i, j, *row.errors);
  }
  const double value = pair.geometric * visible.value / (row.root_area * root_j);
  if (value > 0) writer.add(j, value < 1 ? value : 1);
}

/// The mesh, by its place in the order, that holds a position.
std::uint32_t mesh_of(const Surfaces& surfaces, std::uint32_t position) {
  std::uint32_t low = 0, high = static_cast<std::uint32_t>(surfaces.mesh_at.size());
  while (high - low > 1) {
    const std::uint32_t middle = (low + high) / 2;
    (surfaces.mesh_begin[middle] <= position ? low : high) = middle;
  }
  return low;
}

}  // namespace

void compute_row(const Surfaces& surfaces, std::uint32_t i, const Options& options, Intersector& intersector,
                 RowWriter& writer, RowErrors* errors) {
  writer.start(i);
  if (!(surfaces.root_area[i] > 0)) return;
  RowContext row{surfaces, options, intersector, errors, row_side(surfaces, i), surfaces.root_area[i], {}};
  const std::uint32_t own = mesh_of(surfaces, i);
  for (std::uint32_t k = own; k < surfaces.mesh_at.size(); ++k) {
    if (k == own ? surfaces.planar[k] != 0 : out_of_sight(surfaces, row.side, k)) continue;
    const std::uint32_t first = k == own ? i + 1 : surfaces.mesh_begin[k];
    for (std::uint32_t j = first; j < surfaces.mesh_begin[k + 1]; ++j) add_pair(row, j, writer);
  }
}

}  // namespace shodo
