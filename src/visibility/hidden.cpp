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

/// The directions over a surface, on the lattice.
class Directions {
 public:
  explicit Directions(const Vec3& normal)
      : normal_(normal), tangent_(tangent_of(normal)), bitangent_(cross(normal, tangent_)) {}
  LatticeVector at(const double (&along)[3]) const {
    return lattice_direction(along[0] * tangent_ + along[1] * bitangent_ + along[2] * normal_);
  }

 private:
  Vec3 normal_, tangent_, bitangent_;
};

/// What rays from a box along one direction meet: first all that is near is gathered, then, if need be, all else.
class Rays {
 public:
  Rays(Intersector& intersector, const LatticeBox& from, const LatticeVector& direction)
      : intersector_(intersector), from_(from), direction_(direction),
        gathered_(intersector.gather_near(from, direction)), all_(gathered_.any_triangle) {}
  bool meets_back(const LatticePoint& sample) {
    Hit hit = intersector_.nearest(sample, direction_, gathered_);
    if (!all_ && !hit.near) {
      gathered_ = intersector_.gather_along(from_, direction_);
      all_ = true;
      hit = intersector_.nearest(sample, direction_, gathered_);
    }
    return hit.triangle != kNone && !hit.front;
  }

 private:
  Intersector& intersector_;
  LatticeBox from_;
  LatticeVector direction_;
  Aim gathered_;
  bool all_;
};

}  // namespace

std::uint32_t hidden_samples(Intersector& intersector, std::span<const LatticePoint> samples, const Vec3& normal) {
  const Directions directions(normal);
  std::uint32_t backs[kMostHiddenSamples] = {};
  std::uint32_t open = 0, hidden = 0;  // a bit a sample: not decided yet, decided
  for (std::uint32_t k = 0; k < samples.size(); ++k) open |= std::uint32_t{1} << k;
  for (const double(&along)[3] : kDirections) {
    LatticeBox box;
    for (std::uint32_t k = 0; k < samples.size(); ++k) {
      if ((open >> k & 1) != 0) box.include(samples[k]);
    }
    Rays rays(intersector, box, directions.at(along));
    for (std::uint32_t k = 0; k < samples.size(); ++k) {
      const std::uint32_t bit = std::uint32_t{1} << k;
      if ((open & bit) == 0) continue;
      if (rays.meets_back(samples[k])) ++backs[k];
      if (backs[k] == kEnoughBacks) hidden |= bit;
      if (backs[k] == 0 || backs[k] == kEnoughBacks) open &= ~bit;
    }
    if (open == 0) break;
  }
  return hidden;
}

bool under_backs(Intersector& intersector, std::span<const LatticePoint> samples, const Vec3& normal) {
  LatticeBox box;
  for (const LatticePoint& sample : samples) box.include(sample);
  Rays rays(intersector, box, Directions(normal).at(kDirections[0]));
  for (const LatticePoint& sample : samples) {
    if (!rays.meets_back(sample)) return false;
  }
  return true;
}

}  // namespace shodo
