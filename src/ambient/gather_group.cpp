#include "ambient/gather_group.h"

#include "light/polygon_factor.h"
#include "scene/sub_patches.h"

namespace shodo {

namespace {

// Relative to the error of a node.
constexpr double kTiny = 0.6;
constexpr double kOneSegment = 2, kMostMixed = 8;
constexpr double kOfUneven = 0.5;  // of the unevenness, what a contour's integral makes wrong

constexpr double kSmallest = 16;      // so many times smaller than the mean, patches gather as roughly as any

constexpr double kMostQ = 0.35;       // of the series
constexpr double kSeriesShare = 0.5;  // its error is that times q^2
constexpr double kBelow = 1.0 / 32;   // of a node's longest side, may lie behind the receiver's plane
constexpr double kClose = 3;          // of both longest sides squared: nearer than that is close
constexpr double kPartQ = 0.2;        // sub-patches beyond it send by their contour
constexpr std::int32_t kMoved = 16;   // samples are moved in front of their surface by less than that

std::uint32_t hash_of(std::uint32_t a, std::uint32_t b) {
  std::uint32_t h = a * 0x9E3779B1u + b * 0x85EBCA77u;
  h ^= h >> 15;
  return (h * 0x2C1B3C6Du) >> 16;
}

/// Planar or not, cut or not.
double piece_factor(const Vec3& point, const Vec3& normal, const Piece& piece, bool planar) {
  if (piece.corners == 3 || (planar && !piece.cut)) return point_to_polygon(point, normal, piece.corner, piece.corners);
  const std::uint32_t first = piece.concave ? 1 : 0;
  double sum = 0;
  for (std::uint32_t half = 0; half < 2; ++half) {
    const Vec3 corner[3] = {piece.corner[first], piece.corner[first + 1 + half], piece.corner[(first + 2 + half) & 3]};
    sum += point_to_polygon(point, normal, corner, 3);
  }
  return sum;
}

}  // namespace

void GatherGroup::add(GatherPoint& point, const double* radiosity, double factor) const {
  for (std::uint32_t c = 0; c < scene_.surfaces.scene->channels; ++c) point.lx[c] += factor * radiosity[c];
  point.factor += factor;
}

void GatherGroup::add_close(GatherPoint& point, std::uint32_t k, double weight) const {
  const GatherPoint::Close& close = point.close[k];
  for (std::uint32_t c = 0; c < scene_.surfaces.scene->channels; ++c) point.lx[c] += weight * close.lx[c];
  point.factor += weight * close.factor;
}

/// The free part of so many segments to `ends` (1 or 4) ends; of twice as many if they disagree.
double GatherGroup::visible(GatherPoint& point, std::uint32_t turn, const LatticePoint* to, std::uint32_t ends,
                            std::uint32_t segments, double factor) {
  std::uint32_t free = 0, done = 0;
  for (std::uint32_t most = segments; done < most; ++done) {
    const std::uint32_t origin = (turn + done) & 3, end = (turn / 4 + 3 * done + done / 4) & (ends - 1);
    if (scene_.lists.blocked(point.from[origin], to[end])) {
      point.lost[origin] += static_cast<float>(factor);
    } else {
      ++free;
      point.free |= 1u << origin;
    }
    if (done + 1 == most && most > 1 && most == segments && free > 0 && free <= done) most = 2 * segments;
  }
  const double n = done, f = free;
  point.variance += factor * factor * ((f + 0.5) * (n - f + 0.5) / ((n + 1) * (n + 1) * (n + 2)));
  return f / n;
}

LatticeBox GatherGroup::samples_box(std::uint32_t j) const {
  LatticeBox box;
  const LatticePoint* const samples = scene_.surfaces.samples(j);
  for (std::uint32_t k = 0; k < scene_.surfaces.cached_points; ++k) box.include(samples[k]);
  return box;
}

/// Around all of a block or patch where segments may end.
LatticeBox GatherGroup::whole_box(std::uint32_t j) const {
  const Surfaces& s = scene_.surfaces;
  const double steps = s.geometry->lattice.steps_per_unit;
  const PatchShape& shape = s.shape(j);
  const Patch& patch = s.patch(j);
  LatticeBox box = samples_box(j);
  const double centre[3] = {patch.centre.x, patch.centre.y, patch.centre.z};
  const double a[3] = {shape.a.x, shape.a.y, shape.a.z}, b[3] = {shape.b.x, shape.b.y, shape.b.z};
  const double d[3] = {shape.d.x, shape.d.y, shape.d.z};
  for (int k = 0; k < 3; ++k) {
    if (box.low[k] == box.high[k]) continue;  // square to an axis
    double half = (a[k] < 0 ? -a[k] : a[k]) + (b[k] < 0 ? -b[k] : b[k]) + (d[k] < 0 ? -d[k] : d[k]);
    if (shape.outline != Outline::kQuad) half = 2 * patch.longest_side;
    const std::int32_t low = static_cast<std::int32_t>((centre[k] - half) * steps) - kMoved;
    const std::int32_t high = static_cast<std::int32_t>((centre[k] + half) * steps) + kMoved;
    if (low < box.low[k]) box.low[k] = low;
    if (high > box.high[k]) box.high[k] = high;
  }
  return box;
}

/// Around the samples of a patch and the centres of its sub-patches.
LatticeBox GatherGroup::inner_box(std::uint32_t j, const Mesh& mesh) const {
  LatticeBox box = samples_box(j), whole = whole_box(j);
  const std::uint32_t most = mesh.su > mesh.sv ? mesh.su : mesh.sv;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t inset = (whole.high[k] - whole.low[k]) / static_cast<std::int32_t>(2 * most) - kMoved;
    if (inset <= 0) continue;
    if (whole.low[k] + inset < box.low[k]) box.low[k] = whole.low[k] + inset;
    if (whole.high[k] - inset > box.high[k]) box.high[k] = whole.high[k] - inset;
  }
  return box;
}

