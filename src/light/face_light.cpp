#include "light/face_light.h"

#include "base/bits.h"
#include "light/face_leaves.h"
#include "light/face_work.h"
#include "light/polygon_factor.h"

namespace shodo {

namespace {

/// Of a sub-patch: nearer than that to a face its light is not of the third degree over it, within 1/500.
constexpr double kNearRadii = 4;
/// The middle tier's error over q^2.
constexpr double kMiddleError = 0.45;
/// That of the scaled tier over (r_p r_e / d^2)^2.
constexpr double kScaledError = 4;

/// An area light is near at this part of its radius from its nearest point: its 32 ends are too coarse for it there.
/// From 0.3 on parts of a pelmet over a window had half of their light, from 1 on the leaves were coarser than ends.
constexpr double kSplit = 0.4;
/// Of a quadrilateral, as if it were a rectangle.
Vec3 nearest_point(const Vec3* corner, const Vec3& from) {
  Vec3 nearest = corner[0];
  for (const Vec3& side : {corner[1] - corner[0], corner[3] - corner[0]}) {
    const double at = dot(from - corner[0], side) / length_squared(side);
    nearest = nearest + (at > 1 ? 1 : at > 0 ? at : 0) * side;
  }
  return nearest;
}

bool is_in(std::uint32_t faces, std::uint32_t face) { return face < 32 && (faces >> face & 1) != 0; }

FaceReach reach_of(const SubPatchView& view, const Emitter& emitter) {
  const double squared = length_squared(emitter.centre - view.centre);
  const double near = emitter.radius + kNearRadii * view.radius, very_near = emitter.radius + view.radius;
  if (squared < very_near * very_near) return FaceReach::kVeryNear;
  return squared < near * near ? FaceReach::kNear : FaceReach::kFar;
}

}  // namespace

FaceLight::Tier FaceLight::tier_of(const SubPatchView& view, Face& face) const {
  const Emitter& emitter = *face.emitter;
  const double above = view.receiver->height(emitter.centre), front = emitter.height(view.centre);
  if (above <= -emitter.radius || front <= -view.radius) return Tier::kNothing;
  const double squared = length_squared(emitter.centre - view.centre);
  face.below = above < emitter.radius;
  if (face.below || front < view.radius) return Tier::kNear;
  const double q = (4.0 / 3) * (emitter.radius * emitter.radius + view.radius * view.radius) / squared;
  if (q <= allowed()) return Tier::kFar;
  if (!emitter.is_area() && kMiddleError * q * q <= allowed()) return Tier::kMiddle;
  const double both = emitter.radius * view.radius / squared;
  return kScaledError * both * both <= allowed() ? Tier::kScaled : Tier::kNear;
}

/// From the sub-patch's centre, over the face's Gauss points.
double FaceLight::mean_kernel(const SubPatchView& view, const Emitter& emitter) const {
  double sum = 0, weight = 0;
  for (std::uint32_t e = emitter.first_end; e < emitter.first_end + kFaceEnds; ++e) {
    const EmitterEnd& end = emitters_->ends[e];
    sum += end.weight * kernel(view.centre, view.receiver->normal, end.point, emitter.normal);
    weight += end.weight;
  }
  return sum / weight;
}

/// Over two Gauss points across from each other, which leaves out the term in s t only; odd and even nodes of a patch
/// take different ones.
double FaceLight::pair_kernel(const Vec3& point, const Vec3& normal, const Emitter& emitter, bool odd) const {
  const EmitterEnd* ends = emitters_->ends.data() + emitter.first_end;
  const EmitterEnd &a = ends[odd ? 1 : 0], &b = ends[odd ? 2 : 3];
  const double from_a = a.weight * kernel(point, normal, a.point, emitter.normal);
  const double from_b = b.weight * kernel(point, normal, b.point, emitter.normal);
  return (from_a + from_b) / (a.weight + b.weight);
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
    const bool front = emitter.height(group.point[k]) > 0;
    face.factor[k] = front ? point_to_polygon(group.point[k], normal, piece.corner, piece.corners) : 0;
  }
}

