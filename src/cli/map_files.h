// The illuminance maps as files: NNNN.pfm a mesh, and index.csv which says what they are (contract 1).
#pragma once

#include <cstdint>
#include <string>

#include "cli/output.h"
#include "model.h"

namespace shodo {

/// A mesh's map as a PFM file: total illuminance, lux, Pf (grey) or PF, little-endian on every machine.
///
/// Width nu su, height nv sv, the bottom row, v = 0, first. A triangle with k sub-patches along each edge is a k x k
/// square: (a, b) with a + b < k holds the mean of the upright sub-patch at column a, row b and, if a + b < k - 1, the
/// inverted one beside it, which have equal areas; the rest of the square is 0.
std::string pfm(const Model& model, std::uint32_t mesh);

/// index.csv: file, object, mesh, kind, material, width, height, patches_u, patches_v, sub_u, sub_v; one line a mesh.
std::string map_index(const Model& model);

/// "0012.pfm"
std::string map_name(std::uint32_t mesh);

/// Everything into an opened folder; stops when the user interrupts.
bool write_maps(const Model& model, OutputFolder& folder, FileError& error);

}  // namespace shodo
