// The sub-patches of one patch, in their order.
#pragma once

#include <cstdint>

#include "scene/mesh.h"

namespace shodo {

/// Sub-patches of a patch, counted from the mesh's first; ascending. A triangle's patch has su^2, others su sv.
class SubPatchesOfPatch {
 public:
  SubPatchesOfPatch(const Mesh& mesh, std::uint32_t local_patch)
      : mesh_(&mesh), patch_(patch_index(mesh, local_patch)) {}

  /// The next one, or kNone after the last.
  std::uint32_t next() {
    if (mesh_->kind != MeshKind::kTriangle) {
      if (k_ == mesh_->su * mesh_->sv) return kNone;
      column_ = k_ % mesh_->su;
      row_ = k_ / mesh_->su;
      const std::uint32_t u = patch_.u * mesh_->su + column_, v = patch_.v * mesh_->sv + row_;
      ++k_;
      return v * mesh_->map_width() + u;
    }
    // The parallelogram of an upright and an inverted patch holds 2 su^2; they share it along the diagonal.
    const std::uint32_t n = mesh_->su;
    while (k_ < 2 * n * n) {
      const std::uint32_t tip = k_ % 2, u = k_ / 2 % n, v = k_ / 2 / n;
      ++k_;
      if ((u + v + tip >= n) != patch_.inverted) continue;
      return triangle_piece_order(mesh_->map_width(), {patch_.u * n + u, patch_.v * n + v, tip == 1});
    }
    return kNone;
  }
  /// Of the last one in its patch, on a quadrilateral.
  std::uint32_t column() const { return column_; }
  std::uint32_t row() const { return row_; }

 private:
  const Mesh* mesh_;
  PieceIndex patch_;
  std::uint32_t k_ = 0, column_ = 0, row_ = 0;
};

}  // namespace shodo
