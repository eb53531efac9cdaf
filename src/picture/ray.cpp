#include "picture/ray.h"

#include <bit>

#include "visibility/half_open.h"

namespace shodo {

namespace {

std::int64_t magnitude(std::int64_t x) { return x < 0 ? -x : x; }

std::int64_t largest_component(const LatticeVector& a) {
  const std::int64_t x = magnitude(a.x), y = magnitude(a.y), z = magnitude(a.z);
  const std::int64_t xy = x > y ? x : y;
  return xy > z ? xy : z;
}

/// a / b to the nearest, halves away from zero; b above 0.
std::int64_t rounded_quotient(std::int64_t a, std::int64_t b) {
  const std::int64_t size = (magnitude(a) + b / 2) / b;
  return a < 0 ? -size : size;
}

/// By how many bits a positive number has to go right to have at most `bits`.
int shift_to(std::int64_t a, int bits) {
  const int width = 64 - std::countl_zero(static_cast<std::uint64_t>(a));
  return width > bits ? width - bits : 0;
}

LatticeVector normal_of(const DrawnTriangle& t) { return cross(t.vertex[1] - t.vertex[0], t.vertex[2] - t.vertex[0]); }

std::int32_t odd_near(std::int64_t whole, std::int64_t part, std::int64_t of) {
  // whole + part / of to the odd number that is nearest: 2 floor(x / 2) + 1.
  const std::int64_t twice = 2 * of;
  const std::int64_t even = whole >= 0 ? whole / 2 : -((1 - whole) / 2);
  const std::int64_t rest = (whole - 2 * even) * of + part;
  const std::int64_t steps = rest >= 0 ? rest / twice : -((twice - 1 - rest) / twice);
  return static_cast<std::int32_t>(2 * (even + steps) + 1);
}

}  // namespace

LatticeVector ray_direction(const LatticeVector& any) {
  const std::int64_t largest = largest_component(any);
  if (largest == 0) return {};
  const int right = shift_to(largest, 42);
  const LatticeVector a{any.x >> right, any.y >> right, any.z >> right};
  const std::int64_t whole = largest >> right;
  LatticeVector d{rounded_quotient(a.x * kRayLength, whole), rounded_quotient(a.y * kRayLength, whole),
                  rounded_quotient(a.z * kRayLength, whole)};
  for (std::int64_t* const c : {&d.x, &d.y, &d.z}) {  // a negative component may be one above after the shift
    if (*c < -kRayLength) *c = -kRayLength;
  }
  return d;
}

bool meet(const DrawnTriangle& triangle, std::uint32_t index, const Ray& ray, RayHit& hit) {
  const LatticeVector &d = ray.direction, a = triangle.vertex[0] - ray.origin, b = triangle.vertex[1] - ray.origin,
                      c = triangle.vertex[2] - ray.origin;
  const EdgeSide ab = edge_side(d, a, b), bc = edge_side(d, b, c);
  if (ab.sign != bc.sign || ab.sign == 0) return false;
  const EdgeSide ca = edge_side(d, c, a);
  if (ca.sign != ab.sign) return false;
  const std::int64_t through = ab.value + bc.value + ca.value;
  const std::int64_t side = -dot(a, cross(b, c));  // s(origin)
  if (through > 0 ? side >= 0 : through == 0 || side <= 0) return false;
  hit = {index, side > 0, magnitude(side), magnitude(through), magnitude(ca.value), magnitude(ab.value)};
  return true;
}

bool meet_plane(const DrawnTriangle& triangle, std::uint32_t index, const Ray& ray, RayHit& hit) {
  const LatticeVector &d = ray.direction, a = triangle.vertex[0] - ray.origin, b = triangle.vertex[1] - ray.origin,
                      c = triangle.vertex[2] - ray.origin;
  const std::int64_t ab = dot(d, cross(a, b)), bc = dot(d, cross(b, c)), ca = dot(d, cross(c, a));
  const std::int64_t through = ab + bc + ca, side = -dot(a, cross(b, c));
  if (through > 0 ? side >= 0 : through == 0 || side <= 0) return false;
  const std::int64_t weight_b = through > 0 ? ca : -ca, weight_c = through > 0 ? ab : -ab;
  hit = {index, side > 0, magnitude(side), magnitude(through), weight_b, weight_c};
  return true;
}

bool comes_before(std::span<const DrawnTriangle> drawn, const RayHit& a, const RayHit& b) {
  const Int128 left = multiply(a.distance, b.speed), right = multiply(b.distance, a.speed);
  if (left != right) return left < right;
  return a.triangle != b.triangle && wins_tie(drawn, a.triangle, a.front, b.triangle, b.front);
}

MapPlace map_place(const DrawnTriangle& t, const RayHit& hit) {
  const int right = shift_to(hit.speed, 38);
  const std::int64_t whole = hit.speed >> right;
  const auto part = [&](std::int64_t weight) {  // 2^24: 1; a ray beside the triangle counts as on its border
    if (weight <= 0) return std::int64_t{0};
    return weight >= hit.speed ? std::int64_t{1} << 24 : ((weight >> right) << 24) / whole;
  };
  const std::int64_t b = part(hit.b), c = part(hit.c);
  const auto coordinate = [&](const std::int32_t (&at)[3]) {
    const std::int64_t along = (std::int64_t{at[1]} - at[0]) * b + (std::int64_t{at[2]} - at[0]) * c;
    return static_cast<std::int32_t>((std::int64_t{at[0]} << 4) + (along >> 20));
  };
  return {coordinate(t.u), coordinate(t.v)};
}

LatticePoint point_before(const DrawnTriangle& t, const Ray& ray, const RayHit& hit) {
  const int right = shift_to(hit.speed > hit.distance ? hit.speed : hit.distance, 40);
  const std::int64_t far = hit.distance >> right, fast = hit.speed >> right > 0 ? hit.speed >> right : 1;
  const LatticeVector& d = ray.direction;
  LatticePoint p{odd_near(ray.origin.x, d.x * far, fast), odd_near(ray.origin.y, d.y * far, fast),
                 odd_near(ray.origin.z, d.z * far, fast)};
  LatticeVector n = normal_of(t);
  if (!hit.front) n = {-n.x, -n.y, -n.z};
  const std::int64_t side = dot(n, p - t.vertex[0]);
  if (side > 0) return p;
  const std::int64_t largest = largest_component(n);
  const std::int64_t steps = 2 * (-side / (2 * largest) + 1);
  std::int32_t& at = largest == magnitude(n.x) ? p.x : largest == magnitude(n.y) ? p.y : p.z;
  const std::int64_t along = largest == magnitude(n.x) ? n.x : largest == magnitude(n.y) ? n.y : n.z;
  at = static_cast<std::int32_t>(at + (along > 0 ? steps : -steps));
  return p;
}

LatticeVector mirrored(const DrawnTriangle& triangle, const LatticeVector& d) {
  // All in 64 bits: |d'| = |d| n.n < 2^62.4, and 2 (d.n) n < 2^62.6.
  const LatticeVector n = ray_direction(normal_of(triangle));
  const std::int64_t squared = dot(n, n), twice = 2 * dot(d, n);
  return ray_direction({d.x * squared - twice * n.x, d.y * squared - twice * n.y, d.z * squared - twice * n.z});
}

}  // namespace shodo
