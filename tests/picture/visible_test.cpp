// Visibility of the picture against its twin: equal at every sample, or it is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "picture/drawn_scene.h"

namespace shodo {
namespace {

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::int32_t operator()(std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(engine_() % static_cast<std::uint32_t>(high - low + 1));
  }
  LatticePoint even(std::int32_t half) {
    const std::int32_t x = (*this)(-half / 2, half / 2), y = (*this)(-half / 2, half / 2);
    return {2 * x, 2 * y, 2 * (*this)(-half / 2, half / 2)};
  }

 private:
  std::mt19937 engine_;
};

void expect_twin(DrawnScene& scene, const SampleGrid& grid) {
  const std::vector<TwinHit> seen = scene.visible(grid), truth = scene.twin(grid);
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    if (seen[k] == truth[k]) continue;
    if (wrong++ == 0) {
      ADD_FAILURE() << "sample " << k % grid.columns << ", " << k / grid.columns << ": triangle " << seen[k].triangle
                    << ", twin " << truth[k].triangle;
    }
  }
  EXPECT_EQ(wrong, 0u);
}

Vec3 vector_of(const LatticePoint& p) { return {1.0 * p.x, 1.0 * p.y, 1.0 * p.z}; }

SampleGrid grid_for(const Camera& camera, std::uint32_t width, std::uint32_t height, std::uint32_t antialias = 1) {
  return sample_grid(view_of(camera, Lattice{1}, width, height), width, height, antialias);
}

TEST(VisibleLines, RandomTrianglesEqualTheTwin) {
  Random random(1);
  for (int round = 0; round < 60; ++round) {
    DrawnScene scene;
    const std::int32_t spread = round % 3 == 0 ? 40 : round % 3 == 1 ? 3000 : kLatticeHalf;
    for (int k = 0; k < 60; ++k) scene.triangle(random.even(spread), random.even(spread), random.even(spread));
    const Camera camera =
        camera_at(vector_of(random.even(spread / 2)), vector_of(random.even(spread)), 1 + random(0, 169));
    expect_twin(scene, grid_for(camera, 61, 47, round % 2 == 0 ? 1 : 4));
  }
}

// Coordinates of a few steps: eyes in planes, on sides and on vertices, equal depths and identical triangles in plenty.
TEST(VisibleLines, DegenerateTrianglesEqualTheTwin) {
  Random random(2);
  for (int round = 0; round < 300; ++round) {
    DrawnScene scene;
    for (int k = 0; k < 40; ++k) scene.triangle(random.even(6), random.even(6), random.even(6));
    const LatticePoint eye = random.even(6);
    const SampleGrid grid = plain_grid(eye, 24, 24, 1 + random(0, 2), 1 + random(0, 12));
    expect_twin(scene, grid);
  }
}

TEST(VisibleLines, PolygonsFromBehindTheEyeToTheHorizonEqualTheTwin) {
  const std::int32_t far = kLatticeHalf;
  for (const std::int32_t height : {2, 40, 3000, 400000}) {
    for (const double tilt : {0.0, 0.05, -0.3}) {
      DrawnScene scene;
      scene.quad({-far, -height, -far}, {-far, -height, far}, {far, -height, far}, {far, -height, -far});
      scene.quad({-far, height, -far}, {far, height, -far}, {far, height, far}, {-far, height, far});
      scene.triangle({-20, -height, 30}, {20, -height, 0}, {0, height, -1000});   // a corner in the eye's plane
      scene.triangle({-2000, 0, 0}, {2000, 0, 0}, {0, height, -5000});            // a side in it, the eye on the side
      scene.triangle({-2000, -height, 0}, {2000, -height, 0}, {0, height, -5000});
      expect_twin(scene, grid_for(camera_at({0, 0, 0}, {0.1, tilt, -1}, 90), 97, 83));
    }
  }
}

// n.dx is 4 of up to 2^38: such sides are crossed billions of samples beside the picture, farther with each row.
TEST(VisibleLines, SidesAlmostAlongRowsEqualTheTwin) {
  Random random(9);
  std::uint32_t mixed = 0;
  for (int round = 0; round < 60; ++round) {
    DrawnScene scene;
    for (int k = 0; k < 6; ++k) {
      // y z' - z y' = +-4, as neighbours in a Farey sequence.
      const std::int32_t step = random(1, 100), z = random(1000, 200000 / step);
      const LatticePoint a{-2 * random(100000, 200000), 2 * step, -2 * (z * step + 1)};
      const LatticePoint b{2 * random(100000, 200000), 2, -2 * z};
      scene.triangle(a, b, {random(-50, 50) * 2, random(-20000, 20000) * 2, -2 * random(100, 60000)});
    }
    const SampleGrid grid = plain_grid({0, 0, 0}, 60, 50, 1, random(50, 3000));
    expect_twin(scene, grid);
    const std::vector<TwinHit> seen = scene.visible(grid);
    for (std::size_t k = 60; k < seen.size(); ++k) mixed += seen[k].triangle != seen[k - 60].triangle ? 1 : 0;
  }
  EXPECT_GT(mixed, 1000u);  // samples that differ from the one above
}

