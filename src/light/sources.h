// All lights of a scene behind two questions: how much of a point light or sun does this sample receive, and how much
// of an area or polyhedral light do these? (paper 2.1)
//
// With flags a light is aimed at once from all samples of a sub-patch, and the faces of it again: where nothing can
// come between, no segment is sent. Bytes: 104 a light, and those of light/emitter.h and light/patch_aims.h.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/face_light.h"
#include "light/receiver.h"
#include "scene/scene.h"
#include "visibility/geometry.h"
#include "visibility/intersector.h"

namespace shodo {

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

  /// The patch that the receivers which come next belong to: around their samples, mostly (light/patch_aims.h).
  void start_patch(const LatticeBox& patch) { aims_.start(patch); }
  /// The samples that come next lie in or near this box (whatever it is, answers are the same): those of a sub-patch.
  void expect(const LatticeBox& samples);

  /// False if point light or sun l is behind the receiver's plane.
  bool may_shine_on(std::uint32_t l, const Receiver& receiver) const;
  /// Of a point light or a sun. `trace_dark`: look for blockers even where the light sends nothing, so that `visible`
  /// holds there too.
  Received receive(std::uint32_t l, const Receiver& receiver, const Sample& sample, bool trace_dark = false);
  /// Of an area or polyhedral light.
  FaceLook look(std::uint32_t l, const SubPatchView& view, const ReceiverGroup& group);
  /// The same without segments: `factor` only, of the faces within this reach.
  FaceLook factors(std::uint32_t l, const SubPatchView& view, const ReceiverGroup& group, FaceReach reach);
  /// What sample k of the group gets, given look().
  Received received(std::uint32_t l, const ReceiverGroup& group, const FaceLook& look, std::uint32_t k) const;

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
  };

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
  Emitters emitters_;
  LatticeBox expected_;                 // samples
  Aim aim_;                             // from them to light aimed_, for receiver aimed_object_
  std::uint32_t aimed_ = kNone;
  std::uint32_t aimed_object_ = kNone;
  std::uint32_t clamped_ = 0;
};

}  // namespace shodo
