// What surfaces cover along the rows of antialiased pictures, against a twin that cuts each row at exact fractions; and
// how much nearer to the truth that brings the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "picture/display.h"
#include "picture/drawn_scene.h"
#include "picture/sample_run.h"
#include "support/antialias_truth.h"
#include "support/files.h"
#include "support/solved_scene.h"
#include "support/texture_twin.h"

namespace shodo {
namespace {

/// A row of pixels: everything that may change what is seen lies at a fraction p / q of whole numbers (128 bits; only
/// the quotient is rounded, to 2^-63 of itself), and between two of them the triangle in front at their middle is seen.
class RowTwin {
 public:
  struct Piece {
    long double x0, x1;  // pixels
    std::uint32_t triangle;
    bool front;
  };

  RowTwin(const DrawnScene& scene, const SampleGrid& grid) : grid_(grid) {
    for (std::uint32_t t = 0; t < scene.drawn.size(); ++t) {
      Cone cone{t, {}, {}, 0};
      Vector v[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const LatticePoint& p = scene.drawn[t].vertex[k];
        v[k] = {Wide{p.x} - grid.eye.x, Wide{p.y} - grid.eye.y, Wide{p.z} - grid.eye.z};
      }
      for (std::size_t k = 0; k < 3; ++k) cone.side[k] = cross(v[k], v[(k + 1) % 3]);
      for (std::size_t c = 0; c < 3; ++c) cone.normal[c] = cone.side[0][c] + cone.side[1][c] + cone.side[2][c];
      cone.depth = dot(cone.normal, v[0]);
      if (cone.depth != 0) cones_.push_back(cone);
    }
  }

  std::vector<Piece> row(std::uint32_t y) const {
    const Vector start = vector_at(grid_.d0, grid_.dy, y), step = vector_at(grid_.dx, grid_.dy, 0);
    const long double width = grid_.columns >> grid_.split;
    std::vector<long double> ends{0, width};
    const auto add = [&](Wide c, Wide cx) {
      if (cx == 0) return;
      const long double x = -static_cast<long double>(c) / static_cast<long double>(cx);
      if (x > 0 && x < width) ends.push_back(x);
    };
    for (const Cone& a : cones_) {
      for (const Vector& side : a.side) add(dot(side, start), dot(side, step));
      for (const Cone& b : cones_) {
        if (&b == &a) break;
        // n_a.D / h_a = n_b.D / h_b; vertices of a few thousand steps keep that within 128 bits.
        add(dot(a.normal, start) * b.depth - dot(b.normal, start) * a.depth,
            dot(a.normal, step) * b.depth - dot(b.normal, step) * a.depth);
      }
    }
    std::sort(ends.begin(), ends.end());
    std::vector<Piece> pieces;
    for (std::size_t k = 1; k < ends.size(); ++k) {
      if (ends[k] - ends[k - 1] < 1e-12L) continue;
      const Cone* const seen = nearest(start, step, (ends[k] + ends[k - 1]) / 2);
      if (seen == nullptr) continue;
      if (!pieces.empty() && pieces.back().triangle == seen->triangle && ends[k - 1] - pieces.back().x1 < 1e-12L) {
        pieces.back().x1 = ends[k];
      } else {
        pieces.push_back({ends[k - 1], ends[k], seen->triangle, seen->depth < 0});
      }
    }
    return pieces;
  }

 private:
  __extension__ typedef __int128 Wide;
  using Vector = std::array<Wide, 3>;
  struct Cone {
    std::uint32_t triangle;
    Vector side[3], normal;
    Wide depth;
  };

  static Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Wide dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector vector_at(const LatticeVector& a, const LatticeVector& b, std::int64_t times) {
    return {Wide{a.x + times * b.x}, Wide{a.y + times * b.y}, Wide{a.z + times * b.z}};
  }

  const Cone* nearest(const Vector& start, const Vector& step, long double x) const {
    const auto at = [&](const Vector& n) {
      return static_cast<long double>(dot(n, start)) + x * static_cast<long double>(dot(n, step));
    };
    const Cone* best = nullptr;
    long double most = 0;
    for (const Cone& cone : cones_) {
      const long double sign = cone.depth > 0 ? 1 : -1;
      if (at(cone.side[0]) * sign <= 0 || at(cone.side[1]) * sign <= 0 || at(cone.side[2]) * sign <= 0) continue;
      const long double inverse_depth = at(cone.normal) / static_cast<long double>(cone.depth);
      if (best == nullptr || inverse_depth > most) best = &cone, most = inverse_depth;
    }
    return best;
  }

