// Mirrors, glass, highlights and the background against a slow ray caster (support/optics_twin.h): one display step.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "picture/view.h"
#include "support/collected_lines.h"
#include "support/optics_twin.h"
#include "support/picture_stage.h"
#include "support/kept_scene.h"
#include "support/smooth_light.h"
#include "visibility/geometry.h"

namespace shodo {
namespace {

/// A room, 4 x 3 x 4, that one looks into from its middle; lit by made-up maps, so that only the picture is tested.
const std::string kRoom =
    "shodo 1\n"
    "display 1 250\n"
    "camera main eye 2.3 1.6 3.4 look 1.7 1.1 0 up 0 1 0 fov 70\n"
    "material wall diffuse 0.7 0.6 0.5\n"
    "material grey diffuse 0.5\n"
    "material mirror diffuse 0.05 reflect 0.9\n"
    "material chrome diffuse 0.10 reflect 0.70\n"
    "material gold diffuse 0.2 reflect 0.7 0.5 0.2\n"
    "material glass diffuse 0.02 transmit 0.85\n"
    "material red diffuse 0.02 transmit 0.9 0.1 0.1\n"
    "material blue diffuse 0.1 reflect 0.1 transmit 0.05 0.2 0.7\n"
    "material lacquer diffuse 0.40 0.05 0.05 highlight 0.3 80\n"
    "material satin diffuse 0.3 highlight 0.4 6\n"
    "object room\n"
    "quad wall 0 0 0  0 0 4  4 0 4  4 0 0  patches 4 4 sub 1 1\n"
    "quad wall 0 3 0  4 3 0  4 3 4  0 3 4  patches 4 4 sub 1 1\n"
    "quad wall 0 0 0  0 3 0  0 3 4  0 0 4  patches 4 4 sub 1 1\n"
    "quad wall 4 0 0  4 0 4  4 3 4  4 3 0  patches 4 4 sub 1 1\n"
    "quad wall 0 0 4  0 3 4  4 3 4  4 0 4  patches 4 4 sub 1 1\n";
const std::string kBackWall = "quad grey 0 0 0  4 0 0  4 3 0  0 3 0  patches 4 4 sub 1 1\n";

struct Outcome {
  std::size_t pixels = 0, off = 0, unexplained = 0;
  std::vector<std::uint8_t> rgb;
};

class OpticsScene {
 public:
  OpticsScene(const std::string& text, const Options& options, const TestFiles& files = {})
      : options_(options), loaded_(text, options, files), light_(loaded_.scene, 250, 20, 0.7) {
    // The light is gentle, since the scanline's map coordinates are right to 1/16 sub-patch only.
    EXPECT_TRUE(place_scene(loaded_.scene, loaded_.arena, geometry_).done());
  }

  std::vector<std::uint8_t> draw() {
    std::vector<std::uint8_t> rgb;
    const LineSink sink = collected_in(rgb);
    const std::size_t before = loaded_.arena.used();
    EXPECT_TRUE(draw_picture(loaded_.scene, geometry_, light_.maps(), options_, {}, loaded_.arena, sink).done());
    EXPECT_EQ(loaded_.arena.used(), before);
    return rgb;
  }

  /// A pixel that is off is explained if its samples, moved by up to a hundredth of their distance, show both values
  /// or what is between: it lies on an edge, where rounded directions and points decide otherwise.
  Outcome compare() {
    Outcome outcome;
    outcome.rgb = draw();
    const View view = view_of(loaded_.scene.cameras[0], geometry_.lattice, options_.width, options_.height);
    const SampleGrid grid = picture_grid(view, options_.width, options_.height, options_.antialias);
    const OpticsTwin twin(loaded_.scene, geometry_, light_.maps(), grid);
    for (std::uint32_t y = 0; y < options_.height; ++y) {
      for (std::uint32_t x = 0; x < options_.width; ++x) {
        const std::uint8_t* const found = &outcome.rgb[3 * (std::size_t{y} * options_.width + x)];
        ++outcome.pixels;
        if (agrees(found, twin.level(x, y))) continue;
        ++outcome.off;
        if (!explained(twin, found, x, y)) ++outcome.unexplained;
      }
    }
    return outcome;
  }

