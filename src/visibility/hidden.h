// Whether samples are inside or under something (paper 2.1 has no such thing: deviation D4; design: direct light).
//
// A sample that sees backs is enclosed by them. Sixteen directions in four rings over the hemisphere, from nearly along
// the normal to nearly along the surface, each found on the lattice. The first, next to the normal, must meet a back,
// so a sample in the open costs one ray mostly. Of the others it is enough if some do: under furniture that stands at
// a wall one sees that wall, and its skirting, from the front, in up to half of all directions; where all objects are
// closed, no back is seen from anywhere else. What may be met in a direction is gathered once for all samples of a
// sub-patch. Exact: each ray. Approximate: that sixteen stand for all directions.
// Bytes: none of its own; it uses the intersector's list of a wide aim.
#pragma once

#include <cstdint>
#include <span>

#include "base/vector.h"
#include "visibility/intersector.h"

namespace shodo {

inline constexpr std::uint32_t kMostHiddenSamples = 16;

/// Which of up to 16 samples are hidden, a bit each; `normal` is their surface's, unit. Wide aims of the intersector
/// are not valid afterwards.
std::uint32_t hidden_samples(Intersector& intersector, std::span<const LatticePoint> samples, const Vec3& normal);
/// Whether all samples meet a back in the first direction, without which none is hidden.
bool under_backs(Intersector& intersector, std::span<const LatticePoint> samples, const Vec3& normal);

}  // namespace shodo
