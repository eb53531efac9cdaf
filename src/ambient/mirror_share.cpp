#include "ambient/mirror_share.h"

#include "ambient/coloured_panes.h"
#include "light/piece_grid.h"
#include "visibility/half_open.h"

namespace shodo {

namespace {

constexpr std::uint32_t kRounds = 2;
constexpr std::uint32_t kPoints = 4;

bool shares(const Scene& scene, const Options& options) {
  for (const Optics& optics : scene.optics) {
    if (options.mirror_light && optics.mirrors()) return true;
  }
  return false;
}

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
  const Rgb& rho = scene_.materials[scene_.meshes[m].material].diffuse;
  bool any = false;
  for (std::uint32_t c = 0; c < scene_.channels; ++c) {
    sent[c] = rho.c[c] * (direct_.patch_lx[first + c] + ambient_lx_[first + c]);
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

/// Of all patches, into `share`.
Status gather_all(MirrorShare& mirrors, const Scene& scene, const Progress& progress, std::span<double> share) {
  Status status;
  for (double& value : share) value = 0;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    for (std::uint32_t local = 0; local < scene.meshes[m].patch_count(); ++local) {
      const std::uint32_t i = scene.meshes[m].first_patch + local;
      if (!progress.go_on(Stage::kFormFactors, i, scene.patch_count)) {
        status.code = StatusCode::kInterrupted;
        return status;
      }
      mirrors.gather(m, local, &share[std::size_t{i} * scene.channels]);
    }
  }
  return status;
}

}  // namespace

Status light_ambiently_with_optics(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                                   const DirectLight& direct, Intersector& intersector, const Options& options,
                                   const Progress& progress, Arena& arena, AmbientLight& ambient,
                                   Statistics& statistics) {
  if (!shares(scene, options)) {
    return light_ambiently_through_panes(scene, geometry, patches, direct, intersector, options, progress, arena,
                                         ambient, statistics);
  }
  const std::size_t values = std::size_t{scene.patch_count} * scene.channels;
  if (!arena.take("ambient illuminance with mirrors", values, ambient.patch_lx)) return arena.refused();
  const ArenaScratch scratch(arena);
  std::span<double> share;
  if (!arena.take("light over mirrors", values, share)) return arena.refused();
  for (std::uint32_t round = 0;; ++round) {
    const ArenaScratch round_scratch(arena);
    DirectLight lit = direct;
    if (!arena.take("first light and that over mirrors", values, lit.patch_lx)) return arena.refused();
    for (std::size_t k = 0; k < values; ++k) lit.patch_lx[k] = direct.patch_lx[k] + share[k];
    AmbientLight solved;
    Status status = light_ambiently_through_panes(scene, geometry, patches, lit, intersector, options, progress, arena,
                                                  solved, statistics);
    if (!status.done()) return status;
    for (std::size_t k = 0; k < values; ++k) ambient.patch_lx[k] = solved.patch_lx[k] + share[k];
    if (round == kRounds) return status;
    const IntersectorScratch seeking(intersector);
    if (!intersector.start(arena)) return arena.refused();
    MirrorShare mirrors(scene, geometry, patches, direct, ambient.patch_lx, intersector);
    status = gather_all(mirrors, scene, progress, share);
    if (!status.done()) return status;
  }
}

std::uint64_t mirror_share_bytes(const Scene& scene, const Options& options) {
  return shares(scene, options) ? 24 * std::uint64_t{scene.patch_count} * scene.channels : 0;
}

}  // namespace shodo
