#include "ambient/gather.h"

#include "ambient/gather_group.h"
#include "base/bits.h"
#include "base/interrupted.h"
#include "light/piece_grid.h"
#include "scene/sub_patches.h"
#include "visibility/hidden.h"

namespace shodo {

namespace {

constexpr std::uint32_t kGridDivisions = 4;
constexpr double kStandardErrors = 3;
constexpr double kLightError = 1.0 / 64;
constexpr std::uint32_t kProgressInterval = 16;
constexpr std::uint32_t kRegionNodes = 31;  // 16 patches

/// Blocks serve whatever the rules are.
Options with_blocks(const Options& options) {
  Options changed = options;
  changed.rules = {};
  changed.rules.blocks = true;
  return changed;
}

class Gather {
 public:
  Gather(const GatherScene& scene, const Options& options, Intersector& intersector, std::span<GatherPoint> points,
         std::span<float> ambient_lx)
      : scene_(scene), options_(options), intersector_(intersector), points_(points), ambient_lx_(ambient_lx),
        group_(scene) {}

  // Not inlined: the stack of one is needed while the others' isn't.
  [[gnu::noinline]] void patch(std::uint32_t node, std::uint32_t place);

 private:
  [[gnu::noinline]] bool place_point(std::uint32_t mesh_index, std::uint32_t cell, std::uint32_t local, bool thin,
                                     GatherPoint& point);
  [[gnu::noinline]] bool move_into_view(std::uint32_t mesh_index, std::uint32_t cell, const Vec3& normal,
                                        const PieceGrid& grid, GatherPoint& point);
  [[gnu::noinline]] void finish(std::uint32_t node, std::uint32_t place, std::uint32_t count);
  double scale_of(const GatherPoint& point) const;

  const GatherScene& scene_;
  const Options& options_;
  Intersector& intersector_;
  std::span<GatherPoint> points_;
  std::span<float> ambient_lx_;
  GatherGroup group_;
};

/// False if it is hidden.
bool Gather::place_point(std::uint32_t mesh_index, std::uint32_t cell, std::uint32_t local, bool thin,
                         GatherPoint& point) {
  const Surfaces& s = scene_.surfaces;
  const Mesh& mesh = s.scene->meshes[mesh_index];
  const std::uint32_t index = mesh.first_sub_patch + local;
  if (!scene_.direct.hidden.empty() && scene_.direct.hidden[index] != 0) return false;
  const Piece piece = sub_patch_piece(*s.scene, mesh, local);
  point = {};
  point.sub_patch = index;
  point.offset = piece.centre();
  point.side_squared = piece.longest_side() * piece.longest_side();
  const PieceGrid grid(piece, kGridDivisions, thin);
  for (std::uint32_t k = 0; k < 4; ++k) {
    point.place[k] = grid.point_at(grid.gauss(k));
    point.from[k] = sample_point(*s.scene, *s.geometry, mesh_index, cell, point.place[k]);
  }
  return move_into_view(mesh_index, cell, normalised(piece.vector_area()), grid, point);
}

/// Places inside something move to where the sub-patch is seen: the middles of four equal parts of its samples that
/// are, in their order. Of an even number the one before the middle in the outer parts, the one behind it in the inner
/// ones, so that the four have the mean of all along rows and columns. False if none is seen.
bool Gather::move_into_view(std::uint32_t mesh_index, std::uint32_t cell, const Vec3& normal, const PieceGrid& grid,
                            GatherPoint& point) {
  if (hidden_samples(intersector_, point.from, normal) == 0) return true;
  const Surfaces& s = scene_.surfaces;
  constexpr std::uint32_t kSamples = kGridDivisions * kGridDivisions;
  static_assert(kSamples == kMostHiddenSamples);
  LatticePoint lattice[kSamples];
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    lattice[k] = sample_point(*s.scene, *s.geometry, mesh_index, cell, grid.point(k));
  }
  const std::uint32_t seen = ~hidden_samples(intersector_, lattice, normal) & ((1u << kSamples) - 1);
  const std::uint32_t count = count_bits(seen);
  std::uint32_t at = 0, next = 0;
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    if ((seen >> k & 1) == 0) continue;
    for (; next < 4 && at == ((2 * next + 1) * count - (next % 3 == 0 ? 1 : 0)) / 8; ++next) {
      point.place[next] = grid.point(k);
      point.from[next] = lattice[k];
    }
    ++at;
  }
  point.offset = 0.25 * ((point.place[0] + point.place[1]) + (point.place[2] + point.place[3]));
  return count > 0;
}

