// Scenes on the lattice: what blocks, what is drawn, and what rounding may not change.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "scenes.h"

namespace shodo {
namespace {

using Corner = std::tuple<int, int, int>;
Corner key(const LatticePoint& p) { return {p.x, p.y, p.z}; }

/// Adds the three directed edges of a triangle; opposite ones cancel.
void add_edges(std::map<std::pair<Corner, Corner>, int>& edges, const LatticePoint& a, const LatticePoint& b,
               const LatticePoint& c) {
  const Corner v[3] = {key(a), key(b), key(c)};
  for (int k = 0; k < 3; ++k) {
    const Corner &from = v[k], &to = v[(k + 1) % 3];
    if (from < to) {
      ++edges[{from, to}];
    } else if (to < from) {
      --edges[{to, from}];
    }
  }
}

std::size_t open_edges(const std::map<std::pair<Corner, Corner>, int>& edges) {
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.second != 0; }));
}

/// A closed frustum, fronts outwards: four sides that are no parallelograms, each divided differently, and one of them
/// in two quads, so that there are T-junctions as well.
void frustum(HandMadeScene& scene) {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{4, 3, 0}, d{0, 3, 0};
  const Vec3 e{1, 0.7, 2}, f{3.3, 0.7, 2}, g{3.3, 2.2, 2}, h{1, 2.2, 2};
  scene.quad(a, d, c, b, 4, 5);
  scene.quad(e, f, g, h, 3, 3);
  scene.quad(a, b, f, e, 5, 3, 2, 2);
  scene.quad(b, c, g, f, 2, 4, 3, 1);
  const Vec3 m = 0.5 * (c + d), n = 0.5 * (g + h);
  scene.quad(c, m, n, g, 1, 7);
  scene.quad(m, d, h, n, 3, 2);
  scene.quad(d, a, e, h, 4, 1);
}

TEST(Placement, TrianglesOfAClosedSurfaceCloseEdgeByEdge) {
  Random random(1);
  for (int k = 0; k < 40; ++k) {
    HandMadeScene scene;
    frustum(scene);
    const Vec3 axis{random.signed_unit(), random.signed_unit(), 1.1};
    const double angle = k == 0 ? 0 : 3 * random.signed_unit();
    scene.transform([&](const Vec3& v) { return turned(v, axis, angle); });
    scene.place();
    ASSERT_TRUE(scene.status.done());
    std::map<std::pair<Corner, Corner>, int> blocking, drawn;
    for (const Triangle& t : scene.geometry.triangles) add_edges(blocking, t.a, t.b, t.c);
    for (const DrawnTriangle& t : scene.geometry.drawn) add_edges(drawn, t.vertex[0], t.vertex[1], t.vertex[2]);
    EXPECT_EQ(open_edges(blocking), 0u);
    EXPECT_EQ(open_edges(drawn), 0u);
    EXPECT_GE(scene.geometry.inserted, 2u);
  }
}

