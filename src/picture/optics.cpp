#include "picture/optics.h"

#include <bit>

namespace shodo {

namespace {

constexpr std::uint32_t kWhole = 65536;

std::uint32_t part_of(double part) { return static_cast<std::uint32_t>(part * kWhole + 0.5); }

bool any(const std::uint32_t (&part)[3], std::uint32_t channels) {
  for (std::uint32_t c = 0; c < channels; ++c) {
    if (part[c] != 0) return true;
  }
  return false;
}

/// True if something is left.
bool weaken(std::uint32_t (&part)[3], const std::uint32_t (&by)[3], std::uint32_t channels) {
  for (std::uint32_t c = 0; c < channels; ++c) {
    part[c] = static_cast<std::uint32_t>(std::uint64_t{part[c]} * by[c] >> 16);
  }
  return any(part, channels);
}

/// The two texels between whose centres a coordinate lies, and the second one's weight in 1/4096.
struct Between {
  std::int32_t low, high;
  std::uint32_t weight;
};

Between between(std::int32_t coordinate, std::int32_t count, bool wraps) {
  const std::int32_t from_centre = coordinate - 2048;
  const std::int32_t low = from_centre >> 12;
  const auto inside = [&](std::int32_t k) {
    if (wraps) return (k % count + count) % count;
    return k < 0 ? 0 : k >= count ? count - 1 : k;
  };
  return {inside(low), inside(low + 1), static_cast<std::uint32_t>(from_centre & 4095)};
}

}  // namespace

std::uint32_t PictureOptics::fine_steps(double luminance_cd_m2) const {
  // Here luminances become integers.
  const double steps = luminance_cd_m2 / scene_->display.max_cd_m2 * (kWhite << kFineBits) + 0.5;
  if (!(steps >= 1)) return 0;
  return steps >= kBrightest ? kBrightest : static_cast<std::uint32_t>(steps);
}

bool PictureOptics::start(const Scene& scene, const Geometry& geometry, const DisplayMaps& maps,
                          const SampleGrid& grid, const Display& display, Arena& arena) {
  scene_ = &scene;
  roll_ = display.roll;
  black_ = fine_steps(display.min_cd_m2);
  geometry_ = &geometry;
  maps_ = maps;
  grid_ = grid;
  const std::size_t lights = scene.lights.size() * scene.channels;
  if (!tree_.build(scene, geometry.drawn, arena) || !arena.take("parts of optics", scene.optics.size(), parts_) ||
      !arena.take("luminances of lights", lights, light_) || !arena.take("waiting rays", kMostWaiting, waiting_) ||
      !highlights_.start(scene, geometry, tree_, arena)) {
    return false;
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      parts_[k].reflect[c] = part_of(scene.optics[k].reflect.c[c]);
      parts_[k].transmit[c] = part_of(scene.optics[k].transmit.c[c]);
    }
  }
  for (std::size_t k = 0; k < lights; ++k) {
    const Light& light = scene.lights[k / scene.channels];
    light_[k] = fine_steps(light.strength * light.colour.c[k % scene.channels]);
  }
  if (scene.background.empty()) return true;
  const Background& background = scene.background[0];
  for (std::uint32_t c = 0; c < 3; ++c) {
    horizon_[c] = fine_steps(background.horizon.c[c]);
    zenith_[c] = fine_steps(background.zenith.c[c]);
    ground_[c] = fine_steps(background.ground.c[c]);
  }
  const LatticeVector up = lattice_direction(background.up);
  up_ = {up.x >> 5, up.y >> 5, up.z >> 5};
  return true;
}

std::uint64_t PictureOptics::bytes(const Scene& scene, const Geometry& geometry) {
  if (!used(scene)) return 0;
  const auto block = [](std::uint64_t bytes) { return (bytes + 7) / 8 * 8; };
  return RayTree::bytes(geometry.drawn.size()) + block(sizeof(Parts) * scene.optics.size()) +
         block(4 * std::uint64_t{scene.lights.size()} * scene.channels) + block(sizeof(Path) * kMostWaiting) +
         Highlights::bytes(scene);
}

