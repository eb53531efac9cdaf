#include "ambient/spiral.h"

namespace shodo {

namespace {

constexpr double kCosine = -0x1.798869e0de833p-1, kSine = 0x1.59d9dd253cc13p-1;  // of 2 pi / 1.618...^2

}  // namespace

Spiral::Spiral(const Vec3& normal, std::uint32_t count, double turn)
    : normal_(normal), over_count_(1.0 / count), cosine_(cosine_degrees(360 * turn)), sine_(sine_degrees(360 * turn)) {
  const double x = magnitude(normal.x), y = magnitude(normal.y), z = magnitude(normal.z);
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  tangent_ = normalised(cross(axis, normal));
  bitangent_ = cross(normal, tangent_);
}

LatticeVector Spiral::next() {
  const double squared = (number_++ + 0.5) * over_count_, radius = square_root(squared);
  const Vec3 way = (radius * cosine_) * tangent_ + (radius * sine_) * bitangent_ + square_root(1 - squared) * normal_;
  const double turned = cosine_ * kCosine - sine_ * kSine;
  sine_ = sine_ * kCosine + cosine_ * kSine;
  cosine_ = turned;
  return lattice_direction(way);
}

}  // namespace shodo
