// The geometry of a mesh's pieces: cells (polygons of the file), patches and sub-patches (paper 2.1, 2.3).
//
// A piece is three or four corners. Points of a convex quadrilateral are bilinear in (s, t); a concave one is cut on
// its valid diagonal and affine on both halves, since bilinear points would leave it. Such a quadrilateral has equal
// counts along u and v: then the cut runs through corners of its pieces, and every piece lies inside; with others,
// pieces on the cut could cross themselves. The vector areas of the pieces always add up to the whole.
//
// Order: patches and sub-patches of a quad or grid run row by row, v slowest; row v of a triangle divided k times has
// 2 (k - v) - 1 pieces, upright and inverted by turns, and starts at v (2 k - v).
#pragma once

#include <cstdint>

#include "base/vector.h"
#include "scene/scene.h"

namespace shodo {

/// A cell, a patch or a sub-patch.
struct Piece {
  Vec3 corner[4];             // in front's counter-clockwise order; corner[3] == corner[2] for a triangle
  features::FixedUnless<features::kMeshes, std::uint32_t, 4> corners = 4;  // 3 or 4
  features::FixedUnless<features::kMeshes, bool, false> concave = false;   // cut from corner 1 to corner 3
  /// Not convex: cut from corner 1 to corner 3 if concave, else from corner 0 to corner 2.
  features::FixedUnless<features::kMeshes, bool, false> cut = false;

  /// Point at (s, t) of the unit square: corner 0 at (0,0), 1 at (1,0), 2 at (1,1), 3 at (0,1) for a quadrilateral;
  /// for a triangle corner 0 + s (corner 1 - corner 0) + t (corner 2 - corner 0), s + t <= 1.
  Vec3 point(double s, double t) const;
  Vec3 centre() const;
  /// Half the cross product of the diagonals (of two edges for a triangle): area times mean unit normal.
  Vec3 vector_area() const;
  double longest_side() const;
};

/// Where a patch or sub-patch lies in its mesh: column, row, and for a triangle whether it stands on its tip.
struct PieceIndex {
  std::uint32_t u = 0, v = 0;
  bool inverted = false;
};

/// `k` divisions of a triangle's edge; `local` < k^2.
PieceIndex triangle_piece(std::uint32_t k, std::uint32_t local);
/// Inverse of triangle_piece.
std::uint32_t triangle_piece_order(std::uint32_t k, const PieceIndex& index);

/// `local` counts from the mesh's first patch / sub-patch.
PieceIndex patch_index(const Mesh& mesh, std::uint32_t local);
PieceIndex sub_patch_index(const Mesh& mesh, std::uint32_t local);
Piece patch_piece(const Scene& scene, const Mesh& mesh, std::uint32_t local);
Piece sub_patch_piece(const Scene& scene, const Mesh& mesh, std::uint32_t local);
/// The patch (counted from the mesh's first) that holds a sub-patch (same).
std::uint32_t patch_of_sub_patch(const Mesh& mesh, std::uint32_t local_sub_patch);

/// Cells are the polygons of the file: 1 for a quad or a triangle, cells_u * cells_v of a grid, row by row.
std::uint32_t cell_count(const Mesh& mesh);
Piece cell_piece(const Scene& scene, const Mesh& mesh, std::uint32_t cell);
/// The cell that holds a patch; a patch never spans two.
std::uint32_t cell_of_patch(const Mesh& mesh, std::uint32_t local_patch);

/// A plane as one piece, and its sub-patch `local`, row by row from corner 0, u along its first edge.
Piece plane_piece(const Plane& plane);
Piece plane_sub_patch(const Plane& plane, std::uint32_t local);

/// What light and ambient stages need of a patch; 72 bytes each.
struct Patch {
  Vec3 centre;
  Vec3 normal;              // unit; zero if the patch has no area
  double area = 0;          // scene units squared
  double longest_side = 0;  // scene units
  std::uint32_t mesh = 0;
  std::uint16_t dropped = 0;  // 1: too thin to send or receive (under 4 lattice steps, or no area), blocks only
  std::uint16_t thin = 0;     // 1: under 32 lattice steps wide: samples of its middle half only
};

}  // namespace shodo
