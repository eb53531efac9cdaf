// Which sub-patch a point of a surface lies on, against the pieces of scene/mesh.h, made from the counts alone.
#include "ambient/sub_patch_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/mesh.h"
#include "tests/visibility/scenes.h"

namespace shodo {
namespace {

struct Finding : HandMadeScene {
  void start() {
    place();
    ASSERT_TRUE(status.done());
    const std::size_t before = arena.used();
    ASSERT_TRUE(finder.take(scene, geometry, arena));
    EXPECT_EQ(arena.used(), before + SubPatchFinder::bytes(geometry));
  }

  /// The triangle of a mesh over which a point lies: the one with the largest of the smallest of its three weights.
  /// The point goes to its plane, along the largest component of its normal.
  std::uint32_t triangle_at(std::uint32_t m, Vec3& point) const {
    const double steps = geometry.lattice.steps_per_unit;
    std::uint32_t best = kNone;
    double most = -1e300;
    Vec3 on;
    for (std::uint32_t cell = 0; cell < cell_count(scene.meshes[m]); ++cell) {
      const PolygonTriangles& polygon = geometry.cells[geometry.first_cell[m] + cell];
      for (std::uint32_t t = polygon.first; t < polygon.first + polygon.count; ++t) {
        const Triangle& triangle = geometry.triangles[t];
        const Vec3 n = vector_of(triangle.n), at = steps * point;
        const Vec3 a = vector_of(triangle.a - LatticePoint{}), b = vector_of(triangle.b - LatticePoint{}),
                   c = vector_of(triangle.c - LatticePoint{});
        const auto weight = [&](const Vec3& p, const Vec3& q) {
          return dot(cross(q - p, at - p), n) / length_squared(n);
        };
        const double least = std::min({weight(a, b), weight(b, c), weight(c, a)});
        if (least <= most) continue;
        most = least;
        best = t;
        on = at - (dot(n, at - a) / length_squared(n)) * n;
      }
    }
    EXPECT_GT(most, -1e-3) << "no triangle there";
    point = on;
    return best;
  }

  SubPatchFinder::Found at(std::uint32_t m, Vec3 point) const {
    const std::uint32_t triangle = triangle_at(m, point);
    const auto whole = [](double x) { return static_cast<std::int32_t>(std::lround(x)); };
    const LatticePoint steps{whole(point.x), whole(point.y), whole(point.z)};
    return finder.find(triangle, steps);
  }

  /// Every sub-patch of a mesh is found at its centre and near its corners: `inset` of its sides from them.
  void expect_all_found(std::uint32_t m, double inset = 0.03) {
    const Mesh& mesh = scene.meshes[m];
    std::uint32_t asked = 0;
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const Piece piece = sub_patch_piece(scene, mesh, k);
      if (!(length(piece.vector_area()) > 1e-9)) continue;
      const double near = inset, far = 1 - (piece.corners == 3 ? 2 : 1) * inset;
      const bool triangle = piece.corners == 3;
      const Vec3 points[] = {piece.centre(), piece.point(near, near), piece.point(far, near), piece.point(near, far),
                             triangle ? piece.centre() : piece.point(far, far)};
      for (const Vec3& point : points) {
        const SubPatchFinder::Found found = at(m, point);
        EXPECT_EQ(found.mesh, m);
        EXPECT_EQ(found.sub_patch, k) << "mesh " << m << ", point " << &point - points;
      }
      ++asked;
    }
    EXPECT_GT(asked, 0u);
  }

  LatticePoint inside(const PolygonTriangles& polygon, Random& random, double inset) const {
    const Triangle& t = geometry.triangles[polygon.first + random.below(polygon.count)];
    double s = random.unit(), r = random.unit();
    if (s + r > 1) s = 1 - s, r = 1 - r;
    s = inset + (1 - 3 * inset) * s;
    r = inset + (1 - 3 * inset) * r;
    const Vec3 off = s * vector_of(t.b - t.a) + r * vector_of(t.c - t.a);
    const auto moved = [](std::int32_t from, double by) { return from + static_cast<std::int32_t>(std::lround(by)); };
    return {moved(t.a.x, off.x), moved(t.a.y, off.y), moved(t.a.z, off.z)};
  }

