// The pipeline of the paper behind shodo/shodo.h: place, light directly, light ambiently, map, draw.
//
// The model stands at the start of the caller's memory and its arena over the rest, so one number, the size of that
// memory, bounds everything. What load() leaves stays until the end; solve() starts from there each time it is called.
// Whether the memory suffices for all stages is decided after load() and before anything is lit (design: promise 2).
#include "shodo/shodo.h"

#include <new>

#include "base/self_check.h"
#include "base/text.h"
#include "memory_plan.h"
#include "model.h"
#include "picture/picture.h"
#include "scene/scene_file.h"

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
  TextBuilder text(status.message, sizeof status.message);
  text.add("the memory budget is too small: expected at least ").add(needed).add(" bytes, found ").add(given);
  return status;
}

Status wrong_use(std::string_view what) {
  Status status;
  status.code = StatusCode::kUsage;
  TextBuilder(status.message, sizeof status.message).add(what);
  return status;
}

Status interrupted() {
  Status status;
  status.code = StatusCode::kInterrupted;
  TextBuilder(status.message, sizeof status.message).add("interrupted");
  return status;
}

void count_scene(Model& model) {
  Statistics& statistics = model.statistics;
  statistics.objects = static_cast<std::uint32_t>(model.scene.objects.size());
  statistics.meshes = static_cast<std::uint32_t>(model.scene.meshes.size());
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

Status load_and_place(std::string_view name, std::string_view text, const Reader& reader, Model& model) {
  Status status = load_scene(name, text, reader, model.options, model.arena, model.scene);
  if (!status.done()) return status;
  status = place_scene(model.scene, model.arena, model.geometry);
  if (!status.done()) return status;
  return build_patches(model.scene, model.geometry, model.arena, model.patches, model.statistics);
}

Status light_and_map(Model& model, const Progress& progress) {
  Intersector intersector(model.geometry, model.scene, model.options.flags);
  if (!intersector.take_flags(model.arena)) return model.arena.refused();
  Status status = light_directly(model.scene, model.geometry, model.patches, intersector, progress, model.arena,
                                 model.direct, model.statistics);
  if (!status.done()) return status;
  status = light_ambiently(model.scene, model.geometry, model.patches, model.direct, intersector, model.options,
                           progress, model.arena, model.ambient, model.statistics);
  if (!status.done()) return status;
  model.flags = intersector.flags();
  if (!progress.go_on(Stage::kMap, 0, 1)) return interrupted();
  return map_illuminance(model.scene, model.patches, model.direct, model.ambient, model.options, model.arena,
                         model.maps);
}

}  // namespace

Status self_check() {
  Status status;
  const char* const fault = arithmetic_fault();
  if (fault == nullptr) return status;
  status.code = StatusCode::kFile;
  TextBuilder text(status.message, sizeof status.message);
  text.add("this machine's arithmetic would change pixels: expected ").add(fault).add(", found otherwise");
  return status;
}

Status load(std::string_view name, std::string_view text, const Reader& reader, const Options& options, void* memory,
            std::size_t bytes, Model*& model) {
  model = nullptr;
  if (const Status fit = self_check(); !fit.done()) return fit;
  const std::size_t skew = reinterpret_cast<std::uintptr_t>(memory) % alignof(Model);
  const std::size_t skip = skew == 0 ? 0 : alignof(Model) - skew;
  const std::size_t overhead = skip + sizeof(Model);
  if (bytes < overhead) return too_small(overhead, bytes);
  std::byte* start = static_cast<std::byte*>(memory) + skip;
  Model* loaded = new (start) Model(start + sizeof(Model), bytes - overhead);
  loaded->options = options;
  loaded->memory_bytes = bytes;
  loaded->overhead = overhead;
  loaded->statistics.memory_budget = bytes;
  const Status status = load_and_place(name, text, reader, *loaded);
  if (!status.done()) return with_model(status, overhead);
  count_scene(*loaded);
  loaded->load_peak = loaded->arena.peak();
  loaded->after_load = loaded->arena.mark();
  loaded->statistics.memory_peak = overhead + loaded->arena.peak();
  loaded->loaded = loaded->statistics;
  model = loaded;
  return status;
}

Status solve(Model& model, const Progress& progress) {
  if (const Status fit = self_check(); !fit.done()) return fit;
  model.arena.release(model.after_load);
  model.statistics = model.loaded;
  model.solved = false;
  const std::uint64_t needed = smallest_memory(model, false);
  if (needed > model.memory_bytes) return too_small(needed, model.memory_bytes);
  const Status status = light_and_map(model, progress);
  model.statistics.memory_peak = model.overhead + model.arena.peak();
  model.solved = status.done();
  return with_model(status, model.overhead);
}

Status draw(Model& model, const Progress& progress, const LineSink& sink) {
  if (const Status fit = self_check(); !fit.done()) return fit;
  if (!model.solved) return wrong_use("expected a solved model, found one that is only loaded");
  const std::uint64_t needed = smallest_memory(model);
  if (needed > model.memory_bytes) return too_small(needed, model.memory_bytes);
  const ArenaScratch scratch(model.arena);
  if (!progress.go_on(Stage::kPicture, 0, 1)) return interrupted();
  const Status status =
      draw_picture(model.scene, model.geometry, model.maps, model.options, progress, model.arena, sink);
  model.statistics.memory_peak = model.overhead + model.arena.peak();
  return with_model(status, model.overhead);
}

const Statistics& statistics(const Model& model) { return model.statistics; }

std::uint64_t smallest_memory(const Model& model, bool picture) {
  return model.overhead + plan_memory(model, picture).peak();
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
