#include "picture/light_path.h"

#include <bit>

namespace shodo {

namespace {

std::uint32_t part_of(double part) { return static_cast<std::uint32_t>(part * kWholePart + 0.5); }

bool any(const std::uint32_t (&part)[3], std::uint32_t channels) {
  for (std::uint32_t c = 0; c < channels; ++c) {
    if (part[c] != 0) return true;
  }
  return false;
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

LatticeVector normal_of(const DrawnTriangle& t) { return cross(t.vertex[1] - t.vertex[0], t.vertex[2] - t.vertex[0]); }

/// A map coordinate of a hit, sub-patches.
double coordinate(const std::int32_t (&at)[3], double b, double c) {
  return (at[0] + (b * (static_cast<double>(at[1]) - at[0]) + c * (static_cast<double>(at[2]) - at[0]))) / 256;
}

double weight(std::int64_t part, double over_speed) { return static_cast<double>(part) * over_speed; }

}  // namespace

bool weaken(std::uint32_t (&part)[3], const std::uint32_t (&by)[3], std::uint32_t channels) {
  for (std::uint32_t c = 0; c < channels; ++c) {
    part[c] = static_cast<std::uint32_t>(std::uint64_t{part[c]} * by[c] >> 16);
  }
  return any(part, channels);
}

std::uint32_t LightPaths::fine_steps(double luminance_cd_m2) const {
  // Here luminances become integers.
  const double steps = luminance_cd_m2 / scene_->display.max_cd_m2 * (kWhite << kFineBits) + 0.5;
  if (!(steps >= 1)) return 0;
  return steps >= kBrightest ? kBrightest : static_cast<std::uint32_t>(steps);
}

bool LightPaths::start(const Scene& scene, const Geometry& geometry, const DisplayMaps& maps, const SampleGrid& grid,
                       std::span<const MeshTexture> textures, Arena& arena) {
  scene_ = &scene;
  geometry_ = &geometry;
  maps_ = maps;
  grid_ = &grid;
  textures_ = textures;
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
  picture_.start(scene, grid, fine_steps(background.luminance));
  return true;
}

std::uint64_t LightPaths::bytes(const Scene& scene, const Geometry& geometry) {
  const auto block = [](std::uint64_t bytes) { return (bytes + 7) / 8 * 8; };
  return RayTree::bytes(geometry.drawn.size()) + block(sizeof(PathParts) * scene.optics.size()) +
         block(4 * std::uint64_t{scene.lights.size()} * scene.channels) + block(sizeof(Path) * kMostWaiting) +
         Highlights::bytes(scene);
}

std::uint32_t LightPaths::optics_at(const DrawnTriangle& drawn) const {
  const std::uint32_t glass = glass_of(*scene_, drawn);
  if (drawn.mesh == kNone && glass == kNone) return kNone;
  const Optics* const found =
      scene_->optics_of(glass == kNone ? scene_->meshes[drawn.mesh].material : scene_->glass[glass].material);
  return found == nullptr ? kNone : static_cast<std::uint32_t>(found - scene_->optics.data());
}

bool LightPaths::goes_on(const DrawnTriangle& drawn, bool front) const {
  if (tree_.invisible(drawn, front)) return true;
  const std::uint32_t optics = optics_at(drawn);
  return optics != kNone && (front || any(parts_[optics].transmit, scene_->channels));
}

MapTexels LightPaths::texels_of(const Mesh& mesh) const {
  MapTexels texels;
  texels.texel = &maps_.texel[std::size_t{mesh.first_sub_patch} * scene_->channels];
  texels.width = static_cast<std::int32_t>(mesh.map_width());
  texels.height = static_cast<std::int32_t>(mesh.map_height());
  texels.channels = scene_->channels;
  texels.wraps_u = mesh.wraps_u;
  return texels;
}

void LightPaths::trace(std::int32_t column, std::uint32_t row, std::uint32_t triangle, FineColour& sum,
                       PathRecord* record) {
  direction_ = grid_->direction(column, row);
  Path path{{grid_->eye, ray_direction(direction_)}, {kWholePart, kWholePart, kWholePart}, 0, kNoHit, false, {}, 0, 1};
  if (record != nullptr || !textures_.empty()) {
    direction_length_ = length(vector_of(direction_));
    path.speed = length(vector_of(path.ray.direction));
  }
  RayHit first;
  // At an edge the rounded ray may miss what the sample sees: it meets something else then, or on a seam of a pane the
  // triangle beyond, once.
  const bool sought = triangle != kNone && (tree_.invisible(geometry_->drawn[triangle], true) ||
                                            !meet(geometry_->drawn[triangle], triangle, path.ray, first));
  if (sought) {
    first = tree_.nearest(path.ray, hint_[0]);
    hint_[0] = first.triangle;
  }
  if (record != nullptr) {
    record->count = 0;
    record->sought = sought;
  }
  follow(path, first, sum, record);
}

/// Sums part times luminance along the path and all that branches off.
void LightPaths::follow(const Path& start, const RayHit& first, FineColour& sum, PathRecord* record) {
  Path path = start;
  RayHit hit = first;
  waiting_count_ = 0;
  std::uint32_t depth = 1;
  for (;;) {
    for (; hit.any() && pass(hit, path, sum, record); ++depth) {
      std::uint32_t& hint = hint_[depth < kHints ? depth : kHints - 1];
      hit = tree_.nearest_after(path.ray, hit, hint);
      hint = hit.triangle;
    }
    if (!hit.any()) add_background(path, sum, record);
    if (waiting_count_ == 0) return;
    path = waiting_[--waiting_count_];
    std::uint32_t& hint = hint_[depth < kHints ? depth : kHints - 1];
    hit = tree_.nearest(path.ray, hint);
    hint = hit.triangle;
    ++depth;
  }
}

/// From the eye to a hit, lattice steps.
double LightPaths::way_to(const RayHit& hit, const Path& path) const {
  return path.length + static_cast<double>(hit.distance) / static_cast<double>(hit.speed) * path.speed;
}

/// Null: not kept.
PathHit* LightPaths::note(const RayHit& hit, const Path& path, PathRecord* record) const {
  if (record == nullptr || record->count++ >= kMostPathHits) return nullptr;
  PathHit& noted = record->hit[record->count - 1];
  noted.triangle = hit.triangle;
  noted.front = hit.front;
  noted.reflected = path.reflected;
  noted.parent = path.parent;
  noted.shines = false;
  if (hit.any()) {
    noted.at = point_at(path.ray, hit);
    noted.nearness = direction_length_ / way_to(hit, path);
  }
  return &noted;
}

/// Adds what the hit shows and puts its reflection aside; true if the path goes on behind it.
bool LightPaths::pass(const RayHit& hit, Path& path, FineColour& sum, PathRecord* record) {
  const DrawnTriangle& drawn = geometry_->drawn[hit.triangle];
  const std::uint32_t optics = optics_at(drawn);
  PathHit* const noted = note(hit, path, record);
  if (hit.front) add_surface(drawn, hit, path, sum, noted);
  if (optics == kNone) return false;
  if (record != nullptr) path.parent = static_cast<std::uint8_t>(record->count - 1);
  const bool shines = hit.front && scene_->optics[optics].highlight > 0;
  Path way = path;
  const bool reflects = hit.front && path.reflections < kMostReflections && waiting_count_ < kMostWaiting &&
                        weaken(way.part, parts_[optics].reflect, scene_->channels);
  if (shines || reflects) {
    const LatticePoint point = point_before(drawn, path.ray, hit);
    const LatticeVector direction = mirrored(drawn, path.ray.direction);
    if (shines) add_highlight(drawn, point, direction, path, optics, sum, noted);
    if (reflects) {
      way.ray = {point, direction};
      way.mirror[way.reflections++] = hit.triangle;
      way.reflected = true;
      if (record != nullptr || !textures_.empty()) {
        way.length = way_to(hit, path);
        way.speed = length(vector_of(direction));
      }
      waiting_[waiting_count_++] = way;
    }
  }
  path.reflected = false;
  return weaken(path.part, parts_[optics].transmit, scene_->channels);
}

void LightPaths::add_surface(const DrawnTriangle& drawn, const RayHit& hit, const Path& path, FineColour& sum,
                             PathHit* noted) const {
  const std::uint32_t channels = scene_->channels;
  if (glass_of(*scene_, drawn) != kNone) return;
  if (drawn.mesh == kNone) {
    for (std::uint32_t c = 0; c < channels; ++c) sum[c] += std::uint64_t{path.part[c]} * light(drawn.light, c);
    return;
  }
  if (texture_of_mesh(drawn.mesh) != nullptr) return add_textured(drawn, hit, path, sum, noted);
  if (noted != nullptr) {
    const double over = 1 / static_cast<double>(hit.speed), b = weight(hit.b, over), c = weight(hit.c, over);
    noted->u = coordinate(drawn.u, b, c);
    noted->v = coordinate(drawn.v, b, c);
  }
  const MapPlace at = map_place(drawn, hit);
  for (std::uint32_t c = 0; c < channels; ++c) sum[c] += std::uint64_t{path.part[c]} * map_value(drawn, at, c);
}

void LightPaths::add_textured(const DrawnTriangle& drawn, const RayHit& hit, const Path& path, FineColour& sum,
                              PathHit* noted) const {
  const Mesh& mesh = scene_->meshes[drawn.mesh];
  const TextureShade shade(*scene_, mesh, *texture_of_mesh(drawn.mesh), texels_of(mesh));
  const double over = 1 / static_cast<double>(hit.speed), b = weight(hit.b, over), c = weight(hit.c, over);
  TexturePlace place;
  place.u = coordinate(drawn.u, b, c);
  place.v = coordinate(drawn.v, b, c);
  place.step = texture_step(drawn, hit, path, shade);
  shade.set_texture_place(place);
  shade.show_piece(1, 0, place, place, 65535, [&](std::int32_t, const std::uint32_t (&steps)[3]) {
    for (std::uint32_t k = 0; k < scene_->channels; ++k) {
      sum[k] += std::uint64_t{path.part[k]} * (steps[k] << kFineBits);
    }
  });
  if (noted == nullptr) return;
  noted->u = place.u;
  noted->v = place.v;
  noted->step = place.step;
}

/// Texels to the neighbours in the row and the column, the more of them.
double LightPaths::texture_step(const DrawnTriangle& drawn, const RayHit& hit, const Path& path,
                                const TextureShade& shade) const {
  Vec3 way[3] = {vector_of(direction_), vector_of(grid_->across()), vector_of(grid_->down())};
  for (std::uint32_t k = 0; k < path.reflections; ++k) {
    const Vec3 n = vector_of(normal_of(geometry_->drawn[path.mirror[k]]));
    const double twice = 2 / dot(n, n);
    for (Vec3& v : way) v = v - (twice * dot(n, v)) * n;
  }
  const Vec3 to_b = vector_of(drawn.vertex[1] - drawn.vertex[0]), to_c = vector_of(drawn.vertex[2] - drawn.vertex[0]);
  const Vec3 n = cross(to_b, to_c);
  const double facing = dot(n, way[0]);
  if (facing == 0) return kCoarsestStep;
  const double t = way_to(hit, path) / direction_length_, over = 1 / dot(n, n);
  double step = 0;
  for (int k = 1; k < 3; ++k) {
    const Vec3 moved = t * (way[k] - (dot(n, way[k]) / facing) * way[0]);
    const double b = dot(cross(moved, to_c), n) * over, c = dot(cross(to_b, moved), n) * over;
    const auto change = [&](const std::int32_t (&at)[3]) {
      return (b * (static_cast<double>(at[1]) - at[0]) + c * (static_cast<double>(at[2]) - at[0])) / 256;
    };
    const double texels = shade.texels(change(drawn.u), change(drawn.v));
    if (texels > step) step = texels;
  }
  return step < kCoarsestStep ? step : kCoarsestStep;
}

/// The mesh's map there, bilinear, fine steps.
std::uint32_t LightPaths::map_value(const DrawnTriangle& drawn, const MapPlace& place, std::uint32_t c) const {
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

void LightPaths::add_highlight(const DrawnTriangle& drawn, const LatticePoint& point, const LatticeVector& mirrored,
                               const Path& path, std::uint32_t optics, FineColour& sum, PathHit* noted) const {
  double luminance[3] = {0, 0, 0};
  const bool lamps = highlights_.add(optics, {&drawn, point, mirrored}, luminance);
  std::uint32_t shown[3] = {0, 0, 0};
  for (std::uint32_t c = 0; c < scene_->channels; ++c) {
    shown[c] = fine_steps(luminance[c]);
    sum[c] += std::uint64_t{path.part[c]} * shown[c];
  }
  if (noted == nullptr) return;
  noted->shines = true;
  noted->lamps = lamps;
  noted->at = point;
  noted->mirrored[0] = static_cast<std::int32_t>(mirrored.x);
  noted->mirrored[1] = static_cast<std::int32_t>(mirrored.y);
  noted->mirrored[2] = static_cast<std::int32_t>(mirrored.z);
  for (std::uint32_t c = 0; c < 3; ++c) noted->shown[c] = shown[c];
}

void LightPaths::add_background(const Path& path, FineColour& sum, PathRecord* record) const {
  const LatticeVector& way = path.ray.direction;
  PathHit* const noted = note({}, path, record);
  if (noted != nullptr) {
    const LatticePoint& from = path.ray.origin;
    noted->at = {static_cast<std::int32_t>(from.x + 2 * way.x), static_cast<std::int32_t>(from.y + 2 * way.y),
                 static_cast<std::int32_t>(from.z + 2 * way.z)};
    for (std::uint32_t& shown : noted->shown) shown = 0;
  }
  if (scene_->background.empty()) return;
  std::uint32_t shown[3];
  const bool sky = background(way, shown);
  if (noted != nullptr) noted->front = sky;
  for (std::uint32_t c = 0; c < scene_->channels; ++c) {
    if (noted != nullptr) noted->shown[c] = shown[c];
    sum[c] += std::uint64_t{path.part[c]} * shown[c];
  }
}

bool LightPaths::background(const LatticeVector& way, std::uint32_t (&shown)[3]) const {
  if (picture_.look_up(way, shown)) return true;
  const LatticeVector d{way.x >> 5, way.y >> 5, way.z >> 5};
  const std::int64_t rise = dot(d, up_);  // at most 2^31.6
  // The square of the sine, in 65536ths: 32 bits over 16.
  const std::uint64_t whole = static_cast<std::uint64_t>(dot(d, d)) * static_cast<std::uint64_t>(dot(up_, up_));
  const std::uint64_t size = static_cast<std::uint64_t>(rise < 0 ? -rise : rise);
  const int right = 48 - std::countl_zero(whole | 1) > 0 ? 48 - std::countl_zero(whole | 1) : 0;
  const std::uint32_t below = static_cast<std::uint32_t>(whole >> right);
  const std::uint64_t above = size * size >> right << 16;
  const std::uint32_t squared =
      below == 0 ? 0 : above >= std::uint64_t{below} << 16 ? kWholePart : static_cast<std::uint32_t>(above) / below;
  const std::uint64_t high = squared < kWholePart ? squared : kWholePart;
  for (std::uint32_t c = 0; c < scene_->channels; ++c) {
    const std::uint64_t sky = (horizon_[c] * (kWholePart - high) + zenith_[c] * high) >> 16;
    shown[c] = rise < 0 ? ground_[c] : static_cast<std::uint32_t>(sky);
  }
  return rise >= 0;
}

}  // namespace shodo
