#include "ambient/sample_set.h"

#include <array>

#include "base/quadrature.h"

namespace shodo {

namespace {

constexpr double kThird = 1.0 / 3;

constexpr std::array<SamplePoint, 1> kCentre{{{0, 0, 1}}};

constexpr std::array<SamplePoint, 4> kQuad4{{{-kGaussTwo, -kGaussTwo, 0.25},
                                             {kGaussTwo, -kGaussTwo, 0.25},
                                             {-kGaussTwo, kGaussTwo, 0.25},
                                             {kGaussTwo, kGaussTwo, 0.25}}};

constexpr std::array<SamplePoint, 4> kHalves{
    {{-0.5, -0.5, 0.25}, {0.5, -0.5, 0.25}, {-0.5, 0.5, 0.25}, {0.5, 0.5, 0.25}}};

constexpr double kTwoThirds = 2.0 / 3;
constexpr std::array<SamplePoint, 8> kRing{{{-kTwoThirds, -kTwoThirds, 0.125},
                                            {0, -kTwoThirds, 0.125},
                                            {kTwoThirds, -kTwoThirds, 0.125},
                                            {-kTwoThirds, 0, 0.125},
                                            {kTwoThirds, 0, 0.125},
                                            {-kTwoThirds, kTwoThirds, 0.125},
                                            {0, kTwoThirds, 0.125},
                                            {kTwoThirds, kTwoThirds, 0.125}}};

constexpr std::array<SamplePoint, 8> kQuad8{{{-0.25, -0.75, 0.125},
                                             {0.25, -0.75, 0.125},
                                             {-0.75, -0.25, 0.125},
                                             {0.75, -0.25, 0.125},
                                             {-0.75, 0.25, 0.125},
                                             {0.75, 0.25, 0.125},
                                             {-0.25, 0.75, 0.125},
                                             {0.25, 0.75, 0.125}}};

constexpr std::array<SamplePoint, 16> grid_of_4() {
  std::array<SamplePoint, 16> set{};
  for (unsigned k = 0; k < 16; ++k) set[k] = {k % 4 * 0.5 - 0.75, k / 4 * 0.5 - 0.75, 0.0625};
  return set;
}

/// The three points with one barycentric coordinate 1 - 2 t and two t.
constexpr void put_orbit(SamplePoint* at, double t, double weight) {
  at[0] = {t - kThird, t - kThird, weight};
  at[1] = {1 - 2 * t - kThird, t - kThird, weight};
  at[2] = {t - kThird, 1 - 2 * t - kThird, weight};
}

constexpr std::array<SamplePoint, 4> triangle_4() {
  std::array<SamplePoint, 4> set{};
  put_orbit(&set[0], kInner, 0.25);
  set[3] = {0, 0, 0.25};
  return set;
}

constexpr std::array<SamplePoint, 7> triangle_7() {
  std::array<SamplePoint, 7> set{};
  put_orbit(&set[0], kRadonNear, kRadonNearWeight);
  put_orbit(&set[3], kRadonFar, kRadonFarWeight);
  set[6] = {0, 0, 0.225};
  return set;
}

constexpr std::array<SamplePoint, 16> triangle_16() {
  std::array<SamplePoint, 16> set{};
  unsigned k = 0;
  for (unsigned v = 0; v < 4; ++v) {
    for (unsigned u = 0; u + v < 4; ++u) {
      set[k++] = {(u + kThird) / 4 - kThird, (v + kThird) / 4 - kThird, 0.0625};
      if (u + v < 3) set[k++] = {(u + 2 * kThird) / 4 - kThird, (v + 2 * kThird) / 4 - kThird, 0.0625};
    }
  }
  return set;
}

constexpr std::array<SamplePoint, 16> kQuad16 = grid_of_4();
constexpr std::array<SamplePoint, 4> kTriangle4 = triangle_4();
constexpr std::array<SamplePoint, 7> kTriangle7 = triangle_7();
constexpr std::array<SamplePoint, 16> kTriangle16 = triangle_16();

}  // namespace

std::span<const SamplePoint> sample_points(SampleSet set, bool triangle) {
  switch (set) {
    case SampleSet::kCentre: return kCentre;
    case SampleSet::kGauss: return triangle ? kTriangle4 : kQuad4;
    case SampleSet::kHalves: return triangle ? kTriangle4 : kHalves;
    case SampleSet::kEight: return triangle ? std::span<const SamplePoint>(kTriangle7) : kQuad8;
    case SampleSet::kRing: return triangle ? std::span<const SamplePoint>(kTriangle7) : kRing;
    case SampleSet::kGrid: return triangle ? kTriangle16 : kQuad16;
  }
  return {};
}

SegmentSets segment_sets(std::uint32_t segments) {
  if (segments <= 1) return {SampleSet::kCentre, SampleSet::kCentre};
  if (segments <= 16) return {SampleSet::kGauss, SampleSet::kGauss};
  if (segments <= 64) return {SampleSet::kHalves, SampleSet::kEight};
  return {SampleSet::kRing, SampleSet::kGrid};
}

}  // namespace shodo
