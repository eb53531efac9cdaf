// What sub-patches gather from close by, along long patches and beside or under what stands on them.
#include <cmath>

#include "support/closed_factors.h"
#include "tests/ambient/gathered.h"

namespace shodo {
namespace {

constexpr double kLit = 1000, kSends = 0.5 * kLit;  // of the white surfaces, rho 0.5; all others are black

std::string black_and_white() { return grey(0.5) + "material black diffuse 0\n"; }

/// Howell: a point to a parallel rectangle at distance c through its corner, then to any by signed corners.
double corner(double x, double y) {
  const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * M_PI);
}
double parallel(double x0, double x1, double y0, double y1, double c) {
  return corner(x1 / c, y1 / c) - corner(x0 / c, y1 / c) - corner(x1 / c, y0 / c) + corner(x0 / c, y0 / c);
}

/// A quad that faces the axis (+ or -) named, as `patches` by `patches` and `sub`.
std::string facing(const char* way, const std::string& material, const Vec3& a, const Vec3& b,
                   const std::string& rest = "patches 1 1 sub 1 1") {
  const int axis = way[1] - 'x', u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double low[3] = {a.x, a.y, a.z}, high[3] = {b.x, b.y, b.z};
  std::string line = "quad " + material;
  for (int k = 0; k < 4; ++k) {
    const int turn = way[0] == '+' ? k : (4 - k) % 4;
    double at[3] = {low[0], low[1], low[2]};
    if (turn == 1 || turn == 2) at[u] = high[u];
    if (turn == 2 || turn == 3) at[v] = high[v];
    for (const double value : at) line += " " + std::to_string(value);
  }
  return line + " " + rest + "\n";
}

/// What white surfaces send to sub-patches that send nothing themselves.
Gathered lit_by_white(const std::string& text) {
  const std::string all = black_and_white() + text;
  return Gathered(all, precise(), [&](const Vec3&, std::uint32_t m) {
    std::size_t at = 0;
    for (std::uint32_t k = 0; k <= m; ++k) at = all.find("quad ", at) + 5;
    return all.compare(at, 5, "white") == 0 ? kLit : 0.0;
  });
}

/// A strip of four sub-patches, 0.7 m x 6 cm each, and seven bright patches of 10 cm at `c` over the last of them,
/// 1.05 m from the strip's middle. They are close to that sub-patch, so it has the closed form between rectangles: what
/// is left is the error of this test's mean by the midpoint rule, step^2 / 24 times the second derivative. Along the
/// strip that is found from differences; across it is at most 20 / c^2 of the value.
TEST(GatherNear, AStripsSubPatchIsNotFarFromWhatIsNearItAlone) {
  for (const double c : {0.1, 0.2, 0.3}) {
    Gathered strip = lit_by_white("object strip_\n" +
                                  facing("+z", "black", {0, 0, 0}, {2.8, 0.06, 0}, "patches 1 1 sub 4 1") +
                                  "object row_\n" +
                                  facing("-z", "white", {2.1, -0.02, c}, {2.8, 0.08, c}, "patches 1 7 sub 1 1"));
    ASSERT_TRUE(strip.gather().done());
    constexpr int kAlong = 256, kAcross = 8;
    const double step = 0.7 / kAlong, across = 0.06 / kAcross;
    double column[kAlong] = {}, mean = 0, bend = 0;
    for (int a = 0; a < kAlong; ++a) {
      const double x = step * (a + 0.5);  // from where both the sub-patch and the row begin
      for (int b = 0; b < kAcross; ++b) {
        const double y = across * (b + 0.5);
        column[a] += parallel(-x, 0.7 - x, -0.02 - y, 0.08 - y, c) / kAcross;
      }
      mean += column[a] / kAlong;
    }
    for (int a = 1; a + 1 < kAlong; ++a) {
      bend = std::max(bend, std::abs(column[a - 1] - 2 * column[a] + column[a + 1]));
    }
    const double midpoint = (bend + across * across * 20 / (c * c) * mean) / 24;
    EXPECT_NEAR(static_cast<double>(strip.lx[3]), kSends * mean, kSends * (midpoint + 1e-5 * mean)) << c;
  }
}

/// G of rectangles at right angles, both with an edge on one line: all of its length `l`, or from a to b of it.
double adjacent_exchange(double l, double w, double h) { return l > 0 ? l * w * adjacent(l, w, h) : 0; }
double adjacent_exchange(double l, double a, double b, double w, double h) {
  // The parts of l beside [a, b] see it as a whole of both lengths does, less each by itself.
  const auto whole = [&](double length) { return adjacent_exchange(length, w, h); };
  return whole(b - a) + 0.5 * (whole(b) - whole(a) - whole(b - a)) + 0.5 * (whole(l - a) - whole(l - b) - whole(b - a));
}

/// Against Howell C-14: strips along the foot of a sub-patch, which its four places miss, and tiles there, which are
/// beside two of the places or between them. Both are rectangles along the axes, so that only rounding is left: that of
/// single precision, and 1e-6 of what the closed forms' terms cancel.
TEST(GatherNear, BesideAnEdgeASubPatchGetsWhatTheClosedFormSays) {
  const double length = 0.5;
  for (const double height : {0.06, 0.5}) {
    for (const double width : {0.01, 0.05, 0.5}) {
      for (const double from : {0.0, 0.085, 0.225}) {
        const double to = from > 0 ? from + 0.05 : length;
        Gathered bar = lit_by_white("object bar\n" + facing("+y", "black", {0, 0, 0}, {length, 0, height}) +
                                    "object foot\n" + facing("+z", "white", {from, 0, 0}, {to, width, 0}));
        ASSERT_TRUE(bar.gather().done());
        const double expected = kSends * adjacent_exchange(length, from, to, width, height) / (length * height);
        EXPECT_NEAR(static_cast<double>(bar.lx[0]), expected, 1e-5 * expected) << height << ' ' << width << ' ' << from;
      }
    }
  }
}

/// A black box of 2 cm without a bottom; its top may have a crack between two places along x or y.
std::string lid(const std::string& name, const Vec3& low, const Vec3& high, char along = 0, double crack_from = 0,
                double crack_to = 0) {
  const Vec3 a{low.x, low.y, 0.02}, b{high.x, high.y, 0.02};
  Vec3 to = b, from = a;
  (along == 'x' ? to.x : to.y) = along != 0 ? crack_from : to.y;
  (along == 'x' ? from.x : from.y) = crack_to;
  const std::string rest = along != 0 ? facing("+z", "black", from, b) : "";
  return "object " + name + "\n" + facing("-x", "black", low, {low.x, b.y, b.z}) +
         facing("+x", "black", {b.x, low.y, 0}, b) + facing("-y", "black", low, {b.x, low.y, b.z}) +
         facing("+y", "black", {low.x, b.y, 0}, b) + facing("+z", "black", a, to) + rest;
}

/// Half of a sub-patch of 50 cm stands under a box, whose top has a crack that lets half of the segments out to a
/// panel; the box is beyond all that the other half sees of the panel. A point in the middle of that half is in error
/// by (x^2 Fxx + y^2 Fyy) / 24, x and y its sides, and less of higher orders: twice that. What is wholly under the box
/// keeps what it has.
TEST(GatherNear, ASubPatchPartlyUnderABoxGathersWhereItIsSeen) {
  for (const char along : {'x', 'y'}) {
    // In the way from a hidden place to an end of segments, both Gauss points.
    const double place = 0.25 + 0.25 / std::sqrt(3.0), end = (along == 'x' ? -0.5 : -0.25) - 0.5 / std::sqrt(3.0);
    const double crack = place + 0.02 * (end - place);
    const Vec3 low = along == 'x' ? Vec3{0.25, -0.01, 0} : Vec3{-0.01, 0.25, 0};
    const std::string box = lid("box", low, {1.01, 1.01, 0}, along, crack - 0.005, crack + 0.005);
    Gathered floor = lit_by_white("object floor_\n" +
                                  facing("+z", "black", {0, 0, 0}, {1, 1, 0}, "patches 1 1 sub 2 2") + box +
                                  "object panel_\n" + facing("-z", "white", {-1, -0.75, 1}, {0, 0.25, 1}));
    const std::size_t under = along == 'x' ? 1 : 2;
    floor.lx[under] = 7;
    ASSERT_TRUE(floor.gather().done());
    const double x = along == 'x' ? 0.25 : 0.5, y = 0.75 - x;
    const auto at = [](double px, double py) { return parallel(-1 - px, -px, -0.75 - py, 0.25 - py, 1); };
    constexpr int kSide = 64;
    double mean = 0;
    for (int k = 0; k < kSide * kSide; ++k) {
      mean += at(x * (k % kSide + 0.5) / kSide, y * (k / kSide + 0.5) / kSide) / (kSide * kSide);
    }
    const double centre = at(x / 2, y / 2);
    // A second difference over half sides is a quarter of the side's square times the derivative.
    const double bend = (std::abs(at(0, y / 2) - 2 * centre + at(x, y / 2)) +
                         std::abs(at(x / 2, 0) - 2 * centre + at(x / 2, y))) * 4 / 24;
    EXPECT_NEAR(static_cast<double>(floor.lx[0]), kSends * mean, 2 * kSends * bend) << along;
    EXPECT_EQ(floor.lx[under], 7) << along;
  }
}

/// A point to a rectangle at right angles, length by height, from its foot c away; the point is `beside` from one end.
double square(double length, double height, double c, double beside) {
  const double root = std::sqrt(height * height + c * c);
  const auto half = [&](double a) { return (std::atan(a / c) - c / root * std::atan(a / root)) / (2 * M_PI); };
  return half(beside) + half(length - beside);
}

/// The same beside a wall, where a half and where a quarter of the sub-patch is seen, against Howell C-14. Four places
/// of a grid of 4 x 4, if they are spread over what is seen, do as well as all: a midpoint rule of that pitch. Its
/// error is of second order, so 4/3 of what half the pitch changes; twice that change is allowed.
TEST(GatherNear, ASubPatchPartlyUnderABoxGathersBesideAWall) {
  const double side = 0.5, height = 0.3, across = 0.25;
  for (const double depth : {0.5, 0.25}) {
    const std::string boxes = lid("box", {-0.01, across, 0}, {side, side + 0.01, 0}) +
                              (depth < side ? lid("another", {-0.01, -0.01, 0}, {0.25, 0.249, 0}) : "");
    Gathered floor = lit_by_white("object floor_\n" + facing("+z", "black", {0, 0, 0}, {side, side, 0}) +
                                  boxes + "object wall\n" +
                                  facing("-x", "white", {side, 0, 0}, {side, across, height}));
    ASSERT_TRUE(floor.gather().done());
    const auto rule = [&](double pitch) {
      double sum = 0, count = 0;
      for (double z = pitch / 2; z < depth; z += pitch) {
        for (double y = pitch / 2; y < across; y += pitch, ++count) sum += square(across, height, z, y);
      }
      return sum / count;
    };
    const double expected = kSends * adjacent(across, depth, height);
    const double unsure = 2 * kSends * std::abs(rule(side / 4) - rule(side / 8));
    EXPECT_NEAR(rule(side / 64), adjacent(across, depth, height), unsure / kSends / 64);  // both formulae
    EXPECT_NEAR(static_cast<double>(floor.lx[0]), expected, unsure) << depth;
  }
}

}  // namespace
}  // namespace shodo
