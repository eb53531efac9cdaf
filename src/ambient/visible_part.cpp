#include "ambient/visible_part.h"

#include "light/piece_grid.h"
#include "visibility/hidden.h"

namespace shodo {

namespace {

constexpr std::uint32_t kPoints = 16;
static_assert(kPoints <= kMostHiddenSamples);

/// Where in the unit square, in parts of its sides.
struct Part {
  std::uint32_t column, row;
};

/// One in every part of a square that is cut into 16, in columns, rows or squares.
Part part_of(std::uint32_t k, std::uint32_t sub_patch) {
  const std::uint32_t turned = sub_patch * 0x9e3779b9;  // 2^32 / golden ratio
  const bool bit[4] = {(k & 1) != 0, (k & 2) != 0, (k & 4) != 0, (k & 8) != 0};
  const std::uint32_t column = bit[0] * 8u ^ bit[1] * 4u ^ bit[2] * 2u ^ bit[3] * 1u;
  const std::uint32_t row = bit[0] * 8u ^ bit[1] * 12u ^ bit[2] * 10u ^ bit[3] * 15u;
  return {column ^ turned >> 28, row ^ (turned >> 24 & 15)};
}

}  // namespace

std::uint32_t visible_sixteenths(const Scene& scene, const Geometry& geometry, Intersector& intersector,
                                 std::uint32_t m, std::uint32_t local) {
  const Mesh& mesh = scene.meshes[m];
  const std::uint32_t cell = cell_of_patch(mesh, patch_of_sub_patch(mesh, local));
  const Piece piece = sub_patch_piece(scene, mesh, local);
  const Vec3 area = piece.vector_area();
  if (!(length_squared(area) > 0)) return kPoints;
  const bool triangle = piece.corners == 3, thin = is_thin(geometry.lattice, piece);
  const double middle = triangle ? 1.0 / 3 : 0.5, within = triangle ? 0.25 : 0.5;  // not on a triangle's diagonal
  LatticePoint from[kPoints];
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    const Part part = part_of(k, mesh.first_sub_patch + local);
    double s = (part.column + within) / kPoints, t = (part.row + within) / kPoints;
    if (triangle && s + t > 1) s = 1 - s, t = 1 - t;
    if (thin) s = 0.5 * (s + middle), t = 0.5 * (t + middle);
    from[k] = sample_point(scene, geometry, m, cell, piece.point(s, t));
  }
  std::uint32_t hidden = hidden_samples(intersector, from, normalised(area)), visible = kPoints;
  for (; hidden != 0; hidden &= hidden - 1) --visible;
  return visible;
}

}  // namespace shodo
