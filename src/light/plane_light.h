// Direct illuminance on measuring planes (ours; the paper has none): the same area means as on sub-patches of surfaces.
//
// A plane only receives, so all that direct light needs of it is a receiver. It has no triangles among those that
// block: its samples stand in front of two of its own, so that a plane in a table's top measures what the top receives.
// On a surface that isn't square to an axis the two are rounded apart by a lattice step or two, and a plane has to be
// put a hair above. Exact and approximate: as light/sub_patch_light.h. Bytes left: 8 c + 1 a sub-patch of a plane.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/receiver.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"
#include "shodo/status.h"
#include "visibility/intersector.h"

namespace shodo {

/// Of all planes: [plane.first_sub_patch + local], times channels for lux.
struct PlaneMaps {
  std::span<float> direct_lx, ambient_lx;  // area means, and values at the centres; 0 where hidden
  std::span<std::uint8_t> hidden;          // 1: inside or under something
};

/// A plane on the lattice.
class PlaneReceiver {
 public:
  PlaneReceiver(const Geometry& geometry, const Plane& plane);
  PlaneReceiver(const PlaneReceiver&) = delete;
  PlaneReceiver& operator=(const PlaneReceiver&) = delete;

  const Receiver& receiver() const { return receiver_; }
  /// Has it an area on the lattice? Else it receives nothing.
  bool there() const { return !receiver_.own.empty(); }

 private:
  Triangle triangles_[2];
  Receiver receiver_;
};

/// False if the arena is too small.
bool take_plane_maps(const Scene& scene, Arena& arena, PlaneMaps& maps);
std::uint64_t plane_map_bytes(const Scene& scene);

/// Takes the maps, which stay, and fills `direct_lx` and `hidden`; counts segments and tests. Errors: kMemory,
/// kInterrupted.
Status light_planes(const Scene& scene, const Geometry& geometry, const Options& options, Intersector& intersector,
                    const Progress& progress, Arena& arena, PlaneMaps& maps, Statistics& statistics);

}  // namespace shodo
