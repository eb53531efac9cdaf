#include <cmath>
#include <random>

#include "ambient/form_factor.h"
#include "support/closed_factors.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

constexpr double kNearError = 5e-3;  // asked of neighbours; kSeparateError of patches apart
constexpr double kSeparateError = 1e-3;

Options exact_rows() {
  Options options;
  options.tiers = 0;
  options.scale_rows = false;
  options.row_value_bits = 64;
  return options;
}

std::string corner_list(std::initializer_list<Vec3> corners) {
  char text[100];
  std::string all;
  for (const Vec3& c : corners) {
    std::snprintf(text, sizeof text, " %.17g %.17g %.17g", c.x, c.y, c.z);
    all += text;
  }
  return all;
}

std::string quad(const std::string& name, std::initializer_list<Vec3> corners, const std::string& counts = "1 1") {
  return "object " + name + "\nquad white" + corner_list(corners) + " patches " + counts + " sub 1 1\n";
}

std::string triangle(const std::string& name, std::initializer_list<Vec3> corners) {
  return "object " + name + "\ntri white" + corner_list(corners) + " patches 1 sub 1\n";
}

/// F_ij as stored, of the first patch to the second.
double first_to_second(const std::string& text, const Options& options = exact_rows()) {
  AmbientScene scene(grey(0.5) + text, options);
  return StoredMatrix(scene).form_factor(0, 1);
}

std::string opposed_squares(double distance, const std::string& counts) {
  return quad("below", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, counts) +
         quad("above", {{0, 0, distance}, {0, 1, distance}, {1, 1, distance}, {1, 0, distance}}, counts);
}

/// From all patches of the first mesh to all of the second; both have `count` equal ones.
double mesh_to_mesh(const StoredMatrix& matrix, std::size_t count, std::size_t second) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) sum += matrix.form_factor(i, second + j) / static_cast<double>(count);
  }
  return sum;
}

TEST(FormFactor, TheFormulasGiveThePublishedValues) {
  EXPECT_NEAR(opposed(1, 1, 1), 0.1998248956983874, 1e-14);
  EXPECT_NEAR(adjacent(1, 1, 1), 0.2000437760754032, 1e-14);
  EXPECT_NEAR(opposed(1, 1, 0.001), 0.9980056319075797, 1e-10);  // cancellation in the formula
  EXPECT_NEAR(opposed(10, 6, 3), 0.4887009364, 1e-9);
  EXPECT_NEAR(adjacent(10, 6, 3), 0.1623873549, 1e-9);
  EXPECT_NEAR(adjacent(6, 10, 3), 0.0932621769, 1e-9);
}

TEST(FormFactor, FacesOfTheUnitCube) {
  AmbientScene scene(grey(0.5) + box_walls(1, 1, 1, 1, 1, 1, "white"), exact_rows());
  const StoredMatrix matrix(scene);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      const double expected = i == j ? 0 : i / 2 == j / 2 ? 0.1998248956983874 : 0.2000437760754032;
      EXPECT_NEAR(matrix.form_factor(i, j), expected, (i / 2 == j / 2 ? kSeparateError : kNearError) * 0.2);
    }
  }
}

TEST(FormFactor, WallsOfRoomsAsWholesAndInPatches) {
  for (const double tiers : {0.0, 1e-3}) {
    for (const int n : {1, 2, 5}) {
      Options options = exact_rows();
      options.tiers = tiers;
      AmbientScene scene(grey(0.5) + box_walls(10, 6, 3, n, n, n, "white"), options);
      const StoredMatrix matrix(scene);
      const std::size_t p = static_cast<std::size_t>(n * n);
      EXPECT_NEAR(mesh_to_mesh(matrix, p, p), 0.4887009364, kSeparateError * 0.4887) << n;
      EXPECT_NEAR(mesh_to_mesh(matrix, p, 2 * p), 0.1623873549, kNearError * 0.1624) << n;
      EXPECT_NEAR(mesh_to_mesh(matrix, p, 4 * p), 0.0932621769, kNearError * 0.0933) << n;
    }
  }
}

TEST(FormFactor, ClosePlatesAreNearOneAndNeverAbove) {
  EXPECT_NEAR(first_to_second(opposed_squares(0.001, "1 1")), 0.9980056319, 0.01);
  for (const double tiers : {0.0, 1e-3, 1e-2}) {
    Options options = exact_rows();
    options.tiers = tiers;
    AmbientScene scene(grey(0.5) + opposed_squares(0.001, "8 8"), options);
    const StoredMatrix matrix(scene);
    EXPECT_NEAR(mesh_to_mesh(matrix, 64, 64), 0.9980056319, 0.01) << tiers;
    for (const double f : matrix.f) EXPECT_LE(f, 1.0);
  }
}