/// The index of the material's optics; kNone.
std::uint32_t PictureOptics::optics_at(const DrawnTriangle& drawn) const {
  if (drawn.mesh == kNone) return kNone;
  const Optics* const found = scene_->optics_of(scene_->meshes[drawn.mesh].material);
  return found == nullptr ? kNone : static_cast<std::uint32_t>(found - scene_->optics.data());
}

bool PictureOptics::takes(const DrawnTriangle& drawn, bool front) const {
  if (roll_ || tree_.invisible(drawn, front)) return true;
  const std::uint32_t optics = optics_at(drawn);
  return optics != kNone && (front || any(parts_[optics].transmit, scene_->channels));
}

void PictureOptics::add(std::uint32_t triangle, std::int32_t x0, std::int32_t x1, std::uint32_t row,
                        std::span<std::uint32_t> sums) {
  const std::uint32_t channels = scene_->channels;
  for (std::int32_t x = x0; x < x1; ++x) {
    Path path{{grid_.eye, ray_direction(grid_.direction(x, row))}, {kWhole, kWhole, kWhole}, 0};
    RayHit first;
    Colour sum = {0, 0, 0};
    // At grazing angles the rounded ray may miss what the sample sees; it meets something else then.
    if (triangle != kNone && (tree_.invisible(geometry_->drawn[triangle], true) ||
                              !meet_plane(geometry_->drawn[triangle], triangle, path.ray, first))) {
      first = tree_.nearest(path.ray, hint_[0]);
      hint_[0] = first.triangle;
    }
    follow(path, first, sum);
    std::uint32_t* const to = &sums[(static_cast<std::uint32_t>(x) >> grid_.shift) * channels];
    for (std::uint32_t c = 0; c < channels; ++c) {
      const std::uint64_t fine = roll_ ? rolled(sum[c] >> 16) << 16 : sum[c];
      const std::uint64_t steps = (fine + (std::uint64_t{1} << (15 + kFineBits))) >> (16 + kFineBits);
      to[c] += steps < kWhite ? static_cast<std::uint32_t>(steps) : kWhite;
    }
  }
}

/// v = (L - MIN) / (MAX - MIN) becomes 1 - 1 / (4 v) where it is above a half (display.h).
std::uint64_t PictureOptics::rolled(std::uint64_t fine) const {
  const std::uint64_t range = (std::uint64_t{kWhite} << kFineBits) - black_;
  if (fine <= black_ || 2 * (fine - black_) <= range) return fine;
  return black_ + range - range * range / (4 * (fine - black_));
}

/// Sums part times luminance along the path and all that branches off.
void PictureOptics::follow(const Path& start, const RayHit& first, Colour& sum) {
  Path path = start;
  RayHit hit = first;
  waiting_count_ = 0;
  std::uint32_t depth = 1;
  for (;;) {
    for (; hit.any() && pass(hit, path, sum); ++depth) {
      std::uint32_t& hint = hint_[depth < kHints ? depth : kHints - 1];
      hit = tree_.nearest_after(path.ray, hit, hint);
      hint = hit.triangle;
    }
    if (!hit.any()) add_background(path, sum);
    if (waiting_count_ == 0) return;
    path = waiting_[--waiting_count_];
    std::uint32_t& hint = hint_[depth < kHints ? depth : kHints - 1];
    hit = tree_.nearest(path.ray, hint);
    hint = hit.triangle;
    ++depth;
  }
}

/// Adds what the hit shows and puts its reflection aside; true if the path goes on behind it.
bool PictureOptics::pass(const RayHit& hit, Path& path, Colour& sum) {
  const DrawnTriangle& drawn = geometry_->drawn[hit.triangle];
  const std::uint32_t optics = optics_at(drawn);
  if (hit.front) add_surface(drawn, hit, path, sum);
  if (optics == kNone) return false;
  if (hit.front && scene_->optics[optics].highlight > 0) add_highlight(drawn, hit, path, optics, sum);
  Path way = path;
  if (hit.front && path.reflections < kMostReflections && waiting_count_ < kMostWaiting &&
      weaken(way.part, parts_[optics].reflect, scene_->channels)) {
    way.ray = {point_before(drawn, path.ray, hit), mirrored(drawn, path.ray.direction)};
    ++way.reflections;
    waiting_[waiting_count_++] = way;
  }
  return weaken(path.part, parts_[optics].transmit, scene_->channels);
}

