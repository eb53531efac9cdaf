#include "light/face_light.h"

#include "base/bits.h"
#include "light/face_leaves.h"
#include "light/polygon_factor.h"

namespace shodo {

namespace {

/// So many faces of a polyhedron are looked at together.
constexpr std::uint32_t kFacesAtOnce = 16;
/// Of a sub-patch: nearer than that to a face its light is not of the third degree over it, within 1/500.
constexpr double kNearRadii = 4;
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

bool is_in(std::uint32_t faces, std::uint32_t face) { return face < 32 && (faces >> face & 1) != 0; }

FaceReach reach_of(const SubPatchView& view, const Emitter& emitter) {
  const double squared = length_squared(emitter.centre - view.centre);
  const double near = emitter.radius + kNearRadii * view.radius, very_near = emitter.radius + view.radius;
  if (squared < very_near * very_near) return FaceReach::kVeryNear;
  return squared < near * near ? FaceReach::kNear : FaceReach::kFar;
}

}  // namespace

/// One face at work.
struct FaceLight::Face {
  const Emitter* emitter = nullptr;
  Tier tier = Tier::kNear;
  bool below = true;    // a part may lie below the receiver's horizon
  bool panes = false;   // a pane may be between
  double factor[kMostInGroup];  // filled as far as the group goes
};

/// Faces of a polyhedron that are looked at together.
struct FaceLight::Batch {
  Face face[kFacesAtOnce];
  std::uint32_t count = 0;
  double given = -1;     // as in look(): shares are found when they are needed
  LatticeBox box;        // around the ends
  std::uint32_t own = 0;  // faces (a bit each) whose own polyhedron may be in the way of some sample
  Aim aim;
  std::size_t others = 0;  // facets of the aim that are not the polyhedron's own
  std::uint32_t wanted[kMostInGroup], shadow[kMostInGroup];  // faces, where shares are found later
};

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

/// A face at a distance of less than its radius.
bool FaceLight::is_split(const SubPatchView& view, const Emitter& emitter) {
  const double squared = length_squared(emitter.centre - view.centre);
  return emitter.is_area() && emitter.radius * emitter.radius > squared;
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
    const double factor = face.factor[k];
    look.arrives[k] += shadow[k] == 0 ? factor : factor * weights.part(group.point[k], shadow[k], whole);
  }
}

/// Of a polyhedron's faces each sample looks at one Gauss point: neighbours at different ones, so that mirror images of
/// a sub-patch and of a face are those of each other.
std::uint32_t end_of(const ReceiverGroup& group, std::uint32_t k) {
  if (group.count == kGaussSamples) return k;
  const std::uint32_t index = group.grid_index[k];
  return (index & 1U) + 2 * (index / kGridCuts & 1U);
}

/// What the segments from sample k to one end of each face found.
void FaceLight::count_faces(const ReceiverGroup& group, const Batch& batch, std::uint32_t k, std::uint32_t wanted,
                            std::uint32_t shadow, const LatticePoint* ends, FaceLook& look) const {
  for_each_bit(wanted, [&](std::uint32_t f, std::uint32_t bit) {
    const Face& face = batch.face[f];
    const double factor = face.factor[k];
    look.tested[k] += factor;
    if ((shadow & bit) != 0) return;
    look.arrives[k] += face.panes ? factor * intersector_->panes().pass(group.lattice[k], ends[f]) : factor;
  });
}

