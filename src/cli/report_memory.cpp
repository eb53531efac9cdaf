#include "cli/report_memory.h"

#include <algorithm>

#include "cli/report_counts.h"

namespace shodo {

namespace {

constexpr std::string_view kHead =
    "room,options,budget,instructions,floating_point,seconds,rows_kept,rows_recomputed,lit_again,placed_again";

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

bool memory_costs(std::string_view csv, std::vector<MemoryCost>& costs) {
  costs.clear();
  std::vector<CountedLine> lines;
  if (!read_counted_lines(csv, kHead, lines)) return false;
  for (const CountedLine& line : lines) {
    const std::vector<double>& v = line.values;
    costs.push_back({line.room, line.options, v[0], v[1], v[2], v[3], v[4], v[5], v[6] > 0, v[7] > 0});
  }
  const auto plotted = [](const MemoryCost& cost) { return cost.budget > 0 && cost.instructions > 0; };
  if (std::all_of(costs.begin(), costs.end(), plotted)) return true;
  costs.clear();
  return false;
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
    plot.points.push_back({cost.budget, cost.instructions, 0, static_cast<std::uint32_t>(group), false, series});
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
