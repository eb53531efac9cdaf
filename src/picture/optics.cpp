#include "picture/optics.h"

#include "picture/beam.h"

namespace shodo {

namespace {

constexpr double kTolerance = 1.0 / 32;           // sub-patches, as in shade.h
constexpr std::uint32_t kMostFine = 1u << 28;     // of one surface between samples: 128 times white
// By how much a highlight or a plain background may bend: a step, and a part of its value. It is then filled by two
// lines, which are off by a quarter of that.
constexpr std::uint32_t kBends = 1u << kFineBits;
constexpr double kBendsOf = 1.0 / 64;             // of a highlight
constexpr double kBackgroundBendsOf = 1.0 / 256;  // under a level of sRGB where it is bright

double distance(double a, double b) { return a < b ? b - a : a - b; }

/// Where a row's samples lie on a plane that two of them see, `n` samples apart.
class RowOnPlane {
 public:
  RowOnPlane(const PathHit& a, const PathHit& b, std::int32_t n)
      : a_(a), z_(a.nearness), dz_((b.nearness - a.nearness) / n), over_n_(1.0 / n), weight_b_(b.nearness / n),
        du_(b.u - a.u), dv_(b.v - a.v), n_(n), end_(b) {}

  TexturePlace at(std::int32_t k) const {
    TexturePlace place;
    place.u = a_.u;
    place.v = a_.v;
    place.inverse_depth = z_ + k * dz_;
    if (k == 0) return place;
    const double f = k * weight_b_ / place.inverse_depth;
    place.u = k == n_ ? end_.u : a_.u + f * du_;
    place.v = k == n_ ? end_.v : a_.v + f * dv_;
    return place;
  }
  /// What a step changes is linear over the square of the inverse depth.
  double step_at(std::int32_t k) const {
    const double from = a_.step * a_.nearness * a_.nearness, to = end_.step * end_.nearness * end_.nearness;
    const double z = z_ + k * dz_;
    return (from + k * over_n_ * (to - from)) / (z * z);
  }

