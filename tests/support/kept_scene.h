// A loaded scene with the texels of its textures, as while a picture is drawn.
#pragma once

#include "scene/texture.h"
#include "support/scene_from_text.h"

namespace shodo {

struct KeptScene : LoadedScene {
  explicit KeptScene(std::string_view text, const Options& options = {}, TestFiles included = {})
      : LoadedScene(text, options, std::move(included)) {
    EXPECT_TRUE(keep_texels(scene, reader_of(files), arena, status)) << to_text(status);
  }
};

}  // namespace shodo