TEST(FormFactor, FacesOfARegularTetrahedronSeeAThirdOfEachOther) {
  const Vec3 a{1, 1, 1}, b{1, -1, -1}, c{-1, 1, -1}, d{-1, -1, 1};
  const std::string text =
      triangle("f0", {a, c, b}) + triangle("f1", {a, b, d}) + triangle("f2", {a, d, c}) + triangle("f3", {b, c, d});
  for (const double tiers : {0.0, 1e-3}) {
    Options options = exact_rows();
    options.tiers = tiers;
    AmbientScene scene(grey(0.5) + text, options);
    const StoredMatrix matrix(scene);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(matrix.form_factor(i, j), i == j ? 0 : 1.0 / 3, kNearError / 3);
    }
  }
}

TEST(FormFactor, AScreenMidwayLeavesWhatGoesPastIt) {
  // The screen (half the squares' size) blocks; between 24 x 24 patches, since a screen's edge is only sampled.
  const std::string screen = "object screen\nquad black 0.25 0.25 0.5 0.75 0.25 0.5 0.75 0.75 0.5 0.25 0.75 0.5"
                             " patches 1 1 sub 1 1\n";
  AmbientScene scene(grey(0.5) + "material black diffuse 0\n" + opposed_squares(1, "12 12") + screen, exact_rows());
  const StoredMatrix matrix(scene);
  EXPECT_NEAR(mesh_to_mesh(matrix, 144, 144), 0.099506294598985, 0.005 * 0.0995);
}

TEST(FormFactor, CoplanarAndTurnedAwayPatchesExchangeExactlyNothing) {
  const Vec3 tilted_u{0.6, 0.8, 0}, tilted_v{-0.48, 0.36, 0.8};
  const auto at = [&](double u, double v) { return u * tilted_u + v * tilted_v; };
  EXPECT_EQ(first_to_second(quad("a", {at(0, 0), at(1, 0), at(1, 1), at(0, 1)}) +
                            quad("b", {at(1, 0), at(2, 0), at(2, 1), at(1, 1)})),
            0);
  EXPECT_EQ(first_to_second(quad("a", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) +
                            quad("b", {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})),
            0);
}

