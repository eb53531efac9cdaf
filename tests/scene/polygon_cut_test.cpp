// Cutting polygons into triangles, against winding numbers in whole numbers.
#include "scene/polygon_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace shodo {
namespace {

struct Point {
  std::int64_t x = 0, y = 0;
};
using Polygon = std::vector<Point>;
using Triangles = std::vector<std::array<std::size_t, 3>>;

Triangles cut(const std::vector<Vec3>& corners) {
  std::vector<CutCorner> scratch(corners.size());
  std::vector<CutTriangle> triangles(corners.size() - 2);
  const std::uint32_t count = cut_polygon(corners, scratch, triangles);
  Triangles found;
  for (std::uint32_t k = 0; k < count; ++k) {
    found.push_back({triangles[k].corner[0], triangles[k].corner[1], triangles[k].corner[2]});
  }
  return found;
}

std::vector<Vec3> in_space(const Polygon& polygon) {
  std::vector<Vec3> corners;
  for (const Point& p : polygon) corners.push_back({static_cast<double>(p.x), static_cast<double>(p.y), 0});
  return corners;
}

std::int64_t turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::int64_t twice_area(const Polygon& polygon) {
  std::int64_t sum = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) sum += turn(polygon[0], polygon[k], polygon[k + 1]);
  return sum;
}

/// How often the polygon goes round a point that no line along an edge goes through.
int winding(const Polygon& polygon, const Point& p) {
  int count = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if (a.y <= p.y && b.y > p.y && turn(a, b, p) > 0) ++count;
    if (b.y <= p.y && a.y > p.y && turn(a, b, p) < 0) --count;
  }
  return count;
}

bool on_a_line(const Polygon& polygon, const Point& p) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (turn(polygon[k], polygon[(k + 1) % polygon.size()], p) == 0) return true;
  }
  return false;
}

/// Do two edges cross at a point inside both?
bool crosses(const Polygon& polygon) {
  const auto side = [](const Point& a, const Point& b, const Point& c) {
    const std::int64_t t = turn(a, b, c);
    return t > 0 ? 1 : t < 0 ? -1 : 0;
  };
  for (std::size_t j = 0; j < polygon.size(); ++j) {
    const Point &a = polygon[j], &b = polygon[(j + 1) % polygon.size()];
    for (std::size_t k = 0; k < j; ++k) {
      const Point &c = polygon[k], &d = polygon[k + 1];
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
    }
  }
  return false;
}

/// Triangles have an area, add up to the polygon's, and cover each of some points as often as it goes round it.
void expect_cut(const Polygon& polygon, const Triangles& triangles, std::mt19937_64& random, std::int64_t size) {
  const bool turned = twice_area(polygon) < 0;
  std::int64_t sum = 0;
  for (const auto& t : triangles) {
    const std::int64_t area = turn(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    ASSERT_TRUE(turned ? area < 0 : area > 0);
    sum += area;
  }
  ASSERT_EQ(sum, twice_area(polygon));
  for (int n = 0; n < 50; ++n) {
    const auto chance = [&] { return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(size)); };
    const Point p{chance(), chance()};
    if (on_a_line(polygon, p)) continue;
    int count = 0;
    bool between = false;
    for (const auto& t : triangles) {
      const Polygon triangle = {polygon[t[0]], polygon[t[1]], polygon[t[2]]};
      between = between || on_a_line(triangle, p);
      count += winding(triangle, p);
    }
    if (!between) {
      ASSERT_EQ(count, winding(polygon, p));
    }
  }
}

/// Round (0, 0) by ascending angle, with any distances: a star without crossings. Whole numbers within +-10^6.
Polygon star(std::mt19937_64& random, std::size_t corners) {
  Polygon polygon;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = 6.283185307179586 * static_cast<double>(k) / static_cast<double>(corners);
    const double radius = 1e5 + 9e5 * static_cast<double>(random() % 1000) / 1000;
    polygon.push_back({std::llround(1e6 + radius * std::cos(angle)), std::llround(1e6 + radius * std::sin(angle))});
  }
  return polygon;
}

