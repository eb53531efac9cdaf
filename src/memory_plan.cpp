#include "memory_plan.h"

#include "ambient/ambient_memory.h"
#include "light/sources.h"
#include "model.h"

namespace shodo {

namespace {

constexpr std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

std::uint64_t larger(std::uint64_t a, std::uint64_t b) { return a > b ? a : b; }

}  // namespace

std::uint64_t MemoryPlan::peak() const {
  std::uint64_t most = load;
  for (const std::uint64_t bytes : {direct, ambient, direct_again, map, picture}) most = larger(most, bytes);
  return most;
}

std::uint64_t drawn_and_picture_bytes(const Model& model) {
  const std::uint64_t drawn = rounded_up(sizeof(DrawnTriangle) * std::uint64_t{model.geometry.drawn_count});
  return drawn + larger(model.geometry.placing_bytes, model.picture_scratch);
}

MemoryPlan plan_memory(const Model& model, bool picture) {
  const Scene& scene = model.scene;
  const std::uint64_t flags = model.options.flags == FlagMode::kOff ? 0 : FlagTables::bytes(scene);
  const std::uint64_t blockers = Intersector::bytes(model.geometry, model.options.flags);
  const std::uint64_t patches = model.after_patches + flags + direct_patch_bytes(scene);
  const std::uint64_t solved = patches + ambient_result_bytes(scene);
  const std::uint64_t sub_patches = direct_sub_patch_bytes(scene);
  MemoryPlan plan;
  plan.load = model.loaded.stage_peak[0] - model.overhead;
  plan.direct = patches + blockers + Sources::bytes(scene);
  plan.ambient = patches + (scene.patch_count > 0 ? blockers : 0) + smallest_ambient_bytes(scene, model.options);
  plan.direct_again = solved + sub_patches + blockers + Sources::bytes(scene);
  plan.map = solved + sub_patches + map_bytes(scene, model.options);
  const std::uint64_t maps = rounded_up(4 * std::uint64_t{scene.sub_patch_count} * scene.channels);
  if (picture) plan.picture = model.after_geometry + sub_patches + maps + drawn_and_picture_bytes(model);
  return plan;
}

}  // namespace shodo
