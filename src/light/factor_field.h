// The form factor to an area or polyhedral light over a whole patch, nothing in the way: a biquadratic.
//
// Away from the light F is smooth, and sub-patches of one patch would find nearly the same integrals again and again.
// So it is found at 3 x 3 Chebyshev points of the patch and interpolated; a sub-patch takes the polynomial's mean over
// itself, which is exact. The error is about (r / D)^3 / 4 of F, r the radius of the patch and D the distance of the
// light: below 0.4 % from D = 4 r on, where alone it is used (deviation D6). Bytes: 80 a light.
#pragma once

#include <cstdint>

#include "base/vector.h"

namespace shodo {

/// A sub-patch on its patch, a parallelogram: the unit square, its middle at (0, 0).
struct PatchPlace {
  double s = 0, t = 0;            // the sub-patch's middle
  double half_s = 0, half_t = 0;  // half its sides
};

class FactorField {
 public:
  enum class State : std::uint8_t { kNotYet, kNone, kDark, kUsable };
  static constexpr std::uint32_t kNodes = 3;

  State state = State::kNotYet;

  /// Where node k lies, k < kNodes.
  static double node(std::uint32_t k) { return k == 0 ? -kOff : k == 1 ? 0 : kOff; }
  /// value[j][i]: at node(i) along s, node(j) along t.
  void fit(const double (&value)[kNodes][kNodes]);
  /// The mean over a sub-patch; not below 0.
  double mean(const PatchPlace& place) const;

 private:
  static constexpr double kOff = 0.43301270189221932;  // sqrt(3) / 4

  double c_[kNodes][kNodes];  // of s^i t^j: c_[j][i]
};

}  // namespace shodo
