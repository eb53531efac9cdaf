// How many patches and sub-patches each mesh has, where the scene file doesn't say (contract 1: --patch, --sub-patch,
// --refine; 2: counts). Known at load; computed illuminance has no part in it.
//
// Patches: no edge of a patch is longer than --patch, by default 1/24 of the diagonal of the meshes' box (not of
// cameras and lights: to look from elsewhere must not change the light). Of two opposite edges the longer counts. A
// grid has one patch a cell. All counts, given or not, are then multiplied by --refine.
//
// Sub-patches: no edge longer than --sub-patch, by default a third of the patch's; nor longer than a third of the
// distance from the mesh to the nearest point light, or centre of an area or polyhedral light (not of the light that
// the mesh itself is), as far as 8 an edge allow: right under a point light illuminance falls to 85 % over that third.
//
// A quad that is not convex, or a grid with such a cell, takes the larger of its two counts for both (mesh.h says why).
// Sizes that divide an edge exactly must not give a piece more by rounding, so lengths within 10^-9 of the limit pass.
#include "base/text.h"
#include "scene/finish.h"
#include "scene/mesh.h"
#include "scene/values.h"

namespace shodo {

namespace {

constexpr std::uint32_t kTooMany = kMostPieces + 1;
constexpr double kRoundingAllowed = 1e-9;
constexpr double kPatchesADiagonal = 24;
constexpr double kSubPatchesAPatch = 3;
constexpr double kSubPatchesADistance = 3;
constexpr std::uint32_t kMostNearLights = 8;

/// The fewest equal pieces of at most `most` (> 0), at least 1.
std::uint32_t pieces(double edge, double most) {
  const double ratio = edge / most * (1 - kRoundingAllowed);
  if (!(ratio <= kMostPieces)) return kTooMany;
  const std::uint32_t whole = static_cast<std::uint32_t>(ratio);
  const std::uint32_t count = whole < ratio ? whole + 1 : whole;
  return count > 1 ? count : 1;
}

/// `count` times K, to the nearest, halves up.
std::uint32_t refined(std::uint32_t count, double k) {
  const double product = count * k + 0.5;
  if (!(product < kTooMany)) return kTooMany;
  const std::uint32_t rounded = static_cast<std::uint32_t>(product);
  return rounded > 1 ? rounded : 1;
}

double larger(double a, double b) { return a > b ? a : b; }
std::uint32_t larger(std::uint32_t a, std::uint32_t b) { return a > b ? a : b; }

/// The longest edges of a mesh's cells along u and along v; for a triangle both the longest of all.
struct Edges {
  double u = 0, v = 0;
};

Edges longest_edges(const Scene& scene, const Mesh& mesh) {
  Edges edges;
  for (std::uint32_t cell = 0; cell < cell_count(mesh); ++cell) {
    const Piece piece = cell_piece(scene, mesh, cell);
    if (mesh.kind == MeshKind::kTriangle) {
      edges.u = edges.v = piece.longest_side();
      continue;
    }
    const Vec3* c = piece.corner;
    const double first = larger(length(c[1] - c[0]), length(c[2] - c[3]));
    const double second = larger(length(c[2] - c[1]), length(c[3] - c[0]));
    // A grid's cell starts along v.
    edges.u = larger(edges.u, mesh.kind == MeshKind::kGrid ? second : first);
    edges.v = larger(edges.v, mesh.kind == MeshKind::kGrid ? first : second);
  }
  return edges;
}

/// Of the box of all vertices.
double diagonal(const Scene& scene) {
  if (scene.vertices.empty()) return 0;
  Vec3 low = scene.vertices[0], high = low;
  for (const Vec3& p : scene.vertices) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  return length(high - low);
}

/// The squared distance of p from a segment.
double distance_squared(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double whole = length_squared(along);
  double t = whole > 0 ? dot(p - a, along) / whole : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return length_squared(p - (a + t * along));
}

/// The squared distance of p from a triangle: to its plane if p is above it, else to its edges.
double distance_squared(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a);
  const bool above = dot(cross(b - a, p - a), normal) > 0 && dot(cross(c - b, p - b), normal) > 0 &&
                     dot(cross(a - c, p - c), normal) > 0;
  if (above) {
    const double height = dot(p - a, unit_vector(normal));
    return height * height;
  }
  double least = distance_squared(p, a, b);
  for (const double other : {distance_squared(p, b, c), distance_squared(p, c, a)}) {
    if (other < least) least = other;
  }
  return least;
}

double distance_squared(const Vec3& p, const Piece& cell) {
  const std::uint32_t k = cell.concave ? 1 : 0;
  const Vec3* c = cell.corner;
  const double first = distance_squared(p, c[k], c[k + 1], c[k + 2]);
  if (cell.corners == 3) return first;
  const double second = distance_squared(p, c[k], c[k + 2], c[(k + 3) % 4]);
  return first < second ? first : second;
}

/// Distance from a mesh to the nearest light with a place; infinite if there is none.
double nearest_light(const Scene& scene, const Mesh& mesh) {
  double least = kInfinity;
  for (const Light& light : scene.lights) {
    const bool itself = light.kind == LightKind::kPolyhedron && light.object == mesh.object;
    if (light.kind == LightKind::kSun || itself) continue;
    for (std::uint32_t cell = 0; cell < cell_count(mesh); ++cell) {
      const double squared = distance_squared(light.position, cell_piece(scene, mesh, cell));
      if (squared < least) least = squared;
    }
  }
  return square_root(least);
}

/// Sub-patches along a patch's edge.
std::uint32_t sub_pieces(double patch_edge, double size, double distance) {
  const std::uint32_t wanted =
      size > 0 ? pieces(patch_edge, size) : static_cast<std::uint32_t>(kSubPatchesAPatch);
  std::uint32_t near = kMostNearLights;
  if (distance > 0) near = pieces(patch_edge, distance / kSubPatchesADistance);
  return larger(wanted, near < kMostNearLights ? near : kMostNearLights);
}

void decide_patches(const Scene& scene, const Options& options, double most, Mesh& mesh) {
  if (mesh.kind == MeshKind::kGrid) {
    const std::uint32_t per_cell = refined(1, options.refine);
    mesh.nu = per_cell > kMostPieces / mesh.cells_u ? kTooMany : mesh.cells_u * per_cell;
    mesh.nv = per_cell > kMostPieces / mesh.cells_v ? kTooMany : mesh.cells_v * per_cell;
    return;
  }
  if (mesh.nu == 0) {
    const Edges edges = longest_edges(scene, mesh);
    mesh.nu = pieces(edges.u, most);
    mesh.nv = pieces(edges.v, most);
  }
  mesh.nu = refined(mesh.nu, options.refine);
  mesh.nv = refined(mesh.nv, options.refine);
  if (mesh.cut) mesh.nu = mesh.nv = larger(mesh.nu, mesh.nv);
}

void decide_sub_patches(const Scene& scene, const Options& options, Mesh& mesh) {
  if (mesh.su == 0) {
    const Edges edges = longest_edges(scene, mesh);
    const double distance = nearest_light(scene, mesh);
    mesh.su = sub_pieces(edges.u / (mesh.nu / mesh.cells_u), options.sub_patch_size, distance);
    mesh.sv = sub_pieces(edges.v / (mesh.nv / mesh.cells_v), options.sub_patch_size, distance);
  }
  if (mesh.cut) mesh.su = mesh.sv = larger(mesh.su, mesh.sv);
}

bool fits(const Mesh& mesh, std::uint64_t patches, std::uint64_t sub_patches) {
  if (mesh.nu > kMostPieces || mesh.nv > kMostPieces || mesh.su > kMostPieces || mesh.sv > kMostPieces) return false;
  const std::uint64_t width = std::uint64_t{mesh.nu} * mesh.su, height = std::uint64_t{mesh.nv} * mesh.sv;
  if (width >= kNone || height >= kNone) return false;
  const std::uint64_t all = patches + std::uint64_t{mesh.nu} * mesh.nv;
  return all < kNone && width * height < kNone - sub_patches;
}

bool usable(double size) { return size >= 0 && size <= kLargestNumber; }

bool too_many(const Mesh& mesh, const Wanted& which, Status& status, Wanted& wanted) {
  status.code = StatusCode::kScene;
  TextBuilder(status.message, sizeof status.message)
      .add("expected at most 65535 pieces along an edge and 2^32 - 2 sub-patches in all, found ")
      .add(mesh.nu).add(" x ").add(mesh.nv).add(" patches of ").add(mesh.su).add(" x ").add(mesh.sv)
      .add(" sub-patches (65536 stands for more)");
  wanted = which;
  return false;
}

/// As those of a quad that stands there.
bool decide_plane(Scene& scene, std::uint32_t p, const Options& options, double most, Status& status, Wanted& wanted) {
  Plane& plane = scene.planes[p];
  Scene alone = scene;
  alone.vertices = plane.corners;
  Mesh mesh;
  mesh.object = kNone;
  mesh.nu = plane.nu;
  mesh.nv = plane.nv;
  mesh.su = plane.su;
  mesh.sv = plane.sv;
  decide_patches(alone, options, most > 0 ? most : diagonal(alone) / kPatchesADiagonal, mesh);
  if (mesh.nu <= kMostPieces && mesh.nv <= kMostPieces) decide_sub_patches(alone, options, mesh);
  if (!fits(mesh, 0, scene.plane_sub_patch_count)) return too_many(mesh, {Wanted::Kind::kPlane, p}, status, wanted);
  plane.nu = mesh.nu;
  plane.nv = mesh.nv;
  plane.su = mesh.su;
  plane.sv = mesh.sv;
  plane.first_sub_patch = scene.plane_sub_patch_count;
  scene.plane_sub_patch_count += plane.sub_patch_count();
  return true;
}

}  // namespace

