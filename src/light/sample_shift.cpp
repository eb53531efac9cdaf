#include "light/sample_shift.h"

namespace shodo {

namespace {

/// A permutation of 32 bits in which each bit depends on all (found by C. Wellons, 2018, as lowbias32).
constexpr std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x7feb352d;
  x = (x ^ x >> 15) * 0x846ca68b;
  return x ^ x >> 16;
}

constexpr std::uint32_t without_sign(std::int32_t x) { return static_cast<std::uint32_t>(x < 0 ? -x : x); }

/// Of one axis: steps from the scene's centre, and half the edge's length along it.
constexpr std::uint32_t of_axis(std::int32_t place, std::int32_t edge) {
  return mixed(without_sign(place) * 0x9e3779b9 + without_sign(edge));
}

/// The same whichever way the edge runs and whatever the axes are called.
std::uint32_t of_edge(const LatticePoint& centre, const LatticePoint& edge) {
  return mixed(of_axis(centre.x, edge.x) + of_axis(centre.y, edge.y) + of_axis(centre.z, edge.z));
}

/// Cell `cell` of four along an edge, in row `row` of four: mirrored beyond the middle.
double in_cell_along(std::uint32_t shift, std::uint32_t cell, std::uint32_t row) {
  const std::uint32_t outside = cell < 2 ? cell : 3 - cell, row_outside = row < 2 ? row : 3 - row;
  const std::uint32_t half = (shift >> outside ^ row_outside) & 1;
  const double place = (128 * half + 2 * (shift >> 2 & 63) + 1) / 256.0;
  return cell < 2 ? place : 1 - place;
}

}  // namespace

SampleShift::SampleShift(const Lattice& lattice, const LatticePoint& centre, const Piece& piece) {
  const Vec3* c = piece.corner;
  along_s_ = of_edge(centre, even_point(lattice, 0.25 * ((c[1] - c[0]) + (c[2] - c[3]))));
  along_t_ = of_edge(centre, even_point(lattice, 0.25 * ((c[3] - c[0]) + (c[2] - c[1]))));
}

PieceGrid::Parameter SampleShift::in_cell(std::uint32_t sample) const {
  const std::uint32_t u = sample % 4, v = sample / 4;
  return {in_cell_along(along_s_, u, v), in_cell_along(along_t_, v, u)};
}

}  // namespace shodo
