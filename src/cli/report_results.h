// What a report is made of: the cases of every scene with what they cost and how wrong they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/report_cases.h"
#include "cli/report_document.h"
#include "cli/report_error.h"
#include "cli/report_run.h"
#include "cli/report_workstation.h"

namespace shodo {

/// What a case is dear in. kTestsPicture goes with the picture's error and all tests, the others with the error of the
/// ambient maps and the ambient stage's part.
enum class Cost : std::uint8_t { kSegments, kTests, kFormFactors, kBytes, kTestsPicture };
inline constexpr std::uint32_t kCosts = 5;

struct CaseResult {
  Statistics statistics;
  MapError map;
  PictureError picture;
  std::optional<RuleLoss> loss;  // of cases with rules whose twin without rules was run
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

/// Abscissa and ordinate of a case in a plot of that cost.
CostAndError cost_and_error(const CaseResult& result, Cost cost);

/// Turns finished runs, the reference's first, into results; empties them as it goes.
SceneResults evaluate(std::string name, std::vector<ReportCase> cases, std::vector<ReportJob>& jobs);

/// `workstation_options`: how the workstation's seconds were counted, if that is known.
Document report_document(const std::vector<SceneResults>& scenes, const std::string& workstation_options);

}  // namespace shodo