Status check_count_options(const Options& options) {
  Status status;
  const bool refine = options.refine > 0 && options.refine <= kLargestNumber;
  if (refine && usable(options.patch_size) && usable(options.sub_patch_size)) return status;
  status.code = StatusCode::kUsage;
  MessageText(status.message, sizeof status.message)
      .add("expected --patch and --sub-patch from 0 and --refine above 0, found ")
      .add(options.patch_size).add(", ").add(options.sub_patch_size).add(" and ").add(options.refine);
  return status;
}

bool decide_counts(Scene& scene, const Options& options, Status& status, Wanted& wanted) {
  const double most = options.patch_size > 0 ? options.patch_size : diagonal(scene) / kPatchesADiagonal;
  std::uint64_t patches = 0, sub_patches = 0;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    Mesh& mesh = scene.meshes[m];
    decide_patches(scene, options, most, mesh);
    if (mesh.nu <= kMostPieces && mesh.nv <= kMostPieces) decide_sub_patches(scene, options, mesh);
    if (!fits(mesh, patches, sub_patches)) return too_many(mesh, {Wanted::Kind::kMesh, m}, status, wanted);
    mesh.first_patch = static_cast<std::uint32_t>(patches);
    mesh.first_sub_patch = static_cast<std::uint32_t>(sub_patches);
    patches += mesh.patch_count();
    sub_patches += mesh.sub_patch_count();
  }
  scene.patch_count = static_cast<std::uint32_t>(patches);
  scene.sub_patch_count = static_cast<std::uint32_t>(sub_patches);
  for (std::uint32_t p = 0; p < scene.planes.size(); ++p) {
    if (!decide_plane(scene, p, options, most, status, wanted)) return false;
  }
  return true;
}

}  // namespace shodo
