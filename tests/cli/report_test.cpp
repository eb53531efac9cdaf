// The report: its error measures against cases worked out by hand, its three forms against each other, and the command.
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

// ---- Maps on the same sub-patches

/// A grey map of one mesh: areas, direct and ambient light sub-patch by sub-patch.
MapCopy map_of(MeshKind kind, std::uint32_t width, std::uint32_t height, std::vector<double> area,
               std::vector<float> direct, std::vector<float> ambient) {
  return {1, {{kind, width, height, 0}}, std::move(area), std::move(direct), std::move(ambient)};
}

MapCopy grid(std::uint32_t width, std::uint32_t height, std::vector<float> direct) {
  const std::size_t n = std::size_t{width} * height;
  return map_of(MeshKind::kQuad, width, height, std::vector<double>(n, 1.0 / static_cast<double>(n)), direct,
                std::vector<float>(n, 10.0f));
}

TEST(ReportMaps, TwiceTheCountsAreAveragedTwoByTwo) {
  const MapCopy fine = grid(4, 2, {1, 3, 10, 20, 5, 7, 30, 40});
  const ComparedMap map = bring_to(fine, grid(2, 1, {0, 0}));
  ASSERT_EQ(map.direct.size(), 2u);
  EXPECT_DOUBLE_EQ(map.direct[0], 4);   // 1 3 5 7
  EXPECT_DOUBLE_EQ(map.direct[1], 25);  // 10 20 30 40
  EXPECT_DOUBLE_EQ(map.ambient[0], 10);
  EXPECT_DOUBLE_EQ(map.area[0], 0.5);
}

TEST(ReportMaps, HiddenPiecesHaveNoPartInAMean) {
  MapCopy fine = grid(4, 2, {1, 3, 10, 20, 5, 7, 30, 40});
  fine.area[0] = fine.area[1] = 0;
  fine.area[5] = 0.375;  // weights of 5 and 7: 0.125 and 0.375
  for (const std::size_t k : {2u, 3u, 6u, 7u}) fine.area[k] = 0;
  const ComparedMap map = bring_to(fine, grid(2, 1, {0, 0}));
  EXPECT_DOUBLE_EQ(map.direct[0], 6.5);
  EXPECT_DOUBLE_EQ(map.area[0], 0.5);
  EXPECT_EQ(map.area[1], 0);
}

TEST(ReportMaps, CoarserMapsRepeatAndOverlapByFractions) {
  // Two sub-patches over three: the middle one is half of each.
  const ComparedMap map = bring_to(grid(2, 1, {2, 8}), grid(3, 1, {0, 0, 0}));
  EXPECT_DOUBLE_EQ(map.direct[0], 2);
  EXPECT_DOUBLE_EQ(map.direct[1], 5);
  EXPECT_DOUBLE_EQ(map.direct[2], 8);
  // Three over two: a whole one and half of the middle one.
  const ComparedMap other = bring_to(grid(3, 1, {3, 6, 12}), grid(2, 1, {0, 0}));
  EXPECT_DOUBLE_EQ(other.direct[0], 4);
  EXPECT_DOUBLE_EQ(other.direct[1], 10);
}

MapCopy triangle(std::uint32_t k, std::vector<float> direct) {
  return map_of(MeshKind::kTriangle, k, k, std::vector<double>(std::size_t{k} * k, 1.0 / (k * k)), std::move(direct),
                std::vector<float>(std::size_t{k} * k, 0.0f));
}

