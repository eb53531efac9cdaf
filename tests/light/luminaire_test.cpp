// Point lights whose distribution an IES file gives: the frame, the symmetries, and their light on surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "light/distribution.h"
#include "light/point_source.h"
#include "support/solved_scene.h"
#include "truth/tracer.h"

namespace shodo {
namespace {

/// 1 cd where C is 0 and V is 90, 2 where it is 90, and so on; 2.5 along the axis.
const std::string kAround = "TILT=NONE\n1 -1 1 3 5 1 2 0 0 0\n1 1 0\n0 90 180\n0 90 180 270 360\n"
                            "2.5 1 2.5\n2.5 2 2.5\n2.5 3 2.5\n2.5 4 2.5\n2.5 1 2.5\n";

std::string light(const std::string& words) { return "shodo 1\nlight l point at 0 0 0 ies a.ies " + words + "\n"; }

struct Sides {
  double along_x, against_x, along_y, against_y, along_z, against_z;
  bool operator==(const Sides&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Sides& s) {
  return out << s.along_x << ' ' << s.against_x << ' ' << s.along_y << ' ' << s.against_y << ' ' << s.along_z << ' '
             << s.against_z;
}

/// Rounded: angles are off by an ulp.
Sides sides_of(const std::string& words) {
  const LoadedScene s(light(words), {}, {{"a.ies", kAround}});
  const auto at = [&](double x, double y, double z) {
    return std::round(1e9 * intensity(s.scene, s.scene.lights[0], {x, y, z})) * 1e-9;
  };
  return {at(2, 0, 0), at(-1, 0, 0), at(0, 3, 0), at(0, -1, 0), at(0, 0, 1), at(0, 0, -1)};
}

TEST(Luminaire, ItsHalfPlanesGoRoundAsSeenFromAboveAndItIsTurnedAsSeenFromBelow) {
  // Down, z up: C counts from +x over +y, counter-clockwise in a plan.
  EXPECT_EQ(sides_of("towards 0 0 -1"), (Sides{1, 3, 2, 4, 2.5, 2.5}));
  // Turned by 90 degrees, counter-clockwise for who looks up: C = 0 is on -y.
  EXPECT_EQ(sides_of("towards 0 0 -1 turn 90"), (Sides{2, 4, 3, 1, 2.5, 2.5}));
  EXPECT_EQ(sides_of("towards 0 0 -1 turn -270"), (Sides{2, 4, 3, 1, 2.5, 2.5}));
  // Up.
  EXPECT_EQ(sides_of("towards 0 0 1"), (Sides{1, 3, 4, 2, 2.5, 2.5}));
  // y up, down: a plan with x to the right has -z at its top.
  EXPECT_EQ(sides_of("towards 0 -2 0"), (Sides{1, 3, 2.5, 2.5, 4, 2}));
  // Along x it counts from +z, and goes round against the axis: z, y, -z, -y.
  EXPECT_EQ(sides_of("towards 1 0 0"), (Sides{2.5, 2.5, 2, 4, 1, 3}));
  EXPECT_EQ(sides_of("towards -3 0 0"), (Sides{2.5, 2.5, 4, 2, 1, 3}));
}

TEST(Luminaire, BetweenItsAnglesIntensityIsLinearAndBeyondThereIsNone) {
  const LoadedScene s(light("towards 0 0 -1"), {}, {{"a.ies", kAround}});
  const auto at = [&](double v, double c) {
    v *= kRadiansPerDegree;
    c *= kRadiansPerDegree;
    return intensity(s.scene, s.scene.lights[0],
                     {std::sin(v) * std::cos(c), std::sin(v) * std::sin(c), -std::cos(v)});
  };
  EXPECT_NEAR(at(90, 30), 1 + 30 / 90.0, 1e-12);
  EXPECT_NEAR(at(90, 345), 4 - 3 * 75 / 90.0, 1e-12);
  EXPECT_NEAR(at(60, 90), 2.5 + (2 - 2.5) * 60 / 90.0, 1e-12);
  EXPECT_NEAR(at(135, 225), (2.5 + 3.5) / 2, 1e-12);
  const std::string half = "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n90 180\n0\n5 7\n";
  const LoadedScene up(light("towards 0 0 1"), {}, {{"a.ies", half}});
  EXPECT_EQ(intensity(up.scene, up.scene.lights[0], {1, 0, 1e-9}), 0);
  EXPECT_NEAR(intensity(up.scene, up.scene.lights[0], {1, 0, -1e-9}), 5, 1e-6);
  EXPECT_EQ(intensity(up.scene, up.scene.lights[0], {0, 0, -1}), 7);
}

/// Any intensities at half-planes that stand for a part of the circle.
std::string table(const std::vector<int>& planes, std::mt19937& random) {
  std::string text = "TILT=NONE\n1 -1 1 7 " + std::to_string(planes.size()) +
                     " 1 2 0 0 0\n1 1 0\n0 20 45 70 90 120 180\n";
  for (const int plane : planes) text += std::to_string(plane) + " ";
  std::uniform_real_distribution<double> candela(0, 900);
  for (std::size_t k = 0; k < 7 * planes.size(); ++k) text += std::to_string(candela(random)) + "\n";
  return text;
}

TEST(Luminaire, OnPointsItAgreesWithTheTracersWhateverItsSymmetry) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const std::vector<int>& planes :
       {std::vector{0}, {0, 40, 90}, {0, 30, 100, 180}, {90, 150, 270}, {0, 100, 200, 300, 360}, {0, 120, 240}}) {
    const std::string file = table(planes, random);
    const LoadedScene s(light("towards 1 -2 0.5 turn 25 attenuation 0.3 0.2 1"), {}, {{"a.ies", file}});
    const truth::Tracer tracer(s.scene);
    for (int k = 0; k < 300; ++k) {
      const Vec3 point{3 * any(random), 3 * any(random), 3 * any(random)};
      const truth::Place place{point, normalised(Vec3{any(random), any(random), any(random)})};
      truth::Chance chance(7);
      double lux[3];
      tracer.direct(place, chance, lux);
      Receiver receiver;
      receiver.normal = place.normal;
      receiver.anchor = point;
      // Doubles, but angles near 0 and 180 by the arc cosine: 1e-8 of a radian.
      EXPECT_NEAR(point_lux(s.scene, s.scene.lights[0], receiver, point, 1e-9).lux, lux[0], 1e-5 * (1 + lux[0]));
    }
  }
}

/// Flux that arrives on the walls of a closed black room of 4 x 4 x 3 m over what the luminaire sends.
double arrived(const std::string& words, const std::string& file) {
  const std::string counts = " patches 8 8 sub 3 3\n";
  const std::string text = "shodo 1\nmaterial b diffuse 0\nobject walls\n"
                           "quad b 0 0 0 4 0 0 4 4 0 0 4 0" + counts + "quad b 0 0 3 0 4 3 4 4 3 4 0 3" + counts +
                           "quad b 0 0 0 0 0 3 4 0 3 4 0 0" + counts + "quad b 0 4 0 4 4 0 4 4 3 0 4 3" + counts +
                           "quad b 0 0 0 0 4 0 0 4 3 0 0 3" + counts + "quad b 4 0 0 4 0 3 4 4 3 4 4 0" + counts +
                           "light l point ies a.ies " + words + "\n";
  TestFiles files{{"a.ies", file}};
  const SolvedScene s(text, {}, std::size_t{8} << 20, reader_of(files));
  const Scene& scene = s.model->scene;
  double sum = 0;
  for (const Mesh& mesh : scene.meshes) {
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const double area = length(sub_patch_piece(scene, mesh, k).vector_area());
      sum += area * static_cast<double>(s.model->maps.direct_lx[mesh.first_sub_patch + k]);
    }
  }
  return sum / scene.luminaires[0].lumens;
}

