#include "ambient/gauss_seidel.h"

#include "ambient/slow_light.h"
#include "base/features.h"
#include "base/interrupted.h"

namespace shodo {

namespace {

/// Sweeps in which no change is less than the least of as many before: after them nothing better is expected.
constexpr std::uint32_t kPatience = 30;
/// Sweeps with larger changes than the sweep before, after which corrections are no longer tried.
constexpr std::uint32_t kSetbacks = 3;
/// So many sweeps are always made, and more if so few a channel are likely to be enough; else ambient/slow_light.h.
constexpr std::uint32_t kFirstSweeps = 6, kFewSweeps = 12;
/// Of the tolerance, what conjugate gradients are asked for: a sweep's changes are larger than residuals. Each time the
/// sweep after them isn't content they are asked for the same part of it.
constexpr double kPartOfBound = 0.25, kLeastPart = 1e-4;

/// By channel: what a sweep changed at most, and the largest illuminance.
struct SweepResult {
  double change[3] = {0, 0, 0};
  double largest[3] = {0, 0, 0};
  bool finished = true;

  double largest_of_all() const {
    return largest[0] > largest[1] ? (largest[0] > largest[2] ? largest[0] : largest[2])
                                   : (largest[1] > largest[2] ? largest[1] : largest[2]);
  }
};

struct Run : SolverRun {
  std::uint32_t channels;
  bool doubles;
};

/// 0 as a template's argument: known only now.
template <std::uint32_t kChannels>
std::uint32_t channels_of(const Run& run) {
  return kChannels == 0 ? run.channels : kChannels;
}

/// One sweep's inner loops at row i: sum over j > i of v_ij sent_j, on top of `sum`.
template <RowFormat kFormat, std::uint32_t kChannels>
void gather(const Run& run, const std::uint16_t* row, std::uint32_t i, double* sum) {
  const std::uint32_t channels = channels_of<kChannels>(run);
  const double* sent = run.solver.sent.data();
  for (RowReader<kFormat> entry(row, i, run.doubles); entry.next();) {
    const double v = entry.value();
    const double* from = sent + std::size_t{entry.column()} * channels;
    for (std::uint32_t c = 0; c < channels; ++c) sum[c] += v * from[c];
  }
}

template <RowFormat kFormat, std::uint32_t kChannels>
void scatter(Run& run, const std::uint16_t* row, std::uint32_t i) {
  const std::uint32_t channels = channels_of<kChannels>(run);
  const double* sent_i = &run.solver.sent[std::size_t{i} * channels];
  double* gathered = run.solver.gathered.data();
  for (RowReader<kFormat> entry(row, i, run.doubles); entry.next();) {
    const double v = entry.value();
    double* to = gathered + std::size_t{entry.column()} * channels;
    for (std::uint32_t c = 0; c < channels; ++c) to[c] += v * sent_i[c];
  }
}

/// New values of patch i from its sum; what it sends from now on.
template <std::uint32_t kChannels>
void update(Run& run, std::uint32_t i, std::uint32_t group, const double* reflectance, const double* sum,
            SweepResult& result) {
  const Surfaces& surfaces = run.matrix.surfaces;
  const double root = surfaces.root_area[i], factor = run.matrix.factor[i];
  const std::uint32_t channels = channels_of<kChannels>(run);
  for (std::uint32_t c = 0; c < channels; ++c) {
    const std::size_t at = std::size_t{surfaces.patch_at[i]} * channels + c;
    const double ambient = factor * sum[c], change = ambient - run.solver.ambient_lx[at];
    const double total = run.direct.patch_lx[at] + ambient;
    run.solver.ambient_lx[at] = ambient;
    run.solver.sent[std::size_t{i} * channels + c] = run.matrix.sparsity.sends(i) ? reflectance[c] * root * total : 0;
    run.matrix.coarse.add_change(group, c, root * root, change);
    if (magnitude(change) > result.change[c]) result.change[c] = magnitude(change);
    if (magnitude(total) > result.largest[c]) result.largest[c] = magnitude(total);
  }
}

/// One sweep as it goes on.
struct SweepState {
  RowCursor rows[kGenerations];
  Intersector uncounted;
  SweepResult result;
};

/// Node i gathers; a patch gets its new value and sends it on, a block hands down what it gathered.
template <RowFormat kFormat, std::uint32_t kChannels>
void sweep_node(Run& run, SweepState& state, std::uint32_t i, const MeshWalk& at_i) {
  Matrix& matrix = run.matrix;
  const std::uint32_t channels = channels_of<kChannels>(run);
  double sum[kChannels == 0 ? 3 : kChannels];
  double* gathered = &run.solver.gathered[std::size_t{i} * channels];
  for (std::uint32_t c = 0; c < channels; ++c) {
    sum[c] = gathered[c];
    gathered[c] = 0;
  }
  const std::uint16_t* row[kGenerations];
  std::uint32_t in_scratch = kGenerations;  // the generation whose row lies there
  for (std::uint8_t g = 0; g < matrix.generations(); ++g) {
    row[g] = state.rows[g].row(matrix, state.uncounted, i);
    if (!matrix.keeps(g, i)) in_scratch = g;
    gather<kFormat, kChannels>(run, row[g], i, sum);
  }
  if (matrix.surfaces.is_block(i)) return hand_down<kChannels>(matrix.surfaces, i, sum, run.solver.gathered);
  update<kChannels>(run, i, matrix.coarse.group_at(i, at_i.place()), at_i.reflectance(i), sum, state.result);
  // No column is in two generations, so their order doesn't matter: the last, if it isn't kept, is still at hand.
  for (std::uint32_t g = matrix.generations(); g-- > 0;) {
    if (!matrix.keeps(g, i) && g != in_scratch) row[g] = state.rows[g].row(matrix, state.uncounted, i);
    scatter<kFormat, kChannels>(run, row[g], i);
  }
}

/// The blocks of a mesh send, from its first node on; `rows` stand there.
template <RowFormat kFormat, std::uint32_t kChannels>
void send_blocks(Run& run, SweepState& state, RowCursor* rows, std::uint32_t begin, std::uint32_t end) {
  Matrix& matrix = run.matrix;
  sum_up(matrix.surfaces, begin, end, run.channels, run.solver.sent);
  for (std::uint32_t i = begin; i < end; ++i) {
    for (std::uint8_t g = 0; g < matrix.generations(); ++g) {
      if (!matrix.surfaces.is_block(i) || !(matrix.surfaces.root_area[i] > 0)) {
        rows[g].skip(matrix, i);
        continue;
      }
      scatter<kFormat, kChannels>(run, rows[g].row(matrix, state.uncounted, i), i);
    }
  }
}

template <RowFormat kFormat, std::uint32_t kChannels>
SweepResult sweep(Run& run) {
  Matrix& matrix = run.matrix;
  const Surfaces& surfaces = matrix.surfaces;
  const std::uint32_t n = surfaces.size();
  SweepState state{{}, run.intersector, {}};
  RowCursor at_mesh[kGenerations];
  for (std::uint8_t g = 0; g < matrix.generations(); ++g) state.rows[g] = RowCursor(matrix, g);
  MeshWalk at_i(surfaces, 0);
  matrix.coarse.start_sweep();
  for (std::uint32_t i = 0; i < n; ++i) {
    if ((!matrix.keeps(matrix.sparsity.now(), i) || i % 256 == 0) && !run.progress.go_on(Stage::kSolution, i, n)) {
      state.result.finished = false;
      return state.result;
    }
    at_i.go_to(i);
    const std::uint32_t begin = surfaces.mesh_begin[at_i.place()], end = surfaces.mesh_begin[at_i.place() + 1];
    const bool blocks = surfaces.is_block(begin);
    for (std::uint8_t g = 0; blocks && i == begin && g < matrix.generations(); ++g) at_mesh[g] = state.rows[g];
    if (surfaces.root_area[i] > 0) {
      sweep_node<kFormat, kChannels>(run, state, i, at_i);
    } else {
      for (std::uint8_t g = 0; g < matrix.generations(); ++g) state.rows[g].skip(matrix, i);
    }
    if (blocks && i + 1 == end) send_blocks<kFormat, kChannels>(run, state, at_mesh, begin, end);
  }
  return state.result;
}

SweepResult sweep_once(Run& run) {
  if constexpr (features::kSmallCode) return sweep<RowFormat::kEither, 0>(run);
  const bool grey = run.channels == 1;
  if (run.doubles) return grey ? sweep<RowFormat::kDoubles, 1>(run) : sweep<RowFormat::kDoubles, 3>(run);
  return grey ? sweep<RowFormat::kShort, 1>(run) : sweep<RowFormat::kShort, 3>(run);
}

/// rho_i R_i (E0_i + a_i) of every patch, with the correction of its group added to a_i first. Light is never negative;
/// and a patch that no light has reached is lent none, so that a mesh of which a part is closed in stays dark there.
void correct_and_send(Run& run, std::uint32_t c) {
  const Surfaces& surfaces = run.matrix.surfaces;
  const Sparsity& sparsity = run.matrix.sparsity;
  const std::uint32_t channels = surfaces.scene->channels;
  MeshWalk at(surfaces, 0);
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces.is_block(i) || !(surfaces.root_area[i] > 0)) continue;
    at.go_to(i);
    const std::size_t patch = std::size_t{surfaces.patch_at[i]} * channels + c;
    double& ambient = run.solver.ambient_lx[patch];
    if (sparsity.receives(i) && ambient > 0) {
      ambient += run.solver.group_delta[run.matrix.coarse.group_at(i, at.place())];
    }
    if (ambient < 0) ambient = 0;
    const double total = run.direct.patch_lx[patch] + ambient;
    run.solver.sent[std::size_t{i} * channels + c] =
        sparsity.sends(i) ? at.reflectance(i)[c] * surfaces.root_area[i] * total : 0;
  }
}