  SmoothLight& light() { return light_; }
  Scene& scene() { return loaded_.scene; }
  Geometry& geometry() { return geometry_; }

 private:
  static bool agrees(const std::uint8_t* found, const std::array<int, 3>& level) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::abs(found[c] - level[c]) > 1) return false;
    }
    return true;
  }
  static bool explained(const OpticsTwin& twin, const std::uint8_t* found, std::uint32_t x, std::uint32_t y) {
    int low[3] = {255, 255, 255}, high[3] = {0, 0, 0};
    for (const double dx : {-0.01, 0.0, 0.01}) {
      for (const double dy : {-0.01, 0.0, 0.01}) {
        const std::array<int, 3> level = twin.level(x, y, dx, dy);
        for (std::size_t c = 0; c < 3; ++c) low[c] = std::min(low[c], level[c]), high[c] = std::max(high[c], level[c]);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      if (found[c] < low[c] - 1 || found[c] > high[c] + 1) return false;
    }
    return true;
  }

  Options options_;
  KeptScene loaded_;
  Geometry geometry_;
  SmoothLight light_;
};

Options small(std::uint32_t width = 160, std::uint32_t height = 120, std::uint32_t antialias = 1) {
  Options options;
  options.width = width;
  options.height = height;
  options.antialias = antialias;
  return options;
}

void expect_as_twin(const std::string& text, const Options& options = small(), const TestFiles& files = {}) {
  OpticsScene scene(text, options, files);
  const Outcome outcome = scene.compare();
  testing::Test::RecordProperty("pixels_off", static_cast<int>(outcome.off));  // of the last scene
  EXPECT_LE(outcome.off * 1000, outcome.pixels) << outcome.off << " of " << outcome.pixels;
  EXPECT_EQ(outcome.unexplained, 0u);
}

TEST(PictureOptics, PlaneMirrorsShowWhatARayCasterSees) {
  expect_as_twin(kRoom + kBackWall +
                 "object m\nquad mirror 0.5 0.5 0.1  2.5 0.5 0.3  2.5 2.5 0.3  0.5 2.5 0.1\n"
                 "quad chrome 3.9 0.2 0.5  3.7 0.2 3.0  3.7 2.0 3.0  3.9 2.0 0.5\n"
                 "object box\nquad grey 1 0 1.5  1 0 2  1 0.8 2  1 0.8 1.5\nquad grey 2 0 2 2 0 1.5 2 0.8 1.5 2 0.8 2\n"
                 "quad grey 1 0 2 2 0 2 2 0.8 2 1 0.8 2\nquad gold 1 0.8 1.5 1 0.8 2 2 0.8 2 2 0.8 1.5\n");
}

TEST(PictureOptics, MirrorsFacingEachOtherReflectUpToTheStatedDepth) {
  expect_as_twin(kRoom + kBackWall +
                 "object m\nquad mirror 0.1 0.3 0.2  0.1 2.7 0.2  0.1 2.7 3.8  0.1 0.3 3.8\n"
                 "quad mirror 3.9 0.3 3.8  3.9 2.7 3.8  3.9 2.7 0.2  3.9 0.3 0.2\n");
}

TEST(PictureOptics, FacetedMirrorsReflectFacetByFacet) {
  std::string lower, upper;
  for (int k = 0; k <= 12; ++k) {
    const double a = 2 * M_PI * (k % 12) / 12, x = 1.8 + 0.7 * std::cos(a), z = 1.4 - 0.7 * std::sin(a);
    lower += " " + std::to_string(x) + " 0.2 " + std::to_string(z);
    upper += " " + std::to_string(x) + " 2.2 " + std::to_string(z);
  }
  expect_as_twin(kRoom + kBackWall + "object column\ngrid chrome 13 2" + upper + lower + "\n");
}

