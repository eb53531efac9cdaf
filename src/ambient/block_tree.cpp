#include "ambient/block_tree.h"

#include "ambient/patch_shape.h"

namespace shodo {

namespace {

/// Heights over the mean plane below this part of the size are rounding.
constexpr double kPlanar = 0x1p-30;

bool planar(const Piece& cell) {
  if (cell.corners == 3) return true;
  const Vec3 normal = normalised(cell.vector_area());
  const double height = dot(normal, cell.corner[1] - cell.corner[0]) + dot(normal, cell.corner[3] - cell.corner[2]);
  const double flat = kPlanar * cell.longest_side();
  return height <= flat && height >= -flat;
}

bool equal_areas(const PatchShape& shape) {
  const double a = shape.alpha < 0 ? -shape.alpha : shape.alpha, b = shape.beta < 0 ? -shape.beta : shape.beta;
  return 1 + (a + b) <= (1 + kEqualAreas) * (1 - (a + b));
}

std::uint32_t patches_in(const MeshPart& part) { return part.across() * part.up(); }

MeshPart all_of(const Mesh& mesh) {
  return {0, 0, static_cast<std::uint16_t>(mesh.nu), static_cast<std::uint16_t>(mesh.nv)};
}

std::uint32_t rounded_log2(std::uint32_t count) {
  std::uint32_t bits = 0;
  while ((std::uint64_t{1} << bits) < count) ++bits;
  return bits;
}

}  // namespace

TreeKind tree_kind(const Scene& scene, const Mesh& mesh, const Rules& rules) {
  if (!features::kTrees || !(rules.rule3 || rules.blocks)) return TreeKind::kNone;
  if (mesh.patch_count() < 2 || mesh.kind == MeshKind::kGrid) return TreeKind::kNone;
  const Piece cell = cell_piece(scene, mesh, 0);
  if (cell.cut || !planar(cell) || !(length_squared(cell.vector_area()) > 0)) return TreeKind::kNone;
  if (features::kRules && rules.rule3 && !equal_areas(shape_of(cell))) return TreeKind::kNone;
  return features::blocks(rules) && mesh.kind == MeshKind::kQuad ? TreeKind::kBinary : TreeKind::kFlat;
}

TreeWalk::TreeWalk(const Scene& scene, const Mesh& mesh, const Rules& rules)
    : mesh_(&mesh), kind_(tree_kind(scene, mesh, rules)) {
  if (kind_ != TreeKind::kBinary) return;
  const PatchShape shape = shape_of(cell_piece(scene, mesh, 0));
  length_u_ = length(shape.a) / mesh.nu;
  length_v_ = length(shape.b) / mesh.nv;
  push(all_of(mesh));
}

void TreeWalk::push(const MeshPart& part) { waiting_[waiting_count_++] = part; }

bool TreeWalk::next() {
  if (kind_ == TreeKind::kFlat && !started_) {
    started_ = true;
    node_ = {all_of(*mesh_), mesh_->patch_count() + 1, 0};
    return true;
  }
  if (kind_ != TreeKind::kBinary) {
    if (patches_done_ == mesh_->patch_count()) return false;
    node_ = {{}, 1, patches_done_++};
    return true;
  }
  if (waiting_count_ == 0) return false;
  const MeshPart part = waiting_[--waiting_count_];
  const std::uint32_t across = part.across(), up = part.up();
  node_ = {part, 2 * patches_in(part) - 1, part.v0 * mesh_->nu + part.u0};
  if (node_.nodes == 1) return true;
  MeshPart first = part, second = part;
  if (up == 1 || (across > 1 && across * length_u_ >= up * length_v_)) {
    first.u1 = second.u0 = static_cast<std::uint16_t>(part.u0 + across / 2);
  } else {
    first.v1 = second.v0 = static_cast<std::uint16_t>(part.v0 + up / 2);
  }
  push(second);
  push(first);
  return true;
}

std::uint32_t mesh_nodes(const Scene& scene, const Mesh& mesh, const Rules& rules) {
  const TreeKind kind = tree_kind(scene, mesh, rules);
  const std::uint32_t patches = mesh.patch_count();
  return kind == TreeKind::kNone ? patches : kind == TreeKind::kFlat ? patches + 1 : 2 * patches - 1;
}

std::uint32_t block_count(const Scene& scene, const Rules& rules) {
  std::uint32_t blocks = 0;
  for (const Mesh& mesh : scene.meshes) blocks += mesh_nodes(scene, mesh, rules) - mesh.patch_count();
  return blocks;
}

std::uint32_t block_depth(const Scene& scene, const Rules& rules) {
  std::uint32_t deepest = 0;
  for (const Mesh& mesh : scene.meshes) {
    const TreeKind kind = tree_kind(scene, mesh, rules);
    if (kind == TreeKind::kNone) continue;
    // Halves are rounded up at each cut along u, and at each along v.
    const std::uint32_t depth = kind == TreeKind::kFlat ? 1 : rounded_log2(mesh.nu) + rounded_log2(mesh.nv);
    if (depth > deepest) deepest = depth;
  }
  return deepest;
}

Piece block_piece(const Scene& scene, const Mesh& mesh, const MeshPart& part) {
  if (patches_in(part) == mesh.patch_count()) return cell_piece(scene, mesh, 0);
  const auto patch = [&](std::uint32_t u, std::uint32_t v) { return patch_piece(scene, mesh, v * mesh.nu + u); };
  Piece piece = patch(part.u0, part.v0);
  piece.corner[1] = patch(part.u1 - 1, part.v0).corner[1];
  piece.corner[2] = patch(part.u1 - 1, part.v1 - 1).corner[2];
  piece.corner[3] = patch(part.u0, part.v1 - 1).corner[3];
  return piece;
}

}  // namespace shodo
