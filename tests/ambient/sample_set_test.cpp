#include "ambient/sample_set.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shodo {
namespace {

bool holds(std::span<const SamplePoint> set, double x, double y, double weight) {
  for (const SamplePoint& p : set) {
    if (std::abs(p.x - x) < 1e-15 && std::abs(p.y - y) < 1e-15 && p.weight == weight) return true;
  }
  return false;
}

constexpr SampleSet kAll[] = {SampleSet::kCentre, SampleSet::kGauss, SampleSet::kHalves,
                              SampleSet::kEight,  SampleSet::kRing,  SampleSet::kGrid};

TEST(SampleSet, QuadrilateralsMapOnThemselvesWhenTurnedOrMirrored) {
  for (const SampleSet kind : kAll) {
    const auto set = sample_points(kind, false);
    for (const SamplePoint& p : set) {
      EXPECT_TRUE(holds(set, -p.y, p.x, p.weight)) << set.size();
      EXPECT_TRUE(holds(set, -p.x, p.y, p.weight)) << set.size();
    }
  }
}

TEST(SampleSet, TrianglesMapOnThemselvesWhenCornersAreExchanged) {
  for (const SampleSet kind : kAll) {
    const auto set = sample_points(kind, true);
    for (const SamplePoint& p : set) {
      // x, y belong to corners 1 and 2; corner 0 has what is left, and all three sum to 0 about the centroid.
      EXPECT_TRUE(holds(set, p.y, p.x, p.weight)) << set.size();
      EXPECT_TRUE(holds(set, -p.x - p.y, p.x, p.weight)) << set.size();
    }
  }
}

TEST(SampleSet, PairsOfSetsHaveTheNumberOfSegmentsAskedFor) {
  for (const std::uint32_t segments : {1u, 16u, 64u, 256u}) {
    const SegmentSets sets = segment_sets(segments);
    const std::size_t product = sample_points(sets.few, false).size() * sample_points(sets.many, false).size();
    EXPECT_EQ(product * (sets.few == sets.many ? 1 : 2), segments);
  }
}

TEST(SampleSet, NoTwoCoordinatesOfDifferentSetsCancel) {
  for (const std::uint32_t segments : {64u, 256u}) {
    const SegmentSets sets = segment_sets(segments);
    for (const SamplePoint& p : sample_points(sets.few, false)) {
      for (const SamplePoint& q : sample_points(sets.many, false)) EXPECT_GT(std::abs(p.x + q.x), 0.05);
    }
  }
}

/// Mean of x^a y^b over the unit triangle, x and y from its corner.
double triangle_mean(int a, int b) { return 2 * std::tgamma(a + 1) * std::tgamma(b + 1) / std::tgamma(a + b + 3); }

void expect_exact_to_degree(SampleSet set, int degree) {
  for (int a = 0; a <= degree; ++a) {
    for (int b = 0; a + b <= degree; ++b) {
      double sum = 0;
      for (const SamplePoint& p : sample_points(set, true)) {
        sum += p.weight * std::pow(p.x + 1.0 / 3, a) * std::pow(p.y + 1.0 / 3, b);
      }
      EXPECT_NEAR(sum, triangle_mean(a, b), 1e-15) << sample_points(set, true).size() << " points, " << a << ", " << b;
    }
  }
}

TEST(SampleSet, TriangleRulesAreExactToTheirDegree) {
  expect_exact_to_degree(SampleSet::kCentre, 1);
  expect_exact_to_degree(SampleSet::kGauss, 2);
  expect_exact_to_degree(SampleSet::kEight, 5);
  expect_exact_to_degree(SampleSet::kGrid, 1);
}

TEST(SampleSet, TwoByTwoGaussPointsAreExactToDegree3) {
  for (int a = 0; a <= 3; ++a) {
    for (int b = 0; b <= 3; ++b) {
      double sum = 0;
      for (const SamplePoint& p : sample_points(SampleSet::kGauss, false)) {
        sum += p.weight * std::pow(p.x, a) * std::pow(p.y, b);
      }
      const double mean = (a % 2 == 0 ? 1.0 / (a + 1) : 0) * (b % 2 == 0 ? 1.0 / (b + 1) : 0);
      EXPECT_NEAR(sum, mean, 1e-15) << a << ", " << b;
    }
  }
}

}  // namespace
}  // namespace shodo
