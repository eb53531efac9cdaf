// Surfaces of every kind gather and are gathered from; what they get against contour integrals.
#include <cmath>

#include "tests/ambient/gathered.h"

namespace shodo {
namespace {

/// Over the square from 0 to 3, front down, about a metre up. All but the rectangles are parted unevenly.
struct Shape {
  const char* name;
  std::string text;  // with what follows `quad white` and so on
};

std::vector<Shape> shapes(const std::string& m) {
  return {
      {"rectangle", "quad " + m + " 0 0 1  0 3 1  3 3 1  3 0 1  patches 3 2 sub 2 3\n"},
      {"parallelogram", "quad " + m + " 0 0 1  0.5 3 1.2  3.5 3 1.2  3 0 1  patches 2 3 sub 3 1\n"},
      {"trapezium", "quad " + m + " 0 0 1  1 3 1  2 3 1  3 0 1  patches 3 3 sub 2 1\n"},
      {"not plane", "quad " + m + " 0 0 1  0 3 1.1  3 3 1  3 0 1.1  patches 2 3 sub 2 2\n"},
      {"concave at corner 2", "quad " + m + " 0 0 1  0 3 1  1 1 1  3 0 1  patches 3 3 sub 2 2\n"},
      {"concave at corner 3", "quad " + m + " 3 0 1  0 0 1  0 3 1  1 1 1  patches 3 3 sub 2 2\n"},
      {"triangle", "tri " + m + " 0 0 1  0 3 1  3 0 1  patches 2 sub 3\n"},
      {"triangle of patches", "tri " + m + " 0 0 1  0 3 1.2  3 0 1  patches 5 sub 1\n"},
      {"grid", "grid " + m + " 3 3  0 0 1  1.2 0 1.1  3 0 1  0 1 1  1 1.3 1.05  3 1 1.05  0 3 1  1.5 3 1  3 3 1.1  "
                             "sub 2 3\n"},
  };
}

/// What follows, in one object after the floor, whose front is up.
std::string over_floor(const std::string& floor, const std::string& shape) {
  return black_and_white() + "object floor_\n" + facing("+z", floor, {0, 0, 0}, {3, 3, 0}, "patches 4 3 sub 1 2") +
         "object shape\n" + shape;
}

/// Every sub-patch of a mesh as bright as no neighbour is; nothing else is lit.
void paint(Gathered& g, std::uint32_t m) {
  const Mesh& mesh = g.scene.loaded.scene.meshes[m];
  std::fill(g.direct.begin(), g.direct.end(), 0.0f);
  std::fill(g.lx.begin(), g.lx.end(), 0.0f);
  for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
    g.direct[mesh.first_sub_patch + k] = static_cast<float>(100 + 400 * (k * 7 % 11));
  }
}

Errors errors_of(Gathered& g, std::uint32_t m) {
  EXPECT_TRUE(g.gather().done());
  const Unhidden expected(g);
  Errors errors;
  for (std::uint32_t k = 0; k < g.scene.loaded.scene.meshes[m].sub_patch_count(); ++k) {
    errors.add(g.gathered(m, k), expected(m, k));
  }
  return errors;
}

double dark(const Vec3&, std::uint32_t) { return 0; }

/// 16384 lines leave 1 % of the brightest (measured), sub-patches mistaken for their neighbours 10 %.
TEST(GatherShapes, SubPatchesOfEveryKindOfSurfaceSend) {
  for (const Shape& shape : shapes("white")) {
    Gathered g(over_floor("black", shape.text), 16384, dark);
    paint(g, 1);
    const Errors errors = errors_of(g, 0);
    EXPECT_LT(errors.rms(), 0.02) << shape.name;
  }
}

TEST(GatherShapes, SubPatchesOfEveryKindOfSurfaceReceive) {
  for (const Shape& shape : shapes("black")) {
    Gathered g(over_floor("white", shape.text), 16384, dark);
    paint(g, 0);
    const Errors errors = errors_of(g, 1);
    EXPECT_LT(errors.rms(), 0.02) << shape.name;
  }
}

/// A picture of 4 x 3 texels over as many patches; what they reflect is their texel's linear value, of the mean's.
TEST(GatherShapes, PatchesOfATextureSendWhatTheyReflect) {
  const unsigned char texels[3][4] = {{255, 90, 60, 200}, {30, 240, 120, 70}, {180, 50, 220, 255}};
  const auto linear = [](double level) { return std::pow((level / 255 + 0.055) / 1.055, 2.4); };
  double mean = 0;
  std::string picture = "P5 4 3 255\n";
  for (const auto& row : texels) {
    for (const unsigned char texel : row) {
      picture += static_cast<char>(texel);
      mean += linear(texel) / 12;
    }
  }
  // u runs along x and v along y; the picture's first row is at the end of v.
  Gathered g("shodo 1\nmaterial tiles diffuse 0.3 texture t.pgm\nmaterial black diffuse 0\nobject floor_\n" +
                 std::string("quad tiles 0 0 0  4 0 0  4 3 0  0 3 0  patches 4 3 sub 2 2\nobject over\n") +
                 facing("-z", "black", {0, 0, 0.8}, {4, 3, 0.8}, "patches 6 8 sub 1 1"),
             16384, [](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; }, {{"t.pgm", picture}});
  ASSERT_TRUE(g.gather().done());
  const Unhidden expected(g, [&](const Mesh& mesh, std::uint32_t patch, std::uint32_t) {
    return mesh.nu == 4 ? 0.3 * linear(texels[2 - patch / 4][patch % 4]) / mean : 0.0;
  });
  Errors errors;
  for (std::uint32_t k = 0; k < 48; ++k) errors.add(g.gathered(1, k), expected(1, k));
  EXPECT_LT(errors.rms(), 0.02);
}

}  // namespace
}  // namespace shodo
