// Words on the command line: what is taken, what is refused and how.
#include <gtest/gtest.h>

#include "cli/program.h"

namespace shodo {
namespace {

using testing::Test;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(CommandLine, HelpNamesEveryOptionOfTheContract) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.err, "");
  for (const char* word :
       {"render",        "map",      "report",       "difference",    "check",        "-o",        "--memory",
        "--flags",       "--rules",  "--tolerance",  "--patch",       "--sub-patch",  "--refine",  "--tiers",
        "--segments",    "--size",   "--scale-rows", "--interpolate", "--row-values", "--camera",  "--antialias",
        "--false-colour", "--isolux", "--show",      "--csv",         "--stats",      "--summary", "--quiet",
        "--gather",      "--help",   "--version"}) {
    EXPECT_TRUE(contains(help.out, word)) << word;
  }
  EXPECT_EQ(run({"render", "--help"}).out, help.out);
}

TEST(CommandLine, VersionIsOneLine) {
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out, "shodo 0.1.0\n");
}

struct Mistake {
  Running::Words words;
  std::string said;
};

TEST(CommandLine, EveryMistakeEndsWithStatus2AndOneLineThatNamesIt) {
  const std::string scene = test_scene("sun.scn");
  const auto render = [&](Running::Words more) {
    Running::Words words{"render", scene, "-o", "x.ppm"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const Mistake mistakes[] = {
      {{}, "expected a command"},
      {{"paint"}, "'paint'"},
      {{"render"}, "expected a scene file"},
      {{"render", scene}, "expected -o"},
      {{"render", "-", "-o", "x.ppm"}, "'-'"},
      {{"map", scene}, "expected -o"},
      {{"map", scene, "-o", "-"}, "expected the name of a folder"},
      {{"render", scene, scene, "-o", "x.ppm"}, "expected one scene"},
      {{"render", scene, "-o", "x.jpg"}, ".png or .ppm"},
      {{"render", scene, "-o", ".png"}, ".png or .ppm"},
      {{"render", scene, "-o", "-"}, ".png or .ppm"},
      {{"render", scene, "-o"}, "-o: expected a name, found nothing"},
      {{"render", scene, "-o", "--quiet"}, "-o: expected a name, found nothing"},
      {{"check", scene, "-o", "x.ppm"}, "-o has no meaning for check"},
      {{"check", scene, "--csv", "x"}, "--csv has no meaning for check"},
      {{"map", scene, "-o", "m", "--size", "8x8"}, "--size has no meaning for map"},
      {{"map", scene, "-o", "m", "--antialias", "4"}, "--antialias has no meaning for map"},
      {{"map", scene, "-o", "m", "--camera", "main"}, "--camera has no meaning for map"},
      {render({"--colour"}), "unknown option '--colour'"},
      {render({"--sizes", "8x8"}), "unknown option '--sizes'"},
      {render({"-q"}), "unknown option '-q'"},
      {render({"--quiet=yes"}), "--quiet takes no value"},
      {render({"--size", "8x8", "--size", "8x8"}), "--size is given twice"},
      {render({"--memory"}), "--memory: expected"},
      {render({"--memory", "8m"}), "found '8m'"},
      {render({"--memory", "0"}), "found '0'"},
      {render({"--memory", "-1"}), "found '-1'"},
      {render({"--memory", "1.5M"}), "found '1.5M'"},
      {render({"--memory", "M"}), "found 'M'"},
      {render({"--memory", ""}), "found ''"},
      {render({"--memory", "99999999999999999999"}), "--memory: expected"},
      {render({"--memory", "1025G"}), "--memory: expected"},
      {render({"--flags", "on"}), "--flags: expected off, auto or scene"},
      {render({"--rules", "some"}), "--rules: expected none, all, or a list"},
      {render({"--rules", "4"}), "found '4'"},
      {render({"--rules", "1,1"}), "found '1,1'"},
      {render({"--rules", "2,2+"}), "found '2,2+'"},
      {render({"--rules", "3,blocks"}), "found '3,blocks'"},
      {render({"--rules", "blocks:0.1,3"}), "found 'blocks:0.1,3'"},
      {render({"--rules", "1,"}), "found '1,'"},
      {render({"--rules", "none,1"}), "found 'none,1'"},
      {render({"--rules", "3:0"}), "found '3:0'"},
      {render({"--rules", "1:2"}), "found '1:2'"},
      {render({"--rules", "blocks:2"}), "found 'blocks:2'"},
      {render({"--tolerance", "0"}), "found '0'"},
      {render({"--tolerance", "1e-13"}), "--tolerance: expected a number from 1e-12 to 1"},
      {render({"--tolerance", "nan"}), "found 'nan'"},
      {render({"--tolerance", "1e-4x"}), "found '1e-4x'"},
      {render({"--patch", "-1"}), "--patch: expected"},
      {render({"--patch", "0"}), "--patch: expected a number from 1e-30 to 1e30"},
      {render({"--patch", "1e31"}), "--patch: expected a number from 1e-30 to 1e30"},
      {render({"--patch", "inf"}), "--patch: expected"},
      {render({"--sub-patch", "1,5"}), "--sub-patch: expected"},
      {render({"--refine", "0"}), "--refine: expected"},
      {render({"--refine", "1001"}), "--refine: expected"},
      {render({"--tiers", "far"}), "--tiers: expected near, or a number"},
      {render({"--tiers", "2"}), "--tiers: expected"},
      {render({"--segments", "16"}), "--segments: expected"},
      {render({"--segments", "64,16"}), "--segments: expected"},
      {render({"--segments", "16,32"}), "--segments: expected"},
      {render({"--segments", "16,64,256"}), "--segments: expected"},
      {render({"--scale-rows", "yes"}), "--scale-rows: expected on or off"},
      {render({"--interpolate", "1"}), "--interpolate: expected on or off"},
      {render({"--gather", "0"}), "--gather: expected on, off, or a whole number from 1 to 65536, found '0'"},
      {render({"--gather", "65537"}), "--gather: expected on, off, or a whole number from 1 to 65536"},
      {render({"--gather", "4294967297"}), "--gather: expected"},
      {render({"--gather", "-1"}), "--gather: expected"},
      {render({"--gather", "1e-3"}), "--gather: expected"},
      {render({"--gather", "64.0"}), "--gather: expected"},
      {render({"--gather", ""}), "--gather: expected"},
      {render({"--gather", "on", "--rules", "1"}), "--gather works without --rules or with blocks alone"},
      {render({"--mirror-light", "on", "--gather", "on"}), "--gather works without --mirror-light, found on"},
      {render({"--rules", "2+,blocks", "--gather", "64"}), "--gather works without --rules or with blocks alone"},
      {{"check", scene, "--rules", "all", "--gather", "on"}, "--gather works without --rules or with blocks alone"},
      {render({"--row-values", "32"}), "--row-values: expected 16 or 64"},
      {render({"--size", "640"}), "--size: expected"},
      {render({"--size", "0x8"}), "--size: expected"},
      {render({"--size", "8x16385"}), "--size: expected"},
      {render({"--size", "8X8"}), "--size: expected"},
      {render({"--size", "-8x8"}), "--size: expected"},
      {render({"--size", "8x8x8"}), "--size: expected"},
      {render({"--antialias", "2"}), "--antialias: expected 1, 4 or 16"},
      {render({"--camera", ""}), "--camera: expected"},
      {render({"--false-colour", "0,1e-4"}), "LOW from 0, HIGH from 0.001 to 1e9 and above LOW, found '0,1e-4'"},
      {render({"--isolux", "0,5"}), "numbers from 0.001 to 1e9 with commas between, found '0,5'"},
      {render({"--csv", ""}), "--csv: expected"},
      {render({"--csv", "-", "--stats", "-"}), "two outputs"},
      {render({"--csv", "x.ppm"}), "two outputs"},
      {render({"--stats", "x.ppm"}), "two outputs"},
  };
  const TestFolder folder;
  for (const Mistake& mistake : mistakes) {
    const Outcome outcome = run(mistake.words, folder.path());
    const std::string shown = testing::PrintToString(mistake.words);
    EXPECT_EQ(outcome.status, 2) << shown;
    EXPECT_EQ(outcome.out, "") << shown;
    EXPECT_TRUE(contains(outcome.err, mistake.said)) << shown << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "(see shodo --help)")) << shown << outcome.err;
    EXPECT_EQ(lines_of(outcome.err).size(), 1u) << shown;
  }
  EXPECT_TRUE(folder.entries().empty());
}

