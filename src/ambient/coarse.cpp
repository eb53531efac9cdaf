#include "ambient/coarse.h"

namespace shodo {

namespace {

constexpr std::uint32_t kMostSteps = 32;
constexpr double kReduction = 0x1p-20;  // of the squared residual: a thousandth is enough for a correction
constexpr double kLong = 4;             // times the least extent

/// Four patches for each at least.
std::uint32_t most_groups(const Scene& scene, std::uint32_t most) {
  return scene.patch_count / 4 < most ? scene.patch_count / 4 : most;
}

double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// The box of the patches' centres, cut along each axis into cells that are about as long as wide.
struct Cells {
  Vec3 low, size;
  std::uint32_t count[3] = {1, 1, 1};

  bool any() const { return count[0] > 0; }
  std::uint32_t all() const { return count[0] * count[1] * count[2]; }
  double length(std::uint32_t axis) const { return (axis == 0 ? size.x : axis == 1 ? size.y : size.z) / count[axis]; }
  std::uint32_t at(const Vec3& point) const {
    const Vec3 from = point - low;
    return (along(2, from.z) * count[1] + along(1, from.y)) * count[0] + along(0, from.x);
  }

 private:
  std::uint32_t along(std::uint32_t axis, double from) const {
    const double cells = from > 0 ? from / length(axis) : 0;  // no length: nothing is farther than it
    return cells < count[axis] ? static_cast<std::uint32_t>(cells) : count[axis] - 1;
  }
};

/// The box of the centres of a mesh's patches, up to half a patch.
void include(const Scene& scene, const Mesh& mesh, Vec3& low, Vec3& high) {
  const std::uint32_t count = cell_count(mesh);
  const double s = count > 1 ? 0.5 : 0.5 / mesh.nu, t = count > 1 ? 0.5 : 0.5 / mesh.nv;
  for (std::uint32_t cell = 0; cell < count; ++cell) {
    const Piece piece = cell_piece(scene, mesh, cell);
    for (std::uint32_t k = 0; k < 4; ++k) {
      const Vec3 v = piece.point((k & 1) == 0 ? s : 1 - s, k < 2 ? t : 1 - t);
      low = {v.x < low.x ? v.x : low.x, v.y < low.y ? v.y : low.y, v.z < low.z ? v.z : low.z};
      high = {v.x > high.x ? v.x : high.x, v.y > high.y ? v.y : high.y, v.z > high.z ? v.z : high.z};
    }
  }
}

/// None (any() is false) where there are many meshes or the scene is about as long as wide and high; else at most
/// `most`, always cutting where cells are longest.
Cells cells_of(const Scene& scene) {
  Cells cells;
  cells.count[0] = 0;
  const std::uint32_t most = most_groups(scene, kMostGroups);
  if (scene.meshes.size() >= most) return cells;
  Vec3 high{-kInfinity, -kInfinity, -kInfinity};
  cells.low = -1.0 * high;
  for (const Mesh& mesh : scene.meshes) include(scene, mesh, cells.low, high);
  cells.size = high - cells.low;
  const Vec3& s = cells.size;
  const double least = s.x < s.y ? (s.x < s.z ? s.x : s.z) : (s.y < s.z ? s.y : s.z);
  const double largest = s.x > s.y ? (s.x > s.z ? s.x : s.z) : (s.y > s.z ? s.y : s.z);
  if (!(largest > kLong * least)) return cells;
  cells.count[0] = 1;
  for (;;) {
    const std::uint32_t of_xy = cells.length(1) > cells.length(0) ? 1 : 0;
    const std::uint32_t axis = cells.length(2) > cells.length(of_xy) ? 2 : of_xy;
    if (cells.all() / cells.count[axis] * (cells.count[axis] + 1) > most) return cells;
    ++cells.count[axis];
  }
}

std::uint32_t parts(std::uint32_t count, std::uint32_t edge) { return (count + edge - 1) / edge; }

/// Parts of e x e patches that the meshes have.
std::uint64_t parts_of_meshes(const Scene& scene, std::uint32_t edge) {
  std::uint64_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += std::uint64_t{parts(mesh.nu, edge)} * parts(mesh.nv, edge);
  return count;
}

/// e; 0: meshes stay whole.
std::uint32_t edge_of_parts(const Scene& scene, const Rules& rules) {
  const std::uint32_t most = most_groups(scene, kMostParts);
  if (node_count(scene, rules) > scene.patch_count || scene.meshes.size() >= most) return 0;
  std::uint32_t edge = 1;
  while (parts_of_meshes(scene, edge) > most) ++edge;
  return edge;
}

}  // namespace

std::uint32_t Coarse::group_count(const Scene& scene, const Rules& rules) {
  if (const Cells cells = cells_of(scene); cells.any()) return cells.all();
  const std::uint32_t edge = edge_of_parts(scene, rules);
  if (edge > 0) return static_cast<std::uint32_t>(parts_of_meshes(scene, edge));
  const std::size_t meshes = scene.meshes.size();
  return meshes < kMostGroups ? static_cast<std::uint32_t>(meshes) : kMostGroups;
}

Status Coarse::take(Arena& arena, const Surfaces& surfaces, const Rules& rules) {
  const Scene& scene = *surfaces.scene;
  meshes_ = static_cast<std::uint32_t>(surfaces.mesh_at.size());
  groups_ = group_count(scene, rules);
  channels_ = scene.channels;
  const Cells cells = cells_of(scene);
  const std::uint32_t edge = cells.any() ? 0 : edge_of_parts(scene, rules);
  by_place_ = cells.any();
  const std::size_t g = groups_, grouped = by_place_ || edge > 0 ? surfaces.size() : 0;
  const bool taken = arena.take("coarse exchange", g * (g + 1) / 2, exchange_) &&
                     arena.take("coarse weights", g, weight_) && arena.take("coarse changes", g * channels_, change_) &&
                     arena.take("coarse residual", g, residual_) && arena.take("coarse direction", g, direction_) &&
                     arena.take("coarse image", g, image_) && arena.take("groups of patches", grouped, group_of_);
  if (!taken) return arena.refused();
  for (std::uint32_t i = 0; i < surfaces.size() && by_place_; ++i) {
    group_of_[i] = static_cast<std::uint8_t>(surfaces.is_block(i) ? 0 : cells.at(surfaces.patch(i).centre));
  }
  if (edge > 0) cut_meshes(surfaces, edge);
  return {};
}

void Coarse::cut_meshes(const Surfaces& surfaces, std::uint32_t edge) {
  std::uint32_t first = 0;
  for (std::uint32_t k = 0; k < meshes_; ++k) {
    const Mesh& mesh = surfaces.scene->meshes[surfaces.mesh_at[k]];
    const std::uint32_t width = parts(mesh.nu, edge);
    for (std::uint32_t i = surfaces.mesh_begin[k]; i < surfaces.mesh_begin[k + 1]; ++i) {
      const PieceIndex at = patch_index(mesh, surfaces.patch_at[i] - mesh.first_patch);
      group_of_[i] = static_cast<std::uint8_t>(first + at.v / edge * width + at.u / edge);
    }
    first += width * parts(mesh.nv, edge);
  }
}

std::uint64_t Coarse::bytes(const Scene& scene, const Rules& rules) {
  const std::uint64_t g = group_count(scene, rules);
  const bool grouped = cells_of(scene).any() || edge_of_parts(scene, rules) > 0;
  return (4 * (g * (g + 1) / 2) + 7) / 8 * 8 + 8 * g * (4 + scene.channels) +
         (grouped ? (node_count(scene, rules) + 7) / 8 * 8 : 0);
}

void Coarse::forget() {
  for (float& exchange : exchange_) exchange = 0;
  for (double& weight : weight_) weight = 0;
}

void Coarse::share_out(const Surfaces& surfaces, std::uint32_t node, double (&share)[kMostGroups]) const {
  for (std::uint32_t g = 0; g < groups_; ++g) share[g] = 0;
  const double all = surfaces.root_area[node] * surfaces.root_area[node];
  for (std::uint32_t i = node; i < surfaces.end(node); ++i) {
    if (!surfaces.is_block(i)) share[group_of_[i]] += surfaces.root_area[i] * surfaces.root_area[i] / all;
  }
}

void Coarse::add_exchange_of_blocks(const Surfaces& surfaces, std::uint32_t i, std::uint32_t j, double exchange) {
  double share[kMostGroups];
  share_out(surfaces, j, share);
  const double all = surfaces.root_area[i] * surfaces.root_area[i];
  for (std::uint32_t k = i; k < surfaces.end(i); ++k) {
    if (surfaces.is_block(k)) continue;
    const double part = exchange * (surfaces.root_area[k] * surfaces.root_area[k] / all);
    for (std::uint32_t g = 0; g < groups_; ++g) {
      if (share[g] > 0) add_exchange(group_of_[k], g, part * share[g]);
    }
  }
}

void Coarse::start_sweep() {
  for (double& change : change_) change = 0;
}

void Coarse::apply(std::span<const double> reflectance, std::span<const double> from, std::span<double> to) const {
  for (std::uint32_t g = 0; g < groups_; ++g) {
    const double own = 2 * static_cast<double>(exchange_[at(g, g)]);
    to[g] = reflectance[g] > 0 ? (weight_[g] / reflectance[g] - own) * from[g] : 0;
  }
  for (std::uint32_t g = 0; g < groups_; ++g) {
    if (!(reflectance[g] > 0)) continue;
    for (std::uint32_t h = g + 1; h < groups_; ++h) {
      if (!(reflectance[h] > 0)) continue;
      const double t = static_cast<double>(exchange_[at(g, h)]);
      to[g] -= t * from[h];
      to[h] -= t * from[g];
    }
  }
}

void Coarse::correct(std::uint32_t channel, std::span<const double> area, std::span<const double> reflectance,
                     std::span<double> delta) {
  // Residual: changes of patches after i, by mean change of their group; half of its own group lies after a patch. Of
  // groups by place half of each does.
  for (std::uint32_t g = 0; g < groups_; ++g) {
    residual_[g] = 0;
    if (!(reflectance[g] > 0)) continue;
    for (std::uint32_t h = by_place_ ? 0 : g; h < groups_; ++h) {
      if (!(area[h] > 0)) continue;
      const double mean = change_[h * channels_ + channel] / area[h];
      const double part = by_place_ && h != g ? 0.5 : 1;
      residual_[g] += part * static_cast<double>(exchange_[g < h ? at(g, h) : at(h, g)]) * (reflectance[h] * mean);
    }
  }
  solve(reflectance, kMostSteps, kReduction, delta);
  for (std::uint32_t g = 0; g < groups_; ++g) delta[g] = reflectance[g] > 0 ? delta[g] / reflectance[g] : 0;
}

void Coarse::solve(std::span<const double> reflectance, std::uint32_t most_steps, double reduction,
                   std::span<double> u) {
  for (std::uint32_t g = 0; g < groups_; ++g) u[g] = direction_[g] = 0;
  // Conjugate gradients (Hestenes and Stiefel 1952), preconditioned with the diagonal weight / rho.
  const auto preconditioned = [&](std::uint32_t g) {
    return reflectance[g] > 0 && weight_[g] > 0 ? residual_[g] * (reflectance[g] / weight_[g]) : 0;
  };
  double size = 0, first = 0;
  for (std::uint32_t step = 0; step < most_steps; ++step) {
    double next = 0;
    for (std::uint32_t g = 0; g < groups_; ++g) next += residual_[g] * preconditioned(g);
    if (step == 0) first = next;
    if (!(next > reduction * first)) break;
    const double keep = step == 0 ? 0 : next / size;
    size = next;
    for (std::uint32_t g = 0; g < groups_; ++g) direction_[g] = preconditioned(g) + keep * direction_[g];
    apply(reflectance, direction_, image_);
    const double curvature = product(direction_, image_);
    if (!(curvature > 0)) break;  // rows that sum to more than 1, not scaled
    const double length = size / curvature;
    for (std::uint32_t g = 0; g < groups_; ++g) {
      u[g] += length * direction_[g];
      residual_[g] -= length * image_[g];
    }
  }
}

}  // namespace shodo
