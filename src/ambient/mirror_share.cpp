#include "ambient/mirror_share.h"

#include "base/interrupted.h"
#include "light/piece_grid.h"
#include "scene/patch_reflectance.h"
#include "visibility/half_open.h"

namespace shodo {

namespace {

constexpr std::uint32_t kPoints = 4;

/// A patch's Gauss points.
struct PatchPoints {
  Patch patch;
  std::uint32_t object = 0;
  Vec3 at[kPoints];
  LatticePoint lattice[kPoints];
  double weight[kPoints] = {};  // sum 1
};

class MirrorShare {
 public:
  MirrorShare(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches, const DirectLight& direct,
              std::span<const double> ambient_lx, Intersector& intersector)
      : scene_(scene),
        geometry_(geometry),
        patches_(patches),
        direct_(direct),
        ambient_lx_(ambient_lx),
        intersector_(intersector) {}

  /// Adds what the patch gets over all mirrors, lux by channel.
  void gather(std::uint32_t mesh, std::uint32_t local, double* lux);

 private:
  bool points_of(std::uint32_t mesh, std::uint32_t local, PatchPoints& points) const;
  void gather_from(const PatchPoints& i, const PatchPoints& j, const double (&sent)[3], double* lux);
  void gather_over(const PatchPoints& i, const PatchPoints& j, std::uint32_t mesh, std::uint32_t cell,
                   std::uint32_t triangle, double (&factor)[3]);
  bool sent_by(std::uint32_t mesh, std::uint32_t local, double (&sent)[3]) const;

