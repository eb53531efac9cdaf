#include "picture/texels.h"

#include "picture/display.h"

namespace shodo {

namespace {

/// Steps a sample beyond which a piece is looked up sample by sample, 1/65536 texel.
constexpr std::int32_t kFastest = 32767;

/// Samples of one parabola; more would fall short of the formula by more.
constexpr std::int32_t kMostTogether = 64;

constexpr std::int32_t kStepBits = 13;

/// floor(a b / 2^32): one multiplication, and its upper half.
std::int32_t multiply_high(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(std::int64_t{a} * b >> 32);
}

/// Texels (low u, low v) and, so many values on, their neighbours in u and in v.
struct Cell {
  const std::uint16_t* texel;
  std::ptrdiff_t to_u, to_v;
};

/// The two texels between whose centres a cell at the border of a map lies.
struct Pair {
  std::int32_t low, high;
};
Pair wrapped_pair(std::int32_t low, std::int32_t count) {
  low %= count;
  if (low < 0) low += count;
  return {low, low + 1 == count ? 0 : low + 1};
}
Pair clamped_pair(std::int32_t low, std::int32_t count) {
  if (low < 0) return {0, 0};
  return low + 1 < count ? Pair{low, low + 1} : Pair{count - 1, count - 1};
}

Cell border_cell(const MapTexels& map, std::int32_t u, std::int32_t v) {
  const Pair a = map.wraps_u ? wrapped_pair(u, map.width) : clamped_pair(u, map.width), b = clamped_pair(v, map.height);
  const std::ptrdiff_t next = static_cast<std::ptrdiff_t>(map.channels);  // one function serves both numbers
  return {map.texel + (std::ptrdiff_t{b.low} * map.width + a.low) * next, (a.high - a.low) * next,
          std::ptrdiff_t{b.high - b.low} * map.width * next};
}

template <std::uint32_t kChannels>
inline Cell cell_at(const MapTexels& map, std::int32_t u, std::int32_t v) {
  constexpr std::ptrdiff_t kNext = kChannels;
  if (static_cast<std::uint32_t>(u) < static_cast<std::uint32_t>(map.width - 1) &&
      static_cast<std::uint32_t>(v) < static_cast<std::uint32_t>(map.height - 1)) {
    return {map.texel + (std::ptrdiff_t{v} * map.width + u) * kNext, kNext, map.width * kNext};
  }
  return border_cell(map, u, v);
}

/// A value along the samples: display steps with 13 fraction bits and a half.
struct Ramp {
  std::int32_t value, rate, bend;

  std::int32_t next() {
    const std::int32_t step = value >> kStepBits;
    value += rate;
    rate += bend;
    return step;
  }
};

/// Where a piece is in a cell, from its middle, and how it goes on; all with 32 fraction bits.
struct Course {
  std::int32_t p, q, pq;
  std::int32_t dp, dq, dpq;  // to the next sample, dpq of the product p q; not used where a sample is alone
  std::int32_t dp_dq;
};

enum class Bright { kNone, kClipped, kRolled };  // what the samples at hand can need

template <Bright kBright>
inline std::uint32_t limited(std::int32_t step, const RollOff& roll) {
  const std::uint32_t steps = static_cast<std::uint32_t>(step);
  if constexpr (kBright == Bright::kRolled) return roll.shown(steps);
  return kBright == Bright::kNone || steps < kWhite ? steps : kWhite;
}

/// Shows samples at once.
template <std::uint32_t kChannels, Bright kBright>
void show_samples(Ramp* ramp, const SampleRow& row, std::int32_t x, std::int32_t count) {
  const std::uint8_t* const level = row.level;
  std::uint8_t* rgb = row.rgb + 3 * std::ptrdiff_t{x};
  const std::uint8_t* const end = rgb + 3 * std::ptrdiff_t{count};
  const auto shown = [&](Ramp& of) { return level[limited<kBright>(of.next(), row.roll)]; };
  Ramp first = ramp[0], second = ramp[kChannels / 2], third = ramp[kChannels - 1];
  for (; rgb != end; rgb += 3) {
    rgb[0] = shown(first);
    rgb[1] = kChannels == 1 ? rgb[0] : shown(second);
    rgb[2] = kChannels == 1 ? rgb[0] : shown(third);
  }
}

/// Adds samples to the sums of their pixels.
template <std::uint32_t kChannels, Bright kBright>
void add_samples(Ramp* ramp, const SampleRow& row, std::int32_t x, std::int32_t count) {
  std::uint32_t* sum = row.sums + std::ptrdiff_t{x} * kChannels;
  const std::uint32_t* const end = sum + std::ptrdiff_t{count} * kChannels;
  const std::uint32_t split = row.split;
  const auto shown = [&](Ramp& of) { return limited<kBright>(of.next(), row.roll) << split; };
  Ramp first = ramp[0], second = ramp[kChannels / 2], third = ramp[kChannels - 1];
  for (; sum != end; sum += kChannels) {
    sum[0] += shown(first);
    if (kChannels == 3) {
      sum[1] += shown(second);
      sum[2] += shown(third);
    }
  }
}

Course course_of(const PieceAxis& u, const PieceAxis& v) {
  const std::int32_t p = u.part - 32768, q = v.part - 32768;
  // The next sample is in the cell too, or nobody reads what is said of it.
  const std::uint32_t next = static_cast<std::uint32_t>(p + u.step) * static_cast<std::uint32_t>(q + v.step);
  return {p * 65536,      q * 65536,      p * q,
          u.step * 65536, v.step * 65536, static_cast<std::int32_t>(next - static_cast<std::uint32_t>(p * q)),
          u.step * v.step};
}

/// A cell in one channel: (sum + 2 b p + 2 c q) / 4 + d p q.
struct Corners {
  std::int32_t sum, b, c, d;
  std::int32_t bits;  // of all four texels

