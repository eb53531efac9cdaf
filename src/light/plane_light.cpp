#include "light/plane_light.h"

#include "base/finite.h"
#include "base/interrupted.h"
#include "light/mirror_light.h"
#include "light/sources.h"
#include "light/sub_patch_light.h"

namespace shodo {

namespace {

constexpr std::uint32_t kProgressInterval = 64;

/// As of a surface's sub-patch (light/direct.cpp): through coloured panes every channel by itself.
SubPatchLight plane_light(Sources& sources, MirrorLight& mirrors, const Receiver& receiver, const Piece& piece) {
  Intersector& intersector = sources.intersector();
  const bool thin = is_thin(sources.geometry().lattice, piece), coloured = intersector.panes().coloured();
  SubPatchLight light = light_sub_patch(sources, receiver, piece, thin);
  for (std::uint32_t c = 1; c < sources.scene().channels && coloured; ++c) {
    intersector.set_channel(c);
    light.lux[c] = light_sub_patch(sources, receiver, piece, thin).lux[c];
  }
  intersector.set_channel(0);
  if (mirrors.any() && !light.hidden) mirrors.add(receiver, piece, thin, light.lux);
  return light;
}

constexpr std::uint64_t block(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

PlaneReceiver::PlaneReceiver(const Geometry& geometry, const Plane& plane) {
  const std::uint32_t count = lattice_quad(geometry.lattice, plane.corners, triangles_);
  receiver_.own = std::span<const Triangle>(triangles_, count);
  receiver_.front = flat_front(receiver_.own);
  receiver_.object = kNone;  // no flags: always tested
  receiver_.normal = normalised(plane_piece(plane).vector_area());
  receiver_.anchor = plane.corners[0];
}

bool take_plane_maps(const Scene& scene, Arena& arena, PlaneMaps& maps) {
  const std::size_t count = scene.plane_sub_patch_count, values = count * scene.channels;
  return arena.take("direct light of planes", values, maps.direct_lx) &&
         arena.take("ambient light of planes", values, maps.ambient_lx) &&
         arena.take("hidden sub-patches of planes", count, maps.hidden);
}

std::uint64_t plane_map_bytes(const Scene& scene) {
  const std::uint64_t count = scene.plane_sub_patch_count;
  return 2 * block(4 * count * scene.channels) + block(count);
}

Status light_planes(const Scene& scene, const Geometry& geometry, const Options& options, Intersector& intersector,
                    const Progress& progress, Arena& arena, PlaneMaps& maps, Statistics& statistics) {
  if (!take_plane_maps(scene, arena, maps)) return arena.refused();
  const ArenaScratch scratch(arena);
  const IntersectorScratch seeking(intersector);
  if (!intersector.start(arena)) return arena.refused();
  Sources sources(scene, geometry, intersector, options.tiers);
  Status status = sources.prepare(arena);
  if (!status.done()) return status;
  MirrorLight mirrors(sources);
  if (options.mirror_light && !mirrors.take(arena)) return arena.refused();
  sources.start_patch({}, false);
  statistics.segments_planes -= intersector.segments(LightSet::kDirect);
  statistics.tests_planes -= intersector.tests(LightSet::kDirect);
  for (const Plane& plane : scene.planes) {
    const PlaneReceiver receiver(geometry, plane);
    for (std::uint32_t local = 0; local < plane.sub_patch_count(); ++local) {
      const std::uint32_t index = plane.first_sub_patch + local;
      if (index % kProgressInterval == 0 && !progress.go_on(Stage::kMap, index, 2 * scene.plane_sub_patch_count)) {
        return interrupted();
      }
      SubPatchLight light;
      light.hidden = !receiver.there();
      if (receiver.there()) light = plane_light(sources, mirrors, receiver.receiver(), plane_sub_patch(plane, local));
      maps.hidden[index] = light.hidden ? 1 : 0;
      for (std::uint32_t c = 0; c < scene.channels && !light.hidden; ++c) {
        maps.direct_lx[std::size_t{index} * scene.channels + c] = static_cast<float>(finite(light.lux[c]));
      }
    }
  }
  statistics.segments_planes += intersector.segments(LightSet::kDirect);
  statistics.tests_planes += intersector.tests(LightSet::kDirect);
  return {};
}

}  // namespace shodo
