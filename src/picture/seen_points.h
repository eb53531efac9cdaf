// What every sample of a picture sees: which point of which surface (ours; for pictures that measure).
//
// Samples are points, `antialias` of them a pixel; with one, they are those of the picture. The triangles that they see
// are found as there (visible_lines.h); the point on the surface is exact, by integers, and costs a division or three
// at each sample (exact_map_point), since nothing here is in a hurry. Nothing is shaded.
// Bytes: VisibleLines::bytes, which is less than the picture takes.
#pragma once

#include <cstdint>

#include "base/arena.h"
#include "scene/scene.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/status.h"
#include "visibility/geometry.h"

namespace shodo {

struct SeenPoint {
  std::uint32_t x = 0, y = 0;    // samples, from the upper left one; sqrt(antialias) a pixel each way
  std::uint32_t mesh = kNone;    // kNone: an area light
  std::uint32_t light = kNone;
  bool front = false;
  std::int32_t u = 0, v = 0;     // of a mesh: sub-patches 20.12
};

/// Told in rows, and in a row from left to right; samples that see nothing are left out.
struct SeenSink {
  void (*point)(void* context, const SeenPoint& seen) = nullptr;
  void* context = nullptr;
};

/// Errors: kMemory, kInterrupted; kUsage for a camera that the scene doesn't have.
Status see_points(const Scene& scene, const Geometry& geometry, const Options& options, const Progress& progress,
                  Arena& arena, const SeenSink& sink);

}  // namespace shodo