/// The kernel to second order over the node, and how much it varies there (ambient/link_series.h).
void GatherGroup::develop(const PatchShape& shape, Look& look) const {
  const bool triangle = shape.outline == Outline::kTriangle;
  const Vec3 a = triangle ? (1 / square_root(6)) * (shape.a - 0.5 * shape.b) : shape.a;
  const Vec3 b = triangle ? (1 / square_root(8)) * shape.b : shape.b;
  const double axes = length_squared(a) + length_squared(b), over_squared = 1 / look.squared;
  look.q = 4.0 / 3 * axes * over_squared;
  look.near = look.near || look.q > kMostQ;
  if (look.near) return;
  const double over_height = 1 / look.over_i;
  double mean = -2 * axes * over_squared;
  for (const Vec3* axis : {&a, &b}) {
    const double u = dot(*axis, look.way) * over_squared, p = dot(*axis, normal_) * over_height;
    mean += u * (12 * u - 4 * p);
    look.vary += (p - 4 * u) * (p - 4 * u);
  }
  look.vary *= 1.0 / 3;
  look.correction = 1 + mean * (1.0 / 3);
  if (look.correction < 0) look.correction = 0;
  look.factor = look.over_i * look.over_j * look.patch->area * (over_squared * over_squared * kInversePi) *
                look.correction;
}

/// False if the node can't be seen.
bool GatherGroup::look_at(std::uint32_t j, Look& look) const {
  const Surfaces& s = scene_.surfaces;
  look.node = j;
  look.patch = &s.patch(j);
  look.way = look.patch->centre - centre_;
  look.over_i = dot(normal_, look.way);
  look.over_j = -dot(look.patch->normal, look.way);
  const double size = look.patch->longest_side;
  if (look.over_j + reach_ <= s.flat || look.over_i + 2 * size <= s.flat) return false;
  look.squared = length_squared(look.way);
  scene_.senders.radiosity(j, look.radiosity);
  look.level = scene_.senders.level_of(look.radiosity);
  look.bound = look.patch->area * look.level / (kPi * look.squared + look.patch->area);
  look.near = !(look.over_j > 0) || !(look.over_i > 0);
  if (look.bound <= kTiny * error_) return !look.near;
  if (look.near) {  // in front in part: then no cosine is larger than that of the part
    const double most = (look.over_j + reach_ < size ? look.over_j + reach_ : size) + 2 * reach_;
    const double height = look.over_i + size < 2 * size ? look.over_i + size : 2 * size;
    const double cosines = (look.over_j > 0 ? 1 : most * most / look.squared) *
                           (look.over_i > 0 ? 1 : height * height / look.squared);
    if (cosines < 1 && look.bound * look.bound * cosines <= kTiny * kTiny * error_ * error_) return false;
  }
  const PatchShape& shape = s.shape(j);
  const Extent extent = extent_along(shape, size, normal_);
  if (look.over_i + extent.high <= s.flat) return false;
  look.near = look.near || look.over_i + extent.low < -kBelow * size || shape.outline == Outline::kConcave;
  if (!look.near) develop(shape, look);
  return true;
}

