// A wall in pieces.
#pragma once

#include "base/vector.h"

namespace shodo {

/// Of n x m quads, fronts along `along` x `up`. `Scene`: any with quad().
template <class Scene>
void cut_wall(Scene& scene, const Vec3& corner, const Vec3& along, const Vec3& up, int n, int m) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const auto at = [&](int a, int b) {
        return corner + (static_cast<double>(a) / n) * along + (static_cast<double>(b) / m) * up;
      };
      scene.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

}  // namespace shodo
