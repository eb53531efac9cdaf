#include "picture/textured.h"

#include <bit>

#include "picture/display.h"
#include "scene/mesh.h"

namespace shodo {

namespace {

constexpr std::int32_t kReach = 8;                // samples a piece
constexpr double kTolerance = 1.0 / 256;          // of a texel, and of a sub-patch
constexpr std::uint32_t kMostLevels = 14;         // 8192 halves to 1 in 13 steps
constexpr double kCoarsest = 1 << kMostLevels;    // texels a sample: whatever the size, the last level

double magnitude(double a) { return a < 0 ? -a : a; }
double larger(double a, double b) { return a > b ? a : b; }

/// a 2^bits, towards zero, within +-(2^31 - 1): here doubles become integers, and nowhere else.
std::int32_t fixed_point(double a, int bits) {
  const double scaled = a * static_cast<double>(std::int64_t{1} << bits);
  if (scaled >= 2147483647.0) return 2147483647;
  return scaled <= -2147483647.0 ? -2147483647 : static_cast<std::int32_t>(scaled);
}

/// What is left of s beyond whole repeats, 2^-32 each.
std::uint32_t part_of_repeat(double s) {
  const double whole = static_cast<double>(static_cast<std::int64_t>(s));
  const double part = s - whole < 0 ? s - whole + 1 : s - whole;
  const std::uint32_t upper = static_cast<std::uint32_t>(fixed_point(part, 16));
  return upper << 16 | static_cast<std::uint32_t>(fixed_point(part * 65536 - upper, 16));
}

/// A sample's place on the map and on the texture.
struct Place {
  double u = 0, v = 0;     // sub-patches
  double s = 0, t = 0;     // repeats, t downwards
  double inverse_depth = 1;
  double step = kCoarsest; // texels to the next sample, or to the one below
};

/// Texture values at a place, with two levels of detail.
class TextureLookup {
 public:
  TextureLookup(const Scene& scene, const Texture& texture, bool repeats)
      : linear_(scene.texture_linear), channels_(texture.channels), repeats_(repeats) {
    while (count_ < kMostLevels) {
      level_[count_] = texture_level(texture, count_);
      ++count_;
      if (level_[count_ - 1].width == 1 && level_[count_ - 1].height == 1) break;
    }
  }

  /// Linear, of 65535. `step`: texels of level 0 a sample, 16.16.
  void look_up(std::uint32_t s, std::uint32_t t, std::uint32_t step, std::uint32_t (&value)[3]) const {
    std::uint32_t level = 0, weight = 0;
    if (step > 65536) {
      level = static_cast<std::uint32_t>(std::bit_width(step)) - 17;
      weight = step >> (level + 8) & 255;
    }
    if (level >= count_ - 1) level = count_ - 1, weight = 0;
    bilinear(level_[level], s, t, value);
    if (weight == 0) return;
    std::uint32_t coarse[3];
    bilinear(level_[level + 1], s, t, coarse);
    for (std::uint32_t c = 0; c < channels_; ++c) value[c] = (value[c] * (256 - weight) + coarse[c] * weight) >> 8;
  }
  std::uint32_t channels() const { return channels_; }

 private:
  struct Axis {
    std::uint32_t low, high, weight;
  };

  Axis axis_at(std::uint32_t at, std::uint32_t count) const {
    const std::int64_t place = static_cast<std::int64_t>(std::uint64_t{at} * count >> 16) - 32768;
    const std::int32_t low = static_cast<std::int32_t>(place >> 16), last = static_cast<std::int32_t>(count) - 1;
    const std::uint32_t weight = static_cast<std::uint32_t>(place >> 8 & 255);
    const auto texel = [&](std::int32_t k) {
      if (k < 0) return static_cast<std::uint32_t>(repeats_ ? last : 0);
      if (k > last) return static_cast<std::uint32_t>(repeats_ ? 0 : last);
      return static_cast<std::uint32_t>(k);
    };
    return {texel(low), texel(low + 1), weight};
  }