  const Scene& scene_;
  const Geometry& geometry_;
  std::span<const Patch> patches_;
  const DirectLight& direct_;
  std::span<const double> ambient_lx_;
  Intersector& intersector_;
};

/// False if the patch takes no part.
bool MirrorShare::points_of(std::uint32_t m, std::uint32_t local, PatchPoints& points) const {
  const Mesh& mesh = scene_.meshes[m];
  points.patch = patches_.empty() ? make_patch(scene_, geometry_, m, local) : patches_[mesh.first_patch + local];
  if (points.patch.dropped != 0) return false;
  points.object = mesh.object;
  const std::uint32_t cell = cell_of_patch(mesh, local);
  const Piece piece = patch_piece(scene_, mesh, local);
  const PieceGrid grid(piece, 2, points.patch.thin != 0);
  double total = 0;
  for (std::uint32_t k = 0; k < kPoints; ++k) total += grid.weight_at(grid.gauss(k));
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    points.at[k] = grid.point_at(grid.gauss(k));
    points.lattice[k] = sample_point(scene_, geometry_, m, cell, points.at[k]);
    points.weight[k] = grid.weight_at(grid.gauss(k)) / total;
  }
  return true;
}

/// rho E; false if it is nothing.
bool MirrorShare::sent_by(std::uint32_t m, std::uint32_t local, double (&sent)[3]) const {
  const std::size_t first = (std::size_t{scene_.meshes[m].first_patch} + local) * scene_.channels;
  double room[3];
  const double* const rho = MeshReflectance(scene_, m).of(local, room);
  bool any = false;
  for (std::uint32_t c = 0; c < scene_.channels; ++c) {
    sent[c] = rho[c] * (direct_.patch_lx[first + c] + ambient_lx_[first + c]);
    any = any || sent[c] > 0;
  }
  return any;
}

void MirrorShare::gather(std::uint32_t m, std::uint32_t local, double* lux) {
  PatchPoints i, j;
  if (!points_of(m, local, i)) return;
  for (std::uint32_t other = 0; other < scene_.meshes.size(); ++other) {
    for (std::uint32_t k = 0; k < scene_.meshes[other].patch_count(); ++k) {
      double sent[3];
      if (sent_by(other, k, sent) && points_of(other, k, j)) gather_from(i, j, sent, lux);
    }
  }
}

void MirrorShare::gather_from(const PatchPoints& i, const PatchPoints& j, const double (&sent)[3], double* lux) {
  double factor[3] = {0, 0, 0};
  for (std::uint32_t m = 0; m < scene_.meshes.size(); ++m) {
    const Optics* const optics = scene_.optics_of(scene_.meshes[m].material);
    if (optics == nullptr || !optics->mirrors()) continue;
    for (std::uint32_t cell = 0; cell < cell_count(scene_.meshes[m]); ++cell) {
      const PolygonTriangles range = geometry_.cells[geometry_.first_cell[m] + cell];
      for (std::uint32_t t = range.first; t < range.first + range.count; ++t) gather_over(i, j, m, cell, t, factor);
    }
  }
  for (std::uint32_t c = 0; c < scene_.channels; ++c) lux[c] += factor[c] * sent[c];
}

/// Adds the form factor from i to the image of j, seen through the triangle, times what the mirror reflects.
void MirrorShare::gather_over(const PatchPoints& i, const PatchPoints& j, std::uint32_t mesh, std::uint32_t cell,
                              std::uint32_t triangle, double (&factor)[3]) {
  const Triangle& mirror = geometry_.triangles[triangle];
  const Vec3 normal = normalised(
      {static_cast<double>(mirror.n.x), static_cast<double>(mirror.n.y), static_cast<double>(mirror.n.z)});
  const Vec3 corner = scene_point(geometry_.lattice, mirror.a);
  const std::uint32_t object = scene_.meshes[mesh].object;
  const Rgb& reflect = scene_.optics_of(scene_.meshes[mesh].material)->reflect;
  const Vec3 turned = j.patch.normal - (2 * dot(normal, j.patch.normal)) * normal;
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    const double height = dot(normal, i.at[k] - corner);
    if (!(height > 0)) continue;
    for (std::uint32_t l = 0; l < kPoints; ++l) {
      const double other = dot(normal, j.at[l] - corner);
      if (!(other > 0)) continue;
      const Vec3 way = j.at[l] - (2 * other) * normal - i.at[k];
      const double cosines = dot(i.patch.normal, way), leaves = -dot(turned, way);
      if (!(cosines > 0) || !(leaves > 0)) continue;
      if (!passes(mirror, i.lattice[k], lattice_direction(way))) continue;
      const LatticePoint at =
          sample_point(scene_, geometry_, mesh, cell, i.at[k] + (height / (height + other)) * way);
      if (intersector_.blocked(i.lattice[k], at, {object, i.object, LightSet::kAmbient}) ||
          intersector_.blocked(at, j.lattice[l], {j.object, object, LightSet::kAmbient})) {
        continue;
      }
      const double squared = length_squared(way);
      const double kernel = kInversePi * cosines * leaves / (squared * squared);
      const double part = i.weight[k] * j.weight[l] * j.patch.area * kernel;
      for (std::uint32_t c = 0; c < scene_.channels; ++c) {
        intersector_.set_channel(c);
        const Panes& panes = intersector_.panes();
        const double weak = panes.any() ? panes.pass(i.lattice[k], at) * panes.pass(at, j.lattice[l]) : 1;
        factor[c] += part * reflect.c[c] * weak;
      }
      intersector_.set_channel(0);
    }
  }
}

}  // namespace

bool mirrors_share(const Scene& scene, const Options& options) {
  for (const Optics& optics : scene.optics) {
    if (options.mirror_light && optics.mirrors()) return true;
  }
  return false;
}

Status share_over_mirrors(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                          const DirectLight& direct, const AmbientLight& ambient, Intersector& intersector,
                          const Progress& progress, Arena& arena, std::span<double> share_lx) {
  const ArenaScratch scratch(arena);
  const IntersectorScratch seeking(intersector);
  if (!intersector.start(arena)) return arena.refused();
  MirrorShare mirrors(scene, geometry, patches, direct, ambient.patch_lx, intersector);
  for (double& value : share_lx) value = 0;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    for (std::uint32_t local = 0; local < scene.meshes[m].patch_count(); ++local) {
      const std::uint32_t i = scene.meshes[m].first_patch + local;
      if (!progress.go_on(Stage::kFormFactors, i, scene.patch_count)) return interrupted();
      mirrors.gather(m, local, &share_lx[std::size_t{i} * scene.channels]);
    }
  }
  return {};
}

}  // namespace shodo