 private:
  const PathHit& a_;
  double z_, dz_, over_n_, weight_b_, du_, dv_;
  std::int32_t n_;
  const PathHit& end_;
};

bool is_straight(const TexturePlace& a, const TexturePlace& b) {
  const double near = a.inverse_depth > b.inverse_depth ? a.inverse_depth : b.inverse_depth;
  const double far = a.inverse_depth + b.inverse_depth - near, u = distance(a.u, b.u), v = distance(a.v, b.v);
  return (u > v ? u : v) * (near - far) <= 4 * kTolerance * far;
}

/// Pieces of samples 0 .. n, each at most `longest` and straight: show(first, length, start, end).
template <class PlaceAt, class Straight, class Show>
void cut(std::int32_t n, std::int32_t longest, PlaceAt place_at, Straight straight, Show show) {
  TexturePlace start = place_at(0);
  for (std::int32_t k = 0; k < n;) {
    std::int32_t reach = n - k < longest ? n - k : longest;
    TexturePlace end;
    for (;; reach = (reach + 1) / 2) {
      end = place_at(k + reach);
      if (reach == 1 || straight(start, end)) break;
    }
    show(k, reach, start, end);
    k += reach;
    start = end;
  }
}

/// Whether all of a triangle is on the other side of a plane, or in it; `front`: the side that counts.
bool is_beyond(const DrawnTriangle& triangle, const DrawnTriangle& plane, bool front, bool& all_in_plane) {
  all_in_plane = true;
  for (const LatticePoint& p : triangle.vertex) {
    const std::int64_t side = side_of(plane, p);
    if (front ? side > 0 : side < 0) return false;
    all_in_plane = all_in_plane && side == 0;
  }
  return true;
}

/// Whether the k-th hit is seen without a mirror on the way.
bool seen_straight(const PathRecord& record, std::uint32_t k) {
  for (; record.hit[k].parent != kNoHit; k = record.hit[k].parent) {
    if (record.hit[k].reflected) return false;
  }
  return true;
}

}  // namespace

bool PictureOptics::start(const Shown& shown, const Display& display, Arena& arena) {
  const Scene& scene = shown.scene;
  scene_ = &scene;
  geometry_ = &shown.geometry;
  grid_ = &shown.grid;
  roll_ = display.roll;
  const std::size_t samples = std::size_t{kLongestReach} * scene.channels;
  if (!paths_.start(scene, shown.geometry, shown.maps, shown.grid, shown.textures, arena) ||
      !arena.take("meshes in one plane", scene.meshes.size(), whole_) ||
      !arena.take("traced samples", kRecords, records_) || !arena.take("samples between", samples, fine_) ||
      !arena.take("steps of samples between", samples, steps_)) {
    return false;
  }
  black_ = paths_.fine_steps(display.min_cd_m2);
  const Vec3 across = vector_of(shown.grid.across()), square = cross(across, vector_of(shown.grid.down()));
  const double eye = magnitude(dot(square, vector_of(shown.grid.direction(0, 0)))) / length(square);
  const double reach = kBackgroundAngle * eye / length(across);
  background_reach_ = reach < 2 ? 1 : reach < kBackgroundReach ? static_cast<std::int32_t>(reach) : kBackgroundReach;
  for (std::size_t m = 0; m < whole_.size(); ++m) whole_[m] = scene.meshes[m].kind == MeshKind::kQuad ? 1 : 0;
  const std::span<const DrawnTriangle> drawn = shown.geometry.drawn;
  for (std::size_t t = 1; t < drawn.size(); ++t) {
    if (drawn[t].mesh == kNone || drawn[t].mesh != drawn[t - 1].mesh) continue;
    if (shown.carriers[t] != shown.carriers[t - 1]) whole_[drawn[t].mesh] = 0;
  }
  return true;
}

std::uint64_t PictureOptics::bytes(const Scene& scene, const Geometry& geometry) {
  if (!used(scene)) return 0;
  const auto block = [](std::uint64_t bytes) { return (bytes + 7) / 8 * 8; };
  const std::uint64_t samples = std::uint64_t{kLongestReach} * scene.channels;
  return LightPaths::bytes(scene, geometry) + block(scene.meshes.size()) + block(sizeof(PathRecord) * kRecords) +
         2 * block(4 * samples);
}

void PictureOptics::add(std::uint32_t triangle, std::int32_t x0, std::int32_t x1, std::uint32_t row,
                        std::span<std::uint32_t> sums) {
  triangle_ = triangle;
  row_ = row;
  sums_ = sums;
  RunWalk runs(x0, x1, grid_->split - grid_->parts);
  while (runs.next(run_)) add_run();
}

void PictureOptics::add_run() {
  if (run_.x1 - run_.x0 < 3) {
    for (std::int32_t x = run_.x0; x < run_.x1; ++x) trace(x, nullptr);
    return;
  }
  std::uint32_t left = 0;
  trace(run_.x0, &records_[left]);
  std::int32_t reach = kLongestReach;
  for (std::int32_t x = run_.x0; x + 1 < run_.x1; x = records_[left].x) {
    const std::int32_t to = run_.x1 - 1 - x < reach ? run_.x1 - 1 : x + reach;
    const bool easy = join_up_to(to, left);
    if (easy && reach < kLongestReach) reach *= 2;
    if (!easy && reach > 4) reach /= 2;
  }
}

/// From the record `left` to sample x, of which `left` becomes the record. True if it took one step.
bool PictureOptics::join_up_to(std::int32_t x, std::uint32_t& left) {
  std::uint32_t stack[kRecords], depth = 0, unused[kRecords], free = 0;
  for (std::uint32_t k = 0; k < kRecords; ++k) {
    if (k != left) unused[free++] = k;
  }
  const auto push = [&](std::int32_t at) {
    stack[depth++] = unused[--free];
    trace(at, &records_[stack[depth - 1]]);
  };
  const auto pop = [&] {
    unused[free++] = left;
    left = stack[--depth];
  };
  push(x);
  bool easy = true;
  while (depth > 0) {
    const PathRecord &a = records_[left], &b = records_[stack[depth - 1]];
    if (b.x - a.x <= 1) {
      pop();
      continue;
    }
    const Join how = join(a, b);
    if (how == Join::kYes) {
      fill(a, b);
      pop();
      continue;
    }
    push(a.x + (b.x - a.x) / 2);
    const PathRecord& middle = records_[stack[depth - 1]];
    if (how == Join::kIfMiddleAgrees && agrees(a, middle, b)) {
      fill(a, middle);
      pop();
      fill(middle, b);
      pop();
      continue;
    }
    easy = false;
  }
  return easy;
}

void PictureOptics::trace(std::int32_t x, PathRecord* record) {
  FineColour sum = {0, 0, 0};
  paths_.trace(run_.column_of(x), row_, triangle_, sum, record);
  if (record != nullptr) record->x = x;
  std::uint32_t* const sums = &sums_[(static_cast<std::uint32_t>(x) >> grid_->parts) * scene_->channels];
  for (std::uint32_t c = 0; c < scene_->channels; ++c) {
    const std::uint64_t fine = roll_ ? rolled(sum[c] >> 16) << 16 : sum[c];
    const std::uint64_t steps = (fine + (std::uint64_t{1} << (15 + kFineBits))) >> (16 + kFineBits);
    sums[c] += run_.first * (steps < kWhite ? static_cast<std::uint32_t>(steps) : kWhite);
  }
}

/// v = (L - MIN) / (MAX - MIN) becomes 1 - 1 / (4 v) where it is above a half (display.h).
std::uint64_t PictureOptics::rolled(std::uint64_t fine) const {
  const std::uint64_t range = (std::uint64_t{kWhite} << kFineBits) - black_;
  if (fine <= black_ || 2 * (fine - black_) <= range) return fine;
  return black_ + range - range * range / (4 * (fine - black_));
}

bool PictureOptics::same_surface(const PathHit& a, const PathHit& b) const {
  if (a.front != b.front || a.reflected != b.reflected || a.parent != b.parent || a.shines != b.shines) return false;
  if (a.triangle == b.triangle) return true;
  if (a.triangle == kNone || b.triangle == kNone) return false;
  const std::uint32_t mesh = geometry_->drawn[a.triangle].mesh;
  return mesh != kNone && mesh == geometry_->drawn[b.triangle].mesh && whole_[mesh] != 0;
}

/// Over how many samples the k-th hit, the background, may be told from the ends.
std::int32_t PictureOptics::background_reach(const PathRecord& record, std::uint32_t k) const {
  if (!paths_.has_picture()) return background_reach_;
  return seen_straight(record, k) ? kLongestReach : 2;
}

/// Whether the samples between see what both see.
PictureOptics::Join PictureOptics::join(const PathRecord& a, const PathRecord& b) const {
  if (a.count != b.count || a.count > kMostPathHits || a.sought != b.sought) return Join::kNo;
  bool shines = false, bends = false;
  for (std::uint32_t k = 0; k < a.count; ++k) {
    if (!same_surface(a.hit[k], b.hit[k])) return Join::kNo;
    if (a.hit[k].triangle == kNone && b.x - a.x > background_reach(a, k)) return Join::kNo;
    bends = bends || may_bend(a.hit[k]);
    shines = shines || a.hit[k].shines;
  }
  // What was sought though the scanline knew it is met at a grazing angle.
  if (a.sought && !paths_.tree().invisible(geometry_->drawn[triangle_], true)) return Join::kNo;
  for (std::uint32_t k = a.sought ? 0 : 1; k < a.count; ++k) {
    if (!nothing_between(a, b, k)) return Join::kNo;
  }
  for (std::uint32_t k = 0; k < a.count && shines; ++k) {
    const PathHit &here = a.hit[k], &there = b.hit[k];
    if (!here.shines) continue;
    const DrawnTriangle &at_a = geometry_->drawn[here.triangle], &at_b = geometry_->drawn[there.triangle];
    const HighlightView from{&at_a, here.at, {here.mirrored[0], here.mirrored[1], here.mirrored[2]}},
        to{&at_b, there.at, {there.mirrored[0], there.mirrored[1], there.mirrored[2]}};
    const bool lamps = here.lamps || there.lamps;
    if (!paths_.highlights().even(paths_.optics_at(at_a), from, to, lamps)) return Join::kNo;
  }
  return bends ? Join::kIfMiddleAgrees : Join::kYes;
}

/// Whether no triangle comes between the k-th surface and the one before it, from either sample's ray to the other's.
bool PictureOptics::nothing_between(const PathRecord& a, const PathRecord& b, std::uint32_t k) const {
  const PathHit &here = a.hit[k], &there = b.hit[k];
  const bool from_eye = here.parent == kNoHit;
  const PathHit* const parent = from_eye ? nullptr : &a.hit[here.parent];
  const Beam beam(from_eye ? grid_->eye : parent->at, from_eye ? grid_->eye : b.hit[here.parent].at, here.at, there.at);
  const std::span<const DrawnTriangle> drawn = geometry_->drawn;
  return paths_.tree().visit_in(beam, [&](std::uint32_t t) {
    if (t == here.triangle || t == there.triangle) return true;
    const DrawnTriangle& triangle = drawn[t];
    bool in_plane;
    // Off a surface rays go on before it, through it on its other side.
    const bool starts_in_front = from_eye || here.reflected || !parent->front;
    if (!from_eye && is_beyond(triangle, drawn[parent->triangle], starts_in_front, in_plane)) return true;
    if (here.triangle != kNone && is_beyond(triangle, drawn[here.triangle], here.front, in_plane)) {
      // Another surface in the same plane may be what is seen there.
      return !in_plane || triangle.mesh == drawn[here.triangle].mesh;
    }
    return paths_.tree().invisible(triangle, true) && paths_.tree().invisible(triangle, false);
  });
}

/// Highlights and a plain background are shown as lines between two samples, if they are.
bool PictureOptics::may_bend(const PathHit& hit) const {
  return hit.shines || (hit.triangle == kNone && !paths_.has_picture());
}

/// Whether what may bend goes on as lines.
bool PictureOptics::agrees(const PathRecord& a, const PathRecord& middle, const PathRecord& b) const {
  if (middle.count != a.count || middle.sought != a.sought) return false;
  const double along = static_cast<double>(middle.x - a.x) / (b.x - a.x);
  for (std::uint32_t k = 0; k < a.count; ++k) {
    if (!same_surface(a.hit[k], middle.hit[k])) return false;
    if (!may_bend(a.hit[k])) continue;
    const double of = a.hit[k].shines ? kBendsOf : kBackgroundBendsOf;
    for (std::uint32_t c = 0; c < scene_->channels; ++c) {
      const double from = a.hit[k].shown[c], to = b.hit[k].shown[c], found = middle.hit[k].shown[c];
      if (distance(from + along * (to - from), found) > kBends + of * found) return false;
    }
  }
  return true;
}

/// Shows the samples between two that met the same.
void PictureOptics::fill(const PathRecord& a, const PathRecord& b) {
  const std::uint32_t channels = scene_->channels;
  const std::int32_t n = b.x - a.x;
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(n) * channels; ++k) fine_[k] = 0;
  std::uint32_t part[kMostPathHits][3];
  for (std::uint32_t k = 0; k < a.count; ++k) {
    const PathHit &here = a.hit[k], &there = b.hit[k];
    for (std::uint32_t c = 0; c < 3; ++c) part[k][c] = here.parent == kNoHit ? kWholePart : part[here.parent][c];
    if (here.parent != kNoHit) {
      const PathParts& parts = paths_.parts(paths_.optics_at(geometry_->drawn[a.hit[here.parent].triangle]));
      weaken(part[k], here.reflected ? parts.reflect : parts.transmit, channels);
    }
    if (here.triangle == kNone && add_outdoors(a, k, part[k], n)) continue;
    if (here.triangle == kNone || here.shines) add_line(here.shown, there.shown, part[k], n);
    if (here.triangle == kNone || !here.front) continue;
    const DrawnTriangle& drawn = geometry_->drawn[here.triangle];
    if (glass_of(*scene_, drawn) != kNone) continue;
    if (drawn.mesh == kNone) {
      std::uint32_t light[3] = {0, 0, 0};
      for (std::uint32_t c = 0; c < channels; ++c) light[c] = paths_.light(drawn.light, c);
      add_line(light, light, part[k], n);
    } else if (paths_.texture_of_mesh(drawn.mesh) != nullptr) {
      add_textured(here, there, part[k], n);
    } else {
      add_map(here, there, part[k], n);
    }
  }
  for (std::int32_t k = 1; k < n; ++k) {
    std::uint32_t* const sums = &sums_[(static_cast<std::uint32_t>(a.x + k) >> grid_->parts) * channels];
    for (std::uint32_t c = 0; c < channels; ++c) {
      const std::uint32_t found = fine_[static_cast<std::uint32_t>(k) * channels + c];
      const std::uint32_t fine = roll_ ? static_cast<std::uint32_t>(rolled(found)) : found;
      const std::uint32_t steps = (fine + (1u << (kFineBits - 1))) >> kFineBits;
      sums[c] += run_.first * (steps < kWhite ? steps : kWhite);
    }
  }
}

