#include "cli/report_scaling.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>

#include "base/elementary.h"

namespace shodo {

namespace {

constexpr std::size_t kPatches = 0, kTests = 3, kInstructions = 5, kValues = 6;

/// Lines that differ in their size alone have one.
std::string series_name(const CountedLine& size) {
  return size.room + ", " + size.options.substr(0, size.options.find(" --refine "));
}

struct Series {
  std::string name;
  std::vector<double> values[kValues];  // size by size
};

std::vector<Series> series_of(const std::vector<CountedLine>& sizes) {
  std::vector<Series> all;
  for (const CountedLine& size : sizes) {
    const std::string name = series_name(size);
    auto at = std::find_if(all.begin(), all.end(), [&](const Series& s) { return s.name == name; });
    if (at == all.end()) at = all.insert(at, {name, {}});
    for (std::size_t k = 0; k < kValues; ++k) at->values[k].push_back(size.values[k]);
  }
  return all;
}

bool counted(const Series& series) { return series.values[kInstructions].front() > 0; }

bool different(std::span<const double> n) {
  return std::adjacent_find(n.begin(), n.end(), std::not_equal_to<>()) != n.end();
}

Table size_table(const Series& series) {
  Table table{"scaling.csv", series.name, {}, {}, {}};
  table.columns = {{"patches", "patches"},   {"links", "entries stored"}, {"segments", "segments"},
                   {"tests", "tests"},       {"row_bytes", "rows"},       {"instructions", "instructions"}};
  const auto cell = [](std::size_t k, double value) {
    const auto whole = static_cast<std::uint64_t>(value);
    return k == kPatches ? Cell::number(whole) : k == kInstructions - 1 ? Cell::bytes(whole) : Cell::count(whole);
  };
  const std::size_t columns = counted(series) ? kValues : kInstructions;
  for (std::size_t size = 0; size < series.values[kPatches].size(); ++size) {
    std::vector<Cell>& row = table.rows.emplace_back(kValues);
    for (std::size_t k = 0; k < columns; ++k) row[k] = cell(k, series.values[k][size]);
  }
  std::vector<Cell>& fit = table.rows.emplace_back(kValues);
  fit[kPatches] = Cell::words("exponent");
  for (std::size_t k = 1; k < columns; ++k)
    fit[k] = different(series.values[kPatches])
                 ? Cell::real(fitted_exponent(series.values[kPatches], series.values[k]))
                 : Cell{};
  return table;
}

}  // namespace

bool read_scaling(std::string_view csv, std::vector<CountedLine>& sizes) {
  if (!read_counted_lines(csv, "room,options,patches,links,segments,tests,row_bytes,instructions", sizes)) return false;
  const auto whole = [](const CountedLine& size) {
    return std::all_of(size.values.begin(), size.values.begin() + kInstructions, [](double v) { return v > 0; });
  };
  const auto same = [&](const CountedLine& size) {
    return (size.values[kInstructions] > 0) == (sizes.front().values[kInstructions] > 0);
  };
  if (std::all_of(sizes.begin(), sizes.end(), whole) && std::all_of(sizes.begin(), sizes.end(), same)) return true;
  sizes.clear();
  return false;
}

double fitted_exponent(std::span<const double> n, std::span<const double> y) {
  if (!different(n)) return 0;
  const double count = static_cast<double>(n.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < n.size(); ++k) {
    mean_x += logarithm(n[k]) / count;
    mean_y += logarithm(y[k]) / count;
  }
  for (std::size_t k = 0; k < n.size(); ++k) {
    const double x = logarithm(n[k]) - mean_x;
    xx += x * x;
    xy += x * (logarithm(y[k]) - mean_y);
  }
  return xy / xx;
}

void add_scaling_chapter(Document& document, const std::vector<CountedLine>& sizes) {
  if (sizes.empty()) return;
  const std::vector<Series> all = series_of(sizes);
  const bool has_instructions = counted(all.front());
  const std::size_t shown = has_instructions ? kInstructions : kTests;
  Plot plot;
  plot.file = "scaling.svg";
  plot.title = "cost against size";
  plot.x_title = "patches";
  plot.y_title = has_instructions ? "instructions of form factors and solution" : "triangle tests for form factors";
  document.heading(2, "Cost against size");
  document.paragraph(
      "Both rooms at 1/2, 1, 2, 4 and 8 times the patches, counted by make scaling; segments and tests are those of "
      "the form factors, instructions those of form factors and solution on the paper's workstation. The last line of "
      "each table has the exponent x of cost = c patches^x, fitted by least squares of the logarithms; a matrix of all "
      "pairs would have 2.");
  for (std::size_t s = 0; s < all.size(); ++s) {
    plot.groups.push_back(all[s].name);
    for (std::size_t k = 0; k < all[s].values[kPatches].size(); ++k) {
      plot.points.push_back({all[s].values[kPatches][k], all[s].values[shown][k], 0, static_cast<std::uint32_t>(s),
                             false, all[s].name});
    }
  }
  document.blocks.emplace_back(plot);
  for (const Series& series : all) {
    document.heading(3, series.name);
    document.blocks.emplace_back(size_table(series));
  }
}

}  // namespace shodo
