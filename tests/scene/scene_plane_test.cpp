// The statement `plane`.
#include <gtest/gtest.h>

#include <string>

#include "support/scene_from_text.h"

namespace shodo {
namespace {

const std::string kSquare = " 0 0 0  1 0 0  1 1 0  0 1 0";

TEST(ScenePlane, IsNoMeshAndDoesNotEndAnObject) {
  const LoadedScene loaded("shodo 1\nmaterial grey diffuse 0.5\nobject a\nplane work" + kSquare +
                           " patches 3 2 sub 2 5\nquad grey" + kSquare + "\nplane other" + kSquare + "\n");
  ASSERT_EQ(loaded.scene.planes.size(), 2u);
  EXPECT_EQ(loaded.scene.planes[0].name, "work");
  EXPECT_EQ(loaded.scene.planes[0].width(), 6u);
  EXPECT_EQ(loaded.scene.planes[0].height(), 10u);
  EXPECT_EQ(loaded.scene.planes[1].first_sub_patch, 60u);
  EXPECT_EQ(loaded.scene.objects.size(), 1u);
  EXPECT_EQ(loaded.scene.objects[0].mesh_count, 1u);
  EXPECT_EQ(loaded.scene.meshes.size(), 1u);
  EXPECT_EQ(loaded.scene.patch_count, loaded.scene.meshes[0].patch_count());
}

TEST(ScenePlane, WithoutCountsIsDividedAsAQuadWouldBe) {
  const LoadedScene loaded("shodo 1\nmaterial grey diffuse 0.5\nobject a\nquad grey" + kSquare + "\nplane p" + kSquare +
                           "\nlight l point at 0.5 0.5 0.3 intensity 1\n");
  const Mesh& mesh = loaded.scene.meshes[0];
  const Plane& plane = loaded.scene.planes[0];
  EXPECT_EQ(plane.nu, mesh.nu);
  EXPECT_EQ(plane.nv, mesh.nv);
  EXPECT_EQ(plane.su, mesh.su);
  EXPECT_EQ(plane.sv, mesh.sv);
}

TEST(ScenePlane, StandsAloneAndInTheMiddleOfItsScene) {
  const LoadedScene loaded("shodo 1\nplane p 10 0 0  14 0 0  14 2 0  10 2 0\n");
  EXPECT_EQ(loaded.scene.origin.x, 12);
  EXPECT_EQ(loaded.scene.planes[0].corners[2].x, 2);
  EXPECT_EQ(loaded.scene.half_extent.y, 1);
  EXPECT_EQ(loaded.scene.planes[0].nu, 22u);  // 1/24 of its own diagonal of 4.47
}

TEST(ScenePlane, IsRefusedWithItsPlaceWhereItCanNotBe) {
  const struct {
    std::string text, expected;
  } cases[] = {
      {"plane p 0 0 0  1 0 0  1 1 0.2  0 1 0",
       "top.scn:2:9: expected the four corners of a plane convex quad with an area"},
      {"plane p 0 0 0  1 0 0  1 1 0", "top.scn:2:28: expected a number (x of corner 4), found the end of the line"},
      {"plane p" + kSquare + "\nplane p" + kSquare,
       "top.scn:3:7: expected the name of a plane not used before, found 'p'"},
      {"plane p" + kSquare + " patches 70000 1", "top.scn:2:44: expected a whole number"},
      {"plane p" + kSquare + " patches 65535 65535 sub 60000 60000", "top.scn:2:1: expected at most 65535 pieces"},
  };
  for (const auto& c : cases) {
    const TestScene scene("shodo 1\n" + c.text + "\n");
    EXPECT_EQ(to_text(scene.status).substr(0, c.expected.size()), c.expected) << c.text;
  }
}

}  // namespace
}  // namespace shodo
