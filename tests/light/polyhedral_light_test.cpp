// Polyhedral lights against the sum of their faces, their flux, and each other's faces.
#include <gtest/gtest.h>

#include "lit_scene.h"

namespace shodo {
namespace {

/// A sub-patch of 2 mm about (x, y, z), facing up: a point for all that matters here.
std::uint32_t speck(LitScene& scene, double x, double y, double z = 0) {
  const double r = 0.001;
  return scene.quad({x - r, y - r, z}, {x + r, y - r, z}, {x + r, y + r, z}, {x - r, y + r, z});
}

/// The six faces of a cube as area lights or as the faces of one polyhedral light.
void cube(LitScene& scene, const Vec3& low, double side, double luminance, bool polyhedral) {
  const Vec3 high = low + Vec3{side, side, side};
  if (polyhedral) {
    const std::uint32_t object = scene.object();
    scene.box(low, high);
    scene.add_polyhedron(object, 0.5 * (low + high), luminance);
    return;
  }
  const Vec3 v[8] = {{low.x, low.y, low.z},    {high.x, low.y, low.z}, {high.x, high.y, low.z},
                     {low.x, high.y, low.z},   {low.x, low.y, high.z}, {high.x, low.y, high.z},
                     {high.x, high.y, high.z}, {low.x, high.y, high.z}};
  const int face[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}};
  for (const auto& f : face) scene.add_area(v[f[0]], v[f[1]], v[f[2]], v[f[3]], luminance);
}

TEST(PolyhedralLight, IsTheSumOfItsFaces) {
  LitScene faces, whole;
  for (LitScene* scene : {&faces, &whole}) {
    scene->room({0, 0, 0}, {4, 3, 2.5}, 3, 2);
    cube(*scene, {1.2, 1.1, 1.3}, 0.4, 2000, scene == &whole);
    scene->light();
  }
  for (std::uint32_t m = 0; m < 6; ++m) {
    for (std::uint32_t k = 0; k < 36; ++k) {
      const double expected = faces.lux(m, k % 6, k / 6);
      // Each light decides for itself whether it is linear over a sub-patch: its rule is good to 1/16 squared.
      EXPECT_NEAR(whole.lux(m, k % 6, k / 6), expected, 0.004 * expected);
    }
  }
  for (std::size_t p = 0; p < whole.patches.size(); ++p) EXPECT_EQ(whole.direct.light_form_factor[p], 0);
}

TEST(PolyhedralLight, SendsPiLATimesItsSurfaceIntoARoom) {
  LitScene scene;
  scene.room({0, 0, 0}, {4, 3, 2.5}, 5, 2);
  cube(scene, {1.2, 1.1, 1.3}, 0.4, 2000, true);
  scene.light();
  const double expected = M_PI * 2000 * 6 * 0.16;
  double walls = 0;
  for (std::uint32_t m = 0; m < 6; ++m) walls += scene.flux(m);
  EXPECT_NEAR(walls, expected, 1e-3 * expected);
  for (std::uint32_t m = 6; m < 12; ++m)
    EXPECT_EQ(scene.flux(m), 0);  // the faces of a convex body don't see each other
}

TEST(PolyhedralLight, OfManyFacesSendsPiLATimesItsSurfaceToo) {
  // A ball of 8 x 16 cells about the middle of a room, which nothing blocks but itself.
  LitScene scene;
  scene.room({0, 0, 0}, {3, 3, 3}, 3, 2);
  const std::uint32_t object = scene.object();
  std::vector<Vec3> vertices;
  const std::uint32_t columns = 17, rows = 9;
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const double polar = M_PI * (0.02 + 0.96 * r / (rows - 1)),
                   around = 2 * M_PI * (c % (columns - 1)) / (columns - 1);
      vertices.push_back(Vec3{1.5, 1.5, 1.5} + 0.2 * Vec3{std::sin(polar) * std::cos(around),
                                                          std::sin(polar) * std::sin(around), std::cos(polar)});
    }
  }
  const std::uint32_t ball = scene.grid(columns, rows, vertices);
  scene.add_polyhedron(object, {1.5, 1.5, 1.5}, 1000);
  scene.light();
  double surface = 0;
  for (std::uint32_t cell = 0; cell < cell_count(scene.scene.meshes[ball]); ++cell) {
    surface += length(cell_piece(scene.scene, scene.scene.meshes[ball], cell).vector_area());
  }
  EXPECT_EQ(scene.flux(ball), 0);
  EXPECT_NEAR(scene.flux(), M_PI * 1000 * surface, 0.005 * M_PI * 1000 * surface);
}

TEST(PolyhedralLight, AFaceThatBarelyRisesOverTheHorizonCountsAsVisibleAsTheRest) {
  // The second face stands on the floor's plane nearly up to its neck in it: no segment ends above.
  const Vec3 f[4] = {{1, -1, 0.5}, {1, -1, 1.5}, {1, 1, 1.5}, {1, 1, 0.5}};
  const Vec3 g[4] = {{-1, 1, -1}, {-1, 1, 0.02}, {-1, -1, 0.02}, {-1, -1, -1}};
  LitScene scene;
  const std::uint32_t m = speck(scene, 0.1, 0);
  const std::uint32_t object = scene.object();
  scene.quad(f[0], f[1], f[2], f[3]);
  scene.quad(g[0], g[1], g[2], g[3]);
  scene.add_polyhedron(object, {0, 0, 0}, 1000);
  scene.light();
  const double second = point_to_polygon({0.1, 0, 0}, {0, 0, 1}, g, 4);
  EXPECT_GT(second, 0);
  EXPECT_NEAR(scene.lux(m, 0, 0), 1000 * M_PI * (point_to_polygon({0.1, 0, 0}, {0, 0, 1}, f, 4) + second), 1e-3);
}

TEST(PolyhedralLight, ConcaveFacesLightEachOther) {
  // Two faces at right angles: each receives from the other as from an area light.
  LitScene whole, parts;
  const Vec3 f[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, w[4] = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  whole.object();
  whole.quad(f[0], f[1], f[2], f[3], 3, 3);
  whole.quad(w[0], w[1], w[2], w[3], 3, 3);
  whole.add_polyhedron(0, {0.5, 0.5, 0.5}, 100);
  whole.options.tiers = parts.options.tiers = 0;  // the contour integral for both
  whole.light();
  parts.quad(f[0], f[1], f[2], f[3], 3, 3);
  parts.add_area(w[0], w[1], w[2], w[3], 100);
  parts.light();
  for (std::uint32_t k = 0; k < 9; ++k) {
    EXPECT_NEAR(whole.lux(0, k % 3, k / 3), parts.lux(0, k % 3, k / 3), 1e-6 * parts.lux(0, k % 3, k / 3));
    EXPECT_GT(whole.lux(1, k % 3, k / 3), 0);
  }
}

}  // namespace
}  // namespace shodo
