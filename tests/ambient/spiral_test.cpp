// Directions of the gather's rays: their moments against closed forms of the cosine-weighted hemisphere.
#include <gtest/gtest.h>

#include <cmath>

#include "ambient/spiral.h"

namespace shodo {
namespace {

/// With z along the normal: E z = 2/3, E z^2 = 1/2, E x^2 = E y^2 = 1/4, E x = E y = E xy = 0.
TEST(Spiral, DirectionsAreEvenByCosine) {
  const Vec3 normals[] = {{0, 0, 1},  {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, normalised({1, -2, 0.5}),
                          normalised({-3, 1, 2})};
  for (const Vec3& n : normals) {
    for (const double turn : {0.0, 0.3, 0.99}) {
      constexpr std::uint32_t kCount = 1000;
      Spiral spiral(n, kCount, turn);
      double up = 0, up_squared = 0;
      Vec3 sum;
      for (std::uint32_t k = 0; k < kCount; ++k) {
        const LatticeVector way = spiral.next();
        const Vec3 d = normalised(vector_of(way));
        EXPECT_GT(dot(d, n), 0);
        up += dot(d, n) / kCount;
        up_squared += dot(d, n) * dot(d, n) / kCount;
        sum = sum + (1.0 / kCount) * d;
      }
      // A spiral's means converge like 1 / count, and the lattice turns a direction by 1e-6 at most.
      EXPECT_NEAR(up, 2.0 / 3, 1e-3);
      EXPECT_NEAR(up_squared, 0.5, 1e-5);
      EXPECT_NEAR(length(sum - up * n), 0, 2e-3);
    }
  }
}

/// No octant of the disc is left out: of a quarter of the directions, along the spiral, each has an eighth, but for
/// two.
TEST(Spiral, EveryPartOfItGoesAllRound) {
  Spiral spiral({0, 0, 1}, 256, 0.1);
  for (int part = 0; part < 4; ++part) {
    int octants[8] = {};
    for (int k = 0; k < 64; ++k) {
      const LatticeVector way = spiral.next();
      const double turn = std::atan2(static_cast<double>(way.y), static_cast<double>(way.x)) / (2 * M_PI) + 1;
      ++octants[static_cast<int>(8 * (turn - std::floor(turn)))];
    }
    for (const int count : octants) EXPECT_NEAR(count, 8, 2);
  }
}

TEST(Spiral, TurnedByAPartItIsTurnedByThat) {
  Spiral still({0, 0, 1}, 64, 0), turned({0, 0, 1}, 64, 0.25);
  for (int k = 0; k < 64; ++k) {
    const LatticeVector a = still.next(), b = turned.next();
    const Vec3 first = normalised({static_cast<double>(a.x), static_cast<double>(a.y), 0});
    const Vec3 second = normalised({static_cast<double>(b.x), static_cast<double>(b.y), 0});
    EXPECT_NEAR(dot(first, second), 0, 1e-4) << k;
  }
}

}  // namespace
}  // namespace shodo