void correct(Run& run) {
  const std::uint32_t groups = run.matrix.coarse.groups();
  for (std::uint32_t c = 0; c < run.matrix.surfaces.scene->channels; ++c) {
    run.matrix.coarse.correct(c, run.solver.group_area, run.solver.group_reflectance.subspan(c * groups, groups),
                              run.solver.group_delta);
    correct_and_send(run, c);
  }
  sum_up(run.matrix.surfaces, 0, run.matrix.surfaces.size(), run.channels, run.solver.sent);
}

/// Every patch sends the light it has.
void send_all(Run& run) {
  for (double& value : run.solver.sent) value = 0;
  for (double& value : run.solver.group_delta) value = 0;
  for (std::uint32_t c = 0; c < run.channels; ++c) correct_and_send(run, c);
  sum_up(run.matrix.surfaces, 0, run.matrix.surfaces.size(), run.channels, run.solver.sent);
}

/// Areas and mean reflectances of the groups; every patch sends the light it has.
void prepare(Run& run) {
  const Surfaces& surfaces = run.matrix.surfaces;
  const std::uint32_t groups = run.matrix.coarse.groups(), channels = surfaces.scene->channels;
  Solver& solver = run.solver;
  for (double& value : solver.group_area) value = 0;
  for (double& value : solver.group_reflectance) value = 0;
  MeshWalk at(surfaces, 0);
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    at.go_to(i);
    if (surfaces.is_block(i)) continue;
    const std::uint32_t g = run.matrix.coarse.group_at(i, at.place());
    const double area = surfaces.root_area[i] * surfaces.root_area[i];
    solver.group_area[g] += area;
    for (std::uint32_t c = 0; c < channels; ++c) {
      solver.group_reflectance[c * groups + g] += area * at.reflectance(i)[c];
    }
  }
  for (std::uint32_t g = 0; g < groups; ++g) {
    for (std::uint32_t c = 0; c < channels && solver.group_area[g] > 0; ++c) {
      solver.group_reflectance[c * groups + g] /= solver.group_area[g];
    }
  }
  send_all(run);
}