TEST(CommandLine, AnOutputIsNeverAFileThatIsReadNorAnotherOutput) {
  const TestFolder folder;
  const std::string scene = file_text(test_scene("sun.scn")), picture = "P6\n1 1\n255\nabc";
  folder.write("a.scn", scene);
  folder.write("a.ppm", picture);
  ASSERT_EQ(symlink("a.scn", (folder / "link").c_str()), 0);
  ASSERT_EQ(mkdir((folder / "maps").c_str(), 0777), 0);
  const Mistake mistakes[] = {
      {{"render", "a.scn", "-o", "x.ppm", "--csv", "a.scn"}, "the output 'a.scn' is a file that is read"},
      {{"render", "./a.scn", "-o", "x.ppm", "--stats", "maps/../a.scn"}, "the output 'maps/../a.scn' is a file"},
      {{"map", "a.scn", "-o", "m", "--summary", "link"}, "the output 'link' is a file that is read"},
      {{"difference", "a.ppm", "a.ppm", "-o", "./a.ppm"}, "the output './a.ppm' is a file that is read"},
      {{"render", "a.scn", "-o", "x.ppm", "--csv", "./x.ppm"}, "two outputs are one file, found './x.ppm'"},
      {{"map", "a.scn", "-o", "m", "--csv", "x", "--stats", "maps/../x"}, "two outputs are one file"},
      {{"map", "a.scn", "-o", "maps", "--csv", "./maps/x"}, "'./maps/x' lies in the folder that -o makes anew"}};
  for (const Mistake& mistake : mistakes) {
    const Outcome outcome = run(mistake.words, folder.path());
    const std::string shown = testing::PrintToString(mistake.words);
    EXPECT_EQ(outcome.status, 2) << shown;
    EXPECT_TRUE(contains(outcome.err, mistake.said)) << shown << outcome.err;
  }
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a.ppm", "a.scn", "link", "maps"}));
  EXPECT_EQ(file_text(folder / "a.scn"), scene);
  EXPECT_EQ(file_text(folder / "a.ppm"), picture);
  // What is written there keeps nothing.
  EXPECT_EQ(run({"render", "a.scn", "-o", "x.ppm", "--csv", "/dev/null", "--size", "2x2"}, folder.path()).status, 0);
}

