// The stored system solved by elimination, for the true error of what sweeps find.
#pragma once

#include <cmath>
#include <vector>

#include "tests/ambient/ambient_scene.h"

namespace shodo {

/// Slow and obvious: E = E0 + F rho E of the stored matrix, by elimination in long double.
inline std::vector<long double> eliminated(const StoredMatrix& stored, const AmbientScene& scene, std::uint32_t c) {
  const std::size_t n = stored.n;
  const std::uint32_t channels = scene.loaded.scene.channels;
  std::vector<std::vector<long double>> a(n, std::vector<long double>(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Mesh& mesh = scene.loaded.scene.meshes[scene.patches[j].mesh];
      const double rho = scene.loaded.scene.materials[mesh.material].diffuse.c[c];
      a[i][j] = (i == j ? 1.0L : 0.0L) - static_cast<long double>(stored.form_factor(i, j)) * rho;
    }
    a[i][n] = scene.lux[i * channels + c];
  }
  for (std::size_t k = 0; k < n; ++k) {  // diagonally dominant: no exchange of rows
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k || a[i][k] == 0) continue;
      const long double part = a[i][k] / a[k][k];
      for (std::size_t j = k; j <= n; ++j) a[i][j] -= part * a[k][j];
    }
  }
  std::vector<long double> e(n);
  for (std::size_t i = 0; i < n; ++i) e[i] = a[i][n] / a[i][i];
  return e;
}

/// The largest error against elimination over the largest illuminance, all channels.
inline double true_error(AmbientScene& scene) {
  const StoredMatrix stored(scene);
  const std::uint32_t channels = scene.loaded.scene.channels;
  long double worst = 0, largest = 0;
  for (std::uint32_t c = 0; c < channels; ++c) {
    const std::vector<long double> e = eliminated(stored, scene, c);
    for (std::size_t i = 0; i < stored.n; ++i) {
      worst = std::max(worst, std::abs(e[i] - static_cast<long double>(scene.total(i * channels + c))));
      largest = std::max(largest, std::abs(e[i]));
    }
  }
  return static_cast<double>(worst / largest);
}

}  // namespace shodo
