// Direct illuminance (paper 2.1): every sub-patch, and the sums over a patch that the ambient stage starts from.
//
// Patches ascending, within a patch its sub-patches ascending, within a sub-patch the lights as the file has them: sums
// are doubles in this order. E0 of a patch is the area-weighted mean over its sub-patches that are not hidden
// (deviation D4). Bytes left: 4 channels + 1 a sub-patch, 8 channels + 8 a patch; scratch as light/sources.h says. The
// ambient stage wants the patches only, so sub-patches lie in spare blocks; if it takes those they are lit once more.
#include "light/direct.h"

#include "base/finite.h"
#include "base/interrupted.h"
#include "light/mirror_light.h"
#include "light/piece_grid.h"
#include "light/receiver.h"
#include "light/sources.h"
#include "light/sub_patch_light.h"
#include "scene/sub_patches.h"

namespace shodo {

namespace {

constexpr std::uint32_t kProgressInterval = 64;
constexpr double kThinSteps = 32;
/// Of so many the factors of lights are interpolated over the patch (light/factor_field.h).
constexpr std::uint32_t kManySubPatches = 3;
/// Lattice steps, more than samples on a flat front come to lie outside the patch's corners.
constexpr std::int32_t kRounding = 8;
/// Corners of a cell this near to one plane, of its size, are on it but for rounding.
constexpr double kPlane = 0x1p-40;

/// Of the last sub-patch on a quadrilateral.
PatchPlace place_of(const Mesh& mesh, const SubPatchesOfPatch& at) {
  const double s = 1.0 / mesh.su, t = 1.0 / mesh.sv;
  return {(at.column() + 0.5) * s - 0.5, (at.row() + 0.5) * t - 0.5, 0.5 * s, 0.5 * t};
}

/// Whether a piece is under 32 lattice steps wide, so that rounding moves its samples noticeably.
bool is_thin(const Geometry& geometry, const Piece& piece) {
  const double width = (piece.corners == 3 ? 2 : 1) * length(piece.vector_area());
  return !(geometry.lattice.steps_per_unit * width >= kThinSteps * piece.longest_side());
}

/// The plane of the cell if it is plane, so that all its sub-patches agree on what is in front; else the sub-patch's
/// own.
Receiver receiver_of(const Scene& scene, std::uint32_t mesh, std::uint32_t cell, const Piece& sub_patch) {
  Receiver receiver;
  receiver.mesh = mesh;
  receiver.cell = cell;
  receiver.object = scene.meshes[mesh].object;
  const Piece whole = cell_piece(scene, scene.meshes[mesh], cell);
  receiver.normal = normalised(whole.vector_area());
  receiver.anchor = whole.corner[0];
  const double size = kPlane * whole.longest_side();
  for (std::uint32_t k = 1; k < whole.corners; ++k) {
    const double off = receiver.height(whole.corner[k]);
    if (off <= size && -off <= size) continue;
    receiver.normal = normalised(sub_patch.vector_area());
    receiver.anchor = sub_patch.centre();
    break;
  }
  return receiver;
}

/// Sums over a patch's sub-patches, weighted by area.
struct PatchSums {
  double lux[3] = {0, 0, 0};
  double light_factor = 0;
  double area = 0;
  double visible_area = 0;
};

class DirectStage {
 public:
  DirectStage(const Scene& scene, const Geometry& geometry, const Options& options, Sources& sources,
              MirrorLight& mirrors, DirectLight& direct)
      : scene_(scene),
        geometry_(geometry),
        sources_(sources),
        mirrors_(mirrors),
        direct_(direct),
        parts_count_(options.scale_rows),
        coloured_(sources.intersector().panes().coloured()) {}

  /// False if the progress callback asked to stop.
  bool light_patch(std::uint32_t mesh, std::uint32_t local, const Progress& progress);

 private:
  void start_patch(std::uint32_t mesh, std::uint32_t cell, std::uint32_t local);
  void light_one(std::uint32_t mesh, std::uint32_t cell, std::uint32_t local, const PatchPlace& place,
                 PatchSums& sums);
  void store(std::uint32_t patch, const PatchSums& sums);

