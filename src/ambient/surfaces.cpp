#include "ambient/surfaces.h"

#include "base/sort.h"

namespace shodo {

namespace {

/// Heights are compared with 2^-31 of the scene, 1/2048 of a lattice step.
constexpr double kFlat = 0x1p-31;

int compare(const Vec3& p, const Vec3& q) {
  if (p.x != q.x) return p.x < q.x ? -1 : 1;
  if (p.y != q.y) return p.y < q.y ? -1 : 1;
  if (p.z != q.z) return p.z < q.z ? -1 : 1;
  return 0;
}

std::uint32_t vertex_count(const Mesh& mesh) {
  if (mesh.kind == MeshKind::kQuad) return 4;
  return mesh.kind == MeshKind::kTriangle ? 3 : (mesh.cells_u + 1) * (mesh.cells_v + 1);
}

/// The first (or last) vertex of a mesh by x, then y, then z; `sum`: of all vertices' coordinates.
Vec3 extreme_vertex(const Scene& scene, const Mesh& mesh, int sign) {
  Vec3 best = scene.vertices[mesh.first_vertex];
  for (std::uint32_t k = 1; k < vertex_count(mesh); ++k) {
    const Vec3& vertex = scene.vertices[mesh.first_vertex + k];
    if (compare(vertex, best) * sign < 0) best = vertex;
  }
  return best;
}

Patch patch_of_mesh(const Surfaces& s, std::uint32_t mesh, std::uint32_t local) {
  const std::uint32_t patch = s.scene->meshes[mesh].first_patch + local;
  return s.patches.empty() ? make_patch(*s.scene, *s.geometry, mesh, local) : s.patches[patch];
}

/// By the extreme vertices, then the normal, then the counts; equal ones keep their order in the file.
bool mesh_before(const Surfaces& s, std::uint32_t a, std::uint32_t b) {
  const Scene& scene = *s.scene;
  const Mesh& first = scene.meshes[a];
  const Mesh& second = scene.meshes[b];
  int order = compare(extreme_vertex(scene, first, 1), extreme_vertex(scene, second, 1));
  if (order == 0) order = compare(extreme_vertex(scene, first, -1), extreme_vertex(scene, second, -1));
  if (order != 0) return order < 0;
  const Patch of_first = patch_of_mesh(s, a, 0), of_second = patch_of_mesh(s, b, 0);
  order = compare(of_first.normal, of_second.normal);
  if (order == 0) order = compare(of_first.centre, of_second.centre);
  if (order != 0) return order < 0;
  if (first.nu != second.nu) return first.nu < second.nu;
  if (first.nv != second.nv) return first.nv < second.nv;
  return a < b;
}

bool is_planar(const Scene& scene, const Mesh& mesh, const Vec3& normal, double flat) {
  const Vec3& origin = scene.vertices[mesh.first_vertex];
  for (std::uint32_t k = 1; k < vertex_count(mesh); ++k) {
    const double height = dot(normal, scene.vertices[mesh.first_vertex + k] - origin);
    if (height > flat || height < -flat) return false;
  }
  return length_squared(normal) > 0;
}

SampleSet cached_set(const Options& options) {
  return options.segments_first <= 1 ? SampleSet::kCentre : SampleSet::kGauss;
}

/// ambient/sight.h has no use for boxes of meshes.
std::size_t mesh_boxes(const Scene& scene, const Options& options) {
  return !features::aims(options.flags) || features::blocks(options.rules) ? 0 : scene.meshes.size();
}

bool take_all(Arena& arena, const Scene& scene, const Options& options, std::uint32_t shapes, SurfacesKeep keep,
              Surfaces& s) {
  const std::size_t blocks = block_count(scene, options.rules), meshes = scene.meshes.size();
  const std::size_t n = scene.patch_count + blocks;
  s.cached_set = cached_set(options);
  s.cached_points = static_cast<std::uint32_t>(sample_points(s.cached_set, false).size());
  const bool taken =
      arena.take("mesh order", meshes, s.mesh_at) && arena.take("mesh positions", meshes + 1, s.mesh_begin) &&
      arena.take("planar meshes", meshes, s.planar) && arena.take("patch positions", n, s.patch_at) &&
      arena.take("blocks", blocks, s.blocks) && arena.take("patch areas", n, s.root_area) &&
      arena.take("mesh boxes", mesh_boxes(scene, options), s.mesh_box);
  if (!taken || keep == SurfacesKeep::kNothing) {
    return taken && arena.take("found nodes", scene.patch_count > 0 ? kFoundNodes : 0, s.found_nodes);
  }
  return arena.take("patch shape numbers", n, s.shape_at) && arena.take("patch shapes", shapes + blocks, s.shapes) &&
         arena.take("patches of blocks", blocks, s.block_patches) &&
         arena.take("patch samples", n * s.cached_points, s.kept_samples);
}

std::uint32_t count_shapes(const Scene& scene) {
  std::uint32_t shapes = 0;
  for (const Mesh& mesh : scene.meshes) shapes += shape_count(scene, mesh);
  return shapes;
}

bool takes_part(const Patch& patch, double visible_area) {
  return patch.dropped == 0 && patch.area > 0 && visible_area > 0 && length_squared(patch.normal) > 0;
}

/// What the next mesh starts with.
struct Fill {
  std::uint32_t position = 0, shape = 0, block = 0;
};

Patch make_block_patch(const Surfaces& s, std::uint32_t mesh_index, const Piece& piece, std::uint32_t thin) {
  Patch patch;
  patch.mesh = mesh_index;
  patch.centre = piece.centre();
  patch.area = length(piece.vector_area());
  patch.normal = patch_of_mesh(s, mesh_index, 0).normal;
  patch.longest_side = piece.longest_side();
  patch.thin = static_cast<std::uint16_t>(thin);
  return patch;
}

/// `shape`: the number of its shape, where shapes are kept.
void gather_patch(Surfaces& s, const DirectLight& direct, std::uint32_t mesh, std::uint32_t local,
                  std::uint32_t position, std::uint32_t shape) {
  const std::uint32_t index = s.scene->meshes[mesh].first_patch + local;
  s.patch_at[position] = index;
  if (s.keeps_geometry()) s.shape_at[position] = shape;
  const double visible = static_cast<double>(direct.visible_area[index]);
  const Patch patch = patch_of_mesh(s, mesh, local);
  if (!takes_part(patch, visible)) return;
  s.root_area[position] = square_root(patch.area * visible);
  if (!s.keeps_geometry()) return;
  place_samples(s, position, s.cached_set, &s.kept_samples[std::size_t{position} * s.cached_points]);
}

/// A block's own geometry; its sums follow when its parts are known.
void gather_block(Surfaces& s, std::uint32_t mesh_index, const TreeNode& node, std::uint32_t position, Fill& fill) {
  Block& block = s.blocks[fill.block];
  block.part = node.part;
  block.end = position + node.nodes;
  s.patch_at[position] = s.scene->patch_count + fill.block;
  if (s.keeps_geometry()) {
    const Piece piece = block_piece(*s.scene, s.scene->meshes[mesh_index], node.part);
    s.block_patches[fill.block] = make_block_patch(s, mesh_index, piece, 0);
    s.shapes[fill.shape] = shape_of(piece);
    s.shape_at[position] = fill.shape++;
  }
  ++fill.block;
}

/// Sums over the parts of a block, all of which are there.
void finish_block(Surfaces& s, std::uint32_t mesh_index, std::uint32_t position) {
  Block& block = s.block(position);
  double area = 0;
  for (std::uint32_t child = position + 1; child < block.end; child = s.end(child)) {
    area += s.root_area[child] * s.root_area[child];
    const bool inner = s.is_block(child);
    const std::uint32_t local = s.patch_at[child] - s.scene->meshes[mesh_index].first_patch;
    if ((inner ? s.block(child).thin : patch_of_mesh(s, mesh_index, local).thin) != 0) block.thin = 1;
    block.senders += inner ? s.block(child).senders : s.root_area[child] > 0 ? 1 : 0;
  }
  block.receivers = block.senders;
  s.root_area[position] = square_root(area);
  block.sending_root = s.root_area[position];
  if (!s.keeps_geometry()) return;
  s.block_patches[s.patch_at[position] - s.scene->patch_count].thin = static_cast<std::uint16_t>(block.thin);
  if (!(area > 0)) return;
  place_samples(s, position, s.cached_set, &s.kept_samples[std::size_t{position} * s.cached_points]);
}

/// One mesh's nodes; mesh_at[k].
void gather_mesh(Surfaces& s, const DirectLight& direct, const Rules& rules, std::uint32_t k, Fill& fill) {
  const std::uint32_t mesh_index = s.mesh_at[k];
  const Mesh& mesh = s.scene->meshes[mesh_index];
  const std::uint32_t shapes = shape_count(*s.scene, mesh), first_shape = fill.shape, begin = fill.position;
  for (std::uint32_t n = 0; s.keeps_geometry() && n < shapes; ++n) {
    s.shapes[first_shape + n] = shape_of(patch_piece(*s.scene, mesh, n));
  }
  fill.shape += shapes;
  for (TreeWalk walk(*s.scene, mesh, rules); walk.next(); ++fill.position) {
    const TreeNode& node = walk.node();
    if (node.nodes > 1) {
      gather_block(s, mesh_index, node, fill.position, fill);
    } else {
      gather_patch(s, direct, mesh_index, node.local, fill.position,
                   first_shape + shape_index(shapes, mesh, node.local));
    }
  }
  for (std::uint32_t position = fill.position; position-- > begin;) {
    if (s.is_block(position)) finish_block(s, mesh_index, position);
  }
}

/// Around the cached samples of nodes that take part.
LatticeBox sample_box(const Surfaces& s, std::uint32_t begin, std::uint32_t end) {
  LatticeBox box;
  for (std::uint32_t i = begin; i < end; ++i) {
    if (!(s.root_area[i] > 0)) continue;
    const LatticePoint* const samples = s.samples(i);
    for (std::uint32_t k = 0; k < s.cached_points; ++k) box.include(samples[k]);
  }
  return box;
}

constexpr std::uint64_t block(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

std::uint32_t Surfaces::mesh_index(std::uint32_t position) const {
  if (keeps_geometry()) return patch(position).mesh;
  std::uint32_t low = 0, high = gathered;
  while (high - low > 1) {
    const std::uint32_t middle = (low + high) / 2;
    (mesh_begin[middle] <= position ? low : high) = middle;
  }
  return mesh_at[low];
}

/// The place whose node was looked at longest ago is taken.
const NodeGeometry& Surfaces::found(std::uint32_t position) const {
  std::uint64_t latest = 0;
  FoundNode* oldest = &found_nodes[0];
  FoundNode* here = nullptr;
  for (FoundNode& node : found_nodes) {
    if (node.position == position) here = &node;
    if (node.used > latest) latest = node.used;
    if (node.used < oldest->used) oldest = &node;
  }
  if (here != nullptr) {
    if (here->used != latest) here->used = latest + 1;
    return here->geometry;
  }
  const std::uint32_t index = mesh_index(position);
  const Mesh& own = scene->meshes[index];
  oldest->position = position;
  oldest->used = latest + 1;
  NodeGeometry& node = oldest->geometry;
  node = {};
  if (is_block(position)) {
    const Piece whole = block_piece(*scene, own, block(position).part);
    node.patch = make_block_patch(*this, index, whole, block(position).thin);
    node.shape = shape_of(whole);
  } else {
    const std::uint32_t own_local = patch_at[position] - own.first_patch;
    node.patch = patch_of_mesh(*this, index, own_local);
    node.shape = shape_of(patch_piece(*scene, own, shape_index(shape_count(*scene, own), own, own_local)));
  }
  if (root_area[position] > 0) place_samples(*this, position, cached_set, node.samples);
  return node;
}

Vec3 sample_place(const Surfaces& surfaces, std::uint32_t position, const SamplePoint& sample) {
  const PatchShape& shape = surfaces.shape(position);
  const double part = surfaces.patch(position).thin != 0 ? 0.5 : 1;
  const double x = part * sample.x, y = part * sample.y;
  if (shape.outline == Outline::kConcave) return surfaces.piece(position).point(0.5 + 0.5 * x, 0.5 + 0.5 * y);
  return surfaces.patch(position).centre + shape.offset(x, y);
}

std::uint32_t place_samples(const Surfaces& surfaces, std::uint32_t position, SampleSet set, LatticePoint* at) {
  const std::uint32_t mesh_index = surfaces.patch(position).mesh;
  const Mesh& mesh = surfaces.scene->meshes[mesh_index];
  // A mesh of several cells has no blocks.
  const std::uint32_t cell = surfaces.is_block(position) ? 0 : cell_of_patch(mesh, surfaces.local(position));
  const std::span<const SamplePoint> points = sample_points(set, surfaces.triangular(position));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 place = sample_place(surfaces, position, points[k]);
    at[k] = sample_point(*surfaces.scene, *surfaces.geometry, mesh_index, cell, place);
  }
  return static_cast<std::uint32_t>(points.size());
}

Status gather_surfaces(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                       const DirectLight& direct, const Options& options, Arena& arena, Surfaces& surfaces,
                       SurfacesKeep keep) {
  surfaces.scene = &scene;
  surfaces.geometry = &geometry;
  surfaces.patches = patches;
  surfaces.flat = kFlat * scene.largest_half_extent();
  if (!take_all(arena, scene, options, count_shapes(scene), keep, surfaces)) return arena.refused();
  const std::uint32_t meshes = static_cast<std::uint32_t>(scene.meshes.size());
  for (std::uint32_t m = 0; m < meshes; ++m) surfaces.mesh_at[m] = m;
  heap_sort(surfaces.mesh_at,
            [&](std::uint32_t a, std::uint32_t b) { return mesh_before(surfaces, a, b); });
  for (FoundNode& node : surfaces.found_nodes) node = {};
  Fill fill;
  for (std::uint32_t k = 0; k < meshes; ++k) {
    const Mesh& mesh = scene.meshes[surfaces.mesh_at[k]];
    surfaces.mesh_begin[k] = fill.position;
    surfaces.gathered = k + 1;
    const bool tree = tree_kind(scene, mesh, options.rules) != TreeKind::kNone;
    const Vec3 normal = patch_of_mesh(surfaces, surfaces.mesh_at[k], 0).normal;
    const bool flat = tree || is_planar(scene, mesh, normal, surfaces.flat);
    surfaces.planar[k] = flat ? 1 : 0;
    gather_mesh(surfaces, direct, options.rules, k, fill);
    if (!surfaces.mesh_box.empty()) surfaces.mesh_box[k] = sample_box(surfaces, surfaces.mesh_begin[k], fill.position);
  }
  surfaces.mesh_begin[meshes] = fill.position;
  return {};
}

void sum_up(const Surfaces& surfaces, std::uint32_t begin, std::uint32_t end, std::uint32_t channels,
            std::span<double> values) {
  if (surfaces.blocks.empty()) return;
  for (std::uint32_t b = end; b-- > begin;) {
    if (!surfaces.is_block(b) || !(surfaces.root_area[b] > 0)) continue;
    double* sum = &values[std::size_t{b} * channels];
    for (std::uint32_t c = 0; c < channels; ++c) sum[c] = 0;
    for (std::uint32_t child = b + 1; child < surfaces.end(b); child = surfaces.end(child)) {
      const double share = surfaces.share(child, b);
      const double* from = &values[std::size_t{child} * channels];
      for (std::uint32_t c = 0; c < channels; ++c) sum[c] += share * from[c];
    }
  }
}

std::uint64_t surfaces_bytes(const Scene& scene, const Options& options, SurfacesKeep keep) {
  const std::uint64_t blocks = block_count(scene, options.rules), meshes = scene.meshes.size();
  const std::uint64_t n = scene.patch_count + blocks;
  const std::uint64_t points = sample_points(cached_set(options), false).size();
  const std::uint64_t always = block(4 * meshes) + block(4 * (meshes + 1)) + block(meshes) + block(4 * n) +
                               sizeof(Block) * blocks + 8 * n +
                               sizeof(LatticeBox) * mesh_boxes(scene, options);
  if (keep == SurfacesKeep::kNothing) return always + (n > 0 ? sizeof(FoundNode) * kFoundNodes : 0);
  return always + block(4 * n) + sizeof(PatchShape) * (count_shapes(scene) + blocks) + sizeof(Patch) * blocks +
         block(sizeof(LatticePoint) * n * points);
}

}  // namespace shodo
