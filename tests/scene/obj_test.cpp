// `obj`: faces, places and materials as the files of a model have them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene/mesh.h"
#include "support/files.h"
#include "support/scene_from_text.h"

namespace shodo {
namespace {

const std::string kStart = "shodo 1\nmaterial m diffuse 0.5\nobject o\n";
const std::string kCorners = "v 0 0 0\nv 0 0 4\nv 4 0 4\nv 4 0 0\n";  // of a quad that faces up

/// A model whose faces have material m.
struct ModelScene : LoadedScene {
  explicit ModelScene(const std::string& obj, const std::string& words = "", const Options& options = {})
      : LoadedScene(kStart + "obj a.obj material m " + words + "\n", options, {{"a.obj", obj}}) {}
};

/// Corner k of a mesh, where the file has it.
Vec3 corner(const Scene& scene, std::size_t mesh, std::uint32_t k) {
  return scene.vertices[scene.meshes[mesh].first_vertex + k] + scene.origin;
}

void expect_same_faces(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  EXPECT_EQ(a.origin, b.origin);
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    EXPECT_EQ(a.meshes[m].kind, b.meshes[m].kind);
    EXPECT_EQ(a.meshes[m].cut, b.meshes[m].cut);
    EXPECT_EQ(a.meshes[m].concave, b.meshes[m].concave);
    EXPECT_EQ(a.meshes[m].nu, b.meshes[m].nu);
    EXPECT_EQ(a.meshes[m].nv, b.meshes[m].nv);
    EXPECT_EQ(a.meshes[m].su, b.meshes[m].su);
    EXPECT_EQ(a.meshes[m].sv, b.meshes[m].sv);
    EXPECT_EQ(a.meshes[m].first_vertex, b.meshes[m].first_vertex);
  }
  for (std::size_t k = 0; k < a.vertices.size(); ++k) EXPECT_EQ(a.vertices[k], b.vertices[k]);
}

TEST(Obj, FacesAreQuadsAndTrianglesOfOnePatch) {
  const std::string faces = kCorners + "v 1 0 1\nv 3 0 1\nf 1 2 3 4\nf 1 2 3\nf 1 5 3 4\nf 5 3 4 1\nf 1 6 3 4\n";
  const std::string one = " patches 1 1\n";
  const std::string text = kStart + "quad m 0 0 0  0 0 4  4 0 4  4 0 0" + one +
                           "tri m 0 0 0  0 0 4  4 0 4 patches 1\nquad m 0 0 0  1 0 1  4 0 4  4 0 0" + one +
                           "quad m 1 0 1  4 0 4  4 0 0  0 0 0" + one + "quad m 0 0 0  3 0 1  4 0 4  4 0 0" + one;
  for (const double refine : {1.0, 2.5}) {
    Options options;
    options.refine = refine;
    const ModelScene model(faces, "", options);
    expect_same_faces(model.scene, LoadedScene(text, options).scene);
  }
}

TEST(Obj, EveryWayToNameACorner) {
  const std::string quad = kCorners + "vt 0 0\nvn 0 1 0\nf 1 2 3 4\n";
  const ModelScene plain(quad);
  for (const char* face : {"f 1/1 2/1 3/1 4/1", "f 1//1 2//1 3//1 4//1", "f 1/1/1 2/1/1 3/1/1 4/1/1", "f -4 -3 -2 -1",
                           "f -4/-1/-1 -3/-1/-1 -2//-1 -1/-1", "fo 1 2 3 4", "f 1 -3 3// 4/", "f 01 2 3 4"}) {
    const ModelScene model(kCorners + "vt 0 0\nvn 0 1 0\n" + face + "\n");
    expect_same_faces(plain.scene, model.scene);
  }
}

TEST(Obj, NegativeNumbersCountBackFromTheFaceAndOthersMayComeLater) {
  const ModelScene model("v 9 9 9\n" + kCorners + "f -4 -3 -2 -1\nv 7 7 7\nf 2 3 4 5\nf 2 3 7\nv 0 5 0\n");
  ASSERT_EQ(model.scene.meshes.size(), 3u);
  for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(corner(model.scene, 0, k), corner(model.scene, 1, k));
  EXPECT_EQ(corner(model.scene, 2, 2), (Vec3{0, 5, 0}));
}

TEST(Obj, LinesEndAndGoOnAsFilesHaveThem) {
  const ModelScene plain(kCorners + "f 1 2 3 4\n");
  const std::string crlf = "# x\r\nv 0 0 0\r\nv 0 0 4\r\nv 4 0 4\r\nv 4 0 0\r\nf 1 2 3 4\r\n";
  for (const std::string& text :
       {crlf, "\xef\xbb\xbf" + kCorners + "f 1 2 3 4", kCorners + "f 1 \\\n 2\\\r\n3 \\\n4\n",
        "\t" + kCorners + "\n\n  f\t1 2\t3 4 # the only one\n", kCorners + "# \\\nf 1 2 3 4\\\n\n\\\n",
        std::string("v 0 0 0 1.0\nv 0 0 4 0.5 0.5 0.5\nv 4 0 4 1 0.1 0.2 0.3\nv +4e0 -0 .0\nf 1 2 3 4\\\n")}) {
    const ModelScene model(text);
    expect_same_faces(plain.scene, model.scene);
  }
}

TEST(Obj, WhatHasNoSurfaceIsSkipped) {
  const ModelScene plain(kCorners + "f 1 2 3 4\n");
  const ModelScene model(
      "mtllib none.mtl\no a b\ng\ng a b c\ns off\ns 1\nmg 1 0.1\nvp 0.1 0.2\nvt 0.5\nvn 0 0 1\nl 1 2\np 1\n"
      "bevel on\nc_interp on\nd_interp off\nlod 3\nmaplib a\nusemap off\nshadow_obj a.obj\ntrace_obj a.obj\n"
      "usemtl x\n" + kCorners + "f 1 2 3 4\nusemtl y\nl 1 9/9\n");
  expect_same_faces(plain.scene, model.scene);
}

TEST(Obj, FacesWithoutAreaAreDroppedAndCounted) {
  const std::string good = kCorners + "f 1 2 3 4\n";
  const std::string bad = "f 1 3 5\nf 1 1 2\nf 1 2 1 2\nf 1 3 5 3\nf 1 3 5 3 1\nf 1 1 1 1 1\nf 3 3 3\nf 1 6 3 5 6\n";
  const ModelScene with(good + "v 8 0 8\nv 2 0 2\n" + bad);
  const ModelScene without(good);
  EXPECT_EQ(with.scene.polygons_dropped, 8u);
  EXPECT_EQ(without.scene.polygons_dropped, 0u);
  expect_same_faces(with.scene, without.scene);
}

TEST(Obj, RepeatedCornersAreOne) {
  const ModelScene model(kCorners + "f 1 2 2 3\nf 1 2 3 4 4 1\nf 1 1 2 3 3 4\n");
  ASSERT_EQ(model.scene.meshes.size(), 3u);
  EXPECT_EQ(model.scene.meshes[0].kind, MeshKind::kTriangle);
  EXPECT_EQ(model.scene.meshes[1].kind, MeshKind::kQuad);
  EXPECT_EQ(model.scene.meshes[2].kind, MeshKind::kQuad);
  EXPECT_EQ(model.scene.polygons_dropped, 0u);
}

TEST(Obj, APolygonIsTrianglesOfItsAreaAndFront) {
  // An L of three unit squares that faces down, behind a quad that is cut: its triangles aren't.
  const ModelScene model(
      "v 0 3 0\nv 2 3 0\nv 2 3 1\nv 1 3 1\nv 1 3 2\nv 0 3 2\nv 0.2 3 1\nf 1 2 7 6\nf 1 2 3 4 5 6\nf 6 5 4 3 2 1\n");
  ASSERT_EQ(model.scene.meshes.size(), 1u + 4 + 4);
  EXPECT_TRUE(model.scene.meshes[0].cut);
  for (const std::size_t first : {1u, 5u}) {
    Vec3 area;
    for (std::size_t m = first; m < first + 4; ++m) {
      const Mesh& mesh = model.scene.meshes[m];
      EXPECT_EQ(mesh.kind, MeshKind::kTriangle);
      EXPECT_FALSE(mesh.cut || mesh.concave);
      EXPECT_EQ(mesh.patch_count(), 1u);
      area = area + patch_piece(model.scene, mesh, 0).vector_area();
    }
    EXPECT_EQ(area, (Vec3{0, first == 1 ? -3.0 : 3.0, 0}));
  }
  EXPECT_EQ(model.scene.polygons_dropped, 0u);
}

TEST(Obj, AFaceOf1024Corners) {
  std::string text, face = "f";
  for (int k = 0; k < 1024; ++k) {
    char line[80];
    std::snprintf(line, sizeof line, "v %.6f 0 %.6f\n", std::cos(0.0061359 * k), -std::sin(0.0061359 * k));
    text += line;
    face += " " + std::to_string(k + 1);
  }
  EXPECT_EQ(ModelScene(text + face + "\n").scene.meshes.size(), 1022u);
}

TEST(Obj, ScaleThenTurnAboutXThenYThenZThenAt) {
  // By hand: quarter turns take (x, y, z) to (x, -z, y), (z, y, -x) and (-y, x, z).
  struct Case {
    const char* words;
    Vec3 placed;  // of (1, 2, 3)
  };
  for (const Case& c : {Case{"", {1, 2, 3}},
                        {"scale 2", {2, 4, 6}},
                        {"turn 90 0 0", {1, -3, 2}},
                        {"turn 0 90 0", {3, 2, -1}},
                        {"turn 0 0 90", {-2, 1, 3}},
                        {"turn 90 90 0", {2, -3, -1}},
                        {"turn 90 0 90", {3, 1, 2}},
                        {"turn 0 90 90", {-2, 3, -1}},
                        {"turn 90 90 90", {3, 2, -1}},
                        {"turn -90 180 270", {3, 1, 2}},
                        {"at 10 20 30", {11, 22, 33}},
                        {"at 10 20 30 turn 90 90 90 scale 2", {16, 24, 28}}}) {
    const ModelScene model("v 1 2 3\nv 40 1 0\nv 1 40 0\nf 1 2 3\n", c.words);
    EXPECT_EQ(corner(model.scene, 0, 0), c.placed) << c.words;
  }
  // cos 30 = sqrt(3) / 2, sin 30 = 1 / 2: within an ulp each, on numbers below 40.
  const ModelScene model("v 1 2 3\nv 40 1 0\nv 1 40 0\nf 1 2 3\n", "turn 30 0 0");
  const double half_root = std::sqrt(3.0) / 2;
  EXPECT_NEAR(corner(model.scene, 0, 0).y, 2 * half_root - 1.5, 1e-14);
  EXPECT_NEAR(corner(model.scene, 0, 0).z, 1 + 3 * half_root, 1e-14);
}

TEST(Obj, TheObjectsSubIsForItsFacesToo) {
  const std::string obj = kCorners + "f 1 2 3 4\n";
  const TestFiles files = {{"a.obj", obj}};
  const LoadedScene before(kStart + "sub o 3 5\nobj a.obj material m", {}, files);
  const LoadedScene after(kStart + "obj a.obj material m\nsub o 3 5", {}, files);
  for (const LoadedScene* s : {&before, &after}) {
    EXPECT_EQ(s->scene.meshes[0].su, 3u);
    EXPECT_EQ(s->scene.meshes[0].sv, 5u);
  }
  Options options;
  options.sub_patch_size = 0.5;
  const LoadedScene sized(kStart + "obj a.obj material m", options, files);
  EXPECT_EQ(sized.scene.meshes[0].su, 8u);
}

TEST(Obj, MeshesOfAnObjectMixAndAPolyhedronMayBeAModel) {
  const std::string other = "tri m 0 1 0  0 1 1  1 1 0\n";
  const LoadedScene s(kStart + other + "obj a.obj material m\n" + other + "obj a.obj material m at 9 0 0\n" +
                          "light l polyhedron object o luminance 5\nobject p\n" + other,
                      {}, {{"a.obj", kCorners + "f 1 2 3 4\nf 1 2 3\n"}});
  EXPECT_EQ(s.scene.objects[0].mesh_count, 6u);
  EXPECT_EQ(s.scene.objects[1].first_mesh, 6u);
  EXPECT_EQ(s.scene.meshes[6].object, 1u);
  EXPECT_EQ(corner(s.scene, 4, 0), (Vec3{9, 0, 0}));
}

// ---- materials

const std::string kTwo = kCorners + "v 0 1 0\nusemtl wood\nf 1 2 3 4\nusemtl cloth\nf 1 2 5\nusemtl wood\nf 2 3 5\n";
const std::string kWood = "newmtl wood\nKa 1 1 1\nKd 0.4 0.3 0.2\nKs 1 1 1\nd 0.5\nillum 2\nmap_Kd a.png\nKe 9 9 9\n";
const std::string kCloth = "newmtl cloth\nKd 0.25\n";

std::vector<Rgb> face_colours(const Scene& scene) {
  std::vector<Rgb> colours;
  for (const Mesh& mesh : scene.meshes) colours.push_back(scene.materials[mesh.material].diffuse);
  return colours;
}

TEST(ObjMaterials, AreThoseOfTheMtlFile) {
  const std::string unused = "newmtl unused\nKd 1 1 1\nnewmtl none\n";
  const LoadedScene s(kStart + "obj a.obj\n", {},
                      {{"a.obj", "mtllib a.mtl\n" + kTwo}, {"a.mtl", unused + kWood + kCloth}});
  const Rgb wood{{0.4, 0.3, 0.2}}, cloth{{0.25, 0.25, 0.25}};
  EXPECT_EQ(face_colours(s.scene), (std::vector<Rgb>{wood, cloth, wood}));
  ASSERT_EQ(s.scene.materials.size(), 3u) << "only those that a face has";
  EXPECT_EQ(s.scene.channels, 3u);
}

TEST(ObjMaterials, MayStandInSeveralFilesOfOtherFoldersTheFirstCounts) {
  const LoadedScene s("shodo 1\ninclude parts/part.scn\n", {},
                      {{"parts/part.scn", "object o\nobj chairs/a.obj\n"},
                       {"parts/chairs/a.obj", kTwo + "mtllib b.mtl ../c.mtl\nmtllib ../c.mtl\nmtllib ../../d/e.mtl\n"},
                       {"parts/chairs/b.mtl", kCloth + "newmtl cloth\nKd 0.9\n"},
                       {"parts/c.mtl", "newmtl cloth\nKd 0.1\n"},
                       {"d/e.mtl", "\xef\xbb\xbfnewmtl wood\r\n\tKd 0.4 0.3 0.2\r\n"}});
  EXPECT_EQ(face_colours(s.scene),
            (std::vector<Rgb>{{{0.4, 0.3, 0.2}}, {{0.25, 0.25, 0.25}}, {{0.4, 0.3, 0.2}}}));
}

TEST(ObjMaterials, NamesBelongToTheModelAlone) {
  const LoadedScene s("shodo 1\nmaterial wood diffuse 0.1\nobject o\nobj a/m.obj\nobj b/m.obj\n"
                      "tri wood 0 0 0  0 0 1  1 0 0\nmaterial cloth diffuse 0.2\ntri cloth 0 0 0  0 0 1  1 0 0\n",
                      {},
                      {{"a/m.obj", "mtllib m.mtl\n" + kTwo}, {"a/m.mtl", kWood + kCloth},
                       {"b/m.obj", "mtllib m.mtl\n" + kTwo},
                       {"b/m.mtl", "newmtl wood\nKd 0.5\nnewmtl cloth\nKd 0.6\n"}});
  std::vector<double> red;
  for (const Rgb& colour : face_colours(s.scene)) red.push_back(colour.c[0]);
  EXPECT_EQ(red, (std::vector<double>{0.4, 0.25, 0.4, 0.5, 0.6, 0.5, 0.1, 0.2}));
}

TEST(ObjMaterials, NamesHaveBlanksAndSigns) {
  for (const char* name : {"Wood, dark (2)", "wood#1", "\"wood\"", "w\xc3\xb6od", "a/b.c", "wood #1 #2"}) {
    const std::string obj = "mtllib a.mtl\n" + kCorners + "usemtl " + name + " \t # a comment\r\nf 1 2 3 4\n";
    const std::string mtl = "newmtl wood\nKd 0.1\nnewmtl " + std::string(name) + "\t\nKd 0.3\n";
    const LoadedScene s(kStart + "obj a.obj\n", {}, {{"a.obj", obj}, {"a.mtl", mtl}});
    const double expected = std::string(name) == "wood #1 #2" ? 0.1 : 0.3;  // '#' after a blank starts a comment
    EXPECT_EQ(face_colours(s.scene)[0].c[0], expected) << name;
  }
}

TEST(ObjMaterials, OneOfTheSceneIsForAllFacesAndNoMtlFileIsAskedFor) {
  struct Asked {
    std::string obj = "mtllib a.mtl b.mtl\n" + kTwo + "usemtl\\\n w\nf 1 2 3\n";
    std::vector<std::string> paths;
  } asked;
  const Reader reader{[](void* self, std::string_view path, std::string_view& text) {
                        Asked& files = *static_cast<Asked*>(self);
                        files.paths.emplace_back(path);
                        text = files.obj;
                        return path == "a.obj";
                      },
                      &asked};
  std::vector<std::byte> memory(10000);
  Arena arena(memory.data(), memory.size());
  Scene scene;
  const Status status = load_scene("top.scn", kStart + "obj a.obj material m\n", reader, {}, arena, scene);
  ASSERT_TRUE(status.done()) << to_text(status);
  EXPECT_EQ(asked.paths, (std::vector<std::string>{"a.obj", "a.obj"}));
  EXPECT_EQ(scene.materials.size(), 1u);
  for (const Mesh& mesh : scene.meshes) EXPECT_EQ(mesh.material, 0u);
}

TEST(ObjMaterials, ThousandsOfNamesInAnyOrder) {
  std::string obj = "mtllib a.mtl\n" + kCorners, mtl;
  for (int k = 0; k < 5000; ++k) {
    const std::string name = std::to_string(k * 7919 % 5000);
    obj += "usemtl " + name + "\nf 1 2 3\n";
    mtl += "newmtl " + std::to_string(k) + "\nKd " + std::to_string(0.0001 * k) + "\n";
  }
  const LoadedScene s(kStart + "obj a.obj\n", {}, {{"a.obj", obj}, {"a.mtl", mtl}});
  ASSERT_EQ(s.scene.materials.size(), 5001u);
  for (int k = 0; k < 5000; ++k) {
    const double expected = 0.0001 * (k * 7919 % 5000);
    const std::size_t m = static_cast<std::size_t>(k);
    ASSERT_NEAR(s.scene.materials[s.scene.meshes[m].material].diffuse.c[0], expected, 1e-9);  // nine decimals
  }
}

// ---- memory

TEST(ObjMemory, WhatTheSceneKeepsIsWhatItsStatementsWouldAndAllElseIsGivenBack) {
  const std::string obj = "mtllib a.mtl\n" + kTwo;
  const TestFiles files = {{"a.obj", obj}, {"a.mtl", kWood + kCloth}};
  const LoadedScene s(kStart + "obj a.obj\n", {}, files);
  EXPECT_EQ(s.arena.used(), 3 * sizeof(Material) + sizeof(Object) + 3 * sizeof(Mesh) + 10 * sizeof(Vec3) + 8);
}

TEST(ObjMemory, TooLittleIsRefusedWithMoreThanThereIsAndEnoughWorks) {
  std::string obj = "mtllib a.mtl\n", face = "f";
  for (int k = 0; k < 40; ++k) {
    obj += "v " + std::to_string(std::cos(0.15 * k)) + " 0 " + std::to_string(std::sin(0.15 * k)) + "\n";
    face += " " + std::to_string(k + 1);
  }
  obj += "usemtl wood\n" + face + "\nusemtl cloth\nf 1 2 3\n";
  const TestFiles files = {{"a.obj", obj}, {"a.mtl", kWood + kCloth}};
  std::size_t bytes = 0, steps = 0;
  while (true) {
    const TestScene s(kStart + "obj a.obj\n", {}, files, bytes);
    if (s.status.done()) {
      EXPECT_EQ(s.scene.meshes.size(), 39u);
      EXPECT_LE(s.arena.peak(), bytes);
      EXPECT_GT(s.arena.peak() + 8, bytes) << "what was asked for last is what it takes";
      break;
    }
    ASSERT_EQ(s.status.code, StatusCode::kMemory);
    ASSERT_EQ(s.status.line, 0u);
    ASSERT_GT(s.status.bytes_needed, bytes);
    EXPECT_EQ(s.arena.used(), 0u);
    bytes = static_cast<std::size_t>(s.status.bytes_needed);
    ++steps;
  }
  EXPECT_LE(steps, 3u);
}

TEST(ObjMemory, AFileThatChangesWhileItIsReadIsRefused) {
  const std::string texts[] = {kCorners + "f 1 2 3 4\n", kCorners + "f 1 2 3\n", kCorners + "f 1 2 3 4\nf 1 2 3\n",
                               kCorners, kCorners + "v 1 1 1\nf 1 2 3 4 5\n"};
  struct Changing {
    const std::string* text[2];
    std::size_t reads = 0;
  };
  for (const std::string& first : texts) {
    for (const std::string& second : texts) {
      Changing file{{&first, &second}};
      const Reader reader{[](void* self, std::string_view, std::string_view& text) {
                            Changing& changing = *static_cast<Changing*>(self);
                            text = *changing.text[changing.reads++ % 2];
                            return true;
                          },
                          &file};
      std::vector<std::byte> memory(10000);
      Arena arena(memory.data(), memory.size());
      Scene scene;
      const Status status = load_scene("top.scn", kStart + "obj a.obj material m\n", reader, {}, arena, scene);
      EXPECT_EQ(status.done(), &first == &second) << first << "then\n" << second;
      if (!status.done()) {
        EXPECT_EQ(arena.used(), 0u);
      }
    }
  }
}

// ---- the model of data/

TEST(ObjData, TheChairIsClosedButForTheSolesOfItsLegs) {
  FolderReader files(source_folder() + "/data");
  std::vector<std::byte> memory(100000);
  Arena arena(memory.data(), memory.size());
  Scene scene;
  const Status status =
      load_scene("top.scn", "shodo 1\nobject chair\nobj models/chair.obj\n", files.reader(), {}, arena, scene);
  ASSERT_TRUE(status.done()) << to_text(status);
  EXPECT_EQ(scene.polygons_dropped, 0u);
  EXPECT_EQ(scene.materials.size(), 2u);
  // The vector areas of a closed surface add up to 0; four soles of 4 x 4 cm are missing, which would face down.
  Vec3 sum;
  double area = 0;
  for (const Mesh& mesh : scene.meshes) {
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      const Vec3 a = patch_piece(scene, mesh, p).vector_area();
      sum = sum + a;
      area += length(a);
    }
  }
  // By hand, cm2: seat 42 x 42 twice, less 2 and 4 squares of 16; its sides 4 x (42 + 2 x 38 + 34); front legs
  // 2 x 4 x 4 x 41; posts 2 x (2 x 4 x 86 + 4 x 82 + 4 x 62 + 16); the board 2 x 34 x 20 + 2 x 34 x 4.
  EXPECT_NEAR(area, 1e-4 * (3528 - 96 + 608 + 1312 + 2560 + 1632), 1e-12);
  EXPECT_NEAR(sum.x, 0, 1e-15);
  EXPECT_NEAR(sum.y, 4 * 0.04 * 0.04, 1e-15);
  EXPECT_NEAR(sum.z, 0, 1e-15);
}

}  // namespace
}  // namespace shodo
