#include "picture/texture_lookup.h"

namespace shodo {

TextureLookup::TextureLookup(const Scene& scene, const Texture& texture, bool repeats)
    : linear_(scene.texture_linear), channels_(texture.channels), repeats_(repeats) {
  while (count_ < kMostLevels) {
    level_[count_] = texture_level(texture, count_);
    ++count_;
    if (level_[count_ - 1].width == 1 && level_[count_ - 1].height == 1) break;
  }
}

}  // namespace shodo