TEST(PictureOptics, PanesThatOverlapAndCrossAreCompositedInDepthOrder) {
  expect_as_twin(kRoom + kBackWall +
                 "object panes\nquad glass 0.5 0.2 1.0  2.5 0.2 0.6  2.5 2.2 0.6  0.5 2.2 1.0\n"
                 "quad red 1.0 0.1 0.4  2.2 0.1 1.6  2.2 1.9 1.6  1.0 1.9 0.4\n"
                 "quad blue 1.5 0.3 1.5  3.2 0.3 0.5  3.0 2.0 0.6  1.4 2.4 1.4\n"
                 "quad red 3.2 0.3 2.0  1.5 0.3 1.9  1.5 1.0 1.9  3.2 1.0 2.0\n");
}

TEST(PictureOptics, APaneOfManyTrianglesCountsOnceOnItsSeams) {
  // The camera looks square at the pane, so that columns and rows of samples lie on its seams; all show the wall by
  // 0.85 and nothing else.
  std::string pane = "object pane\n";
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const std::string x0 = std::to_string(0.5 * i - 1), x1 = std::to_string(0.5 * i - 0.5),
                        y0 = std::to_string(0.5 * j - 1), y1 = std::to_string(0.5 * j - 0.5);
      pane += "quad clear " + x0 + " " + y0 + " 0  " + x1 + " " + y0 + " 0  " + x1 + " " + y1 + " 0  " + x0 + " " + y1 +
              " 0  patches 1 1 sub 1 1\n";
    }
  }
  const std::string text =
      "shodo 1\ndisplay 0 100\ncamera main eye 0 0 2 look 0 0 0 up 0 1 0 fov 40\n"
      "material clear diffuse 0 transmit 0.85\nmaterial m diffuse 0.5\n"
      "object wall\nquad m -4 -4 -1  4 -4 -1  4 4 -1  -4 4 -1  patches 1 1 sub 1 1\n" + pane;
  OpticsScene scene(text, small(64, 64));
  const std::vector<std::uint8_t> rgb = scene.draw();
  for (const std::uint8_t level : rgb) EXPECT_EQ(level, rgb[0]);
  EXPECT_GT(rgb[0], 0);
}

TEST(PictureOptics, HighlightsOfAllKindsOfLights) {
  const std::string block =
      "object top\nquad lacquer 0.8 0.6 0.8  0.8 0.6 2.6  3.2 0.6 2.6  3.2 0.6 0.8\n"
      "object rest\nquad satin 0.3 0.1 0.1  3.7 0.1 0.1  3.7 2.9 0.1  0.3 2.9 0.1\n"
      "object bar\nquad grey 1.5 1.2 1.0  1.7 1.2 1.0  1.7 1.3 1.0  1.5 1.3 1.0\n"
      "quad red 2.4 1.1 0.6  2.9 1.1 0.6  2.9 1.8 0.6  2.4 1.8 0.6\n";
  expect_as_twin(kRoom + kBackWall + block + "light p point at 1.5 2.5 0.5 intensity 200\n"
                 "light q point at 2.8 2.7 1.5 towards 0 -1 0 intensity 300 cosine 3 colour 1 0.5 0.2\n");
  expect_as_twin(kRoom + block + "light s sun towards 0.2 -0.5 0.8 illuminance 2000\n");
  expect_as_twin(kRoom + kBackWall + block + "light a area quad 1 2.5 0.6  2.2 2.5 0.6  2.2 2.5 1.2  1 2.5 1.2 "
                 "luminance 3000\n", small(64, 48));
  expect_as_twin(kRoom + kBackWall + block +
                 "object lamp\nquad grey 1.6 2.2 0.8  1.9 2.2 0.8  1.9 2.2 1.1  1.6 2.2 1.1\n"
                 "quad grey 1.6 2.2 1.1  1.6 2.5 1.1  1.9 2.5 1.1  1.9 2.2 1.1\n"
                 "quad grey 1.6 2.2 0.8  1.6 2.5 0.8  1.9 2.5 0.8  1.9 2.2 0.8\n"
                 "light l polyhedron object lamp luminance 2500\n", small(64, 48));
}