/// An area light whose nearest point is at less than kSplit of its radius.
bool FaceLight::is_split(const SubPatchView& view, const Emitter& emitter) const {
  if (!emitter.is_area()) return false;
  const double reach = kSplit * emitter.radius;
  if (length_squared(emitter.centre - view.centre) >= (emitter.radius + reach) * (emitter.radius + reach)) return false;
  const Vec3* corner = scene_->lights[emitter.light].corners;
  return length_squared(nearest_point(corner, view.centre) - view.centre) < reach * reach;
}

/// Segments from the leaves to all samples at once.
void FaceLight::look_at_leaves(const SubPatchView& view, const ReceiverGroup& group, const Link& link,
                               const Face& face, const Aim& aim, FaceLook& look) const {
  const Emitter& emitter = *face.emitter;
  const Piece piece = emitter_piece(*scene_, emitter);
  const PieceGrid grid(piece, 1);
  double all[kMostInGroup] = {}, arrives[kMostInGroup] = {};
  FaceLeaves leaves(piece, grid, emitter.radius, view.centre, view.radius);
  do {
    const Vec3 end = grid.point_at(leaves.centre());
    double weight[kMostInGroup];
    std::uint32_t wanted = 0;
    for (std::uint32_t k = 0; k < group.count; ++k) {
      if (!(face.factor[k] > 0)) continue;
      weight[k] = leaves.weight() * kernel(group.point[k], view.receiver->normal, end, emitter.normal);
      if (weight[k] > 0) wanted |= std::uint32_t{1} << k;
    }
    if (wanted == 0) continue;
    std::uint32_t shadow = 0;
    LatticePoint at;
    if (!aim.clear() || face.panes) at = segment_end(*scene_, *geometry_, emitter, end);
    if (!aim.clear()) shadow = intersector_->shadow({at, {group.lattice, group.count}, group.box}, wanted, link, aim);
    for (std::uint32_t k = 0; k < group.count; ++k) {
      if ((wanted >> k & 1) == 0) continue;
      all[k] += weight[k];
      if ((shadow >> k & 1) != 0) continue;
      arrives[k] += face.panes ? weight[k] * intersector_->panes().pass(group.lattice[k], at) : weight[k];
    }
  } while (leaves.next());
  for (std::uint32_t k = 0; k < group.count; ++k) {
    if (!(all[k] > 0)) continue;
    look.tested[k] += face.factor[k];
    look.arrives[k] += face.factor[k] * (arrives[k] / all[k]);
  }
}

/// Those of some ends of a face, a bit each from `first` on, that are above the receiver's horizon.
std::uint32_t FaceLight::ends_above(const SubPatchView& view, const Face& face, std::uint32_t first,
                                    std::uint32_t ends) const {
  if (!face.below) return ends;
  std::uint32_t above = 0, bit = 1;
  for (std::uint32_t e = first; ends != 0; ++e, bit <<= 1, ends >>= 1) {
    if ((ends & 1) != 0 && view.receiver->height(emitters_->ends[e].point) > 0) above |= bit;
  }
  return above;
}

/// What the ends of an area light count: its own cosines are in proportion to 1 / r, since it is plane, and the heights
/// over the receiver's plane are the same for all its samples.
class FaceLight::EndWeights {
 public:
  EndWeights(const SubPatchView& view, const EmitterEnd* ends, std::uint32_t above) : ends_(ends), above_(above) {
    for_each_bit(above, [&](std::uint32_t e, std::uint32_t) {
      height_[e] = ends[e].weight * view.receiver->height(ends[e].point);
    });
  }
  /// The part that arrives at a sample: kernels of the ends that are free over those of all.
  template <class Pass>
  double part(const Vec3& sample, std::uint32_t shadow, Pass pass) const {
    double all = 0, arrives = 0;
    for_each_bit(above_, [&](std::uint32_t e, std::uint32_t bit) {
      const double squared = length_squared(ends_[e].point - sample);
      const double weight = height_[e] / (squared * squared);
      all += weight;
      if ((shadow & bit) == 0) arrives += pass(weight, e);
    });
    return arrives / all;
  }

