// For tests of the ambient stage: a scene from text, placed on the lattice, with direct light that the test sets.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "ambient/ambient_memory.h"
#include "ambient/gauss_seidel.h"
#include "ambient/matrix.h"
#include "support/ambient_stage.h"
#include "support/scene_from_text.h"
#include "visibility/geometry.h"

namespace shodo {

/// The six walls of the box from 0 to (x, y, z), z up, fronts inside; patches nx, ny, nz along the axes.
/// Order: floor, ceiling, wall y = 0, wall y = y, wall x = 0, wall x = x.
inline std::string box_walls(double x, double y, double z, int nx, int ny, int nz, const std::string& material) {
  const auto quad = [&](std::initializer_list<double> c, int u, int v) {
    std::string line = "quad " + material;
    for (const double value : c) line += " " + std::to_string(value);
    return line + " patches " + std::to_string(u) + " " + std::to_string(v) + " sub 1 1\n";
  };
  std::string text;
  text += "object floor_\n" + quad({0, 0, 0, x, 0, 0, x, y, 0, 0, y, 0}, nx, ny);
  text += "object ceiling_\n" + quad({0, 0, z, 0, y, z, x, y, z, x, 0, z}, ny, nx);
  text += "object wall_y0\n" + quad({0, 0, 0, 0, 0, z, x, 0, z, x, 0, 0}, nz, nx);
  text += "object wall_y1\n" + quad({0, y, 0, x, y, 0, x, y, z, 0, y, z}, nx, nz);
  text += "object wall_x0\n" + quad({0, 0, 0, 0, y, 0, 0, y, z, 0, 0, z}, ny, nz);
  text += "object wall_x1\n" + quad({x, 0, 0, x, 0, z, x, y, z, x, y, 0}, nz, ny);
  return text;
}

inline std::string grey(double rho) {
  return "shodo 1\nmaterial white diffuse " + std::to_string(rho) + "\n";
}

/// A placed scene, unlit.
struct AmbientScene {
  explicit AmbientScene(const std::string& text, Options given = {}, TestFiles files = {})
      : options(given), loaded(text, given, std::move(files)) {
    Status status = place_scene(loaded.scene, loaded.arena, geometry);
    EXPECT_TRUE(status.done()) << to_text(status);
    status = build_patches(loaded.scene, geometry, loaded.arena, patches, statistics);
    EXPECT_TRUE(status.done()) << to_text(status);
    const std::size_t n = patches.size();
    lux.assign(n * loaded.scene.channels, 0.0);
    visible.assign(n, 1.0f);
    lights.assign(n, 0.0f);
    direct.patch_lx = lux;
    direct.visible_area = visible;
    direct.light_form_factor = lights;
  }

  /// E0 of every patch, all channels, by its centre in the file's coordinates and its mesh.
  void light(const std::function<double(const Vec3&, std::uint32_t mesh)>& e0) {
    const std::uint32_t channels = loaded.scene.channels;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      for (std::uint32_t c = 0; c < channels; ++c) {
        lux[i * channels + c] = e0(patches[i].centre + loaded.scene.origin, patches[i].mesh);
      }
    }
  }

  Status solve() { return solve_in(loaded.arena, {}); }
  Status solve_in(Arena& arena, const Progress& progress) {
    Intersector intersector(geometry);
    statistics = {};
    return light_ambiently(loaded.scene, geometry, patches, direct, intersector, options, progress, arena, ambient,
                           statistics);
  }

  double total(std::size_t value) const { return lux[value] + ambient.patch_lx[value]; }
  /// The mean of E over all patches, by area; first channel.
  double mean(bool ambient_only) const {
    double sum = 0, area = 0;
    const std::uint32_t channels = loaded.scene.channels;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      sum += patches[i].area * (ambient_only ? ambient.patch_lx[i * channels] : total(i * channels));
      area += patches[i].area;
    }
    return sum / area;
  }

  Options options;
  LoadedScene loaded;
  Geometry geometry;
  std::span<Patch> patches;
  DirectLight direct;
  AmbientLight ambient;
  Statistics statistics;
  std::vector<double> lux;
  std::vector<float> visible, lights;
};

/// In the scene's arena.
inline Surfaces surfaces_of(AmbientScene& scene) {
  Surfaces surfaces;
  EXPECT_TRUE(gather_surfaces(scene.loaded.scene, scene.geometry, scene.patches, scene.direct, scene.options,
                              scene.loaded.arena, surfaces)
                  .done());
  return surfaces;
}

