#include "ambient/coloured_panes.h"

namespace shodo {

Status light_ambiently_through_panes(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                                     const DirectLight& direct, Intersector& intersector, const Options& options,
                                     const Progress& progress, Arena& arena, AmbientLight& ambient,
                                     Statistics& statistics) {
  if (!intersector.panes().coloured()) {
    return light_ambiently(scene, geometry, patches, direct, intersector, options, progress, arena, ambient,
                           statistics);
  }
  const std::size_t values = std::size_t{scene.patch_count} * scene.channels;
  if (!arena.take("ambient illuminance of all channels", values, ambient.patch_lx)) return arena.refused();
  for (std::uint32_t c = 0; c < scene.channels; ++c) {
    const ArenaScratch scratch(arena);
    AmbientLight one;
    intersector.set_channel(c);
    const Status status = light_ambiently(scene, geometry, patches, direct, intersector, options, progress, arena,
                                          one, statistics);
    intersector.set_channel(0);
    if (!status.done()) return status;
    for (std::size_t k = c; k < values; k += scene.channels) ambient.patch_lx[k] = one.patch_lx[k];
  }
  return {};
}

std::uint64_t coloured_panes_bytes(const Scene& scene, const Geometry& geometry) {
  return Panes(geometry).coloured() ? 8 * std::uint64_t{scene.patch_count} * scene.channels : 0;
}

}  // namespace shodo
