#include "map/illuminance_map.h"

#include "base/finite.h"
#include "map/parabolic.h"
#include "map/triangle_spread.h"

namespace shodo {

namespace {

/// Passes over a mesh with partly hidden patches.
constexpr std::uint32_t kHiddenPasses = 3;

constexpr std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

/// One mesh and channel at a time; sized for the mesh that needs most.
struct Scratch {
  std::span<double> patch;        // lux; extrapolated where a patch has no value
  std::span<double> inner;        // quads and grids: spread along u; triangles: values of corners, then of sub-patches
  std::span<double> lacking;      // of partly hidden patches: lux that the visible sub-patches lack, summed
  std::span<std::uint32_t> seen;  // sub-patches that are not hidden
  std::span<std::uint8_t> known;  // 1: the patch has a value; 2: it got one in this pass; 0: none yet
};

struct ScratchSize {
  std::uint64_t patches = 0, inner = 0;
};

ScratchSize scratch_size(const Scene& scene) {
  ScratchSize size;
  for (const Mesh& mesh : scene.meshes) {
    const std::uint64_t patches = mesh.patch_count();
    const std::uint64_t inner = mesh.kind == MeshKind::kTriangle
                                    ? std::uint64_t{triangle_scratch(mesh.nu)} + mesh.sub_patch_count()
                                    : std::uint64_t{mesh.map_width()} * mesh.nv;
    if (patches > size.patches) size.patches = patches;
    if (inner > size.inner) size.inner = inner;
  }
  return size;
}

/// What one mesh is spread from and to.
struct MeshMap {
  const Scene& scene;
  const Mesh& mesh;
  const AmbientLight& ambient;
  IlluminanceMaps& maps;

  /// Ambient illuminance, lux; never below 0.
  double patch_lx(std::uint32_t local, std::uint32_t c) const {
    const double lx = ambient.patch_lx[(std::size_t{mesh.first_patch} + local) * scene.channels + c];
    return lx > 0 ? lx : 0;
  }
  bool hidden(std::uint32_t local) const {
    return !maps.hidden.empty() && maps.hidden[std::size_t{mesh.first_sub_patch} + local] != 0;
  }
  float& sub_patch_lx(std::uint32_t local, std::uint32_t c) const {
    return maps.ambient_lx[(std::size_t{mesh.first_sub_patch} + local) * scene.channels + c];
  }
  void set(std::uint32_t local, std::uint32_t c, double lx) const {
    sub_patch_lx(local, c) = hidden(local) ? 0.0f : static_cast<float>(finite(lx));
  }
};

/// A patch beside another, and the next one in the same direction; kNone beyond the border.
struct Beside {
  std::uint32_t near = kNone, far = kNone;
};

std::uint32_t step_u(const Mesh& mesh, std::uint32_t u, bool up) {
  if (mesh.wraps_u) return up ? (u + 1 == mesh.nu ? 0 : u + 1) : (u == 0 ? mesh.nu - 1 : u - 1);
  return up ? (u + 1 < mesh.nu ? u + 1 : kNone) : (u > 0 ? u - 1 : kNone);
}

std::uint32_t beside_in_triangle(const Mesh& mesh, const PieceIndex& at, std::uint32_t side) {
  const std::uint32_t k = mesh.nu;
  if (at.inverted) {
    if (side == 0) return triangle_piece_order(k, {at.u, at.v, false});
    if (side == 1) return triangle_piece_order(k, {at.u + 1, at.v, false});
    return triangle_piece_order(k, {at.u, at.v + 1, false});
  }
  if (side == 0) return at.u + at.v + 1 < k ? triangle_piece_order(k, {at.u, at.v, true}) : kNone;
  if (side == 1) return at.u > 0 ? triangle_piece_order(k, {at.u - 1, at.v, true}) : kNone;
  return at.v > 0 ? triangle_piece_order(k, {at.u, at.v - 1, true}) : kNone;
}

/// Side 0 to 3: of quads and grids up and down in u, then in v; of triangles the three sides (no `far`), and none.
Beside patch_beside(const Mesh& mesh, std::uint32_t local, std::uint32_t side) {
  const PieceIndex at = patch_index(mesh, local);
  Beside beside;
  if (mesh.kind == MeshKind::kTriangle) {
    if (side < 3) beside.near = beside_in_triangle(mesh, at, side);
    return beside;
  }
  const bool up = side % 2 == 0;
  if (side < 2) {
    const std::uint32_t near = step_u(mesh, at.u, up), far = near == kNone ? kNone : step_u(mesh, near, up);
    if (near != kNone) beside.near = at.v * mesh.nu + near;
    if (far != kNone) beside.far = at.v * mesh.nu + far;
    return beside;
  }
  if (up ? at.v + 1 < mesh.nv : at.v > 0) beside.near = up ? local + mesh.nu : local - mesh.nu;
  if (up ? at.v + 2 < mesh.nv : at.v > 1) beside.far = up ? local + 2 * mesh.nu : local - 2 * mesh.nu;
  return beside;
}

/// near continued away from far, by at most half of near.
double continued(double near, double far) {
  double step = near - far;
  if (step > 0.5 * near) step = 0.5 * near;
  if (step < -0.5 * near) step = -0.5 * near;
  return near + step;
}

/// Gives patches without a value the mean of what their neighbours continue to, ring by ring. False if none has a
/// value.
bool fill_unknown(const Mesh& mesh, const Scratch& scratch) {
  const auto before = [&](std::uint32_t k, std::uint8_t pass) {
    return k != kNone && scratch.known[k] != 0 && scratch.known[k] != pass;
  };
  std::uint32_t unknown = 0;
  for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) unknown += scratch.known[p] == 0 ? 1 : 0;
  if (unknown == mesh.patch_count()) return false;
  while (unknown > 0) {
    constexpr std::uint8_t kThisPass = 2;
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      if (scratch.known[p] != 0) continue;
      double sum = 0;
      std::uint32_t count = 0;
      for (std::uint32_t side = 0; side < 4; ++side) {
        const Beside beside = patch_beside(mesh, p, side);
        if (!before(beside.near, kThisPass)) continue;
        const double near = scratch.patch[beside.near];
        sum += before(beside.far, kThisPass) ? continued(near, scratch.patch[beside.far]) : near;
        ++count;
      }
      if (count == 0) continue;
      scratch.patch[p] = sum / count;
      scratch.known[p] = kThisPass;
      --unknown;
    }
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) scratch.known[p] = scratch.known[p] != 0 ? 1 : 0;
  }
  return true;
}

