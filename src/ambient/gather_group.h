// Some sub-patches of one patch gather light together (ours; doc/gather.md).
//
// The nodes of all meshes (ambient/block_tree.h) are walked in ascending order; each is taken as a whole, or replaced
// by its parts. With w its light here over the scene's mean illuminance, estimated for the sub-patch that is nearest to
// the node, and `error` what one node may make wrong of it:
//     w small                    one kernel and one segment for all sub-patches
//     the kernel's series fits   (q^2 w, the sizes of both ends in q, and its variation times how unevenly the node
//                                sends) two or four segments for the group; where they agree value and gradient at the
//                                centre, or a kernel for each sub-patch if it bends; where they don't, each sub-patch
//                                gets segments of its own
//     a patch too near for that  its contour from each sub-patch; or, if it sends unevenly or may be in half shade, its
//                                sub-patches one by one, which send their direct light and the ambient light found so
//                                far; from close by from four places in a sub-patch, in all the closed form between
//                                rectangles along the axes
// Otherwise, and in half shade if w is large, blocks are split. Close and near: ambient/gather_near.cpp. Stack: 1 KiB.
#pragma once

#include <cstdint>
#include <span>

#include "ambient/box_factor.h"
#include "ambient/gather_lists.h"
#include "ambient/gather_senders.h"
#include "ambient/surfaces.h"
#include "light/direct.h"

namespace shodo {

inline constexpr std::uint32_t kMostTogether = 16;

// Of the error of a node: up to the first one segment is enough, beyond the last a node in half shade is too large.
inline constexpr double kOneSegment = 2, kMostMixed = 8;

/// So that not all segments go from the same corners to the same corners.
inline std::uint32_t gather_hash(std::uint32_t i, std::uint32_t j) {
  std::uint32_t h = i * 0x9E3779B1u + j * 0x85EBCA77u;
  h ^= h >> 15;
  return (h * 0x2C1B3C6Du) >> 16;
}

/// A sub-patch that gathers.
struct GatherPoint {
  Vec3 offset;               // of its centre from the group's; before, its centre
  double height = 0;         // of that over the group's plane
  double offset_squared = 0;
  double side_squared = 0;   // longest side of the sub-patch
  LatticePoint from[4];      // where its segments start
  Vec3 place[4];             // the same places
  double lx[3] = {0, 0, 0};  // gathered
  double factor = 0;         // sum of form factors, shadows included
  double variance = 0;       // of `factor`, by segments
  double geometry_error = 0;  // of it besides, estimated
  std::uint32_t sub_patch = 0;
};

/// What the parts of a gather share.
struct GatherScene {
  const Surfaces& surfaces;
  const DirectLight& direct;
  std::span<const float> ambient_lx;  // of sub-patches
  const GatherSenders& senders;
  GatherLists& lists;
  double error;      // of one node's light, of the mean illuminance
  double mean_area;  // of patches, scene units squared
};

class GatherGroup {
 public:
  explicit GatherGroup(const GatherScene& scene) : scene_(scene) {}

  /// The points, whose offsets are their centres, belong to the patch at `node` of mesh_at[place].
  void gather(std::uint32_t node, std::uint32_t place, std::span<GatherPoint> points);

 private:
  enum class Step : std::uint8_t { kDone, kSplit };
  /// A node as the group's centre sees it.
  struct Look {
    std::uint32_t node = 0;
    const Patch* patch = nullptr;
    double radiosity[3] = {0, 0, 0};
    Vec3 way;
    double over_i = 0, over_j = 0, squared = 0;
    double nearest = 0;  // of squared distances, among the points
    double level = 0;
    double bound = 0;  // of what it sends here
    double q = 0;
    double factor = 0, correction = 1, vary = 0;  // of the series
    double most = 0;                              // factor, from the nearest point
    bool near = false;                            // there is none
  };

  static double solid_part(const Scene& scene, const Mesh& mesh);
  void place_group(std::uint32_t node);
  Step consider(std::uint32_t j);
  bool look_at(std::uint32_t j, Look& look) const;
  double nearest_squared(const Look& look) const;
  void develop(const PatchShape& shape, Look& look) const;
  bool bends(const Look& look, double w) const;
  void gather_tiny(const Look& look);
  void gather_linear(const Look& look);
  void gather_each(const Look& look, bool clear, std::uint32_t segments);
  void gather_near(const Look& look);
  void gather_polygon(const Look& look, const Piece& piece, bool clear);
  AxisRectangle rectangle(const GatherPoint& point) const;
  void gather_close(GatherPoint& point, const Piece& piece, bool planar, const AxisRectangle& sender,
                    const double* radiosity, const LatticePoint* to, std::uint32_t ends, bool clear);
  struct Part;
  double part_factor(GatherPoint& point, const Part& part) const;
  void gather_parts(const Look& look, bool clear);
  double visible(GatherPoint& point, std::uint32_t turn, const LatticePoint* to, std::uint32_t ends,
                 std::uint32_t segments, double factor);
  double group_visible(const Look& look, std::uint32_t segments);
  void add(GatherPoint& point, const double* radiosity, double factor) const;
  void finish_points();
  LatticeBox samples_box(std::uint32_t j) const;
  LatticeBox inner_box(std::uint32_t j, const Mesh& mesh) const;
  LatticeBox whole_box(std::uint32_t j) const;

  const GatherScene& scene_;
  std::span<GatherPoint> points_;
  std::uint32_t node_ = 0;
  Vec3 centre_, normal_;
  double solid_ = 1;  // of the mesh at work: through a pane one sees what is behind as well
  double error_ = 0;  // that of scene_, more for small patches
  double reach_ = 0;  // of the points' sub-patches, from the centre
  double own_squared_ = 0;  // the longest side of those
  double geometry_error_ = 0;  // of what all points share
  // Of the group's centre, and gradients.
  double shared_lx_[3] = {}, shared_factor_ = 0, shared_variance_ = 0;
  Vec3 slope_lx_[3], slope_factor_;
};

}  // namespace shodo
