// What a run counted and how long it took, as JSON (contract 1).
#pragma once

#include <string>

#include "cli/run.h"

namespace shodo {

/// One object; numbers in their shortest form that reads back the same.
std::string statistics_json(const Run& run);

}  // namespace shodo