TEST(Placement, DrawnTrianglesCoverTheirPolygonAndItsMapOnce) {
  HandMadeScene scene;
  scene.quad({0, 0, 0}, {8, 0, 0}, {6, 4, 0}, {1, 4, 0}, 4, 2, 2, 2);  // a trapezium: patch by patch
  scene.quad({0, 5, 0}, {8, 5, 0}, {8, 9, 0}, {0, 9, 0}, 4, 2, 2, 3);  // a parallelogram: its own two
  scene.triangle({0, 10, 0}, {8, 10, 0}, {0, 14, 0}, 4, 2);
  scene.grid(3, 2, {{10, 0, 0}, {11, 0, 0}, {13, 0, 0}, {10, 2, 0}, {11, 3, 0}, {13, 2, 0}}, 2, 3, 1, 2);
  scene.quad({8, 6, 0}, {9, 6, 0}, {9, 7, 0}, {8, 7, 0});  // a T-junction in the second's edge
  scene.place();
  ASSERT_TRUE(scene.status.done());
  const double area[5] = {26, 32, 16, 7.5, 1};
  const double sense[5] = {1, 1, 1, -1, 1};  // the grid's rows run along +y: it faces -z
  const Lattice& lattice = scene.geometry.lattice;
  for (std::uint32_t m = 0; m < 5; ++m) {
    const Mesh& mesh = scene.scene.meshes[m];
    double covered = 0;
    std::int64_t map_area = 0;
    for (const DrawnTriangle& t : scene.geometry.drawn) {
      if (t.mesh != m) continue;
      const LatticeVector n = cross(t.vertex[1] - t.vertex[0], t.vertex[2] - t.vertex[0]);
      EXPECT_GT(sense[m] * static_cast<double>(n.z), 0) << "mesh " << m << " folds over";
      covered += sense[m] * 0.5 * static_cast<double>(n.z) * lattice.step() * lattice.step();
      const std::int64_t in_map =
          std::int64_t{t.u[1] - t.u[0]} * (t.v[2] - t.v[0]) - std::int64_t{t.u[2] - t.u[0]} * (t.v[1] - t.v[0]);
      map_area += in_map < 0 ? -in_map : in_map;
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(t.u[k], 0);
        EXPECT_LE(t.u[k], static_cast<std::int32_t>(256 * mesh.map_width()));
        EXPECT_GE(t.v[k], 0);
        EXPECT_LE(t.v[k], static_cast<std::int32_t>(256 * mesh.map_height()));
      }
    }
    // Corners are rounded by at most a step each: along a border of 24 units that is 24 steps of area and some.
    EXPECT_NEAR(covered, area[m], 30 * lattice.step()) << "mesh " << m;
    const std::int64_t whole = std::int64_t{2} * 256 * 256 * mesh.map_width() * mesh.map_height();
    EXPECT_EQ(map_area, mesh.kind == MeshKind::kTriangle ? whole / 2 : whole) << "mesh " << m;
  }
  EXPECT_EQ(scene.geometry.inserted, 2u);
}

TEST(Placement, DrawnMapCoordinatesAreThoseOfThePatches) {
  // At every drawn corner of a patch the map says where the patch is: compare with the mesh's own geometry.
  HandMadeScene scene;
  scene.quad({0, 0, 0}, {8, 0, 1}, {6, 4, 0}, {1, 4, 0}, 4, 2, 2, 3);
  scene.grid(3, 2, {{10, 0, 0}, {11, 0, 0.5}, {13, 0, 0}, {10, 2, 0}, {11, 3, 0}, {13, 2, 1}}, 2, 3, 1, 2);
  scene.triangle({0, 10, 0}, {8, 10, 0}, {0, 14, 3}, 4, 2);
  scene.place();
  ASSERT_TRUE(scene.status.done());
  std::size_t compared = 0;
  for (const DrawnTriangle& t : scene.geometry.drawn) {
    const Mesh& mesh = scene.scene.meshes[t.mesh];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t u = static_cast<std::uint32_t>(t.u[k]) / 256, v = static_cast<std::uint32_t>(t.v[k]) / 256;
      ASSERT_EQ(static_cast<std::uint32_t>(t.u[k]), 256 * u);
      bool found = false;
      for (std::uint32_t s = 0; s < mesh.sub_patch_count(); ++s) {
        const PieceIndex at = sub_patch_index(mesh, s);
        if (at.u + 1 < u || at.u > u || at.v + 1 < v || at.v > v) continue;
        const Piece piece = sub_patch_piece(scene.scene, mesh, s);
        const LatticePoint& p = t.vertex[k];
        for (std::uint32_t c = 0; c < piece.corners; ++c) {
          const LatticePoint q = even_point(scene.geometry.lattice, piece.corner[c]);
          found = found || (std::abs(p.x - q.x) <= 2 && std::abs(p.y - q.y) <= 2 && std::abs(p.z - q.z) <= 2);
        }
      }
      EXPECT_TRUE(found) << "mesh " << t.mesh << " at " << u << ", " << v;
      ++compared;
    }
  }
  EXPECT_GT(compared, 60u);
}

