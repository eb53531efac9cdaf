// The geometry of cells, patches and sub-patches, against areas and places that can be told without it.
#include "scene/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "support/scene_from_text.h"

namespace shodo {
namespace {

// A relative error of a sum of n pieces; each adds a few roundings of a double.
constexpr double kRounding = 1e-13;

struct Shape {
  const char* name;
  std::string statement;
  double area;  // 0: not plane, only the vector area is known
  Vec3 vector_area;
};

std::vector<Shape> shapes() {
  return {
      {"square", "quad m 0 0 0  0 0 2  3 0 2  3 0 0 patches 3 5 sub 2 3", 6, {0, 6, 0}},
      {"trapezium", "quad m 0 0 0  4 0 0  3 2 0  0 2 0 patches 4 3 sub 3 1", 7, {0, 0, 7}},
      {"saddle", "quad m 0 0 0  2 0 1  2 2 0  0 2 1 patches 4 4 sub 2 2", 0, {0, 0, 4}},
      {"triangle", "tri m 0 0 0  4 0 0  1 3 0 patches 5 sub 3", 6, {0, 0, 6}},
      {"triangle as a quad", "quad m 0 0 0  4 0 0  4 0 0  1 3 0 patches 5 2 sub 1 3", 6, {0, 0, 6}},
      {"concave at corner 0", "quad m 1 1 0  0 4 0  0 0 0  4 0 0 patches 3 4 sub 2 2", 4, {0, 0, 4}},
      {"concave at corner 1", "quad m 4 0 0  1 1 0  0 4 0  0 0 0 patches 4 2 sub 3 1", 4, {0, 0, 4}},
      {"concave at corner 2", "quad m 0 0 0  4 0 0  1 1 0  0 4 0 patches 5 5 sub 1 1", 4, {0, 0, 4}},
      {"concave at corner 3", "quad m 0 4 0  0 0 0  4 0 0  1 1 0 patches 1 1 sub 4 4", 4, {0, 0, 4}},
      {"grid",
       "grid m 4 3  0 0 0  1 0 0  2 0 0  4 0 0   0 0 1  1 0 2  2 0 1  4 0 1   0 0 3  1 0 3  2 0 3  5 0 3 sub 2 3",
       13,
       {0, 13, 0}},
      {"grid with a concave cell", "grid m 2 2  0 0 0  0 4 0  4 0 0  1 1 0 sub 3 2", 4, {0, 0, 4}},
  };
}

const std::string kStart = "shodo 1\nmaterial m diffuse 0.5\nobject o\n";

Options refined(double k) {
  Options options;
  options.refine = k;
  return options;
}

struct Sum {
  Vec3 vector;
  double area = 0;
  void add(const Piece& piece) {
    vector = vector + piece.vector_area();
    area += length(piece.vector_area());
  }
};

TEST(Mesh, AreasOfPiecesAddUpToTheWhole) {
  for (const Shape& shape : shapes()) {
    for (const double k : {1.0, 2.0, 2.5}) {
      const LoadedScene s(kStart + shape.statement, refined(k));
      const Mesh& mesh = s.scene.meshes[0];
      Sum cells, patches, sub_patches;
      for (std::uint32_t c = 0; c < cell_count(mesh); ++c) cells.add(cell_piece(s.scene, mesh, c));
      for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) patches.add(patch_piece(s.scene, mesh, p));
      for (std::uint32_t p = 0; p < mesh.sub_patch_count(); ++p) sub_patches.add(sub_patch_piece(s.scene, mesh, p));
      for (const Sum& sum : {cells, patches, sub_patches}) {
        EXPECT_LT(length(sum.vector - shape.vector_area), kRounding * 10) << shape.name << " " << k;
        if (shape.area > 0) {
          EXPECT_NEAR(sum.area, shape.area, kRounding * 10) << shape.name << " " << k;
        }
      }
    }
  }
}

TEST(Mesh, ASaddlesPiecesApproachItsTrueArea) {
  // z = (x + y - x y) / 2 over the square of side 2 (s = x/2, t = y/2: z = s + t - 2 s t), by 1000 x 1000 midpoints.
  double truth = 0;
  for (int i = 0; i < 1000; ++i) {
    for (int j = 0; j < 1000; ++j) {
      const double s = (i + 0.5) / 1000, t = (j + 0.5) / 1000;
      const double zx = (1 - 2 * t) / 2, zy = (1 - 2 * s) / 2;
      truth += std::sqrt(1 + zx * zx + zy * zy) * 4e-6;
    }
  }
  const LoadedScene s(kStart + "quad m 0 0 0  2 0 1  2 2 0  0 2 1 patches 20 20");
  Sum patches;
  for (std::uint32_t p = 0; p < 400; ++p) patches.add(patch_piece(s.scene, s.scene.meshes[0], p));
  EXPECT_NEAR(patches.area, truth, 1e-3 * truth);  // chords of 1/20: an error of about (1/20)^2 / 12
}

/// Is p in the triangle a b c, its edges included?
bool inside(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const double least = -1e-12 * length_squared(n);
  return dot(cross(b - a, p - a), n) >= least && dot(cross(c - b, p - b), n) >= least &&
         dot(cross(a - c, p - c), n) >= least;
}

bool inside(const Vec3& p, const Piece& piece) {
  const std::uint32_t k = piece.concave ? 1 : 0;
  const Vec3* c = piece.corner;
  return inside(p, c[k], c[k + 1], c[k + 2]) || (piece.corners == 4 && inside(p, c[k], c[k + 2], c[(k + 3) % 4]));
}

TEST(Mesh, EverySubPatchLiesInThePatchThatHoldsIt) {
  for (const Shape& shape : shapes()) {
    if (shape.area == 0) continue;
    const LoadedScene s(kStart + shape.statement, refined(2));
    const Mesh& mesh = s.scene.meshes[0];
    std::vector<std::uint32_t> held(mesh.patch_count());
    std::vector<Vec3> area(mesh.patch_count());
    for (std::uint32_t q = 0; q < mesh.sub_patch_count(); ++q) {
      const std::uint32_t p = patch_of_sub_patch(mesh, q);
      ASSERT_LT(p, mesh.patch_count());
      ++held[p];
      const Piece sub = sub_patch_piece(s.scene, mesh, q);
      area[p] = area[p] + sub.vector_area();
      EXPECT_TRUE(inside(sub.centre(), patch_piece(s.scene, mesh, p))) << shape.name << " " << q;
      for (std::uint32_t k = 0; k < sub.corners; ++k) {
        EXPECT_TRUE(inside(sub.corner[k], patch_piece(s.scene, mesh, p))) << shape.name << " " << q;
      }
    }
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      EXPECT_EQ(held[p], mesh.su * mesh.sv) << shape.name;
      EXPECT_LT(length(area[p] - patch_piece(s.scene, mesh, p).vector_area()), kRounding) << shape.name << " " << p;
    }
  }
}

