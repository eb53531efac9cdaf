// The tracer of tests/truth against closed forms: it judges maps, so nothing of theirs may judge it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/scene_from_text.h"
#include "truth/comparison.h"
#include "truth/tracer.h"

namespace shodo {
namespace {

/// Six walls of a box with one corner at the origin, fronts inwards, z up; `floor` is the first one's material.
std::string box(double x, double y, double z, const std::string& floor, const std::string& counts) {
  const auto quad = [&](const std::string& material, const char* corners) {
    std::string text = "quad " + material;
    for (const char* c = corners; *c != 0; ++c) {
      if (*c == 'x') text += " " + std::to_string(x);
      else if (*c == 'y') text += " " + std::to_string(y);
      else if (*c == 'z') text += " " + std::to_string(z);
      else if (*c == '0') text += " 0";
    }
    return text + " " + counts + "\n";
  };
  return "object walls\n" + quad(floor, "000 x00 xy0 0y0") + quad("wall", "00z 0yz xyz x0z") +
         quad("wall", "000 00z x0z x00") + quad("wall", "0y0 xy0 xyz 0yz") + quad("wall", "000 0y0 0yz 00z") +
         quad("wall", "x00 x0z xyz xy0");
}

/// Area means over one mesh or all, of both halves.
struct Means {
  double ambient = 0, seen = 0;
};
Means means_of(const Scene& scene, const std::vector<truth::Truth>& truths, std::uint32_t first, std::uint32_t end) {
  Means means;
  double area = 0;
  for (std::uint32_t m = first; m < end; ++m) {
    const Mesh& mesh = scene.meshes[m];
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const double a = length(sub_patch_piece(scene, mesh, k).vector_area());
      for (const truth::Estimate& half : truths[mesh.first_sub_patch + k].half) {
        means.ambient += 0.5 * a * half.seen * half.lux[0];
        means.seen += 0.5 * a * half.seen;
      }
      area += a;
    }
  }
  means.ambient /= means.seen;
  means.seen /= area;
  return means;
}

/// References 5.8: 10,000 lm at the centre of a closed cube of 4 m; the mean is Phi rho / (96 (1 - rho)).
TEST(Truth, ClosedCubeHasTheMeanOfItsClosedForm) {
  for (const double rho : {0.3, 0.7, 0.95}) {
    const LoadedScene cube("shodo 1\nmaterial wall diffuse " + std::to_string(rho) + "\n" +
                           box(4, 4, 4, "wall", "patches 4 4 sub 2 2") + "light lamp point at 2 2 2 intensity " +
                           std::to_string(10000 / (4 * kPi)) + "\n");
    const truth::Tracer tracer(cube.scene);
    const Means means = means_of(cube.scene, tracer.all(rho > 0.9 ? 256 : 64, 1), 0, 6);
    const double right = 10000 * rho / (96 * (1 - rho));
    EXPECT_EQ(means.seen, 1);
    // Noise: 384 x 2 x 64 paths whose spread is about their mean (0.5 %), more at 0.95, whose paths are 20 long and
    // four times as many: four standard deviations.
    EXPECT_NEAR(means.ambient / right, 1, 0.012) << rho;
  }
}

/// References 5.6: one reflection from a floor lit evenly, here by a sun through an open roof that blocks nothing.
TEST(Truth, OneReflectionFromAnEvenFloor) {
  const double rho = 0.5, lux = 1000;
  const std::string small = " patches 1 1 sub 1 1\n";
  const LoadedScene room("shodo 1\nmaterial floor diffuse 0.5\nmaterial wall diffuse 0\nobject floor\n"
                         "quad floor 0 0 0 4 0 0 4 4 0 0 4 0" + small +
                         "object wall\n"
                         "quad wall 1.999 0 0.749 1.999 0 0.751 2.001 0 0.751 2.001 0 0.749" + small +
                         "quad wall 1.999 0 2.749 1.999 0 2.751 2.001 0 2.751 2.001 0 2.749" + small +
                         "object ceiling\n"
                         "quad wall 1.999 0.249 3 1.999 0.251 3 2.001 0.251 3 2.001 0.249 3" + small +
                         "light sun sun towards 0 0 -1 illuminance 1000\n");
  const truth::Tracer tracer(room.scene);
  const double right[] = {35.901, 12.967, 26.795};  // % of E rho
  for (std::uint32_t m = 1; m < 4; ++m) {
    const truth::Truth truth = tracer.sub_patch(m, 0, 1 << 15);
    for (const truth::Estimate& half : truth.half) {
      // An additive sequence of 32,768 directions: off by less than 0.1 % in both halves. The small patches block the
      // sun of 4e-6 m2 at most.
      EXPECT_NEAR(half.lux[0], right[m - 1] / 100 * rho * lux, 0.004 * right[m - 1] / 100 * rho * lux) << m;
    }
  }
}

/// All of the light's flux but 0.2 % falls on the floor; most of it from nearer than an area's sample could take.
TEST(Truth, AreaLightAMillimetreAwayGivesItsFlux) {
  const LoadedScene room("shodo 1\nmaterial wall diffuse 0.6\nobject walls\n"
                         "quad wall 0 0 0 1 0 0 1 1 0 0 1 0 patches 2 2\n"
                         "light lamp area quad 0 0 0.001 0 1 0.001 1 1 0.001 1 0 0.001 luminance 100\n");
  const truth::Tracer tracer(room.scene);
  truth::Chance chance(1);
  double mean = 0;
  constexpr int kTimes = 20000;
  for (int k = 0; k < kTimes; ++k) {
    double lux[3];
    const double x = chance.next(), y = chance.next();
    const Mesh& mesh = room.scene.meshes[0];
    tracer.direct({cell_piece(room.scene, mesh, 0).point(x, y), {0, 0, 1}}, chance, lux);
    mean += lux[0] / kTimes;
  }
  // Unit squares 1 mm apart: F = 0.99801 by the closed form, E = pi L F.
  EXPECT_NEAR(mean / (kPi * 100 * 0.998007), 1, 0.003);
}

/// CIE 171, 5.3: a square area light, by its contour integral.
TEST(Truth, AreaLightIsThatOfItsContourIntegral) {
  const LoadedScene room("shodo 1\nmaterial wall diffuse 0\n" + box(4, 4, 3, "wall", "patches 1 1") +
                         "light lamp area quad 1.5 1.5 3 1.5 2.5 3 2.5 2.5 3 2.5 1.5 3 luminance 1000 open\n");
  const truth::Tracer tracer(room.scene);
  struct Case {
    Vec3 point, normal;
    double lux;
  };
  for (const Case& one : {Case{{2, 0, 2.75}, {0, 1, 0}, 32.68}, Case{{2, 0, 1.25}, {0, 1, 0}, 69.06},
                          Case{{2, 0.25, 0}, {0, 0, 1}, 61.42}, Case{{2, 1.75, 0}, {0, 0, 1}, 105.78}}) {
    truth::Chance chance(7);
    double mean = 0;
    constexpr int kTimes = 40000;
    for (int k = 0; k < kTimes; ++k) {
      double lux[3];
      tracer.direct({one.point - room.scene.origin, one.normal}, chance, lux);
      mean += lux[0] / kTimes;
    }
    EXPECT_NEAR(mean / one.lux, 1, 0.005);  // its own digits 2e-4, chance 1e-3
  }
}

/// A closed polyhedral lamp in a closed cube: all its flux arrives, and the walls reflect it; the lamp reflects as
/// they do, so the mean over all surfaces is Phi rho / (A (1 - rho)).
TEST(Truth, PolyhedralLampKeepsItsEnergy) {
  const auto lamp = [] {
    std::string text = "object lamp\n";
    const char* faces[] = {"1.5 1.5 1.5 1.5 2.5 1.5 2.5 2.5 1.5 2.5 1.5 1.5",
                           "1.5 1.5 2.5 2.5 1.5 2.5 2.5 2.5 2.5 1.5 2.5 2.5",
                           "1.5 1.5 1.5 2.5 1.5 1.5 2.5 1.5 2.5 1.5 1.5 2.5",
                           "1.5 2.5 1.5 1.5 2.5 2.5 2.5 2.5 2.5 2.5 2.5 1.5",
                           "1.5 1.5 1.5 1.5 1.5 2.5 1.5 2.5 2.5 1.5 2.5 1.5",
                           "2.5 1.5 1.5 2.5 2.5 1.5 2.5 2.5 2.5 2.5 1.5 2.5"};
    for (const char* face : faces) text += "quad wall " + std::string(face) + " patches 2 2\n";
    return text;
  };
  const LoadedScene cube("shodo 1\nmaterial wall diffuse 0.7\n" + box(4, 4, 4, "wall", "patches 4 4 sub 2 2") +
                         lamp() + "light lamp polyhedron object lamp luminance 100\n");
  const truth::Tracer tracer(cube.scene);
  const Means means = means_of(cube.scene, tracer.all(128, 1), 0, 12);
  const double flux = kPi * 100 * 6, area = 6 * 16 + 6;
  EXPECT_NEAR(means.ambient / (flux * 0.7 / (area * 0.3)), 1, 0.01);
}

/// What stands under a closed box without a bottom is hidden; what stands beside it isn't.
TEST(Truth, WhatBacksEncloseIsHidden) {
  const LoadedScene room(
      "shodo 1\nmaterial wall diffuse 0.5\n" + box(4, 4, 3, "wall", "patches 4 4") +
      "object chest\nquad wall 0 1 0 1 1 0 1 1 1 0 1 1\nquad wall 1 1 0 1 2 0 1 2 1 1 1 1\n"
      "quad wall 0 2 0 0 2 1 1 2 1 1 2 0\nquad wall 0 1 1 1 1 1 1 2 1 0 2 1\nsub walls 1 1\nsub chest 1 1\n"
      "light lamp point at 2 2 2 intensity 100\n");
  const truth::Tracer tracer(room.scene);
  const Means floor = means_of(room.scene, tracer.all(64, 1), 0, 1);
  EXPECT_NEAR(floor.seen, 15.0 / 16, 1e-3);
}

/// A map that is the truth has no error but noise; one that is 2 lx off has that.
TEST(Truth, NoiseOfTheTruthIsNoErrorOfTheMap) {
  truth::Chance chance(3);
  truth::Table told, map;
  double total = 0;
  constexpr std::uint32_t kCount = 4000;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    truth::Row row{"o", false, 1, 1, {}, {}}, of_map = row;
    for (int c = 0; c < 3; ++c) {
      for (int half = 0; half < 2; ++half) {
        row.ambient[half][c] = 100 + 20 * (chance.next() - 0.5);
        row.direct[half][c] = 50;
        total += 0.5 * (row.ambient[half][c] + 50) / 3 / kCount;
      }
      of_map.direct[0][c] = of_map.direct[1][c] = 50;
      of_map.ambient[0][c] = of_map.ambient[1][c] = k % 2 == 0 ? 102 : 98;
    }
    told[{0, 0, k}] = row;
    map[{0, 0, k}] = of_map;
  }
  truth::Sums sums;
  for (const auto& [key, row] : told) sums.add(truth::compared(key, row, row.ambient, map[key].ambient));
  // The products' spread is 35 / sqrt(3) lx^2; of 4000 that is 0.3 in 4.
  EXPECT_NEAR(sums.square / sums.area, 4, 1.2);
  EXPECT_NEAR(total, 150, 0.5);
  EXPECT_NE(truth::comparison("m", told, map, 1).find("ambient error 1."), std::string::npos);
}

