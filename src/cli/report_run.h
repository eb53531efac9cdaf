// Runs the cases of a report, as many at once as the machine has cores.
//
// Each run has its own memory and shares nothing with the others, so neither their order nor their number changes what
// comes out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/report_error.h"
#include "cli/report_maps.h"
#include "shodo/shodo.h"

namespace shodo {

struct ReportJob {
  std::string scene;
  std::string label;          // for the progress line
  Options options;
  std::uint64_t memory = 0;   // bytes
  bool takes_more = false;    // as much as it needs to hold all its rows, if that is more

  Status status;              // of the run; what follows is filled if it is done
  Statistics statistics;
  MapCopy maps;
  PatchLight patches;
  std::vector<std::uint8_t> picture;
};

/// The smallest budget, in bytes, in which the job can be run; 0 for one that takes more by itself. Loads the scene.
Status smallest_budget(const ReportJob& job, std::uint64_t& bytes);

/// Runs all, the first ones first; stops early if one fails or the user interrupts. The first failure in the order of
/// the list, kDone if all are done.
Status run_jobs(std::vector<ReportJob>& jobs, bool shown);

}  // namespace shodo
