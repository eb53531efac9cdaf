#include "scene/patch_reflectance.h"

#include <cstddef>

#include "scene/mesh.h"
#include "scene/texture.h"
#include "scene/values.h"

namespace shodo {

namespace {

constexpr double kMostAcross = 16;  // texels of a level, a patch
constexpr std::uint32_t kParts = 8;  // along an edge of a triangular patch
constexpr double kEven = 0.125;      // of a repeated pattern's mean

/// A level of a mesh's texture, and how patches lie on it.
struct PatternMean {
  const Scene& scene;
  const Texture& texture;
  TextureLevel level;
  double u = 1, v = 1;           // repeats a patch
  double mean[3] = {1, 1, 1};    // of the level

  PatternMean(const Scene& of, const Mesh& mesh, const Texture& shown) : scene(of), texture(shown) {
    const Repeats repeats = texture_repeats(scene, mesh, texture);
    u = repeats.u / mesh.nu;
    v = repeats.v / mesh.nv;
    std::uint32_t coarse = 0;
    level = texture_level(texture, 0);
    while ((u * level.width > kMostAcross || v * level.height > kMostAcross) && (level.width > 1 || level.height > 1)) {
      level = texture_level(texture, ++coarse);
    }
    for (std::uint32_t c = 0; c < 3; ++c) mean[c] = coarse == 0 ? texture.mean[c] : level_mean(c);
  }

  double texel(std::uint32_t x, std::uint32_t y, std::uint32_t c) const {
    const std::size_t at = (std::size_t{y} * level.width + x) * texture.channels + (texture.channels == 1 ? 0 : c);
    return scene.texture_linear[level.texel[at]];
  }
  double level_mean(std::uint32_t c) const {
    double sum = 0;
    for (std::uint32_t y = 0; y < level.height; ++y) {
      for (std::uint32_t x = 0; x < level.width; ++x) sum += texel(x, y, c);
    }
    return sum / (static_cast<double>(level.width) * level.height);
  }
};

/// The texels that a part of an axis covers, from `from` to `to` texels, and how much of each.
struct Covered {
  double from, to;
  std::int64_t first, last;
  std::uint32_t count;

