// Fixed samples on a piece: the centres of k x k cells of a quadrilateral, the centroids of the k^2 triangles of a
// triangle, each with the share of the area for which it stands. No random numbers, so that a mirrored scene has
// mirrored samples and equal scenes equal ones.
#pragma once

#include <cstdint>

#include "scene/mesh.h"

namespace shodo {

class PieceGrid {
 public:
  /// A place on the piece, as Piece::point() takes it.
  struct Parameter {
    double s, t;
  };

  /// `middle_half`: all samples half as far from the centre (thin patches). The piece must outlive the grid.
  PieceGrid(const Piece& piece, std::uint32_t divisions, bool middle_half = false);

  /// A triangle or a parallelogram: all samples have weight 1.
  bool affine() const { return affine_; }
  std::uint32_t count() const { return divisions_ * divisions_; }
  Vec3 point(std::uint32_t sample) const;
  /// Elsewhere in the sample's cell of a quadrilateral: 0 .. 1 from the cell's corner along s and t.
  Vec3 point(std::uint32_t sample, Parameter in_cell) const;
  /// The sample's share of the area, up to a factor common to all: the Jacobian of the piece there, 1 if it is
  /// constant.
  double weight(std::uint32_t sample) const;
  /// The same at the centre.
  double centre_weight() const { return weight_at({0.5, 0.5}); }
  /// The samples next to the piece's corners: four, or three of a triangle.
  std::uint32_t corner_count() const { return piece_->corners; }
  std::uint32_t corner(std::uint32_t k) const;

  /// Point k < 4 of the 2 x 2 Gauss points of a quadrilateral, exact to the third degree; of a triangle the centroid
  /// and three points, exact to the second. Equal weights but for weight_at().
  Parameter gauss(std::uint32_t k) const;
  /// Point k of a rule exact to the fifth degree, and its weight but for weight_at(): 3 x 3 Gauss points of a
  /// quadrilateral, 7 of a triangle (Radon 1948).
  struct Weighted {
    Parameter at;
    double weight;
  };
  std::uint32_t fine_count() const { return piece_->corners == 3 ? 7 : 9; }
  Weighted fine(std::uint32_t k) const;
  Vec3 point_at(const Parameter& at) const;
  double weight_at(const Parameter& at) const;

 private:
  Parameter parameter(std::uint32_t sample) const;
  Parameter cell_place(std::uint32_t sample, Parameter in_cell) const;
  Parameter kept_in(Parameter at) const;

  const Piece* piece_;
  std::uint32_t divisions_;
  bool middle_half_;
  bool affine_ = false;  // a triangle or a parallelogram: corner 0, and two edges
  double cell_;
  Vec3 edge_s_, edge_t_;
  // Jacobian at corner 0 and its slopes along s and t; of a cut piece its values on the first and the second half.
  double jacobian_ = 1, along_s_ = 0, along_t_ = 0;
};

}  // namespace shodo