/// Whether value and gradient at the centre are not enough for the points.
bool GatherGroup::bends(const Look& look, double w) const {
  const double m2 = reach_ * reach_ / look.squared, alpha = reach_ / look.over_j;
  return w * w * m2 * (alpha * alpha + 16 * m2) * (16.0 / 9) > error_ * error_;
}

GatherGroup::Step GatherGroup::consider(std::uint32_t j) {
  const bool block = scene_.surfaces.is_block(j);
  const double error = error_;
  Look look;
  if (!look_at(j, look)) return Step::kDone;
  if (look.bound <= kTiny * error) {
    gather_tiny(look);
    return Step::kDone;
  }
  const double w = look.factor * look.level, uneven = look.factor * scene_.senders.uneven(j);
  const bool rough = look.near || w * kSeriesShare * look.q * look.q > error ||
                     uneven * uneven * look.vary > error * error;
  if (rough && block) return Step::kSplit;
  if (rough) {
    gather_near(look);
    return Step::kDone;
  }
  const bool clear = scene_.lists.clear(samples_box(j), j);
  if (!clear && w > kMostMixed * error) {
    if (block) return Step::kSplit;
    gather_near(look);
    return Step::kDone;
  }
  geometry_error_ += look.factor * kSeriesShare * look.q * look.q;
  if (!clear) {
    const double part = group_visible(look);
    if (part > 0 && part < 1 && w > kOneSegment * error && points_.size() > 1) {
      gather_each(look, false, 2);
      return Step::kDone;
    }
    if (!(part > 0)) return Step::kDone;
    look.factor *= part;
    look.correction *= part;
  }
  if (bends(look, w)) {
    gather_each(look, true, 0);
  } else {
    gather_linear(look);
  }
  return Step::kDone;
}

/// The free part of four segments between the group and the node.
double GatherGroup::group_visible(const Look& look) {
  const LatticePoint* const samples = scene_.surfaces.samples(look.node);
  const std::uint32_t last = scene_.surfaces.cached_points - 1, turn = hash_of(node_, look.node);
  const std::uint32_t points = static_cast<std::uint32_t>(points_.size());
  std::uint32_t free = 0, at = turn % points;
  constexpr std::uint32_t kSegments = 4;
  for (std::uint32_t k = 0; k < kSegments; ++k) {
    GatherPoint& point = points_[at];
    const std::uint32_t origin = (turn / 16 + k) & 3;
    if (scene_.lists.blocked(point.from[origin], samples[(turn / 64 + 3 * k) & last])) {
      point.lost[origin] += static_cast<float>(look.factor);
    } else {
      ++free;
      point.free |= 1u << origin;
    }
    at += points > kSegments ? points / kSegments : 1;
    if (at >= points) at -= points;
  }
  const double n = kSegments, f = free;
  shared_variance_ += look.factor * look.factor * ((f + 0.5) * (n - f + 0.5) / ((n + 1) * (n + 1) * (n + 2)));
  return f / n;
}

void GatherGroup::gather_tiny(const Look& look) {
  const Surfaces& s = scene_.surfaces;
  const double area = look.patch->area;
  const double factor = look.over_i * look.over_j * area / ((kPi * look.squared + area) * look.squared);
  const std::uint32_t turn = hash_of(node_, look.node);
  GatherPoint& point = points_[turn % points_.size()];
  scene_.lists.aim(look.node);
  const std::uint32_t origin = turn >> 4 & 3, end = turn >> 6 & (s.cached_points - 1);
  shared_variance_ += factor * factor * 0.0625;
  if (scene_.lists.blocked(point.from[origin], s.samples(look.node)[end])) return;
  shared_factor_ += factor;
  for (std::uint32_t c = 0; c < s.scene->channels; ++c) {
    shared_lx_[c] += factor * look.radiosity[c];
  }
}

void GatherGroup::gather_linear(const Look& look) {
  const Vec3 slope = look.factor * ((1 / look.over_j) * look.patch->normal + (4 / look.squared) * look.way);
  shared_factor_ += look.factor;
  slope_factor_ = slope_factor_ + slope;
  for (std::uint32_t c = 0; c < scene_.surfaces.scene->channels; ++c) {
    shared_lx_[c] += look.factor * look.radiosity[c];
    slope_lx_[c] = slope_lx_[c] + look.radiosity[c] * slope;
  }
}

