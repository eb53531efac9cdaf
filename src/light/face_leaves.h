// Where segments to an area light end that is near (light/face_light.cpp): the leaves of a quadtree over it, cells that
// are small against their distance. A long light is cut into squares first, nearly, each of which is a tree.
// Approximate: a leaf is tested at its middle. 150 bytes of stack, no memory.
#pragma once

#include <cstdint>

#include "light/piece_grid.h"
#include "light/quad_cell.h"
#include "scene/mesh.h"

namespace shodo {

class FaceLeaves {
 public:
  /// `radius`: of the face; `from`: the sub-patch's middle, `from_radius` its radius. Piece and grid must outlive it.
  FaceLeaves(const Piece& piece, const PieceGrid& grid, double radius, const Vec3& from, double from_radius);

  PieceGrid::Parameter centre() const { return centre_; }
  /// Share of the face's area, up to a factor common to the leaves.
  double weight() const { return grid_->weight_at(centre_) * cell_.size() * cell_.size(); }
  /// Tree by tree, in Z order; false after the last.
  bool next();

 private:
  void descend();

  const PieceGrid* grid_;
  Vec3 from_;
  double from_radius_;
  double radius_;  // of a tree
  std::uint32_t trees_s_ = 1, trees_t_ = 1, tree_ = 0;
  QuadCell cell_;
  PieceGrid::Parameter centre_{0.5, 0.5};
};

}  // namespace shodo
