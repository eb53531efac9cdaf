#include "hard/variants.h"

#include <cmath>

namespace shodo::hard {

std::vector<Keyed> by_key(const FullRun& run, const SceneText& scene) {
  std::vector<Keyed> all(scene.keys().size());
  for (std::uint32_t m = 0; m < scene.keys().size(); ++m) {
    const Mesh& mesh = run.mesh(m);
    const std::uint32_t key = scene.keys()[m];
    Keyed& own = all[key];
    const bool exchanged = scene.exchanged()[key] && mesh.kind == MeshKind::kQuad;
    const std::uint32_t columns = exchanged ? mesh.nv : mesh.nu, rows = exchanged ? mesh.nu : mesh.nv;
    for (std::uint32_t v = 0; v < rows; ++v) {
      for (std::uint32_t u = 0; u < columns; ++u) {
        const std::uint32_t patch = mesh.first_patch + (exchanged ? u * mesh.nu + v : v * mesh.nu + u);
        own.e0.push_back(run.e0(patch));
        own.total.push_back(run.total(patch));
      }
    }
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      own.map.push_back(run.model().maps.direct_lx[mesh.first_sub_patch + k]);
      own.map.push_back(run.model().maps.ambient_lx[mesh.first_sub_patch + k]);
    }
  }
  return all;
}

double difference(const std::vector<Keyed>& a, const std::vector<Keyed>& b) {
  if (a.size() != b.size()) return -1;
  double worst = 0, largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].total.size() != b[k].total.size()) return -1;
    for (std::size_t i = 0; i < a[k].total.size(); ++i) {
      worst = std::fmax(worst, std::fabs(a[k].e0[i] - b[k].e0[i]));
      worst = std::fmax(worst, std::fabs(a[k].total[i] - b[k].total[i]));
      largest = std::fmax(largest, a[k].total[i]);
    }
  }
  return worst == 0 ? 0 : worst / largest;
}

}  // namespace shodo::hard