TEST(ReportMaps, PiecesOfTrianglesAverageFourToOne) {
  const ComparedMap one = bring_to(triangle(2, {1, 2, 4, 9}), triangle(1, {0}));
  EXPECT_DOUBLE_EQ(one.direct[0], 4);
  // Edges divided by 4: row 0 has 7 pieces, then 5, 3, 1. Of the 4 pieces of edges divided by 2 the upright first one
  // holds 0 1 2 and the first of row 1; the inverted one 3 and, of row 1, 8 9 10 (inverted, upright, inverted).
  std::vector<float> fine(16);
  for (std::size_t k = 0; k < 16; ++k) fine[k] = static_cast<float>(k);
  const ComparedMap two = bring_to(triangle(4, fine), triangle(2, {0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(two.direct[0], (0 + 1 + 2 + 7) / 4.0);
  EXPECT_DOUBLE_EQ(two.direct[1], (3 + 8 + 9 + 10) / 4.0);
  EXPECT_DOUBLE_EQ(two.direct[2], (4 + 5 + 6 + 11) / 4.0);
  EXPECT_DOUBLE_EQ(two.direct[3], (12 + 13 + 14 + 15) / 4.0);
}

TEST(ReportMaps, AMapOnItsOwnSubPatchesStaysAsItIs) {
  const std::vector<float> values{1, 2, 3, 4, 5, 6, 7, 8, 9};
  for (const MapCopy& map : {grid(3, 3, values), triangle(3, values)}) {
    const ComparedMap same = bring_to(map, map);
    for (std::size_t k = 0; k < 9; ++k) EXPECT_DOUBLE_EQ(same.direct[k], static_cast<double>(values[k])) << k;
  }
}

TEST(ReportMaps, AShadowEdgeCutsWherePiecesDiffer) {
  // Mean total 10 + about 85: 2 % of it is 1.9 lx. Sub-patches of four pieces each: even, smooth, cut, dark and cut by
  // less than 2 % of the mean.
  const MapCopy fine = grid(8, 2, {100, 100, 100, 80, 200, 0, 1, 0,  //
                                   100, 100, 90, 95, 200, 0, 0, 0});
  const ComparedMap map = bring_to(fine, grid(4, 1, {0, 0, 0, 0}));
  EXPECT_EQ(map.cut, (std::vector<std::uint8_t>{0, 0, 1, 0}));
}

TEST(ReportMaps, IdenticalMeansEveryBit) {
  const MapCopy a = grid(2, 1, {0.0f, 1});
  MapCopy b = a;
  EXPECT_TRUE(identical(a, b));
  b.direct[0] = -0.0f;
  EXPECT_FALSE(identical(a, b));
}

// ---- Errors

TEST(ReportError, IsTheRootMeanSquareOverAreaOverTheMean) {
  // Areas 1 and 3, ambient off by 2 and 4: sqrt((1 * 4 + 3 * 16) / 4) = sqrt 13. Direct off by 1 where no edge cuts and
  // by 5 where one does. Mean 20.
  const ComparedMap truth{1, {1, 3}, {10, 20}, {5, 5}, {0, 1}};
  const ComparedMap map{1, {1, 3}, {11, 15}, {7, 9}, {0, 0}};
  const MapError error = map_error(truth, map, 20);
  EXPECT_DOUBLE_EQ(error.ambient, std::sqrt(13.0) / 20);
  EXPECT_DOUBLE_EQ(error.direct, 1.0 / 20);
  EXPECT_DOUBLE_EQ(error.direct_cut, 5.0 / 20);
  EXPECT_DOUBLE_EQ(error.total, std::sqrt((1 * 9.0 + 3 * 1.0) / 4) / 20);  // 1 + 2 and -5 + 4
  EXPECT_DOUBLE_EQ(error.cut_area, 0.75);
  EXPECT_EQ(error.left_out, 0);
}

TEST(ReportError, LeavesOutWhatTheCaseHasNoValueFor) {
  const ComparedMap truth{1, {1, 3}, {10, 20}, {5, 5}, {0, 0}};
  const ComparedMap map{1, {1, 0}, {12, 0}, {5, 0}, {0, 0}};
  const MapError error = map_error(truth, map, 10);
  EXPECT_DOUBLE_EQ(error.direct, 0.2);
  EXPECT_DOUBLE_EQ(error.left_out, 0.75);
}

TEST(ReportError, ChannelsCountAlike) {
  const ComparedMap truth{3, {2}, {0, 0, 0}, {10, 10, 10}, {0}};
  const ComparedMap map{3, {2}, {0, 0, 0}, {10, 13, 10}, {0}};
  EXPECT_DOUBLE_EQ(map_error(truth, map, 10).ambient, std::sqrt(9.0 / 3) / 10);
}

TEST(ReportError, TheWorstHundredthOfTheAreaCanBeLeftOut) {
  // 1 of 100 areas is off by 30, the others by 1; then one of twice that area, half of which counts.
  ComparedMap truth{1, {}, std::vector<double>(100, 0), std::vector<double>(100, 10), {}};
  ComparedMap map = truth;
  truth.area = map.area = std::vector<double>(100, 2);
  truth.cut = map.cut = std::vector<std::uint8_t>(100, 0);
  for (double& lx : map.ambient) lx += 1;
  map.ambient[7] = 40;
  EXPECT_NEAR(map_error(truth, map, 10).ambient_99, 0.1, 1e-12);
  EXPECT_NEAR(map_error(truth, map, 10).ambient, std::sqrt((99 + 900) / 100.0) / 10, 1e-12);
  truth.area[7] = 4;
  const double whole = 0.01 * 202, kept = 4 - whole;
  EXPECT_NEAR(map_error(truth, map, 10).ambient_99, std::sqrt((198 + kept * 900) / (202 - whole)) / 10, 1e-12);
}

TEST(ReportError, IsShownObjectByObject) {
  MapCopy like = map_of(MeshKind::kQuad, 1, 1, {1, 1, 2}, {0, 0, 0}, {0, 0, 0});
  like.meshes = {{MeshKind::kQuad, 1, 1, 0, "floor"}, {MeshKind::kQuad, 1, 1, 1, "floor"},
                 {MeshKind::kQuad, 1, 1, 2, "lamp"}};
  const ComparedMap truth{1, {1, 1, 2}, {0, 0, 0}, {5, 5, 5}, {0, 0, 0}};
  const ComparedMap map{1, {1, 1, 2}, {0, 0, 0}, {6, 5, 8}, {0, 0, 0}};  // squares 1, 0 and 18
  const std::vector<ObjectError> where = object_errors(truth, map, like, 10);
  ASSERT_EQ(where.size(), 2u);
  EXPECT_EQ(where[0].object, "lamp");
  EXPECT_DOUBLE_EQ(where[0].square, 18.0 / 19);
  EXPECT_DOUBLE_EQ(where[0].area, 0.5);
  EXPECT_DOUBLE_EQ(where[0].error, 0.3);
  EXPECT_DOUBLE_EQ(where[1].error, std::sqrt(0.5) / 10);
}

TEST(ReportError, OfPicturesIsInGreyLevels) {
  const std::vector<std::uint8_t> a{0, 10, 255, 7}, b{3, 10, 250, 7};
  EXPECT_DOUBLE_EQ(picture_error(a, b).mean, 2);
  EXPECT_EQ(picture_error(a, b).largest, 5u);
}

TEST(ReportError, ACaseIsEfficientIfNoneIsCheaperAndBetter) {
  const std::vector<CostAndError> points{{1, 9}, {2, 5}, {2, 6}, {3, 5}, {4, 1}, {4, 1}, {9, 0.5}, {9, 2}};
  EXPECT_EQ(efficient(points), (std::vector<bool>{true, true, false, false, true, true, true, false}));
}

// ---- Rules

/// Three grey patches of areas 1, 1, 2 and reflectance 0.5, 0.5, 0.8.
PatchLight patches(std::vector<double> direct, std::vector<double> ambient) {
  return {1, 2, 100, {1, 1, 2}, {0.5, 0.5, 0.8}, std::move(direct), std::move(ambient)};
}

TEST(ReportRules, LossAndBoundOfRule2) {
  // Luminances by direct light 0.5 * 100 / pi = 15.9, 0.5 * 6 / pi = 0.95 and 0: the last two are below 2.
  const RuleLoss loss =
      rule_loss(patches({100, 6, 0}, {10, 20, 30}), patches({100, 6, 0}, {9, 15, 28}), {.rule2 = true});
  EXPECT_EQ(loss.columns, 2u);
  EXPECT_EQ(loss.rows, 0u);
  EXPECT_DOUBLE_EQ(loss.largest_lx, 5);
  EXPECT_DOUBLE_EQ(loss.brightest_lx, 110);
  EXPECT_DOUBLE_EQ(loss.mean_lx, (1 * 1 + 1 * 5 + 2 * 2) / 4.0);
  EXPECT_NEAR(loss.bound_lx, 0.8 * 28 / (1 - 0.8), 1e-12);  // against 0.5 * 21
}

TEST(ReportRules, RepeatedRule2DropsOnlyWhatStaysDark) {
  // Totals 21 and 28: luminances 3.3 and 7.1 are no longer below 2, and nothing stays dropped.
  const PatchLight none = patches({100, 6, 0}, {10, 20, 30});
  const RuleLoss loss = rule_loss(none, patches({100, 6, 0}, {9, 15, 28}), {.rule2_repeated = true});
  EXPECT_EQ(loss.columns, 0u);
  EXPECT_EQ(loss.bound_lx, 0);
}

TEST(ReportRules, ABrightRowLosesItsAmbientLight) {
  // 0.5 * 1000 / pi = 159 is above 100: patch 0 is lit directly only.
  const RuleLoss loss =
      rule_loss(patches({1000, 60, 60}, {12, 20, 30}), patches({1000, 60, 60}, {0, 19, 29}), {.rule1 = true});
  EXPECT_EQ(loss.rows, 1u);
  EXPECT_DOUBLE_EQ(loss.bound_lx, 12);
  EXPECT_DOUBLE_EQ(loss.largest_lx, 12);
}

TEST(ReportRules, TheBoundHoldsInASystemSolvedByHand) {
  // Two patches that see only each other, rho 0.5 and 0.8, E0 100 and 0: E0 = 100 + 0.8 E1, E1 = 0.5 E0 give
  // E0 = 1000 / 6, E1 = 500 / 6. Without column 1 (dark by direct light): E0 = 100, E1 = 50.
  PatchLight none{1, 2, 100, {1, 1}, {0.5, 0.8}, {100, 0}, {400.0 / 6, 500.0 / 6}};
  PatchLight ruled = none;
  ruled.ambient = {0, 50};
  const RuleLoss loss = rule_loss(none, ruled, {.rule2 = true});
  EXPECT_NEAR(loss.largest_lx, 400.0 / 6, 1e-9);
  EXPECT_NEAR(loss.bound_lx, 0.8 * 50 / 0.2, 1e-9);
  EXPECT_LE(loss.largest_lx, loss.bound_lx);
}

TEST(ReportRules, CountsAndBoundsAreThoseOfTheSolver) {
  std::vector<ReportJob> jobs(3);
  for (ReportJob& job : jobs) {
    job.scene = test_scene("box.scn");
    job.memory = 8 << 20;
    job.options.width = job.options.height = 8;
  }
  jobs[1].options.rules.rule2 = true;
  jobs[2].options.rules.rule2_repeated = true;
  ASSERT_TRUE(run_jobs(jobs, false).done());
  for (const std::size_t k : {1u, 2u}) {
    const RuleLoss loss = rule_loss(jobs[0].patches, jobs[k].patches, jobs[k].options.rules);
    EXPECT_EQ(loss.columns, jobs[k].statistics.columns_emptied) << k;
    EXPECT_NEAR(loss.bound_lx, jobs[k].statistics.rule2_bound_lx, 1e-9) << k;
    EXPECT_LE(loss.largest_lx, loss.bound_lx + 0.01) << k;  // the solver's tolerance
  }
  EXPECT_GT(jobs[1].statistics.columns_emptied, 10u);
}

/// A report of four cases: without rules, and with a loss of 3 lx over its bound, just within it, and without one.
Document document_of_losses() {
  SceneResults scene;
  scene.name = "room";
  scene.mean_lx = 100;
  const struct {
    Rules rules;
    double bound_lx, solver_lx;
  } losses[] = {{{}, 0, 0}, {{.rule2 = true}, 2.5, 0.25}, {{.rule1 = true}, 2.75, 0.25}, {{.rule3 = true}, 4, 0}};
  for (const auto& [rules, bound_lx, solver_lx] : losses) {
    Options options;
    options.rules = rules;
    scene.cases.push_back({static_cast<std::uint32_t>(scene.cases.size()) + 1, CaseGroup::kRules, options, 1, {}});
    CaseResult result;
    if (!same_rules(rules, {})) result.loss = RuleLoss{0, 0, bound_lx, 3, 1, 100, solver_lx};
    scene.results.push_back(result);
  }
  return report_document({scene});
}

/// What stands between the n-th and the next `separator` of the line.
std::string part_of(std::string line, std::size_t n, const std::string& separator) {
  for (; n > 0; --n) {
    const std::size_t at = line.find(separator);
    if (at == std::string::npos) return "";
    line.erase(0, at + separator.size());
  }
  return line.substr(0, line.find(separator));
}

TEST(ReportRules, SaysWhetherALossIsWithinItsBound) {
  const Document document = document_of_losses();
  std::string csv;
  for (const NamedText& file : csv_files(document)) csv = file.name == "rules.csv" ? file.text : csv;
  const std::vector<std::string> rows = lines_of(csv);
  ASSERT_EQ(rows.size(), 4u);
  std::size_t column = 0;
  while (column < 20 && part_of(rows[0], column, ",") != "within_bound") ++column;
  EXPECT_EQ(part_of(rows[1], column, ","), "no") << "3 of 2.5 and 0.25 lx";
  EXPECT_EQ(part_of(rows[2], column, ","), "yes") << "3 of 2.75 and 0.25 lx";
  EXPECT_EQ(part_of(rows[3], column - 2, ",") + part_of(rows[3], column, ","), "") << "rule 3 has no bound";
  // A bar more before the first cell; there is no column for the scene.
  std::vector<std::string> shown;
  bool there = false;
  for (const std::string& line : lines_of(markdown_text(document))) {
    there = there || line.find("| within bound |") != std::string::npos;
    if (there && line.starts_with("| ")) shown.push_back(part_of(line, column, "|"));
  }
  EXPECT_EQ(shown, (std::vector<std::string>{" within bound ", " no ", " yes ", " - "}));
  const std::string html = html_text(document);
  EXPECT_NE(html.find("within bound</th>"), std::string::npos);
  EXPECT_NE(html.find(">no</td>"), std::string::npos);
}

// ---- The list of cases

TEST(ReportCases, NoneIsThereTwiceAndTheFirstIsTheBase) {
  for (const int kind : {0, 1, 2}) {
    Options base;
    if (kind == 1) base.segments_first = base.segments_mixed = 1;
    base.gather = kind == 2;  // by as many lines as a case asks for
    const std::vector<ReportCase> cases = report_cases(base);
    ASSERT_GT(cases.size(), 8u);
    EXPECT_EQ(cases[0].options.flags, FlagMode::kAuto);
    EXPECT_EQ(rules_text(cases[0].options.rules), "none");
    EXPECT_EQ(cases[0].options.refine, base.refine);
    for (std::size_t a = 0; a < cases.size(); ++a) {
      EXPECT_EQ(cases[a].number, a + 1);
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_NE(options_text(cases[a].options), options_text(cases[b].options)) << a << ' ' << b;
    }
    EXPECT_NE(find_case(cases, FlagMode::kOff, {}), nullptr);
  }
}

TEST(ReportCases, LightOverMirrorsIsACaseWhereThereAreAny) {
  const auto has = [](const std::vector<ReportCase>& cases) {
    bool found = false;
    for (const ReportCase& c : cases) found = found || (c.options.mirror_light && c.other == "mirror-light on");
    return found;
  };
  EXPECT_FALSE(has(report_cases({})));
  EXPECT_TRUE(has(report_cases({}, true)));
  EXPECT_FALSE(reference_options({}).mirror_light);
}

TEST(ReportCases, NoneGathersLightOverMirrors) {
  Options base;
  base.mirror_light = true;
  for (const ReportCase& c : report_cases(base, true)) EXPECT_FALSE(c.options.gather) << options_text(c.options);
  base.mirror_light = false;
  base.gather = true;
  for (const ReportCase& c : report_cases(base, true)) EXPECT_FALSE(c.options.mirror_light) << options_text(c.options);
}

TEST(ReportCases, TheReferenceIsNoCoarserThanTheBase) {
  Options base;
  base.refine = 3;
  base.tiers = 1e-6;
  base.segments_first = 256;
  base.segments_mixed = 256;
  base.flags = FlagMode::kOff;
  const Options reference = reference_options(base);
  EXPECT_EQ(reference.refine, 9);
  EXPECT_EQ(reference.tiers, 1e-6);
  EXPECT_EQ(reference.segments_first, 256u);
  EXPECT_EQ(reference.segments_mixed, 256u);
  EXPECT_EQ(reference.flags, FlagMode::kAuto);
  base.tiers = 0;
  EXPECT_EQ(reference_options(base).tiers, 0) << "0 is the contour integral, the finest";
}

TEST(ReportCases, TheReferenceGathersButWithLightOverMirrors) {
  EXPECT_TRUE(reference_options({}).gather);
  Options base;
  base.mirror_light = true;
  const Options reference = reference_options(base);
  EXPECT_FALSE(reference.gather);
  EXPECT_TRUE(reference.mirror_light);
  EXPECT_EQ(reference.refine, 2);
  EXPECT_EQ(reference.segments_first, 64u);
  EXPECT_EQ(reference.segments_mixed, 256u);
}

TEST(ReportCases, NumbersAreWrittenAsAPersonWould) {
  EXPECT_EQ(number_text(3 * 0.3), "0.9") << "0.8999999999999999 as a double";
  EXPECT_EQ(number_text(1.4142135623731), "1.4142135623731");
  EXPECT_EQ(number_text(2.3e-4), "0.00023");
  EXPECT_EQ(number_text(1e-12), "0.000000000001");
  EXPECT_EQ(number_text(64), "64");
}

/// What tools/case-cost makes of the columns of cases.csv.
TEST(ReportCases, ColumnsTellTheOptionsOfACase) {
  for (const ReportCase& c : report_cases({}, true)) {
    std::string told = "--flags " + std::string(flags_text(c.options.flags)) + " --rules " +
                       rules_text(c.options.rules) + " --refine " + number_text(c.options.refine) + " --segments " +
                       segments_text(c.options);
    if (!c.other.empty()) told.append(" --").append(c.other);
    EXPECT_EQ(options_text(c.options), told) << c.number;
  }
}

TEST(ReportCases, OptionsOfTheBaseAreToldToo) {
  Options base;
  base.patch_size = 0.25;
  base.sub_patch_size = 0.125;
  base.tolerance = 0.001;
  base.gather = true;
  EXPECT_EQ(options_text(base),
            "--flags auto --rules none --refine 1 --segments 16,64 --patch 0.25 --sub-patch 0.125 --tolerance 0.001 "
            "--gather 1024");
}

TEST(ReportCases, OnlySecondsCompareAGatherWithTheRest) {
  ReportCase one;
  CaseResult result;
  result.statistics.segments_ambient = 5;
  result.statistics.tests_ambient = 7;
  result.statistics.tests_direct = 2;
  result.statistics.form_factors_computed = 3;
  result.statistics.row_bytes = 11;
  result.map.ambient = 0.5;
  result.picture.mean = 0.25;
  const auto cost = [&](Cost of) {
    const auto at = cost_and_error(one, result, of);
    return at ? at->cost : -1;
  };
  EXPECT_EQ(cost(Cost::kSegments), 5);
  EXPECT_EQ(cost(Cost::kTests), 7);
  EXPECT_EQ(cost(Cost::kFormFactors), 3);
  EXPECT_EQ(cost(Cost::kBytes), 11);
  EXPECT_EQ(cost(Cost::kTestsPicture), 9);
  EXPECT_EQ(cost_and_error(one, result, Cost::kTestsPicture)->error, 0.25);
  EXPECT_EQ(cost(Cost::kSeconds), -1) << "not counted";
  result.counted = CaseCost{100, 10, 13};
  EXPECT_EQ(cost(Cost::kSeconds), 13);
  one.options.gather = true;
  for (const Cost of : {Cost::kSegments, Cost::kTests, Cost::kFormFactors, Cost::kBytes, Cost::kTestsPicture})
    EXPECT_EQ(cost(of), -1);
  EXPECT_EQ(cost(Cost::kSeconds), 13);
}

TEST(ReportCases, RulesAreNamedAsTheOptionTakesThem) {
  EXPECT_EQ(rules_text({}), "none");
  EXPECT_EQ(rules_text({.rule1 = true, .rule2 = true, .rule3 = true}), "all");
  EXPECT_EQ(rules_text({.rule1 = true, .rule2_repeated = true}), "1,2+");
  EXPECT_EQ(rules_text({.rule3 = true, .rule3_diameters = 2.5}), "3:2.5");
  EXPECT_EQ(rules_text({.blocks = true, .blocks_error = 0.01}), "blocks:0.01");
}

}  // namespace
}  // namespace shodo
