#include <cmath>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "hard/stability.h"
#include "support/closed_factors.h"
#include "support/eliminated.h"
#include "tests/ambient/ambient_scene.h"
#include "visibility/scenes.h"

namespace shodo::hard {

namespace {

/// The furnace E0 / (1 - rho): rows scaled, against rows as they are computed.
std::vector<SweepPoint> reflectance() {
  std::vector<SweepPoint> points;
  for (const double left : {1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4}) {
    SweepPoint point{left, 0, 0};
    for (const bool scaled : {true, false}) {
      Options options;
      options.tolerance = 1e-9;
      options.scale_rows = scaled;
      AmbientScene scene(
          "shodo 1\nmaterial white diffuse " + number(1 - left) + "\n" + box_walls(3, 2, 1, 3, 4, 2, "white"), options);
      scene.light([](const Vec3&, std::uint32_t) { return 1.0; });
      EXPECT_TRUE(scene.solve().done());
      double worst = 0;
      for (std::size_t i = 0; i < scene.patches.size(); ++i) {
        worst = std::fmax(worst, std::fabs(scene.total(i) * left - 1));
      }
      (scaled ? point.ours : point.textbook) = worst;
    }
    points.push_back(point);
  }
  return points;
}

/// Plates 1 x 1 at a distance: F against Howell C-11, and the kernel between centres.
std::vector<SweepPoint> plates() {
  std::vector<SweepPoint> points;
  for (double d = 100; d > 0.9e-4; d /= std::sqrt(10)) {
    const std::string z = number(d);
    Options options;
    options.scale_rows = false;
    options.row_value_bits = 64;
    AmbientScene scene(grey(0.5) +
                           "object a\nquad white 0 0 0  1 0 0  1 1 0  0 1 0 patches 1 1\nobject b\nquad white 0 0 " +
                           z + "  0 1 " + z + "  1 1 " + z + "  1 0 " + z + " patches 1 1\n",
                       options);
    const double f = StoredMatrix(scene).form_factor(0, 1);
    // Howell's formula cancels where plates are far apart: 1 / (pi d^2) and its next term there.
    const double expected = d > 30 ? (1 - 2 / (3 * d * d)) / (M_PI * d * d) : near_plates(d);
    points.push_back({d, relative(f, expected), relative(1 / (M_PI * d * d), expected)});
  }
  return points;
}

/// A textbook's segment test: Moeller and Trumbore 1997 in double, on the file's own coordinates.
bool moller_trumbore(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c, double epsilon) {
  const Vec3 d = q - p, e1 = b - a, e2 = c - a, h = cross(d, e2);
  const double det = dot(e1, h);
  if (det > -1e-14 && det < 1e-14) return false;
  const Vec3 s = p - a;
  const double u = dot(s, h) / det;
  if (u < 0 || u > 1) return false;
  const Vec3 w = cross(s, e1);
  const double v = dot(d, w) / det;
  if (v < 0 || u + v > 1) return false;
  const double t = dot(e2, w) / det;
  return t > epsilon && t < 1 - epsilon;
}

/// A lit and a dark room with a wall between, turned; the part of the wall's samples that see the wrong room or lose
/// their own.
std::vector<SweepPoint> walls() {
  std::vector<SweepPoint> points;
  for (double thickness = 1e-1; thickness > 0.9e-11; thickness /= 10) {
    Random random(3);
    std::uint64_t samples = 0, ours = 0, textbook = 0;
    for (int k = 0; k < 10; ++k) {
      HandMadeScene scene;
      const Vec3 axis{random.signed_unit(), random.signed_unit(), 1.1};
      const double angle = 3 * random.signed_unit();
      const double x0 = 2, x1 = 2 + thickness;
      scene.box({0, 0, 0}, {x1 + 2, 3, 2}, true);
      const std::uint32_t lit = scene.quad({x0, 0, 0}, {x0, 0, 2}, {x0, 3, 2}, {x0, 3, 0});
      const std::uint32_t dark = scene.quad({x1, 0, 0}, {x1, 3, 0}, {x1, 3, 2}, {x1, 0, 2});
      scene.transform([&](const Vec3& v) { return turned(v, axis, angle); });
      scene.place();
      std::vector<Vec3> corners;
      for (const Vec3& v : scene.scene.vertices) corners.push_back(v + scene.scene.origin);
      for (int s = 0; s < 200; ++s) {
        const auto inside = [&](double x) {
          return turned({x, 0.2 + 2.6 * random.unit(), 0.2 + 1.6 * random.unit()}, axis, angle);
        };
        const Vec3 left = inside(0.2 + 1.6 * random.unit()), right = inside(x1 + 0.2 + 1.6 * random.unit());
        for (const std::uint32_t m : {lit, dark}) {
          const Piece cell = cell_piece(scene.scene, scene.scene.meshes[m], 0);
          const Vec3 at = cell.point(0.05 + 0.9 * random.unit(), 0.05 + 0.9 * random.unit());
          const LatticePoint p = sample_point(scene.scene, scene.geometry, m, 0, at);
          for (const bool blocked : {false, true}) {
            const Vec3& light = (m == lit) != blocked ? left : right;
            Intersector intersector(scene.geometry);
            const LatticePoint q = odd_point(scene.geometry.lattice, light - scene.scene.origin);
            ++samples;
            ours += intersector.blocked(p, q, {}) != blocked ? 1 : 0;
            // The textbook starts 1e-6 of the way from the surface.
            bool hit = false;
            const Vec3 from = at + scene.scene.origin;
            for (std::uint32_t quad = 0; quad < corners.size() / 4 && !hit; ++quad) {
              const Vec3* c = &corners[4 * quad];
              hit = moller_trumbore(from, light, c[0], c[1], c[2], 1e-6) ||
                    moller_trumbore(from, light, c[0], c[2], c[3], 1e-6);
            }
            textbook += hit != blocked ? 1 : 0;
          }
        }
      }
    }
    const double n = static_cast<double>(samples);
    points.push_back({thickness / 5.4, static_cast<double>(ours) / n, static_cast<double>(textbook) / n});
  }
  return points;
}

/// A screen of the scene's middle third between two plates, the scene scaled: E of the plate beyond against the
/// unscaled one, and the part of segments that a test with a fixed epsilon of 1e-4 units decides otherwise.
std::vector<SweepPoint> scales() {
  std::vector<SweepPoint> points;
  const auto make = [](double s) {
    SceneText scene([=](const Vec3& v) { return s * v; });
    scene.material("white", 0.7);
    scene.object("room");
    scene.room({0, 0, 0}, {1, 2, 3}, 3, 2);
    scene.area_light({0.25, 1.5, 2.875}, {0.25, 1.75, 2.875}, {0.75, 1.75, 2.875}, {0.75, 1.5, 2.875}, 1000);
    return scene.text();
  };
  const FullRun still(make(1), to_the_last_digits());
  for (double s = 1e-6; s < 1.1e6; s *= 10) {
    const FullRun run(make(s), to_the_last_digits());
    Random random(5);
    int wrong = 0;
    constexpr int kSegments = 4000;
    for (int k = 0; k < kSegments; ++k) {
      // From a floor through a table's plate 0.01 above it, or past it.
      const Vec3 p{s * random.unit(), s * random.unit(), 0}, q{s * random.unit(), s * random.unit(), s};
      const Vec3 a{0.3 * s, 0.3 * s, 0.01 * s}, b{0.7 * s, 0.3 * s, 0.01 * s}, c{0.7 * s, 0.7 * s, 0.01 * s},
          d{0.3 * s, 0.7 * s, 0.01 * s};
      const double x = p.x + 0.01 * (q.x - p.x), y = p.y + 0.01 * (q.y - p.y);
      const bool blocked = x > a.x && x < c.x && y > a.y && y < c.y;
      // Distances along the segment in scene units, as a fixed epsilon takes them.
      const double epsilon = 1e-4 / length(q - p);
      const bool hit = moller_trumbore(p, q, a, b, c, epsilon) || moller_trumbore(p, q, a, c, d, epsilon);
      wrong += hit != blocked ? 1 : 0;
    }
    points.push_back({s, difference(still, run), static_cast<double>(wrong) / kSegments});
  }
  return points;
}

/// The same room moved: E, by an inexact shift; and the side of a plane by N . P - N . A in single precision.
std::vector<SweepPoint> offsets() {
  std::vector<SweepPoint> points;
  const FullRun still(bare_room_moved(0), to_the_last_digits());
  for (double far = 1; far < 1.1e9; far *= 10) {
    const FullRun run(bare_room_moved(far), to_the_last_digits());
    // The height of the lamp over the floor, a sixth of the room's, by the plane's equation in float.
    const float n[3] = {0.6f, 0, 0.8f};
    const auto of = [&](double x, double z) {
      return n[0] * static_cast<float>(far + x) + n[2] * static_cast<float>(far + z);
    };
    const double height = static_cast<double>(of(0.2, 0.5) - of(0, 0));
    points.push_back({far, difference(still, run), relative(height, 0.6 * 0.2 + 0.8 * 0.5)});
  }
  return points;
}

/// Strips of 1 x w at the foot of a wall: the largest error of their row sums; and of their form factor to the floor by
/// the kernel between centres.
std::vector<SweepPoint> slivers() {
  std::vector<SweepPoint> points;
  for (double width = 0.1; width > 0.9e-6; width /= std::sqrt(10)) {
    const int strips = width > 0.03 ? 5 : 20;
    SceneText scene;
    scene.material("white", 0.8);
    scene.object("room");
    cube_with_strips(scene, strips, width);
    Options options;
    options.scale_rows = false;
    AmbientScene placed(scene.text(), options);
    const StoredMatrix stored(placed);
    SweepPoint point{1 / width, 0, 0};
    for (std::size_t i = 0; i < stored.n; ++i) {
      if (placed.patches[i].dropped != 0) continue;
      point.ours = std::fmax(point.ours, std::fabs(stored.row_sum(i) - 1));
      double sum = 0;
      for (std::size_t j = 0; j < stored.n; ++j) {
        const Vec3 r = placed.patches[j].centre - placed.patches[i].centre;
        const double d2 = dot(r, r), ci = dot(placed.patches[i].normal, r), cj = -dot(placed.patches[j].normal, r);
        if (j != i && ci > 0 && cj > 0) sum += ci * cj * placed.patches[j].area / (M_PI * d2 * d2);
      }
      point.textbook = std::fmax(point.textbook, std::fabs(sum - 1));
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace

const std::vector<Sweep>& sweeps() {
  static const std::vector<Sweep> all{
      {"reflectance", "Furnace near reflectance 1", "1 - reflectance", "relative error of E", "rows not scaled",
       reflectance, 1e-6, 0, 1e9},
      {"plates", "Plates at a distance", "distance of unit plates", "relative error of F", "kernel between centres",
       plates, 1e-2, 0, 1e9},
      {"walls", "Thin walls", "thickness, of the scene's size", "part of samples that see wrong",
       "Moeller-Trumbore, epsilon 1e-6", walls, 1e-2, 0, 1e9},
      {"scales", "Scale", "scene units per unit", "relative error", "segments with a fixed epsilon of 1e-4", scales,
       1e-12, 0, 1e9},
      {"offsets", "Far from the origin", "offset, of the size", "relative error", "plane equation in single precision",
       offsets, 1e-5, 0, 1e9},
      {"slivers", "Slivers", "length over width", "largest error of a row sum", "kernel between centres", slivers, 1e-2,
       0, 1e5},
  };
  return all;
}

}  // namespace shodo::hard
