#include "picture/shade.h"

#include <bit>

namespace shodo {

namespace {

/// 2^61 / z for 2^30 <= z < 2^31, at most 2^31 - 1; at most 2^-28 of it too small. Newton: r = d (2 - z d), where d is
/// a quotient of the upper half of z, and z d within 2^-15 of 1.
std::int32_t reciprocal(std::uint32_t z) {
  const std::uint32_t d = 0xffffffffu / (z >> 15);  // 2^47 / z, below 2^17
  const std::int64_t off = (std::int64_t{1} << 47) - static_cast<std::int64_t>(std::uint64_t{z} * d);
  // off is above -2^32 and at most 2^31: the product fits 32 bits.
  const std::int32_t correction = static_cast<std::int32_t>(d) * static_cast<std::int32_t>(off >> 18) >> 15;
  return static_cast<std::int32_t>(d << 14) + correction;
}

/// The lower half of a >> right.
std::int32_t shifted(std::int64_t a, std::int32_t right) {
  if (right < 0) return static_cast<std::int32_t>(a << -right);
  const std::int32_t high = static_cast<std::int32_t>(a >> 32);
  const std::uint32_t low = static_cast<std::uint32_t>(a);
  if (right >= 32) return high >> (right - 32);
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(high) << 1 << (31 - right) | low >> right);
}

int leading_zeros(std::int64_t a) {
  const std::uint32_t high = static_cast<std::uint32_t>(a >> 32);
  return high != 0 ? std::countl_zero(high) : 32 + std::countl_zero(static_cast<std::uint32_t>(a));
}

/// part / inverse depth in 20.12, below 2^27: the part has 12 bits less than the inverse depth, and 12 are wanted.
std::int32_t quotient(std::int64_t part, std::int32_t shift, std::int32_t reciprocal_of_depth) {
  constexpr std::int32_t kBits = 27 - 12 - (kInverseDepthBits - kMapBits);
  return static_cast<std::int32_t>(std::int64_t{shifted(part, shift + kBits)} * reciprocal_of_depth >> 32) >> 2;
}

}  // namespace

MapWalk::Point MapWalk::point(std::int32_t x) const {
  const std::int32_t column = column_of_0_ + (x << bits_);
  if (active_->wide_map) {
    const MapPoint exact = exact_map_point(*drawn_, *grid_, column, row_);
    return {exact.u, exact.v, 1, 0};
  }
  const std::int64_t z = active_->inverse_depth.at(column);
  const std::int32_t shift = 64 - 31 - leading_zeros(z);
  const std::int32_t cut = shifted(z, shift), inverse = reciprocal(static_cast<std::uint32_t>(cut));
  return {(drawn_->u[0] << 4) + quotient(active_->map_u.at(column), shift, inverse),
          (drawn_->v[0] << 4) + quotient(active_->map_v.at(column), shift, inverse), static_cast<std::uint32_t>(cut),
          shift};
}

}  // namespace shodo
