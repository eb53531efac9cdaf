// The CSV table, one line a sub-patch (contract 1).
#pragma once

#include "cli/output.h"
#include "model.h"

namespace shodo {

/// object: its name; mesh: its number, as in NNNN.pfm; u, v: column and row of the sub-patch in its mesh (of a
/// triangle: its place in row v, upright and inverted ones by turns); x y z: centre, scene units of the file; n: unit
/// normal; area: scene units squared; then direct and ambient illuminance, area means in lux. A grey scene repeats its
/// value three times. What is hidden is 0; sub-patches of patches that were dropped have no line.
bool write_table(const Model& model, OutputFile& file, FileError& error);

}  // namespace shodo