  SampleGrid grid_;
  std::vector<Cone> cones_;
};

/// Boxes, a floor under the eye up to the horizon, rods thinner than a pixel, and triangles through one another.
struct Jumble : DrawnScene {
  Jumble() {
    std::mt19937 random(11);
    const auto number = [&](std::int32_t low, std::int32_t high) {
      return 2 * (low / 2 + static_cast<std::int32_t>(random() % static_cast<std::uint32_t>((high - low) / 2 + 1)));
    };
    floor = mesh(6, 6);
    mapped_quad({-8000, -600, -8000}, {-8000, -600, 8000}, {8000, -600, 8000}, {8000, -600, -8000}, 6, 6, floor);
    box({-900, -600, -2600}, {-100, 300, -1900});
    box({200, -400, -2300}, {800, -350, -1200});
    for (int k = 0; k < 12; ++k) {
      const LatticePoint p{number(-1200, 1200), number(-500, 800), number(-2500, -900)};
      triangle(p, {p.x + number(4, 14), p.y, p.z},
               {p.x + number(-500, 500), p.y + number(200, 900), p.z + number(-300, 300)});
    }
    for (int k = 0; k < 10; ++k) {
      triangle({number(-1200, 1200), number(-500, 800), number(-2500, -900)},
               {number(-1200, 1200), number(-500, 800), number(-2500, -900)},
               {number(-1200, 1200), number(-500, 800), number(-2500, -900)});
    }
    scene.display = {0, 100};
    cameras.push_back(camera_at({0, 0, 0}, {0.1, -0.05, -1}, 70, {0.05, 1, 0}));
    link();
    for (std::size_t k = 0; k < direct_lx.size(); ++k) direct_lx[k] = static_cast<float>(300 + 15 * (k % 5));
    options.width = 320;
    options.height = 240;
  }
  SampleGrid grid() const {
    return picture_grid(view_of(cameras[0], Lattice{1}, options.width, options.height), options.width, options.height,
                        options.antialias);
  }
  std::uint32_t floor;
  Options options;
};

/// By pixel of a row and triangle; kNone: what sees nothing.
using Shares = std::map<std::pair<std::uint32_t, std::uint32_t>, long double>;

void add_shares(Shares& shares, long double x0, long double x1, std::uint32_t triangle) {
  for (auto pixel = static_cast<std::uint32_t>(x0); pixel < x1; ++pixel) {
    const long double from = std::max<long double>(x0, pixel), to = std::min<long double>(x1, pixel + 1);
    if (to > from) shares[{pixel, triangle}] += to - from;
  }
}

// A piece begins and ends at the first column behind the exact place: each share is right to a column a piece.
TEST(Coverage, OfEachTriangleInEachPixelsRowIsExactToAColumnAndTheSharesAddUp) {
  Jumble scene;
  for (const std::uint32_t antialias : {4u, 16u}) {
    scene.options.antialias = antialias;
    const SampleGrid grid = scene.grid();
    const RowTwin twin(scene, grid);
    const ArenaScratch scratch(scene.arena());
    VisibleLines lines;
    ASSERT_TRUE(lines.start(scene.scene, scene.geometry, grid, scene.arena()));
    std::uint64_t cut = 0, exact = 0;
    for (std::uint32_t y = 0; y < grid.rows; ++y) {
      Shares found, truth, pieces;
      std::map<std::uint32_t, std::uint32_t> whole;
      lines.begin_row(y);
      for (VisibleSpan span; lines.next(span);) {
        add_shares(found, std::ldexp(span.x0, -8), std::ldexp(span.x1, -8), span.triangle);
      }
      for (const auto& [key, share] : found) whole[key.first] += static_cast<std::uint32_t>(256 * share);
      for (const RowTwin::Piece& piece : twin.row(y)) {
        Shares one;
        add_shares(one, piece.x0, piece.x1, piece.triangle);
        for (const auto& [key, share] : one) truth[key] += share, pieces[key] += 1;
      }
      for (const auto& [key, share] : truth) {
        EXPECT_NEAR(static_cast<double>(found[key] - share), 0, static_cast<double>(pieces[key]) / 256) << y;
        cut += share < 1 ? 1 : 0;
        exact += share < 1 && found[key] > 0 ? 1 : 0;
      }
      for (const auto& [key, share] : found) {
        // Nothing that isn't there; the twin leaves out what is shorter than 10^-12 pixels.
        EXPECT_TRUE(truth.count(key) != 0 || share < 1.5L / 256) << y << ' ' << key.first << ' ' << key.second;
      }
      for (const auto& [pixel, columns] : whole) EXPECT_LE(columns, 256u);
    }
    EXPECT_GT(cut, 3000u);
    EXPECT_GT(exact, 3000u);
  }
}

// Without gaps or overlap, runs give each pixel of a row the columns that the spans have in it.
TEST(SampleRuns, WeighEachPixelsColumns) {
  std::mt19937 random(5);
  for (int round = 0; round < 2000; ++round) {
    const auto parts = static_cast<std::uint32_t>(random() % 3), width = 6u << kColumnBits;
    std::vector<std::int32_t> ends{0, static_cast<std::int32_t>(width)};
    for (auto k = random() % 9; k > 0; --k) ends.push_back(static_cast<std::int32_t>(random() % width));
    std::sort(ends.begin(), ends.end());
    std::vector<std::uint32_t> cut(6), joined(6);
    for (std::size_t k = 1; k < ends.size(); ++k) {
      if (ends[k] == ends[k - 1]) continue;
      RunWalk walk(ends[k - 1], ends[k], kColumnBits - parts);
      std::int32_t column = ends[k - 1];
      for (SampleRun run; walk.next(run);) {
        for (std::int32_t x = run.x0; x < run.x1; ++x) {
          const std::int32_t middle = column + static_cast<std::int32_t>(run.first) / 2;
          EXPECT_EQ(run.column_of(x), middle);
          column += static_cast<std::int32_t>(run.first);
          cut[static_cast<std::size_t>(x >> parts)] += run.first;
        }
      }
      EXPECT_EQ(column, ends[k]);
      const SampleRun run = pixels_of(ends[k - 1], ends[k], kColumnBits);
      EXPECT_EQ(run.column_of(run.x0), 256 * run.x0 + 128);
      const EndPixels pixels(run, 1, joined.data());
      for (std::int32_t x = run.x0; x < run.x1; ++x) joined[static_cast<std::size_t>(x)] += 256;
      pixels.weigh();
    }
    EXPECT_EQ(cut, std::vector<std::uint32_t>(6, 256));
    EXPECT_EQ(joined, cut);
  }
}

/// What a triangle shows in the middle of a piece, display steps.
double steps_at(const Jumble& scene, const DisplayMaps& maps, const PictureTwin& twin, const RowTwin::Piece& piece,
                std::uint32_t y) {
  if (!piece.front) return 0;
  const Mesh& mesh = scene.scene.meshes[scene.drawn[piece.triangle].mesh];
  const auto column = static_cast<std::int64_t>((piece.x0 + piece.x1) * 128);
  const auto at = twin.map_point(piece.triangle, column, y);
  return bilinear_twin(static_cast<double>(at[0]), static_cast<double>(at[1]), [&](std::int64_t u, std::int64_t v) {
    u = std::clamp<std::int64_t>(u, 0, mesh.map_width() - 1);
    v = std::clamp<std::int64_t>(v, 0, mesh.map_height() - 1);
    return double{1} * maps.texel[mesh.first_sub_patch + static_cast<std::size_t>(v * mesh.map_width() + u)];
  });
}

// The mean of what is seen along a pixel's rows. A pixel that is off by more than a level is dark and cut: the 1/256
// pixel of white that a piece may have too much or too little there is 1/256 of white in one of the rows.
TEST(Coverage, MakesThePictureOfTheTwinAtNineHundredAndNinetyNineOfAThousandPixels) {
  Jumble scene;
  for (const std::uint32_t antialias : {4u, 16u}) {
    scene.options.antialias = antialias;
    const SampleGrid grid = scene.grid();
    const std::vector<std::uint8_t> rgb = scene.draw(scene.options);
    const ArenaScratch scratch(scene.arena());
    DisplayMaps maps;
    ASSERT_TRUE(build_display_maps(scene.scene, scene.maps, scene.arena(), maps));
    const RowTwin twin(scene, grid);
    const PictureTwin points(scene.scene, scene.geometry, grid);
    const std::uint32_t rows = 1u << grid.parts;
    std::uint64_t off = 0, mixed = 0;
    for (std::uint32_t y = 0; y < scene.options.height; ++y) {
      std::vector<double> sum(scene.options.width), slack(scene.options.width, 1);
      for (std::uint32_t row = y * rows; row < (y + 1) * rows; ++row) {
        for (const RowTwin::Piece& piece : twin.row(row)) {
          for (auto x = static_cast<std::uint32_t>(piece.x0); x < piece.x1; ++x) {
            RowTwin::Piece here = piece;
            here.x0 = std::max<long double>(piece.x0, x), here.x1 = std::min<long double>(piece.x1, x + 1);
            if (here.x1 <= here.x0) continue;
            const double share = static_cast<double>(here.x1 - here.x0);
            const double steps = std::min(steps_at(scene, maps, points, here, row), double{kWhite});
            sum[x] += share * steps / rows;
            slack[x] += share < 1 ? steps / (256 * rows) + 0.02 * steps / rows : 0;  // and the map's slope
          }
        }
      }
      for (std::uint32_t x = 0; x < scene.options.width; ++x) {
        const double level = srgb_level(sum[x] / kWhite), found = rgb[(y * scene.options.width + x) * 3];
        mixed += slack[x] > 1 ? 1 : 0;
        if (std::fabs(found - level) <= 1) continue;
        ++off;
        EXPECT_GE(found, srgb_level(std::max(sum[x] - slack[x], 0.0) / kWhite) - 0.5) << x << ' ' << y;
        EXPECT_LE(found, srgb_level((sum[x] + slack[x]) / kWhite) + 0.5) << x << ' ' << y;
      }
    }
    RecordProperty("pixels_off_" + std::to_string(antialias), static_cast<int>(off));
    EXPECT_LE(off * 1000, std::uint64_t{scene.options.width} * scene.options.height);
    EXPECT_GT(mixed, 1000u);
  }
}

/// Root mean square of what a picture is off the truth, levels of 255.
double error_of(const std::vector<double>& truth, const std::vector<std::uint8_t>& picture) {
  double squares = 0;
  for (std::size_t k = 0; k < picture.size(); ++k) squares += std::pow(picture[k] - srgb_level(truth[k]), 2);
  return std::sqrt(squares / static_cast<double>(picture.size()));
}

// As many samples a pixel as the option's name says, each shaded by itself, were off by 4.07 and 1.55 levels, 2.73 and
// 1.02, 2.89 and 1.07 (doc/optics.md has the rooms).
TEST(Coverage, IsNearerToTheTruthThanSamples) {
  struct Case {
    const char* name;
    double by_samples[2];
  };
  for (const Case& c : {Case{"shapes", {4.065, 1.551}}, {"textures", {2.726, 1.023}}, {"glass", {2.888, 1.070}}}) {
    SCOPED_TRACE(c.name);
    FolderReader files(source_folder() + "/tests/cli/scenes");
    std::string_view text;
    ASSERT_TRUE(files.read(std::string(c.name) + ".scn", text));
    Options options;
    options.rules.blocks = true;
    options.width = 160;
    options.height = 128;
    SolvedScene solved(std::string(text), options, std::size_t{64} << 20, files.reader());
    const std::vector<double> truth = antialias_truth(*solved.model);
    ASSERT_EQ(truth.size(), 3u * 160 * 128);
    const double one = error_of(truth, antialiased(*solved.model, 1));
    const double two_rows = error_of(truth, antialiased(*solved.model, 4));
    const double four_rows = error_of(truth, antialiased(*solved.model, 16));
    EXPECT_LE(two_rows, c.by_samples[0]);
    EXPECT_LE(four_rows, c.by_samples[1]);
    EXPECT_LT(two_rows, one / 2);
    EXPECT_LT(four_rows, two_rows / 1.5);
    EXPECT_GT(four_rows, 0.3);  // the measure measures
  }
}

}  // namespace
}  // namespace shodo
