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

/// By how many bits a positive number has to go right to have at most `bits`.
int shift_to(std::int64_t a, int bits) {
  const int width = 64 - std::countl_zero(static_cast<std::uint64_t>(a));
  return width > bits ? width - bits : 0;
}

LatticeVector normal_of(const DrawnTriangle& t) { return cross(t.vertex[1] - t.vertex[0], t.vertex[2] - t.vertex[0]); }

/// a / 2^right to the nearest, halves away from zero.
std::int64_t shifted(std::int64_t a, int right) {
  if (right == 0) return a;
  const std::int64_t size = (magnitude(a) + (std::int64_t{1} << (right - 1))) >> right;
  return a < 0 ? -size : size;
}

/// The nearest odd number to origin + d part / 2^kPartBits.
constexpr int kPartBits = 23;
std::int32_t odd_near(std::int32_t origin, std::int64_t d, std::int64_t part) {
  const std::int64_t at = (std::int64_t{origin} << kPartBits) + d * part;
  return static_cast<std::int32_t>(2 * (at >> (kPartBits + 1)) + 1);
}

/// A corner as the ray's origin sees it.
struct Corner {
  std::int32_t x, y, z;
};
Corner corner_from(const LatticePoint& p, const LatticePoint& origin) {
  return {p.x - origin.x, p.y - origin.y, p.z - origin.z};
}
LatticeVector vector_of(const Corner& c) { return {c.x, c.y, c.z}; }

/// d x b, of products of 32 bits.
LatticeVector moment(const LatticeVector& d, const Corner& b) {
  const std::int32_t x = static_cast<std::int32_t>(d.x), y = static_cast<std::int32_t>(d.y),
                     z = static_cast<std::int32_t>(d.z);
  return {product(y, b.z) - product(z, b.y), product(z, b.x) - product(x, b.z), product(x, b.y) - product(y, b.x)};
}
std::int64_t dot(const LatticeVector& m, const Corner& a) { return m.x * a.x + m.y * a.y + m.z * a.z; }

/// The sign of d.(a x b), given its value (visibility/half_open.h).
int sign_of(std::int64_t value, const LatticeVector& d, const Corner& a, const Corner& b) {
  if (value != 0) return value > 0 ? 1 : -1;
  return edge_side(d, vector_of(a), vector_of(b)).sign;
}

}  // namespace

LatticeVector ray_direction(const LatticeVector& any) {
  std::int64_t scale = 1;
  const std::int64_t largest = largest_component(any);
  while (largest > 0 && largest * scale < kRayLength / 2) scale *= 2;
  const int right = shift_to(largest, 20);
  const LatticeVector d{shifted(any.x * scale, right), shifted(any.y * scale, right), shifted(any.z * scale, right)};
  return d;
}

bool meet(const DrawnTriangle& triangle, std::uint32_t index, const Ray& ray, RayHit& hit) {
  const LatticeVector& d = ray.direction;
  const Corner a = corner_from(triangle.vertex[0], ray.origin), b = corner_from(triangle.vertex[1], ray.origin),
               c = corner_from(triangle.vertex[2], ray.origin);
  const LatticeVector m = moment(d, b);
  const std::int64_t ab = -dot(m, a), bc = dot(m, c);
  const int sign = sign_of(ab, d, a, b);
  if (sign == 0 || sign != sign_of(bc, d, b, c)) return false;
  const std::int64_t ca = dot(moment(d, c), a);
  if (sign != sign_of(ca, d, c, a)) return false;
  const std::int64_t through = ab + bc + ca;
  const std::int64_t side = -dot(cross(vector_of(b), vector_of(c)), a);  // s(origin)
  if (through > 0 ? side >= 0 : through == 0 || side <= 0) return false;
  hit = {index, side > 0, magnitude(side), magnitude(through), magnitude(ca), magnitude(ab)};
  return true;
}

bool comes_before(std::span<const DrawnTriangle> drawn, const RayHit& a, const RayHit& b) {
  const Int128 left = multiply(a.distance, b.speed), right = multiply(b.distance, a.speed);
  if (left != right) return left < right;
  return a.triangle != b.triangle && wins_tie(drawn, a.triangle, a.front, b.triangle, b.front);
}

MapPlace map_place(const DrawnTriangle& t, const RayHit& hit) {
  const int right = shift_to(hit.speed, 16);
  const std::uint32_t whole = static_cast<std::uint32_t>(hit.speed >> right);
  const auto part = [&](std::int64_t weight) {  // 2^16: 1
    const int more = right < 15 ? right : 15;  // as many bits as 32 hold
    const std::uint32_t scaled = static_cast<std::uint32_t>(weight >> (right - more)) << (15 - more);
    const std::uint32_t quotient = scaled / whole;  // of 2^15
    return std::int64_t{2} * quotient + 1;
  };
  const std::int64_t b = part(hit.b), c = part(hit.c);
  const auto coordinate = [&](const std::int32_t (&at)[3]) {
    const std::int64_t along = (std::int64_t{at[1]} - at[0]) * b + (std::int64_t{at[2]} - at[0]) * c;
    return static_cast<std::int32_t>((std::int64_t{at[0]} << 4) + (along >> 12));
  };
  return {coordinate(t.u), coordinate(t.v)};
}

std::int64_t side_of(const DrawnTriangle& triangle, const LatticePoint& point) {
  return dot(normal_of(triangle), point - triangle.vertex[0]);
}

LatticePoint point_at(const Ray& ray, const RayHit& hit) {
  const int right = shift_to(hit.speed > hit.distance ? hit.speed : hit.distance, 40);
  const std::int64_t far = hit.distance >> right, fast = hit.speed >> right > 0 ? hit.speed >> right : 1;
  const LatticeVector& d = ray.direction;
  const std::int64_t part = (far << kPartBits) / fast;
  return {odd_near(ray.origin.x, d.x, part), odd_near(ray.origin.y, d.y, part), odd_near(ray.origin.z, d.z, part)};
}

LatticePoint point_before(const DrawnTriangle& t, const Ray& ray, const RayHit& hit) {
  LatticePoint p = point_at(ray, hit);
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
