// Bundles of lines against trying every triangle on every line: exact edge tests in 64 bits, fractions in 128.
#include "visibility/line_bundle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "visibility/scenes.h"
#include "visibility/slow_twin.h"

namespace shodo {
namespace {

using twin::Wide;
using Point = std::array<std::int32_t, 3>;

Point numbers(const LatticePoint& p) { return {p.x, p.y, p.z}; }
LatticePoint point_of(const Point& p) { return {p[0], p[1], p[2]}; }

/// So many steps a unit, whatever the scene's size: small scenes have few lines of the least spacing.
constexpr double kExtent = 400, kSteps = 1024;

/// Boxes, touching ones and such that stand on the floor too, in a closed room of 4 units.
void build_boxes(HandMadeScene& scene, Random& random, int count) {
  const auto eighth = [&] { return random.below(25) / 8.0; };
  scene.box({0, 0, 0}, {4, 4, 4}, true);
  for (int k = 0; k < count; ++k) {
    const Vec3 low{eighth(), eighth(), k % 3 == 0 ? 0 : eighth()};
    scene.box(low, low + Vec3{0.125 + 0.25 * eighth(), 0.5, 0.125 + 0.25 * eighth()});
  }
}

/// Besides, loose triangles, a sheet with two faces, a concave quad, bent ones and an area light.
void build(HandMadeScene& scene, std::uint64_t seed) {
  Random random(seed);
  build_boxes(scene, random, 5);
  const auto anywhere = [&] { return Vec3{4 * random.unit(), 4 * random.unit(), 4 * random.unit()}; };
  for (int k = 0; k < 6; ++k) scene.triangle(anywhere(), anywhere(), anywhere());
  scene.quad({1, 1, 0.5}, {2, 1, 0.5}, {2, 2, 0.5}, {1, 2, 0.5});
  scene.quad({1, 1, 0.5}, {1, 2, 0.5}, {2, 2, 0.5}, {2, 1, 0.5});
  scene.quad({3, 1, 1}, {3.5, 1.25, 1}, {3.5, 1.25, 3}, {3, 1, 3});
  scene.quad({1, 3, 1}, {2, 3, 1}, {2, 3.5, 2}, {1, 3, 2});
  // Sloping along two axes.
  scene.quad({0.5, 3, 2.5}, {0.5, 3.5, 2.5}, {1, 3.5, 3}, {1, 3, 3});
  scene.quad({2.5, 3, 2.5}, {3, 3, 2.5}, {3, 3.5, 3.25}, {2.5, 3.5, 3.25});
  scene.quad({2.5, 2, 2.5}, {3.25, 2.5, 2.5}, {3.25, 2.5, 3}, {2.5, 2, 3});
  scene.mesh(scene.quad({2, 0.5, 3.5}, {3.5, 0.5, 3.5}, {2.5, 1, 3.5}, {2, 2, 3.5})).cut = true;
  scene.grid(3, 3, {{0.5, 0.5, 2}, {1, 0.5, 2.1}, {1.5, 0.5, 2}, {0.5, 1, 2.1}, {1, 1, 2.3}, {1.5, 1, 2.1},
                    {0.5, 1.5, 2}, {1, 1.5, 2.1}, {1.5, 1.5, 2}});
  scene.area_light({1, 1, 3.75}, {1, 2, 3.75}, {2, 2, 3.75}, {2, 1, 3.75});
  scene.place(kExtent);
}

/// Corners of some lie on sides of others.
void build_junctions(HandMadeScene& scene) {
  scene.quad({0, 0, 0}, {9, 0, 0}, {9, 4, 0}, {0, 4, 0});
  scene.quad({0, 4, 0}, {2, 8, 0}, {7, 8, 0}, {9, 4, 0});
  scene.quad({0, 0, 0}, {0, 4, 0.3}, {-1, 4.2, 3}, {-1, 0.1, 2});
  for (int k = 0; k < 3; ++k) {
    const double x = 1 + 2 * k;
    scene.quad({x, 4, 0}, {x + 1, 4, 0}, {x + 1, 4, 3}, {x, 4, 3});
    scene.quad({x, 0, 0}, {x, 0, 2}, {x + 1, 0, 2}, {x + 1, 0, 0});
    scene.triangle({x, 4, 3}, {x + 1, 4, 3}, {x + 0.3, 5, 2.7});
  }
  // A concave one: sides go straight on after they have turned back.
  scene.mesh(scene.quad({14, 0, 0}, {17, 6, 0}, {14, 2, 0}, {11, 6, 0})).cut = true;
  scene.triangle({16.25, 5, 0}, {14.75, 3, 0}, {15.5, 4, 2});
  scene.triangle({13.25, 3, 0}, {11.75, 5, 0}, {12.5, 4, 2});
  scene.place(kExtent);
}

/// What the triangles of a scene are to each other.
struct Facts {
  explicit Facts(const Geometry& of) : geometry(of) {
    const std::size_t count = of.triangles.size();
    unit.resize(count);
    across.resize(count);
    for (std::uint32_t t = 0; t < count; ++t) unit[t] = t;
    for (const std::span<PolygonTriangles> all : {of.cells, of.light_triangles}) {
      for (const PolygonTriangles& polygon : all) join(polygon);
    }
    for (std::uint32_t t = 0; t < count; ++t) {
      for (int k = 0; k < 3; ++k) {
        for (std::uint32_t other = 0; other < count; ++other) {
          for (int j = 0; j < 3; ++j) {
            if (corner(other, j) == corner(t, k + 1) && corner(other, j + 1) == corner(t, k)) {
              across[t][k].push_back(other);
            }
          }
        }
      }
    }
  }
  const LatticePoint& corner(std::uint32_t t, int k) const {
    const Triangle& triangle = geometry.triangles[t];
    return k % 3 == 0 ? triangle.a : k % 3 == 1 ? triangle.b : triangle.c;
  }
  LatticeVector normal(std::uint32_t t) const {
    return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
  }