  void bilinear(const TextureLevel& level, std::uint32_t s, std::uint32_t t, std::uint32_t (&value)[3]) const {
    const Axis x = axis_at(s, level.width), y = axis_at(t, level.height);
    const std::uint8_t* const low = level.texel + std::size_t{y.low} * level.width * channels_;
    const std::uint8_t* const high = level.texel + std::size_t{y.high} * level.width * channels_;
    for (std::uint32_t c = 0; c < channels_; ++c) {
      const auto along = [&](const std::uint8_t* row) {
        return linear_[row[x.low * channels_ + c]] * (256 - x.weight) + linear_[row[x.high * channels_ + c]] * x.weight;
      };
      value[c] = (along(low) * (256 - y.weight) + along(high) * y.weight) >> 16;
    }
  }

  std::span<const std::uint16_t> linear_;
  TextureLevel level_[kMostLevels];
  std::uint32_t count_ = 0, channels_;
  bool repeats_;
};

/// Samples of a span and what they show.
class TexturedWalk {
 public:
  TexturedWalk(const TexturedSpan& span, const SampleRow& samples)
      : span_(span), samples_(samples), texture_(span.scene.textures[span.texture.texture]),
        lookup_(span.scene, texture_, span.texture.repeats) {
    const Display& display = span.scene.display;
    const std::uint32_t source = span.scene.objects[span.mesh.object].light;
    for (std::uint32_t c = 0; c < samples.channels; ++c) {
      const Light* const light = source == kNone ? nullptr : &span.scene.lights[source];
      const double emitted = light == nullptr ? 0 : light->strength * light->colour.c[c];
      const double steps = (emitted - display.min_cd_m2) / (display.max_cd_m2 - display.min_cd_m2);
      offset_[c] = fixed_point(steps * kWhite / 2, 0);  // half of it can be doubled
      const double mean = texture_.mean[c] + 0.5;
      mean_[c] = mean >= 1 ? static_cast<std::uint32_t>(fixed_point(mean, 0)) : 1;
    }
  }

  void show() {
    Place start = place(span_.x0);
    for (std::int32_t x = span_.x0; x < span_.x1;) {
      std::int32_t reach = span_.x1 - x <= kReach ? span_.x1 - x - 1 : kReach;
      Place end = start;
      for (; reach > 0; reach /= 2) {
        end = place(x + reach);
        if (reach == 1 || straight(start, end)) break;
      }
      const std::int32_t length = reach == 0 || x + reach + 1 == span_.x1 ? reach + 1 : reach;
      show_piece(x, length, reach, start, end);
      x += length;
      start = end;
    }
  }

 private:
  Place place(std::int32_t x) const {
    const ActiveTriangle& active = span_.active;
    Place at;
    if (active.wide_map) {
      const MapPoint exact = exact_map_point(span_.carrier, span_.grid, x, span_.row);
      at.u = exact.u / 4096.0;
      at.v = exact.v / 4096.0;
      return at;
    }
    constexpr double kScale = 1 << (kInverseDepthBits - kMapBits);
    const double z = static_cast<double>(active.inverse_depth.at(x));
    const double u = static_cast<double>(active.map_u.at(x)) * kScale / z,
                 v = static_cast<double>(active.map_v.at(x)) * kScale / z;
    at.inverse_depth = z;
    at.u = span_.carrier.u[0] / 256.0 + u;
    at.v = span_.carrier.v[0] / 256.0 + v;
    at.s = at.u * span_.texture.s;
    at.t = 1 - at.v * span_.texture.t;
    // d(U / z) = (dU - U / z dz) / z
    const auto slope = [&](std::int64_t du, double value, std::int64_t dz) {
      return magnitude(static_cast<double>(du) * kScale - value * static_cast<double>(dz)) / z;
    };
    const LinearValue &depth = active.inverse_depth, &map_u = active.map_u, &map_v = active.map_v;
    const double across = larger(slope(map_u.cx, u, depth.cx), slope(map_u.cy, u, depth.cy));
    const double up = larger(slope(map_v.cx, v, depth.cx), slope(map_v.cy, v, depth.cy));
    at.step = larger(across * span_.texture.s * texture_.width, up * span_.texture.t * texture_.height);
    return at;
  }

