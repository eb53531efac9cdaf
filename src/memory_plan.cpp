#include "memory_plan.h"

#include "ambient/ambient_memory.h"
#include "ambient/gather.h"
#include "ambient/plane_gather.h"
#include "ambient/rounds.h"
#include "ambient/surfaces.h"
#include "base/check.h"
#include "light/mirror_light.h"
#include "light/sources.h"
#include "model.h"

namespace shodo {

namespace {

constexpr unsigned kLoad = 1, kDirect = 2, kAmbient = 4, kAgain = 8, kMap = 16, kPicture = 32;
constexpr unsigned kLight = kDirect | kAmbient | kAgain | kMap;  // all that look at patches
constexpr unsigned kAll = kLoad | kLight | kPicture;

constexpr std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

std::uint64_t larger(std::uint64_t a, std::uint64_t b) { return a > b ? a : b; }

std::uint64_t map_value_bytes(const Scene& scene) {
  return rounded_up(4 * std::uint64_t{scene.sub_patch_count} * scene.channels);
}

std::uint64_t drawn_bytes(const Model& model) {
  return rounded_up(sizeof(DrawnTriangle) * std::uint64_t{model.geometry.drawn_count});
}

std::uint64_t mirror_bytes(const Model& model) {
  return model.options.mirror_light ? MirrorLight::bytes(model.scene, model.geometry) : 0;
}

/// What load() leaves, and what it takes meanwhile.
void plan_scene(const Model& model, MemoryPlan& plan) {
  plan.add(PlanPart::kModel, model.overhead, kAll);
  plan.add(PlanPart::kScene, model.geometry.before_triangles, kAll);
  plan.add(PlanPart::kTriangles, model.after_geometry - model.geometry.before_triangles, kLoad | kLight);
  plan.add(PlanPart::kDrawn, drawn_bytes(model), kLoad | kPicture);
  const std::uint64_t left = model.after_geometry + drawn_bytes(model) + model.overhead;
  plan.add(PlanPart::kPlacing, model.loaded.stage_peak[0] - left, kLoad);
}

void plan_light(const Model& model, MemoryPlan& plan) {
  const Scene& scene = model.scene;
  const Options& options = model.options;
  plan.add(PlanPart::kFlags, features::aims(options.flags) ? FlagTables::bytes(scene) : 0, kLight);
  plan.add(PlanPart::kDirectLight, direct_patch_bytes(scene), kLight);
  plan.add(PlanPart::kBlockers, Intersector::bytes(model.geometry, options.flags),
           kDirect | kAgain | (scene.patch_count > 0 ? kAmbient : 0));
  plan.add(PlanPart::kSources, Sources::bytes(scene),
           kDirect | kAgain);
  if (const std::uint64_t mirrors = mirror_bytes(model); mirrors > 0) {
    plan.add(PlanPart::kMirrors, mirrors, kDirect | kAgain);
  }
  const std::uint64_t result = ambient_result_bytes(scene);
  const std::uint64_t surfaces = surfaces_bytes(scene, options, SurfacesKeep::kNothing);
  const std::uint64_t ambient = smallest_ambient_bytes(scene, model.geometry, options, SurfacesKeep::kNothing);
  plan.add(PlanPart::kAmbientLight, result, kAmbient | kAgain | kMap);
  const std::uint64_t links = link_bytes(scene, model.geometry, options);
  plan.add(PlanPart::kSurfaces, surfaces, kAmbient);
  plan.add(PlanPart::kLinks, links, kAmbient);
  plan.add(PlanPart::kSolution, ambient - result - surfaces - links, kAmbient);
  if (const std::uint64_t rounds = rounds_bytes(scene, model.geometry, options); rounds > 0) {
    plan.add(PlanPart::kAmbientOptics, rounds, kAmbient);
  }
  plan.add(PlanPart::kSubPatches, direct_sub_patch_bytes(scene), kAgain | kMap | kPicture);
}

/// Nothing for scenes without planes.
void plan_planes(const Model& model, MemoryPlan& plan) {
  if (!features::kPlanes || model.scene.planes.empty()) return;
  plan.add(PlanPart::kPlanes, plane_map_bytes(model.scene), kAgain | kMap | kPicture);
  plan.add(PlanPart::kMeasuring, plane_gather_bytes(model.scene), kAgain);
}

void plan_picture(const Model& model, MemoryPlan& plan) {
  const Scene& scene = model.scene;
  const std::uint64_t maps = map_value_bytes(scene);
  plan.add(PlanPart::kMaps, maps, kMap | kPicture);
  plan.add(PlanPart::kSpreading, maps_bytes(model) - maps, kMap);
  plan.add(PlanPart::kDrawing, larger(model.geometry.placing_bytes, model.picture_scratch), kPicture);
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

PartText plan_part_text(PlanPart part) {
  static constexpr PartText kTexts[] = {
      {"the model", "its structure, and up to 7 for alignment"},
      {"scene",
       "40 materials + 40 objects + 48 meshes + 24 vertices + 248 lights + 96 cameras + 136 planes + names; "
       "24 textured meshes + 4 c a patch of one; 128 luminaires + 4 a candela and angle"},
      {"triangles that block", "72 triangles + 8 polygons + 4 meshes + 8 lights"},
      {"triangles of the picture", "68 drawn triangles; spare: given up while there is light to find"},
      {"while placing",
       "16 vertices + 24 polygons + 12 insertions + a tree; then 72 n, the patches; before, with obj: 24 of its "
       "vertices + 64 `usemtl` + 46 corners of its largest face"},
      {"flags", "2 (objects + lights)"},
      {"direct light of the patches", "(8 c + 8) n"},
      {"possible blockers", "32 facets + 24 boxes + 8 facets"},
      {"light sources", "4,096 + 400 lights + 168 faces that emit + 44 ends of segments"},
      {"mirrors that send light on", "48 a triangle, with --mirror-light on"},
      {"ambient light of the patches", "8 c n"},
      {"surfaces", "12 a node + 32 blocks + 33 meshes (9 with blocks) + 3,716; their geometry is found again"},
      {"which nodes are linked",
       "2 n a level of blocks; with blocks 20 a node + 4 blocks + "
       "32 meshes + 39 facets (24 of them in steps of 64)"},
      {"solution",
       "16 c + 8 a node (16 more in grey, + 2 with rules 1 and 2, 16 with 2+) + one "
       "row + the coarse correction + 2,300; rows: what is left"},
      {"ambient light by channel, over mirrors", "8 c n where panes are coloured, 24 c n with --mirror-light on"},
      {"direct light of the sub-patches", "(4 c + 1) s; spare: given up to the rows"},
      {"light of measuring planes", "(8 c + 1) sub-patches of planes"},
      {"while measuring", "(44 + 8 c) sub-patches of a plane's patch"},
      {"ambient maps", "4 c s"},
      {"spreading over a mesh, or gathering",
       "9 a patch + 8 a row of sub-patches, of the largest mesh; --gather: 52 polygons + 4 triangles + "
       "(2 c + 5) s + 72 of s near to a point light + the larger of possible blockers and 164 polygons + 4 corners + "
       "1,024, less what stands where n has values"},
      {"drawing, or placing again",
       "1,952 + 2 c s + 8,193 + (4 c + 3) width + 4 rows + 10 drawn + 208 active triangles; textures: 4/3 of their "
       "texels"},
  };
  static_assert(sizeof kTexts / sizeof(PartText) == static_cast<std::size_t>(PlanPart::kDrawing) + 1);
  return kTexts[static_cast<std::size_t>(part)];
}

void MemoryPlan::add(PlanPart which, std::uint64_t bytes, unsigned stages) {
  SHODO_CHECK(parts < kMostParts);
  part[parts++] = {which, bytes, static_cast<std::uint8_t>(stages)};
  for (std::size_t k = 0; k < kPlanStages; ++k) stage[k] += part[parts - 1].in(k) ? bytes : 0;
}

std::uint64_t MemoryPlan::peak() const {
  std::uint64_t most = 0;
  for (const std::uint64_t bytes : stage) most = larger(most, bytes);
  return most;
}

std::uint64_t maps_bytes(const Model& model) {
  const std::uint64_t spread = map_bytes(model.scene, model.options);
  if (!features::gathers(model.options)) return spread;
  return larger(spread, map_value_bytes(model.scene) + gather_bytes(model.scene, model.geometry, model.options,
                                                                 model.near_light_count));
}

std::uint64_t drawn_and_picture_bytes(const Model& model) {
  return drawn_bytes(model) + larger(model.geometry.placing_bytes, model.picture_scratch);
}

MemoryPlan plan_memory(const Model& model, bool picture) {
  MemoryPlan plan;
  plan_scene(model, plan);
  plan_light(model, plan);
  plan_planes(model, plan);
  plan_picture(model, plan);
  if (!picture) plan.stage[static_cast<std::size_t>(PlanStage::kPicture)] = 0;
  return plan;
}

bool keeps_geometry(const Model& model) {
  const Scene& scene = model.scene;
  const Options& options = model.options;
  const std::uint64_t flags = features::aims(options.flags) ? FlagTables::bytes(scene) : 0;
  const std::uint64_t blockers = Intersector::bytes(model.geometry, options.flags);
  const std::uint64_t patches = model.after_patches + flags + direct_patch_bytes(scene);
  const std::uint64_t sub_patches = direct_sub_patch_bytes(scene);
  const std::uint64_t solved = patches + ambient_result_bytes(scene) + sub_patches + plane_map_bytes(scene);
  const std::uint64_t ambient = smallest_ambient_bytes(scene, model.geometry, options, SurfacesKeep::kGeometry);
  const std::uint64_t rows = expected_row_bytes(scene, options);
  // Geometry costs less to find again than the direct light that would have to make room for it.
  const std::uint64_t rounds = rounds_bytes(scene, model.geometry, options);
  std::uint64_t most = patches + blockers + ambient + rounds + rows + (rows > 0 ? sub_patches : 0);
  most = larger(most, solved + blockers + Sources::bytes(scene) + plane_gather_bytes(scene) + mirror_bytes(model));
  most = larger(most, solved + maps_bytes(model));
  return most <= model.arena.capacity();
}

}  // namespace shodo
