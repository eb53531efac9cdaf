// The picture (paper 2.4): camera, integer scanlines, shading from the illuminance maps, display values.
//
// view.h makes the camera integer; from there visibility is exact (visible_lines.h). Antialiased, a pixel shows what
// surfaces cover along 2 or 4 rows, edges exact to 1/256 of its width (sample_run.h). Fronts of meshes show their map
// (shade.h, display.h), fronts of area lights their luminance, backs and nothing are black; an opening has no back.
// One line of pixels is finished at a time and handed to the sink.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/arena.h"
#include "map/illuminance_map.h"
#include "scene/scene.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/status.h"
#include "visibility/geometry.h"

namespace shodo {

/// The first for an empty name; null if there is none, and why.
const Camera* find_camera(const Scene& scene, std::string_view name);
Status no_camera(const Scene& scene, std::string_view name);

/// Everything that lines are made of, in the arena: the maps as the display shows them, and what visibility, textures
/// and optics start with.
struct Picture;

/// Errors: kMemory; kUsage for a camera that the scene doesn't have, or a size.
Status prepare_picture(const Scene& scene, const Geometry& geometry, const IlluminanceMaps& maps,
                       const Options& options, Arena& arena, Picture*& picture);
/// Draws a prepared picture, line by line. Errors: kInterrupted.
Status draw_lines(Picture& picture, const Options& options, const Progress& progress, const LineSink& sink);

/// What prepare_picture takes of the arena, exactly, each block rounded up to 8 bytes; 0 if there is no such camera.
///
///   sizeof(Picture) + 2 sub_patches channels + max(sub-patches of the largest mesh,
///   8193 + (4 channels + 3) width + 4 rows + 10 drawn + (sizeof(ActiveTriangle) + 16) active +
///   32 meshes if there are textures)
///
/// rows: 1, 2 or 4 a pixel, as `antialias` is 1, 4 or 16. active: the most triangles that touch one of 128 bands of
/// rows; one pass over all triangles finds it.
std::uint64_t picture_bytes(const Scene& scene, const Geometry& geometry, const Options& options);

}  // namespace shodo
