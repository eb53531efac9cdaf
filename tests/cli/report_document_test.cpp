// The report as a document: HTML, Markdown and CSV, its plots, what it reads from beside it, and the command.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.h"
#include "cli/report_counts.h"
#include "cli/report_memory.h"
#include "cli/report_results.h"
#include "cli/report_scaling.h"

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

/// Places of the numbers: x of their middle and y of their foot.
std::vector<std::pair<double, double>> number_places(const std::string& svg) {
  std::vector<std::pair<double, double>> places;
  std::size_t at = svg.find("<g font-size=\"10\"");
  const std::size_t end = svg.find("</g>", at);
  while ((at = svg.find("<text x=\"", at + 1)) < end) {
    double x = 0, y = 0;
    if (std::sscanf(svg.c_str() + at, "<text x=\"%lf\" y=\"%lf\"", &x, &y) == 2) places.emplace_back(x, y);
  }
  return places;
}

TEST(ReportPlot, NumbersOfACrowdStandApart) {
  Plot plot{"p.svg", "title", "x", "y", {"one"}, {}};
  for (std::uint32_t k = 0; k < 36; ++k)  // as many as a report has cases: six by six, 3 to 4 pixels apart
    plot.points.push_back({1000 + 12.0 * (k % 6), 1000 + 12.0 * (k / 6), k + 1, 0, false, ""});
  plot.points.push_back({10000, 10000, 37, 0, false, ""});
  const std::string svg = svg_text(plot);
  const auto places = number_places(svg);
  ASSERT_EQ(places.size(), 37u);
  for (std::size_t a = 0; a < places.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double width = 3 * ((a < 9 ? 1 : 2) + (b < 9 ? 1 : 2));  // half of both: a digit is 6 wide
      const bool apart = std::abs(places[a].first - places[b].first) > width ||
                         std::abs(places[a].second - places[b].second) > 9;
      EXPECT_TRUE(apart) << a + 1 << " " << b + 1;
    }
  }
}

TEST(ReportPlot, EveryGroupHasAMarkOfItsOwn) {
  Plot plot{"p.svg", "title", "x", "y", {}, {}};
  for (std::uint32_t g = 0; g < kCaseGroups; ++g) {
    plot.groups.emplace_back(group_name(static_cast<CaseGroup>(g)));
    plot.points.push_back({1.0 + g, 1, 0, g, false, "point"});
  }
  const std::string svg = svg_text(plot);
  std::set<std::string> marks;
  for (std::size_t at = svg.find("</title>", svg.find("<title>point")); at != std::string::npos;
       at = svg.find("</title>", at + 1))
    marks.insert(svg.substr(at, svg.find("</g>", at) - at));
  EXPECT_EQ(marks.size(), kCaseGroups);
}

TEST(ReportPlot, AnAxisHasTwoNumbersAtLeast) {
  // Both between two round numbers; and one point alone.
  const PlotPoint low{123.45, 1.15, 0, 0, false, ""}, high{150, 1.85, 0, 0, false, ""};
  const std::string svg = svg_text({"p.svg", "t", "x", "y", {"a"}, {low, high}});
  for (const char* tick : {">123.5<", ">150<", ">1.15<", ">1.85<"}) EXPECT_EQ(count_of(svg, tick), 1u) << tick;
  const std::string one = svg_text({"p.svg", "t", "x", "y", {"a"}, {low}});
  for (const char* tick : {">123.5<", ">1.15<"}) EXPECT_EQ(count_of(one, tick), 1u) << tick;
}

TEST(ReportPlot, TheLegendStaysInside) {
  Plot plot{"p.svg", "title", "x", "y", {}, {}};
  for (std::uint32_t g = 0; g < kCaseGroups; ++g) {
    plot.groups.emplace_back(group_name(static_cast<CaseGroup>(g)));
    plot.points.push_back({1.0 + g, 1, 0, g, true, "point"});
  }
  const std::string svg = svg_text(plot);
  std::vector<std::string> texts = plot.groups;
  texts.emplace_back("efficient");
  for (const std::string& text : texts) {
    const std::size_t end = svg.find("text-anchor=\"start\">" + text + "</text>");
    ASSERT_NE(end, std::string::npos) << text;
    double x = 0, y = 0;
    ASSERT_EQ(std::sscanf(svg.c_str() + svg.rfind("<text", end), "<text x=\"%lf\" y=\"%lf\"", &x, &y), 2);
    EXPECT_LE(x + 5.9 * static_cast<double>(text.size()), 620) << text;  // as wide as letters are in the mean
    EXPECT_LE(y, 440 - 4) << text;
  }
}

