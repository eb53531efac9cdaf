// No light through seams: segments from inside closed surfaces to the outside, aimed at their edges and vertices.
#include <gtest/gtest.h>

#include <functional>

#include "support/aimed_segments.h"
#include "support/cut_wall.h"

namespace shodo {
namespace {

/// Segments that graze the surface of object 0, from one of its samples, aimed at the lowest few steps of the seam
/// where object 1 ends on it. Only those can pass under a partition: the surface is plane, but for its rounding. Both
/// ends are strictly in front of every triangle of object 0.
Leaks graze(const HandMadeScene& scene, const Where& where, int segments, std::uint64_t seed) {
  const Geometry& geometry = scene.geometry;
  std::vector<const Triangle*> ground, standing;
  for (const Triangle& t : geometry.triangles) (t.object == 0 ? ground : standing).push_back(&t);
  const auto in_front = [&](const LatticePoint& p) {
    for (const Triangle* t : ground) {
      if (t->side(p) <= 0) return false;
    }
    return inside_cube(p);
  };
  Random random(seed);
  Intersector intersector(geometry);
  Leaks result;
  for (int attempt = 0; attempt < 60 * segments && result.segments < static_cast<std::uint64_t>(segments); ++attempt) {
    const Triangle& t = *standing[random.below(static_cast<std::uint32_t>(standing.size()))];
    const LatticePoint* corner[3] = {&t.a, &t.b, &t.c};
    const std::uint32_t k = random.below(3);
    const LatticePoint &a = *corner[k], &b = *corner[(k + 1) % 3];
    const double s = random.unit();
    const LatticePoint at{a.x + static_cast<std::int32_t>(std::lround(s * (b.x - a.x))) + random.between(-2, 2),
                          a.y + static_cast<std::int32_t>(std::lround(s * (b.y - a.y))) + random.between(-2, 2),
                          a.z + static_cast<std::int32_t>(std::lround(s * (b.z - a.z))) + random.between(-2, 2)};
    const std::uint32_t m = random.below(scene.scene.objects[0].mesh_count);
    const Piece floor = cell_piece(scene.scene, scene.scene.meshes[m], 0);
    const LatticePoint p = sample_point(scene.scene, geometry, m, 0, floor.point(random.unit(), random.unit()));
    const LatticePoint q{2 * at.x - p.x, 2 * at.y - p.y, 2 * at.z - p.z};
    const LatticePoint r{at.x + (at.x - p.x) / 4, at.y + (at.y - p.y) / 4, at.z + (at.z - p.z) / 4};
    for (const LatticePoint& end : {q, r}) {
      if (!in_front(p) || !in_front(end)) continue;
      const int side_p = where(p), side_end = where(end);
      if (side_p == 0 || side_end == 0 || side_p == side_end) continue;
      ++result.segments;
      result.leaks += intersector.blocked(p, end, {}) ? 0 : 1;
    }
  }
  return result;
}

/// The same between samples of one plane of object 0, on both sides of object 1.
Leaks along_surface(const HandMadeScene& scene, const Where& where, int segments, std::uint64_t seed) {
  Random random(seed);
  Intersector intersector(scene.geometry);
  Leaks result;
  const std::uint32_t meshes = scene.scene.objects[0].mesh_count;
  for (int attempt = 0; attempt < 30 * segments && result.segments < static_cast<std::uint64_t>(segments); ++attempt) {
    const std::uint32_t m[2] = {random.below(meshes), random.below(meshes)};
    const Piece piece[2] = {cell_piece(scene.scene, scene.scene.meshes[m[0]], 0),
                            cell_piece(scene.scene, scene.scene.meshes[m[1]], 0)};
    if (dot(normalised(piece[0].vector_area()), normalised(piece[1].vector_area())) < 0.999) continue;
    LatticePoint end[2];
    for (int k = 0; k < 2; ++k) {
      end[k] = sample_point(scene.scene, scene.geometry, m[k], 0, piece[k].point(random.unit(), random.unit()));
    }
    const int side_p = where(end[0]), side_q = where(end[1]);
    if (side_p == 0 || side_q == 0 || side_p == side_q) continue;
    ++result.segments;
    result.leaks += intersector.blocked(end[0], end[1], {}) ? 0 : 1;
  }
  return result;
}

struct Turn {
  Vec3 axis;
  double angle;
  Vec3 there(const Vec3& v) const { return turned(v, axis, angle); }
  Vec3 back(const Vec3& v) const { return turned(v, axis, -angle); }
};

Turn random_turn(Random& random) {
  return {{random.signed_unit(), random.signed_unit(), random.signed_unit() + 0.01}, 3 * random.signed_unit()};
}

/// Inside a box of the scene's own coordinates, before it was turned; `clear` in scene units.
Where in_box(const HandMadeScene& scene, const Turn& turn, const Vec3& low, const Vec3& high, double clear) {
  return [&scene, turn, low, high, clear](const LatticePoint& p) {
    const Vec3 v = turn.back(scene_point(scene.geometry.lattice, p) + scene.scene.origin);
    const auto least = [&](double margin) {
      return v.x >= low.x + margin && v.y >= low.y + margin && v.z >= low.z + margin && v.x <= high.x - margin &&
             v.y <= high.y - margin && v.z <= high.z - margin;
    };
    return least(clear) ? 1 : least(-clear) ? 0 : -1;
  };
}

/// 40 steps: more than mending moves anything.
double clearance(const HandMadeScene& scene) { return 40 * scene.geometry.lattice.step(); }

/// A closed box, fronts inwards, whose six walls are divided differently: T-junctions along every edge.
void divided_box(HandMadeScene& scene, const Vec3& size) {
  const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  cut_wall(scene, {}, z, x, 1, 3);
  cut_wall(scene, y, x, z, 5, 2);
  cut_wall(scene, {}, x, y, 5, 3);
  cut_wall(scene, z, y, x, 4, 3);
  cut_wall(scene, {}, y, z, 2, 7);
  cut_wall(scene, x, z, y, 3, 4);
}

TEST(Leaks, NoneFromATurnedBoxThroughItsEdges) {
  HandMadeScene scene;
  const Turn turn{{1, 2, 3}, 0.1};
  scene.box({1, 1, 1}, {4, 3, 2});
  scene.point_light({7, 7, 7});
  scene.transform([&](const Vec3& v) { return turn.there(v); });
  scene.place();
  const Leaks leaks = shoot(scene.geometry, in_box(scene, turn, {1, 1, 1}, {4, 3, 2}, clearance(scene)), 20000, 1);
  EXPECT_EQ(leaks.segments, 20000u);
  EXPECT_EQ(leaks.leaks, 0u);
  EXPECT_EQ(scene.geometry.inserted, 0u);
  EXPECT_EQ(scene.geometry.moved, 0u);
}

TEST(Leaks, NoneThroughTheTJunctionsOfDividedWalls) {
  Random random(3);
  Leaks all;
  for (int k = 0; k < 60; ++k) {
    HandMadeScene scene;
    const Turn turn = random_turn(random);
    const Vec3 size{1 + 3 * random.unit(), 1 + 3 * random.unit(), 1 + 3 * random.unit()};
    divided_box(scene, size);
    scene.point_light({-1.7, 5, 5});
    scene.transform([&](const Vec3& v) { return turn.there(v); });
    scene.place();
    ASSERT_TRUE(scene.status.done());
    const Leaks leaks = shoot(scene.geometry, in_box(scene, turn, {}, size, clearance(scene)), 500, random.next());
    all.segments += leaks.segments;
    all.leaks += leaks.leaks;
  }
  EXPECT_GT(all.segments, 10000u);
  EXPECT_EQ(all.leaks, 0u);
  RecordProperty("segments", static_cast<int>(all.segments));
}

/// A closed space of a scene before it is turned.
struct Space {
  Vec3 low, high;
  bool stands_on_object_0 = false;
  Vec3 graze_low, graze_high;  // the same without the borders that are object 0's
};

/// Runs `count` turned scenes made by `make`.
Leaks turned_scenes(int count, int segments, std::uint64_t seed,
                    const std::function<void(HandMadeScene&, Random&, Space&)>& make) {
  Random random(seed);
  segments = soaked(segments);
  Leaks all;
  int leaky = 0;
  for (int k = 0; k < count; ++k) {
    HandMadeScene scene;
    scene.arena_bytes = std::size_t{1} << 18;
    const Turn turn = random_turn(random);
    Space space;
    make(scene, random, space);
    scene.transform([&](const Vec3& v) { return turn.there(v); });
    scene.place();
    EXPECT_TRUE(scene.status.done()) << scene.status.message;
    const Where where = in_box(scene, turn, space.low, space.high, clearance(scene));
    const Leaks leaks = shoot(scene.geometry, where, segments, random.next());
    Leaks grazing;
    if (space.stands_on_object_0) {
      const Where beside = in_box(scene, turn, space.graze_low, space.graze_high, clearance(scene));
      grazing = graze(scene, beside, segments, random.next());
      const Leaks along = along_surface(scene, beside, segments, random.next());
      grazing.segments += along.segments;
      grazing.leaks += along.leaks;
    }
    all.segments += leaks.segments + grazing.segments;
    all.leaks += leaks.leaks + grazing.leaks;
    leaky += leaks.leaks + grazing.leaks > 0 ? 1 : 0;
  }
  std::printf("             %d scenes, %llu segments, %llu leaks in %d scenes\n", count,
              static_cast<unsigned long long>(all.segments), static_cast<unsigned long long>(all.leaks), leaky);
  return all;
}

/// A room's six walls, fronts inwards.
void room(HandMadeScene& scene, const Vec3& size) { scene.box({}, size, true); }

TEST(Leaks, NoneWhereAPartitionEndsOnTheWallsOfARoom) {
  const Leaks all = turned_scenes(2000, 100, 5, [](HandMadeScene& scene, Random& random, Space& space) {
    const Vec3 size{2 + random.unit(), 2 + random.unit(), 2 + random.unit()};
    room(scene, size);
    const double x = 0.3 + random.unit();
    scene.object();
    scene.quad({x, 0, 0}, {x, size.y, 0}, {x, size.y, size.z}, {x, 0, size.z});
    space = {{}, {x, size.y, size.z}, true, {-9, -9, -9}, {x, 9, 9}};
  });
  EXPECT_GT(all.segments, 200000u);
  EXPECT_EQ(all.leaks, 0u);
}

TEST(Leaks, NoneWhereACabinetWithoutABackStandsOnAWall) {
  const Leaks all = turned_scenes(2000, 100, 6, [](HandMadeScene& scene, Random& random, Space& space) {
    room(scene, {3, 3, 3});
    const Vec3 low{0.2 + random.unit(), 0.2 + random.unit(), 0};
    const Vec3 high = low + Vec3{0.3 + random.unit(), 0.3 + random.unit(), 0.2 + random.unit()};
    const Vec3 a{low.x, low.y, 0}, b{high.x, low.y, 0}, c{high.x, high.y, 0}, d{low.x, high.y, 0}, up{0, 0, high.z};
    scene.object();
    scene.quad(a, b, b + up, a + up);
    scene.quad(b, c, c + up, b + up);
    scene.quad(c, d, d + up, c + up);
    scene.quad(d, a, a + up, d + up);
    scene.quad(a + up, b + up, c + up, d + up);
    space = {low, high, true, {low.x, low.y, -9}, high};
  });
  EXPECT_GT(all.segments, 100000u);
  EXPECT_EQ(all.leaks, 0u);
}

TEST(Leaks, NoneWhereAPartitionStandsAcrossAFloorOfManyCells) {
  const Leaks all = turned_scenes(60, 100, 7, [](HandMadeScene& scene, Random& random, Space& space) {
    const Vec3 size{2 + random.unit(), 2 + random.unit(), 2 + random.unit()};
    divided_box(scene, size);
    const double x = 0.3 + random.unit();
    scene.object();
    scene.quad({x, 0, 0}, {x, size.y, 0}, {x, size.y, size.z}, {x, 0, size.z});
    space = {{}, {x, size.y, size.z}, true, {-9, -9, -9}, {x, 9, 9}};
  });
  EXPECT_GT(all.segments, 10000u);
  EXPECT_EQ(all.leaks, 0u);
}

TEST(Leaks, NoneWhereCornersAreComputedTwoWays) {
  // Every face of the box has its own copies of the corners, up to 0.9 steps apart: they round at most one even step
  // apart.
  const Leaks all = turned_scenes(500, 100, 8, [](HandMadeScene& scene, Random& random, Space& space) {
    space.high = {1 + random.unit(), 1 + random.unit(), 1 + random.unit()};
    scene.box(space.low, space.high);
    scene.transform([&](const Vec3& v) {
      const double e = 0.45 / (1 << 18);  // the scene is 3 high, so a unit has 2^18 steps
      return v + Vec3{e * random.signed_unit(), e * random.signed_unit(), e * random.signed_unit()};
    });
    scene.point_light({3, 3, 3});
  });
  EXPECT_GT(all.segments, 30000u);
  EXPECT_EQ(all.leaks, 0u);
}

TEST(Leaks, NoneFromASphere) {
  HandMadeScene scene;
  constexpr int kColumns = 24, kRows = 12;
  std::vector<Vec3> vertices;
  for (int r = 0; r <= kRows; ++r) {
    for (int c = 0; c <= kColumns; ++c) {
      const double theta = 3.14159265358979 * r / kRows, phi = 2 * 3.14159265358979 * (c % kColumns) / kColumns;
      const double s = r == 0 || r == kRows ? 0 : std::sin(theta);  // the poles are cells with two equal corners
      vertices.push_back({s * std::cos(phi), s * std::sin(phi), std::cos(theta)});
    }
  }
  scene.grid(kColumns + 1, kRows + 1, vertices);
  scene.point_light({3, 3, 3});
  scene.place();
  const Where where = [&](const LatticePoint& p) {
    const double r = length(scene_point(scene.geometry.lattice, p) + scene.scene.origin);
    return r < 0.95 ? 1 : r > 1.001 ? -1 : 0;
  };
  const Leaks leaks = shoot(scene.geometry, where, 30000, 9);
  EXPECT_GT(leaks.segments, 10000u);
  EXPECT_EQ(leaks.leaks, 0u);
}

}  // namespace
}  // namespace shodo