  const Geometry& geometry;
  std::vector<std::uint32_t> unit;  // triangles in one plane of one polygon: one of them
  std::vector<std::array<std::vector<std::uint32_t>, 3>> across;  // those that have an edge the other way round

 private:
  void join(const PolygonTriangles& polygon) {
    std::uint32_t first = kNone;
    for (std::uint32_t t = polygon.first; t < polygon.first + polygon.count; ++t) {
      if (first == kNone && !(normal(t) == LatticeVector{})) first = t;
    }
    for (std::uint32_t t = polygon.first; t < polygon.first + polygon.count; ++t) {
      const twin::WideVector n = twin::of(normal(first)), own = twin::of(normal(t));
      if (twin::dot(n, own) < 0) return;
      for (int k = 0; k < 3; ++k) {
        if (twin::dot(n, twin::of(corner(t, k) - corner(first, 0))) != 0) return;
      }
    }
    for (std::uint32_t t = polygon.first; t < polygon.first + polygon.count; ++t) unit[t] = first;
  }
};

/// Lines through a scene that has been placed.
struct Sweep {
  explicit Sweep(HandMadeScene& scene) : facts(scene.geometry) {
    EXPECT_TRUE(scene.status.done());
    EXPECT_TRUE(lines.take(scene.geometry, scene.arena, scene.arena));
  }

  const Facts facts;
  LineBundle lines;
};

struct Reported {
  std::uint32_t triangle;
  bool up;
  std::int32_t at;
  LatticePoint point;
};

/// All of a bundle, by the lines' starts.
using Lines = std::map<Point, std::vector<Reported>>;

struct Counts {
  std::uint64_t lines = 0, crossings = 0, on_edges = 0, ties = 0, restarts = 0;
};

class Bundle {
 public:
  explicit Bundle(Sweep& sweep) : facts_(sweep.facts), bundle_(sweep.lines) {}

