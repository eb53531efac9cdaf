// Map coordinates against exact rationals, and lookups against the formula in doubles.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "picture/drawn_scene.h"
#include "picture/shade.h"

namespace shodo {
namespace {

struct Worst {
  double error = 0;          // sub-patches
  std::uint64_t samples = 0, pieces = 0;
};

/// Every visible sample's coordinates as the picture takes them.
Worst worst_coordinates(DrawnScene& scene, const SampleGrid& grid) {
  scene.link();
  const ArenaScratch scratch(scene.arena());
  VisibleLines lines;
  EXPECT_TRUE(lines.start(scene.scene, scene.geometry, grid, scene.arena()));
  const PictureTwin twin(scene.scene, scene.geometry, grid);
  Worst worst;
  for (std::uint32_t y = 0; y < grid.rows; ++y) {
    lines.begin_row(y);
    for (VisibleSpan span; lines.next(span);) {
      MapWalk walk(lines.active(span.active), scene.drawn[span.triangle], grid, static_cast<std::int32_t>(y), span.x0,
                   span.x1);
      std::int32_t x = span.x0;
      for (MapPiece piece; walk.next(piece); ++worst.pieces) {
        EXPECT_EQ(piece.x, x);
        for (std::int32_t k = 0; k < piece.length; ++k, ++x) {
          const auto truth = twin.map_point(span.triangle, x, y);
          const long double u = (piece.u + k * piece.du) / 4096.0L, v = (piece.v + k * piece.dv) / 4096.0L;
          worst.error =
              std::max(worst.error, static_cast<double>(std::max(std::fabs(u - truth[0]), std::fabs(v - truth[1]))));
          ++worst.samples;
        }
      }
      EXPECT_EQ(x, span.x1);
    }
  }
  return worst;
}

SampleGrid grid_for(const Camera& camera, std::uint32_t width, std::uint32_t height) {
  return sample_grid(view_of(camera, Lattice{1}, width, height), width, height, 1);
}

TEST(MapWalk, IsWithinASixteenthOfASubPatchUpToTheHorizon) {
  const std::int32_t far = kLatticeHalf;
  for (const std::int32_t height : {2, 60, 4000, 300000}) {
    for (const std::int32_t texels : {1, 54, 4096, 30000}) {
      DrawnScene scene;
      scene.mapped_quad({-far, -height, -far}, {-far, -height, far}, {far, -height, far}, {far, -height, -far}, texels,
                        texels);
      const Worst worst = worst_coordinates(scene, grid_for(camera_at({0, 0, 0}, {0.2, -0.1, -1}, 65), 320, 200));
      EXPECT_GT(worst.samples, 8000u);
      EXPECT_LE(worst.error, 1.0 / 16) << height << ' ' << texels;
    }
  }
}

TEST(MapWalk, IsWithinASixteenthOfASubPatchOnRandomTriangles) {
  std::mt19937 random(3);
  const auto coordinate = [&](std::int32_t half) {
    return 2 * (static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(half + 1)) - half / 2);
  };
  for (int round = 0; round < 40; ++round) {
    DrawnScene scene;
    const std::int32_t half = round % 2 == 0 ? kLatticeHalf : 200;
    for (int k = 0; k < 30; ++k) {
      const std::uint32_t t = scene.triangle({coordinate(half), coordinate(half), coordinate(half)},
                                             {coordinate(half), coordinate(half), coordinate(half)},
                                             {coordinate(half), coordinate(half), coordinate(half)});
      for (std::size_t c = 0; c < 3; ++c) {
        scene.drawn[t].u[c] = static_cast<std::int32_t>(random() % (256 * 3000));
        scene.drawn[t].v[c] = static_cast<std::int32_t>(random() % (256 * 40));
      }
    }
    const Worst worst =
        worst_coordinates(scene, grid_for(camera_at({1.0 * coordinate(half), 2, 4}, {0, 0, 0}, 90), 100, 80));
    EXPECT_LE(worst.error, 1.0 / 16);
  }
}

// The eye so near to a plane that fixed point would overflow.
TEST(MapWalk, IsWithinASixteenthOfASubPatchAHairFromThePlane) {
  const std::int32_t far = kLatticeHalf;
  DrawnScene scene;
  scene.triangle({-far, 1 - far, 3 - far}, {far, -far, far - 5}, {-7, far, 9});
  scene.drawn[0].u[1] = 256 * 50;
  scene.drawn[0].v[2] = 256 * 70;
  // The plane passes within a step of the centre of the corners.
  const Worst worst = worst_coordinates(scene, grid_for(camera_at({-2, 0, 2}, {-2, 50, 30}, 120), 100, 80));
  EXPECT_GT(worst.samples, 1000u);
  EXPECT_LE(worst.error, 1.0 / 16);
}

TEST(MapWalk, DividesSeldomWhereItMay) {
  DrawnScene scene;
  scene.mapped_quad({-9000, -9000, -4000}, {9000, -9000, -4000}, {9000, 9000, -4000}, {-9000, 9000, -4000}, 50, 50);
  const Worst worst = worst_coordinates(scene, grid_for(camera_at({0, 0, 0}, {0, 0, -1}, 65), 640, 100));
  // One piece for 32 samples of a wall seen squarely, and the remainders of two triangles a line.
  EXPECT_LT(worst.pieces, worst.samples / 32 + 3 * 100);
}

struct TestMap {
  TestMap(std::int32_t width, std::int32_t height, std::uint32_t channels, bool wraps) {
    std::mt19937 random(4);
    values.resize(static_cast<std::size_t>(width * height) * channels);
    for (auto& v : values) v = static_cast<std::uint16_t>(random() % 65536);
    texels = {values.data(), width, height, channels, wraps};
  }
  double at(double u, double v, std::uint32_t c) const {
    const auto texel = [&](int x, int y) {
      x = texels.wraps_u ? (x % texels.width + texels.width) % texels.width
                         : std::min(std::max(x, 0), texels.width - 1);
      y = std::min(std::max(y, 0), texels.height - 1);
      return double{1} * values[static_cast<std::size_t>(y * texels.width + x) * texels.channels + c];
    };
    const double x = std::floor(u - 0.5), y = std::floor(v - 0.5), s = u - 0.5 - x, t = v - 0.5 - y;
    const int ix = static_cast<int>(x), iy = static_cast<int>(y);
    return (1 - t) * ((1 - s) * texel(ix, iy) + s * texel(ix + 1, iy)) +
           t * ((1 - s) * texel(ix, iy + 1) + s * texel(ix + 1, iy + 1));
  }
  std::vector<std::uint16_t> values;
  MapTexels texels;
};

// Weights are cut to 1/256: up to 65535 / 256 an axis, and rounding 1/2.
TEST(MapTexels, AreLookedUpBilinearly) {
  for (const bool wraps : {false, true}) {
    for (const std::int32_t width : {1, 2, 7}) {
      const TestMap map(width, 3, 3, wraps);
      for (std::int32_t u = -3000; u < 4096 * width + 3000; u += 97) {
        for (std::int32_t v = -3000; v < 4096 * 3 + 3000; v += 997) {
          const double value = map_value(map.texels, u, v, 1);
          EXPECT_NEAR(value, map.at(u / 4096.0, v / 4096.0, 1), 2 * 65535.0 / 256 + 0.5);
        }
      }
      // At centres of texels the value is the texel's.
      for (std::int32_t u = 0; u < width; ++u) {
        EXPECT_EQ(map_value(map.texels, 4096 * u + 2048, 4096 + 2048, 2),
                  map.values[static_cast<std::size_t>(width + u) * 3 + 2]);
      }
    }
  }
}

TEST(MapTexels, PiecesAddWhatLookupsGiveAtMostWhite) {
  const TestMap map(9, 5, 3, false);
  const MapPiece piece{6, 23, -500, 9000, 1700, 431};
  for (const std::uint32_t shift : {0u, 1u, 2u}) {
    std::vector<std::uint32_t> sums(40 * 3, 5), expected = sums;
    add_piece(map.texels, piece, shift, sums);
    for (std::int32_t k = 0; k < piece.length; ++k) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t value = map_value(map.texels, piece.u + k * piece.du, piece.v + k * piece.dv, c);
        expected[(static_cast<std::uint32_t>(piece.x + k) >> shift) * 3 + c] += std::min(value, kWhite);
      }
    }
    EXPECT_EQ(sums, expected);
  }
}

}  // namespace
}  // namespace shodo
