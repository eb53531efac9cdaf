#include "ambient/matrix.h"

#include "ambient/exchange_row.h"
#include "base/features.h"
#include "base/interrupted.h"

namespace shodo {

namespace {

constexpr double kStandardErrors = 3;
constexpr double kLightError = 1.0 / 64;
constexpr double kHiddenError = 1.0 / 8;
constexpr double kLeastScale = 0x1p-20;  // lights fill all: the row is as good as empty, and f_i isn't 0

/// Everything the first pass has in hand at one row.
struct FirstPass {
  Matrix& matrix;
  const DirectLight& direct;
  FirstPassScratch scratch;
  Statistics& statistics;
  const Panes& panes;
};

/// What the row's sum may be wrong by (matrix.h).
double row_sum_error(const FirstPass& pass, std::uint32_t i, double sum, double lights) {
  const double visible = static_cast<double>(pass.direct.visible_area[pass.matrix.surfaces.patch_at[i]]);
  double hidden = visible < 1 ? (1 - visible) / visible : 0;
  if (hidden > 1) hidden = 1;
  return pass.scratch.geometry_errors[i] + kStandardErrors * square_root(pass.scratch.visibility_errors[i]) +
         kRowValueError * sum + kLightError * lights + kHiddenError * hidden * sum;
}

/// s_i, given S.
double scale_of_row(const FirstPass& pass, std::uint32_t i, double sum) {
  const double given = static_cast<double>(pass.direct.light_form_factor[pass.matrix.surfaces.patch_at[i]]);
  const double lights = given < 1 ? given : 1;
  const double missing = 1 - lights - sum;
  if (!pass.matrix.options->scale_rows || !(sum > 0) || missing > row_sum_error(pass, i, sum, lights)) return 1;
  if (missing > 0 && pass.matrix.sparsity.drops_columns()) return 1;
  const double scale = (1 - lights) / sum;
  return scale > kLeastScale ? scale : kLeastScale;
}

/// Sums of one row over j > i.
struct UpperSums {
  double all = 0;
  double reflected[3] = {0, 0, 0};
};

/// Patches of a node that receive, and that send.
struct LiveEnds {
  std::uint64_t receivers, senders;
};

LiveEnds ends_of(const Matrix& matrix, std::uint32_t node) {
  if (matrix.surfaces.is_block(node)) {
    const Block& block = matrix.surfaces.block(node);
    return {block.receivers, block.senders};
  }
  return {matrix.sparsity.receives(node) ? 1u : 0u, matrix.sparsity.sends(node) ? 1u : 0u};
}

/// The part of a mesh's directions that is its own: through a pane one sees what is behind as well.
double solid_part(const Surfaces& surfaces, std::uint32_t place, std::uint32_t channel) {
  const Mesh& mesh = surfaces.scene->meshes[surfaces.mesh_at[place]];
  const Optics* const optics = surfaces.scene->optics_of(mesh.material);
  return optics == nullptr ? 1 : 1 - optics->transmit.c[channel];
}

/// Adds row i's entries to the sums of the rows after it, to its own in `sums`, and to the coarse matrix.
template <RowFormat kFormat>
void spread_row(FirstPass& pass, std::uint32_t i, const MeshWalk& at_i, const std::uint16_t* row, UpperSums& sums) {
  Matrix& matrix = pass.matrix;
  const Surfaces& surfaces = matrix.surfaces;
  const std::uint32_t channels = surfaces.scene->channels;
  const double sending_i = matrix.sending_root(i);
  const std::uint32_t mesh_i = matrix.coarse.group_of_mesh(at_i.place());
  const LiveEnds ends_i = ends_of(matrix, i);
  MeshWalk at_j = at_i;
  std::uint32_t mesh_j = mesh_i;
  const bool panes = pass.panes.any();
  const double solid_i = panes ? solid_part(surfaces, at_i.place(), pass.panes.channel()) : 1;
  double solid_j = solid_i;
  const double *rho_i = at_i.most_reflectance(), *rho_j = rho_i;
  for (RowReader<kFormat> entry(row, i, matrix.doubles()); entry.next();) {
    const std::uint32_t j = entry.column();
    if (at_j.go_to(j)) {
      rho_j = at_j.most_reflectance();
      mesh_j = matrix.coarse.group_of_mesh(at_j.place());
      if (panes) solid_j = solid_part(surfaces, at_j.place(), pass.panes.channel());
    }
    const double v = entry.value();
    const double to_i = v * matrix.sending_root(j), to_j = v * sending_i;
    sums.all += panes ? solid_j * to_i : to_i;
    matrix.factor[j] += panes ? solid_i * to_j : to_j;
    for (std::uint32_t c = 0; c < channels; ++c) {
      sums.reflected[c] += to_i * rho_j[c];
      pass.scratch.reflected[j * channels + c] += to_j * rho_i[c];
    }
    const LiveEnds ends_j = ends_of(matrix, j);
    // Corrections count exchange that goes both ways only, so that their matrix is symmetric.
    const double both = ends_i.receivers > 0 && ends_j.receivers > 0 ? to_i * sending_i : 0;
    if (both > 0) matrix.coarse.add_exchange(surfaces, i, mesh_i, j, mesh_j, both);
    pass.statistics.nonzeros += ends_i.receivers * ends_j.senders + ends_j.receivers * ends_i.senders;
    ++pass.statistics.links;
    if (surfaces.is_block(i) || surfaces.is_block(j)) ++pass.statistics.block_links;
  }
}

/// The rows of block b are complete: its parts get their shares of its sums, and its errors.
void hand_down(FirstPass& pass, std::uint32_t b, const UpperSums& upper) {
  Matrix& matrix = pass.matrix;
  const Surfaces& surfaces = matrix.surfaces;
  const std::uint32_t channels = surfaces.scene->channels;
  const FirstPassScratch& scratch = pass.scratch;
  if (!(surfaces.root_area[b] > 0)) return;
  for (std::uint32_t child = b + 1; child < surfaces.end(b); child = surfaces.end(child)) {
    const double share = surfaces.share(child, b);
    matrix.factor[child] += share * (matrix.factor[b] + upper.all);
    for (std::uint32_t c = 0; c < channels; ++c) {
      scratch.reflected[child * channels + c] += share * (scratch.reflected[b * channels + c] + upper.reflected[c]);
    }
    // Of every generation only what is new is in a block's errors.
    scratch.geometry_errors[child] += scratch.geometry_errors[b];
    scratch.visibility_errors[child] += scratch.visibility_errors[b];
  }
  matrix.factor[b] = 0;
  scratch.geometry_errors[b] = scratch.visibility_errors[b] = 0;
  for (std::uint32_t c = 0; c < channels; ++c) scratch.reflected[b * channels + c] = 0;
}

/// Row i is complete, since columns ascend: its sum, its scale, its share of the bounds.
void finish_row(FirstPass& pass, std::uint32_t i, const MeshWalk& at_i, const UpperSums& upper) {
  Matrix& matrix = pass.matrix;
  const std::uint32_t channels = matrix.surfaces.scene->channels;
  const double root = matrix.surfaces.root_area[i];
  if (!(root > 0)) return;
  if (!matrix.sparsity.receives(i)) {  // rule 1
    matrix.factor[i] = 0;
    for (std::uint32_t c = 0; c < channels; ++c) pass.scratch.reflected[i * channels + c] = 0;
    return;
  }
  const double scale = scale_of_row(pass, i, (matrix.factor[i] + upper.all) / root);
  if (scale != 1) ++pass.statistics.rows_scaled;
  const double factor = scale / root;
  matrix.factor[i] = factor;
  matrix.coarse.add_row(matrix.coarse.group_at(i, at_i.place()), root / factor);
  for (std::uint32_t c = 0; c < channels; ++c) {
    double& lower = pass.scratch.reflected[i * channels + c];
    const double sum = factor * (lower + upper.reflected[c]);
    // What came through blocks isn't told apart: then all of the row counts as above the diagonal.
    const double above = matrix.surfaces.blocks.empty() ? factor * upper.reflected[c] : sum;
    if (sum > matrix.reflected[c]) matrix.reflected[c] = sum;
    if (above > matrix.reflected_upper[c]) matrix.reflected_upper[c] = above;
    lower = 0;
  }
}

std::size_t scratch_words(const Scene& scene, const Options& options) {
  const std::size_t nodes = node_count(scene, options.rules);
  return row_words(nodes > 0 ? nodes - 1 : 0, options.row_value_bits == 64);
}

/// Everything that the sums of all generations make.
void forget_sums(FirstPass& pass) {
  Matrix& matrix = pass.matrix;
  for (double& sum : matrix.factor) sum = 0;
  for (std::uint32_t c = 0; c < 3; ++c) matrix.reflected[c] = matrix.reflected_upper[c] = 0;
  matrix.coarse.forget();
  pass.statistics.nonzeros = pass.statistics.links = pass.statistics.block_links = 0;
  pass.statistics.rows_scaled = 0;
}

/// The rows of earlier generations, then that of this one, which is new.
UpperSums add_rows(FirstPass& pass, std::uint32_t i, const MeshWalk& at_i, RowCursor* earlier,
                   Intersector& intersector, Intersector& uncounted, RowErrors& errors) {
  Matrix& matrix = pass.matrix;
  UpperSums sums;
  const std::uint8_t now = matrix.sparsity.now();
  for (std::uint8_t g = 0; g <= now; ++g) {
    const std::uint16_t* row;
    if (g < now) {
      row = earlier[g].row(matrix, uncounted, i);
    } else {
      RowWriter writer(matrix.row_words, matrix.doubles());
      compute_row(matrix.surfaces, matrix.sparsity, matrix.walk, matrix.tools, i, g, *matrix.options,
                  intersector, writer, &errors);
      const std::span<const std::uint16_t> made = writer.finish();
      matrix.stores[g].keep(made);
      row = made.data();
    }
    if constexpr (features::kSmallCode) {
      spread_row<RowFormat::kEither>(pass, i, at_i, row, sums);
    } else if (matrix.doubles()) {
      spread_row<RowFormat::kDoubles>(pass, i, at_i, row, sums);
    } else {
      spread_row<RowFormat::kShort>(pass, i, at_i, row, sums);
    }
  }
  return sums;
}

void count_rows(const Matrix& matrix, Statistics& statistics) {
  statistics.rows_kept = statistics.rows_recomputed = 0;
  statistics.row_bytes = 0;
  statistics.blocks = static_cast<std::uint32_t>(matrix.surfaces.blocks.size());
  for (std::uint8_t g = 0; g < matrix.generations(); ++g) {
    statistics.rows_kept += matrix.stores[g].rows();
    statistics.rows_recomputed += matrix.surfaces.size() - matrix.stores[g].rows();
    statistics.row_bytes += matrix.stores[g].bytes();
  }
}

}  // namespace

const std::uint16_t* RowCursor::row(Matrix& matrix, Intersector& uncounted, std::uint32_t i) {
  if (i < matrix.stores[generation_].rows()) {
    const std::uint16_t* row = next_;
    next_ = RowStore::after(row);
    return row;
  }
  RowWriter writer(matrix.row_words, matrix.doubles());
  compute_row(matrix.surfaces, matrix.sparsity, matrix.walk, matrix.tools, i, generation_, *matrix.options,
              uncounted, writer, nullptr);
  return writer.finish().data();
}

Status prepare_matrix(const DirectLight& direct, Arena& arena, Matrix& matrix) {
  const Scene& scene = *matrix.surfaces.scene;
  const std::uint32_t n = matrix.surfaces.size();
  Status status = matrix.sparsity.take(arena, matrix.surfaces, direct, matrix.options->rules);
  if (status.done()) status = matrix.tools.take(arena, matrix.surfaces, direct, *matrix.options);
  if (status.done()) status = matrix.walk.take(arena, matrix.surfaces, matrix.sparsity, *matrix.options);
  if (!status.done()) return status;
  if (!arena.take("row factors", n, matrix.factor)) return arena.refused();
  if (!arena.take("row scratch", scratch_words(scene, *matrix.options), matrix.row_words)) return arena.refused();
  return matrix.coarse.take(arena, matrix.surfaces, matrix.options->rules);
}

Status build_matrix(const DirectLight& direct, const Progress& progress, Intersector& intersector,
                    const FirstPassScratch& scratch, Matrix& matrix, Statistics& statistics) {
  const std::uint32_t n = matrix.surfaces.size();
  FirstPass pass{matrix, direct, scratch, statistics, intersector.panes()};
  forget_sums(pass);
  RowErrors errors{pass.scratch.geometry_errors, pass.scratch.visibility_errors};
  RowCursor earlier[kGenerations];
  for (std::uint8_t g = 0; g < matrix.sparsity.now(); ++g) earlier[g] = RowCursor(matrix, g);
  Intersector uncounted(intersector);
  MeshWalk at_i(matrix.surfaces, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!progress.go_on(Stage::kFormFactors, i, n)) return interrupted();
    at_i.go_to(i);
    const UpperSums upper = add_rows(pass, i, at_i, earlier, intersector, uncounted, errors);
    if (matrix.surfaces.is_block(i)) {
      hand_down(pass, i, upper);
    } else {
      finish_row(pass, i, at_i, upper);
    }
  }
  statistics.form_factors_computed += errors.computed;
  count_rows(matrix, statistics);
  return {};
}

std::uint64_t matrix_bytes(const Scene& scene, const Geometry& geometry, const Options& options) {
  const std::uint64_t nodes = node_count(scene, options.rules);
  return Sparsity::bytes(scene, options.rules) + LinkWalk::bytes(scene, options) +
         BlockTools::bytes(scene, geometry, options) + 8 * nodes +
         (2 * scratch_words(scene, options) + 7) / 8 * 8 + Coarse::bytes(scene, options.rules);
}

}  // namespace shodo