  const Scene& scene_;
  const Geometry& geometry_;
  Sources& sources_;
  MirrorLight& mirrors_;
  DirectLight& direct_;
  /// Parts of sub-patches count in visible areas. A row divided by a small one comes out above 1 if its segments see
  /// more than that: scaled down it does no harm, else light would grow from sweep to sweep.
  bool parts_count_;
  bool coloured_;  // panes: every channel by itself
  std::uint32_t done_ = 0;
  FlatFront front_;  // of the patch at work
};

bool DirectStage::light_patch(std::uint32_t m, std::uint32_t local, const Progress& progress) {
  const Mesh& mesh = scene_.meshes[m];
  const std::uint32_t cell = cell_of_patch(mesh, local);
  SubPatchesOfPatch sub_patches(mesh, local);
  PatchSums sums;
  start_patch(m, cell, local);
  for (std::uint32_t k = sub_patches.next(); k != kNone; k = sub_patches.next()) {
    if (done_ % kProgressInterval == 0 && !progress.go_on(Stage::kDirect, done_, scene_.sub_patch_count)) return false;
    light_one(m, cell, k, place_of(mesh, sub_patches), sums);
    ++done_;
  }
  store(mesh.first_patch + local, sums);
  return true;
}

/// A box for the samples of all sub-patches: they lie between those of the corners but for rounding, and on a flat
/// front in one plane with them.
void DirectStage::start_patch(std::uint32_t m, std::uint32_t cell, std::uint32_t local) {
  front_ = flat_front(geometry_, m, cell);
  const Mesh& mesh = scene_.meshes[m];
  const Piece piece = patch_piece(scene_, mesh, local);
  LatticeBox box;
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    box.include(sample_point(scene_, geometry_, m, cell, piece.corner[k]));
  }
  const std::int32_t margin = front_.flat() ? kRounding : 2 * kMostMoved;
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (k == front_.axis) continue;
    box.low[k] -= margin;
    box.high[k] += margin;
  }
  if (front_.flat()) {  // no sample is nearer to the plane than one step
    const std::int32_t nearest = front_.plane + front_.way;
    std::int32_t &low = box.low[front_.axis], &high = box.high[front_.axis];
    low = front_.way > 0 ? nearest : low - 2;
    high = front_.way > 0 ? high + 2 : nearest;
  }
  sources_.start_patch(box, true);
  if (mesh.su * mesh.sv >= kManySubPatches && PieceGrid(cell_piece(scene_, mesh, cell), 1).affine()) {
    sources_.share_factors(receiver_of(scene_, m, cell, piece), piece);
  }
}

void DirectStage::light_one(std::uint32_t m, std::uint32_t cell, std::uint32_t local, const PatchPlace& place,
                            PatchSums& sums) {
  const Mesh& mesh = scene_.meshes[m];
  const Piece piece = sub_patch_piece(scene_, mesh, local);
  const double area = length(piece.vector_area());
  sums.area += area;
  if (!(area > 0)) return;
  Receiver receiver = receiver_of(scene_, m, cell, piece);
  receiver.front = front_;
  receiver.place = place;
  SubPatchLight light = light_sub_patch(sources_, receiver, piece, is_thin(geometry_, piece));
  for (std::uint32_t c = 1; c < scene_.channels && coloured_; ++c) {
    sources_.intersector().set_channel(c);
    light.lux[c] = light_sub_patch(sources_, receiver, piece, is_thin(geometry_, piece)).lux[c];
    if (c == 2) sources_.intersector().set_channel(0);
  }
  if (mirrors_.any() && !light.hidden) mirrors_.add(receiver, piece, is_thin(geometry_, piece), light.lux);
  const std::uint32_t index = mesh.first_sub_patch + local;
  if (light.hidden) {
    if (!direct_.hidden.empty()) direct_.hidden[index] = 1;
    return;
  }
  const double visible = parts_count_ ? area * light.visible : area;
  sums.visible_area += visible;
  for (std::uint32_t c = 0; c < scene_.channels; ++c) {
    const double lux = finite(light.lux[c]);
    if (!direct_.sub_patch_lx.empty()) direct_.sub_patch_lx[index * scene_.channels + c] = static_cast<float>(lux);
    sums.lux[c] += visible * lux;
  }
  sums.light_factor += visible * light.light_factor;
}

