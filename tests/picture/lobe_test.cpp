// How much of a lobe a polygon of directions fills: against sums over many small triangles, and in pieces.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "picture/lobe.h"

namespace shodo {
namespace {

Lobe lobe_of(double exponent) {
  Lobe lobe;
  lobe.exponent = exponent;
  lobe.strength = (exponent + 2) / (2 * M_PI);
  lobe.width = 1 / std::sqrt(exponent);
  lobe.reach = lobe.ends = std::pow(2, -20 / exponent);
  return lobe;
}

/// The same by the middles of 4^8 triangles a triangle of the polygon, on its plane.
double summed(const Lobe& lobe, const Vec3& r, const Vec3& normal, const DirectionPolygon& polygon) {
  constexpr int kCuts = 256;
  double sum = 0;
  for (std::uint32_t k = 1; k + 1 < polygon.count; ++k) {
    const Vec3 a = polygon.corner[0], ab = polygon.corner[k] - a, ac = polygon.corner[k + 1] - a, n = cross(ab, ac);
    for (int i = 0; i < kCuts; ++i) {
      for (int j = 0; i + j < kCuts; ++j) {
        for (int up = 0; up < (i + j + 1 < kCuts ? 2 : 1); ++up) {
          const double s = (i + (up + 1) / 3.0) / kCuts, t = (j + (up + 1) / 3.0) / kCuts;
          const Vec3 p = a + s * ab + t * ac;
          const double d = length(p), along = dot(p, r) / d;
          if (along <= 0) continue;
          const double solid = std::abs(dot(n, p)) / (2.0 * kCuts * kCuts) / (d * d * d);
          sum += std::pow(along, lobe.exponent) * (dot(p, normal) / d) * solid;
        }
      }
    }
  }
  return lobe.strength * sum;
}

struct Case {
  DirectionPolygon polygon;
  Vec3 r, normal;
};

/// A triangle or a parallelogram in front of a plane, 1 away, and a lobe somewhere about it.
class Cases {
 public:
  Case next() {
    Case c;
    c.normal = normalised({random(-0.4, 0.4), random(-0.4, 0.4), 1});
    const double size = std::exp(random(-2.5, 0.7));
    const Vec3 corner{random(-0.5, 0.5), random(-0.5, 0.5), 1}, a{size * random(0.4, 1), size * random(-0.3, 0.3), 0},
        b{size * random(-0.3, 0.3), size * random(0.4, 1), random(-0.3, 0.3) * size};
    for (const Vec3& v : {corner, corner + a, corner + a + b, corner + b}) c.polygon.push(v);
    if (random(0, 1) < 0.3) c.polygon.count = 3;
    DirectionPolygon behind;
    EXPECT_TRUE(split(c.polygon, c.normal, behind));
    c.r = normalised(corner + random(-0.3, 1.3) * a + random(-0.3, 1.3) * b);
    return c;
  }
  double random(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }

 private:
  std::mt19937 engine_{7};
};

TEST(LobeOver, IsTheSumOverManySmallTriangles) {
  Cases cases;
  for (const double exponent : {2.0, 5.0, 10.0, 30.5, 80.0, 500.0}) {
    const Lobe lobe = lobe_of(exponent);
    for (int k = 0; k < 12; ++k) {
      const Case c = cases.next();
      // Of a lobe that is wholly filled, 1. Errors of the quadrature add up over edges.
      EXPECT_NEAR(lobe_over(lobe, c.r, c.normal, c.polygon), summed(lobe, c.r, c.normal, c.polygon), 0.002)
          << exponent << " " << k;
    }
  }
}

TEST(LobeOver, PiecesAddUpToTheWhole) {
  Cases cases;
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const Lobe lobe = lobe_of(std::exp(cases.random(0.7, 6)));
    const Case c = cases.next();
    DirectionPolygon here = c.polygon, outside;
    const Vec3 through = c.polygon.corner[0] + cases.random(0, 1) * (c.polygon.corner[2] - c.polygon.corner[0]);
    const double turn = cases.random(0, 7);
    // Some cuts go through r.
    const Vec3 side = cross(k % 3 == 0 ? c.r : through, Vec3{std::cos(turn), std::sin(turn), cases.random(-0.5, 0.5)});
    ASSERT_TRUE(split(here, side, outside));
    const double whole = lobe_over(lobe, c.r, c.normal, c.polygon);
    const double sum = lobe_over(lobe, c.r, c.normal, here) + lobe_over(lobe, c.r, c.normal, outside);
    ASSERT_NEAR(whole, sum, 0.001) << k << " " << lobe.exponent;
    worst = std::max(worst, std::abs(whole - sum));
  }
  RecordProperty("worst_millionths", static_cast<int>(1e6 * worst));
}

/// A polygon of which four corners lie in one line, as of a lamp whose faces are cut in three, to within rounding.
TEST(DirectionPolygon, ACutAlongCornersInOneLineLosesNothing) {
  const auto area = [](const DirectionPolygon& polygon) {
    Vec3 sum;
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
      sum = sum + cross(polygon.corner[k], polygon.corner[(k + 1) % polygon.count]);
    }
    return 0.5 * sum.z;
  };
  for (std::uint32_t signs = 0; signs < 16; ++signs) {
    DirectionPolygon here, outside;
    for (std::uint32_t k = 0; k < 4; ++k) here.push({1.0 * k, (signs >> k & 1) != 0 ? 1e-17 : -1e-17, 1});
    here.push({3, 2, 1});
    here.push({0, 2, 1});
    ASSERT_TRUE(split(here, {0, 1, 0}, outside));
    EXPECT_NEAR(area(here) + area(outside), 6, 1e-12) << signs;
  }
}

TEST(LobeOver, AHemisphereSendsAllOfTheLobe) {
  // Nearly: twelve sides, two degrees above the plane. The lobe about the normal has its energy k, 1 here.
  DirectionPolygon polygon;
  for (int k = 0; k < 12; ++k) {
    const double turn = M_PI / 6 * k;
    polygon.push({std::cos(turn), std::sin(turn), 0.03});
  }
  for (const double exponent : {2.0, 10.0, 80.0, 1000.0}) {
    EXPECT_NEAR(lobe_over(lobe_of(exponent), {0, 0, 1}, {0, 0, 1}, polygon), 1, 1e-3) << exponent;
  }
}

}  // namespace
}  // namespace shodo