TEST(FormFactor, APatchThroughTheOthersPlaneCountsWithItsPartInFront) {
  // The wall stands half below the floor: what the floor sees is the upper half, an adjacent rectangle.
  const std::string floor = quad("floor_", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const std::string wall = quad("wall", {{0, 0, -1}, {0, 1, -1}, {0, 1, 1}, {0, 0, 1}});
  for (const double tiers : {0.0, 1e-3, 0.1}) {
    Options options = exact_rows();
    options.tiers = tiers;
    EXPECT_NEAR(first_to_second(floor + wall, options), adjacent(1, 1, 1), kNearError * 0.2);
    EXPECT_NEAR(first_to_second(wall + floor, options), adjacent(1, 1, 1) / 2, kNearError * 0.1);
  }
}

TEST(FormFactor, ASaddleThatAPlaneCutsTwiceStaysWithinBounds) {
  // Its corners lie above and below the floor by turns, so that two of them, and four cuts, are left of it.
  const std::string floor = quad("floor_", {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
  const std::string saddle = quad("saddle", {{-0.5, -0.5, 0.3}, {-0.5, 0.5, -0.1}, {0.5, 0.5, 0.3}, {0.5, -0.5, -0.1}});
  for (const double tiers : {0.0, 1e-3}) {
    Options options = exact_rows();
    options.tiers = tiers;
    const double f = first_to_second(saddle + floor, options);
    EXPECT_GT(f, 0);
    EXPECT_LT(f, 1);
    EXPECT_NEAR(first_to_second(floor + saddle, options) * 16, f, 0.2);  // areas 16 and about 1
  }
}

/// Slow and obvious: the kernel summed over m x m points of each of two quadrilaterals that are planar or nearly.
double summed_exchange(const Vec3* p, const Vec3* q, int m) {
  const auto place = [](const Vec3* c, double s, double t) {
    return (1 - s) * ((1 - t) * c[0] + t * c[3]) + s * ((1 - t) * c[1] + t * c[2]);
  };
  double sum = 0;
  for (int k = 0; k < m * m; ++k) {
    const double s = (k % m + 0.5) / m, t = (k / m + 0.5) / m;
    const Vec3 x = place(p, s, t), xs = (1 - t) * (p[1] - p[0]) + t * (p[2] - p[3]),
               xt = (1 - s) * (p[3] - p[0]) + s * (p[2] - p[1]), nx = cross(xs, xt);
    for (int l = 0; l < m * m; ++l) {
      const double u = (l % m + 0.5) / m, v = (l / m + 0.5) / m;
      const Vec3 y = place(q, u, v), yu = (1 - v) * (q[1] - q[0]) + v * (q[2] - q[3]),
                 yv = (1 - u) * (q[3] - q[0]) + u * (q[2] - q[1]), ny = cross(yu, yv), d = y - x;
      const double a = dot(nx, d), b = -dot(ny, d);
      if (a > 0 && b > 0) sum += a * b / (length_squared(d) * length_squared(d));
    }
  }
  return sum / (M_PI * m * m * m * m);
}

/// Two quadrilaterals about 2 apart that face one another askew; the second uneven and, by `saddle`, not planar.
void askew(std::mt19937& random, double distance, double saddle, Vec3* p, Vec3* q) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  const Vec3 towards = normalised(any());
  for (int side = 0; side < 2; ++side) {
    Vec3* c = side == 0 ? p : q;
    const Vec3 n = normalised((side == 0 ? 1.0 : -1.0) * towards + 0.5 * any());
    const Vec3 u = normalised(cross(n, any())), v = cross(n, u), centre = side * distance * towards;
    c[0] = centre - 0.5 * u - 0.5 * v;
    c[1] = centre + 0.5 * u - 0.5 * v;
    c[2] = centre + (0.5 + side * 0.2) * u + (0.5 + side * 0.1) * v + (side * saddle) * n;
    c[3] = centre - 0.5 * u + 0.5 * v;
  }
}

TEST(FormFactor, EveryTierAgreesWithPlainSummationWithinItsStatedError) {
  std::mt19937 random(20);
  for (int trial = 0; trial < 60; ++trial) {
    Vec3 p[4], q[4];
    const double distance = trial % 3 == 0 ? 2 : trial % 3 == 1 ? 4 : 15;
    askew(random, distance, trial % 2 == 0 ? 0 : 0.1, p, q);
    const std::string text = quad("a", {p[0], p[1], p[2], p[3]}) + quad("b", {q[0], q[1], q[2], q[3]});
    AmbientScene scene(grey(0.5) + text, exact_rows());
    const Surfaces surfaces = surfaces_of(scene);
    const double areas = surfaces.patch(0).area * surfaces.patch(1).area;
    const double reference = areas / (M_PI * length_squared(surfaces.patch(1).centre - surfaces.patch(0).centre));
    // 16 x 16 midpoints of both: remaining error below 1e-3 of it at distance 2, far less beyond.
    const double expected = summed_exchange(p, q, 16);
    for (const double tiers : {0.0, 1e-3, 1e-2, 0.2}) {
      const PairExchange pair = exchange_between(surfaces, row_side(surfaces, 0), 1, tiers);
      // A saddle counts with its mean normal, which costs up to the square of its bend: 0.1 of its size at distance 2.
      const double allowed = tiers + kNearTolerance + (trial % 2 == 0 ? 5e-4 : 5e-3);
      EXPECT_NEAR(pair.geometric, expected, allowed * reference) << "trial " << trial << " tiers " << tiers;
    }
  }
}

/// A twisted quadrilateral: its places, x and y from -1 to 1, and the area about each, seen along its mean normal.
struct Twisted {
  explicit Twisted(const Vec3* c)
      : centre(0.25 * ((c[0] + c[1]) + (c[2] + c[3]))), a(0.25 * ((c[1] - c[0]) + (c[2] - c[3]))),
        b(0.25 * ((c[3] - c[0]) + (c[2] - c[1]))), twist(0.25 * ((c[0] - c[1]) + (c[2] - c[3]))),
        normal(normalised(cross(a, b))) {}
  Vec3 at(double x, double y) const { return centre + x * a + y * b + (x * y) * twist; }
  double area_at(double x, double y) const { return 4 * dot(normal, cross(a + y * twist, b + x * twist)); }
  Vec3 centre, a, b, twist, normal;
};

/// Slow and obvious: the kernel of both mean normals, summed over m x m points of each.
double summed_by_mean_normals(const Twisted& p, const Twisted& q, int m) {
  const auto place = [m](int k) { return (k + 0.5) * 2 / m - 1; };
  double sum = 0;
  for (int k = 0; k < m * m; ++k) {
    const double x = place(k % m), y = place(k / m);
    for (int l = 0; l < m * m; ++l) {
      const double u = place(l % m), v = place(l / m);
      const Vec3 d = q.at(u, v) - p.at(x, y);
      sum -= p.area_at(x, y) * q.area_at(u, v) * dot(p.normal, d) * dot(q.normal, d) /
             (length_squared(d) * length_squared(d));
    }
  }
  return sum / (M_PI * m * m * m * m);
}

TEST(FormFactor, PointsOfATwistedPatchStandAtTheirHeights) {
  // Beside each other, so that a point's height counts beside the way to it. The middle tier errs by 1.4e-3 of these
  // exchanges, well below what it allows itself.
  for (const double lift : {0.5, 1.0}) {
    const Vec3 p[4] = {{0, 0, lift}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Vec3 q[4] = {{2, 2, 1}, {2, 3, 1}, {3, 3, 1 - lift}, {3, 2, 1}};
    AmbientScene scene(grey(0.5) + quad("a", {p[0], p[1], p[2], p[3]}) + quad("b", {q[0], q[1], q[2], q[3]}),
                       exact_rows());
    const Surfaces surfaces = surfaces_of(scene);
    const double expected = summed_by_mean_normals(Twisted(p), Twisted(q), 24);
    const PairExchange pair = exchange_between(surfaces, row_side(surfaces, 0), 1, 0.2);
    EXPECT_NEAR(pair.geometric, expected, 0.002 * expected) << lift;
  }
}

TEST(FormFactor, NeitherTheOrderOfPatchesNorOfVerticesMatters) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 20; ++trial) {
    Vec3 p[4], q[4];
    askew(random, 1.2 + trial * 0.3, 0, p, q);
    for (const double tiers : {0.0, 1e-3, 1e-2}) {
      Options options = exact_rows();
      options.tiers = tiers;
      const std::string a = quad("a", {p[0], p[1], p[2], p[3]}), b = quad("b", {q[0], q[1], q[2], q[3]});
      const std::string turned = quad("b", {q[2], q[3], q[0], q[1]});
      const double f = first_to_second(a + b, options);
      AmbientScene swapped(grey(0.5) + b + a, options);
      EXPECT_EQ(StoredMatrix(swapped).form_factor(1, 0), f) << trial;
      // Turning the corners turns the order of sums: equal but for rounding.
      EXPECT_NEAR(first_to_second(a + turned, options), f, 1e-12 * f + 1e-18) << trial;
    }
  }
}

TEST(FormFactor, AConcaveQuadrilateralCountsAsItsTwoTriangles) {
  const std::string floor = quad("floor_", {{-1, -1, -1}, {2, -1, -1}, {2, 2, -1}, {-1, 2, -1}});
  // An arrowhead that faces down.
  const Vec3 a{0, 0, 0}, b{0.3, 0.3, 0}, c{1, 0, 0}, d{0, 1, 0};
  const double whole = first_to_second(quad("arrow", {a, d, b, c}) + floor);
  AmbientScene halves(grey(0.5) + triangle("t1", {a, d, b}) + triangle("t2", {a, b, c}) + floor, exact_rows());
  const StoredMatrix matrix(halves);
  // Both halves are equal in area, so the mean of their factors is the whole's.
  EXPECT_NEAR(whole, (matrix.form_factor(0, 2) + matrix.form_factor(1, 2)) / 2, 1e-3 * whole);
  EXPECT_GT(whole, 0.3);
}

TEST(FormFactor, AnArmOfAConcavePatchBeyondTheOthersPlaneIsSeen) {
  // Of an arrowhead with thin arms, all of one arm but a tenth, and a tenth of an arm.
  const Vec3 a{-1, 0, 0}, b{0, 0.3, 0}, c{1, 0, 0}, d{-0.05, 0.28, 0};
  for (const double x : {-0.1, -0.9, -0.98, 0.98}) {
    const std::string wall = quad("wall", {{x, -2, 1}, {x, 2, 1}, {x, 2, 3}, {x, -2, 3}});
    AmbientScene scene(grey(0.5) + quad("arrow", {a, d, c, b}) + wall, exact_rows());
    const Surfaces surfaces = surfaces_of(scene);
    EXPECT_TRUE(exchange_between(surfaces, row_side(surfaces, 0), 1, 1e-3).crossing) << x;
  }
}

}  // namespace
}  // namespace shodo
