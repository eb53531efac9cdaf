// What a report is made of: the cases of every scene with what they cost and how wrong they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/report_cases.h"
#include "cli/report_counts.h"
#include "cli/report_document.h"
#include "cli/report_error.h"
#include "cli/report_run.h"
#include "cli/report_workstation.h"

namespace shodo {

/// What a case is dear in. kTestsPicture goes with the picture's error and all tests, kSeconds with the error of the
/// ambient maps and all stages, the others with that error and the ambient stage's part.
enum class Cost : std::uint8_t { kSegments, kTests, kFormFactors, kBytes, kTestsPicture, kSeconds };
inline constexpr std::uint32_t kCosts = 6;

struct CaseResult {
  Statistics statistics;
  MapError map;
  PictureError picture;
  std::optional<CaseCost> counted;
  std::optional<RuleLoss> loss;  // of cases with rules whose twin without rules was run; a gather's isn't its rule's
  std::size_t without_rules = 0;  // that twin's index
  bool efficient[kCosts] = {};
};

/// Two cases that differ in flags off and auto only.
struct FlagsProof {
  std::size_t off = 0, automatic = 0;  // indices of the cases
  bool same_maps = false, same_picture = false;
};

struct SceneResults {
  std::string name;   // of the file, without folder and ending: "day"; its path if another has the same
  std::string camera;
  std::vector<ReportCase> cases;
  std::vector<CaseResult> results;  // the same order
  std::vector<FlagsProof> proofs;
  Options reference;
  Statistics reference_statistics;
  double mean_lx = 0;  // of the reference
  std::vector<ObjectError> where;  // of the first case
  std::optional<WorkstationSeconds> workstation;
};

/// Abscissa and ordinate of a case in a plot of that cost. Nothing for a case that wasn't counted, and for one that
/// gathers but in seconds: its segments are pieces of lines, its tests outlines that a row cuts (doc/gather.md).
std::optional<CostAndError> cost_and_error(const ReportCase& one, const CaseResult& result, Cost cost);

/// Turns finished runs, the reference's first, into results; empties them as it goes.
SceneResults evaluate(const std::string& name, std::vector<ReportCase> cases, std::vector<ReportJob>& jobs,
                      const CaseCosts& costs);

Document report_document(const std::vector<SceneResults>& scenes);

}  // namespace shodo
