// The integer series of a link, against the form factor in floating point.
#include "ambient/link_series.h"

#include <cmath>

#include "ambient/form_factor.h"
#include "ambient/rough_exchange.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

/// A scene with everything that places need.
struct PlacedScene {
  explicit PlacedScene(const std::string& text) : scene(text, options()), surfaces(surfaces_of(scene)) {
    Arena& arena = scene.loaded.arena;
    const std::size_t before = arena.used();
    EXPECT_TRUE(places.take(arena, surfaces, options().rules).done());
    EXPECT_EQ(arena.used() - before, Places::bytes(scene.loaded.scene, options().rules));
  }
  static Options options() {
    Options options;
    options.rules.blocks = true;
    return options;
  }
  /// v without shadows, by the near tier.
  double exact(std::uint32_t i, std::uint32_t j) const {
    return exchange_between(surfaces, row_side(surfaces, i), j, 0).geometric /
           (surfaces.root_area[i] * surfaces.root_area[j]);
  }

  AmbientScene scene;
  Surfaces surfaces;
  Places places;
};

/// Patches of a room's walls, near and far, square to each other and opposed: within the series' own estimate.
TEST(LinkSeries, IsTheFormFactorWithinItsEstimatedError) {
  const PlacedScene placed(grey(0.5) + box_walls(4, 3, 2.5, 7, 5, 3, "white"));
  const Surfaces& surfaces = placed.surfaces;
  const Places& places = placed.places;
  int found = 0;
  for (std::uint32_t m = 0; m < 6; ++m) {
    for (std::uint32_t i = surfaces.mesh_begin[m]; i < surfaces.mesh_begin[m + 1]; i += 3) {
      const PlacedSide side = places.side(i, m);
      for (std::uint32_t n = m + 1; n < 6; ++n) {
        for (std::uint32_t j = surfaces.mesh_begin[n]; j < surfaces.mesh_begin[n + 1]; ++j) {
          const LinkSeries series = places.series(side, j, n);
          ASSERT_NE(series.kind, LinkKind::kAway);
          if (series.kind != LinkKind::kSeries) continue;
          EXPECT_NEAR(series.value, placed.exact(i, j), series.error) << i << ", " << j;
          ++found;
        }
      }
    }
  }
  EXPECT_GT(found, 1000);
}

/// A lamp's shade of trapezoids, one of them a mesh of three, in a room, and a twisted quadrilateral. They have half
/// axes of their own; pairs that these leave open are odd.
TEST(LinkSeries, OfTrapezoidsIsTheFormFactorWithinItsEstimatedError) {
  const PlacedScene placed(grey(0.5) + box_walls(4, 3, 2.5, 7, 5, 3, "white") +
                           "object shade\n"
                           "grid white 5 2  1.7 1 1.2  2.3 1 1.2  2.3 1 1.8  1.7 1 1.8  1.7 1 1.2"
                           "  1.9 1.5 1.4  2.1 1.5 1.4  2.1 1.5 1.6  1.9 1.5 1.6  1.9 1.5 1.4\n"
                           "object foot\nquad white  0.5 0.5 1  0.6 1 1  0.8 1 1  0.9 0.5 1  patches 3 1\n"
                           "object pillow\nquad white  3 0.5 1  3 0.5 1.4  3.5 0.55 1.4  3.5 0.5 1  patches 1 1\n");
  const Surfaces& surfaces = placed.surfaces;
  const std::uint32_t meshes = static_cast<std::uint32_t>(surfaces.mesh_at.size());
  int found = 0, own = 0;
  for (std::uint32_t m = 0; m < meshes; ++m) {
    if (surfaces.mesh_at[m] < 6) continue;  // a wall
    for (std::uint32_t i = surfaces.mesh_begin[m]; i < surfaces.mesh_begin[m + 1]; ++i) {
      const PlacedSide side = placed.places.side(i, m);
      EXPECT_EQ(side.kind, PlaceKind::kOwn);
      ++own;
      for (std::uint32_t n = 0; n < meshes; ++n) {
        if (surfaces.mesh_at[n] >= 6) continue;
        for (std::uint32_t j = surfaces.mesh_begin[n]; j < surfaces.mesh_begin[n + 1]; ++j) {
          const LinkSeries series = placed.places.series(side, j, n);
          if (series.kind == LinkKind::kAway) {
            EXPECT_EQ(placed.exact(i, j), 0) << i << ", " << j;
          }
          if (series.kind != LinkKind::kSeries) continue;
          // The other way round it is the same but for rounding.
          EXPECT_NEAR(placed.places.series(placed.places.side(j, n), i, m).value, series.value, 0.01 * series.value);
          EXPECT_NEAR(series.value, placed.exact(i, j), series.error) << i << ", " << j;
          ++found;
        }
      }
    }
  }
  EXPECT_EQ(own, 4 + 5 + 1);
  EXPECT_GT(found, 1000);
}

/// Over all pairs of a room too near for a series, neighbours in its corners too.
TEST(RoughExchange, OfNearPairsHasHalfTheErrorOfASingleDisc) {
  const PlacedScene placed(grey(0.5) + box_walls(4, 3, 2.5, 7, 5, 3, "white"));
  const Surfaces& surfaces = placed.surfaces;
  double squared = 0, of_one = 0, exact_squared = 0, sum = 0, exact_sum = 0;
  int found = 0;
  for (std::uint32_t m = 0; m < 6; ++m) {
    for (std::uint32_t i = surfaces.mesh_begin[m]; i < surfaces.mesh_begin[m + 1]; ++i) {
      const PlacedSide side = placed.places.side(i, m);
      for (std::uint32_t n = m + 1; n < 6; ++n) {
        for (std::uint32_t j = surfaces.mesh_begin[n]; j < surfaces.mesh_begin[n + 1]; ++j) {
          const LinkSeries one = placed.places.series(side, j, n);
          if (one.kind == LinkKind::kSeries) continue;
          const double rough = rough_exchange(side, placed.places.side(j, n)), exact = placed.exact(i, j);
          sum += rough;
          exact_sum += exact;
          squared += (rough - exact) * (rough - exact);
          of_one += (one.value - exact) * (one.value - exact);
          exact_squared += exact * exact;
          ++found;
        }
      }
    }
  }
  EXPECT_GT(found, 200);
  EXPECT_NEAR(sum, exact_sum, 0.1 * exact_sum);
  EXPECT_LT(std::sqrt(squared / exact_squared), 0.2);
  EXPECT_LT(squared, 0.3 * of_one);  // 0.18 and 0.34, root mean squares
}

}  // namespace
}  // namespace shodo