  /// How far a point is from the nearest border of a parallelogram, of its sides; negative outside.
  static double from_border(const Piece& piece, const Vec3& point) {
    double least = 1;
    for (int k = 0; k < 4; ++k) {
      const Vec3 &a = piece.corner[k], &b = piece.corner[(k + 1) % 4], &c = piece.corner[(k + 2) % 4];
      least = std::min(least, length(cross(b - a, point - a)) / length(cross(b - a, c - a)) *
                                  (dot(cross(b - a, point - a), cross(b - a, c - a)) < 0 ? -1 : 1));
    }
    return least;
  }

  /// Points along lines across each cell of a mesh, at most so many a line, are found one after the other.
  void expect_walks(std::uint32_t m, std::uint32_t most = 1024, int lines = 60) {
    const Mesh& mesh = scene.meshes[m];
    const bool whole = mesh.sub_patch_count() == cell_count(mesh);
    std::size_t compared = 0, near = 0;
    Random random(m + 1);
    for (std::uint32_t cell = 0; cell < cell_count(mesh); ++cell) {
      const PolygonTriangles& polygon = geometry.cells[geometry.first_cell[m] + cell];
      for (int line = 0; line < lines && polygon.count > 0; ++line) {
        const double inset = whole ? 0.01 : 0;
        const LatticePoint from = inside(polygon, random, inset), to = inside(polygon, random, inset);
        const std::uint32_t triangle = polygon.first + random.below(polygon.count), count = 2 + random.below(most - 1);
        const auto part = [&](std::int64_t off) { return static_cast<std::int32_t>(off * 1024 / (count - 1)); };
        const LatticeVector off = to - from;
        const LatticePoint way{part(off.x), part(off.y), part(off.z)};
        SubPatchFinder::Walk walk;
        ASSERT_TRUE(finder.start(triangle, from, way, walk));
        for (std::uint32_t k = 0; k < count; ++k) {
          const auto at = [&](std::int32_t start, std::int32_t step) {
            return start + static_cast<std::int32_t>(std::lround(k * (step / 1024.0)));
          };
          const LatticePoint point{at(from.x, way.x), at(from.y, way.y), at(from.z, way.z)};
          const SubPatchFinder::Found found = finder.find(triangle, point);
          const std::uint32_t walked = walk.next();
          if (!whole) {
            // A place grows by a step that is right to 2^-16 of a sub-patch, up to 1024 times: 1.6 %.
            const Piece piece = sub_patch_piece(scene, mesh, found.sub_patch);
            const double off_border = from_border(piece, scene_point(geometry.lattice, point));
            ASSERT_GT(off_border, -0.02);
            if (off_border < 0.02) {
              ++near;
              continue;
            }
          }
          ASSERT_EQ(walked, mesh.first_sub_patch + found.sub_patch) << "mesh " << m << ", point " << k;
          ++compared;
        }
      }
    }
    EXPECT_GT(compared, 5 * near);
    EXPECT_GT(compared, 100u);
  }

  /// Map coordinates aren't linear there.
  void expect_no_walks(std::uint32_t m) {
    Random random(m);
    for (std::uint32_t cell = 0; cell < cell_count(scene.meshes[m]); ++cell) {
      const PolygonTriangles& polygon = geometry.cells[geometry.first_cell[m] + cell];
      for (std::uint32_t t = 0; t < polygon.count; ++t) {
        SubPatchFinder::Walk walk;
        EXPECT_FALSE(finder.start(polygon.first + t, inside(polygon, random, 0.1), {1, 2, 3}, walk)) << "mesh " << m;
      }
    }
  }