/// A box whose faces all shine.
std::string shining_box(double x0, double y0, double z0, double x1, double y1, double z1) {
  const auto quad = [](std::initializer_list<double> c) {
    std::string line = "quad grey";
    for (const double value : c) line += " " + std::to_string(value);
    return line + " patches 1 1 sub 1 1\n";
  };
  return "object lamp\n" + quad({x0, y0, z0, x1, y0, z0, x1, y0, z1, x0, y0, z1}) +
         quad({x0, y1, z0, x0, y1, z1, x1, y1, z1, x1, y1, z0}) +
         quad({x0, y0, z0, x0, y1, z0, x1, y1, z0, x1, y0, z0}) +
         quad({x0, y0, z1, x1, y0, z1, x1, y1, z1, x0, y1, z1}) +
         quad({x0, y0, z0, x0, y0, z1, x0, y1, z1, x0, y1, z0}) +
         quad({x1, y0, z0, x1, y1, z0, x1, y1, z1, x1, y0, z1}) + "light l polyhedron object lamp luminance 2500\n";
}

const std::string kGlossy = "object top\nquad lacquer 0.8 0.6 0.8  0.8 0.6 2.6  3.2 0.6 2.6  3.2 0.6 0.8\n"
                            "object rest\nquad satin 0.3 0.1 0.1  3.7 0.1 0.1  3.7 2.9 0.1  0.3 2.9 0.1\n";

TEST(PictureOptics, HighlightsOfClosedLampsByTheirOutline) {
  // A bar and panes that cross before it, and a sheet that ends within it.
  expect_as_twin(kRoom + kBackWall + kGlossy +
                 "object bar\nquad grey 1.5 1.2 1.0  1.7 1.2 1.0  1.7 1.3 1.0  1.5 1.3 1.0\n"
                 "quad red 1.9 1.1 0.6  2.4 1.1 0.6  2.4 1.8 0.6  1.9 1.8 0.6\n"
                 "quad glass 2.2 1.2 0.3  2.2 1.2 0.9  2.2 1.9 0.9  2.2 1.9 0.3\n" +
                 shining_box(1.6, 1.9, 0.5, 2.0, 2.2, 0.9), small(64, 48));
  expect_as_twin(kRoom + kBackWall + kGlossy +
                 "object sheet\nquad grey 1.7 1.5 1.0  2.6 1.5 1.0  2.6 2.25 1.0  1.7 2.25 1.0\n"
                 "quad grey 2.6 1.5 1.0  1.7 1.5 1.0  1.7 2.25 1.0  2.6 2.25 1.0\n" +
                 shining_box(1.6, 2.1, 0.8, 2.0, 2.4, 1.2), small(64, 48));
}

TEST(PictureOptics, HighlightsPastMoreThanHasRoomAreSummedOverPoints) {
  // 200 slats, 400 triangles, close below an area light: half of it shows between them.
  std::string slats = "object slats\n";
  for (int k = 0; k < 200; ++k) {
    const std::string z0 = std::to_string(0.25 + 0.0035 * k), z1 = std::to_string(0.25175 + 0.0035 * k);
    slats += "quad grey 1.3 1.8 " + z0 + "  2.3 1.8 " + z0 + "  2.3 1.8 " + z1 + "  1.3 1.8 " + z1 +
             "  patches 1 1 sub 1 1\n";
  }
  OpticsScene scene(kRoom + kBackWall + kGlossy + slats +
                    "light a area quad 1.4 1.9 0.3  2.2 1.9 0.3  2.2 1.9 0.9  1.4 1.9 0.9 luminance 2500\n",
                    small(24, 18));
  const Outcome outcome = scene.compare();
  // 610 points on 400 edges: shadows are noisy by a few levels, and right in the mean.
  RecordProperty("pixels_off", static_cast<int>(outcome.off));
  EXPECT_LE(outcome.off * 25, outcome.pixels) << outcome.off << " of " << outcome.pixels;
}

/// Waves of three colours, so that neither edges nor a single level hide a wrong place or a wrong filter.
std::string waves() {
  std::string text = "P6 64 64 255\n";
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double wave = std::sin(2 * M_PI * (x * (c + 1) + 2 * y) / 64) * std::cos(2 * M_PI * (y + c) / 32);
        text += static_cast<char>(static_cast<unsigned char>(150 + 60 * wave));
      }
    }
  }
  return text;
}

