// The matrix of the ambient equations: rows kept or computed again, their sums made right (paper 2.2, 3.2; design:
// row sums).
//
// F_ij = f_i v_ij R_j with R = sqrt of the visible area, v_ij the stored symmetric value (ambient/row_store.h) and
// f_i = s_i / R_i. The row's scale s_i is found in the first pass, when row i's last entry is known, and is all that a
// row needs besides its entries: reciprocity of what is stored stays exact.
//
// Row sums. S is the sum of the stored F_ij, L the part of the hemisphere that area lights and openings fill. In a
// closed scene S + L = 1. The row is scaled to S = 1 - L if S + L > 1, or if it is below 1 by no more than its
// estimated error:
//     the tiers' errors added up + 3 standard errors of its mixed visible fractions + 2^-12 S (rounding of values)
//     + L / 64 (direct light samples its shadows) + S h / 8 if a part of the patch is hidden (its share is found twice,
//     by sub-patches and by segments), h = (1 - visible share) / visible share, at most 1.
// Bytes: 8 a patch (f), one row of scratch, the coarse matrix, and the rows.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/coarse.h"
#include "ambient/row_store.h"
#include "ambient/surfaces.h"
#include "base/arena.h"
#include "light/direct.h"
#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"

namespace shodo {

struct Matrix {
  explicit Matrix(Arena& arena) : store(arena, 0) {}

  Surfaces surfaces;
  const Options* options = nullptr;
  RowStore store;
  std::span<std::uint16_t> row_words;  // scratch: a row that isn't kept
  std::span<double> factor;            // f_i, by position
  Coarse coarse;
  double reflected[3] = {0, 0, 0};        // max over i of sum_j rho_j F_ij, by channel
  double reflected_upper[3] = {0, 0, 0};  // the same over j > i

  bool doubles() const { return options->row_value_bits == 64; }
};

/// Arrays that the solver needs later and the first pass may use until then; one value a patch, by position.
struct FirstPassScratch {
  std::span<double> geometry_errors;
  std::span<double> visibility_errors;
  std::span<double> reflected;  // [position * channels + c]; zeroed again when the pass is done
};

/// Computes every row once, keeps what fits, finds the scales. `matrix.surfaces` is filled. Errors: kMemory,
/// kInterrupted.
Status build_matrix(const DirectLight& direct, const Progress& progress, Arena& arena, Intersector& intersector,
                    const FirstPassScratch& scratch, Matrix& matrix, Statistics& statistics);

/// Arena bytes of build_matrix without a single row kept.
std::uint64_t matrix_bytes(const Scene& scene, const Options& options);

/// Gives the rows from the first to the last, once.
class RowCursor {
 public:
  /// Segments of rows computed again are not counted: they were, the first time.
  RowCursor(Matrix& matrix, const Intersector& intersector)
      : matrix_(&matrix), intersector_(intersector), next_(matrix.store.first()) {}

  /// Row i: call with 0, 1, 2 ...; valid until the next call.
  const std::uint16_t* row(std::uint32_t i);

 private:
  Matrix* matrix_;
  Intersector intersector_;
  const std::uint16_t* next_;
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
    return true;
  }
  std::uint32_t place() const { return place_; }  // in mesh_at
  /// Reflectance of the mesh, by channel.
  const double* reflectance() const {
    const Scene& scene = *surfaces_->scene;
    return scene.materials[scene.meshes[surfaces_->mesh_at[place_]].material].diffuse.c;
  }

 private:
  const Surfaces* surfaces_;
  std::uint32_t place_ = 0;
  std::uint32_t end_ = 0;
};

}  // namespace shodo
