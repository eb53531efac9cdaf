// The shape of a patch about its centre, shared by all patches of a mesh that are congruent.
//
// The bilinear surface of a quadrilateral is centre + x a + y b + x y d with x, y in [-1, 1]; a triangle is the same
// with d = 0 and barycentric x, y (ambient/sample_set.h). The area element over the mean is 1 + alpha x + beta y,
// projected on the patch's mean normal: exact for planar quadrilaterals, and by construction it sums to the vector
// area of others (saddles). A concave patch has no such map; its form factors come from its two triangles, and its
// samples from Piece::point. 96 bytes a shape: one for a parallelogram's mesh, two for a triangle's, else one a patch.
#pragma once

#include <cstdint>

#include "base/vector.h"
#include "scene/mesh.h"

namespace shodo {

enum class Outline : std::uint32_t { kQuad, kTriangle, kConcave };

struct PatchShape {
  Vec3 a, b, d;                 // scene units
  double alpha = 0, beta = 0;   // of the area element
  features::FixedUnless<features::kMeshes, Outline, Outline::kQuad> outline = Outline::kQuad;
  std::uint32_t even = 1;       // alpha and beta are 0

  Vec3 offset(double x, double y) const { return (x * a + y * b) + (x * y) * d; }
};

/// Lowest and highest corner along `direction` (unit), relative to the patch's centre.
struct Extent {
  double low, high;
};

/// A concave patch gets bounds only: its corners are within two longest sides of its centre.
Extent extent_along(const PatchShape& shape, double longest_side, const Vec3& direction);

PatchShape shape_of(const Piece& piece);

/// Distinct shapes of a mesh (shape k is that of its patch k), and which of them patch `local` has.
std::uint32_t shape_count(const Scene& scene, const Mesh& mesh);
std::uint32_t shape_index(std::uint32_t shapes_of_mesh, const Mesh& mesh, std::uint32_t local);

}  // namespace shodo
