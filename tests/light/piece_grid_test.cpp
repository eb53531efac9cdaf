// The fixed samples on a piece: where they are, what they stand for.
#include "light/piece_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/pieces.h"

namespace shodo {
namespace {

Piece triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  Piece piece = quad_piece(a, b, c, c);
  piece.corners = 3;
  return piece;
}

/// Weighted mean of a linear function and, as a check of the weights, of 1.
Vec3 mean(const PieceGrid& grid) {
  Vec3 sum;
  double weight = 0;
  for (std::uint32_t k = 0; k < grid.count(); ++k) {
    sum = sum + grid.weight(k) * grid.point(k);
    weight += grid.weight(k);
  }
  return (1 / weight) * sum;
}

void expect_near(const Vec3& a, const Vec3& b, double error) {
  EXPECT_NEAR(a.x, b.x, error);
  EXPECT_NEAR(a.y, b.y, error);
  EXPECT_NEAR(a.z, b.z, error);
}

TEST(PieceGrid, HasTheCentresOfEqualCells) {
  const Piece piece = quad_piece({0, 0, 1}, {4, 0, 1}, {4, 2, 1}, {0, 2, 1});
  const PieceGrid grid(piece, 4);
  ASSERT_EQ(grid.count(), 16u);
  expect_near(grid.point(0), {0.5, 0.25, 1}, 1e-15);
  expect_near(grid.point(6), {2.5, 0.75, 1}, 1e-15);
  for (std::uint32_t k = 0; k < 16; ++k) EXPECT_EQ(grid.weight(k), 1);
  EXPECT_EQ(grid.centre_weight(), 1);
}

TEST(PieceGrid, HasTheCentroidsOfEqualTriangles) {
  const Piece piece = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  const PieceGrid grid(piece, 4);
  ASSERT_EQ(grid.count(), 16u);
  expect_near(grid.point(0), {1.0 / 3, 1.0 / 3, 0}, 1e-15);
  expect_near(grid.point(1), {2.0 / 3, 2.0 / 3, 0}, 1e-15);  // on its tip
  expect_near(grid.point(15), {1.0 / 3, 3 + 1.0 / 3, 0}, 1e-15);
  expect_near(mean(grid), piece.centre(), 1e-14);
}

TEST(PieceGrid, NamesTheSamplesNextToTheCorners) {
  const Piece four = quad_piece({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}),
              three = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const PieceGrid square(four, 4), half(three, 4);
  for (std::uint32_t k = 0; k < 4; ++k) {
    expect_near(square.point(square.corner(k)), {k % 2 == 0 ? 0.125 : 0.875, k / 2 == 0 ? 0.125 : 0.875, 0}, 1e-15);
  }
  const Vec3 corner[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  ASSERT_EQ(half.corner_count(), 3u);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3 expected = three.centre() + 0.75 * (corner[k] - three.centre());
    expect_near(half.point(half.corner(k)), expected, 1e-15);
  }
}

TEST(PieceGrid, KeepsToTheMiddleHalfWhenAsked) {
  const Piece four = quad_piece({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}),
              three = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (const Piece& piece : {four, three}) {
    const PieceGrid wide(piece, 4), narrow(piece, 4, true);
    for (std::uint32_t k = 0; k < 16; ++k) {
      expect_near(narrow.point(k), 0.5 * (piece.centre() + wide.point(k)), 1e-15);
    }
  }
}

TEST(PieceGrid, WeightsATrapezoidByArea) {
  // The centroid of a trapezoid of sides 6 and 2 and height 3 lies 3/3 (6 + 4)/(6 + 2) from the longer one; midpoints
  // of four rows miss the second moment by 1/16.
  const Piece piece = quad_piece({-3, 0, 0}, {3, 0, 0}, {1, 3, 0}, {-1, 3, 0});
  expect_near(mean(PieceGrid(piece, 4)), {0, 1.25, 0}, 0.02);
  expect_near(mean(PieceGrid(piece, 64)), {0, 1.25, 0}, 1e-4);
  double sum = 0;
  const PieceGrid grid(piece, 4);
  for (std::uint32_t k = 0; k < 16; ++k) sum += grid.weight(k);
  EXPECT_NEAR(sum / 16, 12, 1e-12);
}

TEST(PieceGrid, WeightsTheHalvesOfAConcavePiece) {
  // Reflex at corner 1; the cut from there to corner 3 leaves halves of 1.5 and 4.5. Then the same counted from
  // corner 3.
  const Vec3 c[4] = {{-1, 2, 0}, {0, 0, 0}, {3, 2, 0}, {0, -3, 0}};
  Piece from_1_to_3 = quad_piece(c[0], c[1], c[2], c[3]), from_0_to_2 = quad_piece(c[3], c[0], c[1], c[2]);
  from_1_to_3.concave = from_1_to_3.cut = from_0_to_2.cut = true;
  const Vec3 first = (1.0 / 3) * (c[0] + c[1] + c[3]), second = (1.0 / 3) * (c[2] + c[1] + c[3]);
  for (const Piece& piece : {from_1_to_3, from_0_to_2}) {
    expect_near(mean(PieceGrid(piece, 4)), 0.25 * first + 0.75 * second, 0.1);  // the cut runs through samples
    expect_near(mean(PieceGrid(piece, 64)), 0.25 * first + 0.75 * second, 1e-3);
  }
}

double factorial(std::uint32_t n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// The mean of s^a t^b over the unit square, or over the triangle (0, 0), (1, 0), (0, 1).
double monomial_mean(std::uint32_t corners, std::uint32_t a, std::uint32_t b) {
  if (corners == 4) return 1.0 / ((a + 1) * (b + 1));
  return 2 * factorial(a) * factorial(b) / factorial(a + b + 2);
}

/// The largest degree up to which a rule is exact: in s and in t each on the square, of both together on the triangle.
std::uint32_t exact_degree(const Piece& piece, bool fine) {
  const PieceGrid grid(piece, 4);
  for (std::uint32_t degree = 0;; ++degree) {
    for (std::uint32_t a = 0; a <= degree; ++a) {
      for (std::uint32_t b = 0; b <= degree; ++b) {
        if (piece.corners == 3 && a + b > degree) continue;
        double sum = 0, weight = 0;
        for (std::uint32_t k = 0; k < (fine ? grid.fine_count() : 4); ++k) {
          const PieceGrid::Weighted at = fine ? grid.fine(k) : PieceGrid::Weighted{grid.gauss(k), 0.25};
          sum += at.weight * std::pow(at.at.s, a) * std::pow(at.at.t, b);
          weight += at.weight;
        }
        EXPECT_NEAR(weight, 1, 1e-15);
        if (std::fabs(sum - monomial_mean(piece.corners, a, b)) > 1e-15) return degree - 1;  // some roundings of 1
      }
    }
  }
}

TEST(PieceGrid, RulesAreExactToTheirDegreeAndNoFurther) {
  const Piece four = quad_piece({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}),
              three = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(exact_degree(four, false), 3u);
  EXPECT_EQ(exact_degree(four, true), 5u);
  EXPECT_EQ(exact_degree(three, false), 2u);
  EXPECT_EQ(exact_degree(three, true), 5u);
}

}  // namespace
}  // namespace shodo
