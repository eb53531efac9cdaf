// The matrix of the ambient equations: rows kept or computed again, their sums made right (paper 2.2, 3.2; design:
// row sums).
//
// F_ij = f_i v_ij R_j with R = sqrt of the visible area, v_ij the stored symmetric value (ambient/row_store.h) and
// f_i = s_i / R_i. The row's scale s_i is found in the first pass, when row i's last entry is known, and is all that a
// row needs besides its entries: reciprocity of what is stored stays exact.
//
// Row sums (deviation D3). S is the sum of the stored F_ij, L the part of the hemisphere that area lights and
// openings fill. In a closed scene S + L = 1. The row is scaled to S = 1 - L if S + L > 1, or if it is below 1 by no
// more than its estimated error:
//     the tiers' errors added up + 3 standard errors of its mixed visible fractions, and of what blocks hand down
//     evenly though it varies over them (v d_i of ambient/block_link.h) + 2^-12 S (rounding of values)
//     + L / 64 (direct light samples its shadows) + S h / 8 if a part of the patch is hidden (its share is found twice,
//     by sub-patches and by segments), h = (1 - visible share) / visible share, at most 1.
// If rule 2 left a column out, rows are scaled down only (deviation D14): what is missing then is missing on purpose.
//
// Blocks. A link to a block stands for one to each patch in it, in proportion to their visible areas: with R_b^2 the
// sum of R_j^2 over its patches, F_ij = f_i v_ib R_j^2 / R_b, which for equal areas is rule 3's F_im / p. So a block
// has sums like a patch, and gives each of its parts c the share R_c / R_b of them. Bytes: 8 a node (f), one row of
// scratch, the coarse matrix, 1 + 1 a node with rules 1 and 2, the lists of ambient/link_walk.h, with `blocks` what
// ambient/block_link.h has, and the rows.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/block_link.h"
#include "ambient/coarse.h"
#include "ambient/link_walk.h"
#include "ambient/row_store.h"
#include "ambient/sparsity.h"
#include "ambient/surfaces.h"
#include "base/arena.h"
#include "light/direct.h"
#include "scene/patch_reflectance.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"

namespace shodo {

struct Matrix {
  explicit Matrix(Arena& arena) : stores{RowStore(arena), RowStore(arena), RowStore(arena), RowStore(arena),
                                         RowStore(arena), RowStore(arena)} {}

  Surfaces surfaces;
  const Options* options = nullptr;
  Sparsity sparsity;
  LinkWalk walk;
  BlockTools tools;
  RowStore stores[kGenerations];       // of each generation the first rows, as many as fit
  std::span<std::uint16_t> row_words;  // scratch: a row that isn't kept
  std::span<double> factor;            // f_i, by node; of no meaning for blocks
  Coarse coarse;
  double reflected[3] = {0, 0, 0};        // max over i of sum_j rho_j F_ij, by channel
  double reflected_upper[3] = {0, 0, 0};  // the same over j > i

  bool doubles() const { return options->row_value_bits == 64; }
  bool keeps(std::uint32_t generation, std::uint32_t i) const { return i < stores[generation].rows(); }
  std::uint8_t generations() const { return static_cast<std::uint8_t>(sparsity.now() + 1); }
  /// What a node adds to the sum of a row over v: R of the part of it that sends.
  double sending_root(std::uint32_t node) const {
    if (surfaces.is_block(node)) return surfaces.block(node).sending_root;
    return sparsity.sends(node) ? surfaces.root_area[node] : 0;
  }
};
static_assert(kGenerations == 6, "Matrix::Matrix");

/// Arrays that the solver needs later and the first pass may use until then; one value a node. All are zero at first;
/// with rule 2+ the errors must stay for later generations.
struct FirstPassScratch {
  std::span<double> geometry_errors;
  std::span<double> visibility_errors;
  std::span<double> reflected;  // [position * channels + c]; zeroed again when the pass is done
};

/// What build_matrix() needs besides rows; takes it after `matrix.surfaces` is filled, and judges rows and columns.
/// Errors: kMemory.
Status prepare_matrix(const DirectLight& direct, Arena& arena, Matrix& matrix);

/// Computes every row of the latest generation once, keeps what fits, finds the scales. Errors: kMemory, kInterrupted.
Status build_matrix(const DirectLight& direct, const Progress& progress, Intersector& intersector,
                    const FirstPassScratch& scratch, Matrix& matrix, Statistics& statistics);

/// Arena bytes of prepare_matrix and build_matrix without a single row kept.
std::uint64_t matrix_bytes(const Scene& scene, const Geometry& geometry, const Options& options);

/// Gives the rows of one generation from the first to the last.
class RowCursor {
 public:
  RowCursor() = default;
  RowCursor(const Matrix& matrix, std::uint8_t generation)
      : next_(matrix.stores[generation].first()), generation_(generation) {}

  /// Row i: call with 0, 1, 2 ...; valid until the next call of any cursor. A copy goes on from where it was copied.
  /// Segments of rows computed again are not counted: they were, the first time.
  const std::uint16_t* row(Matrix& matrix, Intersector& uncounted, std::uint32_t i);
  /// Instead of row(i).
  void skip(const Matrix& matrix, std::uint32_t i) {
    if (matrix.keeps(generation_, i)) next_ = RowStore::after(next_);
  }

 private:
  const std::uint16_t* next_ = nullptr;
  std::uint8_t generation_ = 0;
};

/// Follows ascending positions from mesh to mesh.
class MeshWalk {
 public:
  MeshWalk(const Surfaces& surfaces, std::uint32_t position) : surfaces_(&surfaces) { go_to(position); }
  /// True if the mesh is another than before. Positions ascend.
  bool go_to(std::uint32_t position) {
    if (position < end_) return false;
    while (position >= surfaces_->mesh_begin[place_ + 1]) ++place_;
    end_ = surfaces_->mesh_begin[place_ + 1];
    reflectance_ = MeshReflectance(*surfaces_->scene, surfaces_->mesh_at[place_]);
    return true;
  }
  std::uint32_t place() const { return place_; }  // in mesh_at
  /// Of a patch of the mesh, by channel; good until the next call.
  const double* reflectance(std::uint32_t position) const {
    const std::uint32_t first = surfaces_->scene->meshes[surfaces_->mesh_at[place_]].first_patch;
    return reflectance_.of(surfaces_->patch_at[position] - first, room_);
  }
  /// At least that of any of its patches.
  const double* most_reflectance() const { return reflectance_.most(room_); }

 private:
  const Surfaces* surfaces_;
  std::uint32_t place_ = 0;
  std::uint32_t end_ = 0;
  MeshReflectance reflectance_;
  mutable double room_[3] = {0, 0, 0};
};

}  // namespace shodo
