// Pictures and tables for people who measure: scale, letters, lines, statistics, differences.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "cli/lettering.h"
#include "cli/lux_scale.h"
#include "cli/program.h"
#include "cli/surface_lux.h"
#include "cli/value_grid.h"
#include "support/solved_scene.h"

namespace shodo {
namespace {

double linear(std::uint8_t code) {
  const double s = code / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

/// The lightness of OKLab (Ottosson 2020).
double lightness(const Rgb8& colour) {
  const double r = linear(colour[0]), g = linear(colour[1]), b = linear(colour[2]);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

TEST(LuxScale, LightnessRisesEvenlyFromEndToEnd) {
  for (int k = 0; k <= 16; ++k) {
    EXPECT_NEAR(lightness(scale_colour(k / 16.0)), 0.28 + 0.66 * k / 16, 0.004) << k;  // codes of 8 bits
  }
  for (int k = 1; k <= 256; ++k) {
    EXPECT_GT(lightness(scale_colour(k / 256.0)), lightness(scale_colour((k - 1) / 256.0)) - 0.001) << k;
  }
}

// Machado, Oliveira and Fernandes 2009, severity 1: what the three kinds of dichromats see of a colour, linear RGB.
TEST(LuxScale, KeepsItsOrderWithAnyColourBlindness) {
  const double seen_by[3][9] = {
      {0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998},
      {0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881},
      {1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900}};
  for (const auto& m : seen_by) {
    double before = -1;
    for (int k = 0; k <= 16; ++k) {
      const Rgb8 c = scale_colour(k / 16.0);
      const double rgb[3] = {linear(c[0]), linear(c[1]), linear(c[2])};
      double luminance = 0;
      const double weight[3] = {0.2126, 0.7152, 0.0722};
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) luminance += weight[i] * m[3 * i + j] * rgb[j];
      }
      EXPECT_GT(luminance, before) << k;
      before = luminance;
    }
  }
}

TEST(LuxScale, IsLogarithmicOrLinearFromNothing) {
  const LuxScale scale{10, 1000}, linear_scale{0, 500};
  EXPECT_EQ(scale.place(3), 0);
  EXPECT_NEAR(scale.place(100), 0.5, 1e-15);
  EXPECT_EQ(scale.place(5000), 1);
  EXPECT_EQ(linear_scale.place(125), 0.25);
  EXPECT_EQ(linear_scale.place(0), 0);
}

TEST(LuxScale, RoundLevelsAreThoseOfTheStandardAndNotTooMany) {
  EXPECT_EQ(round_levels(30, 750), (std::vector<double>{30, 50, 75, 100, 150, 200, 300, 500, 750}));
  EXPECT_EQ(round_levels(0.1, 1), (std::vector<double>{0.1, 0.15, 0.2, 0.3, 0.5, 0.75, 1}));
  EXPECT_EQ(round_levels(1, 10000), (std::vector<double>{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000}));
  EXPECT_EQ(round_levels(0.01, 1e6), (std::vector<double>{0.01, 0.1, 1, 10, 100, 1000, 1e4, 1e5, 1e6}));
}

TEST(LuxScale, FindsRoundEndsForWhatIsSeen) {
  std::vector<float> lux;
  for (int k = 0; k < 1000; ++k) lux.push_back(40 + 0.4f * static_cast<float>(k));
  lux.push_back(0);     // dark: has no logarithm
  lux.push_back(9000);  // one of a thousand: beyond the scale
  EXPECT_EQ(scale_for(lux).low, 30);
  EXPECT_EQ(scale_for(lux).high, 500);
  EXPECT_EQ(scale_for({}).high, 1000);
  EXPECT_LT(scale_for({5, 5, 5}).low, scale_for({5, 5, 5}).high);
}

TEST(Lettering, DrawsItsPointsAndNothingElse) {
  Canvas canvas{8, 9, std::vector<std::uint8_t>(3 * 8 * 9)};
  draw_text(canvas, 1, 1, "7", 1, {255, 255, 255});
  std::string drawn;
  for (std::size_t k = 0; k < 72; ++k) drawn += canvas.rgb[3 * k] != 0 ? '#' : '.';
  EXPECT_EQ(drawn,
            "........"
            ".#####.."
            ".....#.."
            "....#..."
            "...#...."
            "..#....."
            "..#....."
            "..#....."
            "........");
  EXPECT_EQ(text_width("750", 2), 2u * 17);
  draw_text(canvas, -20, 100, "750", 3, {255, 255, 255});  // outside: no harm
}

const std::string kHead = "shodo 1\nmaterial black diffuse 0\nmaterial grey diffuse 0.5\n";

TEST(SurfaceLux, IsLinearBetweenCentresAndLeavesHiddenOnesOut) {
  SolvedScene scene(kHead + "object o\nquad grey 0 0 0  4 0 0  4 3 0  0 3 0 patches 2 3 sub 2 1\n");
  std::vector<float> lux(12), nothing(12);
  std::vector<std::uint8_t> hidden(12);
  for (std::uint32_t k = 0; k < 12; ++k) lux[k] = static_cast<float>(10 + 3 * (k % 4) + 5 * (k / 4));
  scene.model->maps.direct_lx = lux;
  scene.model->maps.ambient_lx = nothing;
  scene.model->maps.hidden = hidden;
  const auto at = [&](double u, double v) {
    return surface_lux(*scene.model, 0, static_cast<std::int32_t>(4096 * u), static_cast<std::int32_t>(4096 * v));
  };
  EXPECT_EQ(at(0.5, 0.5), 10);
  EXPECT_EQ(at(1.75, 1.25), 10 + 3 * 1.25 + 5 * 0.75);
  EXPECT_EQ(at(0, 0), 10);            // beyond the outer centres: as at them
  EXPECT_EQ(at(4, 3), 10 + 9 + 10);
  hidden[1] = 1;
  EXPECT_EQ(at(1, 0.5), 10);          // half-way to the hidden one
  EXPECT_EQ(at(2, 0.5), 16);
}

TEST(SurfaceLux, TheSubPatchAtAPointIsTheOneThatHoldsIt) {
  SolvedScene scene(kHead + "object o\ntri grey 0 0 0  4 0 0  0 3 0 patches 3 sub 2\n"
                            "quad grey 0 0 0  4 0 0  4 3 0  0 3 0 patches 2 3 sub 2 1\n");
  for (std::uint32_t m = 0; m < 2; ++m) {
    const Mesh& mesh = scene.model->scene.meshes[m];
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const PieceIndex at = sub_patch_index(mesh, k);
      const double off = mesh.kind != MeshKind::kTriangle ? 0.5 : at.inverted ? 2.0 / 3 : 1.0 / 3;
      const auto fixed = [&](std::uint32_t c) { return static_cast<std::int32_t>(4096 * (c + off)); };
      EXPECT_EQ(sub_patch_at(mesh, fixed(at.u), fixed(at.v)), k) << "mesh " << m;
    }
  }
}

struct Ppm {
  std::uint32_t width = 0, height = 0;
  std::vector<int> value;

