#include "ambient/exchange_row.h"

#include "ambient/form_factor.h"
#include "ambient/visible_fraction.h"

namespace shodo {

namespace {

/// The errors of F_ij and F_ji that come with a pair.
void note_errors(const PairExchange& pair, const VisibleFraction& visible, double area_i, double area_j,
                 std::uint32_t i, std::uint32_t j, RowErrors& errors) {
  const double geometry = pair.error * visible.value;
  if (geometry > 0) {
    errors.geometry[i] += geometry / area_i;
    errors.geometry[j] += geometry / area_j;
  }
  if (!(visible.variance > 0)) return;
  const double squared = pair.geometric * pair.geometric * visible.variance;
  errors.visibility[i] += squared / (area_i * area_i);
  errors.visibility[j] += squared / (area_j * area_j);
}

/// What the parts of a block miss of their own.
void note_variation(const BlockLink& link, double area_i, double area_j, std::uint32_t i, std::uint32_t j,
                    RowErrors& errors) {
  const double exchange = link.pair.geometric * link.visible.value, squared = exchange * exchange;
  if (link.vary_i > 0) errors.visibility[i] += squared * link.vary_i / (area_i * area_i);
  if (link.vary_j > 0) errors.visibility[j] += squared * link.vary_j / (area_j * area_j);
}

struct RowContext {
  RowContext(const Surfaces& s, const Options& o, Intersector& x, const RowSide& i)
      : surfaces(s), options(o), intersector(x), side(i), root_area(s.root_area[i.position]) {
    const LatticePoint* sample = s.samples(i.position);
    for (std::uint32_t k = 0; k < s.cached_points; ++k) box.include(sample[k]);
  }

  const Surfaces& surfaces;
  const Options& options;
  Intersector& intersector;
  const RowSide& side;
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

/// Writes an entry, and notes its errors if they are asked for.
void put_link(const Surfaces& surfaces, std::uint32_t i, std::uint32_t j, const PairExchange& pair,
              const VisibleFraction& visible, RowWriter& writer, RowErrors* errors) {
  const double root_i = surfaces.root_area[i], root_j = surfaces.root_area[j];
  if (errors != nullptr) {
    ++errors->computed;
    note_errors(pair, visible, root_i * root_i, root_j * root_j, i, j, *errors);
  }
  if (!(visible.value > 0)) return;
  const double value = pair.geometric * visible.value / (root_i * root_j);
  if (value > 0) writer.add(j, value < 1 ? value : 1);
}

void add_pair(RowContext& row, std::uint32_t j, RowWriter& writer, RowErrors* errors) {
  const Surfaces& surfaces = row.surfaces;
  while (j >= surfaces.mesh_begin[row.place + 1]) ++row.place;  // nodes ascend
  const PairExchange pair = exchange_between(surfaces, row.side, j, row.options.tiers);
  if (!(pair.geometric > 0)) return;
  const VisibleFraction visible =
      visible_fraction(surfaces, row.side.position, j, pair.crossing, row.options, row.intersector, nullptr,
                       mesh_aim(row), row.dense);
  put_link(surfaces, row.side.position, j, pair, visible, writer, errors);
}

}  // namespace

void compute_row(const Surfaces& surfaces, const Sparsity& sparsity, LinkWalk& walk, BlockTools& tools,
                 std::uint32_t i, std::uint8_t generation, const Options& options, Intersector& intersector,
                 RowWriter& writer, RowErrors* errors) {
  writer.start(i);
  if (!(surfaces.root_area[i] > 0)) return;
  NodeGeometry own;
  const RowSide side = row_side(surfaces, i, own);
  if (features::blocks(options.rules)) {
    BlockJudge judge(surfaces, options, walk, tools, intersector);
    walk.visit(
        side, [&](const RowSide& from, std::uint32_t j) { return judge.judge(from, j); },
        [&](std::uint32_t j) {
          if (sparsity.generation(i, j) != generation) return;
          put_link(surfaces, i, j, judge.found().pair, judge.found().visible, writer, errors);
          if (errors == nullptr) return;
          const double root_i = surfaces.root_area[i], root_j = surfaces.root_area[j];
          note_variation(judge.found(), root_i * root_i, root_j * root_j, i, j, *errors);
        });
    return;
  }
  RowContext row(surfaces, options, intersector, side);
  walk.visit(
      side, [&](const RowSide& from, std::uint32_t j) { return walk.judge(from.position, j); },
      [&](std::uint32_t j) {
        if (sparsity.generation(i, j) == generation) add_pair(row, j, writer, errors);
      });
}

}  // namespace shodo