  void aim(const Vec3& direction, double spacing, double shift_y, double shift_z) {
    bundle_.aim(direction, spacing, shift_y, shift_z);
    const double way[3] = {direction.x, direction.y, direction.z};
    axis_ = 0;
    for (int k = 1; k < 3; ++k) axis_ = std::fabs(way[k]) > std::fabs(way[axis_]) ? k : axis_;
    y_ = (axis_ + 1) % 3;
    z_ = (axis_ + 2) % 3;
    direction_ = bundle_.direction();
    const std::int64_t found[3] = {direction_.x, direction_.y, direction_.z};
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(found[k], std::lround(1024 * (way[k] / way[axis_])));
      slope_[k] = static_cast<std::int32_t>(found[k]);
    }
    const double longer = length(vector_of(direction_)) / 1024;
    step_ = static_cast<std::int32_t>(std::lround(std::clamp(spacing * std::sqrt(longer), 64.0, 524288.0)));
    shift_z_ = static_cast<std::int32_t>(std::lround(shift_z * step_));
    across_ = step_ * (step_ / longer);
  }

  /// All lines, and what holds between those that are told together and after each other.
  void collect() {
    std::vector<std::int64_t> next(bundle_.polygons(), INT64_MIN);
    std::int32_t row_before = INT32_MIN;
    while (bundle_.next_row()) {
      std::int32_t row = INT32_MIN, line_before = INT32_MIN;
      while (bundle_.next_lines()) {
        ASSERT_GT(bundle_.lines(), 0u);
        const auto order = bundle_.order();
        ASSERT_LE(order.size(), bundle_.polygons());
        const Point start = numbers(bundle_.start());
        if (line_before != INT32_MIN) {
          ASSERT_GT(start[y_], line_before);
          ASSERT_EQ((start[y_] - line_before) % step_, 0);
        }
        if (row == INT32_MIN) {
          row = start[z_];
          ASSERT_EQ((row - shift_z_) % step_, 0);
          if (row_before != INT32_MIN) {
            ASSERT_GT(row, row_before);
          }
          row_before = row;
          rows_[row] = start[y_];
          next.assign(next.size(), INT64_MIN);
        }
        for (std::uint32_t k = 0; k < bundle_.lines(); ++k) {
          const Point at = numbers(bundle_.start(k));
          ASSERT_EQ(at[axis_], 0);
          ASSERT_EQ(at[z_], row);
          ASSERT_EQ(at[y_], start[y_] + static_cast<std::int32_t>(k) * step_);
          ASSERT_TRUE(lines_.emplace(at, std::vector<Reported>()).second);
        }
        line_before = start[y_] + static_cast<std::int32_t>(bundle_.lines() - 1) * step_;
        for (const std::uint32_t number : order) {
          ASSERT_LT(number, bundle_.polygons());
          follow(number, next[number]);
        }
      }
    }
  }

