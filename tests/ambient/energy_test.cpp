#include <cmath>

#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

/// Flux absorbed and flux that lights brought, of E.
struct Balance {
  double absorbed = 0, brought = 0;
};

Balance balance(const AmbientScene& scene, const std::vector<double>& e, double rho) {
  Balance sums;
  for (std::size_t i = 0; i < e.size(); ++i) {
    sums.absorbed += scene.patches[i].area * (1 - rho) * e[i];
    sums.brought += scene.patches[i].area * scene.lux[i];
  }
  return sums;
}

/// E = E0 + M E by plain repetition.
std::vector<double> repeated(const AmbientScene& scene, const StoredMatrix& stored, double rho, bool transposed) {
  std::vector<double> e(scene.lux);
  for (int bounce = 0; bounce < 400; ++bounce) {
    std::vector<double> next(scene.lux);
    for (std::size_t i = 0; i < e.size(); ++i) {
      for (std::size_t j = 0; j < e.size(); ++j) {
        next[i] += rho * (transposed ? stored.form_factor(j, i) : stored.form_factor(i, j)) * e[j];
      }
    }
    e = next;
  }
  return e;
}

TEST(Energy, IsConservedWithFractionsOfTheFluxLeavingIAndNotWithThePapersProse) {
  const double rho = 0.7;
  Options options;
  options.tolerance = 1e-10;
  // The floor is one patch of 60, the walls' patches are down to 0.45: very unequal.
  AmbientScene scene(grey(rho) + box_walls(10, 6, 3, 1, 2, 20, "white"), options);
  scene.light([](const Vec3&, std::uint32_t m) { return m == 2 ? 500.0 : 0; });
  ASSERT_TRUE(scene.solve().done());
  std::vector<double> e(scene.patches.size());
  for (std::size_t i = 0; i < e.size(); ++i) e[i] = scene.total(i);
  const Balance ours = balance(scene, e, rho);
  // Form factors of a patch as large as the room are good to 1e-3, and each row is scaled alone.
  EXPECT_NEAR(ours.absorbed / ours.brought, 1, 2e-3);
  const StoredMatrix stored(scene);
  const Balance twin = balance(scene, repeated(scene, stored, rho, false), rho);
  EXPECT_NEAR(twin.absorbed / ours.absorbed, 1, 1e-8);
  // "The fraction of the flux leaving j that is incident on i" in the same equation: light out of nothing.
  const Balance prose = balance(scene, repeated(scene, stored, rho, true), rho);
  EXPECT_GT(std::abs(prose.absorbed / prose.brought - 1), 0.2);
}

TEST(Energy, ReciprocityHoldsExactlyInWhatIsStored) {
  AmbientScene scene(grey(0.5) + box_walls(4, 3, 2, 3, 1, 4, "white"));
  const StoredMatrix stored(scene);
  std::vector<double> scale(stored.n);
  const Surfaces& s = stored.matrix.surfaces;
  for (std::uint32_t p = 0; p < stored.n; ++p) scale[s.patch_at[p]] = stored.matrix.factor[p] * s.root_area[p];
  for (std::size_t i = 0; i < stored.n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double there = scene.patches[i].area * stored.form_factor(i, j) / scale[i];
      const double back = scene.patches[j].area * stored.form_factor(j, i) / scale[j];
      EXPECT_NEAR(there, back, 1e-14 * there);  // but for the scales and the rounding of this test
    }
  }
}

}  // namespace
}  // namespace shodo
