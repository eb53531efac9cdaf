#include "ambient/exchange_row.h"

#include "ambient/form_factor.h"
#include "ambient/visible_fraction.h"

namespace shodo {

namespace {

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
  LatticeBox box = {};          // around i's cached samples
  std::uint32_t place = 0;      // of the mesh at work
  std::uint32_t aimed = kNone;  // the place at which `aim` was taken
  Aim aim = {};
};

/// Between patch i and the mesh at work, found when its first pair asks.
const Aim& mesh_aim(RowContext& row) {
  const Surfaces& surfaces = row.surfaces;
  if (row.aimed == row.place || surfaces.mesh_box.empty()) return row.aim;
  row.aimed = row.place;
  const Mesh& mesh = surfaces.scene->meshes[surfaces.mesh_at[row.place]];
  const Link link{surfaces.mesh(row.side.position).object, mesh.object, LightSet::kAmbient};
  row.aim = row.intersector.aim(row.box, surfaces.mesh_box[row.place], link);
  return row.aim;
}

void add_pair(RowContext& row, std::uint32_t j, RowWriter& writer) {
  const double root_j = row.surfaces.root_area[j];
  if (!(root_j > 0)) return;
  const PairExchange pair = exchange_between(row.surfaces, row.side, j, row.options.tiers);
  if (!(pair.geometric > 0)) return;
  if (row.errors != nullptr) ++row.errors->computed;
  const std::uint32_t i = row.side.position;
  const VisibleFraction visible =
      visible_fraction(row.surfaces, i, j, pair.crossing, row.options, row.intersector, mesh_aim(row), row.dense);
  if (row.errors != nullptr) {
    note_errors(pair, visible, row.root_area * row.root_area, root_j * root_j, i, j, *row.errors);
  }
  const double value = pair.geometric * visible.value / (row.root_area * root_j);
  if (value > 0) writer.add(j, value < 1 ? value : 1);
}

}  // namespace

void compute_row(const Surfaces& surfaces, const Sparsity& sparsity, LinkWalk& walk, std::uint32_t i,
                 std::uint8_t generation, const Options& options, Intersector& intersector, RowWriter& writer,
                 RowErrors* errors) {
  writer.start(i);
  if (!(surfaces.root_area[i] > 0)) return;
  NodeGeometry own;
  RowContext row{surfaces, options, intersector, errors, row_side(surfaces, i, own), surfaces.root_area[i], {}};
  const LatticePoint* const samples = surfaces.samples(i);
  for (std::uint32_t k = 0; k < surfaces.cached_points; ++k) row.box.include(samples[k]);
  walk.visit(row.side, [&](std::uint32_t j) {
    if (sparsity.generation(i, j) != generation) return;
    while (j >= surfaces.mesh_begin[row.place + 1]) ++row.place;  // nodes ascend
    add_pair(row, j, writer);
  });
}

}  // namespace shodo
