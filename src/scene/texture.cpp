#include "scene/texture.h"

#include "base/srgb.h"
#include "base/text.h"
#include "scene/mesh.h"
#include "scene/slice.h"
#include "scene/values.h"

namespace shodo {

namespace {

/// A PPM or PGM file's head, and the bytes after it.
struct PortableMap {
  std::uint32_t width = 0, height = 0, channels = 0;
  std::string_view bytes;

  std::uint8_t at(std::size_t texel, std::uint32_t c) const {
    return static_cast<std::uint8_t>(bytes[texel * channels + (channels == 1 ? 0 : c)]);
  }
  std::size_t texels() const { return std::size_t{width} * height; }
};

bool refuse(Status& status, std::string_view expected, std::string_view found, StatusCode code = StatusCode::kScene) {
  status = {};
  status.code = code;
  TextBuilder(status.message, sizeof status.message).add("expected ").add(expected).add(", found ").add(found);
  return false;
}

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// A number of the head, after white space and comments; at most 99,999.
bool take_number(std::string_view& text, std::uint32_t& number) {
  std::size_t k = 0;
  while (k < text.size() && (is_space(text[k]) || text[k] == '#')) {
    if (text[k] != '#') {
      ++k;
      continue;
    }
    while (k < text.size() && text[k] != '\n') ++k;
  }
  std::size_t digits = 0;
  number = 0;
  for (; k < text.size() && text[k] >= '0' && text[k] <= '9' && digits < 5; ++k, ++digits) {
    number = 10 * number + static_cast<std::uint32_t>(text[k] - '0');
  }
  text = slice(text, k);
  return digits > 0 && !text.empty() && is_space(text[0]);
}

bool read_portable_map(std::string_view text, std::string_view path, PortableMap& map, Status& status) {
  map.channels = text.starts_with("P6") ? 3 : 1;
  std::uint32_t levels = 0;
  const bool known = text.starts_with("P6") || text.starts_with("P5");
  std::string_view rest = slice(text, 2);
  if (!known || !take_number(rest, map.width) || !take_number(rest, map.height) || !take_number(rest, levels) ||
      levels != 255) {
    return refuse(status, "a texture in PPM or PGM (P6 or P5) with 255 levels", path);
  }
  if (map.width - 1 >= kLargestTexture || map.height - 1 >= kLargestTexture) {
    return refuse(status, "a texture of 1 to 8192 texels each way", path);
  }
  map.bytes = slice(rest, 1);
  if (map.bytes.size() < map.texels() * map.channels) return refuse(status, "a texture with all its texels", path);
  return true;
}

bool is_grey(const PortableMap& map) {
  if (map.channels == 1) return true;
  for (std::size_t k = 0; k < map.texels(); ++k) {
    if (map.at(k, 0) != map.at(k, 1) || map.at(k, 1) != map.at(k, 2)) return false;
  }
  return true;
}

std::uint32_t halved(std::uint32_t size) { return size > 1 ? size / 2 : 1; }

/// Texels of all levels.
std::size_t all_texels(std::uint32_t width, std::uint32_t height) {
  std::size_t sum = std::size_t{width} * height;
  while (width > 1 || height > 1) {
    width = halved(width);
    height = halved(height);
    sum += std::size_t{width} * height;
  }
  return sum;
}

void fill_linear(std::span<std::uint16_t> linear) {
  for (std::uint32_t k = 0; k < 256; ++k) {
    linear[k] = static_cast<std::uint16_t>(65535 * linear_of_srgb(k / 255.0) + 0.5);
  }
}

/// The level whose linear value is nearest; the lower one where two are.
std::uint8_t srgb_of_linear(std::span<const std::uint16_t> linear, std::uint32_t value) {
  std::uint32_t low = 0, high = 255;
  while (high - low > 1) {
    const std::uint32_t middle = (low + high) / 2;
    (linear[middle] <= value ? low : high) = middle;
  }
  return static_cast<std::uint8_t>(linear[high] <= value || linear[high] - value < value - linear[low] ? high : low);
}

/// Which texels of the finer level one of the coarser covers, and how much of each: `to` weighs as much as a whole one.
struct Cover {
  std::uint32_t first, last, from, end, to;

  Cover(std::uint32_t k, std::uint32_t fine, std::uint32_t coarse)
      : first(k * fine / coarse), last(((k + 1) * fine - 1) / coarse), from(k * fine), end((k + 1) * fine),
        to(coarse) {}