TEST(Mesh, EveryPatchLiesInTheCellThatHoldsItAndFacesItsFront) {
  for (const Shape& shape : shapes()) {
    const LoadedScene s(kStart + shape.statement, refined(2));
    const Mesh& mesh = s.scene.meshes[0];
    std::vector<std::uint32_t> held(cell_count(mesh));
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      const std::uint32_t cell = cell_of_patch(mesh, p);
      ASSERT_LT(cell, cell_count(mesh));
      ++held[cell];
      const Piece whole = cell_piece(s.scene, mesh, cell), patch = patch_piece(s.scene, mesh, p);
      EXPECT_GT(dot(patch.vector_area(), shape.vector_area), 0) << shape.name << " " << p;
      EXPECT_GT(dot(whole.vector_area(), shape.vector_area), 0) << shape.name;
      if (shape.area > 0) {
        EXPECT_TRUE(inside(patch.centre(), whole)) << shape.name << " " << p;
      }
    }
    for (const std::uint32_t count : held) EXPECT_EQ(count, mesh.patch_count() / cell_count(mesh)) << shape.name;
  }
}

TEST(Mesh, NeighbouringPiecesShareTheirCornersToTheLastBit) {
  for (const Shape& shape : shapes()) {
    const LoadedScene s(kStart + shape.statement, refined(3));
    const Mesh& mesh = s.scene.meshes[0];
    const auto less = [](const Vec3& a, const Vec3& b) {
      return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    std::set<Vec3, decltype(less)> corners(less);
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      const Piece piece = patch_piece(s.scene, mesh, p);
      for (std::uint32_t k = 0; k < piece.corners; ++k) corners.insert(piece.corner[k]);
    }
    const std::uint32_t u = mesh.nu + 1, v = mesh.nv + 1;
    const std::uint32_t expected = mesh.kind == MeshKind::kTriangle ? u * (u + 1) / 2 : u * v;
    EXPECT_EQ(corners.size(), expected) << shape.name;
    // And the polygon's own corners are among them.
    for (std::uint32_t c = 0; c < cell_count(mesh); ++c) {
      for (const Vec3& corner : cell_piece(s.scene, mesh, c).corner)
        EXPECT_TRUE(corners.contains(corner)) << shape.name;
    }
  }
}

