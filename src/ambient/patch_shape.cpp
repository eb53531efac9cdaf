#include "ambient/patch_shape.h"

namespace shodo {

namespace {

/// A quadrilateral is a parallelogram if its twist is below 2^-40 of its size: rounding, not shape.
constexpr double kParallel = 0x1p-80;

bool parallelogram(const PatchShape& shape) {
  return shape.outline == Outline::kQuad &&
         length_squared(shape.d) <= kParallel * (length_squared(shape.a) + length_squared(shape.b));
}

double smallest(double x, double y) { return x < y ? x : y; }
double largest(double x, double y) { return x > y ? x : y; }

}  // namespace

PatchShape shape_of(const Piece& piece) {
  PatchShape shape;
  const Vec3* c = piece.corner;
  if (piece.corners == 3) {
    shape.outline = Outline::kTriangle;
    shape.a = c[1] - c[0];
    shape.b = c[2] - c[0];
    return shape;
  }
  shape.outline = piece.concave ? Outline::kConcave : Outline::kQuad;
  shape.a = 0.25 * ((c[1] - c[0]) + (c[2] - c[3]));
  shape.b = 0.25 * ((c[3] - c[0]) + (c[2] - c[1]));
  shape.d = 0.25 * ((c[0] - c[1]) + (c[2] - c[3]));
  if (shape.outline == Outline::kConcave) return shape;
  if (parallelogram(shape)) {
    shape.d = {};
    return shape;
  }
  const Vec3 area = cross(shape.a, shape.b);
  const double squared = length_squared(area);
  if (squared > 0) {
    shape.alpha = dot(area, cross(shape.a, shape.d)) / squared;
    shape.beta = dot(area, cross(shape.d, shape.b)) / squared;
    shape.even = 0;
  }
  return shape;
}

Extent extent_along(const PatchShape& shape, double longest_side, const Vec3& direction) {
  // The centre is the middle of the diagonal that lies within, which is at most a side from both other corners.
  if (shape.outline == Outline::kConcave) return {-longest_side, longest_side};
  const double a = dot(shape.a, direction), b = dot(shape.b, direction);
  if (shape.outline == Outline::kTriangle) {
    const double c0 = -(a + b) / 3, c1 = c0 + a, c2 = c0 + b;
    return {smallest(c0, smallest(c1, c2)), largest(c0, largest(c1, c2))};
  }
  const double d = dot(shape.d, direction);
  const double c0 = d - (a + b), c1 = (a - b) - d, c2 = d + (a + b), c3 = (b - a) - d;
  return {smallest(smallest(c0, c1), smallest(c2, c3)), largest(largest(c0, c1), largest(c2, c3))};
}

std::uint32_t shape_count(const Scene& scene, const Mesh& mesh) {
  if (mesh.kind == MeshKind::kTriangle) return mesh.nu > 1 ? 2 : 1;
  if (mesh.kind == MeshKind::kQuad && parallelogram(shape_of(cell_piece(scene, mesh, 0)))) return 1;
  return mesh.patch_count();
}

std::uint32_t shape_index(std::uint32_t shapes_of_mesh, const Mesh& mesh, std::uint32_t local) {
  if (mesh.kind == MeshKind::kTriangle) return triangle_piece(mesh.nu, local).inverted ? 1 : 0;
  return shapes_of_mesh == 1 ? 0 : local;
}

}  // namespace shodo
