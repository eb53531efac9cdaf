// The picture's two steps as one.
#pragma once

#include "picture/picture.h"

namespace shodo {

/// The arena is then as it was.
inline Status draw_picture(const Scene& scene, const Geometry& geometry, const IlluminanceMaps& maps,
                           const Options& options, const Progress& progress, Arena& arena, const LineSink& sink) {
  const ArenaScratch scratch(arena);
  Picture* picture = nullptr;
  const Status status = prepare_picture(scene, geometry, maps, options, arena, picture);
  return status.done() ? draw_lines(*picture, options, progress, sink) : status;
}

}  // namespace shodo
