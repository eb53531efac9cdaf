#include "ambient/matrix.h"

#include "ambient/exchange_row.h"

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
  const FirstPassScratch& scratch;
  Statistics& statistics;
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
  const double scale = (1 - lights) / sum;
  return scale > kLeastScale ? scale : kLeastScale;
}

/// Sums of one row over j > i.
struct UpperSums {
  double all = 0;
  double reflected[3] = {0, 0, 0};
};

/// Adds row i's entries to the sums of the rows after it, and to the coarse matrix; returns its own.
template <bool kDoubles>
UpperSums spread_row(FirstPass& pass, std::uint32_t i, const MeshWalk& at_i, const std::uint16_t* row) {
  Matrix& matrix = pass.matrix;
  const Surfaces& surfaces = matrix.surfaces;
  const std::uint32_t channels = surfaces.scene->channels;
  const double root_i = surfaces.root_area[i];
  const std::uint32_t group_i = matrix.coarse.group_of_mesh(at_i.place());
  MeshWalk at_j = at_i;
  std::uint32_t group_j = group_i;
  UpperSums sums;
  for (RowReader<kDoubles> entry(row, i); entry.next();) {
    const std::uint32_t j = entry.column();
    if (at_j.go_to(j)) group_j = matrix.coarse.group_of_mesh(at_j.place());
    const double v = entry.value();
    const double to_i = v * surfaces.root_area[j], to_j = v * root_i;
    sums.all += to_i;
    matrix.factor[j] += to_j;
    for (std::uint32_t c = 0; c < channels; ++c) {
      sums.reflected[c] += to_i * at_j.reflectance()[c];
      pass.scratch.reflected[j * channels + c] += to_j * at_i.reflectance()[c];
    }
    matrix.coarse.add_exchange(group_i, group_j, to_i * root_i);
    pass.statistics.nonzeros += 2;
  }
  return sums;
}

/// Row i is complete, since columns ascend: its sum, its scale, its share of the bounds.
void finish_row(FirstPass& pass, std::uint32_t i, const MeshWalk& at_i, const UpperSums& upper) {
  Matrix& matrix = pass.matrix;
  const std::uint32_t channels = matrix.surfaces.scene->channels;
  const double root = matrix.surfaces.root_area[i];
  if (!(root > 0)) return;
  const double scale = scale_of_row(pass, i, (matrix.factor[i] + upper.all) / root);
  if (scale != 1) ++pass.statistics.rows_scaled;
  const double factor = scale / root;
  matrix.factor[i] = factor;
  matrix.coarse.add_row(matrix.coarse.group_of_mesh(at_i.place()), root / factor);
  for (std::uint32_t c = 0; c < channels; ++c) {
    double& lower = pass.scratch.reflected[i * channels + c];
    const double sum = factor * (lower + upper.reflected[c]), above = factor * upper.reflected[c];
    if (sum > matrix.reflected[c]) matrix.reflected[c] = sum;
    if (above > matrix.reflected_upper[c]) matrix.reflected_upper[c] = above;
    lower = 0;
  }
}

std::size_t scratch_words(const Scene& scene, const Options& options) {
  const std::size_t columns = scene.patch_count > 0 ? scene.patch_count - 1 : 0;
  return row_words(columns, options.row_value_bits == 64);
}

}  // namespace

const std::uint16_t* RowCursor::row(std::uint32_t i) {
  if (i < matrix_->store.rows()) {
    const std::uint16_t* row = next_;
    next_ = RowStore::after(row);
    return row;
  }
  RowWriter writer(matrix_->row_words, matrix_->doubles());
  compute_row(matrix_->surfaces, i, *matrix_->options, intersector_, writer, nullptr);
  return writer.finish().data();
}

Status build_matrix(const DirectLight& direct, const Progress& progress, Arena& arena, Intersector& intersector,
                    const FirstPassScratch& scratch, Matrix& matrix, Statistics& statistics) {
  const Scene& scene = *matrix.surfaces.scene;
  const std::uint32_t n = matrix.surfaces.size();
  if (!arena.take("row factors", n, matrix.factor)) return arena.refused();
  if (!arena.take("row scratch", scratch_words(scene, *matrix.options), matrix.row_words)) return arena.refused();
  Status status = matrix.coarse.take(arena, matrix.surfaces);
  if (!status.done() || n == 0) return status;

  FirstPass pass{matrix, direct, scratch, statistics};
  RowErrors errors{scratch.geometry_errors, scratch.visibility_errors};
  RowWriter writer(matrix.row_words, matrix.doubles());
  MeshWalk at_i(matrix.surfaces, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!progress.go_on(Stage::kFormFactors, i, n)) {
      status.code = StatusCode::kInterrupted;
      return status;
    }
    at_i.go_to(i);
    compute_row(matrix.surfaces, i, *matrix.options, intersector, writer, &errors);
    const std::span<const std::uint16_t> row = writer.finish();
    matrix.store.keep(row);
    const UpperSums upper = matrix.doubles() ? spread_row<true>(pass, i, at_i, row.data())
                                             : spread_row<false>(pass, i, at_i, row.data());
    finish_row(pass, i, at_i, upper);
  }
  statistics.form_factors_computed += errors.computed;
  statistics.rows_kept = matrix.store.rows();
  statistics.rows_recomputed = n - matrix.store.rows();
  statistics.row_bytes = matrix.store.bytes();
  return status;
}

std::uint64_t matrix_bytes(const Scene& scene, const Options& options) {
  return 8 * std::uint64_t{scene.patch_count} + (2 * scratch_words(scene, options) + 7) / 8 * 8 + Coarse::bytes(scene);
}

}  // namespace shodo