TEST(VisibleLines, EyeOnASurfaceAndInsideABoxEqualsTheTwin) {
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    DrawnScene scene;
    scene.box({-1000, -1000, -1000}, {1000, 1000, 1000});
    scene.box({-200, -200, -700}, {200, 200, -300});
    LatticePoint eye = random.even(990);
    if (round % 2 == 0) eye.y = -1000;               // on the floor
    if (round % 4 == 0) eye.x = 1000;                // and on a wall
    if (round == 0) eye = {-1000, -1000, -1000};     // in a corner
    expect_twin(scene, grid_for(camera_at(vector_of(eye), {0, 0, -500}, 100), 80, 60));
  }
}

TEST(VisibleLines, EyeAFewStepsFromSlantedPlanesEqualsTheTwin) {
  Random random(4);
  for (int round = 0; round < 40; ++round) {
    DrawnScene scene;
    const std::int32_t half = kLatticeHalf - 2;
    for (int k = 0; k < 12; ++k) {
      // Corners far away in all directions, and the eye within a hair of the plane.
      const LatticePoint a = random.even(half), b = random.even(half);
      scene.triangle(a, b,
                     {-a.x - b.x > half || a.x + b.x > half ? 0 : 2 * ((-a.x - b.x) / 2), random(-2, 2) * 2,
                      random(-half / 2, half / 2) * 2});
      scene.triangle(a, {-a.x, -a.y, -a.z + 2 * random(-1, 1)}, b);
    }
    expect_twin(scene, grid_for(camera_at({0, 0, 0}, vector_of(random.even(100)), 60), 64, 48));
  }
}

TEST(VisibleLines, InterpenetratingBoxesEqualTheTwin) {
  Random random(5);
  for (int round = 0; round < 25; ++round) {
    DrawnScene scene;
    for (int k = 0; k < 8; ++k) {
      const LatticePoint at = random.even(600);
      scene.box(at, {at.x + 2 * random(20, 300), at.y + 2 * random(20, 300), at.z + 2 * random(20, 300)});
    }
    scene.quad({-2000, 0, -2000}, {-2000, 0, 2000}, {2000, 0, 2000}, {2000, 0, -2000});
    expect_twin(scene, grid_for(camera_at({1500, 900.0 + round, 1700}, {0, 0, 0}, 50), 120, 90, 4));
  }
}

/// Triangles by their corners: what does not depend on the order of the list.
std::vector<std::array<std::int32_t, 9>> by_corners(const DrawnScene& scene, const std::vector<TwinHit>& seen) {
  std::vector<std::array<std::int32_t, 9>> result;
  for (const TwinHit& hit : seen) {
    std::array<std::int32_t, 9> c{};
    for (std::size_t k = 0; k < 3 && hit.triangle != kNone; ++k) {
      const LatticePoint& p = scene.drawn[hit.triangle].vertex[k];
      c[3 * k] = p.x;
      c[3 * k + 1] = p.y;
      c[3 * k + 2] = p.z;
    }
    result.push_back(c);
  }
  return result;
}

TEST(VisibleLines, DoNotDependOnTheOrderOfTriangles) {
  Random random(6);
  for (int round = 0; round < 20; ++round) {
    DrawnScene scene;
    for (int k = 0; k < 30; ++k) scene.triangle(random.even(200), random.even(200), random.even(200));
    // Coplanar overlaps on a wall, in all sizes.
    for (int k = 0; k < 30; ++k) {
      LatticePoint a = random.even(200), b = random.even(200), c = random.even(200);
      a.z = b.z = c.z = -100;
      scene.triangle(a, b, c);
    }
    const SampleGrid grid = grid_for(camera_at({0, 10, 400}, {0, 0, 0}, 40), 90, 70);
    const auto seen = by_corners(scene, scene.visible(grid));
    for (int turn = 0; turn < 3; ++turn) {
      for (std::size_t k = scene.drawn.size(); k-- > 1;) {
        std::swap(scene.drawn[k], scene.drawn[static_cast<std::size_t>(random(0, static_cast<std::int32_t>(k)))]);
      }
      EXPECT_EQ(by_corners(scene, scene.visible(grid)), seen);
    }
    EXPECT_GT(scene.exact_comparisons, 0u);  // else the overlaps did not meet the exact path
  }
}

