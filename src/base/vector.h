// Points, directions and colours in double precision. Sums run x, y, z: this fixes their rounding.
#pragma once

#include "base/elementary.h"

namespace shodo {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  constexpr bool operator==(const Vec3&) const = default;
};

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double length_squared(const Vec3& a) { return dot(a, a); }
inline double length(const Vec3& a) { return square_root(dot(a, a)); }
/// a / |a|; the zero vector stays zero.
inline Vec3 normalised(const Vec3& a) {
  const double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}

/// Red, green, blue; a grey scene uses the first only.
struct Rgb {
  double c[3] = {0, 0, 0};
  constexpr bool operator==(const Rgb&) const = default;
  constexpr bool grey() const { return c[0] == c[1] && c[1] == c[2]; }
};

}  // namespace shodo
