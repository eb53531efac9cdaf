// Meshes taken as a whole, and in parts: the blocks of rule 3 and of `--rules blocks` (paper 3.2 rule 3).
//
// Rule 3 knows one block a mesh, with all patches directly in it. `blocks` carries it on: a quadrilateral mesh of nu
// x nv patches is a binary tree, each block a rectangle of patches cut in two across its longer side (in length, not
// in patches) at the middle. Nodes are numbered in preorder: a block, then everything in it; so the first part of the
// block at node a is node a + 1, and the next part of a block starts where the last one ends. A mesh has blocks if it
// is a planar convex quadrilateral or a triangle of several patches; for rule 3 its patches must have equal areas to
// kEqualAreas. Grids (curved, several cells) and cut or twisted quadrilaterals have none: their patches stay on their
// own. A triangle's patches all stand directly in its one block.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "scene/mesh.h"
#include "shodo/options.h"

namespace shodo {

/// The largest patch of a mesh may be so much larger than the smallest, relative, for rule 3.
inline constexpr double kEqualAreas = 1.0 / 16;

/// A rectangle of patches; u1 and v1 are one past the last. An edge has kMostPieces at most (scene/counts.cpp).
struct MeshPart {
  std::uint16_t u0 = 0, v0 = 0, u1 = 0, v1 = 0;

  std::uint32_t across() const { return std::uint32_t{u1} - u0; }
  std::uint32_t up() const { return std::uint32_t{v1} - v0; }
};

struct Block {
  MeshPart part;
  std::uint32_t end = 0;        // the node after its last
  std::uint32_t senders = 0;    // its patches that send: their columns are kept
  std::uint32_t receivers = 0;  // its patches that receive: their rows are kept
  std::uint32_t thin = 0;       // 1: some of its patches are
  double sending_root = 0;      // visible area of its senders over R: what its row sums count
};
static_assert(sizeof(Block) == 32, "memory_plan.cpp");

/// One node of a mesh's tree, as it is built.
struct TreeNode {
  MeshPart part;
  std::uint32_t nodes = 1;  // with everything in it; 1: a patch
  std::uint32_t local = 0;  // of a patch: its number in the mesh
};

enum class TreeKind : std::uint8_t { kNone, kFlat, kBinary };

TreeKind tree_kind(const Scene& scene, const Mesh& mesh, const Rules& rules);

/// Visits the nodes of a mesh in their order.
class TreeWalk {
 public:
  TreeWalk(const Scene& scene, const Mesh& mesh, const Rules& rules);
  /// False after the last.
  bool next();
  const TreeNode& node() const { return node_; }

 private:
  void push(const MeshPart& part);

  static constexpr std::uint32_t kDeepest = 64;  // cuts of 2^32 by 2^32 patches

  const Mesh* mesh_;
  TreeKind kind_;
  double length_u_ = 0, length_v_ = 0;  // of a patch
  TreeNode node_;
  MeshPart waiting_[kDeepest];  // second halves
  std::uint32_t waiting_count_ = 0;
  std::uint32_t patches_done_ = 0;
  bool started_ = false;
};

/// Patches and blocks of a mesh.
std::uint32_t mesh_nodes(const Scene& scene, const Mesh& mesh, const Rules& rules);
/// Blocks of the whole scene.
std::uint32_t block_count(const Scene& scene, const Rules& rules);
/// Patches and blocks: what the ambient stage has arrays over.
inline std::size_t node_count(const Scene& scene, const Rules& rules) {
  return std::size_t{scene.patch_count} + block_count(scene, rules);
}
/// The most blocks that a patch of the scene is in.
std::uint32_t block_depth(const Scene& scene, const Rules& rules);

/// The outline of a part of a planar mesh.
Piece block_piece(const Scene& scene, const Mesh& mesh, const MeshPart& part);

}  // namespace shodo
