#include "picture/display.h"

#include "base/srgb.h"
#include "scene/mesh.h"
#include "scene/texture.h"

namespace shodo {

namespace {

/// What the maps of one mesh are made of.
struct MeshLight {
  const Scene* scene;
  const Mesh* mesh;
  const IlluminanceMaps* maps;
  double reflected[3];  // rho / pi
  bool textured;        // then only what is reflected, above 0 cd/m2 (textured.h)
  double emitted[3];    // cd/m2, of a polyhedral light's faces

  bool hidden(std::uint32_t local) const {
    return !maps->hidden.empty() && maps->hidden[mesh->first_sub_patch + local] != 0;
  }

  /// L = rho E / pi, and what the face emits.
  std::uint16_t steps(std::uint32_t local, std::uint32_t c) const {
    const std::size_t at = (std::size_t{mesh->first_sub_patch} + local) * scene->channels + c;
    const double lx = static_cast<double>(maps->direct_lx[at]) + static_cast<double>(maps->ambient_lx[at]);
    if (textured) return display_steps(reflected[c] * lx / (scene->display.max_cd_m2 - scene->display.min_cd_m2));
    return luminance_steps(scene->display, reflected[c] * lx + emitted[c]);
  }
};

MeshLight mesh_light(const Scene& scene, const Mesh& mesh, const IlluminanceMaps& maps) {
  MeshLight light{&scene, &mesh, &maps, {}, texture_of(scene, mesh) != kNone, {}};
  const std::uint32_t source = scene.objects[mesh.object].light;
  for (std::uint32_t c = 0; c < scene.channels; ++c) {
    light.reflected[c] = scene.materials[mesh.material].diffuse.c[c] / kPi;
    if (source != kNone) light.emitted[c] = scene.lights[source].strength * scene.lights[source].colour.c[c];
  }
  return light;
}

std::uint32_t limited(std::int64_t value) {
  return value < 0 ? 0 : value > 65535 ? 65535 : static_cast<std::uint32_t>(value);
}

/// A triangle's map as a square of k x k texels, texel (u, v) between (u, v) and (u + 1, v + 1): the mean of the
/// upright and the inverted piece there. On the hypotenuse, where there is but an upright piece, its value goes on to
/// the texel's centre, 1/6 in u and v, as upright neighbours do; beyond, texels continue their neighbours linearly.
class TriangleTexels {
 public:
  TriangleTexels(const MeshLight& light, std::uint32_t k) : light_(&light), k_(k) {}

  /// False where both pieces are hidden, or beyond the texels that are looked up.
  bool known(std::uint32_t u, std::uint32_t v) const { return u + v < k_ && (seen(u, v, false) || seen(u, v, true)); }

  std::uint16_t steps(std::uint32_t u, std::uint32_t v, std::uint32_t c) const {
    if (u + v + 1 < k_) {
      if (!seen(u, v, true)) return piece(u, v, false, c);
      if (!seen(u, v, false)) return piece(u, v, true, c);
      return static_cast<std::uint16_t>((std::uint32_t{piece(u, v, false, c)} + piece(u, v, true, c) + 1) / 2);
    }
    const std::int64_t here = piece(u, v, false, c);
    std::int64_t rise = 0, count = 0;
    const auto add_rise = [&](std::uint32_t u0, std::uint32_t v0) {
      if (!seen(u0, v0, false) || !seen(u0 + 1, v0, false) || !seen(u0, v0 + 1, false)) return;
      rise += std::int64_t{piece(u0 + 1, v0, false, c)} + piece(u0, v0 + 1, false, c) - 2 * piece(u0, v0, false, c);
      ++count;
    };
    if (u > 0) add_rise(u - 1, v);
    if (v > 0) add_rise(u, v - 1);
    return static_cast<std::uint16_t>(count == 0 ? here : limited(here + rise / (6 * count)));
  }

 private:
  std::uint32_t order(std::uint32_t u, std::uint32_t v, bool inverted) const {
    return triangle_piece_order(k_, {u, v, inverted});
  }
  bool seen(std::uint32_t u, std::uint32_t v, bool inverted) const {
    return (!inverted || u + v + 1 < k_) && !light_->hidden(order(u, v, inverted));
  }
  std::uint16_t piece(std::uint32_t u, std::uint32_t v, bool inverted, std::uint32_t c) const {
    return light_->steps(order(u, v, inverted), c);
  }

