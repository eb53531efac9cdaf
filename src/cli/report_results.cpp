#include "cli/report_results.h"

#include <algorithm>

namespace shodo {

namespace {

/// The case that differs in its flags or its rules only; its index, or the number of cases.
std::size_t twin(const std::vector<ReportCase>& cases, const ReportCase& one, FlagMode flags, const Rules& rules) {
  Options wanted = one.options;
  wanted.flags = flags;
  wanted.rules = rules;
  return static_cast<std::size_t>(
      std::find_if(cases.begin(), cases.end(), [&](const ReportCase& c) { return same_settings(c.options, wanted); }) -
      cases.begin());
}

bool has_rules(const Options& options) { return !same_rules(options.rules, Rules{}); }

void mark_efficient(SceneResults& scene) {
  for (std::uint32_t k = 0; k < kCosts; ++k) {
    std::vector<CostAndError> points;
    std::vector<std::size_t> of;
    for (std::size_t c = 0; c < scene.cases.size(); ++c) {
      const auto point = cost_and_error(scene.cases[c], scene.results[c], static_cast<Cost>(k));
      if (!point) continue;
      points.push_back(*point);
      of.push_back(c);
    }
    const std::vector<bool> marks = efficient(points);
    for (std::size_t p = 0; p < points.size(); ++p) scene.results[of[p]].efficient[k] = marks[p];
  }
}

}  // namespace

std::optional<CostAndError> cost_and_error(const ReportCase& one, const CaseResult& result, Cost cost) {
  const Statistics& s = result.statistics;
  if (one.options.gathers() && cost != Cost::kSeconds) return {};
  const auto at = [](auto count, double error) { return CostAndError{static_cast<double>(count), error}; };
  switch (cost) {
    case Cost::kSegments: return at(s.segments_ambient, result.map.ambient);
    case Cost::kTests: return at(s.tests_ambient, result.map.ambient);
    case Cost::kFormFactors: return at(s.form_factors_computed, result.map.ambient);
    case Cost::kBytes: return at(s.row_bytes, result.map.ambient);
    case Cost::kTestsPicture: return at(s.tests_direct + s.tests_ambient, result.picture.mean);
    case Cost::kSeconds: break;
  }
  if (!result.counted) return {};
  return at(result.counted->seconds, result.map.ambient);
}

SceneResults evaluate(const std::string& name, std::vector<ReportCase> cases, std::vector<ReportJob>& jobs,
                      const CaseCosts& costs) {
  SceneResults scene;
  scene.name = name;
  const ReportJob& reference = jobs.front();
  scene.camera = std::string(reference.options.camera);
  scene.reference = reference.options;
  scene.reference_statistics = reference.statistics;
  scene.mean_lx = mean_illuminance(reference.maps);
  const MapCopy& base = jobs[1].maps;
  const ComparedMap truth = bring_to(reference.maps, base);
  scene.where = object_errors(truth, bring_to(base, base), base, scene.mean_lx);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const ReportJob& job = jobs[k + 1];
    CaseResult result;
    result.statistics = job.statistics;
    result.map = map_error(truth, bring_to(job.maps, base), scene.mean_lx);
    result.picture = picture_error(reference.picture, job.picture);
    result.counted = costs.find(name, options_text(cases[k].options));
    const std::size_t plain = twin(cases, cases[k], cases[k].options.flags, Rules{});
    const bool gathered = cases[k].options.gathers() || (plain < cases.size() && cases[plain].options.gathers());
    if (has_rules(cases[k].options) && !gathered && plain < cases.size()) {
      result.loss = rule_loss(jobs[plain + 1].patches, job.patches, cases[k].options.rules);
      result.loss->solver_lx = result.loss->brightest_lx * (job.statistics.solution_bound +
                                                            jobs[plain + 1].statistics.solution_bound);
      result.without_rules = plain;
    }
    const std::size_t off = twin(cases, cases[k], FlagMode::kOff, cases[k].options.rules);
    if (cases[k].options.flags == FlagMode::kAuto && off < cases.size()) {
      scene.proofs.push_back(
          {off, k, identical(jobs[off + 1].maps, job.maps), jobs[off + 1].picture == job.picture});
    }
    scene.results.push_back(result);
  }
  scene.cases = std::move(cases);
  mark_efficient(scene);
  jobs.clear();
  return scene;
}

}  // namespace shodo