  /// Every line against every triangle.
  void check(Counts& counts) {
    std::int64_t low_y = INT64_MAX, high_y = INT64_MIN, low_z = INT64_MAX, high_z = INT64_MIN;
    for (std::uint32_t t = 0; t < facts_.unit.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const Point p = numbers(facts_.corner(t, k));
        const std::int64_t y = std::int64_t{p[y_]} * 1024 - std::int64_t{p[axis_]} * slope_[y_];
        const std::int64_t z = std::int64_t{p[z_]} * 1024 - std::int64_t{p[axis_]} * slope_[z_];
        low_y = std::min(low_y, y), high_y = std::max(high_y, y);
        low_z = std::min(low_z, z), high_z = std::max(high_z, z);
      }
    }
    low_row_ = low_z, high_row_ = high_z;
    std::uint64_t seen = 0;
    for (const auto& [row, some_line] : rows_) {
      const std::int64_t before = (some_line - low_y / 1024) / step_ + 2;
      for (std::int64_t y = some_line - before * step_; y * 1024 <= high_y + 1024; y += step_) {
        Point start{};
        start[y_] = static_cast<std::int32_t>(y);
        start[z_] = row;
        const auto found = lines_.find(start);
        seen += found != lines_.end() ? 1 : 0;
        check_line(start, found == lines_.end() ? std::vector<Reported>() : found->second, counts);
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
    ASSERT_EQ(seen, lines_.size());
  }

  /// None of the rows over what stands is left out; where something closed stands around everything.
  void expect_all_rows() const {
    std::int64_t row = (low_row_ / 1024 - shift_z_) / step_ - 2;
    while ((shift_z_ + row * step_) * 1024 < low_row_) ++row;
    std::size_t count = 0;
    for (; (shift_z_ + row * step_) * 1024 < high_row_; ++row, ++count) {
      ASSERT_EQ(rows_.count(static_cast<std::int32_t>(shift_z_ + row * step_)), 1u);
    }
    ASSERT_EQ(count, rows_.size());
  }

  const Lines& lines() const { return lines_; }
  const LatticeVector& direction() const { return direction_; }
  /// Square steps across the direction, for each line.
  double across() const { return across_; }

 private:
  /// A crossing on the lines at work; `next`: what its `at` is now, if it isn't fresh.
  void follow(std::uint32_t number, std::int64_t& next) {
    LineBundle::Crossing& crossing = bundle_.crossing(number);
    if (!crossing.fresh) {
      ASSERT_EQ(crossing.at, next);
    }
    crossing.fresh = false;
    next = crossing.at + std::int64_t{bundle_.lines()} * crossing.step;
    const Point way = numbers(bundle_.way(crossing));
    Point before{};
    const Point first = numbers(bundle_.point(crossing));
    for (std::uint32_t k = 0; k < bundle_.lines(); ++k) {
      const LatticePoint there = bundle_.point(crossing, k);
      const Point point = numbers(there);
      for (int c = 0; c < 3 && k > 0; ++c) {
        // Points and the way are rounded down, to a step and to 2^-10.
        ASSERT_LE(std::fabs(point[c] - before[c] - way[c] / kSteps), 1 + 2 / kSteps);
        ASSERT_LE(std::fabs(point[c] - first[c] - k * (way[c] / kSteps)), 1 + (k + 1) / kSteps);
      }
      before = point;
      lines_[numbers(bundle_.start(k))].push_back(
          {crossing.triangle, crossing.up, static_cast<std::int32_t>(crossing.at + std::int64_t{k} * crossing.step),
           there});
    }
  }

  /// Where a line meets the plane of a triangle: at from + (numerator / denominator) direction; denominator above 0.
  struct Meeting {
    Wide numerator, denominator;
    bool up;
  };
  Meeting plane(const LatticePoint& from, std::uint32_t t) const {
    const twin::WideVector n = twin::of(facts_.normal(t));
    const Wide over = twin::dot(n, twin::of(facts_.corner(t, 0) - from)), along = twin::dot(n, twin::of(direction_));
    return {along < 0 ? -over : over, twin::absolute(along), along > 0};
  }

  /// A line on an edge of a triangle crosses it if lines further along the row do; or in further rows if it runs along.
  bool begins(Point start, std::uint32_t t, int edge, bool up) const {
    for (const int further : {y_, z_}) {
      ++start[further];
      const LatticePoint from = point_of(start);
      const LatticeVector a = facts_.corner(t, edge) - from, b = facts_.corner(t, edge + 1) - from;
      const std::int64_t side = dot(direction_, cross(a, b));
      if (side != 0) return (side > 0) == up;
      --start[further];
    }
    return false;
  }

  void check_line(const Point& start, const std::vector<Reported>& found, Counts& counts) {
    const LatticePoint from = point_of(start);
    ++counts.lines;
    counts.crossings += found.size();
    const std::size_t count = facts_.unit.size();
    times_.assign(count, 0);
    touched_.assign(count, false);
    for (const Reported& crossing : found) ++times_[facts_.unit[crossing.triangle]];
    for (std::uint32_t t = 0; t < count; ++t) {
      const LatticeVector a = facts_.corner(t, 0) - from, b = facts_.corner(t, 1) - from;
      const LatticeVector c = facts_.corner(t, 2) - from;
      const std::int64_t side[3] = {dot(direction_, cross(a, b)), dot(direction_, cross(b, c)),
                                    dot(direction_, cross(c, a))};
      const std::int64_t along = side[0] + side[1] + side[2];  // the normal's part
      if (along == 0) continue;
      int inside = 0, on = 0, edge = 0;
      for (int k = 0; k < 3; ++k) {
        if (side[k] == 0) ++on, edge = k;
        if (side[k] != 0 && (side[k] > 0) == (along > 0)) ++inside;
      }
      if (inside + on < 3) continue;
      touched_[facts_.unit[t]] = true;
      const int times = times_[facts_.unit[t]];
      ASSERT_LE(times, 1);
      if (inside == 3) {
        ASSERT_EQ(times, 1);
      }
      if (on != 1) continue;
      const std::uint32_t t_unit = facts_.unit[t];
      const auto& others = facts_.across[t][edge];
      const auto inner = [&](std::uint32_t other) { return facts_.unit[other] == t_unit; };
      if (std::none_of(others.begin(), others.end(), inner)) {
        ASSERT_EQ(times, begins(start, t, edge, along > 0) ? 1 : 0);
      }
      // What lies beyond the edge is crossed instead, or, where it turns back, too.
      for (const std::uint32_t beyond : facts_.across[t][edge]) {
        const std::int64_t other = dot(direction_, facts_.normal(beyond));
        if (other == 0) continue;
        ++counts.on_edges;
        if (facts_.unit[beyond] == facts_.unit[t]) {
          ASSERT_EQ(times, 1);
        } else if ((other > 0) == (along > 0)) {
          ASSERT_EQ(times + times_[facts_.unit[beyond]], 1);
        } else {
          ASSERT_EQ(times, times_[facts_.unit[beyond]]);
        }
      }
    }
    Meeting before{};
    for (std::size_t k = 0; k < found.size(); ++k) {
      const Reported& crossing = found[k];
      ASSERT_TRUE(touched_[facts_.unit[crossing.triangle]]);
      const Meeting here = plane(from, crossing.triangle);
      ASSERT_EQ(crossing.up, here.up);
      if (k > 0) {
        const Wide one = before.numerator * here.denominator, other = here.numerator * before.denominator;
        ASSERT_LE(one, other);
        if (one == other) {
          ASSERT_FALSE(before.up && !here.up);
          ++counts.ties;
        }
      }
      before = here;
      const double part = static_cast<double>(here.numerator) / static_cast<double>(here.denominator);
      ASSERT_LE(std::fabs(crossing.at / kSteps - 1024 * part), 1);  // what the header says
      const Point point = numbers(crossing.point);
      for (int c = 0; c < 3; ++c) {
        ASSERT_LE(std::fabs(point[c] - (start[c] + slope_[c] * part)), 2);  // rounded down besides
      }
    }
  }

  const Facts& facts_;
  LineBundle& bundle_;
  Lines lines_;
  std::map<std::int32_t, std::int32_t> rows_;  // a line of each
  std::vector<int> times_;
  std::vector<bool> touched_;
  LatticeVector direction_;
  std::int32_t slope_[3] = {0, 0, 0}, step_ = 1, shift_z_ = 0;
  std::int64_t low_row_ = 0, high_row_ = 0;
  double across_ = 1;
  int axis_ = 0, y_ = 1, z_ = 2;
};

/// Along axes, on diagonals, nearly along faces, and anywhere.
std::vector<Vec3> directions(std::uint64_t seed, int anywhere) {
  std::vector<Vec3> all = {{0, 0, 1},  {-1, 0, 0},         {0, 1, 0},          {1, 1, 0},
                           {1, -1, 1}, {0, -0.002, -0.9}, {1, 0.001, -0.001}, {0.003, 1, 0.5}};
  Random random(seed);
  for (int k = 0; k < anywhere; ++k) all.push_back({random.signed_unit(), random.signed_unit(), random.signed_unit()});
  return all;
}

/// The scene in bundles of all directions; `least` spacing, or more.
void expect_as_every_triangle(HandMadeScene& scene, std::uint64_t seed, int anywhere, double least, bool closed,
                              Counts& counts) {
  Sweep sweep(scene);
  Random random(seed);
  int number = 0;
  for (const Vec3& direction : directions(seed, anywhere)) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ", direction " << number);
    const double spacing = number % 2 == 0 ? least : least * (1 + random.unit());
    // Unshifted rows of even spacing run along edges.
    const double shift_y = number % 3 == 0 ? random.below(2) : random.unit();
    const double shift_z = number % 4 < 3 ? random.below(2) : random.unit();
    ++number;
    Bundle bundle(sweep);
    bundle.aim(direction, spacing, shift_y, shift_z);
    bundle.collect();
    if (::testing::Test::HasFatalFailure()) return;
    bundle.check(counts);
    if (closed) bundle.expect_all_rows();
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(LineBundle, CrossesWhatTryingEveryTriangleFinds) {
  Counts counts;
  for (int seed = 0; seed < soaked(6); ++seed) {
    HandMadeScene scene;
    build(scene, static_cast<std::uint64_t>(seed));
    expect_as_every_triangle(scene, static_cast<std::uint64_t>(seed), 4, seed == 0 ? 1 : 96, true, counts);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(counts.lines, 60000u);
  EXPECT_GT(counts.crossings, 200000u);
  EXPECT_GT(counts.on_edges, 300u);
  EXPECT_GT(counts.ties, 3000u);
}

TEST(LineBundle, CrossesPolygonsWithInsertedVertices) {
  Counts counts;
  HandMadeScene scene;
  build_junctions(scene);
  ASSERT_GE(scene.geometry.inserted, 12u);
  expect_as_every_triangle(scene, 11, 4, 64, false, counts);
  EXPECT_GT(counts.on_edges, 100u);
}

/// The cube of the lattice is full, so that numbers are as large as they get; few lines.
TEST(LineBundle, CrossesWhatFillsTheLattice) {
  Counts counts;
  for (const double spacing : {16384.0, 262144.0, 1e9}) {
    for (std::uint64_t seed = 20; seed < 22; ++seed) {
      HandMadeScene scene;
      build(scene, seed);
      scene.transform([](const Vec3& v) { return 262136.0 * (v - Vec3{2, 2, 2}); });
      scene.place(kLatticeHalf);
      ASSERT_EQ(scene.geometry.lattice.steps_per_unit, 1);
      expect_as_every_triangle(scene, seed, 3, spacing, true, counts);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(counts.crossings, 20000u);
}

/// A wall nearly along the lines: two neighbouring ones cross it more than half the lattice apart.
TEST(LineBundle, CrossesWhatLiesNearlyAlongTheLines) {
  Counts counts;
  HandMadeScene scene;
  const double far = kLatticeHalf - 1;
  scene.quad({-far, 0, -2000}, {far, 0, -2000}, {far, 0, 2000}, {-far, 0, 2000});
  for (int k = -4; k < 5; ++k) {
    const double x = 1e5 * k;
    scene.quad({x, -2000, -2000}, {x, 2000, -2000}, {x, 2000, 2000}, {x, -2000, 2000});
  }
  scene.place(kLatticeHalf);
  Sweep sweep(scene);
  for (const double slope : {1.0, -1.0, 2.0, 3.0}) {
    for (const double spacing : {600.0, 900.0}) {
      for (int k = 0; k < 4; ++k) {
        Bundle bundle(sweep);
        bundle.aim({1, slope / 1024, 0}, spacing, 0.25 * k, 0.3);
        bundle.collect();
        bundle.check(counts);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(counts.crossings, 1000u);
}

/// Rows of some 3000 lines over a floor on a slope.
TEST(LineBundle, StaysOnALongRow) {
  Counts counts;
  HandMadeScene scene;
  // Straight along its axis a line leaves it 5243.535 / 1024 steps lower than the one before: far from what is kept.
  scene.quad({-100000, -700, -9000}, {100000, -700, 7002}, {100000, 500, 7102}, {-100000, 500, -8900});
  scene.quad({-90000, -600, 9000}, {-80000, 600, -9000}, {90000, 600, 3000}, {80000, -600, 4000});
  scene.place(kLatticeHalf);
  Sweep sweep(scene);
  std::size_t most = 0;
  for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{0.03, 0.01, 1}, Vec3{-0.4, 0.3, -1}, Vec3{0, 0.7, 1}}) {
    Bundle bundle(sweep);
    bundle.aim(direction, 64, 0.1, 0.8);
    bundle.collect();
    bundle.check(counts);
    if (HasFatalFailure()) return;
    std::map<std::int32_t, std::size_t> rows;
    for (const auto& [start, crossings] : bundle.lines()) most = std::max(most, ++rows[start[1]]);
  }
  EXPECT_GT(most, 2500u);
}

/// Thousands of short rows over edges that are stepped from each to the next, and on which some lines lie.
TEST(LineBundle, CutsATallSceneRowByRow) {
  Counts counts;
  HandMadeScene scene;
  scene.quad({0, 0, -200000}, {0, 900, -200000}, {0, 300, 200000}, {0, -500, 200000});
  scene.quad({0, 0, -200000}, {0, -100, -200000}, {0, -600, 200000}, {0, -500, 200000});
  scene.triangle({300, 0, -190000}, {340, 700, -189998}, {400, 350, 199998});
  Random random(9);
  for (int k = 0; k < 40; ++k) {
    // Two that share a side of a slope of a third, a fifth or a seventh.
    const double x = 400 + 20 * k, z = 2 * random.between(-95000, 95000);
    const double wide = 2 * random.between(100, 300), by = 3 + 2 * random.below(3);
    const Vec3 low{x, 0, z}, high{x, wide, z + by * wide};
    scene.triangle(low, {x, 800, z + 200}, high);
    scene.triangle(high, {x, -200, z + 400}, low);
  }
  scene.place(kLatticeHalf);
  Sweep sweep(scene);
  for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{1, 0.1, 0.01}, Vec3{-1, 0.25, 0}}) {
    Bundle bundle(sweep);
    bundle.aim(direction, 64, 0.1, 0.8);
    bundle.collect();
    bundle.check(counts);
    if (HasFatalFailure()) return;
    bundle.expect_all_rows();
  }
  EXPECT_GT(counts.on_edges, 10u);
}

/// Fronts of a room look inwards: a line comes in through one and leaves through another, at an edge in one point.
TEST(LineBundle, PassesAPlainRoomTwice) {
  HandMadeScene scene;
  scene.box({0, 0, 0}, {4, 3, 2}, true);
  scene.place(kExtent);
  Sweep sweep(scene);
  EXPECT_EQ(sweep.lines.polygons(), 6u);
  EXPECT_EQ(LineBundle::bytes(scene.geometry).polygons, 6u);
  std::size_t on_edges = 0;
  for (const Vec3& direction : directions(31, 12)) {
    Bundle bundle(sweep);
    bundle.aim(direction, 64, 0, 0.5);
    bundle.collect();
    if (HasFatalFailure()) return;
    ASSERT_GT(bundle.lines().size(), 1000u);
    for (const auto& [start, crossings] : bundle.lines()) {
      ASSERT_EQ(crossings.size(), 2u);
      ASSERT_NE(crossings[0].up, crossings[1].up);
      if (!crossings[0].up) {
        ASSERT_EQ(crossings[0].point, crossings[1].point);
        ++on_edges;
      }
    }
  }
  EXPECT_LT(on_edges, 100u);
}

/// Everything is closed: each line crosses as many fronts as backs, and before the first thing it is outside.
TEST(LineBundle, PassesClosedBoxesEvenly) {
  for (std::uint64_t seed = 40; seed < 44; ++seed) {
    HandMadeScene scene;
    Random random(seed);
    build_boxes(scene, random, 12);
    scene.place(kExtent);
    Sweep sweep(scene);
    for (const Vec3& direction : directions(seed, 3)) {
      Bundle bundle(sweep);
      bundle.aim(direction, 64, 0.5, 0);
      bundle.collect();
      if (HasFatalFailure()) return;
      for (const auto& [start, crossings] : bundle.lines()) {
        int level = 0;
        for (const Reported& crossing : crossings) level += crossing.up ? 1 : -1;
        ASSERT_EQ(level, 0);
      }
    }
  }
}

/// As many lines cross as there are their squares in what polygons cover across the direction.
TEST(LineBundle, CrossesPolygonsByTheirProjectedAreas) {
  HandMadeScene scene;
  build(scene, 50);
  Sweep sweep(scene);
  for (const Vec3& direction : directions(50, 8)) {
    Bundle bundle(sweep);
    bundle.aim(direction, 64, 0.3, 0.6);
    bundle.collect();
    if (HasFatalFailure()) return;
    const Vec3 along = normalised(vector_of(bundle.direction()));
    double area = 0, crossed = 0;
    for (std::uint32_t t = 0; t < sweep.facts.unit.size(); ++t) {
      area += 0.5 * std::fabs(dot(vector_of(sweep.facts.normal(t)), along));
    }
    for (const auto& [start, crossings] : bundle.lines()) crossed += static_cast<double>(crossings.size());
    // Borders of a room 64 lines wide; what is seen edge on has no others.
    EXPECT_NEAR(crossed * bundle.across() / area, 1, 0.01) << direction.x << ' ' << direction.y << ' ' << direction.z;
  }
}

TEST(LineBundle, IsTheSameWhenAimedAgain) {
  HandMadeScene scene;
  build(scene, 60);
  Sweep sweep(scene);
  const auto all = [&] {
    Bundle bundle(sweep);
    bundle.aim({0.3, -0.8, 0.4}, 80, 0.2, 0.9);
    bundle.collect();
    return bundle.lines();
  };
  const auto same = [](const Lines& a, const Lines& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
      return one.first == other.first &&
             std::equal(one.second.begin(), one.second.end(), other.second.begin(), other.second.end(),
                        [](const Reported& x, const Reported& y) {
                          return x.triangle == y.triangle && x.up == y.up && x.at == y.at && x.point == y.point;
                        });
    });
  };
  const Lines first = all();
  ASSERT_GT(first.size(), 1000u);
  EXPECT_TRUE(same(first, all()));
  // After another direction, left in the middle of a row.
  sweep.lines.aim({1, 0.2, 0.1}, 64, 0, 0);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(sweep.lines.next_row());
  ASSERT_TRUE(sweep.lines.next_lines());
  EXPECT_TRUE(same(first, all()));
}

TEST(LineBundle, CrossesWhatIsFoldedByItsTriangles) {
  HandMadeScene scene;
  scene.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 0, 0});
  scene.quad({0, 0, 1}, {2, 0, 1}, {2, 0, 1}, {0, 0, 1});  // no area
  scene.place(kExtent);
  Sweep sweep(scene);
  EXPECT_EQ(sweep.lines.polygons(), 2u);
}

