// Illuminance mapping data (paper 2.3): one value a sub-patch, direct plus interpolated ambient illuminance.
//
// Ambient light of a quad or grid is spread along u, then along v (parabolic.h), that of a triangle by linear pieces
// (triangle_spread.h): continuous over a mesh, sub-patch values are means over the sub-patch in the mesh's
// parameters, and the mean over all sub-patches of a patch is the patch's value up to rounding to float (deviation
// D7). A patch that was dropped or is hidden altogether has no value of its own: neighbours continue into it, so that
// it doesn't darken them. The value of a partly hidden one is that of its visible part: what is spread is moved until
// the mean over the visible sub-patches is that value. Approximate: three passes, after which it is within a few
// thousandths of what light changes by over a patch.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/ambient.h"
#include "base/arena.h"
#include "light/direct.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "shodo/options.h"
#include "shodo/status.h"

namespace shodo {

struct IlluminanceMaps {
  std::span<const float> direct_lx;      // [sub_patch * channels + channel], DirectLight's
  std::span<float> ambient_lx;           // the same order; 0 where hidden
  std::span<const std::uint8_t> hidden;  // per sub-patch, DirectLight's; empty: none
};

/// Spreads the patches' ambient illuminance over their sub-patches: continuous over a mesh, each patch's mean kept.
/// With options.interpolate off every sub-patch has its patch's value. `patches` may be empty: direct light knows no
/// visible area of dropped ones. Errors: kMemory.
Status map_illuminance(const Scene& scene, std::span<const Patch> patches, const DirectLight& direct,
                       const AmbientLight& ambient, const Options& options, Arena& arena, IlluminanceMaps& maps);

/// What map_illuminance takes of the arena, exactly, each block rounded up to 8 bytes:
///
///   4 sub_patches channels, which stay, and if it interpolates 21 patches + 8 inner
///
/// patches: the most patches of a mesh. inner: the most of a mesh's su nu nv, of a triangle's sub-patches + (nu + 1)
/// (nu + 2).
std::uint64_t map_bytes(const Scene& scene, const Options& options);

}  // namespace shodo
