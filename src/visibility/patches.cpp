// The patches as the light stages see them (paper 2.1): centre, normal and area in original coordinates.
//
// A patch under 32 lattice steps wide is thin: rounding moves its samples by a noticeable part of it, so they are taken
// from its middle half. One under 4 steps, or without area, neither sends nor receives; it still blocks.
#include "visibility/geometry.h"

namespace shodo {

namespace {

constexpr double kThinSteps = 32;
constexpr double kDroppedSteps = 4;

/// Lattice steps across: the area over the longest side, twice that for a triangle, whose height it is then.
double width_in_steps(const Lattice& lattice, const Piece& piece, double area, double longest_side) {
  if (!(longest_side > 0)) return 0;
  return lattice.steps_per_unit * (piece.corners == 3 ? 2 : 1) * area / longest_side;
}

Patch patch_of(const Geometry& geometry, std::uint32_t mesh, const Piece& piece) {
  Patch patch;
  patch.mesh = mesh;
  patch.centre = piece.centre();
  const Vec3 vector_area = piece.vector_area();
  patch.area = length(vector_area);
  patch.normal = normalised(vector_area);
  patch.longest_side = piece.longest_side();
  const double width = width_in_steps(geometry.lattice, piece, patch.area, patch.longest_side);
  patch.dropped = !(width >= kDroppedSteps) ? 1 : 0;
  patch.thin = !(width >= kThinSteps) ? 1 : 0;
  return patch;
}

}  // namespace

Patch make_patch(const Scene& scene, const Geometry& geometry, std::uint32_t mesh, std::uint32_t local) {
  return patch_of(geometry, mesh, patch_piece(scene, scene.meshes[mesh], local));
}

bool is_thin(const Lattice& lattice, const Piece& piece) {
  return !(width_in_steps(lattice, piece, length(piece.vector_area()), piece.longest_side()) >= kThinSteps);
}

double sample_inset(const Patch& patch) { return patch.thin != 0 ? 0.25 : 0.0; }

Status build_patches(const Scene& scene, const Geometry& geometry, Arena& arena, std::span<Patch>& patches,
                     Statistics& statistics) {
  if (!arena.take("patches", scene.patch_count, patches)) return arena.refused();
  statistics.patches = 0;
  statistics.sub_patches = 0;
  statistics.patches_dropped = 0;
  statistics.patches_thin = 0;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const std::uint32_t sub_patches = mesh.su * mesh.sv;
    for (std::uint32_t local = 0; local < mesh.patch_count(); ++local) {
      Patch& patch = patches[mesh.first_patch + local];
      patch = make_patch(scene, geometry, m, local);
      if (patch.dropped != 0) {
        ++statistics.patches_dropped;
        continue;
      }
      if (patch.thin != 0) ++statistics.patches_thin;
      ++statistics.patches;
      statistics.sub_patches += sub_patches;
    }
  }
  return {};
}

}  // namespace shodo
