#include "visibility/hidden.h"

namespace shodo {

namespace {

/// Along two tangents and the normal. The rings are turned against each other, and none lies along a tangent or the
/// normal, so that rays seldom run within faces that stand square on the surface.
constexpr double kDirections[16][3] = {
    {0.013, 0.009, 1.0},  {-0.06, 0.10, 1.0},   {-0.88, 0.35, 0.03}, {0.35, 0.88, 0.05},
    {0.62, -0.50, 0.30},  {-0.40, -0.85, 0.03}, {0.93, -0.30, 0.05}, {-0.55, 0.60, 0.30},
    {0.70, 0.66, 0.03},   {-0.69, -0.70, 0.05}, {0.21, -0.93, 0.10}, {-0.24, 0.92, 0.10},
    {0.50, 0.62, 0.30},   {-0.60, -0.55, 0.30}, {0.02, -0.99, 0.02}, {0.99, 0.09, 0.02}};
constexpr std::uint32_t kEnoughBacks = 6;

/// A unit vector square to a unit normal, from the axis along which the normal is smallest.
Vec3 tangent_of(const Vec3& n) {
  const double x = magnitude(n.x), y = magnitude(n.y), z = magnitude(n.z);
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  return normalised(cross(axis, n));
}

}  // namespace

std::uint32_t hidden_samples(Intersector& intersector, std::span<const LatticePoint> samples, const Vec3& normal,
                             bool only_if_all) {
  const Vec3 tangent = tangent_of(normal), bitangent = cross(normal, tangent);
  std::uint32_t backs[kMostHiddenSamples] = {};
  std::uint32_t open = 0, hidden = 0;  // a bit a sample: not decided yet, decided
  for (std::uint32_t k = 0; k < samples.size(); ++k) open |= std::uint32_t{1} << k;
  for (const double(&along)[3] : kDirections) {
    const LatticeVector direction = lattice_direction(along[0] * tangent + along[1] * bitangent + along[2] * normal);
    LatticeBox box;
    for (std::uint32_t k = 0; k < samples.size(); ++k) {
      if ((open >> k & 1) != 0) box.include(samples[k]);
    }
    Aim gathered = intersector.gather_near(box, direction);
    bool all = gathered.any_triangle;
    for (std::uint32_t k = 0; k < samples.size(); ++k) {
      const std::uint32_t bit = std::uint32_t{1} << k;
      if ((open & bit) == 0) continue;
      Hit hit = intersector.nearest(samples[k], direction, gathered);
      if (!all && !hit.near) {
        gathered = intersector.gather_along(box, direction);
        all = true;
        hit = intersector.nearest(samples[k], direction, gathered);
      }
      if (hit.triangle != kNone && !hit.front) ++backs[k];
      if (backs[k] == kEnoughBacks) hidden |= bit;
      if (backs[k] == 0 || backs[k] == kEnoughBacks) open &= ~bit;
      if (backs[k] == 0 && only_if_all) return 0;
    }
    if (open == 0) break;
  }
  return hidden;
}

}  // namespace shodo
