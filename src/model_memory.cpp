#include "model_memory.h"

#include "memory_plan.h"

namespace shodo {

namespace {

template <class T>
void move_down(std::span<T>& block, std::size_t bytes) {
  // A block of the arena: T stands on a multiple of its size from its start.
  if (!block.empty()) block = {block.data() - bytes / sizeof(T), block.size()};
}

/// What the picture is made of takes the place of what lies from `to` on.
void lower_maps(Model& model, Arena::Mark to) {
  const bool with_direct = !model.arena.holds(model.direct.sub_patch_lx);
  const std::size_t by = model.arena.lower(model.before_maps, to);
  model.before_maps = to;
  move_down(model.planes.direct_lx, by);
  move_down(model.planes.ambient_lx, by);
  move_down(model.planes.hidden, by);
  move_down(model.maps.ambient_lx, by);
  if (with_direct) {
    move_down(model.direct.sub_patch_lx, by);
    move_down(model.direct.hidden, by);
    model.maps.direct_lx = model.direct.sub_patch_lx;
    model.maps.hidden = model.direct.hidden;
  }
}

/// Patches and all that is by patch go.
void give_up_patches(Model& model) {
  lower_maps(model, model.after_geometry);
  model.patches = {};
  model.flags = {};
  model.direct.patch_lx = {};
  model.direct.visible_area = model.direct.light_form_factor = {};
  model.ambient = {};
}

/// And what blocks.
void give_up_triangles(Model& model) {
  Geometry& geometry = model.geometry;
  lower_maps(model, geometry.before_triangles);
  geometry.triangles = {};
  geometry.panes = {};
  geometry.cells = geometry.light_triangles = {};
  geometry.first_cell = {};
  model.placed = false;
}

}  // namespace

Status take_patches(Model& model) {
  if (!keeps_geometry(model)) {
    model.arena.release(model.after_geometry);
    model.patches = {};
    model.statistics.geometry_again = 1;
    return {};
  }
  if (!model.patches.empty()) {
    model.arena.release(model.after_patches);
    return {};
  }
  model.arena.release(model.after_geometry);
  const Statistics counted = model.statistics;
  const Status status = build_patches(model.scene, model.geometry, model.arena, model.patches, model.statistics);
  model.statistics = counted;
  return status;
}

Status keep_sub_patches(Model& model, const Progress& progress) {
  Arena& arena = model.arena;
  DirectLight& direct = model.direct;
  const bool held = !direct.hidden.empty() && arena.holds(direct.hidden) && arena.holds(direct.sub_patch_lx);
  arena.pin_spares(held ? arena.spares() : 0);
  if ((held || model.scene.sub_patch_count == 0) && maps_bytes(model) <= arena.left()) return {};
  arena.release_spares(model.loaded_spares);
  arena.pin_spares(0);
  const Statistics counted = model.statistics;
  const Status status = light_directly(model.scene, model.geometry, model.patches, model.options, model.intersector,
                                       progress, arena, direct, model.statistics, DirectKeeps::kSubPatches);
  model.statistics = counted;
  model.statistics.lit_again = 1;
  return status;
}

Status place_again(Model& model) {
  if (model.placed) return {};
  model.arena.release(model.after_scene);
  model.arena.pin_spares(0);
  model.arena.release_spares(0);
  const Statistics counted = model.statistics;
  const Status status = place_scene(model.scene, model.arena, model.geometry);
  model.statistics = counted;
  model.loaded_spares = model.arena.spares();
  model.arena.pin_spares(0);
  model.placed = status.done();
  return status;
}

Status place_drawn_again(Model& model) {
  Geometry& geometry = model.geometry;
  Arena& arena = model.arena;
  const bool held = arena.holds(geometry.drawn) && geometry.drawn.size() == geometry.drawn_count;
  arena.pin_spares(arena.spares());
  const std::uint64_t wanted = held ? model.picture_scratch : drawn_and_picture_bytes(model);
  if (wanted > arena.left() && model.placed) give_up_patches(model);
  if (wanted > arena.left() && model.placed) give_up_triangles(model);
  model.before_drawing = arena.mark();
  if (held) return {};
  model.statistics.placed_again = 1;
  return place_drawn(model.scene, arena, geometry) ? Status() : arena.refused();
}

}  // namespace shodo