void PictureOptics::add_surface(const DrawnTriangle& drawn, const RayHit& hit, const Path& path, Colour& sum) const {
  const std::uint32_t channels = scene_->channels;
  const MapPlace at = drawn.mesh == kNone ? MapPlace{} : map_place(drawn, hit);
  for (std::uint32_t c = 0; c < channels; ++c) {
    const std::uint32_t value = drawn.mesh == kNone ? light_[drawn.light * channels + c] : map_value(drawn, at, c);
    sum[c] += std::uint64_t{path.part[c]} * value;
  }
}

/// The mesh's map there, bilinear, fine steps.
std::uint32_t PictureOptics::map_value(const DrawnTriangle& drawn, const MapPlace& place, std::uint32_t c) const {
  const Mesh& mesh = scene_->meshes[drawn.mesh];
  const std::uint32_t width = mesh.map_width(), channels = scene_->channels;
  const Between u = between(place.u, static_cast<std::int32_t>(width), mesh.wraps_u);
  const Between v = between(place.v, static_cast<std::int32_t>(mesh.map_height()), false);
  const auto texel = [&](std::int32_t at_u, std::int32_t at_v) {
    const std::size_t at = mesh.first_sub_patch + std::size_t{static_cast<std::uint32_t>(at_v)} * width +
                           static_cast<std::uint32_t>(at_u);
    return std::uint64_t{maps_.texel[at * channels + c]};
  };
  const std::uint64_t low = texel(u.low, v.low) * (4096 - u.weight) + texel(u.high, v.low) * u.weight;
  const std::uint64_t high = texel(u.low, v.high) * (4096 - u.weight) + texel(u.high, v.high) * u.weight;
  return static_cast<std::uint32_t>((low * (4096 - v.weight) + high * v.weight) >> (24 - kFineBits));
}

void PictureOptics::add_highlight(const DrawnTriangle& drawn, const RayHit& hit, const Path& path,
                                  std::uint32_t optics, Colour& sum) const {
  const HighlightView view{&drawn, point_before(drawn, path.ray, hit), mirrored(drawn, path.ray.direction)};
  double luminance[3] = {0, 0, 0};
  highlights_.add(optics, view, luminance);
  for (std::uint32_t c = 0; c < scene_->channels; ++c) sum[c] += std::uint64_t{path.part[c]} * fine_steps(luminance[c]);
}

void PictureOptics::add_background(const Path& path, Colour& sum) const {
  if (scene_->background.empty()) return;
  const LatticeVector& way = path.ray.direction;
  const LatticeVector d{way.x >> 5, way.y >> 5, way.z >> 5};
  const std::int64_t rise = dot(d, up_);  // at most 2^31.6
  // The square of the sine, in 65536ths: 32 bits over 16.
  const std::uint64_t whole = static_cast<std::uint64_t>(dot(d, d)) * static_cast<std::uint64_t>(dot(up_, up_));
  const std::uint64_t size = static_cast<std::uint64_t>(rise < 0 ? -rise : rise);
  const int right = 48 - std::countl_zero(whole | 1) > 0 ? 48 - std::countl_zero(whole | 1) : 0;
  const std::uint32_t below = static_cast<std::uint32_t>(whole >> right);
  const std::uint64_t above = size * size >> right << 16;
  const std::uint32_t squared =
      below == 0 ? 0 : above >= std::uint64_t{below} << 16 ? kWhole : static_cast<std::uint32_t>(above) / below;
  const std::uint64_t high = squared < kWhole ? squared : kWhole;
  for (std::uint32_t c = 0; c < scene_->channels; ++c) {
    const std::uint64_t sky = (horizon_[c] * (kWhole - high) + zenith_[c] * high) >> 16;
    sum[c] += path.part[c] * (rise < 0 ? std::uint64_t{ground_[c]} : sky);
  }
}

}  // namespace shodo
