#include "light/face_light.h"

#include "light/polygon_factor.h"
#include "light/quad_cell.h"

namespace shodo {

namespace {

/// Faces of a polyhedron of so many have one segment a sample, or four if they fill more than this of its hemisphere.
constexpr std::uint32_t kManyFaces = 12;
constexpr double kLargeFactor = 0.01;
/// Of a sub-patch: nearer than that to a face its light is not of the third degree over it, within 1/500.
constexpr double kNearRadii = 4;
/// A face at a distance of less than its radius is split, until the leaves' radius is this part of theirs, or of the
/// sub-patch's.
constexpr double kLeafAngle = 0.25;
constexpr double kLeafOfRadius = 0.25;
constexpr std::uint32_t kDeepestLeaf = 6;
/// It is not worth while to narrow an aim for so few tests.
constexpr std::size_t kFewTests = 16;
/// The middle tier's error over q^2.
constexpr double kMiddleError = 0.45;
/// That of the scaled tier over (r_p r_e / d^2)^2.
constexpr double kScaledError = 4;

/// cos cos / r^2 from a sample to a point of a face; 0 or less where one lies behind the other.
double kernel(const Vec3& from, const Vec3& normal, const Vec3& to, const Vec3& emitter_normal) {
  const Vec3 way = to - from;
  const double above = dot(normal, way);
  if (!(above > 0)) return 0;
  const double squared = length_squared(way);
  return above * -dot(emitter_normal, way) / (squared * squared);
}

FaceReach reach_of(const SubPatchView& view, const Emitter& emitter) {
  const double squared = length_squared(emitter.centre - view.centre);
  const double near = emitter.radius + kNearRadii * view.radius, very_near = emitter.radius + view.radius;
  if (squared < very_near * very_near) return FaceReach::kVeryNear;
  return squared < near * near ? FaceReach::kNear : FaceReach::kFar;
}

}  // namespace

/// One face at work.
struct FaceLight::Face {
  const Emitter* emitter;
  std::uint32_t faces;  // of its light
  Tier tier = Tier::kNear;
  bool crossing = true;  // one side may lie partly behind the other's plane
  bool panes = false;    // a pane may be between
  double factor[kMostInGroup] = {};
  double largest = 0;

