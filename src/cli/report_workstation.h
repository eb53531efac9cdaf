// Seconds of the paper's workstation, from the file that `make workstation` leaves.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace shodo {

struct WorkstationSeconds {
  double direct = 0, form_factors = 0, solution = 0, map = 0, picture = 0, total = 0;
};

/// Of one room: {"day": {"direct": 1.5, ...}, ...}. Nothing if the text has no such room or lacks one of its numbers.
std::optional<WorkstationSeconds> workstation_seconds(std::string_view json, std::string_view room);

/// The string under "options" at the top, which says how the rooms were run; empty if there is none.
std::string workstation_options(std::string_view json);

}  // namespace shodo
