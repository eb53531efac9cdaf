// Tables that the tools of the workstation leave for the report: room,options,numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shodo {

/// One line of such a table.
struct CountedLine {
  std::string room, options;   // options may hold commas
  std::vector<double> values;  // what follows them, each at least 0 and exact
};

/// The lines below `head`, which names the columns. False, and none, if `csv` is not empty and not such a table.
bool read_counted_lines(std::string_view csv, std::string_view head, std::vector<CountedLine>& lines);

/// What `make case-cost` counted of a case: the whole run but loading.
struct CaseCost {
  double instructions = 0, floating = 0;
  double seconds = 0;  // of the paper's workstation
};

/// Of every case that it counted.
class CaseCosts {
 public:
  /// False if it is no such table.
  bool read(std::string_view csv);
  /// `options`: as of options_text().
  std::optional<CaseCost> find(std::string_view room, std::string_view options) const;

 private:
  std::vector<CountedLine> lines_;
};

}  // namespace shodo