TEST(Mesh, PiecesRunAlongUFirst) {
  const LoadedScene s(kStart +
                      "quad m 0 0 0  0 0 2  3 0 2  3 0 0 patches 2 3 sub 1 1\n"
                      "grid m 3 2  0 0 0  1 0 0  2 0 0   0 0 1  1 0 1  2 0 1 sub 1 1\n");
  const Vec3 shift = s.scene.origin;
  // Of the quad u runs from corner 1 to corner 2: along z. Of the grid along the columns: x.
  EXPECT_EQ(patch_piece(s.scene, s.scene.meshes[0], 1).centre() + shift, (Vec3{0.5, 0, 1.5}));
  EXPECT_EQ(patch_piece(s.scene, s.scene.meshes[0], 2).centre() + shift, (Vec3{1.5, 0, 0.5}));
  EXPECT_EQ(patch_piece(s.scene, s.scene.meshes[1], 1).centre() + shift, (Vec3{1.5, 0, 0.5}));
  const Piece cell = cell_piece(s.scene, s.scene.meshes[1], 1);
  // v(c, r), v(c, r+1), v(c+1, r+1), v(c+1, r)
  EXPECT_EQ(cell.corner[0] + shift, (Vec3{1, 0, 0}));
  EXPECT_EQ(cell.corner[1] + shift, (Vec3{1, 0, 1}));
  EXPECT_EQ(cell.corner[2] + shift, (Vec3{2, 0, 1}));
  EXPECT_EQ(cell.corner[3] + shift, (Vec3{2, 0, 0}));
  EXPECT_GT(cell.vector_area().y, 0);
}

TEST(Mesh, ATrianglesPiecesAreNumberedAsTheyLie) {
  for (std::uint32_t k = 1; k < 12; ++k) {
    std::uint32_t local = 0;
    for (std::uint32_t v = 0; v < k; ++v) {
      for (std::uint32_t u = 0; u + v < k; ++u) {
        for (const bool inverted : {false, true}) {
          if (inverted && u + v + 1 == k) continue;  // beyond the third edge
          const PieceIndex index = triangle_piece(k, local);
          EXPECT_TRUE(index.u == u && index.v == v && index.inverted == inverted) << k << " " << local;
          EXPECT_EQ(triangle_piece_order(k, index), local);
          ++local;
        }
      }
    }
    EXPECT_EQ(local, k * k);
  }
}

TEST(Mesh, TrianglesHaveTheirCentroidAndAreCutAlike) {
  const LoadedScene s(kStart + "tri m 0 0 0  4 0 0  1 3 0 patches 4 sub 1");
  const Mesh& mesh = s.scene.meshes[0];
  Vec3 mean;
  for (std::uint32_t p = 0; p < 16; ++p) {
    const Piece piece = patch_piece(s.scene, mesh, p);
    EXPECT_NEAR(piece.vector_area().z, 6.0 / 16, kRounding);
    EXPECT_NEAR(piece.longest_side(), std::sqrt(18.0) / 4, kRounding);
    const Vec3 centroid = (1.0 / 3) * (piece.corner[0] + piece.corner[1] + piece.corner[2]);
    EXPECT_LT(length(piece.centre() - centroid), kRounding);
    mean = mean + (1.0 / 16) * piece.centre();
  }
  EXPECT_LT(length(mean + s.scene.origin - Vec3{5.0 / 3, 1, 0}), kRounding);
}

TEST(Mesh, LongestSideIsTheLongestOfThem) {
  const LoadedScene s(kStart + "quad m 0 0 0  4 0 0  3 2 0  0 2 0 patches 1 1");
  EXPECT_EQ(patch_piece(s.scene, s.scene.meshes[0], 0).longest_side(), 4);
}

}  // namespace
}  // namespace shodo