/// Two truths of 20 lx of noise each that are 2 lx apart.
TEST(Truth, NoiseOfNeitherOfTwoTruthsIsTheirDifference) {
  truth::Chance chance(5);
  truth::Sums sums;
  constexpr std::uint32_t kCount = 4000;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    double one[2][3], other[2][3];
    for (int half = 0; half < 2; ++half) {
      for (int c = 0; c < 3; ++c) {
        one[half][c] = 100 + 20 * (chance.next() - 0.5);
        other[half][c] = (k % 2 == 0 ? 102 : 98) + 20 * (chance.next() - 0.5);
      }
    }
    sums.add(truth::compared({0, 0, k}, {"o", false, 1, 1, {}, {}}, one, other));
  }
  // The products' spread is 68 / sqrt(3) lx^2; of 4000 that is 0.62 in 4.
  EXPECT_NEAR(sums.square / sums.area, 4, 2.5);
}

/// What a sub-patch is met on: its own middle and a point near each of its corners.
TEST(Truth, EveryKindOfMeshKnowsItsSubPatches) {
  const LoadedScene scene("shodo 1\nmaterial wall diffuse 0.5\nobject all\n"
                          "quad wall 0 0 0 4 0 0 4 2 0 0 2 0 patches 3 2 sub 2 3\n"
                          "quad wall 0 4 0 4 4 0 3 6 0 1 6 0 patches 2 2 sub 3 2\n"
                          "tri wall 6 0 0 10 0 0 6 3 1 patches 3 sub 2\n"
                          "grid wall 3 3 6 4 0 7 4 0 9 4 0 6 5 0 7 6 1 9 5 0 6 8 0 7 8 0 9 8 0 sub 2 3\n");
  const truth::World world(scene.scene, scene.scene);
  for (std::uint32_t m = 0; m < 4; ++m) {
    const Mesh& mesh = scene.scene.meshes[m];
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const Piece piece = sub_patch_piece(scene.scene, mesh, k);
      truth::Facet facet;
      facet.mesh = m;
      facet.cell = cell_of_patch(mesh, patch_of_sub_patch(mesh, k));
      for (const auto& [s, t] : {std::pair(0.33, 0.33), std::pair(0.05, 0.05), std::pair(0.9, 0.05),
                                 std::pair(0.05, 0.9)}) {
        EXPECT_EQ(world.sub_patch_at(facet, piece.point(s, t)), mesh.first_sub_patch + k) << m;
      }
    }
  }
}

