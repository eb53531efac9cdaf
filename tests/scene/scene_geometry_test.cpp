// What loading does to the geometry: centring, faces without area, quads that are concave, cross, or are triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "scene/mesh.h"
#include "support/scene_from_text.h"

namespace shodo {
namespace {

using Corners = std::vector<Vec3>;

std::string to_text(const Corners& corners) {
  std::string text;
  char buffer[100];
  for (const Vec3& c : corners) {
    std::snprintf(buffer, sizeof buffer, " %.17g %.17g %.17g", c.x, c.y, c.z);
    text += buffer;
  }
  return text;
}

const std::string kStart = "shodo 1\nmaterial m diffuse 0.5\nobject o\n";

std::string box_with_lights(const Vec3& shift, double fine = 0) {
  const auto p = [&](double x, double y, double z) { return to_text({{x + shift.x, y + shift.y, z + shift.z}}); };
  return kStart + "quad m" + p(-0.5, 0, 0.25) + p(-0.5, 0, 2.75) + p(1.125 + fine, 0, 2.75) + p(1.125, 0, 0.25) +
         "\ntri m" + p(0, 1, 0) + p(0, 1.0625, 1) + p(0.375, 1, 0) + "\nlight l point at" + p(0.125, 2, 1) +
         " intensity 1\nlight a area quad" + p(0, 2, 0) + p(1, 2, 0) + p(1, 2, 1) + p(0, 2, 1) +
         " luminance 1\ncamera c eye" + p(0.5, 1, 0.75) + " look" + p(0, 0.25, 0.5) + " up 0 1 0 fov 60\n";
}

/// Everything that has coordinates.
std::vector<Vec3> coordinates(const Scene& s) {
  std::vector<Vec3> all(s.vertices.begin(), s.vertices.end());
  for (const Light& light : s.lights) {
    all.push_back(light.position);
    all.insert(all.end(), light.corners, light.corners + 4);
  }
  for (const Camera& camera : s.cameras) {
    all.push_back(camera.eye);
    all.push_back(camera.look);
  }
  return all;
}

TEST(SceneGeometry, TheBoxHoldsGeometryLightsAndEyesAndItsMiddleIsTheOrigin) {
  const LoadedScene s(box_with_lights({}));
  EXPECT_EQ(s.scene.half_extent, (Vec3{0.8125, 1, 1.375}));
  EXPECT_EQ(s.scene.origin, (Vec3{0.3125, 1, 1.375}));
  EXPECT_EQ(s.scene.vertices[0], (Vec3{-0.8125, -1, -1.125}));
  EXPECT_EQ(s.scene.cameras[0].look, (Vec3{-0.3125, -0.75, -0.875}));
}

TEST(SceneGeometry, AnAreaLightAloneMakesTheBox) {
  const LoadedScene s("shodo 1\nlight l area quad 0 0 0  2 0 0  2 0 4  0 0 4 luminance 1");
  EXPECT_EQ(s.scene.half_extent, (Vec3{1, 0, 2}));
  EXPECT_EQ(s.scene.lights[0].corners[1], (Vec3{1, 0, -2}));
  EXPECT_EQ(s.scene.lights[0].position, Vec3{});
}

TEST(SceneGeometry, AnEyeOrAPointLightAloneMakesTheBox) {
  const LoadedScene s("shodo 1\nlight l point at 1 2 3 intensity 1\ncamera c eye 3 2 1 look 9 9 9 up 0 1 0 fov 60");
  EXPECT_EQ(s.scene.origin, (Vec3{2, 2, 2}));
  EXPECT_EQ(s.scene.half_extent, (Vec3{1, 0, 1}));
}

// Hard case 8: coordinates with few bits can be moved exactly by 10^6, and then nothing may change.
TEST(SceneGeometry, MovingASceneExactlyChangesNoBit) {
  const double fine = 0x1p-33;  // an ulp of 10^6: the middle of the box is no double any more
  const LoadedScene here(box_with_lights({}, fine)), there(box_with_lights({1e6, -1e6, 1e6}, fine));
  EXPECT_EQ(coordinates(here.scene), coordinates(there.scene));
  EXPECT_NEAR(there.scene.origin.x, 1e6 + 0.3125, fine);
  EXPECT_EQ(there.scene.origin.y, -1e6 + 1);
  EXPECT_EQ(here.scene.sub_patch_count, there.scene.sub_patch_count);
}

// Hard case 31, with coordinates that are rounded when the scene is centred.
TEST(SceneGeometry, AMirroredSceneIsMirroredToTheLastBit) {
  std::string text = kStart + "quad m", mirrored = text;
  for (const Vec3& v : Corners{{0.1, 0, 0.3}, {0.1, 0, 7.3}, {3.7, 0.1, 7.3}, {3.7, 0.1, 0.3}}) {
    text += to_text({v});
    mirrored += to_text({{-v.x, v.y, v.z}});
  }
  const LoadedScene a(text), b(mirrored);
  for (std::uint32_t k = 0; k < 4; ++k) {
    EXPECT_EQ(a.scene.vertices[k].x, -b.scene.vertices[k].x);
    EXPECT_EQ(a.scene.vertices[k].y, b.scene.vertices[k].y);
  }
}

// Hard case 10: the rest is as if they were not there.
TEST(SceneGeometry, FacesWithoutAreaAreDroppedCountedAndLeaveNoTrace) {
  const std::string good = "quad m 0 0 0  0 0 1  1 0 1  1 0 0 patches 3 4\n";
  const std::string bad =
      "tri m 9 9 9  9 9 9  9 9 9\ntri m 0 0 0  0.1 0.2 0.3  0.3 0.6 0.9\ntri m 1 1 1  1 1 1  2 5 3\n"
      "quad m 5 5 5  5 5 5  5 5 5  5 5 5\nquad m 0 0 0  1 0 0  2 0 0  3 0 0\nquad m 0 0 0  1 0 0  0 0 0  5 1 0\n"
      "quad m 0 0 0  1 1 1  1 1 1  0 0 0\nquad m 0 0 0  1 0 0  0 0 0  1 0 0\n";
  const LoadedScene with(kStart + bad + good + bad), without(kStart + good);
  EXPECT_EQ(with.scene.polygons_dropped, 16u);
  EXPECT_EQ(without.scene.polygons_dropped, 0u);
  EXPECT_EQ(coordinates(with.scene), coordinates(without.scene));
  EXPECT_EQ(with.scene.meshes.size(), 1u);
  EXPECT_EQ(with.scene.sub_patch_count, without.scene.sub_patch_count);
  EXPECT_EQ(with.arena.used(), without.arena.used());
}

TEST(SceneGeometry, CellsOfAGridWithoutAreaAreCountedAndStay) {
  const LoadedScene s(kStart + "grid m 4 2  0 0 0  1 0 0  1 0 0  2 0 0   0 0 1  1 0 1  1 0 1  2 0 1");
  EXPECT_EQ(s.scene.polygons_dropped, 1u);
  EXPECT_EQ(s.scene.patch_count, 3u);
}

// Hard case 3: slivers are no faces without area.
TEST(SceneGeometry, ThinFacesStay) {
  const LoadedScene s(kStart + "quad m 0 0 0  0 0 1e-9  1 0 1e-9  1 0 0\ntri m 0 0 0  0 0 1e-11  1 0 0");
  EXPECT_EQ(s.scene.polygons_dropped, 0u);
  EXPECT_EQ(s.scene.meshes.size(), 2u);
}

// Hard case 11.
TEST(SceneGeometry, AQuadWithARepeatedCornerIsTheTriangle) {
  const Vec3 a{0, 0, 0}, b{0, 0, 2}, c{3, 0, 1};
  const LoadedScene tri(kStart + "tri m" + to_text(Corners{a, b, c}) + " patches 5 sub 3\n");
  for (const Corners& corners : {Corners{a, a, b, c}, Corners{a, b, b, c}, Corners{a, b, c, c}, Corners{a, b, c, a}}) {
    const LoadedScene quad(kStart + "quad m" + to_text(corners) + " patches 5 4 sub 2 3\n");
    const Mesh& mesh = quad.scene.meshes[0];
    EXPECT_EQ(mesh.kind, MeshKind::kTriangle);
    EXPECT_EQ(mesh.nu, 5u);
    EXPECT_EQ(mesh.nv, 5u);
    EXPECT_EQ(mesh.su, 3u);
    EXPECT_EQ(patch_piece(quad.scene, mesh, 0).vector_area(),
              patch_piece(tri.scene, tri.scene.meshes[0], 0).vector_area());
    Corners left = coordinates(quad.scene), right = coordinates(tri.scene);
    const auto before = [](const Vec3& p, const Vec3& q) { return p.x != q.x ? p.x < q.x : p.z < q.z; };
    std::sort(left.begin(), left.end(), before);
    std::sort(right.begin(), right.end(), before);
    EXPECT_EQ(left, right);
  }
}

/// 2D crossing of segments, for quads without three corners on a line: the obvious twin.
bool cross_2d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto side = [](const Vec3& p, const Vec3& q, const Vec3& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

// Hard case 20. All quads over the points of a 4 x 4 grid, against crossing edges and diagonals tried one by one.
TEST(SceneGeometry, QuadsAreSortedAsTheirEdgesAndDiagonalsSay) {
  std::uint32_t seen[4] = {0, 0, 0, 0};
  for (int n = 0; n < 16 * 16 * 16; n += 3) {
    Corners c;
    for (const int k : {5, n & 15, n >> 4 & 15, n >> 8}) {
      c.push_back({static_cast<double>(k & 3), static_cast<double>(k >> 2), 0});
    }
    bool straight = false;
    for (std::size_t k = 0; k < 4; ++k) {
      straight |= cross(c[(k + 1) % 4] - c[k], c[(k + 2) % 4] - c[k]) == Vec3{};
    }
    if (straight) continue;
    const bool crossing = cross_2d(c[0], c[1], c[2], c[3]) || cross_2d(c[1], c[2], c[3], c[0]);
    const TestScene s(kStart + "quad m" + to_text(c));
    ASSERT_EQ(s.status.done(), !crossing) << to_text(c) << s.status.message;
    if (crossing) {
      ++seen[3];
      continue;
    }
    // The diagonals of a convex quad cross each other; those of a concave one don't, and the valid one lies inside:
    // both its triangles turn the same way.
    const bool convex = cross_2d(c[0], c[2], c[1], c[3]);
    const double first = cross(c[1] - c[0], c[2] - c[0]).z, second = cross(c[2] - c[0], c[3] - c[0]).z;
    const bool cut02 = !convex && first * second > 0;
    const Mesh& mesh = s.scene.meshes[0];
    ASSERT_EQ(mesh.cut, !convex) << to_text(c);
    ASSERT_EQ(mesh.concave, !convex && !cut02) << to_text(c);
    ++seen[convex ? 0 : cut02 ? 1 : 2];
  }
  for (const std::uint32_t count : seen) EXPECT_GT(count, 10u);
}

TEST(SceneGeometry, SaddlesAreAllowedAndFoldsAreNot) {
  EXPECT_FALSE(LoadedScene(kStart + "quad m 0 0 0  0 0.3 1  1 0 1  1 0.3 0").scene.meshes[0].cut);
  EXPECT_EQ(TestScene(kStart + "quad m 0 0 0  1 0 0.1  0 0 1  1 0.1 0").status.code, StatusCode::kScene);
}

TEST(SceneGeometry, ConcaveQuadsTakeTheLargerCountForBoth) {
  const LoadedScene s(kStart + "quad m 0 0 0  4 0 0  1 1 0  0 4 0 patches 3 5 sub 4 2\n");
  const Mesh& mesh = s.scene.meshes[0];
  EXPECT_TRUE(mesh.cut);
  EXPECT_FALSE(mesh.concave);
  EXPECT_EQ(mesh.nu, 5u);
  EXPECT_EQ(mesh.nv, 5u);
  EXPECT_EQ(mesh.su, 4u);
  EXPECT_EQ(mesh.sv, 4u);
  const LoadedScene grid(kStart + "grid m 2 2 0 0 0  0 4 0  4 0 0  1 1 0 sub 4 2\n");
  EXPECT_TRUE(grid.scene.meshes[0].cut);
  EXPECT_EQ(grid.scene.meshes[0].sv, 4u);
  EXPECT_TRUE(cell_piece(grid.scene, grid.scene.meshes[0], 0).cut);
}

}  // namespace
}  // namespace shodo
