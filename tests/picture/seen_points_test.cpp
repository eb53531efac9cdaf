// What samples see: the twin's triangles, and points that are exact to the last of 12 binary places.
#include "picture/seen_points.h"

#include <cmath>
#include <vector>

#include "picture/view.h"
#include "support/picture_twin.h"
#include "support/scene_from_text.h"
#include "visibility/geometry.h"

#include <gtest/gtest.h>

namespace shodo {
namespace {

TEST(SeenPoints, AreThoseOfTheTwinToTheLastPlace) {
  // A floor that reaches from under the eye to the horizon, a slope, a lamp and the back of a wall.
  const std::string text =
      "shodo 1\nmaterial white diffuse 0.7\ncamera low eye 0.3 0.2 0.4 look 4 3 0.3 up 0 0 1 fov 80\n"
      "object room\nquad white -9 -9 0  90 -9 0  90 90 0  -9 90 0 patches 7 5 sub 3 2\n"
      "quad white 2 1 0  3 1 0  3 3 1.5  2 3 1.5 patches 2 3 sub 1 4\n"
      "quad white 1.5 2.5 0  1 2 0  1 2 1  1.5 2.5 1 patches 1 1 sub 1 1\n"
      "light lamp area quad 3 2 2  3 3 2  4 3 2  4 2 2 luminance 100\n";
  Options options;
  options.width = 61;
  options.height = 47;
  options.antialias = 4;
  LoadedScene loaded(text, options);
  Geometry geometry;
  ASSERT_TRUE(place_scene(loaded.scene, loaded.arena, geometry).done());
  const View view = view_of(loaded.scene.cameras[0], geometry.lattice, options.width, options.height);
  const SampleGrid grid = sample_grid(view, options.width, options.height, options.antialias);
  const PictureTwin twin(loaded.scene, geometry, grid);

  std::vector<SeenPoint> seen;
  const SeenSink sink{
      [](void* context, const SeenPoint& point) { static_cast<std::vector<SeenPoint>*>(context)->push_back(point); },
      &seen};
  ASSERT_TRUE(see_points(loaded.scene, geometry, options, {}, loaded.arena, sink).done());
  std::size_t next = 0, lamps = 0, backs = 0, meshes = 0;
  for (std::uint32_t y = 0; y < grid.rows; ++y) {
    for (std::uint32_t x = 0; x < grid.columns; ++x) {
      const TwinHit hit = twin.hit(x, y);
      if (hit.triangle == kNone) continue;
      ASSERT_LT(next, seen.size());
      const SeenPoint& point = seen[next++];
      const DrawnTriangle& drawn = geometry.drawn[hit.triangle];
      ASSERT_EQ(point.x, x);
      ASSERT_EQ(point.y, y);
      EXPECT_EQ(point.mesh, drawn.mesh);
      EXPECT_EQ(point.light, drawn.light);
      EXPECT_EQ(point.front, hit.front);
      lamps += drawn.mesh == kNone ? 1 : 0;
      backs += hit.front ? 0 : 1;
      if (drawn.mesh == kNone) continue;
      ++meshes;
      const std::array<long double, 2> at = twin.map_point(hit.triangle, x, y);
      // Rounded down, from what the twin knows to 1e-15 of the map.
      EXPECT_NEAR(static_cast<double>(point.u - at[0] * 4096), -0.5, 0.5 + 1e-6);
      EXPECT_NEAR(static_cast<double>(point.v - at[1] * 4096), -0.5, 0.5 + 1e-6);
    }
  }
  EXPECT_EQ(next, seen.size());
  EXPECT_GT(lamps, 20u);
  EXPECT_GT(backs, 20u);
  EXPECT_GT(meshes, 1000u);
}

TEST(SeenPoints, OfACameraThatIsNotThereAreRefused) {
  Options options;
  options.camera = "other";
  LoadedScene loaded("shodo 1\nmaterial m diffuse 0.5\ncamera one eye 0 0 1 look 1 1 0 up 0 0 1 fov 60\n"
                     "object o\nquad m 0 0 0  1 0 0  1 1 0  0 1 0 patches 1 1 sub 1 1\n", options);
  Geometry geometry;
  ASSERT_TRUE(place_scene(loaded.scene, loaded.arena, geometry).done());
  EXPECT_EQ(see_points(loaded.scene, geometry, options, {}, loaded.arena, {}).code, StatusCode::kUsage);
}

}  // namespace
}  // namespace shodo