void GatherGroup::gather_each(const Look& look, bool clear, std::uint32_t segments) {
  const double weight = look.patch->area * kInversePi * look.correction;
  const LatticePoint* const samples = scene_.surfaces.samples(look.node);
  std::uint32_t turn = hash_of(node_, look.node);
  for (GatherPoint& point : points_) {
    turn += 5;
    const double over_i = look.over_i - point.height, over_j = look.over_j + dot(look.patch->normal, point.offset);
    if (!(over_i > 0) || !(over_j > 0)) continue;
    const double squared = look.squared - 2 * dot(look.way, point.offset) + point.offset_squared;
    double factor = weight * over_i * over_j / (squared * squared);
    if (!clear) factor *= visible(point, turn, samples, scene_.surfaces.cached_points, segments, factor);
    add(point, look.radiosity, factor);
  }
}

/// A patch too near for one kernel, or partly in the shade.
void GatherGroup::gather_near(const Look& look) {
  const Surfaces& s = scene_.surfaces;
  const Mesh& mesh = s.mesh(look.node);
  const bool clear = scene_.lists.clear(inner_box(look.node, mesh), look.node);
  const double uneven = scene_.senders.uneven(look.node);
  const bool parts = mesh.su * mesh.sv > 1 && (kOfUneven * look.bound * uneven > error_ * look.level ||
                                               (!clear && look.bound > kMostMixed * error_));
  if (parts) {
    gather_parts(look, clear);
  } else {
    gather_polygon(look, s.piece(look.node), clear);
  }
}

/// By the contour from each of four places, with a segment from there.
void GatherGroup::gather_close(GatherPoint& point, const Piece& piece, bool planar, const double* radiosity,
                               const LatticePoint* to, std::uint32_t ends, bool clear) {
  for (std::uint32_t k = 0; k < 4; ++k) {
    const double factor = piece_factor(point.place[k], normal_, piece, planar);
    if (!(factor > 0)) continue;
    if (!clear && scene_.lists.blocked(point.from[k], to[k & (ends - 1)])) {
      point.lost[k] += static_cast<float>(0.25 * factor);
      continue;
    }
    if (!clear) point.free |= 1u << k;
    GatherPoint::Close& close = point.close[k];
    close.factor += factor;
    for (std::uint32_t c = 0; c < scene_.surfaces.scene->channels; ++c) close.lx[c] += factor * radiosity[c];
  }
}

void GatherGroup::gather_polygon(const Look& look, const Piece& piece, bool clear) {
  const Surfaces& s = scene_.surfaces;
  const LatticePoint* const samples = s.samples(look.node);
  const bool planar = s.mesh(look.node).kind != MeshKind::kGrid;
  std::uint32_t turn = hash_of(node_, look.node);
  const double side = look.patch->longest_side;
  for (GatherPoint& point : points_) {
    turn += 5;
    const Vec3 way = look.way - point.offset;
    if (look.bound > kOneSegment * error_ && length_squared(way) < kClose * (side * side + point.side_squared)) {
      gather_close(point, piece, planar, look.radiosity, samples, s.cached_points, clear);
      continue;
    }
    double factor = piece_factor(centre_ + point.offset, normal_, piece, planar);
    if (!(factor > 0)) continue;
    const std::uint32_t segments = factor * look.level <= kMostMixed * error_ ? 2 : 4;
    if (!clear) factor *= visible(point, turn, samples, s.cached_points, segments, factor);
    add(point, look.radiosity, factor);
  }
}