/// Solves a scene with room for all rows, then in the smallest memory and in so many bytes `more`: rows that are
/// computed again give the bits of rows kept. `also(tight, arena, more)` checks each solution further.
template <class Light, class Also>
void expect_same_bits_in_any_memory(const std::string& text, const Options& options, Light e0,
                                    std::initializer_list<std::uint64_t> mores, Also also) {
  AmbientScene kept(text, options);
  kept.light(e0);
  ASSERT_TRUE(kept.solve().done());
  EXPECT_EQ(kept.statistics.rows_recomputed, 0u);
  const std::uint64_t least = smallest_ambient_bytes(kept.loaded.scene, kept.geometry, options);
  for (const std::uint64_t more : mores) {
    std::vector<std::uint64_t> memory((least + more) / 8);
    Arena arena(memory.data(), memory.size() * 8);
    AmbientScene tight(text, options);
    tight.light(e0);
    ASSERT_TRUE(tight.solve_in(arena, {}).done()) << more;
    EXPECT_GT(tight.statistics.rows_recomputed, 0u);
    EXPECT_EQ(tight.statistics.rows_recomputed + tight.statistics.rows_kept, kept.statistics.rows_kept);
    EXPECT_EQ(tight.statistics.segments_ambient, kept.statistics.segments_ambient);
    EXPECT_EQ(tight.statistics.sweeps, kept.statistics.sweeps);
    EXPECT_TRUE(std::ranges::equal(tight.ambient.patch_lx, kept.ambient.patch_lx));
    also(tight, arena, more);
  }
  std::vector<std::uint64_t> memory(least / 8 - 1);
  Arena arena(memory.data(), memory.size() * 8);
  EXPECT_EQ(kept.solve_in(arena, {}).code, StatusCode::kMemory);
}

/// The stored matrix of a scene, rows all kept, as full tables by patch; links of blocks are spread to their patches.
struct StoredMatrix {
  explicit StoredMatrix(AmbientScene& scene) : n(scene.patches.size()), matrix(scene.loaded.arena) {
    Arena& arena = scene.loaded.arena;
    matrix.options = &scene.options;
    std::span<double> scratch[3];
    matrix.surfaces = surfaces_of(scene);
    EXPECT_TRUE(prepare_matrix(scene.direct, arena, matrix).done());
    const std::size_t nodes = matrix.surfaces.size();
    const std::size_t sizes[3] = {nodes, nodes, nodes * scene.loaded.scene.channels};
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(arena.take("scratch", sizes[k], scratch[k]));
    Intersector intersector(scene.geometry);
    scene.statistics = {};
    const FirstPassScratch first{scratch[0], scratch[1], scratch[2]};
    // The columns that rule 2+ put back, by the solution that the scene has: as the stage itself goes on.
    do {
      EXPECT_TRUE(build_matrix(scene.direct, {}, intersector, first, matrix, scene.statistics).done());
    } while (scene.options.rules.rule2_repeated && !scene.ambient.patch_lx.empty() &&
             matrix.sparsity.restore(matrix.surfaces, scene.direct, scene.ambient.patch_lx));
    for (std::uint8_t g = 0; g < matrix.generations(); ++g) EXPECT_EQ(matrix.stores[g].rows(), nodes);
    fill(intersector);
  }

  double form_factor(std::size_t i, std::size_t j) const { return f[i * n + j]; }
  double row_sum(std::size_t i) const {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += f[i * n + j];
    return sum;
  }
  /// The patches of a node.
  std::vector<std::uint32_t> patches_of(std::uint32_t node) const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t k = node; k < matrix.surfaces.end(node); ++k) {
      if (!matrix.surfaces.is_block(k)) all.push_back(matrix.surfaces.patch_at[k]);
    }
    return all;
  }

  std::size_t n;
  Matrix matrix;
  std::vector<double> f;         // F_ij, scaled; 0 where a rule emptied row or column
  std::vector<double> exchange;  // G_ij V_ij as stored, symmetric
  std::vector<int> covered;      // links that cover a pair

 private:
  void put(std::uint32_t a, std::uint32_t b, double v) {
    const Surfaces& s = matrix.surfaces;
    for (std::uint32_t k = a; k < s.end(a); ++k) {
      for (std::uint32_t l = b; l < s.end(b); ++l) {
        if (s.is_block(k) || s.is_block(l)) continue;
        const double ri = s.root_area[k], rj = s.root_area[l];
        const double of_pair = v * ri * rj / (s.root_area[a] * s.root_area[b]);
        const std::size_t i = s.patch_at[k], j = s.patch_at[l];
        ++covered[i * n + j];
        ++covered[j * n + i];
        exchange[i * n + j] = exchange[j * n + i] = of_pair * ri * rj;
        f[i * n + j] = matrix.sparsity.sends(l) ? matrix.factor[k] * of_pair * rj : 0;
        f[j * n + i] = matrix.sparsity.sends(k) ? matrix.factor[l] * of_pair * ri : 0;
      }
    }
  }
  void fill(const Intersector& intersector) {
    f.assign(n * n, 0);
    exchange.assign(n * n, 0);
    covered.assign(n * n, 0);
    Intersector uncounted(intersector);
    for (std::uint8_t g = 0; g < matrix.generations(); ++g) {
      RowCursor rows(matrix, g);
      for (std::uint32_t i = 0; i < matrix.surfaces.size(); ++i) {
        const std::uint16_t* row = rows.row(matrix, uncounted, i);
        for (RowReader<RowFormat::kEither> e(row, i, matrix.doubles()); e.next();) put(i, e.column(), e.value());
      }
    }
  }
};

}  // namespace shodo