const std::string kPatterned =
    "material tiles diffuse 0.35 0.3 0.25 texture w.ppm size 0.7 0.9\n"
    "material sign diffuse 0.3 texture w.ppm\n"
    "material inlay diffuse 0.25 reflect 0.3 highlight 0.2 30 texture w.ppm size 0.5 0.5\n"
    "material etched diffuse 0.1 transmit 0.5 texture w.ppm size 0.6 0.6\n"
    "object patterned\nquad tiles 0 0.01 0  0 0.01 4  4 0.01 4  4 0.01 0  patches 4 4 sub 1 1\n"
    "quad sign 0.4 0.5 3.9  0.4 2.5 3.9  3.6 2.5 3.9  3.6 0.5 3.9  patches 4 4 sub 1 1\n";

TEST(PictureOptics, TexturesShowInMirrorsThroughPanesAndOnWhatMirrorsItself) {
  const TestFiles files{{"w.ppm", waves()}};
  expect_as_twin(kRoom + kBackWall + kPatterned +
                 "object m\nquad mirror 0.5 0.5 0.1  2.5 0.5 0.3  2.5 2.5 0.3  0.5 2.5 0.1\n"
                 "quad chrome 3.9 0.2 0.5  3.7 0.2 3.0  3.7 2.0 3.0  3.9 2.0 0.5\n", small(), files);
  expect_as_twin(kRoom + kBackWall + kPatterned +
                 "object m\nquad mirror 0.1 0.3 0.2  0.1 2.7 0.2  0.1 2.7 3.8  0.1 0.3 3.8\n"
                 "quad mirror 3.9 0.3 3.8  3.9 2.7 3.8  3.9 2.7 0.2  3.9 0.3 0.2\n", small(), files);
  expect_as_twin(kRoom + kBackWall + kPatterned +
                 "object panes\nquad glass 0.5 0.2 1.0  2.5 0.2 0.6  2.5 2.2 0.6  0.5 2.2 1.0\n"
                 "quad etched 1.0 0.1 0.4  2.2 0.1 1.6  2.2 1.9 1.6  1.0 1.9 0.4\n"
                 "quad blue 1.5 0.3 1.5  3.2 0.3 0.5  3.0 2.0 0.6  1.4 2.4 1.4\n", small(), files);
  expect_as_twin(kRoom + kBackWall + kPatterned +
                 "object top\nquad inlay 0.8 0.6 0.8  0.8 0.6 2.6  3.2 0.6 2.6  3.2 0.6 0.8\n"
                 "light p point at 1.5 2.5 0.5 intensity 200\n", small(120, 90, 4), files);
}

TEST(PictureOptics, ATexturedLampShinesInMirrors) {
  // Its pattern is of what it reflects; what it emits is even.
  expect_as_twin(kRoom + kBackWall + kPatterned +
                 "object m\nquad mirror 0.5 0.5 0.1  2.5 0.5 0.3  2.5 2.5 0.3  0.5 2.5 0.1\n"
                 "object lamp\nquad sign 1.2 1.5 3.5  1.2 2.2 3.5  2.4 2.2 3.5  2.4 1.5 3.5\n"
                 "light l polyhedron object lamp luminance 60\n", small(), {{"w.ppm", waves()}});
}

