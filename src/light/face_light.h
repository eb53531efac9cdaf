// How much of an area or polyhedral light some samples receive (paper 2.1): E = pi L F, Lambertian faces.
//
// F, the form factor from a sample to a face, has four tiers by the error allowed (four times --tiers), with
// q = (s_p^2 + s_e^2) / (3 d^2), s twice the radii of sub-patch and face and d the distance of their centres:
//
//     far      kernel cos cos / (pi r^2) A, from the sub-patch's centre to the face's: error about q
//     middle   the kernel from each sample to the face's centre, times its mean over the face's Gauss points as seen
//              from the sub-patch's centre over the value between the centres: about q^2; faces of polyhedra only
//     scaled   the same with the contour integral from the sub-patch's centre for the mean: about 4 (r_p r_e / d^2)^2
//     near     Lambert's contour integral from each sample, exact: all else, and wherever one crosses the other's plane
//
// The part of it that arrives is that of fixed segments from the samples to the face's ends (light/emitter.h). Those to
// an area light are weighted by their kernels, so that a point near the horizon counts little and penumbrae are smooth;
// if its nearest point is at less than 0.4 of its radius they go to the leaves of a quadtree instead. Of a polyhedron
// each sample looks at one end of every face, another than its neighbours', or at all where it is near. Segments are
// tested in bulk (visibility/shadow.h). Where an aim finds nothing in the way none is sent, and none is counted.
// Stack: 2 KiB; no memory.
#pragma once

#include <cstdint>

#include "light/emitter.h"
#include "light/patch_aims.h"
#include "light/receiver_group.h"
#include "visibility/intersector.h"

namespace shodo {

/// What decides how a sub-patch is seen from lights; its samples share it.
struct SubPatchView {
  const Receiver* receiver = nullptr;
  Vec3 centre;
  double radius = 0;  // of the sphere about the centre that holds its corners
};

/// How fast a face's light varies over a sub-patch, by their distance: the mean is found by the four Gauss points, by
/// nine, or by the 16 samples of the grid, since no rule of few points will do.
enum class FaceReach : std::uint8_t { kFar, kNear, kVeryNear };

/// One light from the samples of a group; k as there.
struct FaceLook {
  double factor[kMostInGroup] = {};   // form factor to all faces, nothing in the way
  double far[kMostInGroup] = {};      // the part of it of faces whose reach is kFar
  double tested[kMostInGroup] = {};   // the part of it in faces of which some end is above the horizon
  double arrives[kMostInGroup] = {};  // the part of `tested` that is visible
  FaceReach reach = FaceReach::kFar;  // of the nearest face
  bool clear = false;                 // nothing is in the way, as an aim showed
  bool split = false;                 // a face was so near that segments went to the leaves of its quadtree

  std::uint32_t reaches_of_faces = 0;  // a bit each

  bool reaches(FaceReach r) const { return (reaches_of_faces >> static_cast<std::uint32_t>(r) & 1) != 0; }
  double visible(std::uint32_t k) const { return tested[k] > 0 ? arrives[k] / tested[k] : 0; }
};

class FaceLight {
 public:
  /// `tiers`: as in Options.
  FaceLight(const Scene& scene, const Geometry& geometry, Intersector& intersector, PatchAims& aims,
            const Emitters& emitters, double tiers)
      : scene_(&scene),
        geometry_(&geometry),
        intersector_(&intersector),
        aims_(&aims),
        emitters_(&emitters),
        tiers_(tiers) {}

  /// Faces `first` to `first + count`, all of one light, ascending, of which the samples receive `given` together if it
  /// isn't below 0: then shares of the faces are found roughly, and none of those in `behind`. `ends`: the box around
  /// the ends of all of them, `whole`: around all their points; `grid`: of an area light's ends, or null.
  FaceLook look(const SubPatchView& view, const ReceiverGroup& group, const Link& link, std::uint32_t first,
                std::uint32_t count, const LatticeBox& ends, const LatticeBox& whole, const EndGrid* grid,
                double given, std::uint32_t behind) const;
  /// The factor of all of them at one point, up to the error that is allowed; of two neighbouring points one is `odd`.
  /// None is nearer than `distance`, all of a polyhedron is above the horizon, and of its first 32 faces those in
  /// `behind` (a bit each) look the other way.
  double factor_at(const Vec3& point, const Receiver& receiver, std::uint32_t first, std::uint32_t count,
                   std::uint32_t behind, double distance, bool odd) const;
  /// Only `factor`, and of the faces within this reach; no segments.
  FaceLook factors(const SubPatchView& view, const ReceiverGroup& group, FaceReach reach, std::uint32_t first,
                   std::uint32_t count) const;

 private:
  /// Four times --tiers: the segments' own error is larger by far (doc/report.md).
  double allowed() const { return 4 * tiers_; }

  enum class Tier : std::uint8_t { kNothing, kFar, kMiddle, kScaled, kNear };
  struct Face;
  struct Batch;
  class EndWeights;

  Tier tier_of(const SubPatchView& view, Face& face) const;
  Tier tier_at(double distance, const Emitter& emitter) const;
  double pair_kernel(const Vec3& point, const Vec3& normal, const Emitter& emitter, bool odd) const;
  double mean_kernel(const SubPatchView& view, const Emitter& emitter) const;
  void find_factors(const SubPatchView& view, const ReceiverGroup& group, Face& face) const;
  bool take_face(const SubPatchView& view, const ReceiverGroup& group, double given, Face& face,
                 FaceLook& look) const;
  void find_shares(const SubPatchView& view, const ReceiverGroup& group, Batch& batch) const;
  bool is_split(const SubPatchView& view, const Emitter& emitter) const;
  // What the segments found, added to `look`.
  void look_at_leaves(const SubPatchView& view, const ReceiverGroup& group, const Link& link, const Face& face,
                      const Aim& aim, FaceLook& look) const;
  void look_at_area(const SubPatchView& view, const ReceiverGroup& group, const Link& link, const Face& face,
                    const Aim& aim, FaceLook& look) const;
  void look_at_one(const SubPatchView& view, const ReceiverGroup& group, const Link& link, const LatticeBox& ends,
                   const LatticeBox& whole, const EndGrid* grid, Face& face, FaceLook& look) const;
  void look_at_faces(const SubPatchView& view, const ReceiverGroup& group, const Link& link, const LatticeBox& whole,
                     bool only, Batch& batch, FaceLook& look) const;
  void look_at_ends(const SubPatchView& view, const ReceiverGroup& group, const Link& link, Batch& batch, bool later,
                    std::uint32_t e, FaceLook& look) const;
  void count_faces(const ReceiverGroup& group, const Batch& batch, std::uint32_t k, std::uint32_t wanted,
                   std::uint32_t shadow, const LatticePoint* ends, FaceLook& look) const;
  void share_out(const SubPatchView& view, const ReceiverGroup& group, Batch& batch, FaceLook& look) const;
  std::uint32_t ends_above(const SubPatchView& view, const Face& face, std::uint32_t first, std::uint32_t ends) const;

  const Scene* scene_;
  const Geometry* geometry_;
  Intersector* intersector_;
  PatchAims* aims_;
  const Emitters* emitters_;
  double tiers_;
};

}  // namespace shodo