/// A background with a picture, sample by sample, where glass at most is on the way; false if it isn't that.
bool PictureOptics::add_outdoors(const PathRecord& a, std::uint32_t hit, const std::uint32_t (&part)[3],
                                 std::int32_t n) {
  if (!paths_.has_picture() || !seen_straight(a, hit)) return false;
  const std::uint32_t channels = scene_->channels;
  for (std::int32_t k = 1; k < n; ++k) {
    std::uint32_t shown[3];
    paths_.background(ray_direction(grid_->direction(run_.column_of(a.x + k), row_)), shown);
    for (std::uint32_t c = 0; c < channels; ++c) {
      const std::uint32_t all = static_cast<std::uint32_t>(std::uint64_t{shown[c]} * part[c] >> 16);
      fine_[static_cast<std::uint32_t>(k) * channels + c] += all < kMostFine ? all : kMostFine;
    }
  }
  return true;
}

/// Adds part times what goes from one value to the other.
void PictureOptics::add_line(const std::uint32_t (&from)[3], const std::uint32_t (&to)[3],
                             const std::uint32_t (&part)[3], std::int32_t n) {
  const std::uint32_t channels = scene_->channels;
  for (std::uint32_t c = 0; c < channels; ++c) {
    const auto weak = [&](std::uint32_t value) {
      const std::uint32_t all = static_cast<std::uint32_t>(std::uint64_t{value} * part[c] >> 16);
      return static_cast<std::int32_t>(all < kMostFine ? all : kMostFine);
    };
    // 2 more bits: 31 in all.
    const std::int32_t start = weak(from[c]), step = ((weak(to[c]) - start) * 4) / n;
    std::int32_t value = start * 4 + 2;
    std::uint32_t* fine = &fine_[c];
    for (std::int32_t k = 1; k < n; ++k) {
      value += step;
      fine += channels;
      *fine += static_cast<std::uint32_t>(value) >> 2;
    }
  }
}

