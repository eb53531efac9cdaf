// The report as a document: HTML, Markdown and CSV, its plots, what it reads from beside it, and the command.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.h"
#include "cli/report_memory.h"
#include "cli/report_results.h"

namespace shodo {
namespace {

TEST(ReportDocument, NumbersReadWellAndStayExactInCsv) {
  EXPECT_EQ(shown_text(Cell::number(1234567)), "1,234,567");
  EXPECT_EQ(shown_text(Cell::number(0)), "0");
  EXPECT_EQ(shown_text(Cell::count(999)), "999");
  EXPECT_EQ(shown_text(Cell::count(999499)), "999 k");
  EXPECT_EQ(shown_text(Cell::count(999900)), "1.00 M");
  EXPECT_EQ(shown_text(Cell::count(16886800139)), "16.9 G");
  EXPECT_EQ(shown_text(Cell::bytes(1949456)), "1.95 MB");
  EXPECT_EQ(shown_text(Cell::percent(0.01234)), "1.23 %");
  EXPECT_EQ(shown_text(Cell::percent(0.00001234)), "0.00123 %");
  EXPECT_EQ(shown_text(Cell::real(0.5)), "0.500");
  EXPECT_EQ(shown_text(Cell::real(-12345.6)), "-12,346");
  EXPECT_EQ(shown_text(Cell{}), "-");
  EXPECT_EQ(exact_text(Cell::count(16886800139)), "16886800139");
  EXPECT_EQ(exact_text(Cell::percent(0.0123456789)), "0.0123456789");
  EXPECT_EQ(exact_text(Cell{}), "");
}

TEST(ReportDocument, ForeignCharactersCannotBreakOut) {
  Document document;
  document.title = "a <b> & \"c\"";
  document.blocks.emplace_back(Table{"t.csv", "x,\"y\"", {{"n", "a|b", true}}, {{Cell::words("<i>,|\"")}}, {}});
  EXPECT_NE(html_text(document).find("<h1>a &lt;b&gt; &amp; &quot;c&quot;</h1>"), std::string::npos);
  EXPECT_NE(html_text(document).find("<td class=\"left\">&lt;i&gt;,|&quot;</td>"), std::string::npos);
  EXPECT_NE(markdown_text(document).find("| \\<i\\>,\\|\" |"), std::string::npos);
  ASSERT_EQ(csv_files(document).size(), 1u);
  EXPECT_EQ(csv_files(document)[0].text, "scene,n\n\"x,\"\"y\"\"\",\"<i>,|\"\"\"\n");
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(ReportPlot, RingsAndJoinsTheEfficientPoints) {
  Plot plot{"p.svg", "title", "x", "y", {"one", "two"}, {}};
  plot.points = {{10, 1, 1, 0, true, "first"}, {100, 0.1, 2, 1, true, "second"}, {1000, 2, 3, 1, false, "third"}};
  const std::string svg = svg_text(plot);
  EXPECT_EQ(count_of(svg, "r=\"8\""), 2u);
  EXPECT_EQ(count_of(svg, "stroke-dasharray"), 1u);
  for (const char* told : {"<title>first</title>", "<title>second</title>", "<title>third</title>"})
    EXPECT_EQ(count_of(svg, told), 1u);
  EXPECT_EQ(count_of(svg_text({"p.svg", "none", "x", "y", {}, {}}), "</svg>"), 1u);
}

const std::string kMemoryCosts =
    "room,options,budget,instructions,floating_point,seconds,rows_kept,rows_recomputed,lit_again,placed_again\n"
    "day,--rules 1,2,600000,900,50,12.5,0,1526,1,1\n"
    "day,--rules 1,2,800000,300,20,3.5,1526,0,0,0\n"
    "evening,--rules 1,2,700000,400,30,4.5,1500,26,1,0\n";

TEST(ReportMemory, CostsComeFromTheFileOrNot) {
  const std::vector<MemoryCost> costs = memory_costs(kMemoryCosts);
  ASSERT_EQ(costs.size(), 3u);
  EXPECT_EQ(costs[0].room, "day");
  EXPECT_EQ(costs[0].options, "--rules 1,2");
  EXPECT_EQ(costs[0].budget, 600000);
  EXPECT_EQ(costs[0].seconds, 12.5);
  EXPECT_TRUE(costs[0].placed_again && costs[2].lit_again && !costs[2].placed_again);
  EXPECT_EQ(costs[2].rows_recomputed, 26);
  EXPECT_TRUE(memory_costs("").empty());
  EXPECT_TRUE(memory_costs("another file\n1,2,3\n").empty());
  EXPECT_TRUE(memory_costs(kMemoryCosts + "day,none,x,1,1,1,1,1,1,1\n").empty()) << "not a number";
  EXPECT_TRUE(memory_costs(kMemoryCosts + "1,2,3\n").empty()) << "too few";
}

TEST(ReportMemory, TheChapterHasAPlotAndATableForEachRoom) {
  Document document;
  add_memory_chapter(document, {});
  EXPECT_TRUE(document.blocks.empty());
  add_memory_chapter(document, memory_costs(kMemoryCosts));
  std::size_t tables = 0, points = 0;
  for (const auto& block : document.blocks) {
    if (const Table* table = std::get_if<Table>(&block)) {
      ++tables;
      EXPECT_EQ(table->rows.size(), table->scene.starts_with("day") ? 2u : 1u);
    }
    if (const Plot* plot = std::get_if<Plot>(&block)) points = plot->points.size();
  }
  EXPECT_EQ(tables, 2u);
  EXPECT_EQ(points, 3u);
  EXPECT_EQ(csv_files(document).size(), 1u);
  EXPECT_EQ(plot_files(document).front().name, "memory.svg");
}

TEST(ReportWorkstation, SecondsComeFromTheFileOrNot) {
  const std::string json =
      "{\"options\": \"--rules blocks\", \"day\": {\"direct\": 1.5, \"form_factors\": 2, \"solution\": 0.25,\n"
      " \"map\": 0.125, \"picture\": 10, \"total\": 13.875}, \"evening\": {\"direct\": 3}}";
  const auto day = workstation_seconds(json, "day");
  ASSERT_TRUE(day.has_value());
  EXPECT_EQ(day->direct, 1.5);
  EXPECT_EQ(day->map, 0.125);
  EXPECT_EQ(day->total, 13.875);
  EXPECT_EQ(workstation_options(json), "--rules blocks");
  EXPECT_FALSE(workstation_seconds(json, "evening").has_value()) << "not all numbers are there";
  EXPECT_FALSE(workstation_seconds(json, "night").has_value());
  EXPECT_FALSE(workstation_seconds("", "day").has_value());
  EXPECT_FALSE(workstation_seconds("{\"day\": 3}", "day").has_value());
}

// ---- The command

/// What is wrong with an HTML or SVG text written as XML; empty if every element is closed in order, every attribute is
/// quoted and every entity is one of the four.
std::string malformed(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '&') {
      const std::size_t end = text.find(';', at);
      const std::string name = text.substr(at, end == std::string::npos ? 0 : end - at + 1);
      const std::set<std::string> known{"&amp;", "&lt;", "&gt;", "&quot;"};
      if (!known.contains(name)) return "entity " + text.substr(at, 8);
    }
    if (text[at] == '>') return "a bare > at " + text.substr(at < 20 ? 0 : at - 20, 40);
    if (text[at++] != '<') continue;
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return "a tag without an end";
    const std::string tag = text.substr(at, end - at);
    at = end + 1;
    if (tag[0] == '!') continue;
    if (tag.find('<') != std::string::npos) return "a < in tag " + tag;
    if (tag[0] == '/') {
      if (open.empty() || "/" + open.back() != tag) return "closed out of order: " + tag;
      open.pop_back();
      continue;
    }
    const std::string name = tag.substr(0, tag.find_first_of(" /"));
    if (count_of(tag, "=\"") * 2 != count_of(tag, "\"")) return "an attribute in " + tag;
    if (tag.back() != '/') open.push_back(name);
    if (name == "style") at = text.find("</style>", at);
  }
  return open.empty() ? "" : "not closed: " + open.back();
}

TEST(ReportDocument, TheCheckerOfHtmlSeesMistakes) {
  EXPECT_EQ(malformed("<a b=\"c\"><d/>&amp;</a>"), "");
  for (const char* wrong : {"<a>", "<a></b>", "<a><b></a></b>", "</a>", "<a b=c\"></a>", "&x;", "a & b", "a > b", "<a"})
    EXPECT_NE(malformed(wrong), "") << wrong;
}

class ReportCommand : public testing::Test {
 protected:
  static Outcome report(const TestFolder& folder, const std::string& name, Running::Words more = {}) {
    Running::Words words{"report", test_scene("box.scn"), "-o", folder / name, "--size", "48x40", "--antialias", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

TEST_F(ReportCommand, WritesTheSameBytesTwice) {
  const TestFolder folder;
  const Outcome first = report(folder, "a"), second = report(folder, "b");
  ASSERT_EQ(first.status, 0) << first.err;
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(first.err, "") << "no terminal, no progress";
  const std::vector<std::string> names = folder.entries("a");
  EXPECT_EQ(names, folder.entries("b"));
  for (const char* name : {"cases.csv", "flags.csv", "index.html", "paper.csv", "report.md", "tests-1.svg"})
    EXPECT_TRUE(std::find(names.begin(), names.end(), name) != names.end()) << name;
  for (const std::string& name : names) EXPECT_EQ(file_text(folder / ("a/" + name)), file_text(folder / ("b/" + name)));
}

TEST_F(ReportCommand, WritesHtmlThatIsWellFormedAndNeedsNothing) {
  const TestFolder folder;
  ASSERT_EQ(report(folder, "r").status, 0);
  const std::string html = file_text(folder / "r/index.html");
  EXPECT_EQ(malformed(html), "");
  for (const char* foreign : {"<script", "src=", "href=", "url(", "@import", "<link"})
    EXPECT_EQ(count_of(html, foreign), 0u) << foreign;
  EXPECT_EQ(count_of(html, "http"), count_of(html, "http://www.w3.org/2000/svg"));
  for (const std::string& name : folder.entries("r")) {
    if (!name.ends_with(".svg")) continue;
    const std::string svg = file_text(folder / ("r/" + name));
    EXPECT_EQ(malformed(svg), "") << name;
    EXPECT_EQ(count_of(html, svg), 1u) << name << " stands in the HTML too";
  }
}

/// A Markdown table as rows of cells, without the line under its head.
std::vector<std::vector<std::string>> markdown_table(const std::vector<std::string>& lines, std::size_t& at) {
  std::vector<std::vector<std::string>> rows;
  for (; at < lines.size() && lines[at].starts_with("|"); ++at) {
    if (lines[at].starts_with("|:") || lines[at].starts_with("|-")) continue;
    std::vector<std::string> cells;
    for (std::size_t from = 2; from < lines[at].size();) {
      const std::size_t to = lines[at].find(" |", from);
      cells.push_back(to < from ? "" : lines[at].substr(from, to - from));
      from = to + 3;
    }
    rows.push_back(cells);
  }
  return rows;
}

std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

/// "22.0 M" as 22e6, "1.23 %" as 0.0123; not a number: NaN.
double read_back(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ','), text.end());
  std::istringstream in(text);
  double value = 0;
  std::string unit;
  if (!(in >> value)) return std::nan("");
  in >> unit;
  if (!unit.empty() && unit != "B" && unit.back() == 'B') unit.pop_back();
  const std::map<std::string, double> factors{{"", 1},   {"B", 1},   {"k", 1e3}, {"M", 1e6},
                                              {"G", 1e9}, {"T", 1e12}, {"%", 0.01}};
  const auto factor = factors.find(unit);
  return factor == factors.end() ? std::nan("") : value * factor->second;
}

TEST_F(ReportCommand, SaysTheSameInMarkdownAndCsv) {
  const TestFolder folder;
  ASSERT_EQ(report(folder, "r").status, 0);
  std::map<std::size_t, std::vector<std::string>> csv_by_columns;  // no two files have equally many
  for (const char* name : {"paper.csv", "flags.csv", "cases.csv", "where.csv", "rules.csv"}) {
    const std::vector<std::string> lines = lines_of(file_text(folder / ("r/" + std::string(name))));
    ASSERT_GT(lines.size(), 1u);
    csv_by_columns[csv_cells(lines[0]).size() - 1] = lines;
  }
  ASSERT_EQ(csv_by_columns.size(), 5u);
  const std::vector<std::string> lines = lines_of(file_text(folder / "r/report.md"));
  std::size_t tables = 0, numbers = 0;
  for (std::size_t at = 0; at < lines.size(); ++at) {
    if (!lines[at].starts_with("|")) continue;
    const auto rows = markdown_table(lines, at);
    if (!csv_by_columns.contains(rows[0].size())) continue;
    ++tables;
    const std::vector<std::string>& csv = csv_by_columns[rows[0].size()];
    ASSERT_EQ(rows.size(), csv.size());
    for (std::size_t r = 1; r < rows.size(); ++r) {
      const std::vector<std::string> exact = csv_cells(csv[r]);
      EXPECT_EQ(exact[0], "box");
      for (std::size_t c = 0; c < rows[r].size(); ++c) {
        const std::string& shown = rows[r][c];
        if (exact[c + 1].empty() || exact[c + 1] == shown) continue;
        const double a = read_back(shown), b = std::strtod(exact[c + 1].c_str(), nullptr);
        EXPECT_NEAR(a, b, 0.0051 * std::abs(b)) << shown << " for " << exact[c + 1];  // three digits
        ++numbers;
      }
    }
  }
  EXPECT_EQ(tables, 5u);
  EXPECT_GT(numbers, 100u);
}

TEST_F(ReportCommand, SaysThatFlagsChangeNothing) {
  const TestFolder folder;
  ASSERT_EQ(report(folder, "r").status, 0);
  const std::vector<std::string> lines = lines_of(file_text(folder / "r/flags.csv"));
  ASSERT_GE(lines.size(), 2u);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    EXPECT_EQ(csv_cells(lines[k])[2], "yes");
    EXPECT_EQ(csv_cells(lines[k])[3], "yes");
  }
}

TEST_F(ReportCommand, TakesTheWorkstationsSecondsFromBesideIt) {
  const TestFolder folder;
  folder.write("workstation.json",
               "{\"box\": {\"direct\": 1.5, \"form_factors\": 2.5, \"solution\": 0.25, \"map\": 0.125, "
               "\"picture\": 10.75, \"total\": 15.125}}");
  folder.write("memory-cost.csv", kMemoryCosts);
  ASSERT_EQ(report(folder, "r").status, 0);
  EXPECT_EQ(count_of(file_text(folder / "r/memory.csv"), "\n"), 4u) << "beside it too";
  EXPECT_EQ(count_of(file_text(folder / "r/memory.svg"), "</svg>"), 1u);
  const std::string csv = file_text(folder / "r/paper.csv");
  for (const char* end : {",1.5\n", ",2.5\n", ",0.25\n", ",0.125\n", ",10.75\n", ",15.125\n"})
    EXPECT_EQ(count_of(csv, end), 1u) << end;
}

TEST_F(ReportCommand, TakesSeveralScenes) {
  const TestFolder folder;
  ASSERT_EQ(report(folder, "r", {test_scene("sun.scn")}).status, 0);
  const std::string csv = file_text(folder / "r/cases.csv");
  EXPECT_GT(count_of(csv, "\nbox,"), 5u);
  EXPECT_EQ(count_of(csv, "\nbox,"), count_of(csv, "\nsun,"));
  EXPECT_EQ(count_of(csv, "scene,case,"), 1u);
  EXPECT_EQ(malformed(file_text(folder / "r/index.html")), "");
}

TEST_F(ReportCommand, RefusesWhatItCannotDo) {
  const TestFolder folder;
  ASSERT_EQ(std::system(("mkdir " + (folder / "full") + " && touch " + (folder / "full/file")).c_str()), 0);
  const std::string scene = test_scene("box.scn");
  const struct {
    Running::Words words;
    int status;
    std::string says;
  } cases[] = {
      {{"report", scene}, 2, "report: expected -o and where the report goes, found nothing"},
      {{"report", "-o", folder / "x"}, 2, "report: expected a scene file, found none"},
      {{"report", scene, "-o", "-"}, 2, "-o: expected the name of a folder, found '-'"},
      {{"report", scene, "-o", folder / "x", "--flags", "off"}, 2, "--flags has no meaning for report"},
      {{"report", scene, "-o", folder / "x", "--rules", "none"}, 2, "--rules has no meaning for report"},
      {{"report", scene, "-o", folder / "x", "--csv", "t"}, 2, "--csv has no meaning for report"},
      {{"report", scene, "-o", folder / "full"}, 1, "full: Directory not empty"},
      {{"report", scene, folder / "none.scn", "-o", folder / "x"}, 1, "none.scn: No such file"},
      {{"report", scene, "-o", folder / "x", "--camera", "moon"}, 2, "--camera: expected one of the scene's"},
      {{"report", scene, "-o", folder / "x", "--memory", "4K"}, 4, "the memory budget of 4K is too small"},
  };
  for (const auto& c : cases) {
    const Outcome outcome = run(c.words);
    EXPECT_EQ(outcome.status, c.status) << c.says;
    EXPECT_NE(outcome.err.find(c.says), std::string::npos) << outcome.err;
    EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
  }
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"full"}) << "nothing was left behind";
}

TEST_F(ReportCommand, LeavesNothingWhenItIsInterrupted) {
  const TestFolder folder;
  Running running({"report", test_scene("box.scn"), "-o", folder / "r", "--refine", "12"});
  usleep(300000);
  kill(running.process(), SIGINT);
  const Outcome outcome = running.wait();
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace shodo
