// All lights of a scene behind two questions: how much of a point light or sun does this sample receive, and how much
// of an area or polyhedral light do these? (paper 2.1)
//
// With flags a light is aimed at once from all samples of a sub-patch, and the faces of it again: where nothing can
// come between, no segment is sent. Bytes: 400 a light, and those of light/emitter.h and light/patch_aims.h.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/face_light.h"
#include "light/factor_field.h"
#include "light/point_source.h"
#include "light/receiver.h"
#include "scene/scene.h"
#include "visibility/geometry.h"
#include "visibility/intersector.h"

namespace shodo {

inline constexpr std::uint32_t kUsualSubPatches = 16384;

class Sources {
 public:
  /// `tiers`: as in Options.
  Sources(const Scene& scene, const Geometry& geometry, Intersector& intersector, double tiers)
      : scene_(&scene), geometry_(&geometry), intersector_(&intersector), tiers_(tiers), aims_(intersector) {}

  /// Lists the faces that emit. Errors: kMemory.
  Status prepare(Arena& arena);
  /// Arena bytes of prepare().
  static std::uint64_t bytes(const Scene& scene);

  std::uint32_t count() const { return static_cast<std::uint32_t>(scene_->lights.size()); }
  const Light& light(std::uint32_t l) const { return scene_->lights[l]; }

  /// The patch that the receivers which come next belong to: around their samples, surely or mostly
  /// (light/patch_aims.h).
  void start_patch(const LatticeBox& patch, bool surely) {
    aims_.start(patch, surely);
    shared_ = false;
  }
  /// They lie on this parallelogram, in its plane: light may be found for all of them together.
  void share_factors(const Receiver& receiver, const Piece& patch);
  /// Of an area or polyhedral light, nothing in the way: the mean over a sub-patch; -1: each is to ask for itself.
  double shared_factor(std::uint32_t l, const Receiver& receiver);
  /// A sub-patch of it comes, or the intersector's list was used otherwise.
  void forget_aims() {
    aims_.forget();
    aimed_ = kNone;
  }
  /// The samples that come next lie in or near this box (whatever it is, answers are the same): those of a sub-patch.
  void expect(const LatticeBox& samples);

  /// What light l shows to all of the patch.
  Shown shown(std::uint32_t l, const Receiver& receiver);

  /// What counts as the area of a sub-patch where its part of a light's flux is weighed. In a scene of more sub-patches
  /// than rooms have, a multiple: else all parts would be small, and a finer map as wrong as a coarse one.
  double usual_area(double area) const {
    const std::uint32_t count = scene_->sub_patch_count;
    return count > kUsualSubPatches ? area * (static_cast<double>(count) / kUsualSubPatches) : area;
  }
  /// The part of the flux of an area or polyhedral light that falls on a sub-patch of this area, squared; nothing in
  /// the way, roughly and not much too little. 1 for a light nearer than so many radii of the sub-patch that the
  /// centre's form factor isn't the mean's, where there is no `shared_factor`.
  double share_squared(std::uint32_t l, const SubPatchView& view, double area, double shared_factor) const;
  /// The same of a point light, by what the sub-patch's centre receives.
  double point_share(std::uint32_t l, const Vec3& centre, double lux, double area) const;

  /// False if point light or sun l is behind the receiver's plane.
  bool may_shine_on(std::uint32_t l, const Receiver& receiver) const;
  /// Of a point light or a sun. `trace_dark`: look for blockers even where the light sends nothing, so that `visible`
  /// holds there too.
  Received receive(std::uint32_t l, const Receiver& receiver, const Sample& sample, bool trace_dark = false);
  /// The same of a point light, nothing in the way.
  double point_lux_at(std::uint32_t l, const Receiver& receiver, const Vec3& point) const {
    return point_lux(*scene_, light(l), receiver, point, geometry_->lattice.step()).lux;
  }
  /// Of an area or polyhedral light.
  FaceLook look(std::uint32_t l, const SubPatchView& view, const ReceiverGroup& group, double shared_factor = -1);
  /// The same without segments: `factor` only, of the faces within this reach.
  FaceLook factors(std::uint32_t l, const SubPatchView& view, const ReceiverGroup& group, FaceReach reach);
  /// What sample k of the group gets, given look().
  Received received(std::uint32_t l, const ReceiverGroup& group, const FaceLook& look, std::uint32_t k) const;

  /// The same where nothing is in the way, of the light's shared_factor().
  Received all_of(std::uint32_t l, double shared_factor) const;

  const Scene& scene() const { return *scene_; }
  const Geometry& geometry() const { return *geometry_; }
  Intersector& intersector() const { return *intersector_; }
  const Emitters& emitters() const { return emitters_; }
  /// How often a point light was within one lattice step of a sample.
  std::uint32_t clamped() const { return clamped_; }

 private:
  struct Source {
    std::uint32_t first_emitter = 0;
    std::uint32_t emitter_count = 0;
    LatticeVector to_sun;  // rounded; the same for rays and cosines
    Vec3 to_sun_unit;
    LatticeBox ends;   // of segments
    LatticeBox whole;  // any point of the faces
    EndGrid grid;      // of an area light's ends
    Vec3 centre;         // of the sphere that holds an area light or polyhedron
    double radius = 0;
    FactorField field;   // over the patch
    std::uint32_t behind = 0;  // of a polyhedron's first 32 faces those (a bit each) that look away from all of it
  };

  FaceLight face_light() { return FaceLight(*scene_, *geometry_, *intersector_, aims_, emitters_, tiers_); }
  void enclose(Source& source) const;
  FactorField::State field_of(const Source& source) const;
  std::uint32_t faces_behind(const Source& source) const;
  void fill(std::uint32_t l, Source& source);
  Received receive_point(std::uint32_t l, const Receiver& receiver, const Sample& sample, bool trace_dark);
  Received receive_sun(std::uint32_t l, const Receiver& receiver, const Sample& sample);
  struct EmitterCount {
    std::uint32_t faces = 0, ends = 0;
  };
  static EmitterCount count_emitters(const Scene& scene);
  void list_emitters(std::uint32_t l, EmitterCount& next);
  Link link(std::uint32_t l, const Receiver& receiver) const;
  /// Aims from the expected samples to light l, this one included.
  const Aim& aim_at(std::uint32_t l, const Receiver& receiver, const Sample& sample);

  const Scene* scene_;
  const Geometry* geometry_;
  Intersector* intersector_;
  double tiers_;
  PatchAims aims_;
  std::span<Source> sources_;
  bool shared_ = false;  // what follows is of the patch at work
  Receiver patch_receiver_;
  Piece patch_;
  Vec3 patch_centre_;
  double patch_radius_ = 0;  // of the sphere about the centre that holds its corners
  Emitters emitters_;
  LatticeBox expected_;                 // samples
  Aim aim_;                             // from them to light aimed_, for receiver aimed_object_
  std::uint32_t aimed_ = kNone;
  std::uint32_t aimed_object_ = kNone;
  std::uint32_t clamped_ = 0;
};

}  // namespace shodo