/// End `e` of every face in one look from each sample that looks at this one.
void FaceLight::look_at_ends(const SubPatchView& view, const ReceiverGroup& group, const Link& link, Batch& batch,
                             bool later, std::uint32_t e, FaceLook& look) const {
  LatticePoint ends[kFacesAtOnce];
  LatticeBox box;
  std::uint32_t above = 0;  // bits of faces
  for (std::uint32_t f = 0; f < batch.count; ++f) {
    const Face& face = batch.face[f];
    const std::uint32_t end = face.emitter->first_end + e;
    ends[f] = emitters_->lattice_ends[end];
    box.include(ends[f]);
    above |= (face.below ? ends_above(view, face, end, 1) : 1) << f;
  }
  for (std::uint32_t k = 0; k < group.count; ++k) {
    if (end_of(group, k) != e && look.reach == FaceReach::kFar) continue;  // near: all samples look at all
    std::uint32_t wanted = above;
    for (std::uint32_t f = 0; f < batch.count && batch.given < 0; ++f) {
      if (!(batch.face[f].factor[k] > 0)) wanted &= ~(1U << f);
    }
    std::uint32_t own = 0, shadow = 0;
    for_each_bit(wanted & batch.own, [&](std::uint32_t f, std::uint32_t bit) {
      if (!own_facets_miss(*geometry_, *batch.face[f].emitter, group.lattice[k])) own |= bit;
    });
    if (wanted != 0 && (batch.others > 0 || own != 0 || batch.aim.any_triangle)) {
      const Segments segments{group.lattice[k], {ends, batch.count}, box};
      shadow = intersector_->shadow(segments, wanted, link, batch.aim, batch.others, own);
    }
    batch.wanted[k] = wanted;
    batch.shadow[k] = shadow;
    if (!later) count_faces(group, batch, k, wanted, shadow, ends, look);
  }
}

/// Where each sample sees all faces, or none, their shares don't matter.
void FaceLight::share_out(const SubPatchView& view, const ReceiverGroup& group, Batch& batch, FaceLook& look) const {
  bool any = false, all = true;
  for (std::uint32_t k = 0; k < group.count; ++k) {
    any = any || batch.shadow[k] != batch.wanted[k];
    all = all && batch.shadow[k] == 0;
  }
  if (any && !all) {
    find_shares(view, group, batch);
    for (std::uint32_t k = 0; k < group.count; ++k) {
      count_faces(group, batch, k, batch.wanted[k], batch.shadow[k], nullptr, look);
    }
    return;
  }
  for (std::uint32_t k = 0; k < group.count; ++k) {
    if (batch.wanted[k] == 0) continue;
    look.tested[k] = batch.given;
    if (all) look.arrives[k] = batch.given;
  }
}

/// The faces of a batch; `only`: there is no other.
void FaceLight::look_at_faces(const SubPatchView& view, const ReceiverGroup& group, const Link& link,
                              const LatticeBox& whole, bool only, Batch& batch, FaceLook& look) const {
  if (batch.count == 0) return;
  const Emitter& any = *batch.face[0].emitter;
  if (only && aims_->hidden(any.light, link, group.box, batch.box)) return;
  batch.aim = aims_->towards(any.light, link, group.box, batch.box, whole);
  batch.others = batch.aim.facets.size();
  if (batch.others > 0) batch.others = intersector_->others_first(batch.aim, scene_->meshes[any.mesh].object);
  const bool panes = intersector_->panes().any() && intersector_->panes().between(group.box, batch.box);
  batch.own = 0;
  for (std::uint32_t f = 0; f < batch.count; ++f) {
    Face& face = batch.face[f];
    face.panes = panes;
    if (batch.others == batch.aim.facets.size() || own_facets_miss(*geometry_, *face.emitter, group.box)) continue;
    batch.own |= 1U << f;
  }
  const bool later = batch.given >= 0 && only && !panes;
  if (batch.given >= 0 && !later) find_shares(view, group, batch);
  for (std::uint32_t e = 0; e < kFaceEnds; ++e) look_at_ends(view, group, link, batch, later, e, look);
  if (later) share_out(view, group, batch, look);
  aims_->used(any.light, batch.aim);
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

/// All samples get the same share of what they receive together.
void FaceLight::find_shares(const SubPatchView& view, const ReceiverGroup& group, Batch& batch) const {
  for (std::uint32_t f = 0; f < batch.count; ++f) {
    Face& face = batch.face[f];
    const Emitter& emitter = *face.emitter;
    const double share = emitter.area * kernel(view.centre, view.receiver->normal, emitter.centre, emitter.normal);
    for (std::uint32_t k = 0; k < group.count; ++k) face.factor[k] = share;
  }
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
  find_factors(view, group, face);
  bool any = false;
  for (std::uint32_t k = 0; k < group.count; ++k) {
    look.factor[k] += face.factor[k];
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
