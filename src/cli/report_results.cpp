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

void mark_efficient(std::vector<CaseResult>& results) {
  for (std::uint32_t k = 0; k < kCosts; ++k) {
    std::vector<CostAndError> points;
    for (const CaseResult& r : results) points.push_back(cost_and_error(r, static_cast<Cost>(k)));
    const std::vector<bool> marks = efficient(points);
    for (std::size_t c = 0; c < results.size(); ++c) results[c].efficient[k] = marks[c];
  }
}

}  // namespace

CostAndError cost_and_error(const CaseResult& result, Cost cost) {
  const Statistics& s = result.statistics;
  switch (cost) {
    case Cost::kSegments: return {static_cast<double>(s.segments_ambient), result.map.ambient};
    case Cost::kTests: return {static_cast<double>(s.tests_ambient), result.map.ambient};
    case Cost::kFormFactors: return {static_cast<double>(s.form_factors_computed), result.map.ambient};
    case Cost::kBytes: return {static_cast<double>(s.row_bytes), result.map.ambient};
    case Cost::kTestsPicture: return {static_cast<double>(s.tests_direct + s.tests_ambient), result.picture.mean};
  }
  return {};
}

SceneResults evaluate(std::string name, std::vector<ReportCase> cases, std::vector<ReportJob>& jobs) {
  SceneResults scene;
  scene.name = std::move(name);
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
    const std::size_t plain = twin(cases, cases[k], cases[k].options.flags, Rules{});
    if (has_rules(cases[k].options) && plain < cases.size()) {
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
  mark_efficient(scene.results);
  jobs.clear();
  return scene;
}

}  // namespace shodo