  std::uint32_t weight(std::uint32_t texel) const {
    const std::uint32_t low = texel * to > from ? texel * to : from, high = (texel + 1) * to;
    return (high < end ? high : end) - low;
  }
};

/// Area means of linear values. Exact until they are rounded to 8-bit sRGB: weights add up to fine.width fine.height.
void halve(const TextureLevel& fine, std::uint32_t channels, std::span<const std::uint16_t> linear,
           std::uint8_t* texel) {
  const std::uint32_t width = halved(fine.width), height = halved(fine.height);
  const std::uint64_t whole = std::uint64_t{fine.width} * fine.height;
  for (std::uint32_t y = 0; y < height; ++y) {
    const Cover rows(y, fine.height, height);
    for (std::uint32_t x = 0; x < width; ++x) {
      const Cover columns(x, fine.width, width);
      for (std::uint32_t c = 0; c < channels; ++c) {
        std::uint64_t sum = 0;
        for (std::uint32_t j = rows.first; j <= rows.last; ++j) {
          for (std::uint32_t i = columns.first; i <= columns.last; ++i) {
            const std::uint8_t value = fine.texel[(std::size_t{j} * fine.width + i) * channels + c];
            sum += std::uint64_t{rows.weight(j)} * columns.weight(i) * linear[value];
          }
        }
        *texel++ = srgb_of_linear(linear, static_cast<std::uint32_t>((sum + whole / 2) / whole));
      }
    }
  }
}

/// The mean in linear light, and the lightest texel, by channel.
void measure(const PortableMap& map, std::span<const std::uint16_t> linear, Texture& texture) {
  std::uint64_t sum[3] = {0, 0, 0};
  for (std::size_t k = 0; k < map.texels(); ++k) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint8_t here = map.at(k, c);
      sum[c] += linear[here];
      if (here > texture.lightest[c]) texture.lightest[c] = here;
    }
  }
  for (std::uint32_t c = 0; c < 3; ++c) {
    texture.mean[c] = static_cast<double>(sum[c]) / static_cast<double>(map.texels());
  }
}

/// Texels of every level.
void fill_levels(const PortableMap& map, std::span<const std::uint16_t> linear, std::span<std::uint8_t> texels,
                 Texture& texture) {
  for (std::size_t k = 0; k < map.texels(); ++k) {
    for (std::uint32_t c = 0; c < texture.channels; ++c) texels[k * texture.channels + c] = map.at(k, c);
  }
  texture.texels = texels;
  for (std::uint32_t level = 0;; ++level) {
    const TextureLevel fine = texture_level(texture, level);
    if (fine.width == 1 && fine.height == 1) return;
    const std::size_t at = static_cast<std::size_t>(fine.texel - texels.data()) +
                           std::size_t{fine.width} * fine.height * texture.channels;
    halve(fine, texture.channels, linear, &texels[at]);
  }
}

/// No texel may reflect more than kLargestReflectance with the material's mean.
bool check_reflectance(const Scene& scene, const Texture& texture, Status& status) {
  if (texture.material == kNone) return true;
  constexpr std::string_view kColour[3] = {"red", "green", "blue"};
  const Rgb& diffuse = scene.materials[texture.material].diffuse;
  for (std::uint32_t c = 0; c < 3; ++c) {
    if (diffuse.c[c] == 0) continue;
    const double lightest = diffuse.c[c] * scene.texture_linear[texture.lightest[c]];
    if (texture.mean[c] > 0 && lightest <= kLargestReflectance * texture.mean[c]) continue;
    status = {};
    status.code = StatusCode::kScene;
    TextBuilder message(status.message, sizeof status.message);
    message.add("expected a texture whose lightest texel reflects at most 0.9999 where its mean reflects 'diffuse'");
    message.add(", found ").add(kColour[c]).add(' ');
    if (texture.mean[c] > 0) {
      message.add(lightest / texture.mean[c]);
    } else {
      message.add("none");
    }
    return false;
  }
  return true;
}

bool is_used(const Scene& scene, const Texture& texture) {
  if (texture.material == kNone) return scene.effects;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.material == texture.material) return true;
  }
  return false;
}

/// A texture before the k-th that is used and has the same file.
const Texture* same_file(const Scene& scene, std::uint32_t k) {
  for (std::uint32_t before = 0; before < k; ++before) {
    const Texture& other = scene.textures[before];
    if (other.width != 0 && other.path == scene.textures[k].path) return &other;
  }
  return nullptr;
}

bool read_file(const Reader& reader, std::string_view path, PortableMap& map, Status& status) {
  std::string_view text;
  if (reader.read == nullptr || !reader.read(reader.context, path, text)) {
    return refuse(status, "a picture that can be read", path, StatusCode::kFile);
  }
  return read_portable_map(text, path, map, status);
}

bool take_linear(Scene& scene, Arena& arena, Status& status) {
  if (!arena.take("linear values of texels", 256, scene.texture_linear)) return status = arena.refused(), false;
  fill_linear(scene.texture_linear);
  return true;
}

bool load_texture(Scene& scene, const Reader& reader, std::uint32_t k, Status& status) {
  Texture& texture = scene.textures[k];
  if (!is_used(scene, texture)) return true;
  if (const Texture* const other = same_file(scene, k); other != nullptr) {
    texture.width = other->width;
    texture.height = other->height;
    texture.channels = other->channels;
    for (std::uint32_t c = 0; c < 3; ++c) {
      texture.mean[c] = other->mean[c];
      texture.lightest[c] = other->lightest[c];
    }
    return check_reflectance(scene, texture, status);
  }
  PortableMap map;
  if (!read_file(reader, texture.path, map, status)) return false;
  texture.width = map.width;
  texture.height = map.height;
  texture.channels = is_grey(map) ? 1 : 3;
  measure(map, scene.texture_linear, texture);
  return check_reflectance(scene, texture, status);
}

