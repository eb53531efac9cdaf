// What is said of the IES files that a scene names: the light they give, and what of them was not taken as it stands.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace shodo {

/// "FILE: 1,234 lm, up to 567 cd, 37 x 5 angles"; a line a file.
std::vector<std::string> luminaire_lines(const Scene& scene);
std::vector<std::string> luminaire_warnings(const Scene& scene);

}  // namespace shodo
