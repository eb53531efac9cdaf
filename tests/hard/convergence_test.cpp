// How fast errors fall with patches, segments and tolerance: orders of convergence, fitted over a sweep, on scenes
// whose answers are known in closed form; and that the solver's bound is never below the true error.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "support/closed_factors.h"
#include "support/eliminated.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo::hard {
namespace {

/// The slope of log y over log x, by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double a = std::log(x[k]), b = std::log(std::fmax(y[k], 1e-300));
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void print(const char* what, const std::vector<double>& x, const std::vector<double>& y) {
  std::printf("             %s: order %.2f;", what, slope(x, y));
  for (std::size_t k = 0; k < x.size(); ++k) std::printf(" %g: %.3g", x[k], y[k]);
  std::printf("\n");
}

/// A sphere of radius 1 cut into 2 n x n quadrilaterals, fronts inwards.
std::string sphere(int n, double rho) {
  const int columns = 2 * n;
  std::string text = grey(rho) + "object sphere\n";
  const auto at = [&](int i, int j) {
    const double theta = M_PI * j / n, phi = 2 * M_PI * (i % columns) / columns;
    const double s = j == 0 || j == n ? 0 : std::sin(theta), z = j == 0 ? -1 : j == n ? 1 : -std::cos(theta);
    return " " + number(s * std::cos(phi)) + " " + number(s * std::sin(phi)) + " " + number(z);
  };
  text += "grid white " + std::to_string(columns + 1) + " " + std::to_string(n + 1);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= columns; ++i) text += at(i, j);
  }
  return text + "\nsub sphere 1 1\n";
}

TEST(Convergence, InASphereAmbientLightIsUniformToTheSquareOfThePatchSize) {
  // In a sphere F_ij = A_j / 4 pi, whatever i: one lit spot gives every patch the same ambient illuminance, rho times
  // the flux over the area over 1 - rho. What remains is that the patches are flat.
  std::vector<double> sizes, errors;
  for (const int n : {4, 6, 8, 12}) {
    Options options = to_the_last_digits();
    options.tolerance = 1e-9;
    AmbientScene scene(sphere(n, 0.5), options);
    scene.light([](const Vec3& p, std::uint32_t) { return p.z > 0.3 ? 1000 * p.z * p.z : 0; });
    ASSERT_TRUE(scene.solve().done());
    double flux = 0, area = 0;
    for (std::size_t i = 0; i < scene.patches.size(); ++i) {
      flux += scene.patches[i].area * scene.lux[i];
      area += scene.patches[i].area;
    }
    const double expected = 0.5 * flux / area / 0.5;
    double squares = 0;
    for (std::size_t i = 0; i < scene.patches.size(); ++i) {
      const double off = scene.ambient.patch_lx[i] - expected;
      squares += scene.patches[i].area * off * off;
    }
    sizes.push_back(1.0 / n);
    errors.push_back(std::sqrt(squares / area) / expected);
  }
  print("patch size, sphere", sizes, errors);
  EXPECT_GT(slope(sizes, errors), 1.5);
  EXPECT_LT(errors.back(), 0.02);
}

/// Of a floor 2 x 2 of reflectance rho under an isotropic light of 1 cd at (0, 0, h): the illuminance at (x, y, top) of
/// a ceiling, by a rule of 200 x 200 points, right to 1e-8.
double from_floor(double x, double y, double top, double h) {
  constexpr int kPoints = 200;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      const double u = -1 + 2 * (i + 0.5) / kPoints, v = -1 + 2 * (j + 0.5) / kPoints;
      const double d2 = u * u + v * v + h * h, e = h / (d2 * std::sqrt(d2));
      const double r2 = (x - u) * (x - u) + (y - v) * (y - v) + top * top;
      sum += e * top * top / (M_PI * r2 * r2);
    }
  }
  return 0.5 * sum * 4 / (kPoints * kPoints);
}