/// The certified bound relative to the largest illuminance, and the part of it that no sweep takes away.
struct Bound {
  double error = 0;
  double rounding = 0;
};

Bound bound_after(const Run& run, const SweepResult& result) {
  const double n = static_cast<double>(run.matrix.surfaces.size()) + 16;
  const double rounding = n * 0x1p-52;
  const double largest = result.largest_of_all();
  Bound bound;
  if (!(largest > 0)) return bound;
  for (std::uint32_t c = 0; c < run.matrix.surfaces.scene->channels; ++c) {
    const double left = 1 - run.matrix.reflected[c] * (1 + rounding);  // the sums themselves are rounded
    if (!(left > 0)) return {kNoBound, 0};
    const double from_changes = run.matrix.reflected_upper[c] * (1 + rounding) * result.change[c];
    const double from_rounding = rounding * result.largest[c];
    const double error = (from_changes + from_rounding) / (left * largest);
    if (error > bound.error) bound = {error, from_rounding / (left * largest)};
  }
  return bound;
}

double largest_change(const SweepResult& result) {
  const double first = result.change[0] > result.change[1] ? result.change[0] : result.change[1];
  return first > result.change[2] ? first : result.change[2];
}

/// Tells when to stop, whether corrections still help, and whether sweeps are too slow.
struct Watch {
  double least = kInfinity;         // of the changes of these kPatience sweeps
  double least_before = kInfinity;  // and of those before
  double last = kInfinity;
  double ratio = 0;                 // of the last two changes
  std::uint32_t sweeps = 0;         // of kPatience
  std::uint32_t all = 0;
  std::uint32_t setbacks = 0;

