// Every mistake in a model's files is refused with file:line:column, what was expected and what was found.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <string>
#include <vector>

#include "support/scene_from_text.h"

namespace shodo {
namespace {

struct Refusal {
  std::string text;
  std::string message;  // "file:line:column: " and the message's start
};

const std::string kStart = "shodo 1\nmaterial m diffuse 0.5\nobject o\n";
const std::string kCorners = "v 0 0 0\nv 0 0 4\nv 4 0 4\nv 4 0 0\n";

void expect_refused(const std::string& scene, const TestFiles& files, const std::string& message,
                    StatusCode code = StatusCode::kScene) {
  const TestScene s(scene, {}, files);
  EXPECT_EQ(s.status.code, code) << scene;
  EXPECT_EQ(to_text(s.status).substr(0, message.size()), message) << to_text(s.status);
  EXPECT_EQ(s.arena.used(), 0u) << "a refused scene must leave the arena as it was";
}

TEST(ObjRefusals, TheStatement) {
  const TestFiles files = {{"a.obj", kCorners + "f 1 2 3\n"}};
  for (const Refusal& r : std::vector<Refusal>{
           {"obj", "top.scn:4:4: expected the path of a file, found the end of the line"},
           {"obj a.obj 3", "top.scn:4:11: expected scale, turn, at, material, or the end of the line, found '3'"},
           {"obj a.obj sub 2 2", "top.scn:4:11: expected scale, turn, at, material, or the end of the line"},
           {"obj a.obj scale 0", "top.scn:4:17: expected a number from 1e-30 to 1e+30 (scale), found '0'"},
           {"obj a.obj scale -1", "top.scn:4:17: expected a number from 1e-30 to 1e+30 (scale), found '-1'"},
           {"obj a.obj scale 1 scale 1", "top.scn:4:19: expected this word once only"},
           {"obj a.obj turn 1 2", "top.scn:4:19: expected a number (z of turn, degrees), found the end of the line"},
           {"obj a.obj at 1 2 x", "top.scn:4:18: expected a number (z of at), found 'x'"},
           {"obj a.obj material n", "top.scn:4:20: expected the name of a material defined above, found 'n'"},
           {"obj /a.obj material m", "top.scn:4:5: expected a path relative to this file, found '/a.obj'"},
           {"obj ../a.obj material m", "top.scn:4:5: expected a path that stays in the folder of the top file"},
       }) {
    expect_refused(kStart + r.text + "\n", files, r.message);
  }
  expect_refused(kStart + "obj b.obj\n", files, "top.scn:4:5: expected a file that can be read, found 'b.obj'",
                 StatusCode::kFile);
  expect_refused("shodo 1\nobj a.obj\n", files, "top.scn:2:1: expected an 'object' before the first surface");
  expect_refused(kStart + "sub o 2 3\nobj a.obj material m\n", files,
                 "top.scn:5:1: expected equal counts in the 'sub' of an object with a triangle, found 2 3");
}

TEST(ObjRefusals, NoMoreThanAThousandModels) {
  std::string thousand = kStart;
  for (int k = 0; k < 1000; ++k) thousand += "obj a.obj material m\n";
  const TestFiles files = {{"a.obj", "# nothing\n"}};
  EXPECT_TRUE(TestScene(thousand, {}, files).status.done());
  expect_refused(thousand + "obj a.obj", files, "top.scn:1004:1: expected at most 1000 'obj' in all");
}

TEST(ObjRefusals, WhatNoObjFileHas) {
  const std::string one = "expected a statement of an OBJ file, found ", end = "expected the end of the line, found ";
  const std::string free_form = "expected faces only: free-form curves and surfaces are left out, found ";
  for (const Refusal& r : std::vector<Refusal>{
           {"\nV 1 2 3", "a.obj:2:1: " + one + "'V'"},
           {"  shodo 1", "a.obj:1:3: " + one + "'shodo'"},
           {"\x01", "a.obj:1:1: " + one + "the control character '\\x01'"},
           {"call b.obj", "a.obj:1:1: " + one},
           {"csh ls", "a.obj:1:1: " + one},
           {"newmtl a", "a.obj:1:1: " + one},
           {"v 1 2 3\n\ncstype bezier", "a.obj:3:1: " + free_form + "'cstype'"},
           {"curv 0 1 1 2", "a.obj:1:1: " + free_form},
           {"surf 0 1 0 1 1 2 3 4", "a.obj:1:1: " + free_form},
           {"end", "a.obj:1:1: " + free_form},
           {"v", "a.obj:1:2: expected a number (x of a vertex), found the end of the file"},
           {"v 1 2\n3", "a.obj:2:1: " + one},
           {"v 1 2\nf 1 1 1", "a.obj:1:6: expected a number (z of a vertex), found the end of the line"},
           {"v 1,0 2 3", "a.obj:1:3: expected a number (x of a vertex), found '1,0'"},
           {"v nan 2 3", "a.obj:1:3: expected a number (x of a vertex), found 'nan'"},
           {"v 1 2e30 3", "a.obj:1:5: expected a number from -1e+30 to 1e+30 (y of a vertex), found '2e30'"},
           {"v 1 2 3 red", "a.obj:1:9: expected a number (weight or colour of a vertex), found 'red'"},
           {"v 1 2 3 4 5 6 7 8", "a.obj:1:17: " + end + "'8'"},
           {"v 1 2 3\x02", "a.obj:1:8: " + end + "the control character '\\x02'"},
           {"o \x1b", "a.obj:1:3: " + end + "the control character '\\x1b'"},
           {"# \r x", "a.obj:1:3: "},
           {"usemtl", "a.obj:1:7: expected the name of a material, found the end of the file"},
       }) {
    expect_refused(kStart + "obj a.obj material m\n", {{"a.obj", r.text}}, r.message);
  }
}

TEST(ObjRefusals, Faces) {
  const std::string outside = "expected a vertex from 1 to 4 or, counted back, from -1 to -4, found ";
  const std::string form = "expected a corner as V, V/VT, V//VN or V/VT/VN, found ";
  const std::string few = "expected at least 3 corners of a face, found the end of the ";
  for (const Refusal& r : std::vector<Refusal>{
           {"f", "2: " + few + "file"},
           {"f 1 2\n", "6: " + few + "line"},
           {"f 1 2 # 3", "10: " + few + "file"},
           {"f 1 2 5", "7: " + outside + "'5'"},
           {"f 0 1 2", "3: " + outside + "'0'"},
           {"f 1 -5 2", "5: " + outside + "'-5'"},
           {"f 1 2 -0", "7: " + outside},
           {"f 1 2 4294967297", "7: " + outside},
           {"f 1 2 18446744073709551617", "7: " + outside},
           {"f 1 2 3.0", "7: " + outside},
           {"f 1 2 +3", "7: " + outside},
           {"f 1 2 --3", "7: " + outside},
           {"f 1 2 /3", "7: " + outside},
           {"f 1 2 x", "7: " + outside + "'x'"},
           {"f 1/a 2 3", "3: " + form + "'1/a'"},
           {"f 1/1/1/1 2 3", "3: " + form},
           {"f 1 2 3 \x7f", "9: expected the end of the line, found the control character"},
           {"f 1 3 2 4", "1: expected a quad that does not cross itself or fold over"},
           {"f 1 3 4 2", "1: expected a quad that does not cross itself or fold over"},
       }) {
    expect_refused(kStart + "obj a.obj material m\n", {{"a.obj", kCorners + r.text}}, "a.obj:5:" + r.message);
  }
  const std::string bow = kCorners + "v 2 0 9\nf 1 3 2 4 5\n";
  expect_refused(kStart + "obj a.obj material m\n", {{"a.obj", bow}},
                 "a.obj:6:1: expected a polygon that lies in a plane and does not cross itself");
  // Counted from where the face stands.
  expect_refused(kStart + "obj a.obj material m\n", {{"a.obj", "v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n"}},
                 "a.obj:3:9: expected a vertex from 1 to 3 or, counted back, from -1 to -2, found '-3'");
  expect_refused(kStart + "obj a.obj material m\n", {{"a.obj", "f 1 2 3"}},
                 "a.obj:1:3: expected a vertex, and the file to have any, found '1'");
  expect_refused(kStart + "obj a.obj material m\n", {{"a.obj", "f -1 2 3\n" + kCorners}},
                 "a.obj:1:3: expected a vertex from 1 to 4, found '-1'");
}

TEST(ObjRefusals, AFaceOfMoreThan1024Corners) {
  std::string face = "f";
  for (int k = 0; k < 1025; ++k) face += " 1";
  expect_refused(kStart + "obj a.obj material m\n", {{"a.obj", kCorners + face}},
                 "a.obj:5:2051: expected at most 1024 corners of a face, found '1'");
}

TEST(ObjRefusals, WhatIsPlacedBeyondTheNumbersThatASceneCanHave) {
  const std::string message = "a.obj:2:1: expected a vertex that lies within 1e+30 when it is scaled, turned and moved";
  const TestFiles files = {{"a.obj", "v 1 1 1\nv 2 0 0\nv 0 2 0\nf 1 2 3\n"}};
  expect_refused(kStart + "obj a.obj material m scale 0.6e30", files, message);
  expect_refused(kStart + "obj a.obj material m at 1e30 0 0 scale 0.4e30", files, "a.obj:1:1: ");
  EXPECT_TRUE(TestScene(kStart + "obj a.obj material m scale 0.4e30", {}, files).status.done());
}

TEST(ObjRefusals, Materials) {
  const std::string face = kCorners + "f 1 2 3\n", wood = "mtllib a.mtl\nusemtl wood\n" + face;
  const std::string scene = kStart + "obj s/a.obj\n";
  expect_refused(scene, {{"s/a.obj", face}},
                 "s/a.obj:5:1: expected 'usemtl' before the first face, or a material beside 'obj', found 'f'");
  expect_refused(scene, {{"s/a.obj", "usemtl wood\n" + face}},
                 "s/a.obj:1:8: expected the name of a material of an MTL file, found 'wood'");
  expect_refused(scene,
                 {{"s/a.obj", wood + "usemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\n"}, {"s/a.mtl", "newmtl wood\nKd 0"}},
                 "s/a.obj:8:8: expected the name of a material of an MTL file, found 'b'");
  expect_refused(scene, {{"s/a.obj", wood}}, "s/a.obj:1:8: expected a file that can be read, found 'a.mtl'",
                 StatusCode::kFile);
  expect_refused(scene, {{"s/a.obj", "mtllib ../b.mtl a.mtl"}, {"b.mtl", ""}},
                 "s/a.obj:1:17: expected a file that can be read, found 'a.mtl'", StatusCode::kFile);
  expect_refused(scene, {{"s/a.obj", "mtllib ../../a.mtl"}},
                 "s/a.obj:1:8: expected a path that stays in the folder of the top file, found '../../a.mtl'");
  expect_refused(scene, {{"s/a.obj", "\n mtllib c:\\a.mtl"}}, "s/a.obj:2:9: expected a path without '\\' and ':'");
  expect_refused(scene, {{"s/a.obj", "mtllib"}}, "s/a.obj:1:7: expected the path of a file");
  const std::string number = "expected a number", range = number + " from 0 to 0.9999 ";
  for (const Refusal& r : std::vector<Refusal>{
           {"newmtl", "1:7: expected the name of a material, found the end of the file"},
           {"newmtl wood\n", "1:8: expected a material with a Kd, since a face has it, found 'wood'"},
           {"newmtl wood\nKe 1 1 1\n newmtl b\nKd 0", "1:8: expected a material with a Kd"},
           {"newmtl wood\nKd", "2:3: " + number + " (Kd), found the end of the file"},
           {"newmtl wood\nKd 1 1 1", "2:4: " + range + "(Kd), found '1'"},
           {"newmtl wood\nKd 0 1 0", "2:6: " + range + "(green of Kd), found '1'"},
           {"newmtl wood\nKd 0 0 -0.1", "2:8: " + range + "(blue of Kd), found '-0.1'"},
           {"newmtl wood\nKd 0.1 0.2", "2:11: " + number + " (blue of Kd), found the end of the file"},
           {"newmtl wood\nKd 0.1 0.2 0.3 0.4", "2:16: expected the end of the line, found '0.4'"},
           {"newmtl wood\nKd spectral a.rfl 1", "2:4: " + number + " (Kd), found 'spectral'"},
           {"newmtl wood\nKd xyz 1 1 1", "2:4: " + number + " (Kd), found 'xyz'"},
           {"newmtl wood\nKd 0.1\nNs \x01", "3:4: expected the end of the line, found the control character"},
           {"\x01", "1:1: expected a word of an MTL file, found the control character"},
       }) {
    expect_refused(scene, {{"s/a.obj", wood}, {"s/a.mtl", r.text}}, "s/a.mtl:" + r.message);
  }
}

TEST(ObjRefusals, NoMoreThan64FilesOfMaterials) {
  std::string obj;
  for (int k = 0; k < 64; ++k) obj += k % 2 == 0 ? "mtllib a.mtl\nmtllib a.mtl a.mtl\n" : "mtllib b.mtl\n";
  const TestFiles files = {{"a.obj", obj}, {"a.mtl", ""}, {"b.mtl", ""}, {"b.obj", obj + "mtllib a.mtl"}};
  EXPECT_TRUE(TestScene(kStart + "obj a.obj\n", {}, files).status.done());
  expect_refused(kStart + "obj b.obj\n", files, "b.obj:97:8: expected at most 64 files of materials, found 'a.mtl'");
}

TEST(ObjRefusals, AFileOf4GiBIsRefusedBeforeItIsRead) {
  // Memory that nobody touches: lines and columns are counted in 32 bits.
  constexpr std::size_t kSize = 0xffffffff;
  struct Huge {
    std::string_view path, text;
  };
  void* const pages = mmap(nullptr, kSize, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (pages == MAP_FAILED) GTEST_SKIP() << "no address space";
  for (const char* path : {"a.obj", "a.mtl"}) {
    Huge huge{path, {static_cast<const char*>(pages), kSize}};
    const Reader reader{[](void* self, std::string_view asked, std::string_view& text) {
                          const Huge& file = *static_cast<const Huge*>(self);
                          text = asked == file.path ? file.text : "mtllib a.mtl\n";
                          return true;
                        },
                        &huge};
    std::byte memory[1000];
    Arena arena(memory, sizeof memory);
    Scene scene;
    const Status status = load_scene("top.scn", kStart + "obj a.obj\n", reader, {}, arena, scene);
    EXPECT_EQ(to_text(status), path + std::string(":1:1: expected a file below 4 GiB"));
  }
  munmap(pages, kSize);
}

TEST(ObjRefusals, PathsThatDoNotFitTogether) {
  // The paths of the scene, the model and its materials share 512 bytes.
  const std::string folder(100, 'd'), model = folder + "/a.obj";
  for (const std::size_t length : {305u, 306u}) {
    const std::string mtl(length, 'm');  // beside 106 of the model, and its folder again
    const TestFiles files = {{model, "mtllib " + mtl + "\n"}, {folder + "/" + mtl, ""}};
    const TestScene s(kStart + "obj " + model + "\n", {}, files);
    EXPECT_EQ(s.status.done(), length == 305) << to_text(s.status);
    if (length == 306) {
      EXPECT_EQ(to_text(s.status).substr(0, 63), model.substr(0, 63));
    }
  }
}

TEST(ObjRefusals, AMistakeThatShowsInTheEndIsTheStatementsThatMadeTheMesh) {
  Options fine;
  fine.sub_patch_size = 1e-9;
  const TestScene s(kStart + "tri m 0 0 0  0 0 1  1 0 0 sub 1\n obj a.obj material m\n", fine,
                    {{"a.obj", kCorners + "f 1 2 3\n"}});
  EXPECT_EQ(to_text(s.status).substr(0, 13), "top.scn:5:2: ") << to_text(s.status);
}

}  // namespace
}  // namespace shodo
