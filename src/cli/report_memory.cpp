#include "cli/report_memory.h"

#include <algorithm>

#include "base/decimal.h"

namespace shodo {

namespace {

constexpr std::string_view kHead =
    "room,options,budget,instructions,floating_point,seconds,rows_kept,rows_recomputed,lit_again,placed_again";

std::string_view next_part(std::string_view& text, char end) {
  const std::size_t at = text.find(end);
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + 1);
  return part;
}

/// Counts are exact up to here.
constexpr double kLargestCount = 0x1p53;

bool number(std::string_view text, double& value) {
  const DecimalResult found = parse_decimal(text);
  value = found.value;
  return found.error == DecimalError::none && value >= 0 && value <= kLargestCount;
}

/// Options may hold commas: they are what stands between the first column and the last eight.
bool parse_line(std::string_view line, MemoryCost& cost) {
  double values[8] = {};
  for (std::size_t k = 8; k-- > 0;) {
    const std::size_t at = line.rfind(',');
    if (at == std::string_view::npos || !number(line.substr(at + 1), values[k])) return false;
    line = line.substr(0, at);
  }
  cost.room = next_part(line, ',');
  cost.options = line;
  cost.budget = values[0];
  cost.instructions = values[1];
  cost.floating = values[2];
  cost.seconds = values[3];
  cost.rows_kept = values[4];
  cost.rows_recomputed = values[5];
  cost.lit_again = values[6] > 0;
  cost.placed_again = values[7] > 0;
  return !cost.room.empty() && cost.budget > 0 && cost.instructions > 0;
}

std::string series_name(const MemoryCost& cost) { return cost.room + ", " + cost.options; }

Table cost_table(const std::vector<MemoryCost>& costs, const std::string& series) {
  Table table{"memory.csv", series, {}, {}, {}};
  table.columns = {{"budget", "budget"},
                   {"rows_kept", "rows kept"},
                   {"rows_recomputed", "rows found in each sweep"},
                   {"lit_again", "lit again"},
                   {"placed_again", "placed again"},
                   {"instructions", "instructions"},
                   {"floating_point", "floating-point operations"},
                   {"seconds", "seconds of the workstation"}};
  const auto whole = [](double value) { return Cell::number(static_cast<std::uint64_t>(value)); };
  for (const MemoryCost& cost : costs) {
    if (series_name(cost) != series) continue;
    table.rows.push_back({whole(cost.budget), whole(cost.rows_kept), whole(cost.rows_recomputed),
                          Cell::words(cost.lit_again ? "yes" : "no"), Cell::words(cost.placed_again ? "yes" : "no"),
                          whole(cost.instructions), whole(cost.floating), Cell::real(cost.seconds)});
  }
  return table;
}

}  // namespace

std::vector<MemoryCost> memory_costs(std::string_view csv) {
  std::vector<MemoryCost> costs;
  if (next_part(csv, '\n') != kHead) return costs;
  while (!csv.empty()) {
    MemoryCost cost;
    if (!parse_line(next_part(csv, '\n'), cost)) return {};
    costs.push_back(std::move(cost));
  }
  return costs;
}

void add_memory_chapter(Document& document, const std::vector<MemoryCost>& costs) {
  if (costs.empty()) return;
  Plot plot;
  plot.file = "memory.svg";
  plot.title = "what less memory costs";
  plot.x_title = "budget, bytes";
  plot.y_title = "instructions of the workstation";
  for (const MemoryCost& cost : costs) {
    const std::string series = series_name(cost);
    const auto at = std::find(plot.groups.begin(), plot.groups.end(), series);
    const std::size_t group = static_cast<std::size_t>(at - plot.groups.begin());
    if (at == plot.groups.end()) plot.groups.push_back(series);
    plot.points.push_back({cost.budget, cost.instructions, static_cast<std::uint32_t>(plot.points.size() + 1),
                           static_cast<std::uint32_t>(group), false, series});
  }
  document.heading(2, "Less memory");
  document.paragraph(
      "Budgets from the smallest that works on, each with the same picture, byte for byte; counted by make "
      "memory-cost. Rows that don't fit are found again in each sweep. Before that, what can be found again gives up "
      "its memory: geometry of patches and blocks, the direct light of the sub-patches, the triangles of the picture.");
  document.blocks.emplace_back(plot);
  for (const std::string& series : plot.groups) {
    document.heading(3, series);
    document.blocks.emplace_back(cost_table(costs, series));
  }
}

}  // namespace shodo