/// Along u, then along v: both keep the mean of each patch.
void spread_rows(const MeshMap& map, const Scratch& scratch, std::uint32_t c) {
  const Mesh& mesh = map.mesh;
  const std::uint32_t width = mesh.map_width();
  for (std::uint32_t row = 0; row < mesh.nv; ++row) {
    const CellMeans cells{&scratch.patch[row * mesh.nu], mesh.nu, 1, mesh.wraps_u};
    spread(cells, mesh.su, [&](std::uint32_t u, double lx) { scratch.inner[row * width + u] = lx; });
  }
  for (std::uint32_t u = 0; u < width; ++u) {
    const CellMeans column{&scratch.inner[u], mesh.nv, width, false};
    spread(column, mesh.sv, [&](std::uint32_t v, double lx) { map.set(v * width + u, c, lx); });
  }
}

void spread_pieces(const MeshMap& map, const Scratch& scratch, std::uint32_t c) {
  const Mesh& mesh = map.mesh;
  const std::span<double> corners = scratch.inner.subspan(0, triangle_scratch(mesh.nu));
  const std::span<double> result = scratch.inner.subspan(corners.size(), mesh.sub_patch_count());
  spread_triangle(scratch.patch.subspan(0, mesh.patch_count()), mesh.nu, mesh.su, corners, result);
  for (std::uint32_t s = 0; s < mesh.sub_patch_count(); ++s) map.set(s, c, result[s]);
}

void spread_constant(const MeshMap& map) {
  for (std::uint32_t s = 0; s < map.mesh.sub_patch_count(); ++s) {
    const std::uint32_t p = patch_of_sub_patch(map.mesh, s);
    for (std::uint32_t c = 0; c < map.scene.channels; ++c) map.set(s, c, map.patch_lx(p, c));
  }
}

void spread_patches(const MeshMap& map, const Scratch& scratch, std::uint32_t c) {
  if (map.mesh.kind == MeshKind::kTriangle) {
    spread_pieces(map, scratch, c);
  } else {
    spread_rows(map, scratch, c);
  }
}

