// A triangle as the eye sees it (paper 2.4): edge functions, plane, and the rows of samples it can touch.
//
// With corners A, B, C relative to the eye, n_ab = A x B and so on, a direction D lies in the cone of the triangle if
// the three n.D have the sign of h = A.(B x C) = N.A. So there is no projection, and nothing is clipped where a
// triangle passes beside or behind the eye (homogeneous scan conversion, Olano and Greer 1997; deviation D10).
// Neighbours share n up to its sign.
//
// On an edge, n.D = 0, a sample counts as moved by a hair along +x, and by a hair of that along +y: it is inside if
// n.dx > 0, or n.dx = 0 and n.dy > 0. That is one point for all triangles, so a triangulated area holds it exactly
// once, in corners too. Everything is exact: n is below 2^41, n.D below 2^69, h below 2^61.
#pragma once

#include <cstdint>

#include "picture/view.h"
#include "visibility/geometry.h"

namespace shodo {

struct SeenTriangle {
  LatticeVector corner[3];  // from the eye
  LatticeVector edge[3];    // of corner k and k + 1; turned so that the inside is positive
  LatticeVector normal;     // sum of the edges: +-N, turned so that normal.D > 0 inside
  std::int64_t depth = 0;   // |N.A|, above 0; the inverse depth of D is normal.D / depth
  bool front = false;       // the eye is in front
};

/// False if the eye lies in the triangle's plane: nothing is seen of it then.
bool see_triangle(const DrawnTriangle& triangle, const LatticePoint& eye, SeenTriangle& seen);

/// The four planes through the eye and the outer samples of a picture, by normals that point inwards, cut to 30 bits.
class Frame {
 public:
  explicit Frame(const SampleGrid& grid);
  /// True only if no sample can be of the triangle: all its corners lie beyond one of the planes.
  bool leaves_out(const DrawnTriangle& triangle) const;

 private:
  LatticePoint eye_;
  LatticePoint inwards_[4];
};

/// Rows from `first` to `last` can hold samples of a triangle; none if first > last.
struct RowRange {
  std::int32_t first = 0;
  std::int32_t last = -1;
  bool empty() const { return first > last; }
};

/// Every row that holds a sample of the triangle is in the range; edges along rows hold exactly in it.
RowRange rows_of(const SeenTriangle& seen, const SampleGrid& grid);

/// True if `a` is to be seen before `b` where their depths are equal: front before back, then the smaller area, then
/// the lexicographically smaller sorted vertices, then the lower index in `drawn`.
bool wins_tie(std::span<const DrawnTriangle> drawn, std::uint32_t a, bool a_front, std::uint32_t b, bool b_front);

/// Whether `a` is nearer than `b` in the given direction, exactly, ties as above; both must be hit by it.
bool is_nearer(std::span<const DrawnTriangle> drawn, const LatticePoint& eye, const LatticeVector& direction,
               std::uint32_t a, std::uint32_t b);

}  // namespace shodo
