// Fixed samples on a piece: the centres of k x k cells of a quadrilateral, the centroids of the k^2 triangles of a
// triangle, each with the share of the area for which it stands. No random numbers, so that a mirrored scene has
// mirrored samples and equal scenes equal ones.
#pragma once

#include <cstdint>

#include "scene/mesh.h"

namespace shodo {

class PieceGrid {
 public:
  /// `middle_half`: all samples half as far from the centre (thin patches). The piece must outlive the grid.
  PieceGrid(const Piece& piece, std::uint32_t divisions, bool middle_half = false);

  std::uint32_t count() const { return divisions_ * divisions_; }
  Vec3 point(std::uint32_t sample) const;
  /// The sample's share of the area, up to a factor common to all: the Jacobian of the piece there, 1 if it is
  /// constant.
  double weight(std::uint32_t sample) const;
  /// The same at the centre.
  double centre_weight() const { return weight_at({0.5, 0.5}); }
  /// The samples next to the piece's corners: four, or three of a triangle.
  std::uint32_t corner_count() const { return piece_->corners; }
  std::uint32_t corner(std::uint32_t k) const;

 private:
  struct Parameter {
    double s, t;
  };
  Parameter parameter(std::uint32_t sample) const;
  double weight_at(const Parameter& at) const;

  const Piece* piece_;
  std::uint32_t divisions_;
  bool middle_half_;
  // Jacobian at corner 0 and its slopes along s and t; of a cut piece its values on the first and the second half.
  double jacobian_ = 1, along_s_ = 0, along_t_ = 0;
};

}  // namespace shodo
