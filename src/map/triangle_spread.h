// Spreading patch means over a divided triangle (paper 2.3), continuously and with each patch's mean kept.
//
// Every corner of the patches' lattice gets a value that is right for linear light, a patch is linear between its
// three, and a bubble 27 a b c (a, b, c barycentric), which is 0 on the sides, brings its mean to what it has to be.
// A corner value is from 0 to 1.5 times its darkest patch, so that no bubble dips below 0: the least corner is then
// at least 1.35 times the bubble's depth.
#pragma once

#include <cstdint>
#include <span>

namespace shodo {

/// Doubles of scratch for a triangle with `k` divisions: two for each corner.
constexpr std::uint32_t triangle_scratch(std::uint32_t k) { return (k + 1) * (k + 2); }

/// Means of the k^2 patches in piece order, none negative; `result` gets those of the (k parts)^2 sub-patches.
void spread_triangle(std::span<const double> patch, std::uint32_t k, std::uint32_t parts, std::span<double> scratch,
                     std::span<double> result);

}  // namespace shodo
