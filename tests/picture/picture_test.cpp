// Display values and whole pictures of small scenes against formulas in doubles.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "picture/display.h"
#include "picture/drawn_scene.h"
#include "scene/mesh.h"

namespace shodo {
namespace {

double srgb(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

/// 8-bit sRGB of a luminance.
int level_of(const Display& display, double luminance) {
  const double v = (luminance - display.min_cd_m2) / (display.max_cd_m2 - display.min_cd_m2);
  return static_cast<int>(std::lround(255 * srgb(std::min(std::max(v, 0.0), 1.0))));
}

// Both sides of a middle between levels agree: no step lies within 1e-6 of one.
TEST(DisplayTable, IsTheSrgbFormulaAndAscends) {
  std::vector<std::uint8_t> level(kWhite + 1);
  fill_display_table(level);
  EXPECT_EQ(level[0], 0);
  EXPECT_EQ(level[kWhite], 255);
  for (std::uint32_t s = 0; s <= kWhite; ++s) {
    EXPECT_EQ(level[s], std::lround(255 * srgb(s / 8192.0))) << s;
    if (s > 0) {
      EXPECT_GE(level[s], level[s - 1]);
    }
  }
}

// The hyperbola joins the line at half of the range with the same slope, and goes to white without reaching it.
TEST(DisplaySteps, RollOffIsTheStatedCurve) {
  Display clipped{1, 101, false}, rolled{1, 101, true};
  for (int k = 0; k <= 2000; ++k) {
    const double luminance = 0.5 * k, v = (luminance - 1) / 100;
    const double shown = v <= 0 ? 0 : v <= 0.5 ? v : 1 - 1 / (4 * v);
    EXPECT_NEAR(luminance_steps(rolled, luminance), 8192 * shown, 0.5001) << luminance;
    EXPECT_NEAR(luminance_steps(clipped, luminance), std::min(8192 * std::max(v, 0.0), 65535.0), 0.5001) << luminance;
  }
  EXPECT_EQ(luminance_steps(rolled, 101), 6144);
  EXPECT_EQ(luminance_steps(rolled, 1e9), 8192);
}

TEST(DisplaySteps, RoundAndClamp) {
  EXPECT_EQ(display_steps(0), 0);
  EXPECT_EQ(display_steps(1), 8192);
  EXPECT_EQ(display_steps(-3), 0);
  EXPECT_EQ(display_steps(0.49 / 8192), 0);
  EXPECT_EQ(display_steps(0.51 / 8192), 1);
  EXPECT_EQ(display_steps(7.9999), 65535);
  EXPECT_EQ(display_steps(1e300), 65535);
  EXPECT_EQ(display_steps(std::numeric_limits<double>::infinity()), 65535);
  EXPECT_EQ(display_steps(std::numeric_limits<double>::quiet_NaN()), 0);
}

/// A wall that fills the picture, its map 4 x 3.
struct Wall : DrawnScene {
  Wall() {
    wall = mesh(4, 3);
    mapped_quad({-4000, -3000, 0}, {4000, -3000, 0}, {4000, 3000, 0}, {-4000, 3000, 0}, 4, 3, wall);
    cameras.push_back(camera_at({0, 0, 2000}, {0, 0, 0}, 60));
    options.width = 40;
    options.height = 30;
    options.antialias = 1;
    link();
  }
  void light(double lx) {
    for (float& e : direct_lx) e = static_cast<float>(lx);
  }
  std::uint32_t wall;
  Options options;
};

// One level: a step of 1/8192 can move a value that lies next to the middle between two levels.
TEST(Picture, ShowsRhoEOverPi) {
  for (const double lx : {0.0, 5.0, 20.0, 300.0, 1000.0, 1600.0, 5000.0}) {
    Wall scene;
    scene.light(0.75 * lx);
    for (float& e : scene.ambient_lx) e = static_cast<float>(0.25 * lx);
    for (const std::uint8_t c : scene.draw(scene.options)) {
      EXPECT_NEAR(c, level_of(scene.scene.display, 0.5 * lx / M_PI), 1);
    }
  }
}

TEST(Picture, ShowsThreeChannelsApart) {
  Wall scene;
  scene.scene.channels = 3;
  scene.material().diffuse = {{0.2, 0.4, 0.8}};
  scene.link();
  for (std::size_t k = 0; k < scene.direct_lx.size(); ++k) scene.direct_lx[k] = 200 + 100 * static_cast<float>(k % 3);
  const std::vector<std::uint8_t> rgb = scene.draw(scene.options);
  ASSERT_EQ(rgb.size(), 40u * 30 * 3);
  const double rho[3] = {0.2, 0.4, 0.8};
  for (std::size_t k = 0; k < rgb.size(); ++k) {
    const std::size_t c = k % 3;
    EXPECT_NEAR(rgb[k], level_of(scene.scene.display, rho[c] * (200 + 100.0 * static_cast<double>(c)) / M_PI), 1);
  }
}

TEST(Picture, AreaLightsShowTheirLuminanceInFrontAndBlackBehind) {
  for (const bool behind : {false, true}) {
    Wall scene;
    scene.drawn.clear();
    scene.lights.push_back({});
    scene.lights[0].kind = LightKind::kArea;
    scene.lights[0].strength = 100;
    scene.lights[0].colour = {{0.5, 0.5, 0.5}};
    scene.triangle({-9000, -9000, 0}, behind ? LatticePoint{0, 9000, 0} : LatticePoint{9000, -9000, 0},
                   behind ? LatticePoint{9000, -9000, 0} : LatticePoint{0, 9000, 0});
    scene.drawn[0].mesh = kNone;
    scene.drawn[0].light = 0;
    const std::vector<std::uint8_t> rgb = scene.draw(scene.options);
    EXPECT_EQ(rgb[(15 * 40 + 20) * 3], behind ? 0 : level_of(scene.scene.display, 50));
  }
}

TEST(Picture, FacesOfAPolyhedralLightShowWhatTheyEmitToo) {
  Wall scene;
  scene.lights.push_back({});
  scene.lights[0].kind = LightKind::kPolyhedron;
  scene.lights[0].strength = 40;
  scene.object().light = 0;
  scene.light(100);
  const std::vector<std::uint8_t> rgb = scene.draw(scene.options);
  EXPECT_NEAR(rgb[0], level_of(scene.scene.display, 40 + 50 / M_PI), 1);
}

TEST(Picture, BacksAndNothingAreBlack) {
  Wall scene;
  scene.light(1000);
  scene.cameras[0] = camera_at({0, 0, -2000}, {0, 0, 0}, 60);
  for (const std::uint8_t c : scene.draw(scene.options)) EXPECT_EQ(c, 0);
  scene.cameras[0] = camera_at({0, 0, 2000}, {0, 0, 4000}, 60);
  for (const std::uint8_t c : scene.draw(scene.options)) EXPECT_EQ(c, 0);
}

// The mean of the twin's columns in display steps, before sRGB; dark levels are 2.5 steps each, so rounding shows.
TEST(Picture, AntialiasingIsTheMeanOfColumns) {
  DrawnScene scene;
  scene.quad({-300, -500, 0}, {200, -500, 40}, {150, 400, 0}, {-350, 400, 0});
  scene.scene.display = {0, 100};
  scene.link();
  scene.cameras.push_back(camera_at({0, 0, 1000}, {10, 0, 0}, 60));
  Options options;
  options.width = 40;
  options.height = 30;
  std::vector<std::uint8_t> level(kWhite + 1);
  fill_display_table(level);
  const View view = view_of(scene.cameras[0], Lattice{1}, 40, 30);
  for (const std::uint32_t antialias : {1u, 4u, 16u}) {
    options.antialias = antialias;
    const SampleGrid grid = picture_grid(view, 40, 30, antialias);
    const std::vector<TwinHit> seen = scene.twin(grid);
    const std::uint32_t columns = 1u << grid.split, rows = 1u << grid.parts, whole = rows * columns;
    for (const float lx : {1.0f, 2.0f, 2.5f, 3.0f, 5.0f, 200.0f}) {
      scene.direct_lx[0] = lx;
      const std::uint32_t shown = luminance_steps(scene.scene.display, 0.5 * static_cast<double>(lx) / M_PI);
      const std::vector<std::uint8_t> rgb = scene.draw(options);
      std::uint32_t mixed = 0;
      for (std::uint32_t y = 0; y < 30; ++y) {
        for (std::uint32_t x = 0; x < 40; ++x) {
          std::uint32_t covered = 0;
          for (std::uint32_t k = 0; k < whole; ++k) {
            const TwinHit& hit = seen[(y * rows + k / columns) * grid.columns + x * columns + k % columns];
            covered += hit.triangle != kNone && hit.front ? 1 : 0;
          }
          mixed += covered > 0 && covered < whole ? 1 : 0;
          EXPECT_EQ(rgb[(y * 40 + x) * 3], level[(covered * shown + whole / 2) / whole]);
        }
      }
      EXPECT_EQ(mixed > 10, antialias > 1);
    }
  }
}

TEST(Picture, RefusesSizesBeyondSixteenThousand) {
  for (const std::uint32_t wrong : {0u, 16385u}) {
    for (const bool high : {false, true}) {
      Wall scene;
      (high ? scene.options.height : scene.options.width) = wrong;
      const Status status = draw_picture(scene.scene, scene.geometry, scene.maps, scene.options, {}, scene.arena(), {});
      EXPECT_EQ(status.code, StatusCode::kUsage);
    }
  }
}

// But those of a polygon keep theirs: the first carries the map of all (map_plane.h).
TEST(Picture, DoesNotDependOnTheOrderOfPolygons) {
  Wall scene;
  std::mt19937 random(9);
  for (float& e : scene.direct_lx) e = static_cast<float>(random() % 1500);
  for (int k = 0; k < 40; ++k) {
    const std::int32_t x = 2 * static_cast<std::int32_t>(random() % 1500) - 1500,
                       y = 2 * static_cast<std::int32_t>(random() % 1000) - 1000;
    const std::int32_t z = 2 * static_cast<std::int32_t>(random() % 3);
    scene.mapped_quad({x, y, z}, {x + 300, y, z}, {x + 300, y + 200, 0}, {x, y + 200, 0}, 4, 3, scene.wall);
  }
  scene.options.antialias = 4;
  const std::vector<std::uint8_t> rgb = scene.draw(scene.options);
  for (int turn = 0; turn < 3; ++turn) {
    for (std::size_t k = scene.drawn.size() / 2; k-- > 1;) {
      const std::size_t other = random() % (k + 1);
      std::swap(scene.drawn[2 * k], scene.drawn[2 * other]);
      std::swap(scene.drawn[2 * k + 1], scene.drawn[2 * other + 1]);
    }
    EXPECT_EQ(scene.draw(scene.options), rgb);
  }
}

// Sub-patch (1, 1) is hidden and has 0; a picture must not darken beside it.
TEST(Picture, HiddenSubPatchesDoNotDarkenTheirNeighbours) {
  Wall scene;
  scene.light(500);
  const std::uint32_t first = scene.mesh(scene.wall).first_sub_patch;
  scene.hidden.assign(scene.direct_lx.size(), 0);
  for (const std::uint32_t local : {5u, 6u, 9u}) {
    scene.hidden[first + local] = 1;
    scene.direct_lx[first + local] = 0;
  }
  scene.link();
  for (const std::uint8_t c : scene.draw(scene.options)) EXPECT_NEAR(c, level_of(scene.scene.display, 250 / M_PI), 1);
}

// A map linear over a divided triangle is linear in the square of texels, up to and on the hypotenuse.
TEST(DisplayMaps, OfATriangleKeepLinearLight) {
  DrawnScene scene;
  const std::uint32_t m = scene.mesh(6, 6);
  scene.mesh(m).kind = MeshKind::kTriangle;
  scene.scene.display = {0, 1};
  scene.link();
  const auto light = [](double u, double v) { return 100 + 150 * u + 230 * v; };
  const std::uint32_t first = scene.mesh(m).first_sub_patch;
  for (std::uint32_t s = 0; s < 36; ++s) {
    const PieceIndex at = triangle_piece(6, s);
    const double third = at.inverted ? 2.0 / 3 : 1.0 / 3;
    scene.direct_lx[first + s] = static_cast<float>(light(at.u + third, at.v + third) / 8192 * M_PI / 0.5);
  }
  DisplayMaps display;
  ASSERT_TRUE(build_display_maps(scene.scene, scene.maps, scene.arena(), display));
  for (std::uint32_t v = 0; v < 6; ++v) {
    for (std::uint32_t u = 0; u < 6 && u + v <= 6; ++u) {
      // Two roundings of pieces, or up to seven of those continued.
      EXPECT_NEAR(display.texel[first + v * 6 + u], light(u + 0.5, v + 0.5), 5) << u << ' ' << v;
    }
  }
}

TEST(DisplayMaps, OfAMeshHiddenAltogetherStayBlack) {
  Wall scene;
  scene.hidden.assign(scene.direct_lx.size(), 1);
  scene.link();
  for (const std::uint8_t c : scene.draw(scene.options)) EXPECT_EQ(c, 0);
}

TEST(Picture, NamesTheCameraThatIsMissing) {
  Wall scene;
  scene.options.camera = "side";
  const Status status = draw_picture(scene.scene, scene.geometry, scene.maps, scene.options, {}, scene.arena(), {});
  EXPECT_EQ(status.code, StatusCode::kUsage);
  EXPECT_NE(std::string_view(status.message).find("side"), std::string_view::npos) << status.message;
  scene.options.camera = "main";
  EXPECT_TRUE(draw_picture(scene.scene, scene.geometry, scene.maps, scene.options, {}, scene.arena(), {}).done());
  scene.cameras.clear();
  scene.link();
  scene.options.camera = "";
  EXPECT_EQ(draw_picture(scene.scene, scene.geometry, scene.maps, scene.options, {}, scene.arena(), {}).code,
            StatusCode::kUsage);
}

TEST(Picture, TakesTheBytesThatItSaysAndGivesThemBack) {
  for (const std::uint32_t antialias : {1u, 16u}) {
    Wall scene;
    for (std::int32_t k = 0; k < 30; ++k)
      scene.triangle({-100, 40 * k - 600, 5}, {100, 40 * k - 600, 5}, {0, 40 * k - 540, 5});
    scene.options.antialias = antialias;
    scene.link();
    const std::uint64_t bytes = picture_bytes(scene.scene, scene.geometry, scene.options);
    std::vector<std::uint64_t> memory(bytes / 8);
    for (std::uint64_t budget = bytes;; budget = budget * 7 / 8) {
      Arena arena(memory.data(), budget);
      const Status status = draw_picture(scene.scene, scene.geometry, scene.maps, scene.options, {}, arena, {});
      EXPECT_EQ(arena.used(), 0u);
      if (budget == bytes) {
        EXPECT_TRUE(status.done());
        EXPECT_EQ(arena.peak(), bytes);
      } else {
        EXPECT_EQ(status.code, StatusCode::kMemory);
      }
      if (budget < 64) break;
      if (budget == bytes) budget -= 8;
    }
  }
}

TEST(Picture, StopsWhenAsked) {
  Wall scene;
  std::uint32_t lines = 0;
  LineSink sink;
  sink.context = &lines;
  sink.line = [](void* context, std::uint32_t y, std::span<const std::uint8_t>) {
    ++*static_cast<std::uint32_t*>(context);
    return y < 4;
  };
  EXPECT_EQ(draw_picture(scene.scene, scene.geometry, scene.maps, scene.options, {}, scene.arena(), sink).code,
            StatusCode::kInterrupted);
  EXPECT_EQ(lines, 5u);
  Progress progress;
  progress.report = [](void*, Stage stage, std::uint64_t done, std::uint64_t) {
    EXPECT_EQ(stage, Stage::kPicture);
    return done < 7;
  };
  lines = 0;
  sink.line = [](void* context, std::uint32_t, std::span<const std::uint8_t>) {
    return ++*static_cast<std::uint32_t*>(context) > 0;
  };
  EXPECT_EQ(draw_picture(scene.scene, scene.geometry, scene.maps, scene.options, progress, scene.arena(), sink).code,
            StatusCode::kInterrupted);
  EXPECT_EQ(lines, 7u);
}

}  // namespace
}  // namespace shodo
