// The ambient stage from surfaces to solution (paper 2.2, 3.2).
//
// F_ij is the fraction of the flux leaving i that reaches j: deviation D1, the paper's prose says the reverse, but
// only so do the equations conserve energy (tests/ambient/energy_test.cpp shows both).
// The rules of paper 3.2: ambient/sparsity.h (1, 2 and 2+), ambient/link_walk.h (3 and blocks).
#include "ambient/ambient.h"

#include <new>

#include "ambient/ambient_memory.h"

namespace shodo {

namespace {

/// Rule 2+.
bool repeats(const Rules& rules) { return features::kRules && rules.rule2_repeated; }

/// The first pass notes two errors a node. The fluxes sent aren't there yet: with three channels they have room for
/// them, in a grey scene what ambient/slow_light.h has of its own. With rule 2+ errors must stay while rows are solved.
std::size_t own_errors(const Rules& rules, std::size_t nodes) { return repeats(rules) ? 2 * nodes : 0; }
std::size_t own_spare(const Scene& scene, std::size_t nodes) { return scene.channels == 1 ? 2 * nodes : 0; }

FirstPassScratch first_pass_scratch(const Solver& solver, std::size_t nodes) {
  const std::span<double> errors = !solver.row_errors.empty() ? solver.row_errors
                                   : !solver.spare.empty()    ? solver.spare
                                                              : solver.sent;
  return {errors.first(nodes), errors.subspan(nodes, nodes), solver.gathered};
}

/// Taken before the rows, which then fill what is left.
bool take_solver(Arena& arena, const Scene& scene, const Rules& rules, std::size_t nodes, Solver& solver) {
  const std::size_t values = nodes * scene.channels;
  const std::size_t groups = Coarse::group_count(scene, rules);
  return arena.take("fluxes sent", values, solver.sent) && arena.take("fluxes gathered", values, solver.gathered) &&
         arena.take("mesh areas", groups, solver.group_area) &&
         arena.take("mesh reflectances", groups * scene.channels, solver.group_reflectance) &&
         arena.take("mesh corrections", groups, solver.group_delta) &&
         arena.take("row errors", own_errors(rules, nodes), solver.row_errors) &&
         arena.take("solver's vectors", own_spare(scene, nodes), solver.spare);
}

std::uint64_t solver_bytes(const Scene& scene, const Options& options) {
  const std::size_t nodes = node_count(scene, options.rules);
  return 16 * std::uint64_t{nodes} * scene.channels +
         8 * std::uint64_t{Coarse::group_count(scene, options.rules)} * (2 + scene.channels) +
         8 * std::uint64_t{own_errors(options.rules, nodes) + own_spare(scene, nodes)};
}

/// Once; with rule 2+ until no column that is left out is bright.
Status solve_in_rounds(const DirectLight& direct, Intersector& intersector, const Progress& progress, Matrix& matrix,
                       Solver& solver, Statistics& statistics) {
  const FirstPassScratch first = first_pass_scratch(solver, matrix.surfaces.size());
  do {
    Status status = build_matrix(direct, progress, intersector, first, matrix, statistics);
    statistics.segments_ambient = intersector.segments(LightSet::kAmbient);
    statistics.tests_ambient = intersector.tests(LightSet::kAmbient);
    if (!status.done()) return status;
    status = solve_rows(direct, intersector, progress, matrix, solver, statistics);
    if (!status.done()) return status;
  } while (repeats(matrix.options->rules) && matrix.sparsity.restore(matrix.surfaces, direct, solver.ambient_lx));
  matrix.sparsity.count(statistics);
  statistics.rule2_bound_lx = matrix.sparsity.loss_bound(matrix.surfaces, direct, solver.ambient_lx);
  return {};
}

}  // namespace

Status prepare_ambient(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                       const DirectLight& direct, Intersector& intersector, const Options& options, Arena& arena,
                       AmbientLight& ambient, AmbientWork*& work) {
  const std::size_t n = scene.patch_count;
  if (!arena.take("ambient illuminance", n * scene.channels, ambient.patch_lx)) return arena.refused();
  const Arena::Mark after_result = arena.mark();
  std::span<AmbientWork> room;
  if (!arena.take("matrix and solver", 1, room)) return arena.refused();
  work = new (room.data()) AmbientWork(arena, after_result);
  Matrix& matrix = work->matrix;
  matrix.options = &options;
  work->solver.ambient_lx = ambient.patch_lx;
  Status status = gather_surfaces(scene, geometry, patches, direct, options, arena, matrix.surfaces,
                                  patches.empty() ? SurfacesKeep::kNothing : SurfacesKeep::kGeometry);
  if (!status.done()) return status;
  if (!take_solver(arena, scene, options.rules, matrix.surfaces.size(), work->solver)) return arena.refused();
  if (n == 0) return status;
  status = prepare_matrix(direct, arena, matrix);
  if (!status.done()) return status;
  if (!intersector.start(arena)) return arena.refused();
  if (features::blocks(options.rules)) matrix.tools.sight.start(intersector);
  return status;
}

Status solve_prepared(const DirectLight& direct, Intersector& intersector, const Progress& progress, AmbientWork& work,
                      Statistics& statistics) {
  if (work.matrix.surfaces.scene->patch_count == 0) return {};
  return solve_in_rounds(direct, intersector, progress, work.matrix, work.solver, statistics);
}

std::uint64_t ambient_result_bytes(const Scene& scene) {
  return 8 * std::uint64_t{scene.patch_count} * scene.channels;
}

std::uint64_t smallest_ambient_bytes(const Scene& scene, const Geometry& geometry, const Options& options,
                                     SurfacesKeep keep) {
  const std::uint64_t result = ambient_result_bytes(scene);
  const std::uint64_t before_rows = surfaces_bytes(scene, options, keep) + solver_bytes(scene, options);
  constexpr std::uint64_t kWork = (sizeof(AmbientWork) + 7) / 8 * 8;
  return result + kWork + before_rows + (scene.patch_count > 0 ? matrix_bytes(scene, geometry, options) : 0);
}

std::uint64_t link_bytes(const Scene& scene, const Geometry& geometry, const Options& options) {
  if (scene.patch_count == 0) return 0;
  return LinkWalk::bytes(scene, options) + BlockTools::bytes(scene, geometry, options);
}

std::uint64_t expected_row_bytes(const Scene& scene, const Options& options) {
  constexpr std::uint64_t kBytesANode = 96;
  return features::blocks(options.rules) ? kBytesANode * node_count(scene, options.rules) : 0;
}

}  // namespace shodo