TEST(CommandLine, AnOutputIsNeverAFileThatTheSceneNames) {
  const TestFolder folder;
  const std::string top = "include part.scn\nobject o\nobj model.obj\n"
                          "light l point at 1 1 1 towards 0 -1 0 ies s.ies\n";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.scn", "shodo 1\nmaterial m diffuse 0.3 texture tiles.ppm\n" + top + "quad m 0 0 0 0 0 1 1 0 1 1 0 0\n"},
      {"part.scn", "camera c eye 1 1 1 look 0 0 0 up 0 1 0 fov 60\n"},
      {"tiles.ppm", file_text(test_scene("tiles.ppm"))},
      {"model.obj", file_text(test_scene("model.obj"))},
      {"model.mtl", file_text(test_scene("model.mtl"))},
      {"s.ies", file_text(test_scene("spread.ies"))}};
  for (const auto& [name, text] : files) folder.write(name, text);
  for (const std::string name : {"part.scn", "tiles.ppm", "model.obj", "model.mtl", "s.ies"}) {
    for (const Running::Words& words : std::vector<Running::Words>{
             {"map", "a.scn", "-o", "m", "--csv", name}, {"render", "a.scn", "-o", "x.ppm", "--stats", "./" + name}}) {
      const Outcome outcome = run(words, folder.path());
      EXPECT_EQ(outcome.status, 2) << name;
      EXPECT_TRUE(contains(outcome.err, name + "' is a file that is read")) << outcome.err;
    }
  }
  EXPECT_EQ(run({"render", "a.scn", "-o", "tiles.ppm"}, folder.path()).status, 2);
  EXPECT_EQ(run({"map", "a.scn", "-o", "m", "--csv", "s.csv"}, folder.path()).status, 0);
  for (const auto& [name, text] : files) EXPECT_EQ(file_text(folder / name), text) << name;
  EXPECT_EQ(folder.entries().size(), files.size() + 2);
}

