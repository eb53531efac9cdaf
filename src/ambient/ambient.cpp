// The ambient stage from surfaces to solution (paper 2.2, 3.2).
//
// F_ij is the fraction of the flux leaving i that reaches j: deviation D1, the paper's prose says the reverse, but
// only so do the equations conserve energy (tests/ambient/energy_test.cpp shows both).
// The rules of paper 3.2: ambient/sparsity.h (1, 2 and 2+), ambient/link_walk.h (3 and blocks).
#include "ambient/ambient.h"

#include "ambient/ambient_memory.h"
#include "ambient/gauss_seidel.h"
#include "ambient/matrix.h"

namespace shodo {

namespace {

/// Taken before the rows, which then fill what is left.
bool take_solver(Arena& arena, const Scene& scene, std::size_t nodes, Solver& solver) {
  const std::size_t values = nodes * scene.channels;
  const std::size_t groups = Coarse::group_count(scene);
  return arena.take("fluxes sent", values, solver.sent) && arena.take("fluxes gathered", values, solver.gathered) &&
         arena.take("mesh areas", groups, solver.group_area) &&
         arena.take("mesh reflectances", groups * scene.channels, solver.group_reflectance) &&
         arena.take("mesh corrections", groups, solver.group_delta);
}

std::uint64_t solver_bytes(const Scene& scene, const Options& options) {
  const std::uint64_t values = std::uint64_t{node_count(scene, options.rules)} * scene.channels;
  return 16 * values + 8 * std::uint64_t{Coarse::group_count(scene)} * (2 + scene.channels);
}

/// Once; with rule 2+ until no column that is left out is bright.
Status solve_in_rounds(const DirectLight& direct, Intersector& intersector, const Progress& progress, Matrix& matrix,
                       Solver& solver, Statistics& statistics) {
  const bool own_errors = !matrix.own_errors.empty();
  const std::size_t n = own_errors ? 0 : matrix.surfaces.size();
  const FirstPassScratch first{solver.sent.first(n), solver.ambient_lx.first(n), solver.gathered};
  do {
    Status status = build_matrix(direct, progress, intersector, first, matrix, statistics);
    statistics.segments_ambient = intersector.segments(LightSet::kAmbient);
    statistics.tests_ambient = intersector.tests(LightSet::kAmbient);
    if (!status.done()) return status;
    if (!own_errors) {
      for (double& value : solver.ambient_lx) value = 0;
    }
    status = solve_rows(direct, intersector, progress, matrix, solver, statistics);
    if (!status.done()) return status;
  } while (matrix.options->rules.rule2_repeated && matrix.sparsity.restore(matrix.surfaces, direct, solver.ambient_lx));
  matrix.sparsity.count(statistics);
  statistics.rule2_bound_lx = matrix.sparsity.loss_bound(matrix.surfaces, direct, solver.ambient_lx);
  return {};
}

}  // namespace

Status light_ambiently(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                       const DirectLight& direct, Intersector& intersector, const Options& options,
                       const Progress& progress, Arena& arena, AmbientLight& ambient, Statistics& statistics) {
  const std::size_t n = scene.patch_count;
  if (!arena.take("ambient illuminance", n * scene.channels, ambient.patch_lx)) return arena.refused();
  const ArenaScratch scratch(arena);
  Matrix matrix(arena);
  matrix.options = &options;
  Solver solver;
  solver.ambient_lx = ambient.patch_lx;
  Status status = gather_surfaces(scene, geometry, patches, direct, options, arena, matrix.surfaces,
                                  patches.empty() ? SurfacesKeep::kNothing : SurfacesKeep::kGeometry);
  if (!status.done()) return status;
  if (!take_solver(arena, scene, matrix.surfaces.size(), solver)) return arena.refused();
  if (n == 0) return status;
  status = prepare_matrix(direct, arena, matrix);
  if (!status.done()) return status;
  const IntersectorScratch seeking(intersector);
  if (!intersector.start(arena)) return arena.refused();
  if (options.rules.blocks) matrix.tools.sight.start(intersector);
  return solve_in_rounds(direct, intersector, progress, matrix, solver, statistics);
}

std::uint64_t ambient_result_bytes(const Scene& scene) {
  return 8 * std::uint64_t{scene.patch_count} * scene.channels;
}

std::uint64_t smallest_ambient_bytes(const Scene& scene, const Geometry& geometry, const Options& options,
                                     SurfacesKeep keep) {
  const std::uint64_t result = ambient_result_bytes(scene);
  const std::uint64_t before_rows = surfaces_bytes(scene, options, keep) + solver_bytes(scene, options);
  return result + before_rows + (scene.patch_count > 0 ? matrix_bytes(scene, geometry, options) : 0);
}

std::uint64_t expected_row_bytes(const Scene& scene, const Options& options) {
  constexpr std::uint64_t kBytesANode = 128;
  return options.rules.blocks ? kBytesANode * node_count(scene, options.rules) : 0;
}

}  // namespace shodo