/// As rows are scaled (ambient/matrix.h).
double Gather::scale_of(const GatherPoint& point) const {
  const double given = scene_.direct.sub_patch_factor.empty()
                           ? 0
                           : static_cast<double>(scene_.direct.sub_patch_factor[point.sub_patch]) * (1.0 / 65535);
  const double lights = given < 1 ? given : 1, missing = 1 - lights - point.factor;
  const double unsure = point.geometry_error + kStandardErrors * square_root(point.variance) + kLightError * lights;
  if (!options_.scale_rows || !(point.factor > 0) || missing > unsure) return 1;
  return (1 - lights) / point.factor;
}

void Gather::finish(std::uint32_t node, std::uint32_t place, std::uint32_t count) {
  const std::uint32_t channels = scene_.surfaces.scene->channels;
  group_.gather(node, place, points_.first(count));
  for (const GatherPoint& point : points_.first(count)) {
    const double scale = scale_of(point);
    for (std::uint32_t c = 0; c < channels; ++c) {
      const double lx = scale * point.lx[c];
      ambient_lx_[std::size_t{point.sub_patch} * channels + c] = lx > 0 ? static_cast<float>(lx) : 0.0f;
    }
  }
}

void Gather::patch(std::uint32_t node, std::uint32_t place) {
  const Surfaces& s = scene_.surfaces;
  const std::uint32_t mesh_index = s.mesh_at[place], local = s.local(node);
  const Mesh& mesh = s.scene->meshes[mesh_index];
  const std::uint32_t cell = cell_of_patch(mesh, local);
  const bool thin = s.patch(node).thin != 0;
  SubPatchesOfPatch parts(mesh, local);
  std::uint32_t count = 0;
  for (std::uint32_t k = parts.next(); k != kNone; k = parts.next()) {
    if (place_point(mesh_index, cell, k, thin, points_[count])) ++count;
    if (count < kMostTogether) continue;
    finish(node, place, count);
    count = 0;
  }
  if (count > 0) finish(node, place, count);
}

constexpr std::uint64_t block(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

Status gather_illuminance(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                          const DirectLight& direct, const AmbientLight& ambient, Intersector& intersector,
                          const Options& options, const Progress& progress, Arena& arena, std::span<float> ambient_lx,
                          Statistics& statistics) {
  const ArenaScratch release(arena);
  const Options changed = with_blocks(options);
  Surfaces surfaces;
  Status status = gather_surfaces(scene, geometry, patches, direct, changed, arena, surfaces,
                                  patches.empty() ? SurfacesKeep::kNothing : SurfacesKeep::kGeometry);
  if (!status.done()) return status;
  GatherSenders senders;
  status = senders.take(arena, surfaces, direct, ambient, ambient_lx);
  if (!status.done()) return status;
  const IntersectorScratch seeking(intersector);
  if (!intersector.start(arena)) return arena.refused();
  GatherLists lists(intersector);
  status = lists.take(arena, surfaces);
  if (!status.done()) return status;
  std::span<GatherPoint> points;
  if (!arena.take("sub-patches that gather", kMostTogether, points)) return arena.refused();
  const double error = options.gather_error > 0 ? options.gather_error : kGatherError;
  double area = 0;
  for (std::uint32_t node = 0; node < surfaces.size(); ++node) {
    if (!surfaces.is_block(node)) area += surfaces.root_area[node] * surfaces.root_area[node];
  }
  const GatherScene shared{surfaces, direct, ambient_lx, senders, lists, error, area / scene.patch_count};
  Gather gather(shared, options, intersector, points, ambient_lx);
  std::uint32_t done = 0;
  for (std::uint32_t k = 0; k < surfaces.mesh_at.size(); ++k) {
    std::uint32_t region_end = surfaces.mesh_begin[k];
    for (std::uint32_t node = surfaces.mesh_begin[k]; node < surfaces.mesh_begin[k + 1]; ++node) {
      const bool block = surfaces.is_block(node);
      if (node >= region_end && (!block || surfaces.end(node) - node <= kRegionNodes)) {
        lists.start_region(k, node);
        region_end = block ? surfaces.end(node) : surfaces.mesh_begin[k + 1];
      }
      if (block) continue;
      if (done++ % kProgressInterval == 0 && !progress.go_on(Stage::kSolution, done, scene.patch_count)) {
        return interrupted();
      }
      if (surfaces.root_area[node] > 0) gather.patch(node, k);
    }
  }
  statistics.segments_ambient = intersector.segments(LightSet::kAmbient);
  statistics.tests_ambient = intersector.tests(LightSet::kAmbient);
  return status;
}

std::uint64_t gather_bytes(const Scene& scene, const Geometry& geometry, const Options& options, SurfacesKeep keep) {
  const Options changed = with_blocks(options);
  return surfaces_bytes(scene, changed, keep) + GatherSenders::bytes(scene, changed.rules) +
         Intersector::bytes(geometry, options.flags) + GatherLists::bytes(scene, geometry, options.flags) +
         block(sizeof(GatherPoint) * kMostTogether);
}

}  // namespace shodo
