// Loading a scene file: read once to count and once to keep, then centre it and decide its counts.
//
// A mistake that shows only at the end (too many patches, a camera whose eye and look became one point) gets its place
// by a third reading that stops there.
#include "scene/scene_file.h"

#include "scene/finish.h"
#include "scene/ies_file.h"
#include "scene/patch_reflectance.h"
#include "scene/scene_store.h"
#include "scene/statements.h"
#include "scene/texture.h"
#include "scene/words.h"

namespace shodo {

namespace {

/// A camera's direction must outlive the centring of a scene that is huge against it.
bool check_cameras(const Scene& scene, Status& status, Wanted& wanted) {
  for (std::uint32_t k = 0; k < scene.cameras.size(); ++k) {
    if (scene.cameras[k].eye != scene.cameras[k].look) continue;
    status.code = StatusCode::kScene;
    MessageText(status.message, sizeof status.message)
        .add("expected a camera that looks at a point further from its eye, in a scene of this size");
    wanted = {Wanted::Kind::kCamera, k};
    return false;
  }
  return true;
}

/// Without effects the picture is drawn of illuminance maps and mean reflectances alone. What light may pass or be
/// mirrored by stays, and so does the place of everything and what patches reflect: maps are the same both ways.
void leave_out_effects(Scene& scene) {
  scene.effects = false;
  scene.background = {};
  scene.glass = {};
}

bool finish(Scene& scene, const Options& options, const Reader& reader, Arena& arena, Status& status,
            Wanted& wanted) {
  centre_scene(scene);
  if (!options.effects) leave_out_effects(scene);
  wanted.kind = Wanted::Kind::kTexture;
  if (!load_textures(scene, reader, arena, status, wanted.index)) return false;
  if constexpr (features::kLuminaires) {
    wanted.kind = Wanted::Kind::kLuminaire;
    if (!load_luminaires(scene, reader, arena, status, wanted.index)) return false;
  }
  wanted = {};
  place_lights(scene);
  decide_channels(scene);
  if (!check_cameras(scene, status, wanted) || !decide_counts(scene, options, status, wanted)) return false;
  if (!find_patch_reflectances(scene, reader, arena, status)) return false;
  if (!options.effects) scene.textures = {};
  return true;
}

bool load(Words& words, const Options& options, const Reader& reader, Arena& arena, Scene& scene, Status& status) {
  const Arena::Mark mark = arena.mark();
  SceneStore store(scene);
  SceneReading counting(words, store, arena, status);
  if (!read_statements(counting)) return false;
  if (!store.begin_storing(arena, status)) return false;
  SceneReading storing(words, store, arena, status);
  if (!read_statements(storing)) return false;
  if (!store.complete()) return changed_while_reading(storing);
  Wanted wanted;
  if (finish(scene, options, reader, arena, status, wanted)) return true;
  if (status.code == StatusCode::kMemory || status.line != 0) return false;
  store.begin_counting();
  arena.release(mark);
  SceneReading searching(words, store, arena, status);
  searching.wanted = wanted;
  return read_statements(searching) && false;
}

}  // namespace

Status load_scene(std::string_view name, std::string_view text, const Reader& reader, const Options& options,
                  Arena& arena, Scene& scene) {
  Status status = check_count_options(options);
  if (!status.done()) return status;
  const Arena::Mark mark = arena.mark();
  scene = {};
  Words words(name, text, reader, status);
  if (load(words, options, reader, arena, scene, status)) return status;
  scene = {};
  arena.release(mark);
  return status;
}

}  // namespace shodo