  bool straight(const Place& a, const Place& b) const {
    const double near = larger(a.inverse_depth, b.inverse_depth), far = a.inverse_depth + b.inverse_depth - near;
    const double texels = larger(magnitude(a.s - b.s) * texture_.width, magnitude(a.t - b.t) * texture_.height);
    const double sub_patches = larger(magnitude(a.u - b.u), magnitude(a.v - b.v));
    const double texel = larger(1, a.step < b.step ? a.step : b.step);
    return (near - far) * larger(texels, sub_patches * texel) <= 4 * kTolerance * far * texel;
  }

  /// Samples x .. x + length - 1; `end` lies `reach` samples after `start`.
  void show_piece(std::int32_t x, std::int32_t length, std::int32_t reach, const Place& start, const Place& end) const {
    const double share = reach == 0 ? 0 : 1.0 / reach;
    MapPiece piece{x, length, fixed_point(start.u, 12), fixed_point(start.v, 12),
                   fixed_point((end.u - start.u) * share, 16), fixed_point((end.v - start.v) * share, 16)};
    PieceLookup light(span_.map, piece);
    // Half a repeat a sample or more is too coarse for any pattern; the last level shows the mean wherever it is.
    const std::int32_t ds = fixed_point((end.s - start.s) * share, 32), dt = fixed_point((end.t - start.t) * share, 32);
    const std::int32_t step_by = fixed_point((end.step - start.step) * share, 16);
    std::uint32_t s = part_of_repeat(inside(start.s)), t = part_of_repeat(inside(start.t));
    std::uint32_t step = static_cast<std::uint32_t>(fixed_point(start.step, 16));
    for (const std::int32_t last = x + length; x < last; ++x) {
      std::uint32_t steps[3], value[3];
      light.next(steps);
      lookup_.look_up(s, t, step, value);
      for (std::uint32_t c = 0; c < samples_.channels; ++c) {
        steps[c] = shown(steps[c], value[lookup_.channels() == 1 ? 0 : c], c);
      }
      show_plain(samples_, x, x + 1, steps);
      s += static_cast<std::uint32_t>(ds);
      t += static_cast<std::uint32_t>(dt);
      step += static_cast<std::uint32_t>(step_by);
    }
  }

  /// A texture that ends at the borders must not begin again there: it keeps 2^-22 of itself away from them.
  double inside(double s) const { return span_.texture.repeats ? s : 0x1p-22 + s * (1 - 0x1p-21); }

  /// Display steps of reflected light `light`, at most white.
  std::uint32_t shown(std::uint32_t light, std::uint32_t value, std::uint32_t c) const {
    const std::uint32_t reflected = (light * value + mean_[c] / 2) / mean_[c];  // below 2^32: 65535^2 + 32767
    const std::int64_t steps = std::int64_t{reflected} + 2 * std::int64_t{offset_[c]};
    return steps < 0 ? 0 : steps > kWhite ? kWhite : static_cast<std::uint32_t>(steps);
  }

  const TexturedSpan& span_;
  const SampleRow& samples_;
  const Texture& texture_;
  TextureLookup lookup_;
  std::int32_t offset_[3] = {0, 0, 0};  // halves of display steps: what is emitted, less MIN
  std::uint32_t mean_[3] = {1, 1, 1};   // of the texture, of 65535
};

}  // namespace

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

void show_textured(const TexturedSpan& span, const SampleRow& samples) { TexturedWalk(span, samples).show(); }

}  // namespace shodo
