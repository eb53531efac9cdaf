#include "memory_plan.h"

#include "ambient/ambient_memory.h"
#include "light/sources.h"
#include "model.h"
#include "picture/picture.h"

namespace shodo {

namespace {

/// A block of the arena.
template <class T>
std::uint64_t block(std::uint64_t count) {
  return (count * sizeof(T) + 7) / 8 * 8;
}

/// Stays when the stage is done: DirectLight.
std::uint64_t direct_result_bytes(const Scene& scene) {
  const std::uint64_t n = scene.patch_count, c = scene.channels, s = scene.sub_patch_count;
  return block<float>(s * c) + block<std::uint8_t>(s) + block<double>(n * c) + 2 * block<float>(n);
}

/// Stays when the stage is done: IlluminanceMaps.
std::uint64_t map_result_bytes(const Scene& scene) {
  return block<float>(std::uint64_t{scene.sub_patch_count} * scene.channels);
}

}  // namespace

std::uint64_t MemoryPlan::peak() const {
  std::uint64_t most = load;
  for (const std::uint64_t bytes : {direct, ambient, map, picture}) {
    if (bytes > most) most = bytes;
  }
  return most;
}

MemoryPlan plan_memory(const Model& model, bool picture) {
  const Scene& scene = model.scene;
  MemoryPlan plan;
  plan.load = model.load_peak;
  const std::uint64_t flags = model.options.flags == FlagMode::kOff ? 0 : FlagTables::bytes(scene);
  const std::uint64_t blockers = Intersector::bytes(model.geometry, model.options.flags);
  std::uint64_t held = model.after_load + flags + direct_result_bytes(scene);
  plan.direct = held + blockers + Sources::bytes(scene);
  plan.ambient = held + (scene.patch_count > 0 ? blockers : 0) + smallest_ambient_bytes(scene, model.geometry, model.options);
  held += ambient_result_bytes(scene);
  plan.map = held + map_bytes(scene, model.options);
  held += map_result_bytes(scene);
  if (picture) plan.picture = held + picture_bytes(scene, model.geometry, model.options);
  return plan;
}

}  // namespace shodo
