// What the documents show a newcomer is what the program takes and does.
#include <gtest/gtest.h>

#include "cli/program.h"

namespace shodo {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// What stands between two lines of ```.
std::string example_of(const std::string& document) {
  std::string example;
  bool inside = false;
  for (const std::string& line : lines_of(file_text(document))) {
    if (line == "```") {
      inside = !inside;
    } else if (inside) {
      example += line + "\n";
    }
  }
  return example;
}

/// The words of a list like "(background, camera, tri)" or "expected at, turn, or the end": letters and commas.
std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words(1);
  for (const char c : list) {
    if (c >= 'a' && c <= 'z') {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// The part of `text` between two others.
std::string between(const std::string& text, const std::string& first, const std::string& last) {
  const std::size_t from = text.find(first) + first.size();
  return text.substr(from, text.find(last, from) - from);
}

const char* const kTexels = "P6 2 2 255\nabcdefghijkl";

TEST(Documents, TheExampleOfTheSceneFileIsASceneThatIsDrawn) {
  const TestFolder folder;
  folder.write("all.scn", example_of("doc/scene.md"));
  folder.write("oak.ppm", kTexels);
  folder.write("garden.ppm", kTexels);
  folder.write("downlight.ies", file_text("data/luminaires/downlight.ies"));
  folder.write("chair.obj", file_text("data/models/chair.obj"));
  folder.write("chair.mtl", file_text("data/models/chair.mtl"));
  folder.write("desk.scn", "object desk\n");
  const Outcome check = run({"check", "all.scn"}, folder.path());
  ASSERT_EQ(check.status, 0) << check.err;
  EXPECT_TRUE(contains(check.out, "lights:    2 points, 1 polyhedron, 1 sun, 1 opening\n")) << check.out;
  const Outcome render = run({"render", "all.scn", "-o", "x.ppm", "--size", "40x30"}, folder.path());
  EXPECT_EQ(render.status, 0);
  EXPECT_EQ(render.err, "");
}

TEST(Documents, EveryStatementAndWordOfASceneIsExplained) {
  const std::string document = file_text("doc/scene.md"), example = example_of("doc/scene.md");
  const TestFolder folder;
  const auto expected = [&](const std::string& statement) {
    folder.write("x.scn", "shodo 1\nmaterial w diffuse 0.5\nobject o\n" + statement + "\n");
    const Outcome outcome = run({"check", "x.scn"}, folder.path());
    EXPECT_EQ(outcome.status, 3) << statement;
    return outcome.err;
  };
  const std::vector<std::string> statements = words_of(between(expected("?"), "statement (", ")"));
  ASSERT_EQ(statements.size(), 15u);
  for (const std::string& word : statements) {
    EXPECT_TRUE(contains(document, "`" + word)) << word;
    EXPECT_TRUE(contains("\n" + example, "\n" + word + " ") || contains(example, "\n  " + word + " "))
        << word << " is not in the example";
  }
  for (const char* const statement :
       {"camera c ?", "material m ?", "object p ?", "background ?", "light l point ?", "light l area ?",
        "light l sun ?", "light l polyhedron ?", "quad w 0 0 0  1 0 0  1 1 0  0 1 0 ?", "tri w 0 0 0  1 0 0  1 1 0 ?",
        "grid w 2 2  0 0 0  1 0 0  0 0 1  1 0 1 ?", "obj a.obj ?"}) {
    const std::vector<std::string> words = words_of(between(expected(statement), "expected ", "or the end of the"));
    EXPECT_FALSE(words.empty()) << statement;
    for (const std::string& word : words) {
      EXPECT_TRUE(contains(document, "`" + word) || contains(document, word + " ")) << word << " of " << statement;
    }
  }
}

/// "--rules LIST" and so on, one a line of --help.
std::vector<std::string> options_of_help() {
  std::vector<std::string> options;
  for (const std::string& line : lines_of(run({"--help"}).out)) {
    if (!line.starts_with("  -")) continue;
    const std::string option = line.substr(2, line.find("  ", 2) - 2);
    options.push_back(option);
  }
  return options;
}

/// The manual page without its marks.
std::string manual() {
  std::string text;
  for (const std::string& line : lines_of(file_text("doc/shodo.1"))) {
    const std::size_t space = line.find(' ');
    std::string words = line.starts_with(".") ? (space == std::string::npos ? "" : line.substr(space + 1)) : line;
    std::erase_if(words, [](char c) { return c == '\\' || c == '"'; });
    for (std::size_t at; (at = words.find("  ")) != std::string::npos;) words.erase(at, 1);
    text += words + "\n";
  }
  return text;
}

TEST(Documents, TheManualHasEveryOptionWithItsValuesRangeAndDefault) {
  const std::string text = manual();
  const std::string scene = test_scene("sun.scn");
  const std::vector<std::string> options = options_of_help();
  ASSERT_GT(options.size(), 25u);
  for (const std::string& option : options) {
    const std::string name = option.substr(0, option.find(' '));
    EXPECT_TRUE(contains(text, "\n" + option + "\n")) << option;
    // The range is what the message about a wrong value names.
    const Outcome wrong = run({"render", scene, name, "?"});
    if (!contains(wrong.err, "a number from ")) continue;
    const std::string range = between(wrong.err, "a number from ", ", found");
    const std::string entry = between(text, "\n" + option + "\n", "\n-");
    const std::string low = range.substr(0, range.find(" to ")), high = range.substr(range.find(" to ") + 4);
    EXPECT_TRUE(contains(entry, low + " to " + high)) << option << ": " << range << "\n" << entry;
  }
  // What brackets at the end of a line of --help name as the default stands in the page, too.
  for (const std::string& line : lines_of(run({"--help"}).out)) {
    if (!line.starts_with("  --") || !line.ends_with(")")) continue;
    const std::string option = line.substr(2, line.find("  ", 2) - 2), value = line.substr(line.rfind('('));
    EXPECT_TRUE(contains(between(text, "\n" + option + "\n", "\n-"), value)) << option << " " << value;
  }
}

TEST(Documents, EveryFieldOfTheStatisticsIsExplained) {
  const std::string document = file_text("doc/output.md");
  const TestFolder folder;
  const std::string scene = source_path("tests/cli/scenes/sun.scn");
  const Outcome outcome = run({"map", scene, "-o", "maps", "--stats", "-"}, folder.path());
  ASSERT_EQ(outcome.status, 0);
  for (std::size_t at = 0; (at = outcome.out.find('"', at)) != std::string::npos;) {
    const std::size_t end = outcome.out.find('"', at + 1);
    const std::string word = outcome.out.substr(at + 1, end - at - 1);
    if (outcome.out[end + 1] == ':') {
      const auto stands = [&](const char* before, const char* after) {
        return contains(document, before + word + after);
      };
      EXPECT_TRUE(stands("`", "`") || stands("{", ",") || stands(", ", ",") || stands(", ", "}")) << word;
    }
    at = end + 1;
  }
  ASSERT_EQ(run({"map", scene, "-o", "more", "--csv", "csv"}, folder.path()).status, 0);
  EXPECT_TRUE(contains(document, lines_of(file_text(folder / "csv"))[0] + "\n"));
  EXPECT_TRUE(contains(document, lines_of(file_text(folder / "maps/index.csv"))[0] + "\n"));
}

TEST(Documents, MeasuringShowsTheLinesOfTheDoor) {
  const TestFolder folder;
  const Outcome outcome = run({"map", source_path("data/door.scn"), "-o", "maps", "--summary", "-"}, folder.path());
  ASSERT_EQ(outcome.status, 0);
  const std::string document = file_text("doc/measuring.md");
  for (const std::string& line : lines_of(outcome.out)) {
    const bool shown = contains(document, "    " + line + "\n");
    EXPECT_TRUE(shown || line.starts_with("object,")) << line;
  }
}

}  // namespace
}  // namespace shodo
