#include "ambient/link_walk.h"

#include "base/check.h"

namespace shodo {

namespace {

/// The larger diagonal of a block's outline, or longest side of a triangle, squared.
double diameter_squared(const PatchShape& shape, double longest_side) {
  if (shape.outline != Outline::kQuad) return longest_side * longest_side;
  const double one = 4 * length_squared(shape.a + shape.b), other = 4 * length_squared(shape.a - shape.b);
  return one > other ? one : other;
}

bool wide_nodes(std::size_t nodes) { return nodes > 0x10000; }

}  // namespace

std::uint64_t LinkWalk::bytes(const Scene& scene, const Options& options) {
  const std::uint64_t a_node = wide_nodes(node_count(scene, options.rules)) ? 4 : 2;
  return (a_node * scene.patch_count * block_depth(scene, options.rules) + 7) / 8 * 8;
}

Status LinkWalk::take(Arena& arena, const Surfaces& surfaces, const Sparsity& sparsity, const Options& options) {
  surfaces_ = &surfaces;
  sparsity_ = &sparsity;
  const double diameters = options.rules.rule3_diameters > 0 ? options.rules.rule3_diameters : kRule3Diameters;
  diameters_squared_ = diameters * diameters;
  wide_ = wide_nodes(surfaces.size());
  looks_ = !options.rules.blocks;
  const std::size_t nodes = std::size_t{surfaces.scene->patch_count} * block_depth(*surfaces.scene, options.rules);
  return arena.take("links left", wide_ ? 2 * nodes : nodes, left_) ? Status{} : arena.refused();
}

std::uint32_t LinkWalk::mesh_of(std::uint32_t node) const {
  std::uint32_t low = 0, high = static_cast<std::uint32_t>(surfaces_->mesh_at.size());
  while (high - low > 1) {
    const std::uint32_t middle = (low + high) / 2;
    (surfaces_->mesh_begin[middle] <= node ? low : high) = middle;
  }
  return low;
}

bool LinkWalk::out_of_sight(const RowSide& side, std::uint32_t k) const {
  const Surfaces& surfaces = *surfaces_;
  const Mesh& mesh = surfaces.scene->meshes[surfaces.mesh_at[k]];
  if (mesh.kind == MeshKind::kGrid) return false;
  const Vec3* vertex = &surfaces.scene->vertices[mesh.first_vertex];
  const std::uint32_t vertices = mesh.kind == MeshKind::kTriangle ? 3 : 4;
  bool all_behind = true;
  for (std::uint32_t v = 0; v < vertices && all_behind; ++v) {
    all_behind = dot(side.patch->normal, vertex[v] - side.patch->centre) <= surfaces.flat;
  }
  if (all_behind) return true;
  if (surfaces.planar[k] == 0) return false;
  const Vec3 normal = surfaces.patch(surfaces.mesh_begin[k]).normal;
  const double height = dot(normal, side.patch->centre - vertex[0]);
  return height + extent_along(*side.shape, side.patch->longest_side, normal).high <= surfaces.flat;
}

void LinkWalk::open_level(std::uint32_t a) {
  SHODO_CHECK(levels_ < kDeepest);
  const std::uint32_t first = levels_ == 0 ? 0 : level_[levels_ - 1].last;
  level_[levels_++] = {a, surfaces_->end(a), first, first};
}

void LinkWalk::leave(std::uint32_t b) {
  Level& level = level_[levels_ - 1];
  const std::uint32_t at = level.last++;
  SHODO_CHECK((wide_ ? 2 * at + 1 : at) < left_.size());
  left_[wide_ ? 2 * at : at] = static_cast<std::uint16_t>(b);
  if (wide_) left_[2 * at + 1] = static_cast<std::uint16_t>(b >> 16);
}

std::uint32_t LinkWalk::close_levels(std::uint32_t a) {
  while (levels_ > 0 && (a <= level_[levels_ - 1].block || a >= level_[levels_ - 1].end)) --levels_;
  return levels_ > 0 ? level_[levels_ - 1].block + 1 : surfaces_->mesh_begin[mesh_of(a)];
}

bool LinkWalk::far_from(std::uint32_t patch, std::uint32_t mesh) const {
  const Patch& whole = surfaces_->patch(mesh);
  const double diameter = diameter_squared(surfaces_->shape(mesh), whole.longest_side);
  return length_squared(surfaces_->patch(patch).centre - whole.centre) > diameters_squared_ * diameter;
}

/// How many links it saves to link the patches of a block, where they are far, to the other as a whole.
std::uint32_t LinkWalk::far_links(std::uint32_t parts_of, std::uint32_t whole) const {
  std::uint32_t far = 0;
  for (std::uint32_t patch = parts_of + 1; patch < surfaces_->end(parts_of); ++patch) {
    if (far_from(patch, whole)) ++far;
  }
  return far * (surfaces_->end(whole) - whole - 2);
}

LinkWalk::Step LinkWalk::judge_rule3(std::uint32_t a, std::uint32_t b) const {
  const bool a_whole = surfaces_->is_block(a), b_whole = surfaces_->is_block(b);
  if (a_whole && b_whole) return far_links(b, a) > far_links(a, b) ? Step::kSplitSecond : Step::kSplitFirst;
  if (a_whole) return far_from(b, a) ? Step::kLink : Step::kSplitFirst;
  return far_from(a, b) ? Step::kLink : Step::kSplitSecond;
}

LinkWalk::Step LinkWalk::judge(std::uint32_t a, std::uint32_t b) const {
  if (!features::kRules || (!surfaces_->is_block(a) && !surfaces_->is_block(b))) return Step::kLink;
  return judge_rule3(a, b);
}

}  // namespace shodo
