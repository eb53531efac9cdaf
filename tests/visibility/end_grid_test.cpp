// The grid of a light's ends: whatever blocks a segment to one of them is found.
#include "visibility/end_grid.h"

#include <gtest/gtest.h>

#include <vector>

#include "scenes.h"
#include "slow_twin.h"
#include "visibility/blockers.h"

namespace shodo {
namespace {

std::int32_t& at(LatticePoint& p, std::uint32_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

LatticePoint point_within(Random& random, const LatticeBox& box) {
  return {random.between(box.low[0], box.high[0]), random.between(box.low[1], box.high[1]),
          random.between(box.low[2], box.high[2])};
}

TEST(EndGrid, MissesNoEndThatATriangleHides) {
  Random random(3);
  std::uint64_t hidden = 0, found = 0, asked = 0, missed = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const std::uint32_t axis = random.below(3);
    const std::int32_t plane = random.between(-300000, 300000), size = 1 << random.between(2, 17);
    std::vector<LatticePoint> ends;
    LatticeBox box;
    const LatticePoint middle{random.between(-300000, 300000), random.between(-300000, 300000),
                              random.between(-300000, 300000)};
    for (int k = 0; k < 32; ++k) {
      LatticePoint q{middle.x + random.between(-size, size), middle.y + random.between(-size, size),
                     middle.z + random.between(-size, size)};
      at(q, axis) = plane;
      ends.push_back(q);
      box.include(q);
    }
    const EndGrid grid(ends, box);
    ASSERT_TRUE(grid.usable());
    // Samples on one side of the light, in a box that is small, large or a point.
    LatticeBox from;
    const std::int32_t reach = random.below(3) == 0 ? 0 : 1 << random.between(1, 15);
    const bool above = random.below(2) == 0;
    LatticePoint first{random.between(-400000, 400000), random.between(-400000, 400000),
                       random.between(-400000, 400000)};
    const std::int32_t off = 1 + random.between(0, 1 << random.between(1, 17));
    at(first, axis) = above ? plane + off : plane - off;
    from.include(first);
    LatticePoint second{first.x + reach, first.y + reach, first.z + reach};
    at(second, axis) = above ? at(first, axis) + reach : at(first, axis) - reach;
    from.include(second);
    for (int s = 0; s < 20; ++s) {
      // A triangle about a point of some segment, flat or not.
      const LatticePoint p = point_within(random, from), q = ends[random.below(32)];
      const double t = random.unit();
      const auto between = [&](std::int32_t a, std::int32_t b) {
        return a + static_cast<std::int32_t>(t * static_cast<double>(b - a));
      };
      const std::int32_t spread = 1 << random.between(3, 15);
      Triangle triangle;
      for (LatticePoint* corner : {&triangle.a, &triangle.b, &triangle.c}) {
        *corner = {(between(p.x, q.x) + random.between(-spread, spread)) / 2 * 2,
                   (between(p.y, q.y) + random.between(-spread, spread)) / 2 * 2,
                   (between(p.z, q.z) + random.between(-spread, spread)) / 2 * 2};
      }
      if (random.below(2) == 0) {
        const std::uint32_t flat = random.below(3);
        at(triangle.b, flat) = at(triangle.c, flat) = at(triangle.a, flat);
      }
      bool tilted = false;
      const LatticeBox around = facet_box({&triangle, 1}, tilted);
      const std::uint32_t shadow = grid.shadow(around, from);
      found += static_cast<std::uint64_t>(__builtin_popcount(shadow));
      asked += 32;
      for (std::uint32_t k = 0; k < 32; ++k) {
        if (!twin::blocks_segment(triangle, p, ends[k])) continue;
        ++hidden;
        missed += (shadow >> k & 1) == 0 ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(missed, 0u);
  EXPECT_GT(hidden, 50000u);
  EXPECT_LT(found, asked * 3 / 4);  // it does rule out ends
}

TEST(EndGrid, IsForFlatLightsOnly) {
  const LatticePoint ends[2] = {{1, 1, 1}, {101, 201, 301}};
  LatticeBox box;
  for (const LatticePoint& end : ends) box.include(end);
  EXPECT_FALSE(EndGrid(ends, box).usable());
}

}  // namespace
}  // namespace shodo
