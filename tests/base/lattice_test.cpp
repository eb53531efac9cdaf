// The lattice against its definition, searched by trial: the nearest even or odd integer, the finest power of two.
#include "base/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace shodo {
namespace {

/// The integer of the given parity nearest to x; of two the one further from 0.
std::int32_t nearest_by_trial(double x, bool odd) {
  const std::int32_t near = static_cast<std::int32_t>(std::floor(x));
  std::int32_t best = near + 1000;
  for (std::int32_t k = near - 3; k <= near + 4; ++k) {
    if ((k % 2 != 0) != odd) continue;
    const double now = std::fabs(x - k), before = std::fabs(x - best);
    if (now < before || (now == before && std::abs(k) > std::abs(best))) best = k;
  }
  return best;
}

TEST(Lattice, PointsGoToTheNearestOfTheirParity) {
  std::mt19937_64 random(1);
  const Lattice lattice{4};
  for (int n = 0; n < 20000; ++n) {
    // Multiples of 1/16 steps, so that ties are common.
    const double steps = static_cast<double>(static_cast<std::int64_t>(random() % 4096) - 2048) / 16;
    const Vec3 point{steps / 4, -steps / 4, 0.25};
    const LatticePoint even = even_point(lattice, point), odd = odd_point(lattice, point);
    EXPECT_EQ(even.x, nearest_by_trial(steps, false)) << steps;
    EXPECT_EQ(even.y, -even.x);
    if (steps != 0) {
      EXPECT_EQ(odd.x, nearest_by_trial(steps, true)) << steps;
      EXPECT_EQ(odd.y, -odd.x);
    }
    EXPECT_EQ(even.x % 2, 0);
    EXPECT_EQ(std::abs(odd.x) % 2, 1);
    EXPECT_EQ(odd.z, 1);
  }
}

TEST(Lattice, IsTheFinestOnWhichTheBoxFits) {
  for (double half : {1e-30, 1e-3, 0.1, 1.0, 3.25, 524272.0, 524273.0, 1e6, 1e30}) {
    const Lattice lattice = lattice_for(half);
    int exponent = 0;
    EXPECT_EQ(std::frexp(lattice.steps_per_unit, &exponent), 0.5) << "a power of two";
    EXPECT_LE(half * lattice.steps_per_unit, kLatticeHalf);
    EXPECT_GT(half * lattice.steps_per_unit * 2, kLatticeHalf);
    EXPECT_EQ(lattice.step() * lattice.steps_per_unit, 1);
    const LatticePoint corner = even_point(lattice, {half, -half, half});
    EXPECT_LE(corner.x, kLatticeHalf);
    EXPECT_EQ(corner.y, -corner.x);
    // A sample on the box's face may stand one step outside; the cube has 16 to spare.
    EXPECT_LE(odd_point(lattice, {half, half, half}).x, kLatticeHalf + 1);
  }
  EXPECT_EQ(lattice_for(0).steps_per_unit, 1);
}

TEST(Lattice, APlaceOnTheLatticeComesBackExactly) {
  const Lattice lattice = lattice_for(3.25);
  for (std::int32_t k : {-kLatticeHalf, -1, 0, 2, 77777, kLatticeHalf}) {
    const LatticePoint point{k / 2 * 2, k / 2 * 2, 0};
    EXPECT_EQ(even_point(lattice, scene_point(lattice, point)), point);
    const LatticePoint odd{k / 2 * 2 + 1, 1, -1};
    EXPECT_EQ(odd_point(lattice, scene_point(lattice, odd)), odd);
  }
}

TEST(Lattice, DirectionsHaveTheirLargestComponentAt2To20) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> component(-1, 1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 v{component(random), component(random), component(random)};
    const LatticeVector d = lattice_direction(v), mirrored = lattice_direction(-v);
    const double largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
    // std::round goes away from zero in a tie, too.
    EXPECT_EQ(static_cast<double>(d.x), std::round(v.x / largest * (1 << 20)));
    EXPECT_EQ(static_cast<double>(d.y), std::round(v.y / largest * (1 << 20)));
    EXPECT_EQ(static_cast<double>(d.z), std::round(v.z / largest * (1 << 20)));
    EXPECT_EQ(mirrored, (LatticeVector{-d.x, -d.y, -d.z}));
  }
  EXPECT_EQ(lattice_direction({0, 0, 0}), LatticeVector{});
  EXPECT_EQ(lattice_direction({0, -1e300, 0}), (LatticeVector{0, -(1 << 20), 0}));
  EXPECT_EQ(lattice_direction({1e-310, 0, 0}), (LatticeVector{1 << 20, 0, 0}));
}

}  // namespace
}  // namespace shodo
