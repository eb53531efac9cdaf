// All lights of a scene behind one question: how much of light l does this sample receive? (paper 2.1)
//
// Bytes: 56 a light and 48 a face that emits.
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

  std::uint32_t count() const { return static_cast<std::uint32_t>(scene_->lights.size()); }
  const Light& light(std::uint32_t l) const { return scene_->lights[l]; }

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
  std::uint32_t count_emitters() const;
  void list_emitters(std::uint32_t l, std::uint32_t& next);
  Link link(std::uint32_t l, const Receiver& receiver) const;

  const Scene* scene_;
  const Geometry* geometry_;
  Intersector* intersector_;
  std::span<Source> sources_;
  std::span<Emitter> emitters_;
  std::uint32_t clamped_ = 0;
};

}  // namespace shodo
