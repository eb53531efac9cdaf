#include "map/plane_maps.h"

namespace shodo {

Status measure_planes(const SolvedPatches& solved, const Options& options, Intersector& intersector,
                      const Progress& progress, Arena& arena, PlaneMaps& maps, Statistics& statistics) {
  if (!take_plane_maps(solved.scene, arena, maps)) return arena.refused();
  const ArenaScratch scratch(arena);
  const IntersectorScratch seeking(intersector);
  if (!intersector.start(arena)) return arena.refused();
  const auto segments = [&] {
    return intersector.segments(LightSet::kDirect) + intersector.segments(LightSet::kAmbient);
  };
  const auto tests = [&] { return intersector.tests(LightSet::kDirect) + intersector.tests(LightSet::kAmbient); };
  const std::uint64_t segments_before = segments(), tests_before = tests();
  Status status = light_planes(solved.scene, solved.geometry, options, intersector, progress, arena, maps);
  if (status.done()) status = gather_planes(solved, intersector, progress, arena, maps);
  statistics.segments_planes = segments() - segments_before;
  statistics.tests_planes = tests() - tests_before;
  return status;
}

}  // namespace shodo
