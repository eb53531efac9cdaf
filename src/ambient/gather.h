// A final gather: the ambient illuminance of every sub-patch, once the patches' is known (ours, beyond paper 2.3;
// deviation D19; doc/gather.md).
//
//     E_x = mean over lines from x of rho E of the sub-patch at their other end,     E direct and ambient
//
// Lines go through the whole scene ("global lines", Sbert 1993): bundles of parallel ones (visibility/line_bundle.h) in
// directions even over the sphere. Of all that a line crosses, each two that face each other with nothing in between
// send each other light: so every piece of a line serves both its ends. Lines lie evenly across their direction,
// so they leave a surface even by cosine and by area, and all count the same; a sub-patch has lines in proportion to
// its area, N on average.
//
// The interpolated value that a sub-patch has counts as 16 of its lines. What sub-patches send is found anew after a
// sixteenth, an eighth, a quarter and half of the bundles. Of one that stands partly inside or under something the
// hidden part is left out of the mean. No form factor, no segment, nothing is scaled.
// Exact: what faces what along each line. Approximate: the mean of N lines, to about N^-0.6 of its spread; sub-patches
// that send are one value each, unless a point light is near (ambient/near_light.h); the visible part of a sub-patch,
// in sixteenths.
// Bytes: 52 a polygon, 4 a triangle, 2 a sub-patch and channel, 5 a sub-patch, 72 one that a light is near to, and 164
// a polygon, 4 a corner of it and 1,024, or those of the intersector. Where the arena has no room, 3 a sub-patch and 72
// a polygon stand where values of patches do.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/direct.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"
#include "shodo/status.h"
#include "visibility/intersector.h"

namespace shodo {

/// Lines of a sub-patch, on average.
inline constexpr std::uint32_t kGatherLines = 1024;

/// Values of patches that the maps have in them: they are lost if their room is needed.
struct GatherRoom {
  std::span<double> ambient, direct;
};

/// `ambient_lx` holds what was interpolated, [sub_patch * channels + channel], and gets what is gathered by every
/// sub-patch that is not hidden and whose patch wasn't dropped. `near`: SentLight::uneven_count(). Errors: kMemory,
/// kInterrupted; then it is lost.
Status gather_illuminance(const Scene& scene, const Geometry& geometry, const DirectLight& direct, std::uint32_t near,
                          Intersector& intersector, const Options& options, const Progress& progress, Arena& arena,
                          GatherRoom room, std::span<float> ambient_lx, Statistics& statistics);

/// The arena bytes that it needs at least, all of which it gives back; `near` as above.
std::uint64_t gather_bytes(const Scene& scene, const Geometry& geometry, const Options& options, std::uint32_t near);

}  // namespace shodo
