// Boxes of cells never part what has a direction in common.
#include <gtest/gtest.h>

#include <random>

#include "picture/lamp_frame.h"

namespace shodo {
namespace {

using Random = std::mt19937_64;

double within(Random& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

Vec3 any_vector(Random& random) {
  return {within(random, -1, 1), within(random, -1, 1), within(random, -1, 1)};
}

/// Directions about `view` at right angles to each other.
struct Axes {
  explicit Axes(const Vec3& towards)
      : view(normalised(towards)), a(normalised(cross(view, {0.3, -0.5, 0.8}))), b(cross(view, a)) {}
  Vec3 view, a, b;
  Vec3 at(double x, double y) const { return view + x * a + y * b; }
};

/// A regular polygon around `view`, counter-clockwise, its corners at random distances.
DirectionPolygon lamp_around(Random& random, const Axes& axes, double radius) {
  DirectionPolygon polygon;
  const std::uint32_t corners = 3 + random() % 8;
  for (std::uint32_t k = 0; k < corners; ++k) {
    const double angle = 6.283185307179586 * k / corners;
    polygon.push(within(random, 0.1, 10) * axes.at(radius * __builtin_cos(angle), radius * __builtin_sin(angle)));
  }
  return polygon;
}

Vec3 across(const DirectionPolygon& polygon) {
  Vec3 sum;
  for (std::uint32_t k = 0; k < polygon.count; ++k) {
    sum = sum + cross(polygon.corner[k], polygon.corner[(k + 1) % polygon.count]);
  }
  return sum;
}

TEST(LampFrame, NeverPartsAPieceFromATriangleThatMeetsIt) {
  Random random(20);
  int met = 0, apart = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Axes axes(any_vector(random));
    const double radius = within(random, 0.001, 2);
    const DirectionPolygon lamp = lamp_around(random, axes, radius);
    LampFrame frame;
    frame.start(lamp, across(lamp));
    // A piece between three points of the lamp, and a triangle anywhere, behind the eye too.
    const auto inside = [&] {
      Vec3 sum;
      for (std::uint32_t k = 0; k < lamp.count; ++k) sum = sum + within(random, 0, 1) * lamp.corner[k];
      return sum;
    };
    const Vec3 piece[3] = {inside(), inside(), inside()};
    Vec3 triangle[3];
    for (Vec3& corner : triangle) corner = axes.at(0, 0) + within(random, 0, 3 * radius) * any_vector(random);
    const bool is_apart = frame.box(piece).apart(frame.box(triangle));
    if (is_apart) ++apart;
    // u = s a + t b + r c with all of one sign: inside the triangle's cone.
    for (int sample = 0; sample < 50; ++sample) {
      const double s = within(random, 0, 1), t = within(random, 0, 1 - s);
      const Vec3 u = s * piece[0] + t * piece[1] + (1 - s - t) * piece[2];
      const double det = dot(triangle[0], cross(triangle[1], triangle[2]));
      bool in = det != 0;
      for (int k = 0; k < 3; ++k) in = in && dot(u, cross(triangle[(k + 1) % 3], triangle[(k + 2) % 3])) * det > 0;
      if (!in) continue;
      ++met;
      ASSERT_FALSE(is_apart) << trial;
      break;
    }
  }
  EXPECT_GT(met, 2000);
  EXPECT_GT(apart, 2000);
}

TEST(LampFrame, ATriangleWithACornerBehindTheEyeMeetsAll) {
  DirectionPolygon lamp;
  for (const Vec3& corner : {Vec3{-1, -1, 4}, Vec3{1, -1, 4}, Vec3{1, 1, 4}, Vec3{-1, 1, 4}}) lamp.push(corner);
  LampFrame frame;
  frame.start(lamp, across(lamp));
  const Vec3 beside[3] = {{1, 0.9, 4}, {0.9, 1, 4}, {1, 1, 0}}, at_corner[3] = {{1, 0.9, 4}, {0.9, 1, 4}, {1, 1, 4}};
  const Vec3 piece[3] = {{-1, -1, 4}, {-0.9, -1, 4}, {-1, -0.9, 4}};
  EXPECT_FALSE(frame.box(piece).apart(frame.box(beside)));
  EXPECT_TRUE(frame.box(piece).apart(frame.box(at_corner)));
}

TEST(LampFrame, ALampSeenEdgeOnHasOneCellAlongItsWidth) {
  DirectionPolygon lamp;
  for (const Vec3& corner : {Vec3{-1, 0, 4}, Vec3{1, 0, 4}, Vec3{1, 0, 5}}) lamp.push(corner);
  LampFrame frame;
  frame.start(lamp, {0, 0, 1});
  const CellBox box = frame.box({lamp.corner, 3});
  const int along = box.high[0] == box.low[0] ? 1 : 0;
  EXPECT_EQ(box.high[1 - along], box.low[1 - along]);
  EXPECT_EQ(box.low[along], 0);
  EXPECT_EQ(box.high[along], 255);
}

TEST(LampFrame, BesideALampWithACornerBesideTheEyeNothingIsApart) {
  DirectionPolygon lamp;
  for (const Vec3& corner : {Vec3{1, 0, 0}, Vec3{0, 1, 1}, Vec3{-1, 0, 1}}) lamp.push(corner);
  LampFrame frame;
  frame.start(lamp, {0, 0, 1});
  const Vec3 here[3] = {{0, 0.9, 1}, {0, 1, 1}, {-0.1, 0.9, 1}}, there[3] = {{-1, 0, 1}, {-0.9, 0, 1}, {-0.9, 0.1, 1}};
  EXPECT_FALSE(frame.box(here).apart(frame.box(there)));
}

}  // namespace
}  // namespace shodo
