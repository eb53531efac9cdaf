#include "picture/shade.h"

#include <bit>

namespace shodo {

namespace {

/// How far right the inverse depth goes to have 31 bits.
int shift_to_31_bits(std::int64_t a) { return 64 - std::countl_zero(static_cast<std::uint64_t>(a)) - 31; }

std::int64_t shifted(std::int64_t a, int right) { return right >= 0 ? a >> right : a << -right; }

/// part / inverse_depth in 20.12; both carry their own bits (active_triangle.h).
std::int32_t quotient(std::int64_t part, std::int64_t inverse_depth, int shift) {
  // 12 bits wanted, and 12 that the inverse depth has more than the part.
  constexpr int kBits = 12 + kInverseDepthBits - kMapBits;
  return static_cast<std::int32_t>(shifted(part, shift - kBits) / shifted(inverse_depth, shift));
}

struct Axis {
  std::int32_t low, high;  // texels
  std::uint32_t weight;    // of `high`, 1/256
};

/// The two texels between whose centres a coordinate lies.
Axis axis_at(std::int32_t coordinate, std::int32_t count, bool wraps) {
  const std::int32_t from_centre = coordinate - 2048;
  Axis axis{from_centre >> 12, 0, static_cast<std::uint32_t>(from_centre >> 4 & 255)};
  axis.high = axis.low + 1;
  if (static_cast<std::uint32_t>(axis.low) < static_cast<std::uint32_t>(count - 1)) return axis;
  if (wraps) {
    axis.low %= count;
    if (axis.low < 0) axis.low += count;
    axis.high = axis.low + 1 == count ? 0 : axis.low + 1;
    return axis;
  }
  const auto clamped = [&](std::int32_t k) { return k < 0 ? 0 : k >= count ? count - 1 : k; };
  axis.low = clamped(axis.low);
  axis.high = clamped(axis.high);
  return axis;
}

std::uint32_t mix(std::uint32_t a, std::uint32_t b, std::uint32_t weight) { return a * (256 - weight) + b * weight; }

struct Corners {
  const std::uint16_t *low_low, *high_low, *low_high, *high_high;  // u, v
  std::uint32_t u_weight, v_weight;
};

Corners corners_at(const MapTexels& map, std::int32_t u, std::int32_t v) {
  const Axis a = axis_at(u, map.width, map.wraps_u), b = axis_at(v, map.height, false);
  const std::int32_t channels = static_cast<std::int32_t>(map.channels);
  const std::uint16_t* low = map.texel + std::ptrdiff_t{b.low} * map.width * channels;
  const std::uint16_t* high = map.texel + std::ptrdiff_t{b.high} * map.width * channels;
  return {low + a.low * channels, low + a.high * channels, high + a.low * channels, high + a.high * channels,
          a.weight, b.weight};
}

/// Rounded to the nearest; 65535 (2^16 - 1) times 2^16 and a half still fit 32 bits.
std::uint32_t bilinear(const Corners& at, std::uint32_t c) {
  const std::uint32_t low = mix(at.low_low[c], at.high_low[c], at.u_weight);
  const std::uint32_t high = mix(at.low_high[c], at.high_high[c], at.u_weight);
  return (mix(low, high, at.v_weight) + 32768) >> 16;
}

}  // namespace

MapWalk::MapWalk(const ActiveTriangle& active, const DrawnTriangle& drawn, const SampleGrid& grid, std::int32_t row,
                 std::int32_t x0, std::int32_t x1)
    : active_(&active), drawn_(&drawn), grid_(&grid), row_(row), x_(x0), end_(x1) {}

MapWalk::Point MapWalk::point(std::int32_t x) const {
  if (active_->wide) {
    const MapPoint exact = exact_map_point(*drawn_, *grid_, x, row_);
    return {exact.u, exact.v, 1};
  }
  const std::int64_t z = active_->inverse_depth.at(x);
  const int shift = shift_to_31_bits(z);
  return {(drawn_->u[0] << 4) + quotient(active_->map_u.at(x), z, shift),
          (drawn_->v[0] << 4) + quotient(active_->map_v.at(x), z, shift), z};
}

bool MapWalk::straight(const Point& a, const Point& b) {
  const std::int64_t near = a.inverse_depth > b.inverse_depth ? a.inverse_depth : b.inverse_depth;
  const std::int64_t far = a.inverse_depth > b.inverse_depth ? b.inverse_depth : a.inverse_depth;
  const int shift = shift_to_31_bits(near);
  const auto size = [](std::int64_t d) { return d < 0 ? -d : d; };
  const std::int64_t du = size(std::int64_t{a.u} - b.u), dv = size(std::int64_t{a.v} - b.v);
  // One unit for what the shift cuts off. Products are below 2^63: 31 bits each.
  return (du > dv ? du : dv) * (shifted(near - far, shift) + 1) <= 4 * kPieceTolerance * shifted(far, shift);
}

bool MapWalk::next(MapPiece& piece) {
  if (x_ >= end_) return false;
  const Point start = point(x_);
  piece = {x_, 1, start.u, start.v, 0, 0};
  std::int32_t last = end_ - x_ < kPieceLength ? end_ - x_ - 1 : kPieceLength - 1;
  if (active_->wide) last = 0;
  for (; last > 0; last /= 2) {
    const Point end = point(x_ + last);
    if (!straight(start, end)) continue;
    piece.length = last + 1;
    piece.du = (end.u - start.u) / last;
    piece.dv = (end.v - start.v) / last;
    break;
  }
  x_ += piece.length;
  return true;
}

std::uint32_t map_value(const MapTexels& map, std::int32_t u, std::int32_t v, std::uint32_t channel) {
  return bilinear(corners_at(map, u, v), channel);
}

void add_piece(const MapTexels& map, const MapPiece& piece, std::uint32_t shift, std::span<std::uint32_t> sums) {
  std::int32_t u = piece.u, v = piece.v;
  for (std::int32_t x = piece.x; x < piece.x + piece.length; ++x, u += piece.du, v += piece.dv) {
    const Corners at = corners_at(map, u, v);
    std::uint32_t* sum = &sums[(static_cast<std::uint32_t>(x) >> shift) * map.channels];
    for (std::uint32_t c = 0; c < map.channels; ++c) {
      const std::uint32_t value = bilinear(at, c);
      sum[c] += value < kWhite ? value : kWhite;
    }
  }
}

}  // namespace shodo