TEST(Convergence, LightFromALitFloorIsRightToTheSquareOfThePatchSize) {
  // One reflection from a floor to a black ceiling: the map's values against a fine summation.
  std::vector<double> sizes, errors;
  for (const int n : {3, 6, 12, 24}) {
    SceneText scene;
    scene.material("white", 0.5);
    scene.material("black", 0);
    scene.object("floor");
    scene.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, n, n, 1);
    scene.object("ceiling");
    scene.use("black");
    scene.quad({-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}, n, n, 1);
    scene.point_light({0, 0, 0.6}, 1);
    Options options = to_the_last_digits();
    options.tolerance = 1e-10;
    const FullRun run(scene.text(), options);
    ASSERT_TRUE(run.done());
    double squares = 0, sum = 0;
    for (std::uint32_t i = 0; i < run.mesh(1).patch_count(); ++i) {
      const Vec3 c = run.model().patches[run.mesh(1).first_patch + i].centre;
      const double expected = from_floor(c.x + run.model().scene.origin.x, c.y + run.model().scene.origin.y, 1, 0.6);
      const double off = run.ambient(run.mesh(1).first_patch + i) - expected;
      squares += off * off;
      sum += expected;
    }
    const double count = run.mesh(1).patch_count();
    sizes.push_back(2.0 / n);
    errors.push_back(std::sqrt(squares / count) / (sum / count));
  }
  print("patch size, one reflection", sizes, errors);
  EXPECT_GT(slope(sizes, errors), 1.7);
}

TEST(Convergence, PartlyBlockedFormFactorsGetBetterWithSegments) {
  // Two plates with a screen between that hides a part, patch by patch exactly nothing or by halves: the exchange of
  // all patches against Howell's of what goes past the screen. Over several places of the screen, the root mean square.
  std::vector<double> counts, errors;
  for (const std::uint32_t segments : {1u, 16u, 64u, 256u}) {
    double squares = 0;
    int scenes = 0;
    for (const double edge : {0.13, 0.29, 0.37, 0.46, 0.58, 0.71, 0.83}) {
      Options options = to_the_last_digits();
      options.scale_rows = false;
      options.segments_first = options.segments_mixed = segments;
      SceneText scene;
      scene.material("white", 0.5);
      scene.object("below");
      scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2, 2);
      scene.object("above");
      scene.quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, 2, 2);
      scene.object("screen");
      // Hides what crosses x < edge half-way up; wide enough that nothing passes its other sides.
      scene.quad({-3, -3, 0.5}, {edge, -3, 0.5}, {edge, 4, 0.5}, {-3, 4, 0.5});
      AmbientScene placed(scene.text(), options);
      const StoredMatrix stored(placed);
      double f = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 4; j < 8; ++j) f += stored.form_factor(i, j) / 4;
      }
      // By summation: segments from (x0, y0) below to (x1, y1) above pass where x0 + x1 > 2 edge.
      constexpr int kN = 40;
      double expected = 0;
      for (int a = 0; a < kN; ++a) {
        for (int b = 0; b < kN; ++b) {
          const double x0 = (a + 0.5) / kN, x1 = (b + 0.5) / kN;
          const double passes = std::fmin(1, std::fmax(0, (x0 + x1 - 2 * edge) * kN + 0.5));
          if (passes == 0) continue;
          // Over y in closed form of the difference: its density is 1 - |d|.
          double along = 0;
          for (int d = 0; d < kN; ++d) {
            const double y = (d + 0.5) / kN, r2 = (x0 - x1) * (x0 - x1) + y * y + 1;
            along += 2 * (1 - y) / (M_PI * r2 * r2) / kN;
          }
          expected += passes * along / (kN * kN);
        }
      }
      squares += relative(f, expected) * relative(f, expected);
      ++scenes;
    }
    counts.push_back(segments);
    errors.push_back(std::sqrt(squares / scenes));
  }
  print("segments", counts, errors);
  // A grid in four dimensions across an edge: N^(-1/4) were it random in one of them, N^(-1/2) if errors cancel.
  EXPECT_LT(slope(counts, errors), -0.25);
  EXPECT_LT(errors.back(), 0.05);
}