  /// Repeats of `texels` each.
  Covered(double low, double high, std::uint32_t texels) : from(low * texels), to(high * texels), count(texels) {
    first = floor_of(from);
    last = floor_of(to);
    if (last > first && !(to > static_cast<double>(last))) --last;
  }
  static std::int64_t floor_of(double x) {
    const std::int64_t whole = static_cast<std::int64_t>(x);
    return static_cast<double>(whole) > x ? whole - 1 : whole;
  }
  double weight(std::int64_t k) const {
    const double low = static_cast<double>(k), high = low + 1;
    return (high < to ? high : to) - (low > from ? low : from);
  }
  std::uint32_t texel(std::int64_t k) const {
    const std::int64_t n = count, rest = k % n;
    return static_cast<std::uint32_t>(rest < 0 ? rest + n : rest);
  }
};

/// Mean over a rectangle, s0 .. s1 and t0 .. t1 in repeats, t downwards.
void add_rectangle(const PatternMean& pattern, double s0, double s1, double t0, double t1, double (&sum)[3]) {
  const Covered columns(s0, s1, pattern.level.width), rows(t0, t1, pattern.level.height);
  double weights = 0, here[3] = {0, 0, 0};
  for (std::int64_t y = rows.first; y <= rows.last; ++y) {
    for (std::int64_t x = columns.first; x <= columns.last; ++x) {
      const double weight = rows.weight(y) * columns.weight(x);
      weights += weight;
      for (std::uint32_t c = 0; c < pattern.texture.channels; ++c) {
        here[c] += weight * pattern.texel(columns.texel(x), rows.texel(y), c);
      }
    }
  }
  for (std::uint32_t c = 0; c < 3 && weights > 0; ++c) {
    sum[c] += here[pattern.texture.channels == 1 ? 0 : c] / weights;
  }
}

/// Over a patch of a triangle: its parts' middles.
void add_triangle(const PatternMean& pattern, const PieceIndex& at, double (&sum)[3]) {
  double here[3] = {0, 0, 0};
  for (std::uint32_t part = 0; part < kParts * kParts; ++part) {
    const PieceIndex index = triangle_piece(kParts, part);
    const double third = index.inverted ? 2.0 / 3 : 1.0 / 3;
    double x = (index.u + third) / kParts, y = (index.v + third) / kParts;
    if (at.inverted) x = 1 - x, y = 1 - y;
    const double s = (at.u + x) * pattern.u, t = 1 - (at.v + y) * pattern.v;
    const Covered column(s, s, pattern.level.width), row(t, t, pattern.level.height);
    for (std::uint32_t c = 0; c < 3; ++c) {
      here[c] += pattern.texel(column.texel(column.first), row.texel(row.first), pattern.texture.channels == 1 ? 0 : c);
    }
  }
  for (std::uint32_t c = 0; c < 3; ++c) sum[c] += here[c] / (kParts * kParts);
}

/// The pattern's mean over a patch.
void add_patch(const PatternMean& pattern, const Mesh& mesh, std::uint32_t local, double (&mean)[3]) {
  const PieceIndex at = patch_index(mesh, local);
  if (mesh.kind == MeshKind::kTriangle) return add_triangle(pattern, at, mean);
  add_rectangle(pattern, at.u * pattern.u, (at.u + 1) * pattern.u, 1 - (at.v + 1) * pattern.v, 1 - at.v * pattern.v,
                mean);
}

/// Whether the patches of a mesh have reflectances of their own.
bool has_own(const Scene& scene, const Mesh& mesh) {
  const std::uint32_t which = texture_of(scene, mesh);
  if (which == kNone) return false;
  if (scene.textures[which].size_u == 0) return true;
  const PatternMean pattern(scene, mesh, scene.textures[which]);
  for (std::uint32_t local = 0; local < mesh.patch_count(); ++local) {
    double mean[3] = {0, 0, 0};
    add_patch(pattern, mesh, local, mean);
    for (std::uint32_t c = 0; c < 3; ++c) {
      if (mean[c] > (1 + kEven) * pattern.mean[c] || mean[c] < (1 - kEven) * pattern.mean[c]) return true;
    }
  }
  return false;
}

void fill_mesh(const Scene& scene, TexturedMesh& textured, std::span<float> values) {
  const Mesh& mesh = scene.meshes[textured.mesh];
  const Rgb& diffuse = scene.materials[mesh.material].diffuse;
  const PatternMean pattern(scene, mesh, scene.textures[texture_of(scene, mesh)]);
  for (std::uint32_t local = 0; local < mesh.patch_count(); ++local) {
    double mean[3] = {0, 0, 0};
    add_patch(pattern, mesh, local, mean);
    for (std::uint32_t c = 0; c < scene.channels; ++c) {
      const double rho = pattern.mean[c] > 0 ? diffuse.c[c] * mean[c] / pattern.mean[c] : 0;
      const float value = static_cast<float>(rho < kLargestReflectance ? rho : kLargestReflectance);
      values[textured.first + std::size_t{local} * scene.channels + c] = value;
      if (value > textured.most[c]) textured.most[c] = value;
    }
  }
}

/// With all texels in the arena.
bool find_of_meshes(Scene& scene, Arena& arena, std::span<TexturedMesh>& textured, std::span<float>& reflectance) {
  std::size_t meshes = 0, values = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (!has_own(scene, mesh)) continue;
    ++meshes;
    values += std::size_t{mesh.patch_count()} * scene.channels;
  }
  if (!arena.take("meshes with textures", meshes, textured) ||
      !arena.take("reflectances of their patches", values, reflectance)) {
    return false;
  }
  std::uint32_t first = 0, next = 0;
  for (std::uint32_t m = 0; m < scene.meshes.size() && next < textured.size(); ++m) {
    if (!has_own(scene, scene.meshes[m])) continue;
    textured[next] = {m, first, {0, 0, 0}, 0};
    fill_mesh(scene, textured[next++], reflectance);
    first += scene.meshes[m].patch_count() * scene.channels;
  }
  return true;
}

template <class T>
std::span<T> moved_down(std::span<T> block, std::size_t bytes) {
  if (block.empty()) return block;
  return {reinterpret_cast<T*>(reinterpret_cast<std::byte*>(block.data()) - bytes), block.size()};
}

}  // namespace

bool find_patch_reflectances(Scene& scene, const Reader& reader, Arena& arena, Status& status) {
  std::uint64_t most = 0;  // bytes: which meshes are even is known with their texels only
  for (const Mesh& mesh : scene.meshes) {
    if (texture_of(scene, mesh) == kNone) continue;
    most += sizeof(TexturedMesh) + 8 + 4 * std::uint64_t{mesh.patch_count()} * scene.channels;
  }
  if (most == 0) return true;
  const Arena::Mark before = arena.mark();
  if (!keep_texels(scene, reader, arena, status)) {
    if (status.code == StatusCode::kMemory) status.bytes_needed += most;
    return false;
  }
  const Arena::Mark after = arena.mark();
  std::span<TexturedMesh> textured;
  std::span<float> reflectance;
  const bool found = find_of_meshes(scene, arena, textured, reflectance);
  forget_texels(scene);
  if (!found) return status = arena.refused(), false;
  const std::size_t by = arena.lower(after, before);
  scene.textured = moved_down(textured, by);
  scene.patch_reflectance = moved_down(reflectance, by);
  return true;
}

/// Textured meshes ascend.
void MeshReflectance::find(const Scene& scene, std::uint32_t mesh) {
  std::size_t low = 0, high = scene.textured.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (scene.textured[middle].mesh < mesh) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (low == scene.textured.size() || scene.textured[low].mesh != mesh) return;
  values_ = &scene.patch_reflectance[scene.textured[low].first];
  most_ = scene.textured[low].most;
  channels_ = scene.channels;
}

}  // namespace shodo
