// What the patches of textured meshes reflect: each the mean of its part of the texture (paper 2.2's rho_j; beyond the
// paper, scene/texture.h).
//
// A patch's reflectance is the material's `diffuse` times the mean of the texture's linear values over the patch, over
// the mean of all of it: so the mean over a whole number of repeats is `diffuse`. It is taken over the level of detail
// that has 8 to 16 texels across the patch, by the area that each texel covers, in map coordinates; of a patch of a
// triangle at the middles of its 64 parts.
// Approximate: the area of a quadrilateral that is no parallelogram isn't even over its map; levels beyond the first
// are rounded to 8 bits.
// A repeated pattern that differs by at most an eighth from patch to patch counts as even: its mesh has `diffuse`.
// Bytes: 24 another textured mesh and 4 a channel and patch of it, and the textures' texels while it goes on; none in
// scenes without textures.
#pragma once

#include <cstdint>

#include "base/arena.h"
#include "scene/scene.h"
#include "shodo/callbacks.h"
#include "shodo/status.h"

namespace shodo {

/// After channels and counts are decided. Errors: as keep_texels().
[[nodiscard]] bool find_patch_reflectances(Scene& scene, const Reader& reader, Arena& arena, Status& status);

/// Reflectances of one mesh, by channel.
class MeshReflectance {
 public:
  MeshReflectance() = default;
  MeshReflectance(const Scene& scene, std::uint32_t mesh)
      : diffuse_(scene.materials[scene.meshes[mesh].material].diffuse.c) {
    if (!scene.textured.empty()) find(scene, mesh);
  }

  /// All patches reflect alike.
  bool even() const { return values_ == nullptr; }
  /// Of a patch, counted from the mesh's first; `room` may be used for it.
  const double* of(std::uint32_t local, double (&room)[3]) const {
    return values_ == nullptr ? diffuse_ : widened(values_ + local * channels_, room);
  }
  /// At least that of any patch.
  const double* most(double (&room)[3]) const { return values_ == nullptr ? diffuse_ : widened(most_, room); }

 private:
  void find(const Scene& scene, std::uint32_t mesh);
  const double* widened(const float* from, double (&room)[3]) const {
    for (std::uint32_t c = 0; c < channels_; ++c) room[c] = static_cast<double>(from[c]);
    return room;
  }

  const double* diffuse_ = nullptr;
  const float* values_ = nullptr;  // of a textured mesh
  const float* most_ = nullptr;
  std::uint32_t channels_ = 1;
};

}  // namespace shodo
