#include "ambient/gather_group.h"

namespace shodo {

namespace {

// Relative to the error of a node.
constexpr double kTiny = 0.8, kTiniest = 0.4;  // the last: what the object's last segment met is good enough

constexpr double kSmallest = 16;      // so many times smaller than the mean, patches gather as roughly as any

constexpr double kMostQ = 0.35;       // of the series
constexpr double kSeriesShare = 0.5;  // its error is that times q^2
constexpr double kBendShare = 1.0 / 8;  // of the second order over the group
constexpr double kFarOff = 64;        // times the group's reach squared: all of it sees the node from one place
constexpr double kOwnShare = 2.0 / 3;  // of the longest side squared of what gathers, in q
constexpr double kBelow = 1.0 / 32;   // of a node's longest side, may lie behind the receiver's plane
constexpr std::int32_t kMoved = 16;   // samples are moved in front of their surface by less than that

}  // namespace

void GatherGroup::add(GatherPoint& point, const double* radiosity, double factor) const {
  for (std::uint32_t c = 0; c < scene_.surfaces.scene->channels; ++c) point.lx[c] += factor * radiosity[c];
  point.factor += solid_ * factor;
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

/// The kernel to second order over the node, and how much it varies there (ambient/link_series.h).
void GatherGroup::develop(const PatchShape& shape, Look& look) const {
  const bool triangle = shape.outline == Outline::kTriangle;
  const Vec3 a = triangle ? (1 / square_root(6)) * (shape.a - 0.5 * shape.b) : shape.a;
  const Vec3 b = triangle ? (1 / square_root(8)) * shape.b : shape.b;
  const double axes = length_squared(a) + length_squared(b), over_squared = 1 / look.squared;
  look.q = (4.0 / 3 * axes + kOwnShare * own_squared_) / look.nearest;
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
  const double rise = look.squared / look.nearest;
  look.most = look.factor * rise * rise;
}

/// Of the node's centre from the nearest of the points, where that tells them apart.
double GatherGroup::nearest_squared(const Look& look) const {
  double nearest = look.squared;
  if (kFarOff * reach_ * reach_ < nearest) return nearest;
  for (const GatherPoint& point : points_) {
    const double squared = length_squared(look.way - point.offset);
    if (squared < nearest) nearest = squared;
  }
  return nearest;
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
  look.nearest = nearest_squared(look);
  scene_.senders.radiosity(j, look.radiosity);
  look.level = scene_.senders.level_of(look.radiosity);
  look.bound = look.patch->area * look.level / (kPi * look.nearest + look.patch->area);
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
  const double w = look.most * look.level, uneven = look.most * scene_.senders.uneven(j);
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
    const double part = group_visible(look, w <= kOneSegment * error ? 2 : 4);
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

/// The free part of two or four segments between the group and the node; of four if two disagree.
double GatherGroup::group_visible(const Look& look, std::uint32_t segments) {
  const LatticePoint* const samples = scene_.surfaces.samples(look.node);
  const std::uint32_t last = scene_.surfaces.cached_points - 1, turn = gather_hash(node_, look.node);
  const std::uint32_t points = static_cast<std::uint32_t>(points_.size());
  std::uint32_t free = 0, at = turn % points;
  double passed = 0;
  for (std::uint32_t k = 0; k < segments; ++k) {
    GatherPoint& point = points_[at];
    const std::uint32_t origin = (turn / 16 + k) & 3;
    const LatticePoint& end = samples[(turn / 64 + 3 * k) & last];
    if (!scene_.lists.blocked(point.from[origin], end)) {
      ++free;
      passed += scene_.lists.pass(point.from[origin], end);
    }
    at += points > 4 ? points / 4 : 1;
    if (at >= points) at -= points;
    if (k == 1 && free == 1) segments = 4;
  }
  const double n = segments, f = free;
  shared_variance_ += look.factor * look.factor * ((f + 0.5) * (n - f + 0.5) / ((n + 1) * (n + 1) * (n + 2)));
  return passed / n;
}

void GatherGroup::gather_tiny(const Look& look) {
  const Surfaces& s = scene_.surfaces;
  const double area = look.patch->area;
  double factor = look.over_i * look.over_j * area / ((kPi * look.squared + area) * look.squared);
  const std::uint32_t turn = gather_hash(node_, look.node);
  GatherPoint& point = points_[turn % points_.size()];
  const LatticePoint &from = point.from[turn >> 4 & 3], &to = s.samples(look.node)[turn >> 6 & (s.cached_points - 1)];
  GatherLists::Seen& seen = scene_.lists.seen();
  if (look.bound > kTiniest * error_ || seen == GatherLists::Seen::kNotYet) {
    scene_.lists.aim(look.node);
    seen = scene_.lists.blocked(from, to) ? GatherLists::Seen::kBlocked : GatherLists::Seen::kFree;
  }
  shared_variance_ += factor * factor * 0.0625;
  if (seen == GatherLists::Seen::kBlocked) return;
  factor *= scene_.lists.pass(from, to);
  shared_factor_ += solid_ * factor;
  for (std::uint32_t c = 0; c < s.scene->channels; ++c) {
    shared_lx_[c] += factor * look.radiosity[c];
  }
}

void GatherGroup::gather_linear(const Look& look) {
  const double m2 = reach_ * reach_ / look.squared, alpha = reach_ / look.over_j;
  geometry_error_ += kBendShare * look.factor * (alpha * alpha + 16 * m2);
  const Vec3 slope = look.factor * ((1 / look.over_j) * look.patch->normal + (4 / look.squared) * look.way);
  shared_factor_ += solid_ * look.factor;
  slope_factor_ = slope_factor_ + solid_ * slope;
  for (std::uint32_t c = 0; c < scene_.surfaces.scene->channels; ++c) {
    shared_lx_[c] += look.factor * look.radiosity[c];
    slope_lx_[c] = slope_lx_[c] + look.radiosity[c] * slope;
  }
}

void GatherGroup::gather_each(const Look& look, bool clear, std::uint32_t segments) {
  const double weight = look.patch->area * kInversePi * look.correction;
  const LatticePoint* const samples = scene_.surfaces.samples(look.node);
  std::uint32_t turn = gather_hash(node_, look.node);
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

/// The part of a mesh's directions that is its own, the mean of the channels.
double GatherGroup::solid_part(const Scene& scene, const Mesh& mesh) {
  const Optics* const optics = scene.optics_of(mesh.material);
  if (optics == nullptr) return 1;
  double passed = 0;
  for (std::uint32_t c = 0; c < scene.channels; ++c) passed += optics->transmit.c[c];
  return 1 - passed / scene.channels;
}

void GatherGroup::place_group(std::uint32_t node) {
  const Surfaces& s = scene_.surfaces;
  node_ = node;
  normal_ = s.patch(node).normal;
  centre_ = {};
  for (const GatherPoint& point : points_) centre_ = centre_ + point.offset;
  centre_ = (1 / static_cast<double>(points_.size())) * centre_;
  double farthest = 0;
  own_squared_ = 0;
  LatticeBox box;
  for (GatherPoint& point : points_) {
    point.offset = point.offset - centre_;
    point.height = dot(normal_, point.offset);
    point.offset_squared = length_squared(point.offset);
    if (point.offset_squared > farthest) farthest = point.offset_squared;
    if (point.side_squared > own_squared_) own_squared_ = point.side_squared;
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
    point.factor += shared_factor_ + dot(slope_factor_, point.offset);
    point.variance += shared_variance_;
    point.geometry_error += geometry_error_;
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
    solid_ = solid_part(*s.scene, s.scene->meshes[s.mesh_at[k]]);
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