TEST(Convergence, TheErrorFollowsTheToleranceAndTheBoundIsNeverBelowIt) {
  // Hard scenes, all reflectances, all tolerances: against elimination of the stored system in long double.
  const std::string box = box_walls(4, 3, 2.5, 3, 2, 3, "white");
  const std::string corridor = box_walls(1, 1, 30, 1, 1, 12, "white");
  const std::string scenes[] = {box,
                                corridor,
                                box +
                                    "object plates\nquad white 1 1 1  2 1 1  2 2 1  1 2 1 patches 2 2 sub 1 1\n"
                                    "quad white 1 1 1.001  1 2 1.001  2 2 1.001  2 1 1.001 patches 2 2 sub 1 1\n",
                                sphere(5, 0.5).substr(grey(0.5).size()),
                                "object open\nquad white 0 0 0  1 0 0  1 1 0  0 1 0 patches 5 5 sub 1 1\n"
                                "quad white 0 0 0  0 0 1  1 0 1  1 0 0 patches 5 5 sub 1 1\n",
                                "object strips\nquad white 0 0 0  1 0 0  1 1 0  0 1 0 patches 40 1 sub 1 1\n"
                                "quad white 0 0 1e-3  0 1 1e-3  1 1 1e-3  1 0 1e-3 patches 1 40 sub 1 1\n"};
  std::vector<double> tolerances, worst;
  std::uint32_t sweeps = 0;
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8}) {
    double largest = 0;
    for (const std::string& text : scenes) {
      for (const double rho : {0.3, 0.9, 0.99, 0.9999}) {
        Options options;
        options.tolerance = tolerance;
        AmbientScene scene(grey(rho) + text, options);
        scene.light([](const Vec3& p, std::uint32_t m) { return m == 0 ? 100 + 50 * p.x : 0; });
        ASSERT_TRUE(scene.solve().done());
        const Statistics counted = scene.statistics;
        const double error = true_error(scene);
        EXPECT_LE(error, counted.solution_bound + 1e-15) << rho << ", " << tolerance << ": " << text.substr(0, 30);
        EXPECT_LE(counted.solution_bound, std::max(tolerance, 1e-9)) << rho;
        EXPECT_LT(counted.sweeps, 60u) << rho << ", " << tolerance << ": " << text.substr(0, 30);
        sweeps = std::max(sweeps, counted.sweeps);
        largest = std::fmax(largest, error);
      }
    }
    tolerances.push_back(tolerance);
    worst.push_back(largest);
  }
  print("tolerance", tolerances, worst);
  std::printf("             at most %u sweeps\n", sweeps);
  EXPECT_GT(slope(tolerances, worst), 0.8);
  EXPECT_LT(slope(tolerances, worst), 1.3);
}

TEST(Convergence, DirectLightOfAShadowsEdgeIsRightToTheSizeOfTheSubPatch) {
  // The lit area beside a shadow's edge is a sub-patch off at most, in sixteenths.
  std::vector<double> sizes, errors;
  for (const int sub : {1, 2, 4, 8}) {
    double squares = 0;
    int scenes = 0;
    for (const double edge : {0.117, 0.281, 0.333, 0.468, 0.592, 0.731, 0.861}) {
      SceneText scene;
      scene.material("white", 0);
      scene.object("floor");
      scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 4, 4, sub);
      scene.object("roof");
      scene.quad({-1, -1, 1}, {edge, -1, 1}, {edge + 0.2, 2, 1}, {-1, 2, 1});
      scene.sun({0, 0, -1}, 1000);
      const FullRun run(scene.text());
      ASSERT_TRUE(run.done());
      const double lit = 1 - (edge + 0.2 * 0.5);  // the edge at y = 0.5
      const double off = run.mean(0) / 1000 - (lit - 0);
      squares += off * off;
      ++scenes;
    }
    sizes.push_back(0.25 / sub);
    errors.push_back(std::sqrt(squares / scenes));
  }
  print("sub-patch size, a shadow's edge", sizes, errors);
  EXPECT_GT(slope(sizes, errors), 0.7);
}

}  // namespace
}  // namespace shodo::hard