  explicit Ppm(const std::string& path) {
    ValueGrid grid;
    std::string mistake;
    EXPECT_TRUE(read_grid(file_text(path), grid, mistake)) << mistake;
    width = grid.width;
    height = grid.height;
    for (const float level : grid.value) value.push_back(static_cast<int>(level));
  }
  int at(std::uint32_t x, std::uint32_t y, std::uint32_t c) const { return value[3 * (y * width + x) + c]; }
};

/// A black floor of 4 x 4 m seen from straight above, all of it; the lamp is 2 m over its middle, 1,000 cd all round.
const std::string kFloor =
    "shodo 1\nmaterial black diffuse 0\nobject floor\nquad black -2 -2 0  2 -2 0  2 2 0  -2 2 0 patches 8 8 sub 4 4\n"
    "light lamp point at 0 0 2 intensity 1000\n"
    "camera above eye 0 0 4 look 0 0 0 up 0 1 0 fov 53.13010235415598\n";

double lux_at(double x, double y) { return 2000 / std::pow(4 + x * x + y * y, 1.5); }

TEST(Measured, FalseColoursAreTheScaleOfTheClosedForm) {
  const TestFolder folder;
  folder.write("floor.scn", kFloor);
  const Running::Words words{"render", "floor.scn",   "-o", "f.ppm",          "--size",
                             "100x100", "--antialias", "1",  "--false-colour", "20,300"};
  ASSERT_EQ(run(words, folder.path()).status, 0);
  const Ppm picture(folder / "f.ppm");
  const LuxScale scale{20, 300};
  for (std::uint32_t y = 0; y < 100; ++y) {
    for (std::uint32_t x = 0; x < 58; ++x) {  // beside the legend
      const Rgb8 expected = scale.colour(lux_at((x + 0.5) / 25 - 2, 2 - (y + 0.5) / 25));
      // Linear between centres 12.5 cm apart, and flat beyond the outermost: 1 % of lux, 1/3 of an entry of the scale.
      for (std::uint32_t c = 0; c < 3; ++c) ASSERT_NEAR(picture.at(x, y, c), expected[c], 14) << x << " " << y;
    }
  }
  EXPECT_NE(picture.at(97, 3, 0), 24);   // above the legend's panel
  EXPECT_EQ(picture.at(99, 50, 0), 24);  // on it
}

TEST(Measured, ALineOfEqualIlluminanceIsTheClosedFormsCircle) {
  const TestFolder folder;
  folder.write("floor.scn", kFloor);
  ASSERT_EQ(run({"render", "floor.scn", "-o", "f.ppm", "--size", "200x200", "--antialias", "1", "--isolux", "150"},
                folder.path())
                .status,
            0);
  const Ppm picture(folder / "f.ppm");
  const double radius = 50 * std::sqrt(std::pow(2000 / 150.0, 2.0 / 3) - 4);  // pixels
  std::map<int, int> around;  // pixels of the line by their angle, in 5 degrees
  int far = 0;
  for (std::uint32_t y = 0; y < 200; ++y) {
    for (std::uint32_t x = 0; x < 200; ++x) {
      if (picture.at(x, y, 0) == 0) continue;  // the floor is black
      const double dx = x + 0.5 - 100, dy = y + 0.5 - 100;
      // The label, 21 x 11 pixels on the line, is the only thing off it.
      if (std::abs(std::sqrt(dx * dx + dy * dy) - radius) > 1.5) ++far;
      ++around[static_cast<int>(std::floor(std::atan2(dy, dx) * 36 / M_PI))];
    }
  }
  EXPECT_EQ(around.size(), 72u);
  EXPECT_GT(far, 50);
  EXPECT_LT(far, 21 * 11);
}

TEST(Measured, BordersOfPatchesStandWhereTheyAre) {
  const TestFolder folder;
  folder.write("floor.scn", kFloor);
  for (const std::string what : {"patches", "sub-patches"}) {
    const Running::Words words{"render", "floor.scn",   "-o", what + ".ppm", "--size",
                               "128x128", "--antialias", "1",  "--show",     what};
    ASSERT_EQ(run(words, folder.path()).status, 0);
    const Ppm picture(folder / (what + ".ppm"));
    const std::uint32_t step = what == "patches" ? 16 : 4;  // pixels
    for (std::uint32_t y = 0; y < 128; ++y) {
      for (std::uint32_t x = 0; x < 128; ++x) {
        const bool line = (x % step == step - 1 && x != 127) || (y % step == step - 1 && y != 127);
        ASSERT_EQ(picture.at(x, y, 1) != 0, line) << what << " " << x << " " << y;
      }
    }
  }
}

TEST(Measured, OtherPicturesStayAsTheyAre) {
  const TestFolder folder;
  folder.write("floor.scn", kFloor);
  const Running::Words plain{"render", "floor.scn", "-o", "a.ppm", "--size", "40x30"};
  ASSERT_EQ(run(plain, folder.path()).status, 0);
  // Levels that nothing reaches draw no line.
  const Running::Words lined{"render", "floor.scn", "-o", "b.ppm", "--size", "40x30", "--isolux", "9000"};
  ASSERT_EQ(run(lined, folder.path()).status, 0);
  EXPECT_EQ(file_text(folder / "a.ppm"), file_text(folder / "b.ppm"));
}

TEST(Measured, LessMemoryChangesNoPixel) {
  const TestFolder folder;
  folder.write("floor.scn", kFloor + "plane work -1 -1 0.5  1 -1 0.5  1 1 0.5  -1 1 0.5 patches 2 1 sub 1 3\n");
  const auto words = [](const std::string& name, const std::string& memory) {
    return Running::Words{"render", "floor.scn", "-o",   name,             "--size", "40x30",    "--memory", memory,
                          "--isolux", "auto",    "--show", "patches", "--summary", name + ".csv"};
  };
  const Outcome refused = run(words("a.ppm", "1K"), folder.path());
  ASSERT_EQ(refused.status, 4);
  const std::size_t at = refused.err.find("(--memory ") + 10;
  const std::string smallest = refused.err.substr(at, refused.err.find(')', at) - at);
  ASSERT_EQ(run(words("a.ppm", smallest), folder.path()).status, 0) << smallest;
  ASSERT_EQ(run(words("b.ppm", "8M"), folder.path()).status, 0);
  EXPECT_EQ(file_text(folder / "a.ppm"), file_text(folder / "b.ppm"));
  EXPECT_EQ(file_text(folder / "a.ppm.csv"), file_text(folder / "b.ppm.csv"));
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result(1);
  for (const char c : line) {
    if (c == ',') {
      result.emplace_back();
    } else {
      result.back() += c;
    }
  }
  return result;
}

// A closed box whose walls all shine with L on each other has E0 = pi L everywhere, and so E = pi L / (1 - rho).
// Direct light of large near faces is right to 1e-3 (--tiers).
TEST(Summary, OfAFurnaceIsOneIlluminanceEverywhere) {
  const TestFolder folder;
  folder.write("box.scn",
               "shodo 1\nunit cm\nmaterial grey diffuse 0.5\nobject box\nquad grey 0 0 0  400 0 0  400 400 0  0 400 0\n"
               "quad grey 0 0 400  0 400 400  400 400 400  400 0 400\nquad grey 0 0 0  0 0 400  400 0 400  400 0 0\n"
               "quad grey 0 400 0  400 400 0  400 400 400  0 400 400\nquad grey 0 0 0  0 400 0  0 400 400  0 0 400\n"
               "quad grey 400 0 0  400 0 400  400 400 400  400 400 0\nlight all polyhedron object box luminance 100\n"
               "object none\nplane mid 100 100 200  300 100 200  300 300 200  100 300 200 patches 3 3 sub 1 1\n");
  const Outcome outcome = run({"map", "box.scn", "-o", "maps", "--summary", "-", "--patch", "50"}, folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "kind,name,area_m2,hidden_m2,mean_lx,least_lx,greatest_lx,uo,ud");
  for (std::size_t k = 1; k < 3; ++k) {
    const std::vector<std::string> f = fields(lines[k]);
    ASSERT_EQ(f.size(), 9u);
    EXPECT_EQ(f[0] + f[1], k == 1 ? "objectbox" : "planemid");
    EXPECT_NEAR(std::stod(f[2]), k == 1 ? 96 : 4, 1e-9);
    EXPECT_EQ(f[3], "0");
    for (std::size_t n = 4; n < 7; ++n) EXPECT_NEAR(std::stod(f[n]), 200 * M_PI, 0.002 * 200 * M_PI) << lines[k];
    EXPECT_NEAR(std::stod(f[7]), std::stod(f[5]) / std::stod(f[4]), 1e-8);
    EXPECT_NEAR(std::stod(f[8]), std::stod(f[5]) / std::stod(f[6]), 1e-8);
  }
}

TEST(Summary, PlanesFollowTheMeshesInMapsAndTables) {
  const TestFolder folder;
  folder.write("floor.scn", kFloor + "plane work -1 -1 0.5  1 -1 0.5  1 1 0.5  -1 1 0.5 patches 2 1 sub 1 3\n");
  ASSERT_EQ(run({"map", "floor.scn", "-o", "maps", "--csv", "t.csv"}, folder.path()).status, 0);
  EXPECT_EQ(lines_of(file_text(folder / "maps/index.csv")).back(), "0001.pfm,work,1,plane,,2,3,2,1,1,3");
  ValueGrid grid;
  std::string mistake;
  ASSERT_TRUE(read_grid(file_text(folder / "maps/0001.pfm"), grid, mistake)) << mistake;
  EXPECT_EQ(grid.width, 2u);
  EXPECT_EQ(grid.height, 3u);
  const std::vector<std::string> lines = lines_of(file_text(folder / "t.csv"));
  ASSERT_EQ(lines.size(), 1u + 1024u + 6u);
  const std::vector<std::string> last = fields(lines.back());
  EXPECT_EQ(last[0] + " " + last[1] + " " + last[2] + " " + last[3], "work 1 1 2");
  EXPECT_NEAR(std::stod(last[11]), static_cast<double>(grid.value[1]), 1e-3);  // the top row is v = 2
}

TEST(Difference, OfAPictureToItselfIsNothing) {
  const TestFolder folder;
  folder.write("a.ppm", std::string("P6 # two pixels\n2 1\n255\n") + "abcdef");
  const Outcome outcome = run({"difference", "a.ppm", "a.ppm", "-o", "d.ppm"}, folder.path());
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out,
            "size:      2 x 1, 3 channels\nmean:      0 levels\nrms:       0 levels\n"
            "largest:   0 levels, at column 0, row 0 from above\ndifferent: 0 of 2 pixels\n");
  const Ppm picture(folder / "d.ppm");
  for (std::uint32_t c = 0; c < 3; ++c) EXPECT_EQ(picture.at(1, 0, c), scale_colour(0)[c]);
}

