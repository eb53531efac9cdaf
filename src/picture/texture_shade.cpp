#include "picture/texture_shade.h"

#include "picture/display.h"
#include "scene/mesh.h"

namespace shodo {

namespace {

constexpr double kTolerance = 1.0 / 256;  // of a texel, and of a sub-patch

double larger(double a, double b) { return a > b ? a : b; }

/// What is left of s beyond whole repeats, 2^-32 each.
std::uint32_t part_of_repeat(double s) {
  const double whole = static_cast<double>(static_cast<std::int64_t>(s));
  const double part = s - whole < 0 ? s - whole + 1 : s - whole;
  const std::uint32_t upper = static_cast<std::uint32_t>(fixed_point(part, 16));
  return upper << 16 | static_cast<std::uint32_t>(fixed_point(part * 65536 - upper, 16));
}

double share_of(std::int32_t reach) { return reach == 0 ? 0 : 1.0 / reach; }

MapPiece piece_of(std::int32_t reach, const TexturePlace& start, const TexturePlace& end) {
  const double share = share_of(reach);
  return {0, 0, fixed_point(start.u, 12), fixed_point(start.v, 12), fixed_point((end.u - start.u) * share, 16),
          fixed_point((end.v - start.v) * share, 16)};
}

}  // namespace

std::int32_t fixed_point(double a, int bits) {
  const double scaled = a * static_cast<double>(std::int64_t{1} << bits);
  if (scaled >= 2147483647.0) return 2147483647;
  return scaled <= -2147483647.0 ? -2147483647 : static_cast<std::int32_t>(scaled);
}

bool find_mesh_textures(const Scene& scene, Arena& arena, std::span<MeshTexture>& textures) {
  if (scene.textures.empty()) return true;
  if (!arena.take("textures of meshes", scene.meshes.size(), textures)) return false;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    MeshTexture& at = textures[m] = {};
    at.texture = texture_of(scene, mesh);
    if (at.texture == kNone) continue;
    const Texture& texture = scene.textures[at.texture];
    const Repeats repeats = texture_repeats(scene, mesh, texture);
    at.repeats = texture.size_u != 0;
    at.s = repeats.u / mesh.map_width();
    at.t = repeats.v / mesh.map_height();
  }
  return true;
}

std::uint64_t mesh_texture_bytes(const Scene& scene) {
  return scene.textures.empty() ? 0 : (sizeof(MeshTexture) * std::uint64_t{scene.meshes.size()} + 7) / 8 * 8;
}

TextureShade::TextureShade(const Scene& scene, const Mesh& mesh, const MeshTexture& at, const MapTexels& map)
    : texture_(scene.textures[at.texture]), at_(at), map_(map), lookup_(scene, texture_, at.repeats) {
  const Display& display = scene.display;
  const std::uint32_t source = scene.objects[mesh.object].light;
  for (std::uint32_t c = 0; c < map.channels; ++c) {
    const Light* const light = source == kNone ? nullptr : &scene.lights[source];
    const double emitted = light == nullptr ? 0 : light->strength * light->colour.c[c];
    const double steps = (emitted - display.min_cd_m2) / (display.max_cd_m2 - display.min_cd_m2);
    offset_[c] = fixed_point(steps * kWhite / 2, 0);  // half of it can be doubled
    const double mean = texture_.mean[c] + 0.5;
    mean_[c] = mean >= 1 ? static_cast<std::uint32_t>(fixed_point(mean, 0)) : 1;
  }
}

double TextureShade::texels(double du, double dv) const {
  return larger(magnitude(du) * at_.s * texture_.width, magnitude(dv) * at_.t * texture_.height);
}

bool TextureShade::straight(const TexturePlace& a, const TexturePlace& b) const {
  const double near = larger(a.inverse_depth, b.inverse_depth), far = a.inverse_depth + b.inverse_depth - near;
  const double texels = larger(magnitude(a.s - b.s) * texture_.width, magnitude(a.t - b.t) * texture_.height);
  const double sub_patches = larger(magnitude(a.u - b.u), magnitude(a.v - b.v));
  const double texel = larger(1, a.step < b.step ? a.step : b.step);
  return (near - far) * larger(texels, sub_patches * texel) <= 4 * kTolerance * far * texel;
}

/// Half a repeat a sample or more is too coarse for any pattern; the last level shows the mean wherever it is.
TextureShade::Course::Course(const TextureShade& shade, std::int32_t reach, const TexturePlace& start,
                             const TexturePlace& end)
    : shade_(shade), light_(shade.map_, piece_of(reach, start, end)), s_(part_of_repeat(shade.inside(start.s))),
      t_(part_of_repeat(shade.inside(start.t))), step_(static_cast<std::uint32_t>(fixed_point(start.step, 16))),
      ds_(fixed_point((end.s - start.s) * share_of(reach), 32)),
      dt_(fixed_point((end.t - start.t) * share_of(reach), 32)),
      dstep_(fixed_point((end.step - start.step) * share_of(reach), 16)) {}

}  // namespace shodo
