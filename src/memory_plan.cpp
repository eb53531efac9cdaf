#include "memory_plan.h"

#include "ambient/ambient_memory.h"
#include "ambient/surfaces.h"
#include "base/check.h"
#include "light/sources.h"
#include "model.h"

namespace shodo {

namespace {

constexpr unsigned kLoad = 1, kDirect = 2, kAmbient = 4, kAgain = 8, kMap = 16, kPicture = 32;
constexpr unsigned kLight = kDirect | kAmbient | kAgain | kMap;  // all that look at patches
constexpr unsigned kAll = kLoad | kLight | kPicture;

constexpr std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

std::uint64_t larger(std::uint64_t a, std::uint64_t b) { return a > b ? a : b; }

std::uint64_t drawn_bytes(const Model& model) {
  return rounded_up(sizeof(DrawnTriangle) * std::uint64_t{model.geometry.drawn_count});
}

/// What load() leaves, and what it takes meanwhile.
void plan_scene(const Model& model, MemoryPlan& plan) {
  plan.add("the model", "its structure, and up to 7 for alignment", model.overhead, kAll);
  plan.add("scene", "40 materials + 40 objects + 56 meshes + 24 vertices + 248 lights + 96 cameras + names; "
           "textures: 4/3 of their texels",
           model.after_scene, kAll);
  plan.add("triangles that block", "72 triangles + 8 polygons + 4 meshes + 20 lights",
           model.after_geometry - model.after_scene, kAll);
  plan.add("triangles of the picture", "68 drawn triangles; spare: given up while there is light to find",
           drawn_bytes(model), kLoad | kPicture);
  const std::uint64_t left = model.after_geometry + drawn_bytes(model) + model.overhead;
  plan.add("while placing", "16 vertices + 24 polygons + 12 insertions + a tree; then 72 n, the patches",
           model.loaded.stage_peak[0] - left, kLoad);
}

void plan_light(const Model& model, MemoryPlan& plan) {
  const Scene& scene = model.scene;
  const Options& options = model.options;
  plan.add("flags", "2 (objects + lights)", options.flags == FlagMode::kOff ? 0 : FlagTables::bytes(scene), kLight);
  plan.add("direct light of the patches", "(8 c + 8) n", direct_patch_bytes(scene), kLight);
  plan.add("possible blockers", "32 facets + 24 boxes + 8 facets", Intersector::bytes(model.geometry, options.flags),
           kDirect | kAgain | (scene.patch_count > 0 ? kAmbient : 0));
  plan.add("light sources", "4,096 + 112 lights + 168 faces that emit + 44 ends of segments", Sources::bytes(scene),
           kDirect | kAgain);
  const std::uint64_t result = ambient_result_bytes(scene);
  const std::uint64_t surfaces = surfaces_bytes(scene, options, SurfacesKeep::kNothing);
  const std::uint64_t ambient = smallest_ambient_bytes(scene, model.geometry, options, SurfacesKeep::kNothing);
  plan.add("ambient light of the patches", "8 c n", result, kAmbient | kAgain | kMap);
  const std::uint64_t links = link_bytes(scene, model.geometry, options);
  plan.add("surfaces", "12 a node + 32 blocks + 33 meshes (9 with blocks) + 3,716; their geometry is found again",
           surfaces, kAmbient);
  plan.add("which nodes are linked", "2 n a level of blocks; with blocks 20 a node + 4 blocks + 32 meshes + 12,288 + "
           "17 facets", links, kAmbient);
  plan.add("solution", "16 c + 8 a node (+ 2 with rules 1 and 2, 16 with 2+) + one row + the coarse correction; "
           "rows: what is left", ambient - result - surfaces - links, kAmbient);
  plan.add("direct light of the sub-patches", "(4 c + 1) s; spare: given up to the rows", direct_sub_patch_bytes(scene),
           kAgain | kMap | kPicture);
}

void plan_picture(const Model& model, MemoryPlan& plan) {
  const Scene& scene = model.scene;
  const std::uint64_t maps = rounded_up(4 * std::uint64_t{scene.sub_patch_count} * scene.channels);
  plan.add("ambient maps", "4 c s", maps, kMap | kPicture);
  plan.add("spreading over a mesh", "9 a patch + 8 a row of sub-patches, of the largest mesh",
           map_bytes(scene, model.options) - maps, kMap);
  plan.add("drawing, or placing again", "2 c s + 8193 + (4 c + 3) width + 4 rows + 10 drawn + 208 active triangles",
           larger(model.geometry.placing_bytes, model.picture_scratch), kPicture);
}

}  // namespace

const char* plan_stage_name(PlanStage stage) {
  switch (stage) {
    case PlanStage::kLoad: return "load";
    case PlanStage::kDirect: return "direct";
    case PlanStage::kAmbient: return "ambient";
    case PlanStage::kDirectAgain: return "direct again";
    case PlanStage::kMap: return "map";
    case PlanStage::kPicture: return "picture";
  }
  return "";
}

void MemoryPlan::add(const char* name, const char* formula, std::uint64_t bytes, unsigned stages) {
  SHODO_CHECK(parts < kMostParts);
  part[parts++] = {name, formula, bytes, static_cast<std::uint8_t>(stages)};
  for (std::size_t k = 0; k < kPlanStages; ++k) stage[k] += part[parts - 1].in(k) ? bytes : 0;
}

std::uint64_t MemoryPlan::peak() const {
  std::uint64_t most = 0;
  for (const std::uint64_t bytes : stage) most = larger(most, bytes);
  return most;
}

std::uint64_t drawn_and_picture_bytes(const Model& model) {
  return drawn_bytes(model) + larger(model.geometry.placing_bytes, model.picture_scratch);
}

MemoryPlan plan_memory(const Model& model, bool picture) {
  MemoryPlan plan;
  plan_scene(model, plan);
  plan_light(model, plan);
  plan_picture(model, plan);
  if (!picture) plan.stage[static_cast<std::size_t>(PlanStage::kPicture)] = 0;
  return plan;
}

bool keeps_geometry(const Model& model) {
  const Scene& scene = model.scene;
  const Options& options = model.options;
  const std::uint64_t flags = options.flags == FlagMode::kOff ? 0 : FlagTables::bytes(scene);
  const std::uint64_t blockers = Intersector::bytes(model.geometry, options.flags);
  const std::uint64_t patches = model.after_patches + flags + direct_patch_bytes(scene);
  const std::uint64_t solved = patches + ambient_result_bytes(scene) + direct_sub_patch_bytes(scene);
  const std::uint64_t ambient = smallest_ambient_bytes(scene, model.geometry, options, SurfacesKeep::kGeometry);
  const std::uint64_t rows = expected_row_bytes(scene, options);
  // Geometry costs less to find again than the direct light that would have to make room for it.
  std::uint64_t most = patches + blockers + ambient + rows + (rows > 0 ? direct_sub_patch_bytes(scene) : 0);
  most = larger(most, solved + blockers + Sources::bytes(scene));
  most = larger(most, solved + map_bytes(scene, options));
  return most <= model.arena.capacity();
}

}  // namespace shodo