void PictureOptics::add_map(const PathHit& a, const PathHit& b, const std::uint32_t (&part)[3], std::int32_t n) {
  const std::uint32_t channels = scene_->channels, values = static_cast<std::uint32_t>(n) * channels;
  const MapTexels map = paths_.texels_of(scene_->meshes[geometry_->drawn[a.triangle].mesh]);
  const RowOnPlane row(a, b, n);
  for (std::uint32_t k = 0; k < values; ++k) steps_[k] = 0;
  cut(n, n, [&](std::int32_t k) { return row.at(k); }, is_straight,
      [&](std::int32_t k, std::int32_t reach, const TexturePlace& start, const TexturePlace& end) {
        const double share = 1.0 / reach;
        add_piece(map, {k, reach, fixed_point(start.u, 12), fixed_point(start.v, 12),
                        fixed_point((end.u - start.u) * share, 16), fixed_point((end.v - start.v) * share, 16)},
                  steps_.data());
      });
  for (std::uint32_t k = channels; k < values; k += channels) {
    for (std::uint32_t c = 0; c < channels; ++c) {
      const std::uint32_t steps = steps_[k + c] < 65535 ? steps_[k + c] : 65535;
      fine_[k + c] += steps * part[c] >> (16 - kFineBits);
    }
  }
}

