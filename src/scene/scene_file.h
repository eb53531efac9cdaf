// Reads a scene file (contract 2) into a Scene.
#pragma once

#include <string_view>

#include "base/arena.h"
#include "scene/scene.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/status.h"

namespace shodo {

/// Reads `text`, called `name` in messages, and everything it includes; leaves the scene in the arena.
///
/// Counts come from the file, from options.patch_size, sub_patch_size and refine. Coordinates are centred.
/// Errors: kScene with file:line:column, what was expected and what was found; kMemory with the size that would do for
/// the scene; kFile for a file that can't be read; kUsage for options that no scene can have. The arena is then
/// as before.
Status load_scene(std::string_view name, std::string_view text, const Reader& reader, const Options& options,
                  Arena& arena, Scene& scene);

}  // namespace shodo
