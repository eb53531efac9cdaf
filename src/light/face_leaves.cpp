#include "light/face_leaves.h"

namespace shodo {

namespace {

/// A cell is split until its radius is this part of its distance, or of the sub-patch's radius.
constexpr double kLeafAngle = 0.35;
constexpr double kLeafOfRadius = 0.25;
constexpr std::uint32_t kDeepestLeaf = 6;
/// A light so many times as long as wide has more trees than one.
constexpr double kLong = 1.5;
constexpr double kMostTrees = 64;

std::uint32_t trees(double longer, double shorter) {
  return static_cast<std::uint32_t>(longer > kMostTrees * shorter ? kMostTrees : longer / shorter + 0.5);
}

}  // namespace

FaceLeaves::FaceLeaves(const Piece& piece, const PieceGrid& grid, double radius, const Vec3& from, double from_radius)
    : grid_(&grid), from_(from), from_radius_(from_radius), radius_(radius) {
  const double side_s = length(piece.corner[1] - piece.corner[0]), side_t = length(piece.corner[3] - piece.corner[0]);
  if (!piece.cut && side_s > kLong * side_t) trees_s_ = trees(side_s, side_t);
  if (!piece.cut && side_t > kLong * side_s) trees_t_ = trees(side_t, side_s);
  if (trees_s_ * trees_t_ > 1) radius_ = 0.5 * (side_s / trees_s_ + side_t / trees_t_);
  descend();
}

bool FaceLeaves::next() {
  if (!cell_.advance()) {
    if (++tree_ == trees_s_ * trees_t_) return false;
    cell_ = {};
  }
  descend();
  return true;
}

void FaceLeaves::descend() {
  for (;;) {
    const double size = cell_.size();
    centre_ = {size * (cell_.x + 0.5), size * (cell_.y + 0.5)};
    if (trees_s_ > 1) centre_.s = (tree_ + centre_.s) / trees_s_;
    if (trees_t_ > 1) centre_.t = (tree_ + centre_.t) / trees_t_;
    const double radius = radius_ * size;
    const double squared = length_squared(grid_->point_at(centre_) - from_);
    const bool small = radius * radius <= kLeafAngle * kLeafAngle * squared || radius < kLeafOfRadius * from_radius_;
    if (small || cell_.depth == kDeepestLeaf) return;
    cell_.descend();
  }
}

}  // namespace shodo