void DirectStage::store(std::uint32_t patch, const PatchSums& sums) {
  if (!(sums.visible_area > 0)) return;
  for (std::uint32_t c = 0; c < scene_.channels; ++c) {
    direct_.patch_lx[patch * scene_.channels + c] = sums.lux[c] / sums.visible_area;
  }
  direct_.visible_area[patch] = static_cast<float>(sums.visible_area / sums.area);
  direct_.light_form_factor[patch] = static_cast<float>(sums.light_factor / sums.visible_area);
}

bool take_patches(const Scene& scene, Arena& arena, DirectLight& direct) {
  const std::size_t patches = scene.patch_count;
  return arena.take("direct illuminance of patches", patches * scene.channels, direct.patch_lx) &&
         arena.take("visible areas", patches, direct.visible_area) &&
         arena.take("form factors to lights", patches, direct.light_form_factor);
}

bool take_sub_patches(const Scene& scene, Arena& arena, DirectLight& direct) {
  return arena.take("direct illuminance", std::size_t{scene.sub_patch_count} * scene.channels, direct.sub_patch_lx) &&
         arena.take("hidden sub-patches", scene.sub_patch_count, direct.hidden);
}

/// All or none.
void take_spare_sub_patches(const Scene& scene, Arena& arena, DirectLight& direct) {
  const std::uint32_t before = arena.spares();
  const std::size_t values = std::size_t{scene.sub_patch_count} * scene.channels;
  if (arena.take_spare("direct illuminance", values, direct.sub_patch_lx) &&
      arena.take_spare("hidden sub-patches", scene.sub_patch_count, direct.hidden)) {
    return;
  }
  arena.release_spares(before);
  direct.sub_patch_lx = {};
  direct.hidden = {};
}

constexpr std::uint64_t block(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

Status light_directly(const Scene& scene, const Geometry& geometry, std::span<const Patch> patches,
                      const Options& options, Intersector& intersector, const Progress& progress, Arena& arena,
                      DirectLight& direct, Statistics& statistics, DirectKeeps keeps) {
  const bool first = keeps == DirectKeeps::kPatches;
  if (!(first ? take_patches(scene, arena, direct) : take_sub_patches(scene, arena, direct))) {
    return arena.refused();
  }
  const ArenaScratch scratch(arena);
  const IntersectorScratch seeking(intersector);
  if (!intersector.start(arena, Rectangles::kWhole)) return arena.refused();
  Sources sources(scene, geometry, intersector, options.tiers);
  const Status status = sources.prepare(arena);
  if (!status.done()) return status;
  MirrorLight mirrors(sources);
  if (options.mirror_light && !mirrors.take(arena)) return arena.refused();
  if (first) take_spare_sub_patches(scene, arena, direct);
  if (!intersector.take_masks(arena)) return arena.refused();
  DirectStage stage(scene, geometry, options, sources, mirrors, direct);
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    for (std::uint32_t local = 0; local < scene.meshes[m].patch_count(); ++local) {
      const std::uint32_t patch = scene.meshes[m].first_patch + local;
      if ((patches.empty() ? make_patch(scene, geometry, m, local) : patches[patch]).dropped != 0) continue;
      if (!stage.light_patch(m, local, progress)) return interrupted();
    }
  }
  statistics.lights_clamped = sources.clamped();
  statistics.segments_direct = intersector.segments(LightSet::kDirect);
  statistics.tests_direct = intersector.tests(LightSet::kDirect);
  return {};
}

std::uint64_t direct_patch_bytes(const Scene& scene) {
  const std::uint64_t n = scene.patch_count;
  return block(8 * n * scene.channels) + 2 * block(4 * n);
}

std::uint64_t direct_sub_patch_bytes(const Scene& scene) {
  const std::uint64_t s = scene.sub_patch_count;
  return block(4 * s * scene.channels) + block(s);
}

}  // namespace shodo