 private:
  const EmitterEnd* ends_;
  std::uint32_t above_;
  double height_[kAreaEnds];
};

void FaceLight::look_at_area(const SubPatchView& view, const ReceiverGroup& group, const Link& link, const Face& face,
                             const Aim& aim, FaceLook& look) const {
  const std::uint32_t first = face.emitter->first_end;
  const std::uint32_t above = ends_above(view, face, first, group.ends_of_area);
  if (above == 0) return;
  const std::span<const LatticePoint> ends = emitters_->lattice_ends.subspan(first, kAreaEnds);
  std::uint32_t shadow[kMostInGroup] = {};
  bool mixed = face.panes;
  for (std::uint32_t k = 0; k < group.count; ++k) {
    if (!(face.factor[k] > 0) || aim.clear()) continue;
    shadow[k] = intersector_->shadow({group.lattice[k], ends, face.emitter->box}, above, link, aim);
    mixed = mixed || (shadow[k] != 0 && shadow[k] != above);
  }
  const EndWeights weights(view, emitters_->ends.data() + first, mixed ? above : 0);
  for (std::uint32_t k = 0; k < group.count; ++k) {
    if (!(face.factor[k] > 0)) continue;
    look.tested[k] += face.factor[k];
    if (shadow[k] == above) continue;
    if (face.panes) {
      look.arrives[k] += face.factor[k] * weights.part(group.point[k], shadow[k], [&](double weight, std::uint32_t e) {
        return weight * intersector_->panes().pass(group.lattice[k], ends[e]);
      });
      continue;
    }
    const auto whole = [](double weight, std::uint32_t) { return weight; };
    const double part = shadow[k] == 0 ? 1 : weights.part(group.point[k], shadow[k], whole);
    look.arrives[k] += face.factor[k] * part;
  }
}

/// From a point at least so far away, of a face of a polyhedron; kNear: not known.
FaceLight::Tier FaceLight::tier_at(double distance, const Emitter& emitter) const {
  if (emitter.is_area() || !(distance > 0)) return Tier::kNear;
  const double q = (4.0 / 3) * (emitter.radius * emitter.radius) / (distance * distance);
  return q <= allowed() ? Tier::kFar : kMiddleError * q * q <= allowed() ? Tier::kMiddle : Tier::kNear;
}

double FaceLight::factor_at(const Vec3& point, const Receiver& receiver, std::uint32_t first, std::uint32_t count,
                            std::uint32_t behind, double distance, bool odd) const {
  SubPatchView view;
  view.receiver = &receiver;
  view.centre = point;
  double sum = 0;
  for (std::uint32_t e = first; e < first + count; ++e) {
    Face face;
    face.emitter = &emitters_->faces[e];
    if (is_in(behind, e - first) || !(face.emitter->height(point) > 0)) continue;
    Tier tier = tier_at(distance, *face.emitter);
    if (tier == Tier::kNear) tier = tier_of(view, face);
    if (tier == Tier::kNothing) continue;
    if (tier == Tier::kFar || tier == Tier::kMiddle) {
      const Emitter& emitter = *face.emitter;
      const double mean = tier == Tier::kFar ? kernel(point, receiver.normal, emitter.centre, emitter.normal)
                                             : pair_kernel(point, receiver.normal, emitter, odd);
      sum += kInversePi * emitter.area * mean;
    } else {
      const Piece piece = emitter_piece(*scene_, *face.emitter);
      sum += point_to_polygon(point, receiver.normal, piece.corner, piece.corners);
    }
  }
  return sum;
}

