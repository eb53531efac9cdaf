// `include`: in place, within the top file's folder, never without end (contract 2).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "scene/include_path.h"
#include "support/scene_from_text.h"

namespace shodo {
namespace {

std::string place(const Status& status) {
  return std::string(status.file) + ":" + std::to_string(status.line) + ":" + std::to_string(status.column);
}

TEST(SceneInclude, ReadsStatementsInPlace) {
  const LoadedScene s("shodo 1\ninclude a.scn # first\ninclude sub/b.scn\nquad m 0 0 0 0 0 1 1 0 1 1 0 0 patches 1 1\n",
                      {},
                      {{"a.scn", "\xef\xbb\xbfmaterial m diffuse 0.5\r\nobject o"},
                       {"sub/b.scn", "tri m 0 0 0 0 0 1 1 0 0 patches 1\ninclude c.scn"},
                       {"sub/c.scn", "object p\ndisplay 1 2\n"}});
  ASSERT_EQ(s.scene.objects.size(), 2u);
  EXPECT_EQ(s.scene.objects[0].mesh_count, 1u);
  EXPECT_EQ(s.scene.objects[1].mesh_count, 1u);
  EXPECT_EQ(s.scene.meshes[1].kind, MeshKind::kQuad);
  EXPECT_EQ(s.scene.display.max_cd_m2, 2);
}

TEST(SceneInclude, GivesTheSameSceneAsTheTextInPlace) {
  const std::string part = "object p\ntri m 0 0 0 0 0 3 3 0 0\nlight l point at 1 1 1 intensity 1\n";
  const std::string start = "shodo 1\nmaterial m diffuse 0.5\nobject o\ntri m 0 0 0 0 0 1 1 0 0\n", end = "sub p 5 5\n";
  const LoadedScene whole(start + part + end), parts(start + "include x\n" + end, {}, {{"x", part}});
  ASSERT_EQ(whole.arena.used(), parts.arena.used());
  EXPECT_TRUE(std::equal(whole.scene.vertices.begin(), whole.scene.vertices.end(), parts.scene.vertices.begin()));
  EXPECT_EQ(whole.scene.sub_patch_count, parts.scene.sub_patch_count);
  EXPECT_EQ(whole.scene.meshes[1].su, parts.scene.meshes[1].su);
}

TEST(SceneInclude, AMistakeNamesTheFileItIsIn) {
  const TestFiles files = {{"sub/a.scn", "material m diffuse 0.5\n\ninclude b.scn"}, {"sub/b.scn", "\n  object o o"}};
  EXPECT_EQ(place(TestScene("shodo 1\ninclude sub/a.scn", {}, files).status), "sub/b.scn:2:12");
  // And afterwards again the including one, in its own line.
  EXPECT_EQ(place(TestScene("shodo 1\ninclude m\n\n bad", {}, {{"m", "material m diffuse 0.5"}}).status),
            "top.scn:4:2");
}

TEST(SceneInclude, AFileThatEndsInTheMiddleOfAStatementDoesNotGoOnOutside) {
  const TestScene s("shodo 1\ninclude a\n0.5\n", {}, {{"a", "material m diffuse"}});
  EXPECT_EQ(place(s.status), "a:1:19");
  EXPECT_STREQ(s.status.message, "expected a number (diffuse), found the end of the file");
}

TEST(SceneInclude, TheVersionAndTheUnitStayInTheTopFile) {
  EXPECT_EQ(place(TestScene("shodo 1\ninclude a", {}, {{"a", "shodo 1"}}).status), "a:1:1");
  EXPECT_EQ(place(TestScene("shodo 1\ninclude a", {}, {{"a", "\nunit m"}}).status), "a:2:1");
  EXPECT_EQ(place(TestScene("include a", {}, {{"a", "shodo 1"}}).status), "top.scn:1:1");
}

TEST(SceneInclude, AFileThatCannotBeReadIsAFileError) {
  const TestScene s("shodo 1\n include sub/nothing.scn");
  EXPECT_EQ(s.status.code, StatusCode::kFile);
  EXPECT_EQ(place(s.status), "top.scn:2:10");
  EXPECT_STREQ(s.status.message, "expected a file that can be read, found 'sub/nothing.scn'");
  std::byte memory[64];
  Arena arena(memory, sizeof memory);
  Scene scene;
  EXPECT_EQ(load_scene("x", "shodo 1\ninclude a", {}, {}, arena, scene).code, StatusCode::kFile) << "without a reader";
}

TEST(SceneInclude, PathsAreResolvedWithinTheTopFolder) {
  struct Case {
    const char *including, *path, *resolved;
    PathProblem problem;
  };
  const PathProblem none = PathProblem::kNone;
  for (const Case& c : {
           Case{"top.scn", "a.scn", "a.scn", none},
           Case{"sub/x.scn", "a.scn", "sub/a.scn", none},
           Case{"sub/x.scn", "../a.scn", "a.scn", none},
           Case{"a/b/x.scn", "../../c/./d//e.scn", "c/d/e.scn", none},
           Case{"a/b/x.scn", "../c/../d.scn", "a/d.scn", none},
           Case{"top.scn", "./a/b/../../c.scn", "c.scn", none},
           Case{"top.scn", "..a/...", "..a/...", none},
           Case{"top.scn", "../a.scn", "", PathProblem::kOutside},
           Case{"sub/x.scn", "../../a.scn", "", PathProblem::kOutside},
           Case{"top.scn", "a/../../b/c.scn", "", PathProblem::kOutside},
           Case{"sub/x.scn", "../../sub/a.scn", "", PathProblem::kOutside},
           Case{"top.scn", "/a.scn", "", PathProblem::kAbsolute},
           Case{"sub/x.scn", "/sub/a.scn", "", PathProblem::kAbsolute},
           Case{"top.scn", "a\\b.scn", "", PathProblem::kForbidden},
           Case{"top.scn", "C:a.scn", "", PathProblem::kForbidden},
           Case{"top.scn", "a/", "", PathProblem::kNoFile},
           Case{"top.scn", "a/..", "", PathProblem::kNoFile},
           Case{"top.scn", ".", "", PathProblem::kNoFile},
       }) {
    char buffer[16];
    std::size_t size = 0;
    const PathProblem problem = resolve_include(c.including, c.path, buffer, size);
    EXPECT_EQ(problem, c.problem) << c.including << " " << c.path;
    if (problem == none) {
      EXPECT_EQ(std::string(buffer, size), c.resolved);
    }
  }
}

TEST(SceneInclude, BadPathsAreRefusedAtTheirPlace) {
  for (const char* path : {"/a", "../a", "a\\b", "c:/a", "a/", ".", "..", "x/../../a"}) {
    const TestScene s("shodo 1\ninclude " + std::string(path), {}, {{"a", ""}});
    EXPECT_EQ(s.status.code, StatusCode::kScene) << path;
    EXPECT_EQ(place(s.status), "top.scn:2:9") << path;
    EXPECT_NE(std::string(s.status.message).find(", found '" + std::string(path)), std::string::npos);
  }
  EXPECT_EQ(place(TestScene("shodo 1\ninclude").status), "top.scn:2:8");
  EXPECT_EQ(place(TestScene("shodo 1\ninclude a b", {}, {{"a", ""}}).status), "top.scn:2:11");
}

TEST(SceneInclude, PathsFitTheirBufferOrAreRefused) {
  for (std::size_t room = 0; room < 12; ++room) {
    std::vector<char> buffer(room);
    std::size_t size = 0;
    const PathProblem problem = resolve_include("ab/x", "cd/efg", buffer, size);
    EXPECT_EQ(problem, room < 9 ? PathProblem::kTooLong : PathProblem::kNone) << room;
  }
  for (const std::size_t length : {100u, 500u, 510u, 512u, 513u, 5000u}) {
    const std::string name(length, 'n');
    EXPECT_EQ(TestScene("shodo 1\ninclude " + name, {}, {{name, ""}}).status.done(), length <= 512) << length;
  }
}

TEST(SceneInclude, CyclesAreRefused) {
  EXPECT_EQ(place(TestScene("shodo 1\ninclude top.scn", {}, {{"top.scn", ""}}).status), "top.scn:2:9");
  EXPECT_EQ(place(TestScene("shodo 1\ninclude a", {}, {{"a", "include ./a"}}).status), "a:1:9");
  EXPECT_EQ(place(TestScene("shodo 1\ninclude s/a", {}, {{"s/a", "include ../s/b"}, {"s/b", "\ninclude a"}}).status),
            "s/b:2:9");
  std::byte memory[64];
  Arena arena(memory, sizeof memory);
  Scene scene;
  TestFiles files = {{"day.scn", ""}};
  const Status status = load_scene("data/day.scn", "shodo 1\ninclude day.scn", reader_of(files), {}, arena, scene);
  EXPECT_EQ(place(status), "data/day.scn:2:9");
}

TEST(SceneInclude, TheSameFileTwiceIsNoCycle) {
  EXPECT_TRUE(TestScene("shodo 1\ninclude a\ninclude a", {}, {{"a", "# nothing\n"}}).status.done());
}

TEST(SceneInclude, EightFilesWithinEachOtherAndNotNine) {
  TestFiles files;
  for (int k = 1; k <= 9; ++k) files[std::to_string(k)] = "include " + std::to_string(k + 1);
  files["8"] = "";
  EXPECT_TRUE(TestScene("shodo 1\ninclude 1", {}, files).status.done());
  files["8"] = "include 9";
  files["9"] = "";
  EXPECT_EQ(place(TestScene("shodo 1\ninclude 1", {}, files).status), "8:1:9");
}

// Eight levels of ten includes each are 10^8 files.
TEST(SceneInclude, ManyTimesManyIncludesEnd) {
  TestFiles files;
  for (int level = 1; level <= 8; ++level) {
    for (int k = 0; k < 10; ++k)
      files[std::to_string(level)] += level == 8 ? "\n" : "include " + std::to_string(level + 1) + "\n";
  }
  const TestScene s("shodo 1\ninclude 1\n", {}, files);
  EXPECT_EQ(s.status.code, StatusCode::kScene);
  EXPECT_NE(std::string(s.status.message).find("at most 1000 includes in all"), std::string::npos) << s.status.message;
  std::string thousand = "shodo 1\n";
  for (int k = 0; k < 1000; ++k) thousand += "include e\n";
  EXPECT_TRUE(TestScene(thousand, {}, {{"e", ""}}).status.done());
  EXPECT_EQ(place(TestScene(thousand + "include e", {}, {{"e", ""}}).status), "top.scn:1002:9");
}

/// Gives another text every time.
struct ChangingFile {
  std::vector<std::string> texts;
  std::size_t reads = 0;
};

TEST(SceneInclude, AFileThatChangesWhileItIsReadIsRefused) {
  const std::string one = "object a\ntri m 0 0 0 0 0 1 1 0 0\n", other = "object bb\ntri m 0 0 0 0 0 1 1 0 0\n";
  const std::string light = "light l point at 0 0 0 intensity 1\n", grid = "grid m 2 2 0 0 0 1 0 0 0 0 1 1 0 1\n";
  const std::string camera = "camera c eye 0 0 0 look 0 0 1 up 0 1 0 fov 9\n", material = "material n diffuse 0\n";
  const std::string texts[] = {one, other, one + one.substr(9), light, one + light, one + grid, camera, material, ""};
  std::vector<std::byte> memory(10000);
  for (const std::string& first : texts) {
    for (const std::string& second : texts) {
      ChangingFile file{{first, second}};
      Reader reader;
      reader.context = &file;
      reader.read = [](void* context, std::string_view, std::string_view& text) {
        ChangingFile& changing = *static_cast<ChangingFile*>(context);
        text = changing.texts[changing.reads++ % 2];
        return true;
      };
      Arena arena(memory.data(), memory.size());
      Scene scene;
      const Status status =
          load_scene("top.scn", "shodo 1\nmaterial m diffuse 0.5\ninclude changing\n", reader, {}, arena, scene);
      EXPECT_EQ(status.done(), first == second) << first << "then\n" << second;
      if (!status.done()) {
        EXPECT_EQ(arena.used(), 0u);
      }
    }
  }
}

}  // namespace
}  // namespace shodo
