// The contour integral against the closed forms of references.md and against a sum over the hemisphere, which knows
// nothing of contours.
#include "light/polygon_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <vector>

namespace shodo {
namespace {

using Polygon = std::vector<Vec3>;

double factor(const Vec3& point, const Vec3& normal, const Polygon& polygon) {
  return point_to_polygon(point, normal, polygon.data(), static_cast<std::uint32_t>(polygon.size()));
}

const Vec3 kUp{0, 0, 1};

/// Fronts down, towards the points below; corners from (x0, y0) to (x1, y1) at height z.
Polygon ceiling(double x0, double y0, double x1, double y1, double z) {
  return {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}};
}

double parallel_corner(double x, double y) {
  const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * M_PI);
}

double perpendicular_corner(double a, double b, double c) {
  const double s = std::sqrt(b * b + c * c);
  return (std::atan(a / c) - c / s * std::atan(a / s)) / (2 * M_PI);
}

/// The obvious twin: midpoints of n x n equal parts of the cosine-weighted hemisphere (rings of equal projected area),
/// each looking along its direction for the polygon.
double sum_over_hemisphere(const Vec3& point, const Vec3& n, const Polygon& polygon, int parts) {
  const Vec3 helper = std::fabs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 s = normalised(cross(helper, n)), t = cross(n, s);
  const Vec3 front = cross(polygon[1] - polygon[0], polygon[2] - polygon[0]);
  int hits = 0;
  for (int i = 0; i < parts; ++i) {
    const double sine = std::sqrt((i + 0.5) / parts);
    for (int j = 0; j < 4 * parts; ++j) {
      const double angle = 2 * M_PI * (j + 0.5) / (4 * parts);
      const Vec3 d = sine * std::cos(angle) * s + sine * std::sin(angle) * t + std::sqrt(1 - sine * sine) * n;
      const double along = dot(front, d);
      if (along >= 0) continue;
      const double distance = dot(front, polygon[0] - point) / along;
      if (distance <= 0) continue;
      const Vec3 hit = point + distance * d;
      bool inside = true;
      for (std::size_t k = 0; k < polygon.size() && inside; ++k) {
        const Vec3& a = polygon[k];
        const Vec3& b = polygon[(k + 1) % polygon.size()];
        inside = dot(cross(b - a, hit - a), front) >= 0;
      }
      hits += inside;
    }
  }
  return static_cast<double>(hits) / (4.0 * parts * parts);
}

TEST(PolygonFactor, OfAParallelRectangleIsTheClosedForm) {
  for (const double x : {0.01, 0.3, 1.0, 4.0, 300.0}) {
    for (const double y : {0.02, 1.0, 50.0}) {
      EXPECT_NEAR(factor({0, 0, 0}, kUp, ceiling(0, 0, 2.5 * x, 2.5 * y, 2.5)), parallel_corner(x, y), 1e-12);
    }
  }
}

TEST(PolygonFactor, OfAPerpendicularRectangleIsTheClosedForm) {
  // The rectangle stands on the element's plane at distance c, a wide and b high, and the element looks along the
  // plane's normal: its lower edge lies on the horizon.
  for (const double a : {0.1, 1.0, 30.0}) {
    for (const double b : {0.2, 1.0, 10.0}) {
      for (const double c : {0.05, 1.0, 7.0}) {
        const Polygon wall{{c, 0, 0}, {c, 0, b}, {c, a, b}, {c, a, 0}};  // faces -x
        EXPECT_NEAR(factor({0, 0, 0}, kUp, wall), perpendicular_corner(a, b, c), 1e-12) << a << " " << b << " " << c;
      }
    }
  }
}

TEST(PolygonFactor, BelowTheHorizonChangesNothing) {
  for (const double depth : {1e-9, 0.3, 1.0, 1000.0}) {
    const Polygon wall{{1, 0, -depth}, {1, 0, 1}, {1, 2, 1}, {1, 2, -depth}};
    EXPECT_NEAR(factor({0, 0, 0}, kUp, wall), perpendicular_corner(2, 1, 1), 1e-12);
    // A triangle that the horizon cuts to a triangle: twice as wide and deep.
    const Polygon tall{{1, -1 - depth, -depth}, {1, 0, 1}, {1, 1 + depth, -depth}};
    const Polygon cut{{1, -1, 0}, {1, 0, 1}, {1, 1, 0}};
    EXPECT_NEAR(factor({0, 0, 0}, kUp, tall), factor({0, 0, 0}, kUp, cut), 1e-12);
  }
}

