// The chapters of the report: the paper's table (report_paper.cpp), speed against error, and what the rules lost.
#include <algorithm>
#include <initializer_list>

#include "cli/report_tables.h"

namespace shodo {

namespace {

// ---- 2: speed against error

/// Letters of the costs at which a case is efficient.
std::string efficient_letters(const CaseResult& result) {
  constexpr std::string_view kLetters[kCosts] = {"S", "T", "F", "B", "P", "W"};
  std::string text;
  for (std::uint32_t k = 0; k < kCosts; ++k) {
    if (result.efficient[k]) text += kLetters[k];
  }
  return text;
}

std::vector<Column> case_columns() {
  return {{"case", "case"},
          {"flags", "flags", true},
          {"rules", "rules", true},
          {"refine", "refine"},
          {"segments", "segments a pair", true},
          {"other", "other", true},
          {"patches", "patches"},
          {"segments_direct", "segments, direct"},
          {"tests_direct", "tests, direct"},
          {"form_factors", "form factors"},
          {"segments_ambient", "segments, ambient"},
          {"tests_ambient", "tests, ambient"},
          {"nonzeros", "non-zeros"},
          {"links", "entries stored"},
          {"row_bytes", "rows"},
          {"memory_peak", "memory, peak"},
          {"instructions", "instructions"},
          {"workstation_seconds", "seconds, workstation"},
          {"ambient_error", "ambient error"},
          {"ambient_error_99", "the same, best 99 % of the area"},
          {"direct_error", "direct error"},
          {"direct_cut_error", "direct error at shadow edges"},
          {"total_error", "total error"},
          {"picture_mean", "picture, mean"},
          {"picture_largest", "picture, largest"},
          {"efficient", "efficient", true}};
}

std::vector<Cell> case_row(const ReportCase& c, const CaseResult& r) {
  const Statistics& s = r.statistics;
  return {Cell::number(c.number),
          Cell::words(std::string(flags_text(c.options.flags))),
          Cell::words(rules_text(c.options.rules)),
          Cell::words(number_text(c.options.refine)),
          Cell::words(segments_text(c.options)),
          Cell::words(std::string(c.other)),
          Cell::number(s.patches),
          Cell::count(s.segments_direct),
          Cell::count(s.tests_direct),
          Cell::count(s.form_factors_computed),
          Cell::count(s.segments_ambient),
          Cell::count(s.tests_ambient),
          Cell::count(s.nonzeros),
          Cell::count(s.links),
          Cell::bytes(s.row_bytes),
          Cell::bytes(s.memory_peak),
          r.counted ? Cell::count(static_cast<std::uint64_t>(r.counted->instructions)) : Cell{},
          r.counted ? Cell::real(r.counted->seconds) : Cell{},
          Cell::percent(r.map.ambient),
          Cell::percent(r.map.ambient_99),
          Cell::percent(r.map.direct),
          Cell::percent(r.map.direct_cut),
          Cell::percent(r.map.total),
          Cell::real(r.picture.mean),
          Cell::number(r.picture.largest),
          Cell::words(efficient_letters(r))};
}

Table cases_table(const SceneResults& scene) {
  Table table{"cases.csv", scene.name, case_columns(), {}, {}};
  for (std::size_t k = 0; k < scene.cases.size(); ++k) {
    table.rows.push_back(case_row(scene.cases[k], scene.results[k]));
    table.strong.push_back(scene.results[k].efficient[static_cast<std::size_t>(Cost::kTests)] ? 1 : 0);
  }
  return table;
}

/// Objects with the largest part of the first case's squared ambient error.
Table where_table(const SceneResults& scene) {
  constexpr std::size_t kMost = 8;
  Table table{"where.csv", scene.name, {}, {}, {}};
  table.columns = {{"object", "object", true},
                   {"area", "part of the area"},
                   {"squared_error", "part of the squared error"},
                   {"ambient_error", "ambient error on it"}};
  for (std::size_t k = 0; k < std::min(kMost, scene.where.size()); ++k) {
    const ObjectError& o = scene.where[k];
    table.rows.push_back(
        {Cell::words(o.object), Cell::percent(o.area), Cell::percent(o.square), Cell::percent(o.error)});
  }
  return table;
}

struct PlotKind {
  Cost cost;
  std::string_view file, title, x_title, y_title;
  double scale;  // of the ordinate
};

constexpr std::string_view kAmbientError = "RMS error of the ambient maps, % of the mean illuminance";
constexpr PlotKind kPlots[] = {
    {Cost::kSeconds, "seconds", "seconds of the workstation", "seconds of the paper's workstation, all stages",
     kAmbientError, 100},
    {Cost::kTests, "tests", "triangle tests", "triangle tests for form factors", kAmbientError, 100},
    {Cost::kSegments, "segments", "segments", "segments for form factors", kAmbientError, 100},
    {Cost::kFormFactors, "form-factors", "form factors", "geometric form factors computed", kAmbientError, 100},
    {Cost::kBytes, "bytes", "memory of the rows", "bytes of stored rows", kAmbientError, 100},
    {Cost::kTestsPicture, "picture", "the picture", "triangle tests in all",
     "mean difference of the picture, grey levels", 1},
};

Plot plot_of(const SceneResults& scene, std::size_t number, const PlotKind& kind) {
  Plot plot;
  plot.file = std::string(kind.file) + "-" + std::to_string(number) + ".svg";
  plot.title = scene.name + ": " + std::string(kind.title);
  plot.x_title = kind.x_title;
  plot.y_title = kind.y_title;
  for (std::uint32_t g = 0; g < kCaseGroups; ++g) plot.groups.emplace_back(group_name(static_cast<CaseGroup>(g)));
  for (std::size_t k = 0; k < scene.cases.size(); ++k) {
    const ReportCase& c = scene.cases[k];
    const auto at = cost_and_error(c, scene.results[k], kind.cost);
    if (!at || !(at->cost > 0) || !(at->error > 0)) continue;
    plot.points.push_back({at->cost, kind.scale * at->error, c.number, static_cast<std::uint32_t>(c.group),
                           scene.results[k].efficient[static_cast<std::size_t>(kind.cost)],
                           std::to_string(c.number) + ": " + options_text(c.options)});
  }
  return plot;
}

std::string reference_text(const SceneResults& scene) {
  const Options& o = scene.reference;
  const Statistics& s = scene.reference_statistics;
  const MapError& base = scene.results.front().map;
  const auto number = [](std::uint64_t n) { return shown_text(Cell::number(n)); };
  return "The reference has " + number(s.patches) + " patches and " + number(s.sub_patches) + " sub-patches (refine " +
         number_text(o.refine) + "), tiers " + (o.tiers > 0 ? number_text(o.tiers) : "near") + ", segments " +
         segments_text(o) + ", 64-bit rows, flags auto, no rules, " +
         (o.gather ? "ambient light gathered by each sub-patch" : "ambient light interpolated") + "; it took " +
         shown_text(Cell::count(s.tests_direct + s.tests_ambient)) + " tests and " +
         shown_text(Cell::bytes(s.memory_peak)) + " of memory. Its mean total illuminance is " +
         shown_text(Cell::real(scene.mean_lx)) + " lx. Shadow edges cut " + shown_text(Cell::percent(base.cut_area)) +
         " of the area; " + shown_text(Cell::percent(base.left_out)) +
         " of it has no value in case 1 (hidden there, not in the reference) and is left out.";
}

// ---- 3: rules

Table rules_table(const SceneResults& scene) {
  Table table{"rules.csv", scene.name, {}, {}, {}};
  table.columns = {{"case", "case"},
                   {"flags", "flags", true},
                   {"rules", "rules", true},
                   {"rows_empty", "rows emptied (rule 1)"},
                   {"columns_empty", "columns dropped (rule 2)"},
                   {"columns_restored", "columns put back (rule 2+)"},
                   {"form_factors_saved", "form factors saved"},
                   {"nonzeros_saved", "non-zeros saved"},
                   {"bound_lx", "bound on the loss, lx"},
                   {"largest_loss_lx", "largest loss, lx"},
                   {"within_bound", "within bound", true},
                   {"mean_loss_lx", "mean loss, lx"},
                   {"mean_loss", "mean loss, of the mean"},
                   {"ambient_error", "ambient error"},
                   {"ambient_error_none", "the same without rules"}};
  for (std::size_t k = 0; k < scene.cases.size(); ++k) {
    const ReportCase& c = scene.cases[k];
    const CaseResult& r = scene.results[k];
    if (!r.loss) continue;
    const CaseResult& none = scene.results[r.without_rules];
    const RuleLoss& loss = *r.loss;
    const bool bounded = !c.options.rules.rule3 && !c.options.rules.blocks;
    const auto saved = [](std::uint64_t less, std::uint64_t all) {
      return all == 0 ? Cell{} : Cell::percent(1 - static_cast<double>(less) / static_cast<double>(all));
    };
    table.rows.push_back({Cell::number(c.number), Cell::words(std::string(flags_text(c.options.flags))),
                          Cell::words(rules_text(c.options.rules)), Cell::number(r.statistics.rows_emptied),
                          Cell::number(r.statistics.columns_emptied), Cell::number(r.statistics.columns_restored),
                          saved(r.statistics.form_factors_computed, none.statistics.form_factors_computed),
                          saved(r.statistics.nonzeros, none.statistics.nonzeros),
                          bounded ? Cell::real(loss.bound_lx) : Cell{}, Cell::real(loss.largest_lx),
                          bounded ? Cell::words(loss.within_bound() ? "yes" : "no") : Cell{},
                          Cell::real(loss.mean_lx),
                          scene.mean_lx > 0 ? Cell::percent(loss.mean_lx / scene.mean_lx) : Cell{},
                          Cell::percent(r.map.ambient), Cell::percent(none.map.ambient)});
  }
  return table;
}

void add_paper_chapter(Document& document, const std::vector<SceneResults>& scenes) {
  document.heading(2, "1. The paper's table");
  document.paragraph(
      "The paper's figures are seconds on its workstation, without and with its flags (3.1), rules 1 to 3 on. Ours are "
      "counts, the same on every machine and on every run: a segment is a line of sight that was looked along, a test "
      "is one segment against one triangle. Flags: off tests every triangle; auto leaves out only what can't change a "
      "bit; scene takes the flags that the scene file sets, as the paper does.");
  const auto has_seconds = [](const SceneResults& s) { return s.workstation.has_value(); };
  const auto timed = std::find_if(scenes.begin(), scenes.end(), has_seconds);
  document.paragraph(
      timed != scenes.end()
          ? "The last column is in seconds of the paper's workstation, counted by make workstation" +
                  (timed->workstation->options.empty() ? "" : " with " + timed->workstation->options) +
                  ": (instructions - floating-point operations) / 10 million + floating-point operations / 1.1 million."
            : std::string("The last column is for seconds of the paper's workstation. They are not there: make "
                          "workstation counts them into workstation.json, which belongs beside the report's folder."));
  for (const SceneResults& scene : scenes) {
    document.heading(3, scene.name);
    document.blocks.emplace_back(paper_table(scene));
  }
  if (std::all_of(scenes.begin(), scenes.end(), [](const SceneResults& s) { return s.proofs.empty(); })) return;
  document.heading(3, "Flags auto against off");
  document.paragraph("Every value of every map, and every byte of the picture, compared bit by bit.");
  for (const SceneResults& scene : scenes) {
    document.paragraph(scene.name + ":");
    document.blocks.emplace_back(flags_table(scene));
  }
}

void add_speed_chapter(Document& document, const std::vector<SceneResults>& scenes) {
  document.heading(2, "2. Speed against error");
  document.paragraph(
      "Errors are root mean squares over area and colour channels, in percent of the reference's mean total "
      "illuminance; all maps are first brought to the sub-patches of case 1, coarser ones by repeating, finer ones by "
      "averaging over area. Direct errors leave out the sub-patches that a shadow edge cuts, which have a column of "
      "their own: there a map blurs, which is its resolution and no error of the light. An edge cuts a sub-patch if "
      "the reference's direct light on the pieces in it differs by more than 25 % of the largest of them and by more "
      "than 2 % of the mean total illuminance. The picture's error is in grey levels, 0 to 255, over all channels, "
      "against the reference's picture. A few places next to lamps can hold most of a root mean square: the best 99 % "
      "of the area have a column of their own.");
  document.paragraph(
      "A case is efficient if no other is both cheaper and better: S in segments, T in tests, F in form factors, B in "
      "bytes of rows, all of the ambient stage against the ambient error; P in all tests against the picture; W in "
      "seconds of the paper's workstation, all stages, against the ambient error. In the tables T is set apart; in the "
      "plots the efficient cases are ringed and joined. Numbers in the plots are cases.");
  document.paragraph(
      "Cases that gather are compared in seconds alone. What the table counts for them beside the segments and tests "
      "of the form factors before are pieces of lines from one surface to the next and outlines that a row of lines "
      "cuts: work of another kind, most of it steps of integers, which needs neither form factors nor rows.");
  const auto counted = [](const SceneResults& s) {
    return std::any_of(s.results.begin(), s.results.end(), [](const CaseResult& r) { return r.counted.has_value(); });
  };
  document.paragraph(
      std::any_of(scenes.begin(), scenes.end(), counted)
          ? "Instructions and seconds are those of make case-cost: a whole run but loading, with a picture of 1280 x "
            "1024 pixels, one sample each, without effects, in 8 MiB, or in what holds all rows where that is more. "
            "Cases that would have taken too long weren't counted."
          : "Instructions and seconds of the paper's workstation are not there: make case-cost counts them into "
            "case-cost.csv, which belongs beside the report's folder.");
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    document.heading(3, scenes[k].name);
    document.paragraph(reference_text(scenes[k]));
    document.blocks.emplace_back(cases_table(scenes[k]));
    document.paragraph("Where the ambient error of case 1 sits, object by object:");
    document.blocks.emplace_back(where_table(scenes[k]));
    for (const PlotKind& kind : kPlots) {
      Plot plot = plot_of(scenes[k], k + 1, kind);
      if (!plot.points.empty()) document.blocks.emplace_back(std::move(plot));
    }
  }
}

void add_rules_chapter(Document& document, const std::vector<SceneResults>& scenes) {
  const auto without = [](const SceneResults& s) { return rules_table(s).rows.empty(); };
  if (std::all_of(scenes.begin(), scenes.end(), without)) return;
  document.heading(2, "3. What the rules lose");
  document.paragraph(
      "Each case against the same case without rules, patch by patch: the largest loss of illuminance on any patch in "
      "any channel, and the area mean (negative: light was gained). The bound of rule 2 is the largest rho_j E_j over "
      "the dropped columns j, E_j the total illuminance that the case finds there, over 1 - the largest reflectance; "
      "that of rule 1 is the largest ambient illuminance of the emptied rows; of both together their sum. Both speak "
      "of one matrix: as soon as a column is dropped no row is scaled up to 1 any more, and what scaling would have "
      "added is lost on top. So a loss may be above its bound (within bound: no; what the solver may have made wrong "
      "of both solutions is allowed for); with --scale-rows off it can't. Rule 3 and blocks have an estimated error "
      "and no bound. Cases that gather aren't here: what their rule lost is the loss of the solution before that.");
  for (const SceneResults& scene : scenes) {
    document.heading(3, scene.name);
    document.blocks.emplace_back(rules_table(scene));
  }
}

}  // namespace

Document report_document(const std::vector<SceneResults>& scenes) {
  Document document;
  document.title = "shodo: speed against error";
  std::string names;
  for (const SceneResults& scene : scenes) names += (names.empty() ? "" : ", ") + scene.name;
  document.paragraph("Scenes: " + names +
                     ". Everything here is counted or computed, nothing is timed: another run gives the same bytes. "
                     "The tables are there as CSV too, with all digits and with parts of one for percent.");
  add_paper_chapter(document, scenes);
  add_speed_chapter(document, scenes);
  add_rules_chapter(document, scenes);
  return document;
}

}  // namespace shodo