/// Spreads again until the mean over the visible sub-patches of a partly hidden patch is the patch's value: what it
/// lacks is added to what is spread.
void settle_hidden(const MeshMap& map, std::span<const float> visible_area, const Scratch& scratch, std::uint32_t c) {
  const Mesh& mesh = map.mesh;
  bool partly = false;
  for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
    const float visible = visible_area.empty() ? 1.0f : visible_area[std::size_t{mesh.first_patch} + p];
    partly = partly || (visible > 0 && visible < 1);
  }
  if (!partly) return;
  for (std::uint32_t pass = 0; pass < kHiddenPasses; ++pass) {
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      scratch.lacking[p] = 0;
      scratch.seen[p] = 0;
    }
    for (std::uint32_t s = 0; s < mesh.sub_patch_count(); ++s) {
      if (map.hidden(s)) continue;
      const std::uint32_t p = patch_of_sub_patch(mesh, s);
      scratch.lacking[p] += map.patch_lx(p, c) - static_cast<double>(map.sub_patch_lx(s, c));
      scratch.seen[p] += 1;
    }
    const std::uint32_t all = mesh.su * mesh.sv;
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      if (scratch.seen[p] == 0 || scratch.seen[p] == all) continue;
      const double lx = scratch.patch[p] + scratch.lacking[p] / scratch.seen[p];
      scratch.patch[p] = lx > 0 ? lx : 0;
    }
    spread_patches(map, scratch, c);
  }
}

/// A mesh whose patches are all hidden or dropped stays at 0.
void spread_mesh(const MeshMap& map, std::span<const Patch> patches, const DirectLight& direct,
                 const Scratch& scratch) {
  const Mesh& mesh = map.mesh;
  for (std::uint32_t c = 0; c < map.scene.channels; ++c) {
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      const std::size_t at = std::size_t{mesh.first_patch} + p;
      const bool visible = direct.visible_area.empty() || direct.visible_area[at] > 0;
      const bool dropped = !patches.empty() && patches[at].dropped != 0;
      scratch.known[p] = !dropped && visible ? 1 : 0;
      scratch.patch[p] = scratch.known[p] != 0 ? map.patch_lx(p, c) : 0;
    }
    if (!fill_unknown(mesh, scratch)) return;
    spread_patches(map, scratch, c);
    settle_hidden(map, direct.visible_area, scratch, c);
  }
}

}  // namespace

Status map_illuminance(const Scene& scene, std::span<const Patch> patches, const DirectLight& direct,
                       const AmbientLight& ambient, const Options& options, Arena& arena, IlluminanceMaps& maps) {
  maps = {};
  maps.direct_lx = direct.sub_patch_lx;
  maps.hidden = direct.hidden;
  const std::size_t values = std::size_t{scene.sub_patch_count} * scene.channels;
  if (!arena.take("ambient maps", values, maps.ambient_lx)) return arena.refused();
  const ArenaScratch release(arena);
  Scratch scratch;
  if (options.interpolate) {
    const ScratchSize size = scratch_size(scene);
    const std::size_t most = static_cast<std::size_t>(size.patches);
    const bool taken = arena.take("patches of a mesh", most, scratch.patch) &&
                       arena.take("spreading over a mesh", static_cast<std::size_t>(size.inner), scratch.inner) &&
                       arena.take("what visible sub-patches lack", most, scratch.lacking) &&
                       arena.take("visible sub-patches", most, scratch.seen) &&
                       arena.take("known patches", most, scratch.known);
    if (!taken) return arena.refused();
  }
  for (const Mesh& mesh : scene.meshes) {
    const MeshMap map{scene, mesh, ambient, maps};
    if (!options.interpolate) {
      spread_constant(map);
    } else {
      spread_mesh(map, patches, direct, scratch);
    }
  }
  return {};
}

std::uint64_t map_bytes(const Scene& scene, const Options& options) {
  const std::uint64_t values = rounded_up(4 * std::uint64_t{scene.sub_patch_count} * scene.channels);
  if (!options.interpolate) return values;
  const ScratchSize size = scratch_size(scene);
  return values + 16 * size.patches + rounded_up(4 * size.patches) + 8 * size.inner + rounded_up(size.patches);
}

}  // namespace shodo