TEST(CommandLine, EveryOptionIsTakenAtBothEndsOfItsRange) {
  const std::string scene = test_scene("sun.scn");
  const std::vector<Running::Words> options = {
      {"--memory", "640K"},    {"--memory", "8M"},        {"--memory", "1G"},        {"--memory", "1000000"},
      {"--memory=1024G"},      {"--flags", "off"},        {"--rules", "none"},       {"--tolerance", "1e-12"},
      {"--tolerance", "1"},    {"--patch", "0.25"},       {"--sub-patch", ".1"},     {"--refine", "0.001"},
      {"--refine", "4"},       {"--tiers", "near"},       {"--tiers", "1e-9"},       {"--tiers", "1"},
      {"--segments", "1,1"},   {"--segments", "256,256"}, {"--segments", "1,64"},    {"--scale-rows", "on"},
      {"--scale-rows", "off"}, {"--interpolate", "on"},   {"--interpolate", "off"},  {"--row-values", "16"},
      {"--gather", "on"},      {"--gather", "off"},       {"--gather", "1"},         {"--gather", "65536"},
      {"--row-values", "64"},  {"--size", "1x1"},         {"--size", "16384x16384"}, {"--antialias", "1"},
      {"--antialias", "4"},    {"--antialias", "16"},     {"--camera", "side"},      {"--quiet"},
      {"--flags", "auto"},     {"--flags", "scene"},      {"--rules", "all"},        {"--rules", "1,2,3:2.5"},
      {"--rules", "2+"},       {"--rules", "blocks,1"},   {"--rules", "blocks:1e-9"}};
  for (const Running::Words& option : options) {
    Running::Words words{"check", scene};
    words.insert(words.end(), option.begin(), option.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << option[0] << outcome.err;
    EXPECT_EQ(outcome.err, "") << option[0];
  }
}

TEST(CommandLine, OptionsMayComeBeforeTheCommandAndWithAnEqualsSign) {
  const TestFolder folder;
  const Outcome outcome =
      run({"--size=4x3", "--quiet", "render", "-o=x.ppm", test_scene("sun.scn"), "-o", "y.ppm"}, folder.path());
  EXPECT_EQ(outcome.status, 2) << "-o takes no equals sign";
  EXPECT_EQ(run({"--size=4x3", "--quiet", "render", "-o", "x.ppm", test_scene("sun.scn")}, folder.path()).status, 0);
  EXPECT_EQ(file_text(folder / "x.ppm").substr(0, 11), "P6\n4 3\n255\n");
}

TEST(CommandLine, ACameraThatTheSceneLacksIsNamedWithThoseItHas) {
  const TestFolder folder;
  for (const Running::Words& words :
       {Running::Words{"check", test_scene("sun.scn"), "--camera", "roof"},
        Running::Words{"render", test_scene("sun.scn"), "-o", "x.ppm", "--camera", "roof"}}) {
    const Outcome outcome = run(words, folder.path());
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(contains(outcome.err, "main, side") && contains(outcome.err, "'roof'")) << outcome.err;
  }
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace shodo