/// Rods of 2 to 8 mm in all directions, less than a sample wide: samples between two that see none of them may.
TEST(PictureOptics, NothingThinIsMissedBetweenTracedSamples) {
  std::string rods = "object rods\n";
  std::uint32_t seed = 1;
  const auto random = [&](double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (seed >> 8) / 16777216.0;
  };
  const auto point = [](double x, double y, double z) {
    return " " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z);
  };
  for (int k = 0; k < 40; ++k) {
    const double x = random(0.5, 3.5), y = random(0.3, 2.7), z = random(1.5, 3.0), w = random(0.002, 0.008);
    const double dx = random(-0.5, 0.5), dy = random(-0.5, 0.5), dz = random(-0.5, 0.5);
    // A strip, and one behind it that is seen from the other side.
    rods += "quad grey" + point(x, y, z) + point(x + w, y, z) + point(x + w + dx, y + dy, z + dz) +
            point(x + dx, y + dy, z + dz) + " patches 1 1 sub 1 1\n";
    const double back = z - 0.01;
    rods += "quad grey" + point(x + w, y, back) + point(x, y, back) + point(x + dx, y + dy, back + dz) +
            point(x + w + dx, y + dy, back + dz) + " patches 1 1 sub 1 1\n";
  }
  expect_as_twin(kRoom + rods + "object m\nquad mirror 0 0 0  4 0 0.1  4 3 0.1  0 3 0 patches 1 1\n"
                 "quad glass 0.2 0.2 1.2  2.2 0.2 1.2  2.2 2.2 1.2  0.2 2.2 1.2\n");
}

TEST(PictureOptics, OfTwoPolygonsInOnePlaneAMirrorShowsTheSameInAnyOrder) {
  const std::string mirror = "object m\nquad mirror 0.2 0.2 0.1  3.8 0.2 0.1  3.8 2.8 0.1  0.2 2.8 0.1\n";
  const std::string wide = "object wide\nquad wall 1 0.5 3.5  1 2.5 3.5  3 2.5 3.5  3 0.5 3.5\n";
  const std::string small_one = "object small\nquad gold 1.5 1 3.5  1.5 2 3.5  2.5 2 3.5  2.5 1 3.5\n";
  const auto drawn = [](const std::string& text) {
    OpticsScene scene(kRoom + text, small(80, 60));
    scene.light().fill(300);
    return scene.draw();
  };
  EXPECT_EQ(drawn(mirror + wide + small_one), drawn(mirror + small_one + wide));
  EXPECT_NE(drawn(mirror + wide + small_one), drawn(mirror + wide)) << "the smaller one is seen";
}

TEST(PictureOptics, HighlightsOfAFaceAreThoseOfItsTriangles) {
  // A parallelogram, and a quadrilateral with a corner inwards, against the two triangles that make them.
  const auto drawn = [](const std::string& lamp) {
    OpticsScene scene(kRoom + kBackWall +
                      "object top\nquad lacquer 0.8 0.6 0.8  0.8 0.6 2.6  3.2 0.6 2.6  3.2 0.6 0.8\n"
                      "object lamp\n" + lamp + "light l polyhedron object lamp luminance 2500\n", small(64, 48));
    return scene.draw();
  };
  for (const auto& [quad, halves] :
       {std::pair{"quad grey 1.6 2.2 0.8  1.9 2.2 0.8  1.9 2.2 1.1  1.6 2.2 1.1\n",
                  "tri grey 1.6 2.2 0.8  1.9 2.2 0.8  1.9 2.2 1.1\ntri grey 1.6 2.2 0.8  1.9 2.2 1.1  1.6 2.2 1.1\n"},
        {"quad grey 1.2 2.2 0.6  2.2 2.2 0.6  1.5 2.2 0.9  1.2 2.2 1.6\n",
         "tri grey 1.2 2.2 0.6  2.2 2.2 0.6  1.5 2.2 0.9\ntri grey 1.2 2.2 0.6  1.5 2.2 0.9  1.2 2.2 1.6\n"}}) {
    const std::vector<std::uint8_t> whole = drawn(quad), parts = drawn(halves);
    int off = 0, most = 0;
    for (std::size_t k = 0; k < whole.size(); ++k) {
      const int apart = std::abs(whole[k] - parts[k]);
      off += apart > 1 ? 1 : 0;
      most = std::max(most, apart);
    }
    // Other points of the face: what they share out is the same to the error of the quadrature.
    EXPECT_LT(off * 50, static_cast<int>(whole.size())) << most;
    EXPECT_LT(most, 12);
  }
}

