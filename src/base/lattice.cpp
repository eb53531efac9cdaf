#include "base/lattice.h"

namespace shodo {

namespace {

/// x rounded to the nearest integer, halves away from zero; it fits the type.
template <class Integer>
Integer round_away(double x) {
  const double m = magnitude(x);
  Integer whole = static_cast<Integer>(m);
  if (m - static_cast<double>(whole) >= 0.5) ++whole;
  return x < 0 ? -whole : whole;
}

std::int32_t even(double steps) { return static_cast<std::int32_t>(2 * round_away<std::int64_t>(0.5 * steps)); }

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
  const auto component = [&](double x) { return round_away<std::int32_t>(x / largest * kSteps); };
  return {component(d.x), component(d.y), component(d.z)};
}

Vec3 scene_point(const Lattice& lattice, const LatticePoint& p) {
  const double step = lattice.step();
  return {step * p.x, step * p.y, step * p.z};
}

}  // namespace shodo
