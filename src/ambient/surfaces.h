// What the ambient stage knows of every patch before it looks at pairs.
//
// Patches are numbered here by their *position*: meshes in an order that geometry alone decides (by their vertices, not
// by their place in the file), each mesh's patches in their own order. So sums run in the same order, and give the
// same bits, whatever the order of objects in the file. Columns of the rows are positions too.
//
// With rule 3 or blocks a mesh that can be taken as a whole is a tree (ambient/block_tree.h), and positions number its
// *nodes*: a block comes before what is in it, a mesh's patches stand in the order of its tree. A block is looked at
// as one large patch: it has a centre, a normal, an area, a shape and samples. Without blocks a node is a patch.
// Bytes: 16 + 12 P a node (P samples, 1 or 4) + 96 a shape + 9 a mesh (33 with flags and without `blocks`) + 128 a
// block, which has a shape of its own.
//
// With little memory the *geometry* of nodes (patch, shape, samples) isn't kept: it is found again, to the same bits,
// when it is asked for, and the last kFoundNodes that were stay at hand. A reference to a node's geometry is then good
// until so many others have been looked at. Bytes: 12 a node + 32 a block + 9 or 33 a mesh + 3,712.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/block_tree.h"
#include "ambient/patch_shape.h"
#include "ambient/sample_set.h"
#include "base/arena.h"
#include "light/direct.h"
#include "scene/patch_reflectance.h"
#include "shodo/options.h"
#include "visibility/geometry.h"
#include "visibility/lattice_box.h"

namespace shodo {

/// Where a node lies and how it looks.
struct NodeGeometry {
  Patch patch;
  PatchShape shape;
  LatticePoint samples[4];  // points of Surfaces::cached_set
};

inline constexpr std::uint32_t kFoundNodes = 16;

/// A node's geometry that was found again.
struct FoundNode {
  NodeGeometry geometry;
  std::uint32_t position = kNone;
  std::uint64_t used = 0;  // the later, the larger
};
static_assert(sizeof(FoundNode) <= 232, "memory_plan.cpp");  // less where doubles stand on 4 bytes

struct Surfaces {
  const Scene* scene = nullptr;
  const Geometry* geometry = nullptr;
  std::span<const Patch> patches;        // none: found again too

  std::span<std::uint32_t> mesh_at;      // order of meshes
  std::span<std::uint32_t> mesh_begin;   // first position of mesh_at[k]; one more at the end
  std::span<std::uint8_t> planar;        // of mesh_at[k]: all its patches lie in one plane
  std::span<std::uint32_t> patch_at;     // position -> patch, or the number of patches + block
  std::span<Block> blocks;               // by their order
  std::span<std::uint32_t> shape_at;     // position -> shape
  std::span<PatchShape> shapes;
  std::span<Patch> block_patches;        // by their order: all of a block as one patch
  std::span<LatticePoint> kept_samples;  // [position * cached_points + k]: points of cached_set
  std::span<FoundNode> found_nodes;      // none: shapes, block_patches and kept_samples hold all geometry
  SampleSet cached_set = SampleSet::kGauss;  // kCentre for one segment a pair
  std::uint32_t cached_points = 4;       // 1 or 4
  std::span<LatticeBox> mesh_box;        // of mesh_at[k]: around its samples; none with flags off, or `blocks`
  std::span<double> root_area;           // sqrt R of the area that isn't hidden; 0: takes no part
  std::uint32_t gathered = 0;            // of mesh_at: how many are there
  double flat = 0;                       // heights below it are rounding, scene units