TEST(PictureOptics, BrightnessRollsOffAfterAllIsAdded) {
  std::string text = kRoom;
  text.replace(text.find("display 1 250"), 13, "display 4 60 roll");
  expect_as_twin(text + "background zenith 20 50 120 horizon 150 160 180 ground 60 50 30\n"
                 "object m\nquad mirror 0.5 0.5 0.1  2.5 0.5 0.3  2.5 2.5 0.3  0.5 2.5 0.1\n"
                 "quad glass 1.5 0.5 1  3.5 0.5 1  3.5 2.5 1  1.5 2.5 1\n"
                 "light l area quad 2.2 2.9 1  3 2.9 1  3 2.9 1.6  2.2 2.9 1.6 luminance 500\n", small(120, 90, 4));
}

TEST(PictureOptics, TheBackgroundIsSeenByDirectionThroughOpeningsToo) {
  expect_as_twin(kRoom + "background zenith 20 50 120 horizon 150 160 180 ground 60 50 30 up 0.1 1 0.2\n"
                 "object pane\nquad red 0.5 0.5 0.5 2 0.5 0.5 2 2.5 0.5 0.5 2.5 0.5\n"
                 "quad mirror 3.9 0.3 3.8  3.9 2.7 3.8  3.9 2.7 0.2  3.9 0.3 0.2\n"
                 "light w area quad 1 1 0.2  1 2 0.2  3 2 0.2  3 1 0.2 luminance 500 open\n", small(120, 90, 4));
}

TEST(PictureOptics, APlainBackgroundIsSeenByDirectionAtWideAnglesToo) {
  // A picture 170 degrees high, its horizon askew: brightness bends between samples that are many degrees apart.
  for (const auto& [width, height] : {std::pair{64u, 48u}, {64u, 8u}, {33u, 24u}}) {
    expect_as_twin("shodo 1\ndisplay 0 200\ncamera main eye 0 1 5 look 0.2 1.1 0 up 0.3 1 0 fov 170\n"
                   "background zenith 20 50 120 horizon 150 160 180 ground 60 50 30\n"
                   "material grey diffuse 0.5\n"
                   "object o\nquad grey -1 0 -2  1 0 -2  1 2 -2  -1 2 -2 patches 1 1\n",
                   small(width, height));
  }
}

TEST(PictureOptics, BetweenSamplesNothingIsMissedWhereDirectionsAreShort) {
  // 16,384 pixels in one row: those in the middle have directions of 46,000 where others have 2^20.
  expect_as_twin("shodo 1\ndisplay 0 200\ncamera main eye 0 1 5 look 0 1 0 up 0 1 0 fov 20\n"
                 "background zenith 150 horizon 150 ground 150\n"
                 "material grey diffuse 0.5\nmaterial glass diffuse 0.02 transmit 0.85\n"
                 "object pane\nquad glass -50 -20 4.5  50 -20 4.5  50 20 4.5  -50 20 4.5 patches 1 1\n"
                 "object posts\nquad grey -88 -20 -40  -56 -20 -40  -56 18 -40  -88 18 -40 patches 1 1\n"
                 "quad grey 44 -20 -40  88 -20 -40  88 18 -40  44 18 -40 patches 1 1\n",
                 small(16384, 1));
}

/// Highlights as far as they go: only those of the lamp, behind the camera, are light here.
std::vector<std::uint8_t> lit_by(const std::string& light) {
  const std::string lamp = "light l area quad 1 2.8 3.5  3 2.8 3.5  3 2.8 3.9  1 2.8 3.9 ";
  OpticsScene scene(kRoom + kBackWall + kGlossy + lamp + light + "\n", small(64, 48));
  scene.light().fill(0);
  return scene.draw();
}

TEST(PictureOptics, HighlightsEndByWhatArrivesOfALampNotByItsLuminanceAlone) {
  const std::vector<std::uint8_t> plain = lit_by("luminance 3000");
  EXPECT_NE(plain, lit_by("luminance 300"));
  EXPECT_EQ(plain, lit_by("luminance 0.03 colour 100000 100000 100000"));
  // Attenuation is rounded: a level.
  const std::vector<std::uint8_t> attenuated = lit_by("luminance 0.03 attenuation 0 0 0.00001");
  for (std::size_t k = 0; k < plain.size(); ++k) ASSERT_NEAR(plain[k], attenuated[k], 1) << k / 3;
}

}  // namespace
}  // namespace shodo
