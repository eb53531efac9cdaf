#include "base/lattice.h"

namespace shodo {

namespace {

/// x rounded to the nearest integer, halves away from zero; |x| < 2^52.
std::int64_t round_away(double x) {
  const double m = magnitude(x);
  std::int64_t whole = static_cast<std::int64_t>(m);
  if (m - static_cast<double>(whole) >= 0.5) ++whole;
  return x < 0 ? -whole : whole;
}

std::int32_t even(double steps) { return static_cast<std::int32_t>(2 * round_away(0.5 * steps)); }

std::int32_t odd(double steps) {
  const std::int32_t below = 2 * static_cast<std::int32_t>(0.5 * magnitude(steps)) + 1;
  return steps < 0 ? -below : below;
}

}  // namespace

Lattice lattice_for(double half_extent) {
  Lattice lattice;
  if (!(half_extent > 0)) return lattice;
  while (half_extent * lattice.steps_per_unit > kLatticeHalf) lattice.steps_per_unit *= 0.5;
  while (half_extent * (2 * lattice.steps_per_unit) <= kLatticeHalf) lattice.steps_per_unit *= 2;
  return lattice;
}

LatticePoint even_point(const Lattice& lattice, const Vec3& p) {
  const double k = lattice.steps_per_unit;
  return {even(k * p.x), even(k * p.y), even(k * p.z)};
}

LatticePoint odd_point(const Lattice& lattice, const Vec3& p) {
  const double k = lattice.steps_per_unit;
  return {odd(k * p.x), odd(k * p.y), odd(k * p.z)};
}

LatticeVector lattice_direction(const Vec3& d) {
  double largest = magnitude(d.x);
  if (magnitude(d.y) > largest) largest = magnitude(d.y);
  if (magnitude(d.z) > largest) largest = magnitude(d.z);
  if (!(largest > 0)) return {};
  constexpr double kSteps = 1 << 20;
  return {round_away(d.x / largest * kSteps), round_away(d.y / largest * kSteps), round_away(d.z / largest * kSteps)};
}

Vec3 scene_point(const Lattice& lattice, const LatticePoint& p) {
  const double step = lattice.step();
  return {step * p.x, step * p.y, step * p.z};
}

}  // namespace shodo