/// A cube of which half of the floor sends: its walls get what the form factors of whole and half squares say.
TEST(Truth, PathsThatEndWhereTheyMeetSomethingFindWhatThatSends) {
  const LoadedScene cube("shodo 1\nmaterial wall diffuse 0.7\n" + box(4, 4, 4, "wall", "patches 2 1 sub 1 1"));
  truth::Tracer tracer(cube.scene);
  truth::Tracer::Senders senders(12, {0, 0, 0});
  senders[0] = {100, 50, 25};
  tracer.end_at(senders, false);
  const std::vector<truth::Truth> truths = tracer.all(4096, 1);
  const Means ceiling = means_of(cube.scene, truths, 1, 2), all = means_of(cube.scene, truths, 0, 6);
  // Opposite faces of a cube have F = 0.199825; half of the floor gives the whole ceiling half of that.
  EXPECT_NEAR(ceiling.ambient, 0.7 * 100 * 0.199825 / 2, 0.02);
  // All that it sends arrives, on six faces.
  EXPECT_NEAR(all.ambient, 0.7 * 100 / 12, 0.02);
  for (const truth::Truth& truth : truths) {
    EXPECT_NEAR(truth.half[0].lux[1], truth.half[0].lux[0] / 2, 1e-9);
    EXPECT_NEAR(truth.half[0].lux[2], truth.half[0].lux[0] / 4, 1e-9);
  }
}

/// The same by a lamp in the cube's middle, whose light each place has as it is: all that it sends, reflected once.
TEST(Truth, PathsThatEndFindDirectLightThere) {
  const LoadedScene cube("shodo 1\nmaterial wall diffuse 0.7\n" + box(4, 4, 4, "wall", "patches 1 1 sub 1 1") +
                         "light lamp point at 2 2 2 intensity 100\n");
  truth::Tracer tracer(cube.scene);
  tracer.end_at(truth::Tracer::Senders(6, {10, 10, 10}), true);
  const Means means = means_of(cube.scene, tracer.all(4096, 1), 0, 6);
  EXPECT_NEAR(means.ambient, 0.7 * (10 + 4 * kPi * 100 / 96), 0.02);  // six sequences of 8,192: measured, 0.003
}

}  // namespace
}  // namespace shodo