TEST(PolygonFactor, OfTurnedPolygonsIsTheSumOverTheHemisphere) {
  const Polygon shapes[] = {
      {{0.4, -0.3, 0.9}, {0.2, 0.8, 0.7}, {1.1, 0.9, 0.1}},                      // all above
      {{0.5, -0.6, -0.7}, {0.5, -0.6, 0.9}, {0.5, 0.9, 0.9}, {0.5, 0.9, -0.7}},  // cut through two sides
      {{0.4, -1.2, -0.2}, {0.4, 0.1, 1.1}, {0.4, 1.4, -0.2}, {0.4, 0.1, -1.5}},  // on its tip
      {{0.6, 0.5, -0.4}, {0.6, -0.9, -0.1}, {0.6, 0.1, 0.8}},                    // one corner above
      {{-2, -2, 0.05}, {-2, 2, 0.05}, {2, 2, 0.05}, {2, -2, 0.05}},              // a lid, nearly all of it
  };
  for (const Polygon& shape : shapes) {
    for (const Vec3& way : {Vec3{0, 0, 1}, Vec3{1, 2, 3}, Vec3{3, -1, 0.5}}) {
      const Vec3 n = normalised(way);
      // A contour along the horizon may be off by half a ring, 1/1200; across rings errors cancel to some 1e-4.
      EXPECT_NEAR(factor({0, 0, 0}, n, shape), sum_over_hemisphere({0, 0, 0}, n, shape, 600), 1e-3);
    }
  }
}

TEST(PolygonFactor, OfPartsAddsUp) {
  const Vec3 n = normalised({0.3, -0.2, 0.8}), p{0.1, 0.2, 0.3};
  double sum = 0;
  for (int k = 0; k < 10; ++k) sum += factor(p, n, ceiling(-4 + k, -3, -3 + k, 5, 1.3));
  EXPECT_NEAR(factor(p, n, ceiling(-4, -3, 6, 5, 1.3)), sum, 1e-14);
}

TEST(PolygonFactor, OfASmallFarPolygonKeepsItsDigits) {
  // cos cos A / (pi d^2), the relative error of which is about (e/d)^2.
  for (const double d : {1e3, 1e4, 1e5}) {
    const double expected = 1 / (M_PI * d * d);
    EXPECT_NEAR(factor({0, 0, 0}, kUp, ceiling(-0.5, -0.5, 0.5, 0.5, d)) / expected, 1, 1 / (d * d) + 4e-16 * d);
  }
}

TEST(PolygonFactor, OfASmallFarPolygonAsideKeepsItsDigits) {
  // No symmetry in which roundings might cancel: cos cos A / (pi d^2) at the middle of a parallelogram.
  for (const double d : {1e4, 1e5}) {
    const Vec3 middle = d * Vec3{0.6, 0.48, 0.64}, s{-0.8, 0.3, 0.1}, t{0.11, 0.7, -0.73};
    const Vec3 front = cross(s, t);
    const Polygon shape{middle - s - t, middle + s - t, middle + s + t, middle - s + t};
    const double expected = 4 * -dot(front, middle) / d * 0.64 / (M_PI * d * d);
    ASSERT_GT(expected, 0);
    EXPECT_NEAR(factor({0, 0, 0}, kUp, shape) / expected, 1, 4 / (d * d) + 4e-16 * d) << d;
  }
}

TEST(PolygonFactor, OfAQuadrilateralWithACornerTwiceIsThatOfTheTriangle) {
  const Vec3 a{0.4, -0.3, 0.9}, b{0.2, 0.8, 0.7}, c{1.1, 0.9, 0.1}, n = normalised({1, 0.3, 0.4});
  const double expected = factor({0, 0, 0}, n, {a, b, c});
  EXPECT_NEAR(factor({0, 0, 0}, n, {a, b, c, c}), expected, 1e-15);
  EXPECT_NEAR(factor({0, 0, 0}, n, {a, a, b, c}), expected, 1e-15);
}

