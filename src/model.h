// What stands behind shodo.h: the plain structures that the stages hand on, in one place. The program reads maps and
// tables from here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ambient/ambient.h"
#include "base/arena.h"
#include "light/direct.h"
#include "map/illuminance_map.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "shodo/shodo.h"
#include "visibility/geometry.h"
#include "visibility/intersector.h"

namespace shodo {

struct Model {
  Model(void* memory, std::size_t bytes) : arena(memory, bytes) {}

  Arena arena;
  Options options;
  Statistics statistics;
  Scene scene;
  Geometry geometry;
  std::span<Patch> patches;
  FlagTables flags;                // of paper 3.1, and what was found; empty with flags off
  DirectLight direct;
  AmbientLight ambient;
  IlluminanceMaps maps;
  std::uint64_t memory_bytes = 0;  // what the caller gave
  std::uint64_t overhead = 0;      // the part of it before the arena: this structure
  std::uint64_t load_peak = 0;     // of the arena
  Arena::Mark after_load = 0;      // what solve() starts from
  Statistics loaded;               // and what was counted until then
  bool solved = false;
};

}  // namespace shodo