  const MeshLight* light_;
  std::uint32_t k_;
};

/// One mesh's texels while those without a value are filled.
struct TexelGrid {
  std::span<std::uint16_t> texel;
  std::span<std::uint8_t> pass;  // in which pass a texel got its value, counted from 1; 0: it has none
  std::uint32_t width, height, channels;
  bool wraps_u;
};

/// The mean of the up to 8 neighbours that had values before `pass`; false if there are none.
bool fill_texel(const TexelGrid& grid, std::uint32_t u, std::uint32_t v, std::uint8_t current) {
  std::uint32_t sum[3] = {0, 0, 0}, count = 0;
  for (std::uint32_t dv = 0; dv < 3; ++dv) {
    if (v + dv < 1 || v + dv > grid.height) continue;
    for (std::uint32_t du = 0; du < 3; ++du) {
      if (!grid.wraps_u && (u + du < 1 || u + du > grid.width)) continue;
      const std::uint32_t at = (v + dv - 1) * grid.width + (u + du + grid.width - 1) % grid.width;
      if (grid.pass[at] == 0 || grid.pass[at] == current) continue;
      for (std::uint32_t c = 0; c < grid.channels; ++c) sum[c] += grid.texel[at * grid.channels + c];
      ++count;
    }
  }
  if (count == 0) return false;
  const std::uint32_t at = v * grid.width + u;
  for (std::uint32_t c = 0; c < grid.channels; ++c) {
    grid.texel[at * grid.channels + c] = static_cast<std::uint16_t>((sum[c] + count / 2) / count);
  }
  return true;
}

/// Texels without a value (hidden sub-patches) get their neighbours' mean, ring by ring, so that bilinear lookups
/// beside them don't darken. A mesh that is hidden altogether stays black.
void fill_texels(const TexelGrid& grid) {
  std::uint8_t current = 1;
  for (bool changed = true; changed;) {
    changed = false;
    current = current == 2 ? 3 : 2;
    for (std::uint32_t v = 0; v < grid.height; ++v) {
      for (std::uint32_t u = 0; u < grid.width; ++u) {
        std::uint8_t& pass = grid.pass[v * grid.width + u];
        if (pass == current) pass = 1;
      }
    }
    for (std::uint32_t v = 0; v < grid.height; ++v) {
      for (std::uint32_t u = 0; u < grid.width; ++u) {
        const std::uint32_t at = v * grid.width + u;
        if (grid.pass[at] != 0 || !fill_texel(grid, u, v, current)) continue;
        grid.pass[at] = current;
        changed = true;
      }
    }
  }
}

/// Writes the values that the mesh has; true if some texels have none.
bool write_texels(const MeshLight& light, const TexelGrid& grid) {
  const bool triangle = light.mesh->kind == MeshKind::kTriangle;
  const TriangleTexels square(light, grid.width);
  bool some_unknown = false;
  for (std::uint32_t v = 0; v < grid.height; ++v) {
    for (std::uint32_t u = 0; u < grid.width; ++u) {
      const std::uint32_t at = v * grid.width + u;
      const bool known = triangle ? square.known(u, v) : !light.hidden(at);
      grid.pass[at] = known ? 1 : 0;
      some_unknown = some_unknown || !known;
      for (std::uint32_t c = 0; c < grid.channels && known; ++c) {
        grid.texel[at * grid.channels + c] = triangle ? square.steps(u, v, c) : light.steps(at, c);
      }
    }
  }
  return some_unknown;
}

/// T(u, v) = T(u - 1, v) + T(u, v - 1) - T(u - 1, v - 1) on the first diagonal beyond the hypotenuse, which bilinear
/// lookups on the hypotenuse touch.
void extend_triangle(const TexelGrid& grid) {
  for (std::uint32_t v = 1; v < grid.height; ++v) {
    const std::uint32_t u = grid.width - v;
    const std::uint32_t at = v * grid.width + u;
    for (std::uint32_t c = 0; c < grid.channels; ++c) {
      const auto texel = [&](std::uint32_t k) { return std::int64_t{grid.texel[k * grid.channels + c]}; };
      const std::int64_t value = texel(at - 1) + texel(at - grid.width) - texel(at - grid.width - 1);
      grid.texel[at * grid.channels + c] = static_cast<std::uint16_t>(limited(value));
    }
  }
}

}  // namespace

std::uint16_t display_steps(double v) {
  const double steps = v * kWhite + 0.5;
  if (!(steps >= 1)) return 0;
  return steps >= 65535 ? std::uint16_t{65535} : static_cast<std::uint16_t>(steps);
}

std::uint16_t luminance_steps(const Display& display, double luminance_cd_m2) {
  const double v = (luminance_cd_m2 - display.min_cd_m2) / (display.max_cd_m2 - display.min_cd_m2);
  return display_steps(display.roll && v > 0.5 ? 1 - 0.25 / v : v);
}

void fill_display_table(std::span<std::uint8_t> level, double black) {
  // Each level starts where sRGB passes the middle between it and the one before: 255 powers instead of 8193.
  std::uint32_t step = 0;
  for (std::uint32_t k = 0; k <= 255; ++k) {
    const double end = k == 255 ? 2.0 * kWhite : kWhite * (black + (1 - black) * linear_of_srgb((k + 0.5) / 255));
    for (; step <= kWhite && static_cast<double>(step) < end; ++step) level[step] = static_cast<std::uint8_t>(k);
  }
}

bool build_display_maps(const Scene& scene, const IlluminanceMaps& maps, Arena& arena, DisplayMaps& display) {
  const std::size_t texels = std::size_t{scene.sub_patch_count} * scene.channels;
  if (!arena.take("display maps", texels, display.texel)) return false;
  std::uint32_t largest = 0;
  for (const Mesh& mesh : scene.meshes) largest = mesh.sub_patch_count() > largest ? mesh.sub_patch_count() : largest;
  const ArenaScratch scratch(arena);
  std::span<std::uint8_t> pass;
  if (!arena.take("filling of hidden sub-patches", largest, pass)) return false;
  for (const Mesh& mesh : scene.meshes) {
    TexelGrid grid;
    grid.texel = display.texel.subspan(std::size_t{mesh.first_sub_patch} * scene.channels,
                                       std::size_t{mesh.sub_patch_count()} * scene.channels);
    grid.pass = pass;
    grid.width = mesh.map_width();
    grid.height = mesh.map_height();
    grid.channels = scene.channels;
    grid.wraps_u = mesh.wraps_u;
    if (write_texels(mesh_light(scene, mesh, maps), grid)) fill_texels(grid);
    if (mesh.kind == MeshKind::kTriangle) extend_triangle(grid);
  }
  return true;
}

}  // namespace shodo