/// One face to be looked at; false: nothing of it comes.
bool FaceLight::take_face(const SubPatchView& view, const ReceiverGroup& group, double given, Face& face,
                          FaceLook& look) const {
  if (given >= 0) {
    const bool area = face.emitter->is_area();
    face.below = area && view.receiver->height(face.emitter->centre) < face.emitter->radius;
    for (std::uint32_t k = 0; k < group.count && area; ++k) face.factor[k] = given;
    return area || face.emitter->height(view.centre) > 0;
  }
  face.tier = tier_of(view, face);
  if (face.tier == Tier::kNothing) return false;
  const FaceReach reach = reach_of(view, *face.emitter);
  if (reach > look.reach) look.reach = reach;
  look.reaches_of_faces |= 1U << static_cast<std::uint32_t>(reach);
  find_factors(view, group, face);
  bool any = false;
  for (std::uint32_t k = 0; k < group.count; ++k) {
    look.factor[k] += face.factor[k];
    if (reach == FaceReach::kFar) look.far[k] += face.factor[k];
    any = any || face.factor[k] > 0;
  }
  return any;
}

FaceLook FaceLight::factors(const SubPatchView& view, const ReceiverGroup& group, FaceReach reach, std::uint32_t first,
                            std::uint32_t count) const {
  FaceLook look;
  for (std::uint32_t e = first; e < first + count; ++e) {
    Face face;
    face.emitter = &emitters_->faces[e];
    if (reach_of(view, *face.emitter) != reach) continue;
    face.tier = tier_of(view, face);
    if (face.tier == Tier::kNothing) continue;
    find_factors(view, group, face);
    for (std::uint32_t k = 0; k < group.count; ++k) look.factor[k] += face.factor[k];
  }
  return look;
}

/// An area light: its only face.
void FaceLight::look_at_one(const SubPatchView& view, const ReceiverGroup& group, const Link& link,
                            const LatticeBox& ends, const LatticeBox& whole, const EndGrid* grid, Face& face,
                            FaceLook& look) const {
  look.split = is_split(view, *face.emitter);
  const LatticeBox& aimed = look.split ? whole : ends;
  if (!look.split && !face.below && aims_->hidden(face.emitter->light, link, group.box, ends)) {
    for (std::uint32_t k = 0; k < group.count; ++k) look.tested[k] = face.factor[k];
    return;
  }
  const Aim aim = aims_->towards(face.emitter->light, link, group.box, aimed, whole,
                                 look.split || !grid->usable() ? nullptr : grid);
  face.panes = intersector_->panes().any() && intersector_->panes().between(group.box, aimed);
  look.clear = aim.clear() && !face.panes;
  if (look.split) {
    look_at_leaves(view, group, link, face, aim, look);
  } else {
    look_at_area(view, group, link, face, aim, look);
  }
  aims_->used(face.emitter->light, aim);
}

FaceLook FaceLight::look(const SubPatchView& view, const ReceiverGroup& group, const Link& link, std::uint32_t first,
                         std::uint32_t count, const LatticeBox& ends, const LatticeBox& whole,
                         const EndGrid* grid, double given, std::uint32_t behind) const {
  FaceLook look;
  Batch batch;
  batch.given = given;
  bool only = true;
  for (std::uint32_t e = first; e < first + count; ++e) {
    if (given >= 0 && is_in(behind, e - first)) continue;
    Face& face = batch.face[batch.count];
    face.emitter = &emitters_->faces[e];
    if (!take_face(view, group, given, face, look)) continue;
    if (face.emitter->is_area()) {
      look_at_one(view, group, link, ends, whole, grid, face, look);
      break;
    }
    batch.box.include(face.emitter->box);
    if (++batch.count < kFacesAtOnce) continue;
    only = false;
    look_at_faces(view, group, link, whole, only, batch, look);
    batch.count = 0;
    batch.box = {};
  }
  look_at_faces(view, group, link, whole, only, batch, look);
  for (std::uint32_t k = 0; k < group.count && given >= 0; ++k) look.factor[k] = given;
  return look;
}

}  // namespace shodo
