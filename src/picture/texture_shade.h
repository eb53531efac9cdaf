// What a textured mesh shows at places of its map: light from the map times the texture's value over its mean, plus
// what the mesh emits (paper 2.4 and beyond; scene/texture.h). Where the places come from is the caller's:
// picture/textured.h walks along a scanline, picture/light_path.h follows rays.
//
// A texture is looked up in two levels of detail, bilinearly in each, and the two are mixed; `step` chooses them: how
// many texels of the finest level lie between a sample and the next one, or the one below. Approximate: between levels
// the logarithm of the step is taken as a straight line. Weights have 8 bits, coordinates 1/2^32 of a repeat. Doubles
// become integers in fixed_point() alone.
// Bytes: 32 a mesh, in scenes with textures; stack 250.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/texels.h"
#include "picture/texture_lookup.h"
#include "scene/texture.h"

namespace shodo {

/// How a mesh shows its texture.
struct MeshTexture {
  std::uint32_t texture = kNone;
  bool repeats = false;           // else it ends at the mesh's borders
  double s = 0, t = 0;            // repeats a sub-patch along u and v; t runs upwards in the picture
};

/// One for each mesh; none and no bytes if the scene has no textures. False if the arena is too small.
[[nodiscard]] bool find_mesh_textures(const Scene& scene, Arena& arena, std::span<MeshTexture>& textures);
std::uint64_t mesh_texture_bytes(const Scene& scene);

/// a 2^bits, towards zero, within +-(2^31 - 1): here doubles become integers, and nowhere else.
std::int32_t fixed_point(double a, int bits);

inline constexpr double kCoarsestStep = 1 << TextureLookup::kMostLevels;  // whatever the size, the last level

/// A sample's place on the map and on the texture.
struct TexturePlace {
  double u = 0, v = 0;     // sub-patches
  double s = 0, t = 0;     // repeats, t downwards
  double inverse_depth = 1;
  double step = kCoarsestStep;
};

class TextureShade {
 public:
  TextureShade(const Scene& scene, const Mesh& mesh, const MeshTexture& at, const MapTexels& map);

  /// s and t of a place that has u and v.
  void set_texture_place(TexturePlace& place) const {
    place.s = place.u * at_.s;
    place.t = 1 - place.v * at_.t;
  }
  /// Texels to a neighbour whose map coordinates are so far away.
  double texels(double du, double dv) const;

  /// Whether coordinates may be taken linearly between two places.
  bool straight(const TexturePlace& a, const TexturePlace& b) const;

  /// Display steps of `length` samples from `start` on, of which the `reach`-th is at `end`: put(k, steps), steps[c] at
  /// most `most`.
  template <class Put>
  void show_piece(std::int32_t length, std::int32_t reach, const TexturePlace& start, const TexturePlace& end,
                  std::uint32_t most, Put put) const {
    Course course(*this, reach, start, end);
    for (std::int32_t k = 0; k < length; ++k) {
      std::uint32_t steps[3];
      course.next(steps, most);
      put(k, steps);
    }
  }

  static constexpr std::int32_t kReach = 8;  // samples a piece

 private:
  class Course {
   public:
    Course(const TextureShade& shade, std::int32_t reach, const TexturePlace& start, const TexturePlace& end);
    void next(std::uint32_t (&steps)[3], std::uint32_t most);

   private:
    const TextureShade& shade_;
    PieceLookup light_;
    std::uint32_t s_, t_, step_;
    std::int32_t ds_, dt_, dstep_;
  };
  std::uint32_t shown(std::uint32_t light, std::uint32_t value, std::uint32_t c, std::uint32_t most) const;
  /// A texture that ends at the borders must not begin again there: it keeps 2^-22 of itself away from them.
  double inside(double s) const { return at_.repeats ? s : 0x1p-22 + s * (1 - 0x1p-21); }

  const Texture& texture_;
  const MeshTexture& at_;
  MapTexels map_;
  TextureLookup lookup_;
  std::int32_t offset_[3] = {0, 0, 0};  // halves of display steps: what is emitted, less MIN
  std::uint32_t mean_[3] = {1, 1, 1};   // of the texture, of 65535
};

// What every sample of a textured surface runs through.

/// Display steps of reflected light `light`.
inline std::uint32_t TextureShade::shown(std::uint32_t light, std::uint32_t value, std::uint32_t c,
                                         std::uint32_t most) const {
  const std::uint32_t reflected = (light * value + mean_[c] / 2) / mean_[c];  // below 2^32: 65535^2 + 32767
  const std::int64_t steps = std::int64_t{reflected} + 2 * std::int64_t{offset_[c]};
  return steps < 0 ? 0 : steps > most ? most : static_cast<std::uint32_t>(steps);
}

inline void TextureShade::Course::next(std::uint32_t (&steps)[3], std::uint32_t most) {
  std::uint32_t value[3];
  light_.next(steps);
  shade_.lookup_.look_up(s_, t_, step_, value);
  for (std::uint32_t c = 0; c < shade_.map_.channels; ++c) {
    steps[c] = shade_.shown(steps[c], value[shade_.texture_.channels == 1 ? 0 : c], c, most);
  }
  s_ += static_cast<std::uint32_t>(ds_);
  t_ += static_cast<std::uint32_t>(dt_);
  step_ += static_cast<std::uint32_t>(dstep_);
}

}  // namespace shodo
