// The integer series of a link, against the form factor in floating point.
#include "ambient/link_series.h"

#include <cmath>

#include "ambient/form_factor.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

/// Patches of a room's walls, near and far, square to each other and opposed: within the series' own estimate.
TEST(LinkSeries, IsTheFormFactorWithinItsEstimatedError) {
  Options options;
  options.rules.blocks = true;
  AmbientScene scene(grey(0.5) + box_walls(4, 3, 2.5, 7, 5, 3, "white"), options);
  Surfaces surfaces;
  Arena& arena = scene.loaded.arena;
  ASSERT_TRUE(gather_surfaces(scene.loaded.scene, scene.geometry, scene.patches, scene.direct, options, arena, surfaces)
                  .done());
  Places places;
  ASSERT_TRUE(places.take(arena, surfaces, options.rules).done());
  int found = 0;
  for (std::uint32_t m = 0; m < 6; ++m) {
    for (std::uint32_t i = surfaces.mesh_begin[m]; i < surfaces.mesh_begin[m + 1]; i += 3) {
      const PlacedSide side = places.side(i, m);
      for (std::uint32_t n = m + 1; n < 6; ++n) {
        for (std::uint32_t j = surfaces.mesh_begin[n]; j < surfaces.mesh_begin[n + 1]; ++j) {
          const LinkSeries series = places.series(side, j, n);
          ASSERT_NE(series.kind, LinkKind::kAway);
          if (series.kind != LinkKind::kSeries) continue;
          const double exact = exchange_between(surfaces, row_side(surfaces, i), j, 0).geometric /
                               (surfaces.root_area[i] * surfaces.root_area[j]);
          EXPECT_NEAR(series.value, exact, series.error) << i << ", " << j;
          ++found;
        }
      }
    }
  }
  EXPECT_GT(found, 1000);
}

}  // namespace
}  // namespace shodo
