// What a stage returns when the caller's progress or sink of lines says no: the code tells all.
#pragma once

#include "shodo/status.h"

namespace shodo {

Status interrupted();

}  // namespace shodo