std::size_t texel_bytes(const Texture& texture) {
  return texture.width == 0 ? 0 : all_texels(texture.width, texture.height) * texture.channels;
}

bool keep_texture(Scene& scene, const Reader& reader, Arena& arena, std::uint32_t k, Status& status) {
  Texture& texture = scene.textures[k];
  if (texture.width == 0) return true;
  if (const Texture* const other = same_file(scene, k); other != nullptr) {
    texture.texels = other->texels;
    return true;
  }
  PortableMap map;
  if (!read_file(reader, texture.path, map, status)) return false;
  if (map.width != texture.width || map.height != texture.height || (texture.channels == 1) != is_grey(map)) {
    return refuse(status, "the picture that was there when the scene was loaded", texture.path, StatusCode::kFile);
  }
  std::span<std::uint8_t> texels;
  if (!arena.take("texture", texel_bytes(texture), texels)) return status = arena.refused(), false;
  fill_levels(map, scene.texture_linear, texels, texture);
  return true;
}

/// Length of the line of vertices that starts at `first` and goes on in steps of `step`.
double line_length(const Scene& scene, std::uint32_t first, std::uint32_t step, std::uint32_t cells) {
  double sum = 0;
  for (std::uint32_t k = 0; k < cells; ++k) {
    sum += length(scene.vertices[first + (k + 1) * step] - scene.vertices[first + k * step]);
  }
  return sum;
}

/// Mean lengths of the two borders along u and v; of a triangle the two edges at its first corner.
void mesh_lengths(const Scene& scene, const Mesh& mesh, double& u, double& v) {
  const std::uint32_t first = mesh.first_vertex;
  if (mesh.kind == MeshKind::kGrid) {
    const std::uint32_t columns = mesh.cells_u + 1, last_row = first + mesh.cells_v * columns;
    u = 0.5 * (line_length(scene, first, 1, mesh.cells_u) + line_length(scene, last_row, 1, mesh.cells_u));
    v = 0.5 * (line_length(scene, first, columns, mesh.cells_v) +
               line_length(scene, first + mesh.cells_u, columns, mesh.cells_v));
    return;
  }
  const Vec3* const corner = &scene.vertices[first];
  u = length(corner[1] - corner[0]);
  v = length(corner[mesh.kind == MeshKind::kTriangle ? 2 : 3] - corner[0]);
  if (mesh.kind == MeshKind::kTriangle) return;
  u = 0.5 * (u + length(corner[2] - corner[3]));
  v = 0.5 * (v + length(corner[2] - corner[1]));
}

}  // namespace

TextureLevel texture_level(const Texture& texture, std::uint32_t level) {
  TextureLevel at{texture.texels.data(), texture.width, texture.height};
  for (; level > 0 && (at.width > 1 || at.height > 1); --level) {
    at.texel += std::size_t{at.width} * at.height * texture.channels;
    at.width = halved(at.width);
    at.height = halved(at.height);
  }
  return at;
}

bool load_textures(Scene& scene, const Reader& reader, Arena& arena, Status& status, std::uint32_t& at) {
  if (scene.textures.empty()) return true;
  const ArenaScratch scratch(arena);
  if (!take_linear(scene, arena, status)) return false;
  bool done = true;
  for (at = 0; at < scene.textures.size() && done; ++at) done = load_texture(scene, reader, at, status);
  if (!done) --at;
  scene.texture_linear = {};
  return done;
}

bool keep_texels(Scene& scene, const Reader& reader, Arena& arena, Status& status) {
  if (scene.textures.empty()) return true;
  if (!take_linear(scene, arena, status)) return false;
  for (std::uint32_t k = 0; k < scene.textures.size(); ++k) {
    if (!keep_texture(scene, reader, arena, k, status)) return false;
  }
  return true;
}

void forget_texels(Scene& scene) {
  scene.texture_linear = {};
  for (Texture& texture : scene.textures) texture.texels = {};
}

std::uint64_t texel_bytes(const Scene& scene) {
  std::uint64_t sum = scene.textures.empty() ? 0 : 2 * 256;
  for (std::uint32_t k = 0; k < scene.textures.size(); ++k) {
    if (same_file(scene, k) == nullptr) sum += (texel_bytes(scene.textures[k]) + 7) / 8 * 8;
  }
  return sum;
}

std::uint32_t texture_of(const Scene& scene, const Mesh& mesh) {
  for (std::uint32_t k = 0; k < scene.textures.size(); ++k) {
    if (scene.textures[k].material == mesh.material) return k;
  }
  return kNone;
}

Repeats texture_repeats(const Scene& scene, const Mesh& mesh, const Texture& texture) {
  if (texture.size_u == 0) return {};
  Repeats repeats;
  mesh_lengths(scene, mesh, repeats.u, repeats.v);
  repeats.u /= texture.size_u;
  repeats.v /= texture.size_v;
  return repeats;
}

}  // namespace shodo
