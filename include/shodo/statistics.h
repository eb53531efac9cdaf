// What a run counted. All of it is deterministic; times are the caller's business.
#pragma once

#include <cstdint>

namespace shodo {

/// The stages as memory sees them: form factors and solution are one.
enum class MemoryStage : std::uint8_t { kLoad, kDirect, kAmbient, kMap, kPicture };
inline constexpr std::uint32_t kMemoryStageCount = 5;

struct Statistics {
  std::uint32_t objects = 0;
  std::uint32_t meshes = 0;
  std::uint32_t patches = 0;              // receivers that were not dropped
  std::uint32_t sub_patches = 0;
  std::uint32_t planes = 0;               // that measure, and their sub-patches: in no other count
  std::uint32_t plane_sub_patches = 0;
  std::uint32_t channels = 0;             // 1 if every material and light is grey, else 3
  double lattice_step = 0;                // scene units
  std::uint32_t vertices_inserted = 0;    // T-junctions
  std::uint32_t vertices_moved = 0;       // off the interior of a polygon
  std::uint32_t patches_dropped = 0;      // thinner than 4 lattice steps
  std::uint32_t patches_thin = 0;         // thinner than 32 lattice steps: samples of their middle half only
  std::uint32_t polygons_dropped = 0;     // no area
  std::uint32_t lights_clamped = 0;       // point lights within one lattice step of a sample
  std::uint64_t segments_direct = 0;
  std::uint64_t segments_ambient = 0;
  std::uint64_t tests_direct = 0;         // one segment against one triangle, early exits included
  std::uint64_t tests_ambient = 0;
  std::uint64_t segments_planes = 0;      // on measuring planes
  std::uint64_t tests_planes = 0;
  std::uint64_t form_factors_computed = 0;  // geometric factors, a pair counted once
  std::uint64_t nonzeros = 0;             // of the matrix F, both of a pair counted
  std::uint64_t row_bytes = 0;
  std::uint32_t rows_scaled = 0;
  std::uint32_t rows_kept = 0;
  std::uint32_t rows_recomputed = 0;
  std::uint64_t links = 0;                // stored entries: pairs of patches, patches and meshes (rule 3), or blocks
  std::uint64_t block_links = 0;          // those of which an end is a mesh or a block
  std::uint32_t blocks = 0;               // of all meshes, whole meshes included
  std::uint32_t rows_emptied = 0;         // by rule 1
  std::uint32_t columns_emptied = 0;      // by rule 2, in the end
  std::uint32_t columns_restored = 0;     // by rule 2+
  std::uint32_t rule2_rounds = 0;         // solutions after the first that rule 2+ needed
  double rule2_bound_lx = 0;              // rule 2: no illuminance is too small by more
  std::uint32_t sweeps = 0;               // of all solutions
  double solution_bound = 0;              // certified, of the largest illuminance
  std::uint64_t memory_budget = 0;        // bytes
  std::uint64_t memory_peak = 0;
  std::uint64_t stage_peak[kMemoryStageCount] = {};  // bytes, by MemoryStage
  std::uint32_t lit_again = 0;            // 1: the memory of the sub-patches' direct light was wanted in between
  std::uint32_t geometry_again = 0;       // 1: patches and blocks were found again at each look
  std::uint32_t placed_again = 0;         // 1: that of the picture's triangles
};

}  // namespace shodo