  SubPatchFinder finder;
};

TEST(SubPatchFinder, FindsEverySubPatchOfParallelograms) {
  Finding scene;
  const std::uint32_t flat = scene.quad({0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {0, 4, 0}, 3, 2, 2, 3);
  const std::uint32_t tilted = scene.quad({1, 5, 1}, {4, 6, 3}, {3, 9, 4}, {0, 8, 2}, 2, 3, 3, 1);
  const std::uint32_t upside_down = scene.quad({0, 4, 7}, {6, 4, 7}, {6, 0, 7}, {0, 0, 7}, 1, 5, 4, 2);
  scene.start();
  for (const std::uint32_t m : {flat, tilted, upside_down}) scene.expect_all_found(m);
}

TEST(SubPatchFinder, FindsEverySubPatchOfQuadsThatAreNone) {
  Finding scene;
  const std::uint32_t trapezium = scene.quad({0, 0, 0}, {8, 0, 0}, {5, 4, 0}, {3, 4, 0}, 4, 2, 2, 3);
  const std::uint32_t leaning = scene.quad({0, 5, 0}, {7, 5, 3}, {8, 9, 3.5}, {0, 7, 0}, 2, 2, 1, 4);
  // Not plane: a corner stands off the plane of the others by a tenth of the sides.
  const std::uint32_t twisted = scene.quad({0, 10, 0}, {4, 10, 0}, {4, 14, 0.4}, {0, 14, 0}, 2, 3, 2, 1);
  // Fronts along every axis and against it; a corner on the way between its neighbours, which is no bend at all there.
  const std::uint32_t up_x = scene.quad({9, 0, 0}, {9, 4, 0}, {9, 3, 4}, {9, 1, 2}, 3, 2, 2, 2);
  const std::uint32_t down_x = scene.quad({10, 1, 2}, {10, 3, 4}, {10, 4, 0}, {10, 0, 0}, 3, 2, 2, 2);
  const std::uint32_t up_y = scene.quad({0, 20, 0}, {0, 20, 4}, {2, 20, 3}, {4, 20, 0}, 2, 3, 2, 2);
  const std::uint32_t down_y = scene.quad({4, 21, 0}, {2, 21, 3}, {0, 21, 4}, {0, 21, 0}, 2, 3, 2, 2);
  const std::uint32_t down_z = scene.quad({9, 10, 1}, {10, 14, 1}, {13, 13, 1}, {15, 10, 1}, 3, 3, 1, 2);
  const std::uint32_t straight = scene.quad({9, 20, 0}, {13, 20, 0}, {9, 24, 0}, {9, 22, 0}, 2, 2, 2, 2);
  scene.start();
  for (const std::uint32_t m : {trapezium, leaning, twisted, up_x, down_x, up_y, down_y, down_z, straight}) {
    scene.expect_all_found(m);
  }
}

/// Cut on the diagonal that lies inside, and even on both halves.
TEST(SubPatchFinder, FindsEverySubPatchOfConcaveQuads) {
  Finding scene;
  const std::uint32_t at_corner_2 = scene.quad({0, 0, 0}, {6, 0, 0}, {2, 2, 0}, {0, 6, 0}, 3, 3, 2, 2);
  const std::uint32_t at_corner_0 = scene.quad({12, 4, 0}, {14, 0, 1}, {14, 6, 1}, {8, 6, -2}, 2, 2, 2, 2);
  const std::uint32_t at_corner_1 = scene.quad({0, 8, 0}, {2, 10, 0}, {6, 8, 0}, {0, 14, 0}, 3, 3, 2, 2);
  const std::uint32_t at_corner_3 = scene.quad({8, 8, 0}, {14, 8, 2}, {14, 14, 2}, {12, 10, 4. / 3}, 2, 2, 2, 2);
  for (const std::uint32_t m : {at_corner_2, at_corner_0, at_corner_1, at_corner_3}) scene.mesh(m).cut = true;
  scene.mesh(at_corner_1).concave = scene.mesh(at_corner_3).concave = true;
  scene.start();
  for (const std::uint32_t m : {at_corner_2, at_corner_0, at_corner_1, at_corner_3}) scene.expect_all_found(m);
}

/// A side goes there and back, so that half of the quad has no area; sub-patches of the other half.
TEST(SubPatchFinder, FindsSubPatchesBesideASpike) {
  Finding scene;
  const std::uint32_t at_corner_1 = scene.quad({0, 0, 0}, {8, 0, 0}, {4, 0, 0}, {0, 6, 0}, 2, 2, 2, 2);
  const std::uint32_t at_corner_0 = scene.quad({8, 8, 0}, {4, 8, 0}, {0, 14, 0}, {0, 8, 0}, 2, 2, 2, 2);
  for (const std::uint32_t m : {at_corner_1, at_corner_0}) scene.mesh(m).cut = true;
  scene.mesh(at_corner_0).concave = true;
  scene.start();
  for (std::uint32_t row = 0; row < 4; ++row) {
    for (std::uint32_t column = 0; column < 4; ++column) {
      const std::uint32_t number = 4 * row + column;
      for (const std::uint32_t m : {at_corner_1, at_corner_0}) {
        if (m == at_corner_1 ? row <= column : row + column <= 3) continue;
        const Vec3 middle = sub_patch_piece(scene.scene, scene.scene.meshes[m], number).centre();
        EXPECT_EQ(scene.at(m, middle).sub_patch, number) << "mesh " << m;
      }
    }
  }
}

TEST(SubPatchFinder, FindsEverySubPatchOfTriangles) {
  Finding scene;
  scene.triangle({0, 0, 0}, {8, 0, 0}, {0, 6, 0}, 1, 1);
  scene.triangle({0, 7, 0}, {8, 7, 0}, {0, 13, 0}, 2, 3);
  scene.triangle({0, 14, 5}, {3, 20, 1}, {9, 15, 2}, 4, 1);
  scene.triangle({10, 0, 0}, {10, 5, 1}, {10, 2, 8}, 1, 5);
  scene.start();
  for (std::uint32_t m = 0; m < 4; ++m) scene.expect_all_found(m);
}

/// Cells are even and uneven, concave ones among them; one has no area, so that it has no triangles.
TEST(SubPatchFinder, FindsEverySubPatchOfGrids) {
  Finding scene;
  const std::uint32_t even = scene.grid(3, 4, {{0, 0, 0}, {2, 0, 0}, {5, 0, 0}, {0, 1, 1}, {2, 1, 1}, {5, 1, 1},
                                               {0, 3, 1}, {2, 3, 1}, {5, 3, 1}, {0, 4, 3}, {2, 4, 3}, {5, 4, 3}},
                                        2, 1, 2, 3);
  const std::uint32_t uneven = scene.grid(3, 2, {{7, 0, 0}, {8, 0, 0}, {10, 0, 0}, {7, 2, 0}, {8, 3, 0}, {10, 2, 0}},
                                          2, 3, 1, 2);
  // The middle column's cell is nothing but an edge; the last one is concave.
  const std::uint32_t odd = scene.grid(4, 2, {{0, 6, 0}, {3, 6, 0}, {3, 6, 0}, {6, 6, 0},
                                              {0, 9, 0}, {3, 9, 0}, {3, 9, 0}, {4, 7, 0}},
                                       2, 2, 2, 2);
  scene.mesh(odd).cut = true;
  const std::uint32_t after = scene.quad({0, 10, 0}, {6, 10, 0}, {6, 12, 0}, {0, 12, 0}, 2, 2);
  scene.start();
  EXPECT_EQ(scene.geometry.cells[scene.geometry.first_cell[odd] + 1].count, 0u);
  for (const std::uint32_t m : {even, uneven, odd, after}) scene.expect_all_found(m);
}

/// 300 steps of the lattice wide; its corners go to even points, 1 % of a sub-patch.
TEST(SubPatchFinder, FindsSubPatchesOfASmallMeshInALargeScene) {
  Finding scene;
  scene.quad({0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0});
  const std::uint32_t small = scene.quad({9, 9, 1}, {9.01, 9, 1}, {9.01, 9, 1.01}, {9, 9, 1.01}, 2, 2, 2, 2);
  scene.start();
  scene.expect_all_found(small, 0.05);
}

TEST(SubPatchFinder, FindsThroughTrianglesOfInsertedVertices) {
  Finding scene;
  const std::uint32_t wide = scene.quad({0, 0, 0}, {9, 0, 0}, {9, 4, 0}, {0, 4, 0}, 3, 2, 2, 2);
  const std::uint32_t crooked = scene.quad({0, 4, 0}, {2, 8, 0}, {7, 8, 0}, {9, 4, 0}, 2, 2, 2, 2);
  for (int k = 0; k < 3; ++k) {
    const double x = 1 + 2 * k;
    scene.quad({x, 4, 0}, {x + 1, 4, 0}, {x + 1, 4, 3}, {x, 4, 3});
    scene.quad({x, 0, 0}, {x, 0, 2}, {x + 1, 0, 2}, {x + 1, 0, 0});
  }
  scene.start();
  EXPECT_GE(scene.geometry.inserted, 12u);
  EXPECT_GE(scene.geometry.cells[scene.geometry.first_cell[wide]].count, 14u);
  EXPECT_GE(scene.geometry.cells[scene.geometry.first_cell[crooked]].count, 8u);
  scene.expect_all_found(wide);
  scene.expect_all_found(crooked);
}

/// A parallelogram that is a line in the file, and has triangles as its corners go to the lattice: its first one.
TEST(SubPatchFinder, FindsASubPatchOfWhatHasAnAreaByRoundingAlone) {
  Finding scene;
  const Vec3 s = (0.125 + 19 * 0x1p-24) * Vec3{-1, -3, -7}, t = 0.5 * s;  // exact
  scene.quad({}, s, s + t, t, 3, 2, 2, 2);
  scene.start();
  const PolygonTriangles& polygon = scene.geometry.cells[0];
  ASSERT_GT(polygon.count, 0u);
  for (std::uint32_t k = polygon.first; k < polygon.first + polygon.count; ++k) {
    const Triangle& triangle = scene.geometry.triangles[k];
    for (const LatticePoint& at : {triangle.a, triangle.b, triangle.c}) {
      EXPECT_EQ(scene.finder.find(k, at).sub_patch, 0u);
    }
  }
}

/// By rounding, say: as if it were on it.
TEST(SubPatchFinder, FindsWhatIsBeyondAnEdgeOnItsSubPatch) {
  Finding scene;
  scene.quad({0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {0, 4, 0}, 3, 2, 2, 2);
  scene.quad({0, 5, 0}, {6, 5, 0}, {5, 9, 0}, {1, 9, 0}, 3, 2, 2, 2);
  scene.triangle({0, 10, 0}, {6, 10, 0}, {0, 16, 0}, 3, 2);
  scene.start();
  for (std::uint32_t m = 0; m < 3; ++m) {
    const Piece piece = cell_piece(scene.scene, scene.scene.meshes[m], 0);
    for (std::uint32_t k = 0; k < 24 * piece.corners; ++k) {
      const Vec3 &a = piece.corner[k / 24], &b = piece.corner[(k / 24 + 1) % piece.corners];
      const Vec3 at = a + ((k % 24 + 0.5) / 24) * (b - a), inwards = 0.002 * normalised(piece.centre() - at);
      const std::uint32_t inside = scene.at(m, at + inwards).sub_patch;
      EXPECT_EQ(scene.at(m, at - inwards).sub_patch, inside) << "mesh " << m << ", point " << k;
    }
  }
  // Beyond a triangle's longest side, where one of them ends.
  for (int row = 0; row < 6; ++row) {
    const Vec3 at = Vec3{6.002 - row, 10.002 + row, 0} - scene.scene.origin;
    EXPECT_EQ(scene.at(2, at).sub_patch, scene.at(2, at - Vec3{0.01, 0, 0}).sub_patch) << row;
  }
}

TEST(SubPatchFinder, WalksOverParallelograms) {
  Finding scene;
  const std::uint32_t flat = scene.quad({0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {0, 4, 0}, 3, 2, 2, 3);
  const std::uint32_t tilted = scene.quad({1, 5, 1}, {4, 6, 3}, {3, 9, 4}, {0, 8, 2}, 2, 3, 3, 1);
  const std::uint32_t upside_down = scene.quad({0, 4, 7}, {6, 4, 7}, {6, 0, 7}, {0, 0, 7}, 1, 5, 4, 2);
  const std::uint32_t strip = scene.quad({7, 0, 0}, {7, 0.1, 0}, {7, 0.1, 8}, {7, 0, 8}, 1, 40, 1, 3);
  const std::uint32_t sheared = scene.quad({0, 10, 0}, {3, 10, 0}, {7, 12, 1}, {4, 12, 1}, 3, 3, 2, 2);
  scene.start();
  for (const std::uint32_t m : {flat, tilted, upside_down, strip, sheared}) scene.expect_walks(m);
}

/// Cells are rectangles of several sizes, sheared, and turned in space.
TEST(SubPatchFinder, WalksOverGridsOfParallelograms) {
  Finding scene;
  const std::uint32_t even = scene.grid(3, 4, {{0, 0, 0}, {2, 0, 0}, {5, 0, 0}, {0, 1, 1}, {2, 1, 1}, {5, 1, 1},
                                               {0, 3, 1}, {2, 3, 1}, {5, 3, 1}, {0, 4, 3}, {2, 4, 3}, {5, 4, 3}},
                                        2, 1, 2, 3);
  const std::uint32_t sheared = scene.grid(2, 3, {{0, 6, 0}, {3, 6, 1}, {1, 8, 1}, {4, 8, 2}, {1, 9, 4}, {4, 9, 5}},
                                           3, 2, 1, 2);
  scene.start();
  scene.expect_walks(even);
  scene.expect_walks(sheared);
}

/// A cell that is one sub-patch may have any shape.
TEST(SubPatchFinder, WalksOverCellsOfOneSubPatch) {
  Finding scene;
  scene.quad({0, 0, 0}, {8, 0, 0}, {5, 4, 0}, {3, 4, 0});
  scene.quad({0, 10, 0}, {4, 10, 0}, {4, 14, 0.4}, {0, 14, 0});
  scene.triangle({0, 14, 5}, {3, 20, 1}, {9, 15, 2});
  scene.mesh(scene.quad({10, 0, 0}, {16, 0, 0}, {12, 2, 0}, {10, 6, 0})).cut = true;
  scene.grid(3, 3, {{7, 10, 0}, {8, 10, 0}, {10, 10, 0}, {7, 12, 0}, {8, 13, 0}, {10, 12, 1}, {6, 16, 0}, {8, 15, 1},
                    {11, 16, 2}});
  scene.start();
  for (std::uint32_t m = 0; m < 5; ++m) scene.expect_walks(m);
}

TEST(SubPatchFinder, WalksNowhereElse) {
  Finding scene;
  scene.quad({0, 0, 0}, {8, 0, 0}, {5, 4, 0}, {3, 4, 0}, 4, 2, 2, 3);
  scene.quad({0, 10, 0}, {4, 10, 0}, {4, 14, 0.4}, {0, 14, 0}, 1, 2);
  scene.triangle({0, 14, 5}, {3, 20, 1}, {9, 15, 2}, 2, 1);
  scene.triangle({10, 0, 0}, {10, 5, 1}, {10, 2, 8}, 1, 3);
  scene.mesh(scene.quad({12, 0, 0}, {18, 0, 0}, {14, 2, 0}, {12, 6, 0}, 2, 2)).cut = true;
  scene.grid(3, 2, {{7, 10, 0}, {8, 10, 0}, {10, 10, 0}, {7, 12, 0}, {8, 13, 0}, {10, 12, 0}}, 1, 2);
  // More columns and rows than a place in a walk can count, and as many.
  scene.quad({0, 0, 9}, {9, 0, 9}, {9, 4, 9}, {0, 4, 9}, 16385, 1);
  scene.quad({0, 0, 8}, {9, 0, 8}, {9, 4, 8}, {0, 4, 8}, 1, 16385);
  const std::uint32_t columns = scene.quad({0, 5, 9}, {9, 5, 9}, {9, 9, 9}, {0, 9, 9}, 16384, 1);
  const std::uint32_t rows = scene.quad({0, 5, 8}, {9, 5, 8}, {9, 9, 8}, {0, 9, 8}, 1, 16384);
  const std::uint32_t light = scene.area_light({0, 0, 3}, {0, 2, 3}, {2, 2, 3}, {2, 0, 3});
  scene.start();
  for (std::uint32_t m = 0; m < 8; ++m) scene.expect_no_walks(m);
  const PolygonTriangles& polygon = scene.geometry.light_triangles[light];
  SubPatchFinder::Walk walk;
  for (const std::uint32_t most : {columns, rows}) {
    const std::uint32_t triangle = scene.geometry.cells[scene.geometry.first_cell[most]].first;
    EXPECT_TRUE(scene.finder.start(triangle, scene.geometry.triangles[triangle].a, {1, 2, 3}, walk));
  }
  EXPECT_FALSE(scene.finder.start(polygon.first, scene.geometry.triangles[polygon.first].a, {1, 2, 3}, walk));
}

/// 75 steps of the lattice a sub-patch, so that rounding a point moves it by up to 1 % of one: fewer points.
TEST(SubPatchFinder, WalksOverASmallMeshInALargeScene) {
  Finding scene;
  scene.quad({0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0});
  const std::uint32_t small = scene.quad({9, 9, 1}, {9.01, 9, 1}, {9.01, 9, 1.01}, {9, 9, 1.01}, 2, 2, 2, 2);
  scene.start();
  scene.expect_walks(small, 40, 200);
}

/// A line that is the only one to cross a polygon: where the next would is anywhere.
TEST(SubPatchFinder, WalksToOnePointWhateverTheWay) {
  Finding scene;
  scene.quad({0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0});
  const std::uint32_t small = scene.quad({9, 9, 1}, {9.1, 9, 1}, {9.1, 9, 1.1}, {9, 9, 1.1}, 3000, 2);
  scene.start();
  const std::uint32_t triangle = scene.geometry.cells[scene.geometry.first_cell[small]].first;
  const Triangle& t = scene.geometry.triangles[triangle];
  Random random(3);
  for (int k = 0; k < 2000; ++k) {
    const auto part = [&] { return static_cast<std::int32_t>(random.signed_unit() * (1 << (10 + random.below(21)))); };
    const LatticePoint way{part(), part(), part()};
    const LatticePoint& at = k % 3 == 0 ? t.a : k % 3 == 1 ? t.b : t.c;
    SubPatchFinder::Walk walk;
    ASSERT_TRUE(scene.finder.start(triangle, at, way, walk));
    ASSERT_EQ(walk.next(), scene.scene.meshes[small].first_sub_patch + scene.finder.find(triangle, at).sub_patch);
  }
}

TEST(SubPatchFinder, WalksOverTrianglesOfInsertedVertices) {
  Finding scene;
  const std::uint32_t wide = scene.quad({0, 0, 0}, {9, 0, 0}, {9, 4, 0}, {0, 4, 0}, 3, 2, 2, 2);
  for (int k = 0; k < 3; ++k) {
    const double x = 1 + 2 * k;
    scene.quad({x, 4, 0}, {x + 1, 4, 0}, {x + 1, 4, 3}, {x, 4, 3});
  }
  scene.start();
  EXPECT_GE(scene.geometry.cells[scene.geometry.first_cell[wide]].count, 8u);
  scene.expect_walks(wide);
}

TEST(SubPatchFinder, AnAreaLightHasNone) {
  for (const int quads : {0, 1, 2}) {
    Finding scene;
    if (quads > 0) scene.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, 2, 2);
    // Without area, so the light's triangles begin where its own would.
    if (quads > 1) scene.quad({0, 5, 0}, {4, 5, 0}, {4, 5, 0}, {0, 5, 0});
    const std::uint32_t light = scene.area_light({0, 0, 3}, {0, 2, 3}, {2, 2, 3}, {2, 0, 3});
    scene.start();
    const PolygonTriangles& polygon = scene.geometry.light_triangles[light];
    ASSERT_EQ(polygon.count, 2u);
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
      const SubPatchFinder::Found found =
          scene.finder.find(polygon.first + k, scene.geometry.triangles[polygon.first + k].a);
      EXPECT_EQ(found.mesh, kNone);
      EXPECT_EQ(found.sub_patch, kNone);
    }
  }
}

TEST(SubPatchFinder, SaysWhenTheArenaIsTooSmall) {
  Finding scene;
  scene.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, 2, 2);
  scene.start();
  Arena none(nullptr, 0);
  SubPatchFinder finder;
  EXPECT_FALSE(finder.take(scene.scene, scene.geometry, none));
}

}  // namespace
}  // namespace shodo
