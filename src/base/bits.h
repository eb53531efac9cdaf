// Sets of up to 32 things, a bit each. The compiler's own functions would call its run-time library on some machines.
#pragma once

#include <cstdint>

namespace shodo {

constexpr std::uint32_t count_bits(std::uint32_t x) {
  x -= x >> 1 & 0x55555555;
  x = (x & 0x33333333) + (x >> 2 & 0x33333333);
  return (((x + (x >> 4)) & 0x0F0F0F0F) * 0x01010101) >> 24;
}

/// visit(k, bit) for each, ascending.
template <class Visit>
constexpr void for_each_bit(std::uint32_t bits, Visit visit) {
  std::uint32_t bit = 1;
  for (std::uint32_t k = 0; bits != 0; ++k, bit <<= 1, bits >>= 1) {
    if ((bits & 1) != 0) visit(k, bit);
  }
}

}  // namespace shodo
