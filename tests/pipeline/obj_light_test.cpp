// Light in models: the same as in the same faces written as statements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/mesh.h"
#include "support/solved_scene.h"

namespace shodo {
namespace {

const std::string kLights =
    "light p point at 1.5 2.5 1 intensity 400\n"
    "light a area quad 1 2.75 2  2 2.75 2  2 2.75 3  1 2.75 3 luminance 900\n";

void expect_same_maps(const IlluminanceMaps& a, const IlluminanceMaps& b) {
  ASSERT_GT(a.direct_lx.size(), 500u);
  ASSERT_EQ(a.direct_lx.size(), b.direct_lx.size());
  EXPECT_TRUE(std::equal(a.direct_lx.begin(), a.direct_lx.end(), b.direct_lx.begin()));
  EXPECT_TRUE(std::equal(a.ambient_lx.begin(), a.ambient_lx.end(), b.ambient_lx.begin()));
  EXPECT_GT(*std::max_element(a.ambient_lx.begin(), a.ambient_lx.end()), 0);
}

TEST(ObjLight, ARoomOfAModelHasTheSameBitsAsTheRoomOfQuads) {
  // 4 x 3 x 5 m, all faces inwards.
  const std::string quads =
      "quad m 0 0 0  0 0 5  4 0 5  4 0 0 patches 1 1\nquad m 0 3 0  4 3 0  4 3 5  0 3 5 patches 1 1\n"
      "quad n 0 0 0  4 0 0  4 3 0  0 3 0 patches 1 1\nquad m 4 0 5  0 0 5  0 3 5  4 3 5 patches 1 1\n"
      "quad n 0 0 5  0 0 0  0 3 0  0 3 5 patches 1 1\nquad m 4 0 0  4 0 5  4 3 5  4 3 0 patches 1 1\n";
  const std::string faces =
      "f 1 4 3 2\nf 5 6 7 8\nusemtl n\nf 1 2 6 5\nusemtl m\nf 3 4 8 7\nusemtl n\nf 4 1 5 8\nusemtl m\nf 2 3 7 6\n";
  const std::string obj =
      "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 4 0 0\nv 4 0 5\nv 0 0 5\nv 0 3 0\nv 4 3 0\nv 4 3 5\nv 0 3 5\n" + faces;
  // In half the size, on its side and off: turned about z by 90 degrees it stands at (0, 4) .. (3, 0).
  const std::string other =
      "mtllib m.mtl\nusemtl m\nv 0 2 0\nv 0 0 0\nv 0 0 2.5\nv 0 2 2.5\n"
      "v 1.5 2 0\nv 1.5 0 0\nv 1.5 0 2.5\nv 1.5 2 2.5\n" + faces;
  TestFiles files = {{"m.mtl", "newmtl m\nKd 0.6\nnewmtl n\nKd 0.35\n"}, {"a.obj", obj}, {"b.obj", other}};
  const std::string start = "shodo 1\nmaterial m diffuse 0.6\nmaterial n diffuse 0.35\nobject o\n";
  Options options;
  options.refine = 4;
  const SolvedScene scene(start + quads + kLights, options);
  const SolvedScene model("shodo 1\nobject o\nobj a.obj\n" + kLights, options, std::size_t{64} << 20, reader_of(files));
  expect_same_maps(scene.model->maps, model.model->maps);
  const SolvedScene placed("shodo 1\nobject o\nobj b.obj scale 2 turn 0 0 90 at 4 0 0\n" + kLights, options,
                           std::size_t{64} << 20, reader_of(files));
  expect_same_maps(scene.model->maps, placed.model->maps);
}

/// Flux on the first object, lumens, and its area.
struct Received {
  Received(const std::string& floor, double refine, TestFiles files) {
    Options options;
    options.refine = refine;
    // A wall that light comes back from; no shadows.
    const SolvedScene solved(floor + "object wall\nquad m 0 0 0  2 0 0  2 2 0  0 2 0 patches 2 2\n"
                                     "light p point at 0.75 1.5 0.6 intensity 100\n",
                             options, std::size_t{64} << 20, reader_of(files));
    const Scene& scene = solved.model->scene;
    const IlluminanceMaps& maps = solved.model->maps;
    for (std::uint32_t m = 0; m < scene.objects[0].mesh_count; ++m) {
      const Mesh& mesh = scene.meshes[m];
      for (std::uint32_t p = 0; p < mesh.sub_patch_count(); ++p) {
        const double size = length(sub_patch_piece(scene, mesh, p).vector_area());
        const std::size_t at = mesh.first_sub_patch + p;
        area += size;
        direct += size * static_cast<double>(maps.direct_lx[at]);
        ambient += size * static_cast<double>(maps.ambient_lx[at]);
      }
    }
  }
  double area = 0, direct = 0, ambient = 0;
};

TEST(ObjLight, AnLReceivesWhatItsTwoRectanglesDo) {
  const std::string start = "shodo 1\nmaterial m diffuse 0.5\nobject floor\n";
  const TestFiles files = {
      {"l.obj", "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 1 0 1\nv 1 0 2\nv 0 0 2\nf 6 5 4 3 2 1\n"}};
  const std::string two = start + "quad m 0 0 0  0 0 1  2 0 1  2 0 0 patches 1 1\nquad m 0 0 1  0 0 2  1 0 2  1 0 1 "
                                  "patches 1 1\n";
  const std::string one = start + "obj l.obj material m\n";
  const Received quads(two, 4, {}), finer_quads(two, 8, {}), faces(one, 4, files), finer_faces(one, 8, files);
  EXPECT_NEAR(finer_faces.area, 3, 1e-13);  // a thousand pieces of an ulp's error each
  // Both tend to the same flux; how far each still is from it is no more than its last step towards it was.
  const auto step = [](double before, double now) { return std::abs(now - before); };
  EXPECT_NEAR(finer_faces.direct, finer_quads.direct,
              step(faces.direct, finer_faces.direct) + step(quads.direct, finer_quads.direct));
  EXPECT_NEAR(finer_faces.ambient, finer_quads.ambient,
              step(faces.ambient, finer_faces.ambient) + step(quads.ambient, finer_quads.ambient));
  // And those steps are small.
  EXPECT_LT(step(faces.direct, finer_faces.direct), 0.001 * finer_faces.direct);
  EXPECT_LT(step(faces.ambient, finer_faces.ambient), 0.01 * finer_faces.ambient);
}

}  // namespace
}  // namespace shodo
