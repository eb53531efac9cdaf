#include "ambient/ray_places.h"

#include "light/piece_grid.h"

namespace shodo {

namespace {

/// Where in the unit square, in parts of its sides.
struct Part {
  std::uint32_t column, row;
};

/// Sobol's first sixteen points (1967): any four from a multiple of four on, and all sixteen, have one point in every
/// part of a square that is cut into so many, in columns, rows or squares. Bits of columns and rows are turned over
/// from sub-patch to sub-patch. So the mean of sixteen is the middle of their parts.
Part part_of(std::uint32_t k, std::uint32_t sub_patch) {
  static_assert(RayPlaces::kMost == 16);  // higher bits of k count for nothing
  const std::uint32_t turned = sub_patch * 0x9e3779b9;  // 2^32 / golden ratio
  const bool bit[4] = {(k & 1) != 0, (k & 2) != 0, (k & 4) != 0, (k & 8) != 0};
  const std::uint32_t column = bit[0] * 8u ^ bit[1] * 4u ^ bit[2] * 2u ^ bit[3] * 1u;
  const std::uint32_t row = bit[0] * 8u ^ bit[1] * 12u ^ bit[2] * 10u ^ bit[3] * 15u;
  return {column ^ turned >> 28, row ^ (turned >> 24 & 15)};
}

}  // namespace

void RayStarts::find(std::uint32_t local, std::uint32_t first, std::uint32_t count, RayPlaces& places) const {
  const Mesh& mesh = scene_.meshes[mesh_];
  const Piece piece = sub_patch_piece(scene_, mesh, local);
  const Vec3 area = piece.vector_area();
  places.count = 0;
  if (!(length_squared(area) > 0)) return;
  const bool triangle = piece.corners == 3, affine = PieceGrid(piece, 1).affine();
  const bool thin = is_thin(geometry_.lattice, piece);
  const double middle = triangle ? 1.0 / 3 : 0.5, within = triangle ? 0.25 : 0.5;  // not on a triangle's diagonal
  const Vec3 along_s = piece.corner[1] - piece.corner[0], along_t = piece.corner[triangle ? 2 : 3] - piece.corner[0];
  for (std::uint32_t k = 0; k < count; ++k) {
    const Part part = part_of(first + k, mesh.first_sub_patch + local);
    double s = (part.column + within) / RayPlaces::kMost, t = (part.row + within) / RayPlaces::kMost;
    if (triangle && s + t > 1) s = 1 - s, t = 1 - t;
    if (thin) s = 0.5 * (s + middle), t = 0.5 * (t + middle);
    const Vec3 at = affine ? piece.corner[0] + s * along_s + t * along_t : piece.point(s, t);
    places.from[k] = front_.flat() ? front_.move(odd_point(geometry_.lattice, at))
                                   : sample_point(scene_, geometry_, mesh_, cell_, at);
  }
  const std::uint32_t hidden = hidden_samples(intersector_, {places.from, count}, normalised(area));
  for (std::uint32_t k = 0; k < count; ++k) {
    if ((hidden >> k & 1) == 0) places.from[places.count++] = places.from[k];
  }
}

}  // namespace shodo
