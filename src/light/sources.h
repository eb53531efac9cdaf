// All lights of a scene behind one question: how much of light l does this sample receive? (paper 2.1)
//
// With flags a light is aimed at once from all samples of a sub-patch, and its faces from each sample again: where
// nothing can come between, no segment is sent. Bytes: 80 a light and 72 a face that emits.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/area_source.h"
#include "light/receiver.h"
#include "scene/scene.h"
#include "visibility/geometry.h"
#include "visibility/intersector.h"

namespace shodo {

class Sources {
 public:
  Sources(const Scene& scene, const Geometry& geometry, Intersector& intersector)
      : scene_(&scene), geometry_(&geometry), intersector_(&intersector) {}

  /// Lists the faces that emit. Errors: kMemory.
  Status prepare(Arena& arena);
  /// Arena bytes of prepare().
  static std::uint64_t bytes(const Scene& scene);

  std::uint32_t count() const { return static_cast<std::uint32_t>(scene_->lights.size()); }
  const Light& light(std::uint32_t l) const { return scene_->lights[l]; }

  /// The samples that come next lie in or near this box (whatever it is, answers are the same): those of a sub-patch.
  void expect(const LatticeBox& samples);

  /// `trace_dark`: look for blockers even where the light sends nothing, so that `visible` holds there too.
  Received receive(std::uint32_t l, const Receiver& receiver, const Sample& sample, bool trace_dark = false);

  const Scene& scene() const { return *scene_; }
  const Geometry& geometry() const { return *geometry_; }
  const Intersector& intersector() const { return *intersector_; }
  /// How often a point light was within one lattice step of a sample.
  std::uint32_t clamped() const { return clamped_; }

 private:
  struct Source {
    std::uint32_t first_emitter = 0;
    std::uint32_t emitter_count = 0;
    LatticeVector to_sun;  // rounded; the same for rays and cosines
    Vec3 to_sun_unit;
    LatticeBox ends;      // of segments; with flags only
  };

  Received receive_point(std::uint32_t l, const Receiver& receiver, const Sample& sample, bool trace_dark);
  Received receive_sun(std::uint32_t l, const Receiver& receiver, const Sample& sample);
  Received receive_faces(std::uint32_t l, const Receiver& receiver, const Sample& sample);
  struct Faces {
    double factor = 0;   // to all faces
    double tested = 0;   // to those to which segments were sent
    double arrives = 0;  // the part of `tested` that is visible
    bool some_blocked = false;
  };
  Faces look_at_faces(std::uint32_t l, const Receiver& receiver, const Sample& sample, std::uint32_t finer);
  static std::uint32_t count_emitters(const Scene& scene);
  void list_emitters(std::uint32_t l, std::uint32_t& next);
  Link link(std::uint32_t l, const Receiver& receiver) const;
  void prepare_ends(std::uint32_t l);
  /// Aims from the expected samples to light l, this one included.
  const Aim& aim_at(std::uint32_t l, const Receiver& receiver, const Sample& sample);

  const Scene* scene_;
  const Geometry* geometry_;
  Intersector* intersector_;
  std::span<Source> sources_;
  std::span<Emitter> emitters_;
  std::span<LatticeBox> emitter_ends_;  // with flags only
  LatticeBox expected_;                 // samples
  Aim aim_;                             // from them to light aimed_, for receiver aimed_object_
  std::uint32_t aimed_ = kNone;
  std::uint32_t aimed_object_ = kNone;
  std::uint32_t clamped_ = 0;
};

}  // namespace shodo
