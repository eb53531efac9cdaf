#include "ambient/surfaces.h"

#include "visibility/sort.h"

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

/// By the extreme vertices, then the normal, then the counts; equal ones keep their order in the file.
bool mesh_before(const Scene& scene, std::span<const Patch> patches, std::uint32_t a, std::uint32_t b) {
  const Mesh& first = scene.meshes[a];
  const Mesh& second = scene.meshes[b];
  int order = compare(extreme_vertex(scene, first, 1), extreme_vertex(scene, second, 1));
  if (order == 0) order = compare(extreme_vertex(scene, first, -1), extreme_vertex(scene, second, -1));
  if (order == 0) order = compare(patches[first.first_patch].normal, patches[second.first_patch].normal);
  if (order == 0) order = compare(patches[first.first_patch].centre, patches[second.first_patch].centre);
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

bool take_all(Arena& arena, const Scene& scene, const Options& options, std::uint32_t shapes, Surfaces& s) {
  const std::size_t n = scene.patch_count, meshes = scene.meshes.size();
  s.cached_set = cached_set(options);
  s.cached_points = static_cast<std::uint32_t>(sample_points(s.cached_set, false).size());
  return arena.take("mesh order", meshes, s.mesh_at) && arena.take("mesh positions", meshes + 1, s.mesh_begin) &&
         arena.take("planar meshes", meshes, s.planar) && arena.take("patch positions", n, s.patch_at) &&
         arena.take("patch shape numbers", n, s.shape_at) && arena.take("patch shapes", shapes, s.shapes) &&
         arena.take("patch samples", n * s.cached_points, s.samples) && arena.take("patch areas", n, s.root_area);
}

std::uint32_t count_shapes(const Scene& scene) {
  std::uint32_t shapes = 0;
  for (const Mesh& mesh : scene.meshes) shapes += shape_count(scene, mesh);
  return shapes;
}

bool takes_part(const Patch& patch, double visible_area) {
  return patch.dropped == 0 && patch.area > 0 && visible_area > 0 && length_squared(patch.normal) > 0;
}

/// One mesh's patches from position `position` on; its shapes from `first_shape` on.
void gather_mesh(Surfaces& s, const DirectLight& direct, std::uint32_t mesh_index, std::uint32_t position,
                 std::uint32_t first_shape) {
  const Mesh& mesh = s.scene->meshes[mesh_index];
  const std::uint32_t shapes = shape_count(*s.scene, mesh);
  for (std::uint32_t k = 0; k < shapes; ++k) s.shapes[first_shape + k] = shape_of(patch_piece(*s.scene, mesh, k));
  for (std::uint32_t local = 0; local < mesh.patch_count(); ++local, ++position) {
    const std::uint32_t patch = mesh.first_patch + local;
    s.patch_at[position] = patch;
    s.shape_at[position] = first_shape + shape_index(shapes, mesh, local);
    const double visible = static_cast<double>(direct.visible_area[patch]);
    if (!takes_part(s.patches[patch], visible)) continue;
    s.root_area[position] = square_root(s.patches[patch].area * visible);
    place_samples(s, position, s.cached_set, &s.samples[std::size_t{position} * s.cached_points]);
  }
}

constexpr std::uint64_t block(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

Vec3 sample_place(const Surfaces& surfaces, std::uint32_t position, const SamplePoint& sample) {
  const PatchShape& shape = surfaces.shape(position);
  const double part = surfaces.patch(position).thin != 0 ? 0.5 : 1;
  const double x = part * sample.x, y = part * sample.y;
  if (shape.outline == Outline::kConcave) return surfaces.piece(position).point(0.5 + 0.5 * x, 0.5 + 0.5 * y);
  return surfaces.patch(position).centre + shape.offset(x, y);
}

std::uint32_t place_samples(const Surfaces& surfaces, std::uint32_t position, SampleSet set, LatticePoint* at) {
  const std::uint32_t mesh_index = surfaces.patch(position).mesh;
  const std::uint32_t cell = cell_of_patch(surfaces.scene->meshes[mesh_index], surfaces.local(position));
  const std::span<const SamplePoint> points = sample_points(set, surfaces.triangular(position));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 place = sample_place(surfaces, position, points[k]);
    at[k] = sample_point(*surfaces.scene, *surfaces.geometry, mesh_index, cell, place);
  }
  return static_cast<std::uint32_t>(points.size());
}

Status gather_surfaces(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                       const DirectLight& direct, const Options& options, Arena& arena, Surfaces& surfaces) {
  surfaces.scene = &scene;
  surfaces.geometry = &geometry;
  surfaces.patches = patches;
  surfaces.flat = kFlat * scene.largest_half_extent();
  if (!take_all(arena, scene, options, count_shapes(scene), surfaces)) return arena.refused();
  const std::uint32_t meshes = static_cast<std::uint32_t>(scene.meshes.size());
  for (std::uint32_t m = 0; m < meshes; ++m) surfaces.mesh_at[m] = m;
  heap_sort(surfaces.mesh_at,
            [&](std::uint32_t a, std::uint32_t b) { return mesh_before(scene, patches, a, b); });
  std::uint32_t position = 0, shape = 0;
  for (std::uint32_t k = 0; k < meshes; ++k) {
    const Mesh& mesh = scene.meshes[surfaces.mesh_at[k]];
    surfaces.mesh_begin[k] = position;
    surfaces.planar[k] = is_planar(scene, mesh, patches[mesh.first_patch].normal, surfaces.flat) ? 1 : 0;
    gather_mesh(surfaces, direct, surfaces.mesh_at[k], position, shape);
    position += mesh.patch_count();
    shape += shape_count(scene, mesh);
  }
  surfaces.mesh_begin[meshes] = position;
  return {};
}

std::uint64_t surfaces_bytes(const Scene& scene, const Options& options) {
  const std::uint64_t n = scene.patch_count, meshes = scene.meshes.size();
  const std::uint64_t points = sample_points(cached_set(options), false).size();
  return block(4 * meshes) + block(4 * (meshes + 1)) + block(meshes) + 2 * block(4 * n) +
         block(sizeof(PatchShape) * count_shapes(scene)) + block(sizeof(LatticePoint) * n * points) + block(8 * n);
}

}  // namespace shodo
