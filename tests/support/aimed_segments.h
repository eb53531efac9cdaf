// Segments aimed at the edges and vertices of a scene's triangles, from one side of a closed surface to the other.
//
// A target is an edge's point, rounded to the lattice and shifted by up to a step, or a vertex; the segment passes
// exactly through it. Every such segment has to be blocked, whatever it is aimed at, since its ends are on different
// sides.
#pragma once

#include <cmath>
#include <cstdlib>
#include <functional>

#include "visibility/scenes.h"

namespace shodo {

inline constexpr std::int32_t kEnd = 1 << 19;

inline bool inside_cube(const LatticePoint& p) {
  return std::abs(p.x) <= kEnd && std::abs(p.y) <= kEnd && std::abs(p.z) <= kEnd;
}

/// 1 if a lattice point is well inside, -1 if well outside, 0 if too near the surface to say.
using Where = std::function<int(const LatticePoint&)>;

struct Leaks {
  std::uint64_t segments = 0;
  std::uint64_t leaks = 0;
};

/// Aims at the edges and vertices of the scene's triangles.
inline Leaks shoot(const Geometry& geometry, const Where& where, int segments, std::uint64_t seed) {
  Random random(seed);
  Intersector intersector(geometry);
  Leaks result;
  for (int attempt = 0; attempt < 60 * segments && result.segments < static_cast<std::uint64_t>(segments); ++attempt) {
    const Triangle& t = geometry.triangles[random.below(static_cast<std::uint32_t>(geometry.triangles.size()))];
    const LatticePoint* corner[3] = {&t.a, &t.b, &t.c};
    const std::uint32_t k = random.below(3);
    const LatticePoint &a = *corner[k], &b = *corner[(k + 1) % 3];
    const double s = random.below(5) == 0 ? 0.0 : random.unit();
    const auto jitter = [&] { return s == 0 ? 0 : random.between(-1, 1); };
    const LatticePoint at{a.x + static_cast<std::int32_t>(std::lround(s * (b.x - a.x))) + jitter(),
                          a.y + static_cast<std::int32_t>(std::lround(s * (b.y - a.y))) + jitter(),
                          a.z + static_cast<std::int32_t>(std::lround(s * (b.z - a.z))) + jitter()};
    const std::int32_t reach = random.below(3) == 0 ? 2000 : kEnd / 2;
    const LatticePoint v{random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)};
    const std::int32_t m = random.between(1, 2), n = random.between(1, 2);
    const LatticePoint p{at.x - m * v.x, at.y - m * v.y, at.z - m * v.z};
    const LatticePoint q{at.x + n * v.x, at.y + n * v.y, at.z + n * v.z};
    if (!inside_cube(p) || !inside_cube(q)) continue;
    const int side_p = where(p), side_q = where(q);
    if (side_p == 0 || side_q == 0 || side_p == side_q) continue;
    ++result.segments;
    result.leaks += intersector.blocked(p, q, {}) ? 0 : 1;
  }
  return result;
}

}  // namespace shodo
