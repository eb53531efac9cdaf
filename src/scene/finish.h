// What can be done only when a whole scene has been read: the centre, the counts, the centres of lights, the channels.
#pragma once

#include "scene/scene.h"
#include "scene/statements.h"
#include "shodo/options.h"
#include "shodo/status.h"

namespace shodo {

/// Puts the middle of the scene's box at the origin. The box holds the vertices, the corners of area lights and planes,
/// point lights and eyes; faces that were dropped are not in it. A coordinate a becomes ((a - min) + (a - max)) / 2:
/// moving or mirroring a scene changes no bit, as long as its coordinates can be moved exactly; the error is an ulp of
/// the box.
void centre_scene(Scene& scene);

/// Positions of area and polyhedral lights: the area-weighted mean of their surface, faces ascending, each cut in two.
void place_lights(Scene& scene);

/// 1 if everything is grey, else 3.
void decide_channels(Scene& scene);

/// kUsage if patch_size, sub_patch_size or refine can't be used.
Status check_count_options(const Options& options);

/// Fills in nu, nv, su, sv where they are 0, applies refine, and numbers patches and sub-patches; of planes too, apart.
/// False if a mesh, a plane or the scene has too many, with a message without position and which it is in `wanted`.
bool decide_counts(Scene& scene, const Options& options, Status& status, Wanted& wanted);

}  // namespace shodo