TEST(VisibleLines, ThePictureOnAWallWinsWhateverTheOrder) {
  for (const bool picture_first : {false, true}) {
    DrawnScene scene;
    const auto picture = [&] { scene.quad({-40, -30, 0}, {40, -30, 0}, {40, 30, 0}, {-40, 30, 0}); };
    if (picture_first) picture();
    scene.quad({-1000, -1000, 0}, {1000, -1000, 0}, {1000, 1000, 0}, {-1000, 1000, 0});
    if (!picture_first) picture();
    const SampleGrid grid = plain_grid({0, 0, 100}, 100, 80, 1, 100);
    const std::vector<TwinHit> seen = scene.visible(grid);
    for (std::uint32_t y = 0; y < 80; ++y) {
      for (std::uint32_t x = 0; x < 100; ++x) {
        // Samples lie at whole numbers; moved by a hair to the right and downwards they belong to [-40, 40) and (-30,
        // 30].
        const int at_x = static_cast<int>(x) - 50, at_y = 40 - static_cast<int>(y);
        const bool inside = at_x >= -40 && at_x < 40 && at_y > -30 && at_y <= 30;
        EXPECT_EQ((seen[y * 100 + x].triangle < 2) == picture_first, inside) << at_x << ' ' << at_y;
      }
    }
  }
}

TEST(VisibleLines, FrontsWinOverBacksInOnePlane) {
  DrawnScene scene;
  scene.triangle({-50, -50, 0}, {0, 50, 0}, {50, -50, 0});        // its back, and smaller
  scene.triangle({-200, -100, 0}, {200, -100, 0}, {0, 150, 0});   // its front
  const std::vector<TwinHit> seen = scene.visible(plain_grid({0, 0, 100}, 40, 40, 1, 100));
  for (const TwinHit& hit : seen) EXPECT_EQ(hit, (TwinHit{1, true}));
}

TEST(VisibleLines, BacksOfOpeningsAreNotSeen) {
  for (const bool open : {false, true}) {
    DrawnScene scene;
    scene.lights.push_back({});
    scene.lights[0].kind = LightKind::kArea;
    scene.lights[0].open = open;
    scene.triangle({-200, -100, 0}, {0, 150, 0}, {200, -100, 0});
    scene.drawn[0].light = 0;
    scene.drawn[0].mesh = kNone;
    const std::vector<TwinHit> seen = scene.visible(plain_grid({0, 0, 100}, 10, 10, 1, 100));
    for (const TwinHit& hit : seen) EXPECT_EQ(hit, (open ? TwinHit{} : TwinHit{0, false}));
  }
}

/// A square from -half to half at z = 0 in triangles: random points are inserted one by one into the triangle that
/// holds them, or into both triangles at a side that holds them. All are exactly on samples of plain_grid(eye, ...,
/// 2, ...).
std::vector<std::array<LatticePoint, 3>> random_sheet(Random& random, std::int32_t half, std::size_t least) {
  using Three = std::array<LatticePoint, 3>;
  const auto turn = [](const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    return cross(b - a, c - a).z;
  };
  std::vector<Three> sheet{{{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}}},
                           {{{-half, -half, 0}, {half, half, 0}, {-half, half, 0}}}};
  while (sheet.size() < least) {
    LatticePoint p = random.even(half);
    p.z = 0;
    const std::vector<Three> old = sheet;
    sheet.clear();
    for (const Three& t : old) {
      const bool holds = turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0;
      const bool corner = p == t[0] || p == t[1] || p == t[2];
      if (!holds || corner) {
        sheet.push_back(t);
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        if (turn(t[k], t[(k + 1) % 3], p) > 0) sheet.push_back({t[k], t[(k + 1) % 3], p});
      }
    }
  }
  return sheet;
}

TEST(VisibleLines, ASheetOfTrianglesHoldsEachSampleExactlyOnce) {
  Random random(7);
  for (const bool back : {false, true}) {
    const auto sheet = random_sheet(random, 60, 1000);
    const SampleGrid grid = plain_grid({0, 0, 120}, 70, 70, 2, 120);
    std::vector<std::uint32_t> count(std::size_t{70} * 70);
    DrawnScene scene;
    for (const auto& t : sheet) {
      // Each by itself, so that none hides behind another; half of the sheets are seen from behind.
      scene.drawn.clear();
      scene.triangle(t[0], t[back ? 2 : 1], t[back ? 1 : 2]);
      const std::vector<TwinHit> seen = scene.visible(grid);
      for (std::size_t k = 0; k < seen.size(); ++k) count[k] += seen[k].triangle == 0 ? 1 : 0;
    }
    for (std::uint32_t y = 0; y < 70; ++y) {
      for (std::uint32_t x = 0; x < 70; ++x) {
        const int at_x = 2 * (static_cast<int>(x) - 35), at_y = 2 * (35 - static_cast<int>(y));
        const bool inside = at_x >= -60 && at_x < 60 && at_y > -60 && at_y <= 60;
        EXPECT_EQ(count[y * 70 + x], inside ? 1u : 0u) << at_x << ' ' << at_y;
      }
    }
    // Together they must be the same.
    scene.drawn.clear();
    for (const auto& t : sheet) scene.triangle(t[0], t[back ? 2 : 1], t[back ? 1 : 2]);
    expect_twin(scene, grid);
  }
}

