#include "cli/report_counts.h"

#include <algorithm>
#include <utility>

#include "base/decimal.h"

namespace shodo {

namespace {

std::string_view next_line(std::string_view& text) {
  const std::size_t at = text.find('\n');
  const std::string_view line = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + 1);
  return line;
}

/// Counts are exact up to here.
constexpr double kLargestCount = 0x1p53;

bool number(std::string_view text, double& value) {
  const DecimalResult found = parse_decimal(text);
  value = found.value;
  return found.error == DecimalError::none && value >= 0 && value <= kLargestCount;
}

/// Options are what stands between the first column and the last ones.
bool parse_line(std::string_view line, std::size_t values, CountedLine& read) {
  read.values.resize(values);
  for (std::size_t k = values; k-- > 0;) {
    const std::size_t at = line.rfind(',');
    if (at == std::string_view::npos || !number(line.substr(at + 1), read.values[k])) return false;
    line = line.substr(0, at);
  }
  const std::size_t at = line.find(',');
  if (at == 0 || at == std::string_view::npos) return false;
  read.room = line.substr(0, at);
  read.options = line.substr(at + 1);
  return true;
}

}  // namespace

bool read_counted_lines(std::string_view csv, std::string_view head, std::vector<CountedLine>& lines) {
  lines.clear();
  if (csv.empty()) return true;
  if (next_line(csv) != head) return false;
  const std::size_t values = static_cast<std::size_t>(std::count(head.begin(), head.end(), ',')) - 1;
  while (!csv.empty()) {
    if (!parse_line(next_line(csv), values, lines.emplace_back())) {
      lines.clear();
      return false;
    }
  }
  return true;
}

bool CaseCosts::read(std::string_view csv) {
  return read_counted_lines(csv, "room,options,instructions,floating_point,seconds", lines_);
}

std::optional<CaseCost> CaseCosts::find(std::string_view room, std::string_view options) const {
  for (const CountedLine& line : lines_) {
    if (line.room == room && line.options == options) return CaseCost{line.values[0], line.values[1], line.values[2]};
  }
  return {};
}

}  // namespace shodo