  /// Ends that are aimed at together.
  std::uint32_t tiles() const { return emitter->is_area() ? kQuarters : 1; }
  /// Of an area light a quarter of the set; of a polyhedron's face its centre or Gauss points.
  Tile tile(std::uint32_t t, EndSet set) const {
    if (!emitter->is_area()) {
      const bool one = faces >= kManyFaces && !(largest > kLargeFactor);
      return one ? Tile{emitter->first_end, 1} : Tile{emitter->first_end + 1, kFaceEnds - 1};
    }
    if (set == EndSet::kFew) return {emitter->first_end + t * kFewInQuarter, kFewInQuarter};
    const std::uint32_t first = emitter->first_end + kFewEnds + t * kManyInQuarter;
    return {first, set == EndSet::kMany ? kManyInQuarter : kFewInQuarter};
  }
};

FaceLight::Tier FaceLight::tier_of(const SubPatchView& view, Face& face) const {
  const Emitter& emitter = *face.emitter;
  const double above = view.receiver->height(emitter.centre), front = emitter.height(view.centre);
  if (above <= -emitter.radius || front <= -view.radius) return Tier::kNothing;
  const double squared = length_squared(emitter.centre - view.centre);
  face.crossing = above < emitter.radius || front < view.radius;
  if (face.crossing) return Tier::kNear;
  const double q = (4.0 / 3) * (emitter.radius * emitter.radius + view.radius * view.radius) / squared;
  if (q <= tiers_) return Tier::kFar;
  if (!emitter.is_area() && kMiddleError * q * q <= tiers_) return Tier::kMiddle;
  const double both = emitter.radius * view.radius / squared;
  return kScaledError * both * both <= tiers_ ? Tier::kScaled : Tier::kNear;
}

/// From the sub-patch's centre, over the face's Gauss points.
double FaceLight::mean_kernel(const SubPatchView& view, const Emitter& emitter) const {
  double sum = 0, weight = 0;
  for (std::uint32_t e = emitter.first_end + 1; e < emitter.first_end + kFaceEnds; ++e) {
    const EmitterEnd& end = emitters_->ends[e];
    sum += end.weight * kernel(view.centre, view.receiver->normal, end.point, emitter.normal);
    weight += end.weight;
  }
  return sum / weight;
}

void FaceLight::find_factors(const SubPatchView& view, const ReceiverGroup& group, Face& face) const {
  const Emitter& emitter = *face.emitter;
  const Vec3& normal = view.receiver->normal;
  if (face.tier == Tier::kFar) {
    const double factor = kInversePi * emitter.area * kernel(view.centre, normal, emitter.centre, emitter.normal);
    for (std::uint32_t k = 0; k < group.count; ++k) face.factor[k] = factor;
    return;
  }
  const Piece piece = emitter_piece(*scene_, emitter);
  if (face.tier != Tier::kNear) {
    const double scale = face.tier == Tier::kMiddle
                             ? kInversePi * emitter.area * mean_kernel(view, emitter)
                             : point_to_polygon(view.centre, normal, piece.corner, piece.corners);
    const double centres = kernel(view.centre, normal, emitter.centre, emitter.normal);
    for (std::uint32_t k = 0; k < group.count; ++k) {
      face.factor[k] = scale * (kernel(group.point[k], normal, emitter.centre, emitter.normal) / centres);
    }
    return;
  }
  for (std::uint32_t k = 0; k < group.count; ++k) {
    if (!(emitter.height(group.point[k]) > 0)) continue;
    face.factor[k] = point_to_polygon(group.point[k], normal, piece.corner, piece.corners);
  }
}

/// What the segments to one face found, by sample of the group: the visible part, or -1 if every end lies below the
/// sample's horizon.
struct FaceLight::Seen {
  double part[kMostInGroup];
};

/// The leaves of a face's quadtree, in Z order: cells small against their distance.
class FaceLight::Leaves {
 public:
  Leaves(const Piece& piece, const PieceGrid& grid, const SubPatchView& view, double radius)
      : piece_(&piece), grid_(&grid), view_(&view), radius_(radius) {
    descend();
  }
  PieceGrid::Parameter centre() const { return centre_; }
  /// Share of the face's area.
  double weight() const { return grid_->weight_at(centre_) * cell_.size() * cell_.size(); }
  /// False after the last.
  bool next() {
    if (!cell_.advance()) return false;
    descend();
    return true;
  }

 private:
  void descend() {
    for (;;) {
      const double size = cell_.size();
      centre_ = {size * (cell_.x + 0.5), size * (cell_.y + 0.5)};
      const double radius = radius_ * size;
      const double squared = length_squared(piece_->point(centre_.s, centre_.t) - view_->centre);
      const bool small = radius * radius <= kLeafAngle * kLeafAngle * squared || radius < kLeafOfRadius * view_->radius;
      if (small || cell_.depth == kDeepestLeaf) return;
      cell_.descend();
    }
  }