/// Straight through a floor and a ceiling.
TEST(LineBundle, CountsRowsTimesThePolygonsThatTheyCut) {
  HandMadeScene scene;
  scene.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
  scene.quad({0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3});
  scene.place(kExtent);
  Sweep sweep(scene);
  std::uint64_t rows = 0;
  for (int bundle = 1; bundle < 3; ++bundle) {
    sweep.lines.aim({0, 0, 1}, 64, 0.5, 0.5);
    while (sweep.lines.next_row()) ++rows;
    EXPECT_EQ(rows, bundle * 64u);
    EXPECT_EQ(sweep.lines.tests(), 2 * rows);
  }
}

TEST(LineBundle, HasAsManyBytesAsItSays) {
  HandMadeScene scene;
  build(scene, 70);
  ASSERT_TRUE(scene.status.done());
  const LineBundle::Bytes bytes = LineBundle::bytes(scene.geometry);
  std::vector<std::uint64_t> memory(bytes.rest / 8), elsewhere(bytes.cuts / 8);
  LineBundle lines;
  Arena enough(memory.data(), bytes.rest), small(memory.data(), bytes.rest - 8);
  Arena for_cuts(elsewhere.data(), bytes.cuts), small_for_cuts(elsewhere.data(), bytes.cuts - 8);
  EXPECT_TRUE(lines.take(scene.geometry, enough, for_cuts));
  EXPECT_EQ(enough.used(), bytes.rest);
  EXPECT_EQ(for_cuts.used(), bytes.cuts);
  EXPECT_EQ(lines.polygons(), bytes.polygons);
  enough.release(0);
  EXPECT_FALSE(lines.take(scene.geometry, enough, small_for_cuts));
  enough.release(0);
  for_cuts.release(0);
  EXPECT_FALSE(lines.take(scene.geometry, small, for_cuts));
}

TEST(LineBundle, WhereNothingStandsNoRowIs) {
  HandMadeScene scene;
  scene.place(1);
  ASSERT_TRUE(scene.status.done());
  LineBundle lines;
  ASSERT_TRUE(lines.take(scene.geometry, scene.arena, scene.arena));
  EXPECT_EQ(lines.polygons(), 0u);
  lines.aim({1, -1, 0.5}, 64, 0.5, 0.5);
  EXPECT_FALSE(lines.next_row());
  EXPECT_EQ(lines.tests(), 0u);
}

}  // namespace
}  // namespace shodo
