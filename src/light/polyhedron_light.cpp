// The faces of a polyhedron, seen from some samples: up to 16 at once, whose ends a sample looks at in bulk.
//
// Facets of the polyhedron itself are asked about those faces only that they can hide (light/emitter.h). How the light
// is shared among its faces matters only where some are seen and some not, so that it is found then.
#include "base/bits.h"
#include "light/face_work.h"

namespace shodo {

/// All samples get the same share of what they receive together.
void FaceLight::find_shares(const SubPatchView& view, const ReceiverGroup& group, Batch& batch) const {
  for (std::uint32_t f = 0; f < batch.count; ++f) {
    Face& face = batch.face[f];
    const Emitter& emitter = *face.emitter;
    const double share = emitter.area * kernel(view.centre, view.receiver->normal, emitter.centre, emitter.normal);
    for (std::uint32_t k = 0; k < group.count; ++k) face.factor[k] = share;
  }
}

namespace {

/// Of a polyhedron's faces each sample looks at one Gauss point: neighbours at different ones, so that mirror images of
/// a sub-patch and of a face are those of each other.
std::uint32_t end_of(const ReceiverGroup& group, std::uint32_t k) {
  if (group.count == kGaussSamples) return k;
  const std::uint32_t index = group.grid_index[k];
  return (index & 1U) + 2 * (index / kGridCuts & 1U);
}

}  // namespace

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
  bool asked = look.reach != FaceReach::kFar;
  for (std::uint32_t k = 0; k < group.count; ++k) asked = asked || end_of(group, k) == e;
  if (!asked) return;
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

}  // namespace shodo
