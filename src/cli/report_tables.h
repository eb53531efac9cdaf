// The tables of the report's first chapter.
#pragma once

#include "cli/report_results.h"

namespace shodo {

/// One line a quantity; columns: the paper without and with flags, our cases, workstation seconds.
Table paper_table(const SceneResults& scene);

/// Whether flags auto changed nothing, and how much less they took than off.
Table flags_table(const SceneResults& scene);

}  // namespace shodo