/// The triangles as sets of corners in a canonical order, so that scenes can be compared whatever their file's order.
std::vector<std::array<Corner, 3>> canonical(const Geometry& geometry) {
  std::vector<std::array<Corner, 3>> all;
  for (const Triangle& t : geometry.triangles) {
    std::array<Corner, 3> v{key(t.a), key(t.b), key(t.c)};
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    all.push_back(v);
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(Placement, DoesNotDependOnTheOrderOfPolygons) {
  Random random(4);
  for (int k = 0; k < 30; ++k) {
    const Vec3 axis{random.signed_unit(), random.signed_unit(), 1.1};
    const double angle = 3 * random.signed_unit(), x = 0.3 + random.unit();
    std::vector<std::array<Vec3, 4>> quads;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 5; ++j) {
        const double u = i / 3.0, v = j / 5.0, a = (i + 1) / 3.0, b = (j + 1) / 5.0;
        quads.push_back({Vec3{3 * u, 2 * v, 0}, Vec3{3 * a, 2 * v, 0}, Vec3{3 * a, 2 * b, 0}, Vec3{3 * u, 2 * b, 0}});
      }
    }
    quads.push_back({Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{3, 0, 2}, Vec3{0, 0, 2}});
    quads.push_back({Vec3{0, 2, 0}, Vec3{0, 2, 2}, Vec3{3, 2, 2}, Vec3{3, 2, 0}});
    quads.push_back({Vec3{x, 0, 0}, Vec3{x, 2, 0}, Vec3{x, 2, 2}, Vec3{x, 0, 2}});
    std::vector<std::array<Corner, 3>> first;
    std::uint32_t moved = 0, inserted = 0;
    for (int order = 0; order < 3; ++order) {
      HandMadeScene scene;
      for (const auto& q : quads) scene.quad(q[0], q[1], q[2], q[3]);
      scene.transform([&](const Vec3& v) { return turned(v, axis, angle); });
      scene.place();
      ASSERT_TRUE(scene.status.done());
      if (order == 0) {
        first = canonical(scene.geometry);
        moved = scene.geometry.moved;
        inserted = scene.geometry.inserted;
      } else {
        EXPECT_EQ(canonical(scene.geometry), first);
        EXPECT_EQ(scene.geometry.moved, moved);
        EXPECT_EQ(scene.geometry.inserted, inserted);
      }
      std::reverse(quads.begin(), quads.end());
      if (order == 1) std::swap(quads[2], quads[9]);
    }
  }
}

TEST(Placement, ResultsHaveNoSlackAndMemoryChangesNothing) {
  const auto fill = [](HandMadeScene& scene) {
    frustum(scene);
    scene.area_light({1, 1, 3}, {2, 1, 3}, {2, 2, 3}, {1, 2, 3});
    scene.transform([](const Vec3& v) { return turned(v, {1, 2, 3}, 0.1); });
  };
  HandMadeScene roomy;
  fill(roomy);
  roomy.place();
  ASSERT_TRUE(roomy.status.done());
  const Geometry& g = roomy.geometry;
  const auto block = [](std::size_t bytes) { return (bytes + 7) / 8 * 8; };
  const std::size_t exact = block(g.triangles.size() * sizeof(Triangle)) +
                            block(g.drawn.size() * sizeof(DrawnTriangle)) + block(7 * sizeof(PolygonTriangles)) +
                            block(1 * sizeof(PolygonTriangles)) + block(7 * 4) + block(1 * sizeof(LatticePoint));
  EXPECT_EQ(roomy.arena.in_use(), exact);
  HandMadeScene tight;
  fill(tight);
  tight.arena_bytes = roomy.arena.peak();
  tight.place();
  ASSERT_TRUE(tight.status.done());
  EXPECT_EQ(canonical(tight.geometry), canonical(g));
  for (std::size_t bytes = 0; bytes < roomy.arena.peak(); bytes += 104) {
    HandMadeScene small;
    fill(small);
    small.arena_bytes = bytes;
    small.place();
    EXPECT_EQ(small.status.code, StatusCode::kMemory) << bytes;
    EXPECT_GT(small.status.bytes_needed, bytes);
  }
}

TEST(Placement, TrianglesPlacedAgainAreTheSame) {
  HandMadeScene scene;
  frustum(scene);
  scene.transform([](const Vec3& v) { return turned(v, {1, 2, 3}, 0.1); });
  scene.place();
  ASSERT_TRUE(scene.status.done());
  Geometry again = scene.geometry;
  const std::size_t before = scene.arena.used();
  scene.arena.start_stage();
  ASSERT_TRUE(place_drawn(scene.scene, scene.arena, again));
  EXPECT_NE(again.drawn.data(), scene.geometry.drawn.data());
  EXPECT_EQ(canonical(again), canonical(scene.geometry));
  const std::size_t block = (again.drawn.size() * sizeof(DrawnTriangle) + 7) / 8 * 8;
  EXPECT_EQ(scene.arena.used(), before + block);
  EXPECT_EQ(scene.arena.stage_peak(), 2 * block + before + again.placing_bytes) << "the plan counts on it";
}

