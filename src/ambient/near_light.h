// A point light that is near to a sub-patch: what that sends depends on where (ambient/gather.h).
//
//     E_L(x) = I cos / d^2, or as the light's attenuation has it, nothing in the way
//
// A lamp in its shade, a spot on a wall: E_L changes by half and more within one sub-patch, and what lies beside it
// gets its light from the bright end. Of a light that is so near that a spot of the sub-patch gets most of it the mean
// does better: few lines meet the spot.
#pragma once

#include <cstdint>

#include "base/vector.h"
#include "scene/scene.h"
#include "scene/sub_patches.h"

namespace shodo {

class NearLight {
 public:
  /// Whether one may be near to any of the `in_u` times `in_v` sub-patches of a cell or a patch.
  static bool reaches(const Light& light, const Piece& piece, std::uint32_t in_u, std::uint32_t in_v);
  /// Whether one is uneven on a sub-patch, which is then known. `step`: of the lattice.
  bool find(const Scene& scene, const Light& light, const Mesh& mesh, std::uint32_t local, double step);

  /// Lux of it, at a point.
  double lux(const Scene& scene, const Light& light, const Vec3& point, double step) const;

 private:
  static constexpr double kNear = 3;                // longest sides of a sub-patch
  static constexpr double kUneven = 2, kSpot = 16;  // the largest over the least, at some points

  Vec3 normal_, anchor_;  // of the plane of the sub-patch's vector area
};

/// act(light's number, mesh's, sub-patch counted from the mesh's first, where), for all that are uneven; a sub-patch
/// may have several.
template <class Do>
void for_near_lights(const Scene& scene, double step, Do act) {
  NearLight here;
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    if (light.kind != LightKind::kPoint) continue;
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
      const Mesh& mesh = scene.meshes[m];
      const std::uint32_t in_u = mesh.map_width() / mesh.cells_u, in_v = mesh.map_height() / mesh.cells_v;
      bool any = false;
      for (std::uint32_t cell = 0; cell < cell_count(mesh) && !any; ++cell) {
        any = NearLight::reaches(light, cell_piece(scene, mesh, cell), in_u, in_v);
      }
      for (std::uint32_t p = 0; any && p < mesh.patch_count(); ++p) {
        if (!NearLight::reaches(light, patch_piece(scene, mesh, p), mesh.su, mesh.sv)) continue;
        SubPatchesOfPatch parts(mesh, p);
        for (std::uint32_t k = parts.next(); k != kNone; k = parts.next()) {
          if (here.find(scene, light, mesh, k, step)) act(l, m, k, here);
        }
      }
    }
  }
}

}  // namespace shodo
