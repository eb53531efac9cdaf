// Ambient light where panes are coloured: a form factor then differs from channel to channel (doc/optics.md).
//
// The rows hold one value a pair, so each channel is found by itself, with what panes let through of it: three times
// the time, of which nothing is kept but the one channel's answer. Bytes: 8 channels a patch more while it goes on.
// Grey panes, and scenes without any, go straight to light_ambiently().
#pragma once

#include "ambient/ambient.h"

namespace shodo {

/// As light_ambiently().
Status light_ambiently_through_panes(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                                     const DirectLight& direct, Intersector& intersector, const Options& options,
                                     const Progress& progress, Arena& arena, AmbientLight& ambient,
                                     Statistics& statistics);

/// Arena bytes that it takes besides.
std::uint64_t coloured_panes_bytes(const Scene& scene, const Geometry& geometry);

}  // namespace shodo