  const Piece* piece_;
  const PieceGrid* grid_;
  const SubPatchView* view_;
  double radius_;
  QuadCell cell_;
  PieceGrid::Parameter centre_{0.5, 0.5};
};

bool FaceLight::is_split(const SubPatchView& view, const Emitter& emitter) {
  const double squared = length_squared(emitter.centre - view.centre);
  return emitter.is_area() && emitter.radius * emitter.radius > squared;
}

void FaceLight::look_at_leaves(const SubPatchView& view, const ReceiverGroup& group, const Link& link,
                               const Face& face, const Aim& aim, Seen& seen) const {
  const Emitter& emitter = *face.emitter;
  const Piece piece = emitter_piece(*scene_, emitter);
  const PieceGrid grid(piece, 1);
  double all[kMostInGroup] = {}, arrives[kMostInGroup] = {};
  Leaves leaves(piece, grid, view, emitter.radius);
  do {
    const EmitterEnd end{grid.point_at(leaves.centre()), leaves.weight()};
    const LatticePoint at = aim.clear() && !face.panes ? LatticePoint{} : segment_end(*scene_, *geometry_, emitter, end.point);
    const Aim narrow = aim.facets.size() * group.count > kFewTests ? narrowed(group, {&at, 1}, aim) : aim;
    for (std::uint32_t k = 0; k < group.count; ++k) {
      if (!(face.factor[k] > 0)) continue;
      const double weight = end.weight * kernel(group.point[k], view.receiver->normal, end.point, emitter.normal);
      if (!(weight > 0)) continue;
      all[k] += weight;
      const bool free = narrow.clear() || !intersector_->blocked(group.lattice[k], at, link, narrow);
      if (free) arrives[k] += face.panes ? weight * intersector_->panes().pass(group.lattice[k], at) : weight;
    }
  } while (leaves.next());
  for (std::uint32_t k = 0; k < group.count; ++k) seen.part[k] = all[k] > 0 ? arrives[k] / all[k] : -1;
}

Aim FaceLight::narrowed(const ReceiverGroup& group, std::span<const LatticePoint> ends, const Aim& aim) const {
  LatticeBox box;
  for (const LatticePoint& end : ends) box.include(end);
  return intersector_->narrow(aim, group.ends(), {ends, box});
}

/// Kernels are found only where they decide: which ends are above the horizon, if one side crosses the other's plane,
/// and how much they count, if some but not all are free.
void FaceLight::look_at_ends(const SubPatchView& view, const ReceiverGroup& group, const Link& link, const Face& face,
                             const Aim& aim, Seen& seen) const {
  const Emitter& emitter = *face.emitter;
  const auto weight_of = [&](std::uint32_t k, std::uint32_t e) {
    const EmitterEnd& end = emitters_->ends[e];
    if (face.tier == Tier::kFar) return end.weight;
    return end.weight * kernel(group.point[k], view.receiver->normal, end.point, emitter.normal);
  };
  std::uint32_t tested[kMostInGroup] = {}, free[kMostInGroup] = {};  // a bit an end
  std::uint32_t bit = 0;
  for (std::uint32_t t = 0; t < face.tiles(); ++t) {
    const Tile tile = face.tile(t, group.ends_of_area);
    const std::span<const LatticePoint> ends = emitters_->lattice_ends.subspan(tile.first, tile.count);
    const bool worth = aim.facets.size() * group.count * tile.count > kFewTests;
    const Aim narrow = worth ? narrowed(group, ends, aim) : aim;
    for (std::uint32_t k = 0; k < group.count; ++k) {
      if (!(face.factor[k] > 0)) continue;
      for (std::uint32_t e = 0; e < tile.count; ++e) {
        if (face.crossing && !(weight_of(k, tile.first + e) > 0)) continue;
        const std::uint32_t mask = std::uint32_t{1} << (bit + e);
        tested[k] |= mask;
        if (narrow.clear() || !intersector_->blocked(group.lattice[k], ends[e], link, narrow)) free[k] |= mask;
      }
    }
    bit += tile.count;
  }
  for (std::uint32_t k = 0; k < group.count; ++k) {
    seen.part[k] = tested[k] == 0 ? -1 : free[k] == tested[k] ? 1 : 0;
    if (free[k] == 0 || (free[k] == tested[k] && !face.panes)) continue;
    double all = 0, arrives = 0;
    bit = 0;
    for (std::uint32_t t = 0; t < face.tiles(); ++t) {
      const Tile tile = face.tile(t, group.ends_of_area);
      for (std::uint32_t e = 0; e < tile.count; ++e, ++bit) {
        if ((tested[k] >> bit & 1) == 0) continue;
        const double weight = weight_of(k, tile.first + e);
        all += weight;
        if ((free[k] >> bit & 1) == 0) continue;
        const LatticePoint& end = emitters_->lattice_ends[tile.first + e];
        arrives += face.panes ? weight * intersector_->panes().pass(group.lattice[k], end) : weight;
      }
    }
    seen.part[k] = arrives / all;
  }
}

void FaceLight::look_at(const SubPatchView& view, const ReceiverGroup& group, const Link& link, Face& face,
                        const Aim& aim, FaceLook& look) const {
  for (std::uint32_t k = 0; k < group.count; ++k) {
    if (face.factor[k] > face.largest) face.largest = face.factor[k];
  }
  if (!(face.largest > 0)) return;
  Seen seen;
  if (is_split(view, *face.emitter)) {
    look.split = true;
    look_at_leaves(view, group, link, face, aim, seen);
  } else {
    look_at_ends(view, group, link, face, aim, seen);
  }
  for (std::uint32_t k = 0; k < group.count; ++k) {
    look.factor[k] += face.factor[k];
    if (seen.part[k] < 0) continue;
    look.tested[k] += face.factor[k];
    look.arrives[k] += face.factor[k] * seen.part[k];
  }
}

FaceLook FaceLight::factors(const SubPatchView& view, const ReceiverGroup& group, FaceReach reach, std::uint32_t first,
                            std::uint32_t count) const {
  FaceLook look;
  for (std::uint32_t e = first; e < first + count; ++e) {
    Face face{&emitters_->faces[e], count};
    if (reach_of(view, *face.emitter) != reach) continue;
    face.tier = tier_of(view, face);
    if (face.tier == Tier::kNothing) continue;
    find_factors(view, group, face);
    for (std::uint32_t k = 0; k < group.count; ++k) look.factor[k] += face.factor[k];
  }
  return look;
}

FaceLook FaceLight::look(const SubPatchView& view, const ReceiverGroup& group, const Link& link, std::uint32_t first,
                         std::uint32_t count, const LatticeBox& ends, const LatticeBox& whole) const {
  FaceLook look;
  Aim aim, others;  // `others`: without the polyhedron's own facets
  bool aimed = false, panes = false;
  for (std::uint32_t e = first; e < first + count; ++e) {
    Face face{&emitters_->faces[e], count};
    face.tier = tier_of(view, face);
    if (face.tier == Tier::kNothing) continue;
    const FaceReach reach = reach_of(view, *face.emitter);
    if (reach > look.reach) look.reach = reach;
    find_factors(view, group, face);
    if (!aimed) {
      const bool leaves = is_split(view, *face.emitter);  // then the light has no other face
      panes = intersector_->panes().any() && intersector_->panes().between(group.box, leaves ? whole : ends);
      aim = others = aims_->towards(face.emitter->light, link, group.box, leaves ? whole : ends, whole);
      if (!face.emitter->is_area() && aim.facets.size() > 0) {
        const std::uint32_t own = scene_->meshes[face.emitter->mesh].object;
        others.facets = aim.facets.first(intersector_->others_first(aim, own));
      }
    }
    look.clear = aim.clear() && !panes;
    face.panes = panes;
    aimed = true;
    const bool own_miss = others.facets.size() < aim.facets.size() &&
                          own_facets_miss(*geometry_, *face.emitter, {group.lattice, group.count});
    look_at(view, group, link, face, own_miss ? others : aim, look);
    // What blocked came to the front.
    if (!own_miss && !others.any_triangle && others.facets.size() < aim.facets.size()) {
      intersector_->others_first(aim, scene_->meshes[face.emitter->mesh].object);
    }
  }
  return look;
}

}  // namespace shodo