TEST(Difference, SaysHowFarAndWhere) {
  const TestFolder folder;
  folder.write("a.ppm", std::string("P6\n2 2\n255\n") + "aaabbbcccddd");
  folder.write("b.ppm", std::string("P6\n2 2\n255\n") + "aaabbbcgcdde");
  const Outcome outcome = run({"difference", "a.ppm", "b.ppm"}, folder.path());
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out,
            "size:      2 x 2, 3 channels\nmean:      0.416666667 levels\nrms:       1.19023807 levels\n"
            "largest:   4 levels, at column 0, row 1 from above\ndifferent: 2 of 4 pixels\n");
}

std::string floats(std::initializer_list<float> values, bool little) {
  std::string bytes;
  for (const float value : values) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, 4);
    for (unsigned k = 0; k < 4; ++k) bytes += static_cast<char>(bits >> (little ? 8 * k : 24 - 8 * k));
  }
  return bytes;
}

TEST(Difference, ReadsMapsOfEitherByteOrderFromTheBottomRow) {
  const TestFolder folder;
  folder.write("a.pfm", "Pf\n1 2\n-1.0\n" + floats({100, 200}, true));
  folder.write("b.pfm", "Pf\n1 2\n1.0\n" + floats({100, 203}, false));
  const Outcome outcome = run({"difference", "a.pfm", "b.pfm"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(lines_of(outcome.out)[1], "mean:      1.5 lx");
  EXPECT_EQ(lines_of(outcome.out)[3], "largest:   3 lx, at column 0, row 0 from above");
}

TEST(Difference, RefusesWhatItCanNotCompare) {
  const TestFolder folder;
  folder.write("a.ppm", std::string("P6\n2 1\n255\n") + "abcdef");
  folder.write("small.ppm", std::string("P6\n1 1\n255\n") + "abc");
  folder.write("short.ppm", std::string("P6\n2 1\n255\n") + "abc");
  folder.write("deep.ppm", std::string("P6\n1 1\n65535\n") + "abcdef");
  folder.write("nan.pfm", "Pf\n1 1\n-1\n" + floats({std::nanf("")}, true));
  folder.write("text", "hello");
  const struct {
    Running::Words words;
    int status;
    std::string said;
  } cases[] = {
      {{"a.ppm"}, 2, "expected two files, found 'a.ppm' alone"},
      {{}, 2, "expected two files, found none"},
      {{"a.ppm", "a.ppm", "a.ppm"}, 2, "expected two files"},
      {{"a.ppm", "small.ppm"}, 2,
       "expected two of one kind and size, found a picture of 2 x 1 x 3 and a picture of 1 x 1 x 3"},
      {{"a.ppm", "none.ppm"}, 1, "none.ppm: No such file"},
      {{"a.ppm", "short.ppm"}, 1, "short.ppm: expected 6 bytes after the header, found 3"},
      {{"deep.ppm", "a.ppm"}, 1, "deep.ppm: expected 255 as the largest value"},
      {{"nan.pfm", "nan.pfm"}, 1, "nan.pfm: expected finite numbers"},
      {{"text", "a.ppm"}, 1, "text: expected a picture (PPM, P6; PNG) or a map (PFM)"},
      {{"a.ppm", "a.ppm", "-o", "d.pfm"}, 2, "-o: expected a name that ends in .png or .ppm"},
      {{"a.ppm", "a.ppm", "--size", "8x8"}, 2, "--size has no meaning for difference"},
  };
  for (const auto& c : cases) {
    Running::Words words{"difference"};
    words.insert(words.end(), c.words.begin(), c.words.end());
    const Outcome outcome = run(words, folder.path());
    EXPECT_EQ(outcome.status, c.status) << c.said;
    EXPECT_NE(outcome.err.find(c.said), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(Measured, WrongWordsAreRefused) {
  const std::string scene = test_scene("sun.scn");
  const std::pair<Running::Words, std::string> cases[] = {
      {{"--false-colour", "red"}, "--false-colour: expected auto, or LOW,HIGH in lux"},
      {{"--false-colour", "5,5"}, "found '5,5'"},
      {{"--false-colour", "-1,5"}, "found '-1,5'"},
      {{"--isolux", "0"}, "found '0'"},
      {{"--isolux", "100,50"}, "found '100,50'"},
      {{"--isolux", "100,"}, "found '100,'"},
      {{"--show", "meshes"}, "--show: expected patches or sub-patches, found 'meshes'"},
      {{"--summary", "x.ppm"}, "two outputs have the same name 'x.ppm'"},
  };
  for (const auto& [words, said] : cases) {
    Running::Words all{"render", scene, "-o", "x.ppm"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.status, 2) << said;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run({"map", scene, "-o", "m", "--isolux", "auto"}).status, 2);
}

}  // namespace
}  // namespace shodo
