// Direct illuminance of every sub-patch (paper 2.1), and what the ambient stage needs of it.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"
#include "shodo/status.h"
#include "visibility/intersector.h"

namespace shodo {

struct DirectLight {
  std::span<float> sub_patch_lx;   // [sub_patch * channels + channel], area means; 0 where hidden
  std::span<std::uint8_t> hidden;  // per sub-patch: 1 if inside or under something
  std::span<double> patch_lx;      // [patch * channels + channel]: E0, area-weighted over sub-patches not hidden
  std::span<float> visible_area;   // per patch: the fraction of its area that is not hidden
  // Per patch: the part of its cosine-weighted hemisphere that area lights and openings fill.
  std::span<float> light_form_factor;
};

/// What stays of a run: 8 c + 8 a patch, c channels, and 4 c + 1 a sub-patch.
enum class DirectKeeps : std::uint8_t {
  kPatches,     // and sub-patches in spare blocks, as far as the arena holds them: see `sub_patch_lx`
  kSubPatches,  // once more, after kPatches and with the same answers: patches' values are there
};

/// `patches` may be empty: then each is found again. Errors: kMemory, kInterrupted.
Status light_directly(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                      const Options& options, Intersector& intersector, const Progress& progress, Arena& arena,
                      DirectLight& direct, Statistics& statistics, DirectKeeps keeps = DirectKeeps::kPatches);

/// Arena bytes of what stays of the patches, and of the sub-patches.
std::uint64_t direct_patch_bytes(const Scene& scene);
std::uint64_t direct_sub_patch_bytes(const Scene& scene);

}  // namespace shodo