TEST(Luminaire, AllOfItsLightArrives) {
  std::mt19937 random(3);
  // Between angles 20 degrees apart intensity has edges, which samples of a sub-patch don't meet.
  const std::string any = table({0, 100, 200, 300, 360}, random);
  EXPECT_NEAR(arrived("at 2.1 1.8 1.4 towards 1 2 -1 turn 40", any), 1, 0.002);
  EXPECT_NEAR(arrived("at 2.1 1.8 2.9 towards 0 0 -1", any), 1, 0.002);
  // Millimetres from a wall its sub-patch has the flux itself.
  EXPECT_NEAR(arrived("at 2.03 1.74 2.995 towards 0 0 1", any), 1, 0.005);
  EXPECT_NEAR(arrived("at 0.001 0.002 0.003 towards 1 1 1", any), 1, 0.005);
}

TEST(Luminaire, LightThatFallsBetweenAllSamplesOfAPartlyShadowedSubPatchIsThere) {
  // 600 cd down to 45 degrees, nothing from 50 on, 4 cm over the middle of a sub-patch of 50 cm: up to 5 cm around it.
  // Samples are 12.5 cm apart. Those of one side, beyond the light, are under a card with two fronts.
  const std::string file = "TILT=NONE\n1 -1 1 4 1 1 2 0 0 0\n1 1 0\n0 45 50 90\n0\n600 600 0 0\n";
  const std::string text = "shodo 1\nmaterial b diffuse 0\nobject floor\n"
                           "quad b 0 0 0 0 0 2 2 0 2 2 0 0 patches 1 1 sub 4 4\nobject card\n"
                           "quad b 0.5 0.005 0.9 0.5 0.005 1 1 0.005 1 1 0.005 0.9 patches 1 1 sub 1 1\n"
                           "quad b 0.5 0.005 0.9 1 0.005 0.9 1 0.005 1 0.5 0.005 1 patches 1 1 sub 1 1\n"
                           "light l point at 0.75 0.04 0.75 towards 0 -1 0 ies a.ies\n";
  TestFiles files{{"a.ies", file}};
  const SolvedScene s(text, {}, std::size_t{8} << 20, reader_of(files));
  double sum = 0;
  for (std::uint32_t k = 0; k < 16; ++k) sum += 0.25 * static_cast<double>(s.model->maps.direct_lx[k]);
  // Twelve of sixteen samples share the flux, which is the cells' to 1 %.
  EXPECT_NEAR(sum / s.model->scene.luminaires[0].lumens, 0.75, 0.0075);
}

}  // namespace
}  // namespace shodo