TEST(PolygonFactor, OfAConcavePolygonIsThatOfItsTriangles) {
  const Polygon turned{{0, 0, 1}, {2, 2, 1}, {0, -2, 1}, {-2, 2, 1}};  // an arrowhead, fronts down
  const Polygon arrow{{0, 0, 1}, {-2, 2, 1}, {0, -2, 1}, {2, 2, 1}};   // the same, fronts up
  const Polygon left{{0, 0, 1}, {0, -2, 1}, {-2, 2, 1}}, right{{0, 0, 1}, {2, 2, 1}, {0, -2, 1}};
  for (const Vec3& way : {Vec3{0, 0, 1}, Vec3{0, 3, 1}, Vec3{2, 1, 0.2}, Vec3{1, 0, 0}}) {
    const Vec3 n = normalised(way), p{0.1, 0.5, 0.2};
    EXPECT_NEAR(factor(p, n, turned), factor(p, n, left) + factor(p, n, right), 1e-14);
    EXPECT_EQ(factor(p, n, arrow), 0);
  }
}

TEST(PolygonFactor, FromBehindOrBeneathIsExactlyZero) {
  const Polygon lid = ceiling(-1, -1, 1, 1, 1);
  EXPECT_EQ(factor({0, 0, 2}, kUp, lid), 0);         // behind, looking away
  EXPECT_EQ(factor({0, 0, 2}, {0, 0, -1}, lid), 0);  // behind, looking at its back
  EXPECT_EQ(factor({0, 0, 0}, {0, 0, -1}, lid), 0);  // in front, looking away
  EXPECT_EQ(factor({5, 0, 1}, kUp, lid), 0);         // in its plane
  EXPECT_EQ(factor({5, 0, 1}, {-1, 0, 0}, lid), 0);  // in its plane, looking at its edge
}

TEST(PolygonFactor, OfALightInThePatchsOwnPlaneIsZeroHoweverItIsTurned) {
  // Points on and beside the polygon, in its plane up to rounding, looking where it looks.
  const Vec3 s = normalised({1, 2, 3}), t = normalised(cross(s, {0.3, -0.7, 0.1})), n = cross(s, t);
  const Vec3 origin{1.7, -0.3, 2.9};
  const auto at = [&](double x, double y) { return origin + x * s + y * t; };
  const Polygon light{at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)};
  for (int i = -7; i <= 7; ++i) {
    for (int j = -7; j <= 7; ++j) {
      EXPECT_EQ(factor(at(0.31 * i, 0.29 * j), n, light), 0);
      EXPECT_EQ(factor(at(0.31 * i, 0.29 * j), -n, light), 0);
    }
  }
}

TEST(PolygonFactor, IsFiniteOnThePolygonItsEdgesAndItsCorners) {
  const Polygon lid = ceiling(-1, -1, 1, 1, 0.5);
  for (const double x : {-1.0, -0.5, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.25, 1.0}) {
      for (const double below : {0.0, 1e-300, 1e-17, 1e-9, 1e-3}) {
        for (const Vec3& n : {kUp, Vec3{1, 0, 0}, Vec3{0, -1, 0}, -kUp}) {
          const double f = factor({x, y, 0.5 - below}, n, lid);
          EXPECT_TRUE(f >= 0 && f <= 1) << x << " " << y << " " << below;
        }
      }
    }
  }
  EXPECT_NEAR(factor({0, 0, 0.5 - 1e-6}, kUp, lid), 1, 1e-11);
}

TEST(PolygonFactor, DoesNotDependOnScale) {
  for (const double k : {0x1p-60, 0x1p-10, 0x1p40}) {
    const Polygon small{{0.4 * k, -1.2 * k, -0.2 * k}, {0.4 * k, 0.1 * k, 1.1 * k}, {0.4 * k, 1.4 * k, -0.2 * k}};
    const Polygon plain{{0.4, -1.2, -0.2}, {0.4, 0.1, 1.1}, {0.4, 1.4, -0.2}};
    EXPECT_EQ(factor({0, 0, 0}, kUp, small), factor({0, 0, 0}, kUp, plain));
  }
}

}  // namespace
}  // namespace shodo
