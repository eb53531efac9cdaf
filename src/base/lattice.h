// The integer lattice on which visibility and the picture are decided (design: exact visibility).
//
// Scene coordinates (scene units, already centred on the scene's box) times a power of two, rounded half away from the
// centre, so that a mirrored scene rounds mirrored. Coordinates lie within +-(2^19 - 16). Vertices are even, samples
// odd.
#pragma once

#include <cstdint>

#include "base/vector.h"

namespace shodo {

inline constexpr std::int32_t kLatticeHalf = (1 << 19) - 16;

/// A point of the lattice, steps from the scene's centre.
struct LatticePoint {
  std::int32_t x = 0, y = 0, z = 0;
  constexpr bool operator==(const LatticePoint&) const = default;
};

constexpr std::int32_t component(const LatticePoint& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// A difference of points, or a direction; components within +-2^20, of normals within +-2^41.
struct LatticeVector {
  std::int64_t x = 0, y = 0, z = 0;
  constexpr bool operator==(const LatticeVector&) const = default;
};

constexpr LatticeVector operator-(const LatticePoint& a, const LatticePoint& b) {
  return {std::int64_t{a.x} - b.x, std::int64_t{a.y} - b.y, std::int64_t{a.z} - b.z};
}
constexpr Vec3 vector_of(const LatticeVector& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
constexpr std::int64_t dot(const LatticeVector& a, const LatticeVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr LatticeVector cross(const LatticeVector& a, const LatticeVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A product of two differences of lattice points: one instruction on a machine of 32 bits.
constexpr std::int64_t product(std::int32_t a, std::int32_t b) { return std::int64_t{a} * b; }

struct Lattice {
  double steps_per_unit = 1;  // a power of two

  double step() const { return 1 / steps_per_unit; }
};

/// The finest lattice on which a box of the given half extent (largest axis, scene units) fits.
Lattice lattice_for(double half_extent);

/// Floating point becomes lattice here and nowhere else.
LatticePoint even_point(const Lattice& lattice, const Vec3& point);
/// The nearest point with three odd coordinates; an exact tie goes away from the centre.
LatticePoint odd_point(const Lattice& lattice, const Vec3& point);
/// A direction with its largest component scaled to +-2^20, rounded half away from zero; zero stays zero.
LatticeVector lattice_direction(const Vec3& direction);
/// Back to centred scene units; exact.
Vec3 scene_point(const Lattice& lattice, const LatticePoint& point);

}  // namespace shodo
