// The near tier: Lambert's contour integral over one patch, averaged over the other (paper 2.2; design: form factors).
//
// Exact over the patch that is looked at, horizon included; the average over the other is Gauss quadrature, refined
// where it has not converged: 2 x 2 against 3 x 3 points (3 against 7 of a triangle), then 4 x 4, then cut in four,
// to depth 4; for rough tolerances a single point against 2 x 2 before that. A patch that crosses the other's plane is
// cut there first, so that no rule has to integrate over the crease. Approximate: the remainder that the last two rules
// differ by, which is returned. About 1 KiB of stack, no memory.
#pragma once

#include "scene/mesh.h"

namespace shodo {

/// One patch of a pair.
struct NearPatch {
  Piece piece;
  Vec3 normal;  // mean, unit
  double area = 0;
};

struct NearFactor {
  double exchange = 0;  // G, scene units squared: area of `points` times the mean factor to `polygon`
  double error = 0;     // of it, estimated
};

/// G between two patches, from points of the first to the polygon of the second. `tolerance`: of G, scene units
/// squared; `crosses`: the first may cross the second's plane; `rough`: a single point and 2 x 2 may do.
NearFactor near_factor(const NearPatch& points, const NearPatch& polygon, double tolerance, bool crosses, double flat,
                       bool rough = false);

}  // namespace shodo
