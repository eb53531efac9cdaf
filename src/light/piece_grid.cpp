#include "light/piece_grid.h"

#include "base/quadrature.h"

namespace shodo {

namespace {

/// Slopes of the Jacobian below this share of it are rounding: a parallelogram's samples have weight 1 exactly.
constexpr double kConstant = 0x1p-30;
constexpr double kGaussLow = 0.21132486540518713;  // (1 - 1 / sqrt 3) / 2

bool constant(double a, double b) {
  const double difference = a < b ? b - a : a - b;
  return difference <= kConstant * (a < 0 ? -a : a);
}

}  // namespace

PieceGrid::PieceGrid(const Piece& piece, std::uint32_t divisions, bool middle_half)
    : piece_(&piece), divisions_(divisions), middle_half_(middle_half), cell_(1.0 / divisions) {
  const Vec3* c = piece.corner;
  edge_s_ = c[1] - c[0];
  edge_t_ = piece.corners == 3 ? c[2] - c[0] : c[3] - c[0];
  affine_ = piece.corners == 3;
  if (piece.corners == 3) return;
  const Vec3 normal = normalised(piece.vector_area());
  const double at_0 = dot(cross(c[1] - c[0], c[3] - c[0]), normal);
  if (piece.concave || piece.cut) {
    jacobian_ = piece.concave ? at_0 : dot(cross(c[1] - c[0], c[2] - c[1]), normal);
    along_s_ = dot(cross(c[3] - c[2], piece.concave ? c[1] - c[2] : c[0] - c[3]), normal);
    return;
  }
  const double at_1 = dot(cross(c[1] - c[0], c[2] - c[1]), normal);
  const double at_3 = dot(cross(c[2] - c[3], c[3] - c[0]), normal);
  if (constant(at_0, at_1) && constant(at_0, at_3)) {
    affine_ = true;
    return;
  }
  jacobian_ = at_0;
  along_s_ = at_1 - at_0;
  along_t_ = at_3 - at_0;
}

PieceGrid::Parameter PieceGrid::parameter(std::uint32_t sample) const {
  const double cell = cell_;
  Parameter at;
  if (piece_->corners == 3) {
    const PieceIndex index = triangle_piece(divisions_, sample);
    const double inside = index.inverted ? 2.0 / 3 : 1.0 / 3;
    at = {cell * (index.u + inside), cell * (index.v + inside)};
  } else {
    at = cell_place(sample, {0.5, 0.5});
  }
  return kept_in(at);
}

PieceGrid::Parameter PieceGrid::cell_place(std::uint32_t sample, Parameter in_cell) const {
  return {cell_ * (sample % divisions_ + in_cell.s), cell_ * (sample / divisions_ + in_cell.t)};
}

/// Half as far from the centre if only the middle half is used.
PieceGrid::Parameter PieceGrid::kept_in(Parameter at) const {
  if (!middle_half_) return at;
  const double middle = piece_->corners == 3 ? 1.0 / 3 : 0.5;
  return {middle + 0.5 * (at.s - middle), middle + 0.5 * (at.t - middle)};
}

PieceGrid::Parameter PieceGrid::gauss(std::uint32_t k) const {
  if (piece_->corners == 3) {
    if (k == 0) return {1.0 / 3, 1.0 / 3};
    return kept_in({k == 2 ? 1 - 2 * kInner : kInner, k == 3 ? 1 - 2 * kInner : kInner});
  }
  return kept_in({(k & 1) == 0 ? kGaussLow : 1 - kGaussLow, (k >> 1) == 0 ? kGaussLow : 1 - kGaussLow});
}

PieceGrid::Weighted PieceGrid::fine(std::uint32_t k) const {
  if (piece_->corners == 3) {
    if (k == 0) return {{1.0 / 3, 1.0 / 3}, kRadonCentreWeight};
    const double t = k < 4 ? kRadonNear : kRadonFar;
    const std::uint32_t tip = (k - 1) % 3;
    return {kept_in({tip == 1 ? 1 - 2 * t : t, tip == 2 ? 1 - 2 * t : t}), k < 4 ? kRadonNearWeight : kRadonFarWeight};
  }
  constexpr double kPlace[3] = {0.11270166537925831, 0.5, 0.88729833462074169};  // 1/2 -+ sqrt(3/5) / 2
  constexpr double kWeight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  return {kept_in({kPlace[k % 3], kPlace[k / 3]}), kWeight[k % 3] * kWeight[k / 3]};
}

Vec3 PieceGrid::point(std::uint32_t sample) const {
  const Parameter at = parameter(sample);
  return point_at(at);
}

Vec3 PieceGrid::point(std::uint32_t sample, Parameter in_cell) const {
  return point_at(kept_in(cell_place(sample, in_cell)));
}

Vec3 PieceGrid::point_at(const Parameter& at) const {
  if (!affine_) return piece_->point(at.s, at.t);
  return piece_->corner[0] + at.s * edge_s_ + at.t * edge_t_;
}

double PieceGrid::weight(std::uint32_t sample) const { return affine_ ? 1 : weight_at(parameter(sample)); }

double PieceGrid::weight_at(const Parameter& at) const {
  if (affine_) return 1;
  if (!(piece_->concave || piece_->cut) || piece_->corners == 3) return jacobian_ + at.s * along_s_ + at.t * along_t_;
  // Positive in the first half: 0-1-3 where the cut runs from 1 to 3, else 0-1-2. Samples on the cut belong to both.
  const double side = piece_->concave ? 1 - (at.s + at.t) : at.s - at.t;
  return side > 0 ? jacobian_ : side < 0 ? along_s_ : 0.5 * (jacobian_ + along_s_);
}

std::uint32_t PieceGrid::corner(std::uint32_t k) const {
  const std::uint32_t last = divisions_ - 1;
  if (piece_->corners == 3) return k == 0 ? 0 : k == 1 ? 2 * last : count() - 1;
  return (k & 1) * last + (k >> 1) * last * divisions_;
}

}  // namespace shodo
