// Where the samples that look at the sun lie: everywhere equally often, and turned and mirrored with the scene.
#include "light/sample_shift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/pieces.h"

namespace shodo {
namespace {

const Lattice kLattice = lattice_for(1);

/// A square of 1/40 on the floor, whose corner is at (x, y).
Piece square(double x, double y) {
  const double e = 1.0 / 40;
  return quad_piece({x, y, 0.25}, {x + e, y, 0.25}, {x + e, y + e, 0.25}, {x, y + e, 0.25});
}

SampleShift shift_of(const Piece& piece) { return {kLattice, odd_point(kLattice, piece.centre()), piece}; }

std::vector<Vec3> samples(const Piece& piece) {
  const PieceGrid grid(piece, 4);
  const SampleShift shift = shift_of(piece);
  std::vector<Vec3> points;
  for (std::uint32_t k = 0; k < 16; ++k) points.push_back(grid.point(k, shift.in_cell(k)));
  return points;
}

bool has(const std::vector<Vec3>& points, const Vec3& point) {
  return std::any_of(points.begin(), points.end(), [&](const Vec3& p) { return length(p - point) < 1e-14; });
}

TEST(SampleShift, SamplesStayInTheirCellsAndTakeEveryEighthTwiceAlongEachEdge) {
  for (int n = 0; n < 100; ++n) {
    const SampleShift shift = shift_of(square(-0.9 + 0.0171 * n, 0.3));
    int along_s[8] = {}, along_t[8] = {};
    for (std::uint32_t k = 0; k < 16; ++k) {
      const PieceGrid::Parameter at = shift.in_cell(k);
      ASSERT_TRUE(at.s > 0 && at.s < 1 && at.t > 0 && at.t < 1);
      ++along_s[static_cast<int>(2 * (k % 4 + at.s))];
      ++along_t[static_cast<int>(2 * (k / 4 + at.t))];
    }
    for (int eighth = 0; eighth < 8; ++eighth) {
      EXPECT_EQ(along_s[eighth], 2);
      EXPECT_EQ(along_t[eighth], 2);
    }
  }
}

TEST(SampleShift, OverManySubPatchesEveryPlaceOfACellIsTakenEquallyOften) {
  // 8 x 8 parts of each of the four cells of a quarter, over 6,400 squares: 100 each, give or take 10 (one in 10,000 by
  // more than 40).
  int taken[4][8][8] = {};
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 80; ++x) {
      const SampleShift shift = shift_of(square(-1 + x / 40.0, -1 + y / 40.0));
      const std::uint32_t quarter[4] = {0, 1, 4, 5};
      for (int k = 0; k < 4; ++k) {
        const PieceGrid::Parameter at = shift.in_cell(quarter[k]);
        ++taken[k][static_cast<int>(8 * at.t)][static_cast<int>(8 * at.s)];
      }
    }
  }
  for (auto& cell : taken) {
    for (auto& row : cell) {
      for (int count : row) EXPECT_NEAR(count, 100, 50);
    }
  }
}

TEST(SampleShift, SamplesAreMirrorImagesOfEachOther) {
  const Piece piece = square(0.1, 0.2);
  const std::vector<Vec3> points = samples(piece);
  const Vec3 centre = piece.centre();
  for (const Vec3& p : points) {
    EXPECT_TRUE(has(points, {2 * centre.x - p.x, p.y, p.z}));
    EXPECT_TRUE(has(points, {p.x, 2 * centre.y - p.y, p.z}));
  }
}

TEST(SampleShift, AMirroredOrTurnedSceneHasMirroredOrTurnedSamples) {
  const auto turned = [](const Vec3& v) { return Vec3{v.z, -v.x, v.y}; };
  const auto mirrored = [](const Vec3& v) { return Vec3{-v.x, v.y, v.z}; };
  const auto swapped = [](const Vec3& v) { return Vec3{v.y, v.x, v.z}; };
  for (int n = 0; n < 20; ++n) {
    const Piece piece = square(0.031 * n, 0.0573 * (n % 7));
    const std::vector<Vec3> points = samples(piece);
    const auto expect_image = [&](auto map, bool reversed) {
      Vec3 corner[4];
      for (int k = 0; k < 4; ++k) corner[k] = map(piece.corner[reversed ? (4 - k) % 4 : k]);
      const std::vector<Vec3> images = samples(quad_piece(corner[0], corner[1], corner[2], corner[3]));
      for (const Vec3& p : points) EXPECT_TRUE(has(images, map(p)));
    };
    expect_image(turned, false);
    expect_image(mirrored, true);
    expect_image(swapped, true);
    const Piece from_elsewhere = quad_piece(piece.corner[2], piece.corner[3], piece.corner[0], piece.corner[1]);
    for (const Vec3& p : samples(from_elsewhere)) EXPECT_TRUE(has(points, p));
  }
}

TEST(SampleShift, NeighboursDiffer) {
  std::vector<double> places;
  for (int n = 0; n < 64; ++n) places.push_back(shift_of(square(0.1 + n / 80.0, 0)).in_cell(0).s);
  std::sort(places.begin(), places.end());
  const auto different = std::unique(places.begin(), places.end()) - places.begin();
  EXPECT_GT(different, 38);  // of 64 numbers among 128 some 50 differ
}

}  // namespace
}  // namespace shodo