  std::uint32_t size() const { return static_cast<std::uint32_t>(patch_at.size()); }
  bool is_block(std::uint32_t position) const {
    return features::kTrees && patch_at[position] >= scene->patch_count;
  }
  const Block& block(std::uint32_t position) const { return blocks[patch_at[position] - scene->patch_count]; }
  Block& block(std::uint32_t position) { return blocks[patch_at[position] - scene->patch_count]; }
  /// The node after the last that is part of this one.
  std::uint32_t end(std::uint32_t position) const { return is_block(position) ? block(position).end : position + 1; }
  bool keeps_geometry() const { return found_nodes.empty(); }
  const Patch& patch(std::uint32_t position) const {
    if (!keeps_geometry()) return found(position).patch;
    return is_block(position) ? block_patches[patch_at[position] - scene->patch_count] : patches[patch_at[position]];
  }
  const PatchShape& shape(std::uint32_t position) const {
    return keeps_geometry() ? shapes[shape_at[position]] : found(position).shape;
  }
  /// cached_points of them.
  const LatticePoint* samples(std::uint32_t position) const {
    return keeps_geometry() ? &kept_samples[std::size_t{position} * cached_points] : found(position).samples;
  }
  /// Of the scene.
  std::uint32_t mesh_index(std::uint32_t position) const;
  const Mesh& mesh(std::uint32_t position) const { return scene->meshes[mesh_index(position)]; }
  /// Of a patch, by channel; `room` may be used for it.
  const double* reflectance(std::uint32_t position, double (&room)[3]) const {
    if (scene->textured.empty()) return scene->materials[mesh(position).material].diffuse.c;
    return MeshReflectance(*scene, mesh_index(position)).of(local(position), room);
  }
  /// Of a patch, counted from its mesh's first.
  std::uint32_t local(std::uint32_t position) const { return patch_at[position] - mesh(position).first_patch; }
  Piece piece(std::uint32_t position) const {
    return is_block(position) ? block_piece(*scene, mesh(position), block(position).part)
                              : patch_piece(*scene, mesh(position), local(position));
  }
  /// The share of a node in the flux of the block that holds it.
  double share(std::uint32_t child, std::uint32_t parent) const { return root_area[child] / root_area[parent]; }
  bool triangular(std::uint32_t position) const { return shape(position).outline == Outline::kTriangle; }

  /// Whatever is kept, found again.
  const NodeGeometry& found(std::uint32_t position) const;
};

/// Whether nodes' geometry stays in the arena.
enum class SurfacesKeep : std::uint8_t { kGeometry, kNothing };

/// `patches` may be empty with kNothing. Errors: kMemory.
Status gather_surfaces(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                       const DirectLight& direct, const Options& options, Arena& arena, Surfaces& surfaces,
                       SurfacesKeep keep = SurfacesKeep::kGeometry);

/// Blocks among the nodes from `begin` to `end`: the sum of their parts' fluxes, each with its share. values[node *
/// channels + c].
void sum_up(const Surfaces& surfaces, std::uint32_t begin, std::uint32_t end, std::uint32_t channels,
            std::span<double> values);
/// Adds to the parts of a block their shares of `sum`, by channel.
template <std::uint32_t kChannels>
void hand_down(const Surfaces& surfaces, std::uint32_t block, const double* sum, std::span<double> values) {
  const std::uint32_t channels = kChannels == 0 ? surfaces.scene->channels : kChannels;
  for (std::uint32_t child = block + 1; child < surfaces.end(block); child = surfaces.end(child)) {
    const double share = surfaces.share(child, block);
    double* to = &values[std::size_t{child} * channels];
    for (std::uint32_t c = 0; c < channels; ++c) to[c] += share * sum[c];
  }
}

/// Arena bytes of gather_surfaces.
std::uint64_t surfaces_bytes(const Scene& scene, const Options& options, SurfacesKeep keep);

/// Sample (x, y) of a patch in scene coordinates; of a thin one (narrower than 32 lattice steps) only the middle half
/// is used (design: exact visibility).
Vec3 sample_place(const Surfaces& surfaces, std::uint32_t position, const SamplePoint& sample);
/// The lattice points of a set, in its order; returns their number.
std::uint32_t place_samples(const Surfaces& surfaces, std::uint32_t position, SampleSet set, LatticePoint* at);

}  // namespace shodo
