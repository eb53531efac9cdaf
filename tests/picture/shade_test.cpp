// Map coordinates against exact rationals.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "picture/drawn_scene.h"
#include "picture/map_plane.h"
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
      MapWalk walk(lines.active(span.active), scene.drawn[lines.map_of(span.triangle)], grid,
                   static_cast<std::int32_t>(y), {span.x0, span.x1, span.x0});
      std::int32_t x = span.x0;
      for (MapPiece piece; walk.next(piece); ++worst.pieces) {
        EXPECT_EQ(piece.x, x);
        for (std::int32_t k = 0; k < piece.length; ++k, ++x) {
          const auto truth = twin.map_point(span.triangle, x, y);
          const long double u = piece.u / 4096.0L + k * (piece.du / 65536.0L),
                            v = piece.v / 4096.0L + k * (piece.dv / 65536.0L);
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

// Maps so fine that their coordinates have no room in fixed point: exact, sample by sample.
TEST(MapWalk, IsExactOnMapsOfManyThousandSubPatches) {
  for (const std::int32_t texels : {32767, 32768, 65535, 300000}) {
    DrawnScene scene;
    scene.mapped_quad({-9000, -9000, -4000}, {9000, -9000, -9000}, {9000, 9000, -9000}, {-9000, 9000, -4000}, texels,
                      texels / 2);
    const Worst worst = worst_coordinates(scene, grid_for(camera_at({0, 0, 0}, {0, 0, -1}, 65), 64, 50));
    EXPECT_GT(worst.samples, 2000u);
    // Rounded down to 1/4096.
    EXPECT_LE(worst.error, texels < 32768 ? 1.0 / 16 : 1.0 / 4096) << texels;
  }
}

TEST(MapWalk, DividesSeldomWhereItMay) {
  DrawnScene scene;
  scene.mapped_quad({-9000, -9000, -4000}, {9000, -9000, -4000}, {9000, 9000, -4000}, {-9000, 9000, -4000}, 50, 50);
  const Worst worst = worst_coordinates(scene, grid_for(camera_at({0, 0, 0}, {0, 0, -1}, 65), 640, 100));
  // One piece for 128 samples of a wall seen squarely, and the remainders of two triangles a line.
  EXPECT_LT(worst.pieces, worst.samples / 128 + 3 * 100);
}

/// A parallelogram as a polygon whose sides others touch is drawn: many thin triangles, coordinates rounded to 1/256.
void fan(DrawnScene& scene, const LatticePoint& at, const LatticeVector& u, const LatticeVector& v,
         std::mt19937& random) {
  struct Corner {
    LatticePoint point;
    std::int32_t u, v;
  };
  const auto corner = [&](std::int32_t s, std::int32_t t) {  // 1/64 of the sides
    const auto even = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
      return static_cast<std::int32_t>(a + 2 * ((b * s + c * t) / 128));
    };
    return Corner{{even(at.x, u.x, v.x), even(at.y, u.y, v.y), even(at.z, u.z, v.z)}, s * 20 * 4 + s % 3, t * 30 * 4};
  };
  std::vector<Corner> ring{corner(0, 0)};
  const auto step = [&] { return 1 + static_cast<std::int32_t>(random() % 20); };
  for (std::int32_t s = step(); s < 64; s += step()) ring.push_back(corner(s, 0));
  ring.push_back(corner(64, 0));
  ring.push_back(corner(64, 64));
  ring.push_back(corner(0, 64));
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const Corner* three[3] = {&ring[0], &ring[k], &ring[k + 1]};
    if (k + 3 < ring.size()) three[0] = &ring[ring.size() - 2];  // not from a corner on the same side
    if (k + 3 == ring.size()) three[0] = &ring[ring.size() - 1], three[1] = &ring[0], three[2] = &ring[k + 1];
    const std::uint32_t t = scene.triangle(three[0]->point, three[1]->point, three[2]->point);
    for (std::size_t c = 0; c < 3; ++c) {
      scene.drawn[t].u[c] = three[c]->u;
      scene.drawn[t].v[c] = three[c]->v;
    }
  }
}

// Triangles of one plane take one map, but coordinates are right for each by its own corners. Walls square to an axis
// stay planes on the lattice; tilted ones are off by a step, and each triangle keeps its own map.
TEST(MapWalk, IsWithinASixteenthOfASubPatchWhereTrianglesShareAMap) {
  std::mt19937 random(6);
  for (const bool tilted : {false, true}) {
    std::uint32_t shared = 0, own = 0;
    for (int round = 0; round < 20; ++round) {
      DrawnScene scene;
      const std::int64_t tilt = tilted ? 1501 : 0;
      fan(scene, {-20000, -8000, -20000}, {40000, tilt, 0}, {0, 0, 30000}, random);
      fan(scene, {-20000, -8000, -20000}, {0, 20000, tilt}, {40000, 0, 3 * tilt}, random);
      const Worst worst =
          worst_coordinates(scene, grid_for(camera_at({100.0 * round, 0, 9000}, {0, -500, -9000}, 70), 100, 80));
      EXPECT_GT(worst.samples, 3000u);
      EXPECT_LE(worst.error, 1.0 / 16);
      std::vector<std::uint32_t> map_of(scene.drawn.size());
      find_map_planes(scene.drawn, map_of);
      for (std::uint32_t t = 0; t < map_of.size(); ++t) ++(map_of[t] == t ? own : shared);
    }
    EXPECT_EQ(shared > own, !tilted) << shared << ' ' << own;
  }
}

}  // namespace
}  // namespace shodo