void GatherGroup::gather_parts(const Look& look, bool clear) {
  const Surfaces& s = scene_.surfaces;
  const Mesh& mesh = s.mesh(look.node);
  const Rgb& rho = s.scene->materials[mesh.material].diffuse;
  const std::uint32_t mesh_index = s.mesh_index(look.node), local = s.local(look.node), channels = s.scene->channels;
  const std::uint32_t cell = cell_of_patch(mesh, local);
  const bool planar = mesh.kind != MeshKind::kGrid;
  std::uint32_t turn = hash_of(node_, look.node);
  SubPatchesOfPatch parts(mesh, local);
  for (std::uint32_t k = parts.next(); k != kNone; k = parts.next()) {
    const std::size_t at = mesh.first_sub_patch + std::size_t{k};
    if (!scene_.direct.hidden.empty() && scene_.direct.hidden[at] != 0) continue;
    double sends[3] = {0, 0, 0};
    for (std::uint32_t c = 0; c < channels; ++c) {
      const std::size_t value = at * channels + c;
      sends[c] = rho.c[c] * (static_cast<double>(scene_.direct.sub_patch_lx[value]) +
                             static_cast<double>(scene_.ambient_lx[value]));
    }
    const double level = scene_.senders.level_of(sends);
    const Piece piece = sub_patch_piece(*s.scene, mesh, k);
    const Vec3 centre = piece.centre();
    const LatticePoint end = sample_point(*s.scene, *s.geometry, mesh_index, cell, centre);
    const double area = length(piece.vector_area()) * kInversePi;
    const double side = piece.longest_side(), near = side * side / (3 * kPartQ);
    for (GatherPoint& point : points_) {
      turn += 5;
      const Vec3 from = centre_ + point.offset, way = centre - from;
      const double over_i = dot(normal_, way), over_j = -dot(look.patch->normal, way), squared = length_squared(way);
      if (squared < kClose * (side * side + point.side_squared)) {
        gather_close(point, piece, planar, sends, &end, 1, clear);
        continue;
      }
      double factor;
      if (squared < near || over_i < side) {
        factor = piece_factor(from, normal_, piece, planar);
      } else {
        factor = over_j > 0 ? over_i * over_j * area / (squared * squared) : 0;
      }
      if (!(factor > 0)) continue;
      const double w = factor * level;
      const std::uint32_t segments = w <= kOneSegment * error_ ? 1 : w <= kMostMixed * error_ ? 2 : 4;
      if (!clear) factor *= visible(point, turn, &end, 1, segments, factor);
      add(point, sends, factor);
    }
  }
}

void GatherGroup::place_group(std::uint32_t node) {
  const Surfaces& s = scene_.surfaces;
  node_ = node;
  normal_ = s.patch(node).normal;
  centre_ = {};
  for (const GatherPoint& point : points_) centre_ = centre_ + point.offset;
  centre_ = (1 / static_cast<double>(points_.size())) * centre_;
  double farthest = 0;
  LatticeBox box;
  for (GatherPoint& point : points_) {
    point.offset = point.offset - centre_;
    point.height = dot(normal_, point.offset);
    point.offset_squared = length_squared(point.offset);
    if (point.offset_squared > farthest) farthest = point.offset_squared;
    for (const LatticePoint& from : point.from) box.include(from);
  }
  reach_ = square_root(farthest);
  scene_.lists.start_group(box);
  geometry_error_ = shared_factor_ = shared_variance_ = 0;
  slope_factor_ = {};
  for (std::uint32_t c = 0; c < 3; ++c) {
    shared_lx_[c] = 0;
    slope_lx_[c] = {};
  }
}

void GatherGroup::finish_points() {
  for (GatherPoint& point : points_) {
    double places = 0;
    for (std::uint32_t k = 0; k < 4; ++k) places += point.inside(k) ? 0 : 1;
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (!point.inside(k)) add_close(point, k, 1 / places);
    }
    point.factor += shared_factor_ + dot(slope_factor_, point.offset);
    point.variance += shared_variance_;
    for (std::uint32_t c = 0; c < scene_.surfaces.scene->channels; ++c) {
      point.lx[c] += shared_lx_[c] + dot(slope_lx_[c], point.offset);
    }
  }
}

void GatherGroup::gather(std::uint32_t node, std::uint32_t place, std::span<GatherPoint> points) {
  const Surfaces& s = scene_.surfaces;
  points_ = points;
  // A root mean square over area forgives small patches more.
  const double ratio = scene_.mean_area / (s.root_area[node] * s.root_area[node]);
  error_ = scene_.error * (ratio > 1 ? square_root(ratio < kSmallest ? ratio : kSmallest) : 1);
  place_group(node);
  for (std::uint32_t k = 0; k < s.mesh_at.size(); ++k) {
    if (k == place && s.planar[k] != 0) continue;
    const std::uint32_t end = s.mesh_begin[k + 1];
    scene_.lists.start_object(s.scene->meshes[s.mesh_at[k]].object);
    for (std::uint32_t j = s.mesh_begin[k]; j < end;) {
      const bool sends = s.root_area[j] > 0 && j != node;
      if (!sends || consider(j) == Step::kDone) {
        j = s.end(j);
        continue;
      }
      scene_.lists.split(whole_box(j), j, s.end(j));
      ++j;
    }
  }
  finish_points();
}

}  // namespace shodo