void PictureOptics::add_textured(const PathHit& a, const PathHit& b, const std::uint32_t (&part)[3], std::int32_t n) {
  const std::uint32_t channels = scene_->channels, mesh = geometry_->drawn[a.triangle].mesh;
  const TextureShade shade(*scene_, scene_->meshes[mesh], *paths_.texture_of_mesh(mesh),
                           paths_.texels_of(scene_->meshes[mesh]));
  const RowOnPlane row(a, b, n);
  const auto place_at = [&](std::int32_t k) {
    TexturePlace place = row.at(k);
    place.step = row.step_at(k);
    shade.set_texture_place(place);
    return place;
  };
  cut(n, TextureShade::kReach, place_at,
      [&](const TexturePlace& start, const TexturePlace& end) { return shade.straight(start, end); },
      [&](std::int32_t first, std::int32_t reach, const TexturePlace& start, const TexturePlace& end) {
        shade.show_piece(reach, reach, start, end, 65535, [&](std::int32_t k, const std::uint32_t (&steps)[3]) {
          const std::uint32_t at = static_cast<std::uint32_t>(first + k) * channels;
          for (std::uint32_t c = 0; c < channels; ++c) fine_[at + c] += steps[c] * part[c] >> (16 - kFineBits);
        });
      });
}

}  // namespace shodo
