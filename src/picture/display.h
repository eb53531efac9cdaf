// From luminance to the screen (paper 2.4): a map a mesh in display steps, and the table from steps to 8-bit sRGB.
//
// A channel's luminance L in cd/m2 is shown as v = (L - MIN) / (MAX - MIN). Steps are v in 13 bits, 8192 = white;
// texels go up to 65535 (8 times white) and down to 0, so that interpolation sees what lies beyond white, not below
// black. With `roll` (deviation D17) what is brighter than half of the range is rolled off before it becomes steps: v
// is shown as 1 - 1 / (4 v) above 1/2, a hyperbola (as the one of Reinhard and others 2002, eq. 3) that goes on from v
// = 1/2 with the same slope and reaches white at infinity only: MAX is 3/4, lamps keep their shape. Samples are clamped
// at white, averaged over the pixel in steps, and then made sRGB (IEC 61966-2-1).
//
// Approximate: a step is 1/8192, at most 0.4 of an 8-bit level (near black). Bytes: 2 a sub-patch and channel; 8193
// for the table; while it is made, one a sub-patch of the largest mesh.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "map/illuminance_map.h"
#include "scene/scene.h"

namespace shodo {

inline constexpr std::uint32_t kWhite = 8192;

/// v in steps, to the nearest, within [0, 65535]; here display values become integers, and nowhere else. NaN is 0.
std::uint16_t display_steps(double v);

/// Luminance of a channel in display steps.
std::uint16_t luminance_steps(const Display& display, double luminance_cd_m2);

/// Rolls off steps that were added or multiplied first: of luminance from 0, or of v with black 0.
struct RollOff {
  bool on = false;
  std::uint32_t black = 0;  // steps of the display's MIN

  /// At most white.
  std::uint32_t shown(std::uint32_t steps) const {
    const std::uint32_t range = kWhite - black;
    if (steps <= black || 2 * (steps - black) <= range) return steps;
    if (!on) return steps < kWhite ? steps : kWhite;
    const std::uint32_t above = steps - black;
    return kWhite - (range * range / 4 + above / 2) / above;
  }
};

/// level[s] = round(255 sRGB(v)), s = 0 .. 8192, v = (s / 8192 - black) / (1 - black): steps from luminance 0 have the
/// display's black at MIN / MAX.
void fill_display_table(std::span<std::uint8_t> level, double black = 0);

/// texel[(first_sub_patch + v width + u) channels + channel] of every mesh; a triangle's map is a square (see the
/// .cpp).
struct DisplayMaps {
  std::span<std::uint16_t> texel;
};

/// False if the arena is too small. What only closes the sums is released again.
[[nodiscard]] bool build_display_maps(const Scene& scene, const IlluminanceMaps& maps, Arena& arena,
                                      DisplayMaps& display);

}  // namespace shodo
