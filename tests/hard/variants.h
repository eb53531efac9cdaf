// Runs of variants of one scene, compared patch by patch whatever the order and the winding of its polygons.
#pragma once

#include <vector>

#include "hard/run.h"
#include "hard/scene_text.h"

namespace shodo::hard {

/// What the patches of a mesh have, row by row along the edges as they were given, not as a mirrored file has them.
struct Keyed {
  std::vector<double> e0, total;
  std::vector<float> map;  // direct, then ambient, of the sub-patches in the file's order
};

/// By key; `scene` after the text() that was run.
std::vector<Keyed> by_key(const FullRun& run, const SceneText& scene);

/// The largest difference of E0 and total, of the largest total; -1 if the meshes don't match.
double difference(const std::vector<Keyed>& a, const std::vector<Keyed>& b);

}  // namespace shodo::hard