TEST(VisibleLines, AHundredThousandSubpixelQuadsCoverEachSampleOnce) {
  DrawnScene scene;
  // 320 x 320 quads of 8 x 6 steps, a pixel is 100 steps: 0.08 pixels each.
  for (std::int32_t j = 0; j < 320; ++j) {
    for (std::int32_t i = 0; i < 320; ++i) {
      const std::int32_t x = 8 * (i - 160), y = 6 * (j - 160);
      scene.quad({x, y, 0}, {x + 8, y, 0}, {x + 8, y + 6, 0}, {x, y + 6, 0});
    }
  }
  SampleGrid grid = plain_grid({0, 0, 1000}, 30, 24, 100, 1000);
  grid.d0.x += 2;  // samples at x = 2 (mod 100), y = 0: on sides of quads
  const std::vector<TwinHit> seen = scene.visible(grid);
  const PictureTwin twin(scene.scene, scene.geometry, grid);
  std::uint32_t inside = 0;
  for (std::uint32_t y = 0; y < grid.rows; ++y) {
    for (std::uint32_t x = 0; x < grid.columns; ++x) {
      const std::int32_t at_x = 100 * (static_cast<std::int32_t>(x) - 15) + 2,
                         at_y = 100 * (12 - static_cast<std::int32_t>(y));
      const TwinHit& hit = seen[y * grid.columns + x];
      const bool in = at_x >= -1280 && at_x < 1280 && at_y > -960 && at_y <= 960;
      EXPECT_EQ(hit.triangle != kNone, in);
      if (!in) continue;
      ++inside;
      // The quad that holds the sample moved by a hair to the right and downwards.
      const std::int32_t i = (at_x + 1280) / 8, j = (at_y + 960 - 1) / 6;
      EXPECT_EQ(hit.triangle / 2, static_cast<std::uint32_t>(j * 320 + i));
      if ((x * 7 + y) % 20 == 0) {
        EXPECT_EQ(twin.cover(x, y), 1u);
      }
    }
  }
  EXPECT_EQ(inside, 25u * 19u);
}

TEST(VisibleLines, HugePolygonsCoverThePictureOnce) {
  const std::int32_t far = kLatticeHalf;
  for (const std::int32_t distance : {2, 1000, far}) {
    DrawnScene scene;
    scene.quad({-far, -far, -distance}, {far, -far, -distance}, {far, far, -distance}, {-far, far, -distance});
    const double fov = distance == far ? 60 : 120;
    const SampleGrid grid = grid_for(camera_at({0, 0, 0}, {0, 0, -1}, fov), 160, 120);
    const std::vector<TwinHit> seen = scene.visible(grid);
    for (const TwinHit& hit : seen) EXPECT_NE(hit.triangle, kNone);
    expect_twin(scene, grid);
  }
}

TEST(VisibleLines, ManySpansInALineAreSortedByHeapToo) {
  Random random(8);
  DrawnScene scene;
  for (int k = 0; k < 3000; ++k) {
    const LatticePoint p = random.even(900);
    scene.triangle(p, {p.x + 2 * random(1, 60), p.y + 2 * random(-5, 5), p.z},
                   {p.x + 2 * random(-5, 40), p.y + 2 * random(1, 40), p.z});
  }
  expect_twin(scene, grid_for(camera_at({0, 0, 2000}, {0, 0, 0}, 50), 90, 60));
}

TEST(VisibleLines, TakeTheBytesThatTheySay) {
  DrawnScene scene;
  for (std::int32_t k = 0; k < 50; ++k) scene.triangle({-100, 2 * k - 50, -k}, {100, 2 * k - 50, -k}, {0, 2 * k, -k});
  scene.link();
  const SampleGrid grid = grid_for(camera_at({0, 0, 300}, {0, 0, 0}, 50), 91, 61);
  const std::uint64_t bytes = VisibleLines::bytes(scene.scene, scene.geometry, grid);
  for (const bool enough : {true, false}) {
    std::vector<std::uint64_t> memory(bytes / 8);
    Arena arena(memory.data(), enough ? bytes : bytes - 8);
    VisibleLines lines;
    EXPECT_EQ(lines.start(scene.scene, scene.geometry, grid, arena), enough);
    if (enough) {
      EXPECT_EQ(arena.used(), bytes);
    }
  }
}

}  // namespace
}  // namespace shodo
