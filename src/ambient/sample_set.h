// Fixed points on a patch: quadrature of the middle tier, and ends of the segments that find the visible fraction.
//
// A point is a pair (x, y) and lies at centre + x a + y b + x y d (ambient/patch_shape.h). Of a quadrilateral x, y run
// over [-1, 1]; of a triangle they are its barycentric coordinates of corners 1 and 2 less 1/3. Every set is mapped on
// itself by each exchange of corners, so nothing depends on the order of vertices:
//
//     set        quadrilateral                                   triangle
//     kCentre    centre                                          centroid
//     kGauss     4: 2 x 2 Gauss points, degree 3                 4: centroid and 3 points, equal weights, degree 2
//     kHalves    4: (+-1/2, +-1/2)                               as kGauss
//     kEight     8: (+-3/4, +-1/4), (+-1/4, +-3/4)               7 points of Radon 1948, degree 5
//     kRing      8: (+-2/3, +-2/3), (+-2/3, 0), (0, +-2/3)       as kEight
//     kGrid      16: centres of the 4 x 4 grid                   16: centroids of sub-triangles
//
// The weights sum to 1. A pair of patches has 1 segment (kCentre to kCentre), 16 (kGauss to kGauss), 64 (kHalves to
// kEight and kEight to kHalves) or 256 (kRing to kGrid and back). With one symmetric set at both ends every shadow
// edge that lies evenly to the patches, as edges in rooms do, is met exactly by many segments, which then all count
// as blocked: two unit squares in 8 to 12 divisions with a screen half-way lost up to 4 % so, whether by 64 or 256
// segments. No sum of coordinates of two different sets is zero, and the loss goes down to 0.6 %.
#pragma once

#include <cstdint>
#include <span>

namespace shodo {

struct SamplePoint {
  double x, y, weight;
};

enum class SampleSet : std::uint8_t { kCentre, kGauss, kHalves, kEight, kRing, kGrid };

inline constexpr std::uint32_t kMostSamples = 16;

std::span<const SamplePoint> sample_points(SampleSet set, bool triangle);

/// From `few` to `many`, and if they differ from `many` to `few` as well.
struct SegmentSets {
  SampleSet few, many;
};

/// `segments`: 1, 16, 64 or 256.
SegmentSets segment_sets(std::uint32_t segments);

}  // namespace shodo
