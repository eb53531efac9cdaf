// Every statement of the scene file (contract 2), as it must arrive in the Scene. Coordinates arrive centred, so these
// scenes are built about the origin wherever a coordinate is compared.
#include <gtest/gtest.h>

#include <string>

#include "support/scene_from_text.h"

namespace shodo {
namespace {

// A box of half extent 4 about the origin, by two cameras.
const std::string kCorners =
    "shodo 1\n"
    "camera low eye -4 -4 -4 look 0 0 0 up 0 1 0 fov 1\n"
    "camera high eye 4 4 4 look 0 0 1 up 0 0 2 fov 170\n"
    "material grey diffuse 0.5\n"
    "object o\n";

TEST(SceneStatements, AFileWithTheVersionAloneIsAnEmptyScene) {
  for (const char* text :
       {"shodo 1", "shodo 1\n", "\n\n # first\n\tshodo\t1 # then\r\n\r\n", "\xef\xbb\xbfshodo 1\r"}) {
    const LoadedScene empty(text);
    EXPECT_TRUE(empty.scene.objects.empty() && empty.scene.cameras.empty() && empty.scene.lights.empty());
    EXPECT_EQ(empty.scene.patch_count, 0u);
    EXPECT_EQ(empty.scene.channels, 1u);
    EXPECT_EQ(empty.scene.metres_per_unit, 1);
    EXPECT_EQ(empty.scene.display.min_cd_m2, 1);
    EXPECT_EQ(empty.scene.display.max_cd_m2, 250);
    EXPECT_EQ(empty.scene.origin, Vec3{});
    EXPECT_EQ(empty.scene.half_extent, Vec3{});
    EXPECT_EQ(empty.arena.used(), 0u);
  }
}

TEST(SceneStatements, UnitsAreMetres) {
  EXPECT_EQ(LoadedScene("shodo 1\nunit m").scene.metres_per_unit, 1);
  EXPECT_EQ(LoadedScene("shodo 1\nunit cm").scene.metres_per_unit, 0.01);
  EXPECT_EQ(LoadedScene("shodo 1\nunit mm").scene.metres_per_unit, 0.001);
  EXPECT_EQ(LoadedScene("shodo 1\nunit in").scene.metres_per_unit, 0.0254);
  EXPECT_EQ(LoadedScene("shodo 1\nunit ft").scene.metres_per_unit, 0.3048);
}

TEST(SceneStatements, Display) {
  const LoadedScene display("shodo 1\ndisplay 0 80.5");
  EXPECT_EQ(display.scene.display.min_cd_m2, 0);
  EXPECT_EQ(display.scene.display.max_cd_m2, 80.5);
  EXPECT_FALSE(display.scene.display.roll);
  EXPECT_TRUE(LoadedScene("shodo 1\ndisplay 0 80.5 roll").scene.display.roll);
  EXPECT_FALSE(LoadedScene("shodo 1\ndisplay 0 80.5 clip").scene.display.roll);
}

TEST(SceneStatements, CameraWithItsWordsInAnyOrder) {
  const LoadedScene s(kCorners + "camera third_-3 fov 65 up 0 1 0 look 5 1 3.25 eye 0.5 1.5 -0.5");
  ASSERT_EQ(s.scene.cameras.size(), 3u);
  const Camera& camera = s.scene.cameras[2];
  EXPECT_EQ(camera.name, "third_-3");
  EXPECT_EQ(camera.eye, (Vec3{0.5, 1.5, -0.5}));
  EXPECT_EQ(camera.look, (Vec3{5, 1, 3.25}));
  EXPECT_EQ(camera.up, (Vec3{0, 1, 0}));
  EXPECT_EQ(camera.fov_degrees, 65);
  EXPECT_EQ(s.scene.cameras[1].up, (Vec3{0, 0, 1}));
}

TEST(SceneStatements, MaterialsAreGreyOrColoured) {
  const LoadedScene s("shodo 1\nmaterial a diffuse 0.75\nmaterial b diffuse 0 0.9999 -0");
  EXPECT_EQ(s.scene.materials[0].diffuse, (Rgb{{0.75, 0.75, 0.75}}));
  EXPECT_EQ(s.scene.materials[1].diffuse, (Rgb{{0, 0.9999, 0}}));
  EXPECT_EQ(s.scene.materials[1].name, "b");
  EXPECT_EQ(s.scene.channels, 3u);
  EXPECT_EQ(LoadedScene("shodo 1\nmaterial a diffuse 0.3 0.3 0.3").scene.channels, 1u);
}

TEST(SceneStatements, ObjectsWithFlags) {
  const LoadedScene s(
      "shodo 1\nobject plain\nobject both direct +blocks ambient -blocks -shadowed_towards -shadowed_leaving\n"
      "object other ambient +shadowed_leaving direct +shadowed_towards -blocks\n");
  ASSERT_EQ(s.scene.objects.size(), 3u);
  const Object& plain = s.scene.objects[0];
  EXPECT_EQ(plain.direct.blocks | plain.direct.shadowed_towards | plain.ambient.shadowed_leaving, 0);
  const Object& both = s.scene.objects[1];
  EXPECT_EQ(both.direct.blocks, 1);
  EXPECT_EQ(both.direct.shadowed_towards, 0);
  EXPECT_EQ(both.ambient.blocks, -1);
  EXPECT_EQ(both.ambient.shadowed_towards, -1);
  EXPECT_EQ(both.ambient.shadowed_leaving, -1);
  const Object& other = s.scene.objects[2];
  EXPECT_EQ(other.ambient.shadowed_leaving, 1);
  EXPECT_EQ(other.direct.shadowed_towards, 1);
  EXPECT_EQ(other.direct.blocks, -1);
  EXPECT_EQ(other.mesh_count, 0u);
}

TEST(SceneStatements, QuadTriAndGridBecomeMeshes) {
  const LoadedScene s(kCorners +
                      "quad grey -1 0 -1  -1 0 1  1 0 1  1 0 -1 patches 18 26 sub 2 3\n"
                      "tri grey 0 0 0  0 0 1  1 0 0 sub 5 patches 4\n"
                      "object p\n"
                      "grid grey 3 2  0 0 0  1 0 0  2 0 0   0 0 1  1 0.25 1  2 0 1 sub 1 4\n");
  ASSERT_EQ(s.scene.meshes.size(), 3u);
  const Mesh& quad = s.scene.meshes[0];
  EXPECT_EQ(quad.kind, MeshKind::kQuad);
  EXPECT_EQ(quad.nu, 18u);
  EXPECT_EQ(quad.nv, 26u);
  EXPECT_EQ(quad.su, 2u);
  EXPECT_EQ(quad.sv, 3u);
  EXPECT_EQ(quad.object, 0u);
  EXPECT_FALSE(quad.concave || quad.cut || quad.wraps_u);
  EXPECT_EQ(s.scene.vertices[quad.first_vertex + 1], (Vec3{-1, 0, 1}));
  const Mesh& tri = s.scene.meshes[1];
  EXPECT_EQ(tri.kind, MeshKind::kTriangle);
  EXPECT_EQ(tri.nu, 4u);
  EXPECT_EQ(tri.nv, 4u);
  EXPECT_EQ(tri.su, 5u);
  EXPECT_EQ(tri.sv, 5u);
  EXPECT_EQ(tri.first_vertex, 4u);
  EXPECT_EQ(tri.first_patch, 18u * 26);
  EXPECT_EQ(tri.first_sub_patch, 18u * 26 * 6);
  const Mesh& grid = s.scene.meshes[2];
  EXPECT_EQ(grid.kind, MeshKind::kGrid);
  EXPECT_EQ(grid.object, 1u);
  EXPECT_EQ(grid.cells_u, 2u);
  EXPECT_EQ(grid.cells_v, 1u);
  EXPECT_EQ(grid.nu, 2u);
  EXPECT_EQ(grid.nv, 1u);
  EXPECT_EQ(grid.su, 1u);
  EXPECT_EQ(grid.sv, 4u);
  EXPECT_EQ(s.scene.vertices[grid.first_vertex + 4], (Vec3{1, 0.25, 1}));
  EXPECT_EQ(grid.first_patch, 18u * 26 + 16);
  EXPECT_EQ(s.scene.patch_count, 18u * 26 + 16 + 2);
  EXPECT_EQ(s.scene.sub_patch_count, 18u * 26 * 6 + 16 * 25 + 8);
  EXPECT_EQ(s.scene.objects[0].mesh_count, 2u);
  EXPECT_EQ(s.scene.objects[1].first_mesh, 2u);
  EXPECT_EQ(s.scene.objects[1].mesh_count, 1u);
}

TEST(SceneStatements, OtherStatementsDoNotEndAnObject) {
  const LoadedScene s(kCorners +
                      "tri grey 0 0 0  0 0 1  1 0 0\nlight l point at 0 0 0 intensity 1\nmaterial m diffuse 0\n"
                      "camera c eye 1 1 1 look 0 0 0 up 0 1 0 fov 50\ndisplay 1 2\nunit ft\nsub o 2\n"
                      "tri m 0 1 0  0 1 1  1 1 0\n");
  EXPECT_EQ(s.scene.objects[0].mesh_count, 2u);
  EXPECT_EQ(s.scene.meshes[1].material, 1u);
}

TEST(SceneStatements, AGridThatClosesItselfWraps) {
  const std::string ring = "1 0 0  0 0 1  -1 0 0  ", above = "1 1 0  0 1 1  -1 1 0  ";
  EXPECT_TRUE(LoadedScene(kCorners + "grid grey 4 2 " + ring + "1 0 0 " + above + "1 1 0").scene.meshes[0].wraps_u);
  EXPECT_FALSE(LoadedScene(kCorners + "grid grey 4 2 " + ring + "1 0 0 " + above + "1 1 0.01").scene.meshes[0].wraps_u);
  EXPECT_FALSE(LoadedScene(kCorners + "grid grey 3 2 " + ring + above).scene.meshes[0].wraps_u);
}

TEST(SceneStatements, SubOverridesAllMeshesOfAnObjectAndTheLastOneCounts) {
  const std::string quad = "quad grey 0 0 0  0 0 1  1 0 1  1 0 0 patches 2 2 sub 7 7\n";
  const LoadedScene s(kCorners + quad + "sub o 9 9\nsub o 3 4\n" + quad + "object p\n" + quad + quad + "sub p 5\n" +
                      quad + "object q\n" + quad + "sub p 2 3\n" + quad);
  const std::uint32_t su[] = {3, 3, 2, 2, 2, 7, 7}, sv[] = {4, 4, 3, 3, 3, 7, 7};
  ASSERT_EQ(s.scene.meshes.size(), 7u);
  for (std::uint32_t m = 0; m < 7; ++m) {
    EXPECT_EQ(s.scene.meshes[m].su, su[m]) << m;
    EXPECT_EQ(s.scene.meshes[m].sv, sv[m]) << m;
  }
  const LoadedScene tri(kCorners + "tri grey 0 0 0  0 0 1  1 0 0\nsub o 6\n");
  EXPECT_EQ(tri.scene.meshes[0].su, 6u);
  EXPECT_EQ(tri.scene.meshes[0].sv, 6u);
}

TEST(SceneStatements, LightsOfAllKinds) {
  const LoadedScene s(
      kCorners +
      "tri grey 0 0 0  0 0 3  3 0 0\n"
      "light sun sun towards 0 -3 4 illuminance 60000\n"
      "light sky area quad 0 1 1  0 2 1  0 2 3  0 1 3 luminance 3000 open\n"
      "light bulb point intensity 300 at 1 2.5 1\n"
      "light spot point at 1 2.5 1 towards 0 -2 0 intensity 200 cosine 3 colour 1 0.5 0 attenuation 1 2 3\n"
      "light lamp polyhedron object o luminance 2500 direct -blocks ambient +shadowed_leaving\n");
  ASSERT_EQ(s.scene.lights.size(), 5u);
  const Light& sun = s.scene.lights[0];
  EXPECT_EQ(sun.kind, LightKind::kSun);
  EXPECT_EQ(sun.strength, 60000);
  EXPECT_NEAR(length(sun.towards - Vec3{0, -0.6, 0.8}), 0, 1e-15);  // two roundings of a unit vector
  const Light& sky = s.scene.lights[1];
  EXPECT_EQ(sky.kind, LightKind::kArea);
  EXPECT_TRUE(sky.open);
  EXPECT_EQ(sky.strength, 3000);
  EXPECT_EQ(sky.corners[2], (Vec3{0, 2, 3}));
  EXPECT_NEAR(length(sky.position - Vec3{0, 1.5, 2}), 0, 1e-15);  // a few ulp
  const Light& bulb = s.scene.lights[2];
  EXPECT_EQ(bulb.kind, LightKind::kPoint);
  EXPECT_FALSE(bulb.aimed || bulb.open);
  EXPECT_EQ(bulb.position, (Vec3{1, 2.5, 1}));
  EXPECT_EQ(bulb.colour, (Rgb{{1, 1, 1}}));
  EXPECT_EQ(bulb.attenuation[0] + bulb.attenuation[1], 0);
  EXPECT_EQ(bulb.attenuation[2], 1);
  const Light& spot = s.scene.lights[3];
  EXPECT_TRUE(spot.aimed);
  EXPECT_EQ(spot.cosine_exponent, 3);
  EXPECT_EQ(spot.towards, (Vec3{0, -1, 0}));
  EXPECT_EQ(spot.colour, (Rgb{{1, 0.5, 0}}));
  EXPECT_EQ(spot.attenuation[1], 2);
  const Light& lamp = s.scene.lights[4];
  EXPECT_EQ(lamp.kind, LightKind::kPolyhedron);
  EXPECT_EQ(lamp.object, 0u);
  EXPECT_EQ(s.scene.objects[0].light, 4u);
  EXPECT_NEAR(length(lamp.position - Vec3{1, 0, 1}), 0, 1e-15);
  EXPECT_EQ(lamp.direct.blocks, -1);
  EXPECT_EQ(lamp.ambient.shadowed_leaving, 1);
  EXPECT_EQ(s.scene.channels, 3u);
}

TEST(SceneStatements, APolyhedronsCentreIsWeightedByArea) {
  // A square of area 4 at z = 0 and one of area 1 at z = 5: the middle lies at z = 1.
  const LoadedScene s(kCorners +
                      "quad grey -1 -1 -2  -1 1 -2  1 1 -2  1 -1 -2\n"
                      "quad grey 1.5 1 3  1.5 2 3  2.5 2 3  2.5 1 3 patches 7 9\n"
                      "light l polyhedron object o luminance 1");
  EXPECT_NEAR(length(s.scene.lights[0].position - Vec3{0.4, 0.3, -1}), 0, 1e-15);
}

TEST(SceneStatements, NamesMayBeSharedBetweenKindsAndHave63Letters) {
  const std::string name(63, 'x');
  const LoadedScene s("shodo 1\ncamera " + name + " eye 0 0 0 look 0 0 1 up 0 1 0 fov 9\nmaterial " + name +
                      " diffuse 0\nobject " + name + "\nlight " + name + " point at 0 0 0 intensity 1");
  EXPECT_EQ(s.scene.lights[0].name, name);
}

TEST(SceneStatements, CommentsBlanksAndLineEndsDoNotMatter) {
  const LoadedScene a("shodo 1\nmaterial m diffuse 0.5 0.25 0.75\nobject o\ntri m 0 0 0 0 0 1 1 0 0 patches 3");
  const LoadedScene b(
      "\xef\xbb\xbf# \xe7\x85\xa7\xe5\xba\xa6\r\n\r\n  shodo\t1#x\r\n\tmaterial  m\tdiffuse 0.5 0.25 0.75   \r\n"
      "object o # the only one\r\n\ntri m 0 0 0 0 0 1 1 0 0 patches 3#\r\n   ");
  EXPECT_EQ(a.scene.materials[0].diffuse, b.scene.materials[0].diffuse);
  EXPECT_EQ(a.scene.patch_count, b.scene.patch_count);
}

TEST(SceneStatements, LinesMayBeLong) {
  std::string text = "shodo 1\nmaterial m diffuse 0.5\nobject o\ngrid m 2 5000";
  for (int k = 0; k < 5000; ++k) text += " 0 0 " + std::to_string(k) + " 1 0 " + std::to_string(k);
  const LoadedScene s(text + std::string(100000, ' ') + "sub 1 1" + std::string(100000, '#'));
  EXPECT_EQ(s.scene.patch_count, 4999u);
}

TEST(SceneStatements, NumbersArriveCorrectlyRoundedAndDenormalsAndMinusZeroAreNumbers) {
  const std::string digits = "0." + std::string(400, '3');
  const LoadedScene s(
      "shodo 1\nmaterial a diffuse 0.1000000000000000055511151231257827021181583404541015625\n"
      "material b diffuse 1e-320 -0 +.5E0\nmaterial c diffuse " +
      digits);
  EXPECT_EQ(s.scene.materials[0].diffuse.c[0], 0.1);
  EXPECT_EQ(s.scene.materials[1].diffuse, (Rgb{{1e-320, 0, 0.5}}));
  EXPECT_EQ(s.scene.materials[2].diffuse.c[0], 1.0 / 3);
}

}  // namespace
}  // namespace shodo
