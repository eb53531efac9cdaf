// What each stage needs of the arena, known before anything is lit (design: promise 2; doc/memory.md).
//
// A plan is a list of parts, each with the stages that hold it: a stage's bytes are the sum of its parts. It doesn't
// count what the arena holds only as long as nobody wants the memory: rows, and spare blocks (base/arena.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "ambient/surfaces.h"

namespace shodo {

struct Model;

/// In the order in which they run.
enum class PlanStage : std::uint8_t { kLoad, kDirect, kAmbient, kDirectAgain, kMap, kPicture };
inline constexpr std::size_t kPlanStages = 6;

const char* plan_stage_name(PlanStage stage);

enum class PlanPart : std::uint8_t {
  kModel, kScene, kTriangles, kDrawn, kPlacing, kFlags, kDirectLight, kBlockers, kSources, kMirrors, kAmbientLight,
  kSurfaces, kLinks, kSolution, kAmbientOptics, kSubPatches, kPlanes, kMeasuring, kMaps, kSpreading, kDrawing
};

/// For whoever shows a plan; not linked where nobody does.
struct PartText {
  const char* name;
  const char* formula;  // bytes; n patches, s sub-patches, c channels
};
PartText plan_part_text(PlanPart part);

struct PlannedPart {
  PlanPart part = PlanPart::kModel;
  std::uint64_t bytes = 0;
  std::uint8_t stages = 0;   // bit k: held in PlanStage k

  bool in(std::size_t stage) const { return (stages >> stage & 1) != 0; }
};

struct MemoryPlan {
  static constexpr std::size_t kMostParts = 24;

  PlannedPart part[kMostParts];
  std::size_t parts = 0;
  std::uint64_t stage[kPlanStages] = {};  // bytes in use at most; 0 for a picture that isn't asked for

  void add(PlanPart which, std::uint64_t bytes, unsigned stages);
  std::uint64_t peak() const;
};

/// Of a loaded model, in bytes of the caller's memory; `picture`: whether the picture is drawn too.
MemoryPlan plan_memory(const Model& model, bool picture);

/// Whether there is room for the patches and the geometry of all nodes; the plan is made without.
bool keeps_geometry(const Model& model);

/// Arena bytes of the maps, interpolated and gathered.
std::uint64_t maps_bytes(const Model& model);

/// Arena bytes of drawing without the drawn triangles at hand.
std::uint64_t drawn_and_picture_bytes(const Model& model);

}  // namespace shodo
