// The pipeline of the paper behind shodo/shodo.h: place, light directly, light ambiently, map, draw.
//
// The model stands at the start of the caller's memory and its arena over the rest, so one number, the size of that
// memory, bounds everything. What load() leaves stays until the end; solve() starts from there each time it is called.
// Whether the memory suffices for all stages is decided after load() and before anything is lit (design: promise 2);
// what gives way where it is short, and comes back, is in model_memory.h.
#include "shodo/shodo.h"

#include <new>

#include "ambient/gather.h"
#include "ambient/plane_gather.h"
#include "ambient/sent_light.h"
#include "base/interrupted.h"
#include "base/self_check.h"
#include "base/text.h"
#include "memory_plan.h"
#include "model.h"
#include "model_memory.h"
#include "picture/picture.h"
#include "scene/scene_file.h"
#include "scene/texture.h"

namespace shodo {

namespace {

/// A stage's refusal counts from the start of the arena; the caller's number counts from the start of his memory.
Status with_model(Status status, std::uint64_t overhead) {
  if (status.code == StatusCode::kMemory && status.bytes_needed != 0) status.bytes_needed += overhead;
  return status;
}

Status too_small(std::uint64_t needed, std::uint64_t given) {
  Status status;
  status.code = StatusCode::kMemory;
  status.bytes_needed = needed;
  MessageText text(status.message, sizeof status.message);
  text.add("the memory budget is too small: expected at least ").add(needed).add(" bytes, found ").add(given);
  return status;
}

Status wrong_use(std::string_view what) {
  Status status;
  status.code = StatusCode::kUsage;
  MessageText(status.message, sizeof status.message).add(what);
  return status;
}

/// What the options ask of a library that is built without it (base/features.h); null if nothing.
const char* part_left_out(const Options& options) {
  const Rules& rules = options.rules;
  if (!features::kBlocks && rules.blocks) return "blocks";
  if (!features::kRules && (rules.rule1 || rules.rule2 || rules.rule2_repeated || rules.rule3)) return "rules";
  if (!features::kGather && options.gather) return "gathering";
  if (!features::kAims && options.flags == FlagMode::kScene) return "flags that a scene gives";
  return nullptr;
}

Status left_out(const char* part) {
  Status status;
  status.code = StatusCode::kUsage;
  TextBuilder(status.message, sizeof status.message).add("this library is built without ").add(part);
  return status;
}

void count_scene(Model& model) {
  Statistics& statistics = model.statistics;
  statistics.objects = static_cast<std::uint32_t>(model.scene.objects.size());
  statistics.meshes = static_cast<std::uint32_t>(model.scene.meshes.size());
  statistics.planes = static_cast<std::uint32_t>(model.scene.planes.size());
  statistics.plane_sub_patches = model.scene.plane_sub_patch_count;
  statistics.channels = model.scene.channels;
  statistics.lattice_step = model.geometry.lattice.step();
  statistics.vertices_inserted = model.geometry.inserted;
  statistics.vertices_moved = model.geometry.moved;
  statistics.polygons_dropped = model.scene.polygons_dropped;
  statistics.patches = 0;
  statistics.sub_patches = 0;
  for (const Patch& patch : model.patches) {
    if (patch.dropped != 0) continue;
    const Mesh& mesh = model.scene.meshes[patch.mesh];
    ++statistics.patches;
    statistics.sub_patches += mesh.su * mesh.sv;
  }
}

Status place(Model& model) {
  Status status = place_scene(model.scene, model.arena, model.geometry);
  if (!status.done()) return status;
  model.after_geometry = model.arena.mark();
  model.loaded_spares = model.arena.spares();
  if (features::gathers(model.options)) {
    model.near_light_count = SentLight::uneven_count(model.scene, model.geometry.lattice.step());
  }
  status = build_patches(model.scene, model.geometry, model.arena, model.patches, model.statistics);
  model.after_patches = model.arena.mark();
  return status;
}

void end_stage(Model& model, MemoryStage stage) {
  std::uint64_t& peak = model.statistics.stage_peak[static_cast<std::size_t>(stage)];
  const std::uint64_t bytes = model.overhead + model.arena.stage_peak();
  if (bytes > peak) peak = bytes;
  model.statistics.memory_peak = model.overhead + model.arena.peak();
  model.arena.start_stage();
}

/// What drawing took goes, and so do drawn triangles that aren't spare.
Status end_drawing(Model& model, const Status& status) {
  model.arena.release(model.before_drawing);
  if (!model.arena.holds(model.geometry.drawn)) model.geometry.drawn = {};
  end_stage(model, MemoryStage::kPicture);
  return with_model(status, model.overhead);
}

AmbientStage ambient_stage(Model& model, const Progress& progress) {
  return {model.scene, model.geometry, model.patches, model.direct,  model.intersector,
          model.options, progress, model.arena, model.ambient, model.statistics};
}

Status after_ambient_step(Model& model, const Status& status) {
  if (model.rounds.next == AmbientRounds::Step::kDone) end_stage(model, MemoryStage::kAmbient);
  return with_model(status, model.overhead);
}

}  // namespace

Status self_check() {
  Status status;
  const char* const fault = arithmetic_fault();
  if (fault == nullptr) return status;
  status.code = StatusCode::kFile;
  MessageText text(status.message, sizeof status.message);
  text.add("this machine's arithmetic would change pixels: expected ").add(fault).add(", found otherwise");
  return status;
}

Status start_loading(std::string_view name, std::string_view text, const Reader& reader, const Options& options,
                     void* memory, std::size_t bytes, Model*& model) {
  model = nullptr;
  if (const char* part = part_left_out(options); part != nullptr) return left_out(part);
  if (const Status fit = self_check(); !fit.done()) return fit;
  const std::size_t skew = reinterpret_cast<std::uintptr_t>(memory) % alignof(Model);
  const std::size_t skip = skew == 0 ? 0 : alignof(Model) - skew;
  const std::size_t overhead = skip + sizeof(Model);
  if (bytes < overhead) return too_small(overhead, bytes);
  std::byte* start = static_cast<std::byte*>(memory) + skip;
  Model* read = new (start) Model(start + sizeof(Model), bytes - overhead);
  read->options = options;
  read->reader = reader;
  read->memory_bytes = bytes;
  read->overhead = overhead;
  read->statistics.memory_budget = bytes;
  const Status status = load_scene(name, text, reader, options, read->arena, read->scene);
  if (!status.done()) return with_model(status, overhead);
  read->after_scene = read->arena.mark();
  model = read;
  return status;
}

Status finish_loading(Model& model) {
  const Status status = place(model);
  if (!status.done()) return with_model(status, model.overhead);
  count_scene(model);
  model.arena.pin_spares(0);
  model.picture_scratch = texel_bytes(model.scene) + picture_bytes(model.scene, model.geometry, model.options);
  model.statistics.stage_peak[0] = model.statistics.memory_peak = model.overhead + model.arena.peak();
  model.arena.start_stage();
  model.loaded = model.statistics;
  return status;
}

Status load(std::string_view name, std::string_view text, const Reader& reader, const Options& options, void* memory,
            std::size_t bytes, Model*& model) {
  Status status = start_loading(name, text, reader, options, memory, bytes, model);
  if (status.done()) status = finish_loading(*model);
  if (!status.done()) model = nullptr;
  return status;
}

Status start_solving(Model& model) {
  if (const Status fit = self_check(); !fit.done()) return fit;
  model.statistics = model.loaded;
  model.solved = false;
  model.rounds = {};
  const std::uint64_t needed = smallest_memory(model, false);
  if (needed > model.memory_bytes) return too_small(needed, model.memory_bytes);
  // Where they were others may lie by now: gone is gone.
  if (!model.arena.holds(model.geometry.drawn)) model.geometry.drawn = {};
  model.arena.release_spares(model.geometry.drawn.empty() ? 0 : model.loaded_spares);
  model.arena.pin_spares(0);
  Status status = place_again(model);
  if (status.done()) status = take_patches(model);
  if (!status.done()) return with_model(status, model.overhead);
  model.arena.start_stage();
  model.intersector = Intersector(model.geometry, model.scene, model.options.flags);
  if (!model.intersector.take_flags(model.arena)) status = model.arena.refused();
  return with_model(status, model.overhead);
}

Status solve_directly(Model& model, const Progress& progress) {
  const Status status = light_directly(model.scene, model.geometry, model.patches, model.options, model.intersector,
                                       progress, model.arena, model.direct, model.statistics);
  end_stage(model, MemoryStage::kDirect);
  return with_model(status, model.overhead);
}

Status prepare_ambiently(Model& model, const Progress& progress) {
  return after_ambient_step(model, model.rounds.prepare(ambient_stage(model, progress)));
}

Status solve_ambiently(Model& model, const Progress& progress) {
  return after_ambient_step(model, model.rounds.solve(ambient_stage(model, progress)));
}

Status send_over_mirrors(Model& model, const Progress& progress) {
  return after_ambient_step(model, model.rounds.send_over_mirrors(ambient_stage(model, progress)));
}

Status solve_again(Model& model, const Progress& progress) {
  model.before_maps = model.arena.mark();
  Status status;
  if (features::kPlanes && !model.scene.planes.empty()) {
    status = light_planes(model.scene, model.geometry, model.options, model.intersector, progress, model.arena,
                          model.planes, model.statistics);
  }
  if (status.done()) status = keep_sub_patches(model, progress);
  end_stage(model, MemoryStage::kDirect);
  return with_model(status, model.overhead);
}

Status solve_maps(Model& model, const Progress& progress) {
  if (!progress.go_on(Stage::kMap, 0, 1)) return interrupted();
  Status status;
  if (features::kPlanes && !model.scene.planes.empty()) {
    status = gather_planes({model.scene, model.geometry, model.patches, model.direct, model.ambient},
                           model.intersector, progress, model.arena, model.planes, model.statistics);
  }
  model.flags = model.intersector.flags();
  if (status.done()) {
    status = map_illuminance(model.scene, model.patches, model.direct, model.ambient, model.options, model.arena,
                             model.maps);
  }
  if (status.done() && features::gathers(model.options)) {
    status = gather_illuminance(model.scene, model.geometry, model.direct, model.near_light_count, model.intersector,
                                model.options, progress, model.arena, {model.ambient.patch_lx, model.direct.patch_lx},
                                model.maps.ambient_lx, model.statistics);
  }
  end_stage(model, MemoryStage::kMap);
  model.solved = status.done();
  return with_model(status, model.overhead);
}

Status solve(Model& model, const Progress& progress) {
  Status status = start_solving(model);
  if (status.done()) status = solve_directly(model, progress);
  while (status.done() && model.rounds.next != AmbientRounds::Step::kDone) {
    switch (model.rounds.next) {
      case AmbientRounds::Step::kPrepare: status = prepare_ambiently(model, progress); break;
      case AmbientRounds::Step::kSolve: status = solve_ambiently(model, progress); break;
      default: status = send_over_mirrors(model, progress);
    }
  }
  if (status.done()) status = solve_again(model, progress);
  return status.done() ? solve_maps(model, progress) : status;
}

Status start_drawing(Model& model, const Progress& progress) {
  if (const Status fit = self_check(); !fit.done()) return fit;
  if (!model.solved) return wrong_use("expected a solved model, found one that is only loaded");
  const std::uint64_t needed = smallest_memory(model);
  if (needed > model.memory_bytes) return too_small(needed, model.memory_bytes);
  if (!progress.go_on(Stage::kPicture, 0, 1)) return interrupted();
  model.arena.start_stage();
  const Status status = place_drawn_again(model);
  return status.done() ? status : end_drawing(model, status);
}

Status prepare_drawing(Model& model) {
  Status status;
  if (keep_texels(model.scene, model.reader, model.arena, status)) {
    status = prepare_picture(model.scene, model.geometry, model.maps, model.options, model.arena, model.picture);
  }
  if (status.done()) return status;
  forget_texels(model.scene);
  return end_drawing(model, status);
}

Status finish_drawing(Model& model, const Progress& progress, const LineSink& sink) {
  const Status status = draw_lines(*model.picture, model.options, progress, sink);
  forget_texels(model.scene);
  return end_drawing(model, status);
}

Status draw(Model& model, const Progress& progress, const LineSink& sink) {
  Status status = start_drawing(model, progress);
  if (status.done()) status = prepare_drawing(model);
  return status.done() ? finish_drawing(model, progress, sink) : status;
}

Status see(Model& model, const Progress& progress, const SeenSink& sink) {
  const Status status = start_drawing(model, progress);
  if (!status.done()) return status;
  return end_drawing(model, see_points(model.scene, model.geometry, model.options, progress, model.arena, sink));
}

const Statistics& statistics(const Model& model) { return model.statistics; }

std::uint64_t smallest_memory(const Model& model, bool picture) {
  return plan_memory(model, picture).peak();
}

const char* stage_name(Stage stage) {
  switch (stage) {
    case Stage::kLoad: return "load";
    case Stage::kDirect: return "direct";
    case Stage::kFormFactors: return "form_factors";
    case Stage::kSolution: return "solution";
    case Stage::kMap: return "map";
    case Stage::kPicture: return "picture";
  }
  return "";
}

}  // namespace shodo