TEST(ReportCounts, CostsOfCasesComeFromTheFile) {
  const std::string head = "room,options,instructions,floating_point,seconds\n";
  CaseCosts costs;
  ASSERT_TRUE(costs.read(head + "day,--rules 1,2 --segments 16,64,5000,200,1.5\nevening,--rules none,7,1,0.25\n"));
  const auto day = costs.find("day", "--rules 1,2 --segments 16,64");
  ASSERT_TRUE(day.has_value());
  EXPECT_EQ(day->instructions, 5000);
  EXPECT_EQ(day->floating, 200);
  EXPECT_EQ(day->seconds, 1.5);
  EXPECT_FALSE(costs.find("day", "--rules none").has_value()) << "counted in the other room";
  EXPECT_TRUE(costs.find("evening", "--rules none").has_value());
  EXPECT_TRUE(costs.read("")) << "there is none";
  EXPECT_FALSE(costs.find("evening", "--rules none").has_value());
  for (const char* line : {"day,none,1,2\n", "day,none,1,2,x\n", ",none,1,2,3\n", "day,none,1,2,-3\n", "\n"})
    EXPECT_FALSE(costs.read(head + line)) << line;
  EXPECT_FALSE(costs.read("day,none,1,2,3\n")) << "no head";
}

const std::string kMemoryCosts =
    "room,options,budget,instructions,floating_point,seconds,rows_kept,rows_recomputed,lit_again,placed_again\n"
    "day,--rules 1,2,600000,900,50,12.5,0,1526,1,1\n"
    "day,--rules 1,2,800000,300,20,3.5,1526,0,0,0\n"
    "evening,--rules 1,2,700000,400,30,4.5,1500,26,1,0\n";

TEST(ReportMemory, CostsComeFromTheFileOrNot) {
  std::vector<MemoryCost> costs;
  ASSERT_TRUE(memory_costs(kMemoryCosts, costs));
  ASSERT_EQ(costs.size(), 3u);
  EXPECT_EQ(costs[0].room, "day");
  EXPECT_EQ(costs[0].options, "--rules 1,2");
  EXPECT_EQ(costs[0].budget, 600000);
  EXPECT_EQ(costs[0].seconds, 12.5);
  EXPECT_TRUE(costs[0].placed_again && costs[2].lit_again && !costs[2].placed_again);
  EXPECT_EQ(costs[2].rows_recomputed, 26);
  EXPECT_TRUE(memory_costs("", costs)) << "there is none";
  EXPECT_TRUE(costs.empty());
  for (const std::string& broken :
       {std::string("another file\n1,2,3\n"), kMemoryCosts + "day,none,x,1,1,1,1,1,1,1\n", kMemoryCosts + "1,2,3\n",
        kMemoryCosts + "day,none,0,1,1,1,1,1,1,1\n"}) {
    EXPECT_FALSE(memory_costs(broken, costs)) << broken;
    EXPECT_TRUE(costs.empty()) << broken;
  }
}

TEST(ReportMemory, TheChapterHasAPlotAndATableForEachRoom) {
  Document document;
  add_memory_chapter(document, {});
  EXPECT_TRUE(document.blocks.empty());
  std::vector<MemoryCost> costs;
  memory_costs(kMemoryCosts, costs);
  add_memory_chapter(document, costs);
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
      "{\"day\": {\"direct\": 1.5, \"form_factors\": 2, \"solution\": 0.25,\n \"map\": 0.125, \"picture\": 10, "
      "\"total\": 13.875, \"options\": \"--rules blocks\"}, \"evening\": {\"direct\": 3}}\n";
  std::optional<WorkstationSeconds> day, other;
  ASSERT_TRUE(workstation_seconds(json, "day", day));
  ASSERT_TRUE(day.has_value());
  EXPECT_EQ(day->direct, 1.5);
  EXPECT_EQ(day->map, 0.125);
  EXPECT_EQ(day->total, 13.875);
  EXPECT_EQ(day->options, "--rules blocks");
  EXPECT_TRUE(workstation_seconds(json, "night", other)) << "another room's file is a good one";
  EXPECT_FALSE(other.has_value());
  EXPECT_TRUE(workstation_seconds("", "day", other)) << "there is none";
  EXPECT_FALSE(other.has_value());
  EXPECT_FALSE(workstation_seconds(json, "evening", other)) << "not all numbers are there";
  EXPECT_TRUE(workstation_seconds(json, "total", other)) << "no room, though a name in one";
  EXPECT_FALSE(other.has_value());
  EXPECT_FALSE(workstation_seconds("day 3", "day", other));
  EXPECT_FALSE(workstation_seconds(json.substr(0, json.find(", \"evening")), "night", other)) << "cut short";
  EXPECT_FALSE(other.has_value());
}

