// Seconds of the paper's workstation, from the file that `make workstation` leaves.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace shodo {

struct WorkstationSeconds {
  double direct = 0, form_factors = 0, solution = 0, map = 0, picture = 0, total = 0;
  std::string options;  // of the program, as they were given; empty if the file doesn't tell
};

/// Of one room: {"day": {"direct": 1.5, ...}, ...}; nothing if the text has no such room. False if it is not empty and
/// no object, or the room lacks one of its numbers.
bool workstation_seconds(std::string_view json, std::string_view room, std::optional<WorkstationSeconds>& seconds);

}  // namespace shodo