TEST(PolygonCut, StarsOfAnySizeAreCutIntoTwoTrianglesLessThanTheirCorners) {
  std::mt19937_64 random(7);
  for (std::size_t corners : {5u, 6u, 7u, 9u, 20u, 100u, 333u, 1024u}) {
    for (int n = 0; n < (corners < 100 ? 100 : 3); ++n) {
      Polygon polygon = star(random, corners);
      if (n % 2 == 1) std::reverse(polygon.begin(), polygon.end());
      const Triangles triangles = cut(in_space(polygon));
      ASSERT_EQ(triangles.size(), corners - 2);
      expect_cut(polygon, triangles, random, 2000000);
    }
  }
}

// Polygons over points of a grid of 5 x 5 cross, touch themselves and turn back in every way there is.
TEST(PolygonCut, AnyPolygonIsCutAsItWindsOrRefused) {
  std::mt19937_64 random(11);
  constexpr std::int64_t kCell = 1009;  // a prime: few points that are tried lie on lines
  const auto below = [&](std::uint64_t end) { return static_cast<std::int64_t>(random() % end); };
  std::uint32_t accepted = 0, refused = 0, refused_once = 0;
  for (int n = 0; n < 60000; ++n) {
    Polygon polygon(5 + random() % 5);
    for (Point& p : polygon) p = {below(5) * kCell, below(5) * kCell};
    bool once = true, any = false;
    const int sign = twice_area(polygon) < 0 ? -1 : 1;
    for (int k = 0; once && k < 400; ++k) {
      const Point p{below(4 * kCell), below(4 * kCell)};
      if (on_a_line(polygon, p)) continue;
      const int turns = sign * winding(polygon, p);
      once = turns == 0 || turns == 1;
      any = any || turns != 0;
    }
    const Triangles triangles = cut(in_space(polygon));
    if (triangles.empty()) {
      ++refused;
      refused_once += once && any && !crosses(polygon) ? 1 : 0;
      continue;
    }
    ++accepted;
    ASSERT_TRUE(once);
    expect_cut(polygon, triangles, random, 4 * kCell);
  }
  EXPECT_GT(accepted, 10000u);
  EXPECT_GT(refused, 10000u);
  // One that goes round every point once or not at all can be cut, but for a few that run along themselves.
  EXPECT_LT(refused_once, accepted / 1000);
}

/// The triangles' areas in the polygon's own plane, which must add up.
void expect_cut_into(const std::vector<Vec3>& corners, std::size_t count, double area) {
  const Triangles triangles = cut(corners);
  ASSERT_EQ(triangles.size(), count);
  Vec3 sum;
  for (const auto& t : triangles) {
    const Vec3 twice = cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]);
    sum = sum + 0.5 * twice;
    EXPECT_GT(length(twice), 0);
  }
  EXPECT_NEAR(length(sum), area, 1e-14 * area);  // some ten roundings of an ulp, 2.2e-16
}

/// An L of three unit squares.
const Polygon kL = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

TEST(PolygonCut, TheSamePolygonInEveryPlaneFromEveryCornerAndBothWaysRound) {
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t start = 0; start < kL.size(); ++start) {
      for (const bool reversed : {false, true}) {
        std::vector<Vec3> corners;
        for (std::size_t k = 0; k < kL.size(); ++k) {
          const Point& p = kL[(start + k) % kL.size()];
          const double x = static_cast<double>(p.x), y = static_cast<double>(p.y);
          corners.push_back(axis == 0 ? Vec3{7, x, y} : axis == 1 ? Vec3{x, 7, y} : Vec3{x, y, x + y});
        }
        if (reversed) std::reverse(corners.begin(), corners.end());
        Vec3 whole, pieces;
        for (std::size_t k = 1; k + 1 < 6; ++k) {
          whole = whole + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
        }
        const Triangles triangles = cut(corners);
        ASSERT_EQ(triangles.size(), 4u);
        for (const auto& t : triangles) {
          pieces = pieces + cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]);
        }
        EXPECT_EQ(pieces, whole);  // small whole numbers: exact, and the same front
      }
    }
  }
}