  void note(double change) {
    if (change > last) ++setbacks;
    ratio = last > 0 && last < kInfinity ? change / last : 0;
    last = change;
    if (all++ == 0) return;  // no correction before it
    if (sweeps == kPatience) {
      least_before = least;
      least = kInfinity;
      sweeps = 0;
    }
    ++sweeps;
    if (change < least) least = change;
  }
  bool hopeless() const { return sweeps == kPatience && !(least < least_before); }
  /// Many more sweeps would be needed, going by the last.
  bool slow(double error, double goal, std::uint32_t channels) const {
    if (all < kFirstSweeps) return false;
    for (std::uint32_t k = 0; k < kFewSweeps * channels && error > goal; ++k) error *= ratio;
    return error > goal;
  }
};

/// Conjugate gradients for every channel, to a part of what the bound is to be; then all is ready for a sweep.
Status accelerate(Run& run, double goal, double largest, Statistics& statistics) {
  for (std::uint32_t c = 0; c < run.channels; ++c) {
    const Status status = solve_slow_light(run, c, goal * (1 - run.matrix.reflected[c]) * largest, statistics);
    if (!status.done()) return status;
  }
  send_all(run);
  for (double& value : run.solver.gathered) value = 0;
  return {};
}

}  // namespace

Status solve_rows(const DirectLight& direct, const Intersector& intersector, const Progress& progress, Matrix& matrix,
                  Solver& solver, Statistics& statistics) {
  Run run{{direct, intersector, progress, matrix, solver}, matrix.surfaces.scene->channels, matrix.doubles()};
  const double tolerance = matrix.options->tolerance;
  prepare(run);
  Watch watch;
  double part = kPartOfBound;  // of the tolerance: what conjugate gradients are asked for
  for (;;) {
    const SweepResult result = sweep_once(run);
    if (!result.finished) return interrupted();
    ++statistics.sweeps;
    const Bound bound = bound_after(run, result);
    statistics.solution_bound = bound.error;
    const double change = largest_change(result);
    watch.note(change);
    const bool only_rounding = bound.error < kNoBound && bound.error <= 2 * bound.rounding;
    if (bound.error <= tolerance || only_rounding || !(change > 0) || watch.hopeless()) return {};
    const double goal = tolerance > 2 * bound.rounding ? tolerance : 2 * bound.rounding;
    if (bound.error < kNoBound && part > kLeastPart && watch.slow(bound.error, goal, run.channels)) {
      const Status status = accelerate(run, part * goal, result.largest_of_all(), statistics);
      if (!status.done()) return status;
      part *= kPartOfBound;
      continue;
    }
    if (watch.setbacks < kSetbacks) correct(run);
  }
}

}  // namespace shodo
