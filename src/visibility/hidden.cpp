// Hidden samples (paper 2.1 has none: deviation D4; design: direct light): inside an object or under one that stands on
// the surface.
//
// A sample that sees backs is enclosed by them. Sixteen directions in four rings over the hemisphere, from nearly along
// the normal to nearly along the surface, each found on the lattice. The first, next to the normal, must meet a back,
// so a sample in the open costs one ray mostly. Of the others it is enough if some do: under furniture that stands at
// a wall one sees that wall, and its skirting, from the front, in up to half of all directions; where all objects are
// closed, no back is seen from anywhere else. Exact: each ray. Approximate: that sixteen stand for all directions.
#include <cstdint>

#include "visibility/intersector.h"

namespace shodo {

namespace {

/// Along two tangents and the normal. The rings are turned against each other, and none lies along a tangent or the
/// normal, so that rays seldom run within faces that stand square on the surface.
constexpr double kDirections[16][3] = {
    {0.013, 0.009, 1.0},  {-0.06, 0.10, 1.0},   {-0.88, 0.35, 0.03}, {0.35, 0.88, 0.05},
    {0.62, -0.50, 0.30},  {-0.40, -0.85, 0.03}, {0.93, -0.30, 0.05}, {-0.55, 0.60, 0.30},
    {0.70, 0.66, 0.03},   {-0.69, -0.70, 0.05}, {0.21, -0.93, 0.10}, {-0.24, 0.92, 0.10},
    {0.50, 0.62, 0.30},   {-0.60, -0.55, 0.30}, {0.02, -0.99, 0.02}, {0.99, 0.09, 0.02}};
constexpr int kEnoughBacks = 6;

/// A unit vector square to a unit normal, from the axis along which the normal is smallest.
Vec3 tangent_of(const Vec3& n) {
  const double x = n.x < 0 ? -n.x : n.x, y = n.y < 0 ? -n.y : n.y, z = n.z < 0 ? -n.z : n.z;
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  return normalised(cross(axis, n));
}

}  // namespace

bool is_hidden(const Intersector& intersector, const LatticePoint& sample, const Vec3& normal) {
  const Vec3 tangent = tangent_of(normal);
  const Vec3 bitangent = cross(normal, tangent);
  int backs = 0;
  for (const double(&along)[3] : kDirections) {
    const Vec3 direction = along[0] * tangent + along[1] * bitangent + along[2] * normal;
    const Hit hit = intersector.nearest(sample, lattice_direction(direction));
    if (hit.triangle != kNone && !hit.front) ++backs;
    if (backs == 0) return false;
    if (backs == kEnoughBacks) return true;
  }
  return false;
}

}  // namespace shodo