TEST(PolygonCut, AnySizeAndShapeThatNumbersCanHave) {
  for (const double size : {0x1p-99, 0x1p-10, 1.0, 0x1p99}) {
    for (const double narrow : {1.0, 0x1p-40}) {
      std::vector<Vec3> corners;
      for (const Point& p : kL) {
        corners.push_back({size * narrow * static_cast<double>(p.x), 0, size * static_cast<double>(p.y)});
      }
      expect_cut_into(corners, 4, 3 * size * size * narrow);
    }
  }
}

TEST(PolygonCut, CornersOnAStraightEdgeAreCornersOfTriangles) {
  // A square with two more corners on each side: no triangle may lie along a side.
  std::vector<Vec3> corners;
  for (int k = 0; k < 12; ++k) {
    const double along = k % 3;
    corners.push_back(k < 3   ? Vec3{along, 0, 0}
                      : k < 6 ? Vec3{3, along, 0}
                      : k < 9 ? Vec3{3 - along, 3, 0}
                              : Vec3{0, 3 - along, 0});
  }
  expect_cut_into(corners, 10, 9);
}

TEST(PolygonCut, AHoleJoinedToTheRimByADoubleEdge) {
  const std::vector<Vec3> ring = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                  {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  expect_cut_into(ring, 8, 12);
}

TEST(PolygonCut, WhereItTurnsBackNothingIsLost) {
  // A unit square, from a corner of which an edge goes out and back, and one corner of which stands twice.
  expect_cut_into({{0, 0, 0}, {1, 0, 0}, {5, -3, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 1, 0}}, 2, 1);
}

TEST(PolygonCut, WhatCrossesItselfOrHasNoAreaIsRefused) {
  const std::vector<std::vector<Vec3>> wrong = {
      {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {-1, 1, 0}},              // a bow
      {{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}},           // a star in one stroke
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},    // twice round
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},               // a line
      {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},               // a point
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {0, -2, 0}, {0, 0, 0}, {-3, 0, 0}, {0, 3, 0}},
  };
  for (const std::vector<Vec3>& corners : wrong) EXPECT_TRUE(cut(corners).empty()) << corners.size();
  // Aslant, and with as much area this way round as that: what rounding leaves of the sum is along any axis.
  std::vector<Vec3> aslant;
  for (const Point& p : Polygon{{3, 6}, {2, 5}, {4, 4}, {6, 4}, {1, 5}}) {
    const double along = 0.1 * static_cast<double>(p.x);
    aslant.push_back({0.6 * along + 0.3, 0.8 * along, 0.1 * static_cast<double>(p.y)});
  }
  EXPECT_TRUE(cut(aslant).empty());
}

TEST(PolygonCut, ARoundPieceIsNotAFan) {
  // Cut into a fan, one corner of 64 would have 62 triangles; every other one cut off first, as many as rounds: 6, and
  // two for the last round's ends.
  std::vector<Vec3> corners;
  for (int k = 0; k < 64; ++k) corners.push_back({std::cos(0.09817477 * k), std::sin(0.09817477 * k), 0});
  std::vector<int> at(64);
  for (const auto& t : cut(corners)) {
    for (const std::size_t k : t) ++at[k];
  }
  EXPECT_LE(*std::max_element(at.begin(), at.end()), 2 * 6);
  EXPECT_GE(*std::min_element(at.begin(), at.end()), 1);
}

TEST(PolygonCut, SpiralsAndCombsOfTheMostCorners) {
  // A spiral's only ears are at its ends; a comb's are its teeth.
  std::mt19937_64 random(3);
  Polygon spiral, comb;
  for (int side = 0; side < 2; ++side) {
    for (int k = 0; k < 512; ++k) {
      const int step = side == 0 ? k : 511 - k;
      const double angle = 0.1 * step, radius = 1000.0 * (20 + step) + 3000.0 * side;
      spiral.push_back({std::llround(1e6 + radius * std::cos(angle)), std::llround(1e6 + radius * std::sin(angle))});
    }
  }
  for (int k = 0; k < 1022; ++k) comb.push_back({1000 * k, k % 2 == 0 ? 1000 : 1000000});
  comb.push_back({1021000, 0});
  comb.push_back({0, 0});
  for (const Polygon& polygon : {spiral, comb}) {
    const Triangles triangles = cut(in_space(polygon));
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    expect_cut(polygon, triangles, random, 2000000);
  }
}

}  // namespace
}  // namespace shodo