const std::string kSizes =
    "room,options,patches,links,segments,tests,row_bytes,instructions\n"
    "day,--rules blocks,2+ --refine 1,100,1000,50,70,4000,900\n"
    "day,--rules blocks,2+ --refine 2,400,8000,50,280,64000,1800\n"
    "evening,--rules blocks,2+ --refine 1,100,1000,50,70,4000,900\n";

TEST(ReportScaling, ExponentsAreThoseOfPowers) {
  const std::vector<double> n{1, 3, 10, 50}, half{2, 2 * std::sqrt(3.0), 2 * std::sqrt(10.0), 2 * std::sqrt(50.0)};
  EXPECT_NEAR(fitted_exponent(n, half), 0.5, 1e-12);
  // By hand: logarithms 0, 1, 2 and 0, 2, 3 of 10: slope 3 / 2.
  EXPECT_NEAR(fitted_exponent(std::vector<double>{1, 10, 100}, std::vector<double>{1, 100, 1000}), 1.5, 1e-12);
  EXPECT_EQ(fitted_exponent(std::vector<double>{7}, std::vector<double>{3}), 0) << "one size has no exponent";
  const std::vector<double> same(6, 1526), other{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(fitted_exponent(same, other), 0);
}

TEST(ReportScaling, TheChapterFitsEachRoom) {
  std::vector<CountedLine> sizes;
  Document document;
  ASSERT_TRUE(read_scaling("", sizes));
  add_scaling_chapter(document, sizes);
  EXPECT_TRUE(document.blocks.empty());
  ASSERT_TRUE(read_scaling(kSizes, sizes));
  add_scaling_chapter(document, sizes);
  ASSERT_EQ(csv_files(document).size(), 1u);
  // 4 times the patches: 8, 1, 4, 16 and 2 times the rest.
  EXPECT_EQ(csv_files(document)[0].text,
            "scene,patches,links,segments,tests,row_bytes,instructions\n"
            "\"day, --rules blocks,2+\",100,1000,50,70,4000,900\n"
            "\"day, --rules blocks,2+\",400,8000,50,280,64000,1800\n"
            "\"day, --rules blocks,2+\",exponent,1.5,0,1,2,0.5\n"
            "\"evening, --rules blocks,2+\",100,1000,50,70,4000,900\n"
            "\"evening, --rules blocks,2+\",exponent,,,,,\n") << "one size has no exponent";
  ASSERT_EQ(plot_files(document).size(), 1u);
  EXPECT_EQ(count_of(plot_files(document)[0].text, "<title>day"), 2u);
}

TEST(ReportScaling, WithoutInstructionsTestsArePlotted) {
  std::vector<CountedLine> sizes;
  std::string none = kSizes;
  for (const char* count : {",900\n", ",1800\n", ",900\n"}) none.replace(none.find(count), std::strlen(count), ",0\n");
  ASSERT_TRUE(read_scaling(none, sizes));
  Document document;
  add_scaling_chapter(document, sizes);
  EXPECT_NE(csv_files(document)[0].text.find("exponent,1.5,0,1,2,\n"), std::string::npos);
  EXPECT_EQ(count_of(plot_files(document)[0].text, "triangle tests"), 1u);
  EXPECT_FALSE(read_scaling(kSizes + "day,--rules none,100,1000,50,70,4000,0\n", sizes)) << "counted or not";
  EXPECT_FALSE(read_scaling(kSizes + "day,--rules none,0,1000,50,70,4000,900\n", sizes)) << "no patches";
  EXPECT_TRUE(sizes.empty());
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

TEST_F(ReportCommand, TakesWhatCasesCostFromBesideIt) {
  const TestFolder folder;
  folder.write("case-cost.csv", "room,options,instructions,floating_point,seconds\n"
                                "box,--flags auto --rules none --refine 1 --segments 16,64,5000,200,12.5\n"
                                "box,--flags auto --rules none --refine 1 --segments 16,64 --gather 1024,500,20,7.5\n");
  ASSERT_EQ(report(folder, "r").status, 0);
  const std::string csv = file_text(folder / "r/cases.csv");
  EXPECT_EQ(count_of(csv, ",5000,12.5,"), 1u);
  EXPECT_EQ(count_of(csv, ",500,7.5,"), 1u);
  const std::string svg = file_text(folder / "r/seconds-1.svg");
  EXPECT_EQ(count_of(svg, "--segments 16,64</title>"), 1u);
  EXPECT_EQ(count_of(svg, "--gather 1024</title>"), 1u);
  EXPECT_EQ(count_of(file_text(folder / "r/tests-1.svg"), "--gather"), 0u) << "its tests are of another kind";
}

TEST_F(ReportCommand, TwoScenesOfOneNameHaveNoFiguresOfEither) {
  const TestFolder folder;
  for (const char* name : {"a", "b"}) {
    ASSERT_EQ(mkdir((folder / name).c_str(), 0777), 0);
    folder.write(std::string(name) + "/box.scn", file_text(test_scene(name[0] == 'a' ? "box.scn" : "sun.scn")));
  }
  folder.write("case-cost.csv", "room,options,instructions,floating_point,seconds\n"
                                "box,--flags auto --rules none --refine 1 --segments 16,64,5000,200,12.5\n");
  const Outcome told =
      run({"report", folder / "a/box.scn", folder / "b/box.scn", "-o", folder / "r", "--size", "16x16"});
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_EQ(count_of(file_text(folder / "r/cases.csv"), ",5000,12.5,"), 0u);
}

TEST_F(ReportCommand, GatheringAsTheBaseIsNotWhatRulesAreComparedWith) {
  const TestFolder folder;
  ASSERT_EQ(report(folder, "r", {"--gather", "64"}).status, 0);
  EXPECT_EQ(file_text(folder / "r/rules.csv").find("\nbox,"), std::string::npos) << "no case without rules and gather";
}

TEST_F(ReportCommand, AGathersLossIsNotItsRules) {
  const TestFolder folder;
  ASSERT_EQ(report(folder, "r").status, 0);
  std::set<std::string> gather;
  for (const std::string& line : lines_of(file_text(folder / "r/cases.csv"))) {
    if (csv_cells(line)[6].starts_with("gather")) gather.insert(csv_cells(line)[1]);
  }
  ASSERT_GE(gather.size(), 2u);
  const std::vector<std::string> rules = lines_of(file_text(folder / "r/rules.csv"));
  ASSERT_GT(rules.size(), 5u);
  for (const std::string& line : rules) EXPECT_FALSE(gather.contains(csv_cells(line)[1])) << line;
}

TEST_F(ReportCommand, SaysWhatItCannotReadBesideIt) {
  const TestFolder folder;
  for (const char* name : {"workstation.json", "memory-cost.csv", "case-cost.csv", "scaling.csv"})
    folder.write(name, "box: {\n");
  const Outcome told = report(folder, "r");
  ASSERT_EQ(told.status, 0) << told.err;
  for (const char* says :
       {"workstation.json: not as make workstation leaves it, so it is left out\n",
        "scaling.csv: not as make scaling leaves it, so it is left out\n",
        "memory-cost.csv: not as make memory-cost leaves it, so it is left out\n",
        "case-cost.csv: not as make case-cost leaves it, so it is left out\n"})
    EXPECT_EQ(count_of(told.err, says), 1u) << told.err;
  folder.write("workstation.json", "{\"box\": {\"direct\": 1.5}}");
  EXPECT_EQ(count_of(report(folder, "p").err, "workstation.json: not as"), 1u);
  EXPECT_EQ(report(folder, "q", {"--quiet"}).err, "");
  EXPECT_EQ(file_text(folder / "q/report.md"), file_text(folder / "r/report.md"));
}

TEST_F(ReportCommand, NamesABudgetThatAllCasesCanDoWith) {
  const TestFolder folder;
  const auto with = [&](const std::string& bytes) { return report(folder, "r" + bytes, {"--memory", bytes}); };
  const Outcome told = with("1");
  ASSERT_EQ(told.status, 4);
  unsigned long long bytes = 0;
  const char* format = "shodo: the memory budget of 1 is too small: expected at least %llu bytes";
  ASSERT_EQ(std::sscanf(told.err.c_str(), format, &bytes), 1) << told.err;
  EXPECT_EQ(with(std::to_string(bytes)).status, 0);
  const Outcome less = with(std::to_string(bytes - 1));
  EXPECT_EQ(less.status, 4);
  EXPECT_NE(less.err.find("expected at least " + std::to_string(bytes) + " bytes (--memory "), std::string::npos)
      << less.err;
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
      {{"report", scene, scene, "-o", folder / "x"}, 2, "report: expected each scene once, found '" + scene + "'"},
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