TEST(Placement, PolygonsWithoutAreaBlockNothingAndChangeNothing) {
  HandMadeScene plain, with;
  plain.box({0, 0, 0}, {3, 2, 1});
  with.box({0, 0, 0}, {3, 2, 1});
  with.triangle({1, 1, 0.5}, {1, 1, 0.5}, {1, 1, 0.5});       // a point
  with.triangle({1, 1, 0.25}, {1.5, 1, 0.25}, {2, 1, 0.25});  // a line
  plain.place();
  with.place();
  ASSERT_TRUE(with.status.done());
  EXPECT_EQ(canonical(with.geometry), canonical(plain.geometry));
  EXPECT_EQ(with.geometry.drawn.size(), plain.geometry.drawn.size());
}

TEST(Placement, AQuadWithTwoEqualCornersIsTheTriangle) {
  HandMadeScene quad, triangle;
  quad.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 1}, {2, 2, 1});
  triangle.triangle({0, 0, 0}, {2, 0, 0}, {2, 2, 1});
  quad.place();
  triangle.place();
  EXPECT_EQ(canonical(quad.geometry), canonical(triangle.geometry));
}

TEST(Placement, ASaddleIsCutOnTheFixedDiagonalAndAConcaveQuadOnTheValidOne) {
  HandMadeScene saddle;
  saddle.quad({0, 0, 0}, {2, 0, 1}, {2, 2, 0}, {0, 2, 1});
  saddle.place();
  ASSERT_EQ(saddle.geometry.triangles.size(), 2u);
  const Lattice& lattice = saddle.geometry.lattice;
  const LatticePoint first = even_point(lattice, saddle.scene.vertices[0]);
  const LatticePoint third = even_point(lattice, saddle.scene.vertices[2]);
  for (const Triangle& t : saddle.geometry.triangles) {
    EXPECT_TRUE(t.a == first || t.b == first || t.c == first);
    EXPECT_TRUE(t.a == third || t.b == third || t.c == third);
  }
  HandMadeScene dart;  // concave at corner 3: from 1 to 3
  const std::uint32_t m = dart.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 1, 0});
  dart.mesh(m).concave = true;
  dart.mesh(m).cut = true;
  dart.place();
  ASSERT_EQ(dart.geometry.triangles.size(), 2u);
  for (const Triangle& t : dart.geometry.triangles) EXPECT_GT(t.n.z, 0);
}

TEST(Placement, AreaLightsBlockUnlessOpenAndAreDrawnAlways) {
  HandMadeScene scene;
  scene.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0});
  scene.area_light({0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1});
  scene.area_light({1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}, true);
  scene.place();
  ASSERT_EQ(scene.geometry.triangles.size(), 4u);
  EXPECT_EQ(scene.geometry.triangles[0].object, 0u);
  EXPECT_EQ(scene.geometry.triangles[2].object, 1u) << "objects.size() + light";
  EXPECT_EQ(scene.geometry.light_triangles[0].first, 2u);
  EXPECT_EQ(scene.geometry.light_triangles[0].count, 2u);
  EXPECT_EQ(scene.geometry.light_triangles[1].count, 0u);
  ASSERT_EQ(scene.geometry.drawn.size(), 6u);
  EXPECT_EQ(scene.geometry.drawn[5].light, 1u);
  EXPECT_EQ(scene.geometry.drawn[5].mesh, kNone);
}

TEST(Placement, AMirroredSceneIsPlacedMirrored) {
  HandMadeScene scene, mirrored;
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    Vec3 v[3];
    for (Vec3& p : v) p = {random.signed_unit(), random.signed_unit(), random.signed_unit()};
    scene.triangle(v[0], v[1], v[2]);
    for (Vec3& p : v) p.x = -p.x;
    mirrored.triangle(v[0], v[1], v[2]);
  }
  scene.place(1);
  mirrored.place(1);
  ASSERT_EQ(scene.geometry.triangles.size(), mirrored.geometry.triangles.size());
  for (std::size_t k = 0; k < scene.geometry.triangles.size(); ++k) {
    const Triangle &t = scene.geometry.triangles[k], &u = mirrored.geometry.triangles[k];
    EXPECT_TRUE(t.a.x == -u.a.x && t.a.y == u.a.y && t.a.z == u.a.z);
    EXPECT_TRUE(t.c.x == -u.c.x && t.c.y == u.c.y && t.c.z == u.c.z);
  }
}

}  // namespace
}  // namespace shodo
