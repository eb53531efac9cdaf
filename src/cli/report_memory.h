// What less memory costs, from the file that `make memory-cost` leaves: a chapter of the report.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cli/report_document.h"

namespace shodo {

/// A run with one budget.
struct MemoryCost {
  std::string room, options;
  double budget = 0;                      // bytes
  double instructions = 0, floating = 0;  // of the workstation
  double seconds = 0;
  double rows_kept = 0, rows_recomputed = 0;
  bool lit_again = false, placed_again = false;
};

/// The lines of the file. False, and none, if `csv` is not empty and not as `make memory-cost` leaves it.
bool memory_costs(std::string_view csv, std::vector<MemoryCost>& costs);

/// Nothing if there are no costs.
void add_memory_chapter(Document& document, const std::vector<MemoryCost>& costs);

}  // namespace shodo
