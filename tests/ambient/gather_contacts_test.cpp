// What sub-patches gather from close by, along long patches and beside or under what stands on them.
#include <cmath>

#include "ambient/visible_part.h"
#include "support/closed_factors.h"
#include "tests/ambient/gathered.h"

namespace shodo {
namespace {

constexpr double kLit = 1000, kSends = 0.5 * kLit;  // of the white surfaces, rho 0.5; all others are black

/// Howell: a point to a parallel rectangle at distance c through its corner, then to any by signed corners.
double corner(double x, double y) {
  const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * M_PI);
}
double parallel(double x0, double x1, double y0, double y1, double c) {
  return corner(x1 / c, y1 / c) - corner(x0 / c, y1 / c) - corner(x1 / c, y0 / c) + corner(x0 / c, y0 / c);
}

/// What white surfaces send to sub-patches that send nothing themselves.
Gathered lit_by_white(const std::string& text, std::uint32_t lines) {
  const std::string all = black_and_white() + text;
  return Gathered(all, lines, [&](const Vec3&, std::uint32_t m) {
    std::size_t at = 0;
    for (std::uint32_t k = 0; k <= m; ++k) at = all.find("quad ", at) + 5;
    return all.compare(at, 5, "white") == 0 ? kLit : 0.0;
  });
}

/// A strip of four sub-patches, 0.7 m x 6 cm each, and seven bright patches of 10 cm at `c` over the last of them,
/// 1.05 m from the strip's middle; against the mean of the closed form of points. A row is narrow and seen from far
/// along it, so that 16384 lines leave 0.3 % of what it would send if it were all around.
TEST(GatherContacts, AStripsSubPatchIsNotFarFromWhatIsNearItAlone) {
  for (const double c : {0.1, 0.2, 0.3}) {
    Gathered strip = lit_by_white("object strip_\n" +
                                      facing("+z", "black", {0, 0, 0}, {2.8, 0.06, 0}, "patches 1 1 sub 4 1") +
                                      "object row_\n" +
                                      facing("-z", "white", {2.1, -0.02, c}, {2.8, 0.08, c}, "patches 1 7 sub 1 1"),
                                  16384);
    ASSERT_TRUE(strip.gather().done());
    constexpr int kAlong = 256, kAcross = 8;
    double mean = 0;
    for (int a = 0; a < kAlong * kAcross; ++a) {
      const double x = 0.7 * (a % kAlong + 0.5) / kAlong, y = 0.06 * (a / kAlong + 0.5) / kAcross;
      mean += parallel(-x, 0.7 - x, -0.02 - y, 0.08 - y, c) / (kAlong * kAcross);
    }
    EXPECT_NEAR(strip.gathered(0, 3), kSends * mean, 0.004 * kSends) << c;
  }
}

/// G of rectangles at right angles, both with an edge on one line: all of its length `l`, or from a to b of it.
double adjacent_exchange(double l, double w, double h) { return l > 0 ? l * w * adjacent(l, w, h) : 0; }
double adjacent_exchange(double l, double a, double b, double w, double h) {
  // The parts of l beside [a, b] see it as a whole of both lengths does, less each by itself.
  const auto whole = [&](double length) { return adjacent_exchange(length, w, h); };
  return whole(b - a) + 0.5 * (whole(b) - whole(a) - whole(b - a)) + 0.5 * (whole(l - a) - whole(l - b) - whole(b - a));
}

/// Against Howell C-14: strips along the foot of a wall of 64 patches, and tiles there. 64 x 65536 lines leave some
/// 3e-4 of what a white hemisphere would send (measured; N^-0.6).
TEST(GatherContacts, BesideAnEdgeAWallGetsWhatTheClosedFormSays) {
  const double length = 0.5;
  for (const double height : {0.06, 0.5}) {
    for (const double width : {0.01, 0.05, 0.5}) {
      for (const double from : {0.0, 0.085, 0.225}) {
        if (from > 0 && width < 0.05) continue;  // too little to tell
        const double to = from > 0 ? from + 0.05 : length;
        Gathered bar = lit_by_white("object bar\n" +
                                        facing("+y", "black", {0, 0, 0}, {length, 0, height}, "patches 8 8 sub 1 1") +
                                        "object foot\n" + facing("+z", "white", {from, 0, 0}, {to, width, 0}),
                                    65536);
        ASSERT_TRUE(bar.gather().done());
        const double expected = kSends * adjacent_exchange(length, from, to, width, height) / (length * height);
        EXPECT_NEAR(bar.mean(0), expected, 6e-4 * kSends) << height << ' ' << width << ' ' << from;
      }
    }
  }
}

/// A black box of 2 cm without a bottom.
std::string lid(const std::string& name, const Vec3& low, const Vec3& high) {
  const Vec3 a{low.x, low.y, 0.02}, b{high.x, high.y, 0.02};
  return "object " + name + "\n" + facing("-x", "black", low, {low.x, b.y, b.z}) +
         facing("+x", "black", {b.x, low.y, 0}, b) + facing("-y", "black", low, {b.x, low.y, b.z}) +
         facing("+y", "black", {low.x, b.y, 0}, b) + facing("+z", "black", a, b);
}

/// Of a sub-patch of 50 cm a half or a quarter is not under a box, which is beyond all that the rest sees of a panel.
/// Sixteenths tell these parts exactly; what is left is noise, less than N^-0.5 of what a bright hemisphere would send.
/// What is wholly under a box keeps what it has.
TEST(GatherContacts, ASubPatchPartlyUnderABoxGathersWhereItIsSeen) {
  struct Case {
    double x, y;  // of the sub-patch, seen
  };
  for (const auto& [x, y] : {Case{0.25, 0.5}, Case{0.5, 0.25}, Case{0.25, 0.25}}) {
    const bool along_x = x < 0.5;
    const Vec3 low = along_x ? Vec3{0.25, -0.01, 0} : Vec3{-0.01, 0.25, 0};
    std::string boxes = lid("box", low, {1.01, 1.01, 0});
    if (x == y) boxes += lid("another", {-0.01, 0.25, 0}, {0.249, 1.01, 0});
    Gathered floor = lit_by_white("object floor_\n" +
                                      facing("+z", "black", {0, 0, 0}, {1, 1, 0}, "patches 1 1 sub 2 2") + boxes +
                                      "object panel_\n" + facing("-z", "white", {-1, -0.75, 1}, {0, 0.25, 1}),
                                  65536);
    const std::uint32_t under = along_x ? 1 : 2;
    floor.lx[under] = 7;
    ASSERT_TRUE(floor.gather().done());
    const auto at = [](double px, double py) { return parallel(-1 - px, -px, -0.75 - py, 0.25 - py, 1); };
    constexpr int kSide = 64;
    double mean = 0;
    for (int k = 0; k < kSide * kSide; ++k) {
      mean += at(x * (k % kSide + 0.5) / kSide, y * (k / kSide + 0.5) / kSide) / (kSide * kSide);
    }
    EXPECT_NEAR(floor.gathered(0, 0), kSends * mean, 0.004 * kSends) << x << ' ' << y;
    EXPECT_NEAR(floor.gathered(0, under), 7, 1e-4) << x << ' ' << y;
  }
}

/// Sixteenths of a floor's sub-patch that are in the open; the floor is the first mesh.
std::uint32_t visible(const std::string& floor, const std::string& lids, std::uint32_t sub_patch = 0) {
  const AmbientScene scene(black_and_white() + "object floor_\n" + floor + lids);
  Intersector intersector(scene.geometry);
  return visible_sixteenths(scene.loaded.scene, scene.geometry, intersector, 0, sub_patch);
}

/// One of its points is in each of 16 columns, rows and squares.
TEST(GatherContacts, SixteenPointsTellEverySixteenth) {
  const std::string floor = facing("+z", "black", {0, 0, 0}, {3.2, 1.6, 0}, "patches 1 1 sub 2 1");
  for (const std::uint32_t part : {0u, 1u}) {
    for (std::uint32_t k = 0; k < 16; ++k) {
      const double at = 0.1 * k, x = 1.6 * part, column = 0.4 * (k % 4), row = 0.4 * (k / 4);
      EXPECT_EQ(visible(floor, lid("l", {x + at, -0.1, 0}, {x + 1.7, 1.7, 0}), part), k);
      EXPECT_EQ(visible(floor, lid("l", {-0.1, at, 0}, {3.3, 1.7, 0}), part), k);
      EXPECT_EQ(visible(floor, lid("l", {x + column, row, 0}, {x + column + 0.4, row + 0.4, 0}), part), 15u);
    }
  }
}

/// A place that is a sixteenth wide each way has a point in some of a row of sub-patches, not in all.
TEST(GatherContacts, PointsDifferFromSubPatchToSubPatch) {
  const std::string floor = facing("+z", "black", {0, 0, 0}, {6.4, 0.8, 0}, "patches 1 1 sub 8 1");
  std::uint32_t hidden = 0;
  for (std::uint32_t k = 0; k < 8; ++k) {
    hidden += 16 - visible(floor, lid("l", {0.8 * k, 0, 0}, {0.8 * k + 0.05, 0.05, 0}), k);
  }
  EXPECT_LT(hidden, 8u);
}

/// Half of its area is a square in its right angle.
TEST(GatherContacts, PointsOfATriangleAreWithinIt) {
  const std::string triangle = "tri black 0 0 0  1.6 0 0  0 1.6 0 patches 1 sub 1\n";
  EXPECT_EQ(visible(triangle, lid("l", {-0.1, -0.1, 0}, {0.8, 0.8, 0})), 8u);
}

/// Of a strip of 3 mm, narrower than 32 steps of the lattice here, points are in the middle half both ways.
TEST(GatherContacts, PointsOfAStripAreInItsMiddle) {
  const std::string far = "object far\n" + facing("-z", "black", {0, 0, 90}, {90, 90, 90});
  const std::string along_x = facing("+z", "black", {0, 0, 0}, {1.6, 0.003, 0});
  const std::string along_y = facing("+z", "black", {0, 0, 0}, {0.003, 1.6, 0});
  for (std::uint32_t k = 0; k < 16; ++k) {
    const double at = 0.4 + 0.05 * k;
    EXPECT_EQ(visible(along_x, lid("l", {at, -0.1, 0}, {1.7, 0.1, 0}) + far), k);
    EXPECT_EQ(visible(along_y, lid("l", {-0.1, at, 0}, {0.1, 1.7, 0}) + far), k);
  }
}

}  // namespace
}  // namespace shodo
