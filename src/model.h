// What stands behind shodo.h: the plain structures that the stages hand on, in one place. The program reads maps and
// tables from here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ambient/rounds.h"
#include "base/arena.h"
#include "light/direct.h"
#include "light/plane_light.h"
#include "map/illuminance_map.h"
#include "picture/picture.h"
#include "picture/seen_points.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "shodo/shodo.h"
#include "visibility/geometry.h"
#include "visibility/intersector.h"

namespace shodo {

struct alignas(8) Model {  // as the blocks behind it
  Model(void* memory, std::size_t bytes) : arena(memory, bytes) {}

  Arena arena;
  Options options;
  Reader reader;                   // of the pictures that the scene names
  Statistics statistics;
  Scene scene;
  Geometry geometry;
  Intersector intersector{geometry};
  std::span<Patch> patches;        // like all that is by patch: until the picture wants the memory
  FlagTables flags;                // of paper 3.1, and what was found; empty with flags off
  DirectLight direct;
  AmbientLight ambient;
  AmbientRounds rounds;
  IlluminanceMaps maps;
  PlaneMaps planes;
  std::uint64_t memory_bytes = 0;  // what the caller gave
  std::uint64_t overhead = 0;      // the part of it before the arena: this structure
  Arena::Mark after_scene = 0;
  Arena::Mark after_geometry = 0;  // then come the patches
  Arena::Mark after_patches = 0;
  std::uint32_t loaded_spares = 0;
  std::uint32_t near_light_count = 0;  // sub-patches that a point light may be near to, if they gather
  std::uint64_t picture_scratch = 0;  // bytes of prepare_picture(); found while the drawn triangles are there
  Arena::Mark before_maps = 0;     // what the picture is made of comes from here on
  Arena::Mark before_drawing = 0;
  Picture* picture = nullptr;      // between prepare_drawing() and finish_drawing()
  Statistics loaded;               // and what was counted until then
  bool solved = false;
  bool placed = true;              // blocking triangles are there: until the picture wants their memory
};

/// What every sample of the picture of a solved model sees. Errors: as draw().
Status see(Model& model, const Progress& progress, const SeenSink& sink);
/// The steps of load(), solve() and draw(), in this order. What one leaves to the next lies in the model, so that a
/// machine with little memory for code can hold one at a time (doc/determinism.md). Errors: those of load(), solve()
/// and draw().
Status start_loading(std::string_view name, std::string_view text, const Reader& reader, const Options& options,
                     void* memory, std::size_t bytes, Model*& model);
Status finish_loading(Model& model);
Status start_solving(Model& model);
Status solve_directly(Model& model, const Progress& progress);
/// As `rounds` say which is next, until they are done.
Status prepare_ambiently(Model& model, const Progress& progress);
Status solve_ambiently(Model& model, const Progress& progress);
Status send_over_mirrors(Model& model, const Progress& progress);
/// Direct light of measuring planes; and all once more, if the rows had the memory of the sub-patches'.
Status solve_again(Model& model, const Progress& progress);
Status solve_maps(Model& model, const Progress& progress);
Status start_drawing(Model& model, const Progress& progress);
Status prepare_drawing(Model& model);
Status finish_drawing(Model& model, const Progress& progress, const LineSink& sink);

}  // namespace shodo