  Corners(const Cell& cell, std::uint32_t channel) {
    const std::uint16_t *low = cell.texel + channel, *high = low + cell.to_v;
    const std::int32_t low_low = low[0], high_low = low[cell.to_u], low_high = high[0], high_high = high[cell.to_u];
    const std::int32_t up = high_high - low_low, across = high_low - low_high;
    sum = high_high + low_low + high_low + low_high;
    b = up + across;
    c = up - across;
    d = high_high + low_low - high_low - low_high;
    bits = low_low | high_low | low_high | high_high;
  }
};

inline Ramp ramp_at(const Corners& of, const Course& at) {
  // So many bits more that the upper half of a product has 13 fraction bits; b, c and d are within 2^17.
  const std::int32_t b = of.b * (1 << (kStepBits - 1)), c = of.c * (1 << (kStepBits - 1)), d = of.d * (1 << kStepBits);
  return {of.sum * (1 << (kStepBits - 2)) + (1 << (kStepBits - 1)) + multiply_high(b, at.p) + multiply_high(c, at.q) +
              multiply_high(d, at.pq),
          multiply_high(b, at.dp) + multiply_high(c, at.dq) + multiply_high(d, at.dpq), multiply_high(2 * d, at.dp_dq)};
}

bool is_white(const Cell& cell, std::uint32_t channel) {
  const std::uint16_t *low = cell.texel + channel, *high = low + cell.to_v;
  return low[0] >= kWhite && low[cell.to_u] >= kWhite && high[0] >= kWhite && high[cell.to_u] >= kWhite;
}

template <std::uint32_t kChannels, Bright kBright>
void show_or_add(Ramp* ramp, const SampleRow& row, std::int32_t x, std::int32_t count) {
  row.to_sums ? add_samples<kChannels, kBright>(ramp, row, x, count)
              : show_samples<kChannels, kBright>(ramp, row, x, count);
}

/// Where a part of the map is lighter than white, or, where that is rolled off, than half of it.
template <std::uint32_t kChannels>
void show_bright(const Cell& cell, Ramp* ramp, const SampleRow& row, std::int32_t x, std::int32_t count) {
  if (row.roll.on) return show_or_add<kChannels, Bright::kRolled>(ramp, row, x, count);
  bool all_white = true;
  for (std::uint32_t c = 0; c < kChannels && all_white; ++c) all_white = is_white(cell, c);
  if (all_white) return show_plain(row, x, x + count, {kWhite, kWhite, kWhite});
  show_or_add<kChannels, Bright::kClipped>(ramp, row, x, count);
}

/// Where lookups go: to the screen, clipped at white, or to sums as they are.
enum class Target { kScreen, kSums };

template <std::uint32_t kChannels, Target kTarget>
inline void show_in_cell(const Cell& cell, const Course& course, const SampleRow& row, std::int32_t x,
                         std::int32_t count) {
  Ramp ramp[kChannels];
  std::int32_t bits = 0;
  const auto set = [&](std::uint32_t c) {
    const Corners corners(cell, c);
    bits |= corners.bits;
    ramp[c] = ramp_at(corners, course);
  };
  set(0);
  if constexpr (kChannels == 3) {
    set(1);
    set(2);
  }
  if constexpr (kTarget == Target::kSums) return add_samples<kChannels, Bright::kNone>(ramp, row, x, count);
  if (bits >= static_cast<std::int32_t>(row.roll.on ? kWhite / 2 : kWhite)) {  // powers of two
    show_bright<kChannels>(cell, ramp, row, x, count);
  } else {
    show_or_add<kChannels, Bright::kNone>(ramp, row, x, count);
  }
}

template <std::uint32_t kChannels, Target kTarget>
void show_cells(const MapTexels& map, const MapPiece& piece, const SampleRow& row) {
  PieceAxis u(piece.u, piece.du), v(piece.v, piece.dv);
  std::int32_t stay_u = u.stay(piece.length), stay_v = v.stay(piece.length);
  std::int32_t x = piece.x;
  for (const std::int32_t end = x + piece.length; x < end;) {
    std::int32_t count = stay_u < stay_v ? stay_u : stay_v;
    if (count > end - x) count = end - x;
    if (count > kMostTogether) count = kMostTogether;
    show_in_cell<kChannels, kTarget>(cell_at<kChannels>(map, u.cell, v.cell), course_of(u, v), row, x, count);
    x += count;
    u.move(count);
    v.move(count);
    stay_u = stay_u == count ? u.stay(piece.length) : stay_u - count;
    stay_v = stay_v == count ? v.stay(piece.length) : stay_v - count;
  }
}

template <std::uint32_t kChannels>
void look_up(const MapTexels& map, const PieceAxis& u, const PieceAxis& v, std::uint32_t (&steps)[3]) {
  const Cell cell = cell_at<kChannels>(map, u.cell, v.cell);
  const std::int32_t p = u.part - 32768, q = v.part - 32768;
  for (std::uint32_t c = 0; c < kChannels; ++c) {
    Ramp ramp = ramp_at(Corners(cell, c), {p * 65536, q * 65536, p * q, 0, 0, 0, 0});
    steps[c] = static_cast<std::uint32_t>(ramp.next());
  }
}

/// One lookup a sample, where texels are smaller than samples.
void show_each(const MapTexels& map, const MapPiece& piece, const SampleRow& row) {
  PieceLookup lookup(map, piece);
  for (std::int32_t x = piece.x; x < piece.x + piece.length; ++x) {
    std::uint32_t steps[3];
    lookup.next(steps);
    for (std::uint32_t c = 0; c < map.channels; ++c) steps[c] = row.roll.shown(steps[c]);
    show_plain(row, x, x + 1, steps);
  }
}

/// Whether cells are worth looking for.
bool is_slow(const MapPiece& piece) {
  const auto slow = [](std::int32_t step) { return step <= kFastest && step >= -kFastest; };
  return slow(piece.du) && slow(piece.dv);
}

template <std::uint32_t kChannels>
void show(const MapTexels& map, const MapPiece& piece, const SampleRow& row) {
  is_slow(piece) ? show_cells<kChannels, Target::kScreen>(map, piece, row) : show_each(map, piece, row);
}

}  // namespace

void show_plain(const SampleRow& row, std::int32_t x0, std::int32_t x1, const std::uint32_t (&steps)[3]) {
  const std::uint32_t channels = row.channels;
  if (!row.to_sums) {
    const std::uint8_t first = row.level[steps[0]], second = row.level[steps[channels / 2]],
                       third = row.level[steps[channels - 1]];
    const std::uint8_t* const end = row.rgb + 3 * std::ptrdiff_t{x1};
    for (std::uint8_t* rgb = row.rgb + 3 * std::ptrdiff_t{x0}; rgb != end; rgb += 3) {
      rgb[0] = first;
      rgb[1] = second;
      rgb[2] = third;
    }
    return;
  }
  std::uint32_t* sum = row.sums + static_cast<std::uint32_t>(x0) * channels;
  for (std::int32_t x = x0; x < x1; ++x) {
    for (std::uint32_t c = 0; c < channels; ++c) *sum++ += steps[c] << row.split;
  }
}

void PieceLookup::next(std::uint32_t (&steps)[3]) {
  map_->channels == 1 ? look_up<1>(*map_, u_, v_, steps) : look_up<3>(*map_, u_, v_, steps);
  u_.move(1);
  v_.move(1);
}

void show_piece(const MapTexels& map, const MapPiece& piece, const SampleRow& row) {
  map.channels == 1 ? show<1>(map, piece, row) : show<3>(map, piece, row);
}

void add_piece(const MapTexels& map, const MapPiece& piece, std::uint32_t* steps) {
  if (is_slow(piece)) {
    SampleRow row;
    row.sums = steps;
    row.to_sums = true;
    row.channels = map.channels;
    if (map.channels == 1) return show_cells<1, Target::kSums>(map, piece, row);
    return show_cells<3, Target::kSums>(map, piece, row);
  }
  PieceLookup lookup(map, piece);
  steps += static_cast<std::uint32_t>(piece.x) * map.channels;
  for (std::int32_t k = 0; k < piece.length; ++k, steps += map.channels) {
    std::uint32_t here[3];
    lookup.next(here);
    for (std::uint32_t c = 0; c < map.channels; ++c) steps[c] += here[c];
  }
}

}  // namespace shodo
