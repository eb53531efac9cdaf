// Form factors with a closed form (Howell's catalogue).
#pragma once

#include <cmath>

namespace shodo {

/// Howell C-11: opposed rectangles a x b at distance c.
inline double opposed(double a, double b, double c) {
  const double x = a / c, y = b / c, x1 = std::sqrt(1 + x * x), y1 = std::sqrt(1 + y * y);
  return 2 / (M_PI * x * y) *
         (std::log(x1 * y1 / std::sqrt(1 + x * x + y * y)) + x * y1 * std::atan(x / y1) + y * x1 * std::atan(y / x1) -
          x * std::atan(x) - y * std::atan(y));
}

/// Howell C-14: rectangles at right angles with a common edge l, from the one of width w to the one of height h.
inline double adjacent(double l, double w, double h) {
  const double W = w / l, H = h / l, s = W * W + H * H;
  const double a = (1 + W * W) * (1 + H * H) / (1 + s);
  const double b = W * W * (1 + s) / ((1 + W * W) * s), c = H * H * (1 + s) / ((1 + H * H) * s);
  return (W * std::atan(1 / W) + H * std::atan(1 / H) - std::sqrt(s) * std::atan(1 / std::sqrt(s)) +
          0.25 * (std::log(a) + W * W * std::log(b) + H * H * std::log(c))) /
         (M_PI * W);
}

/// C-11 of unit squares in long double: its terms cancel where they are near each other.
inline double near_plates(double d) {
  const long double x = 1 / static_cast<long double>(d), x1 = std::sqrt(1 + x * x);
  return static_cast<double>(2 / (static_cast<long double>(M_PIl) * x * x) *
                             (std::log(x1 * x1 / std::sqrt(1 + 2 * x * x)) + 2 * x * x1 * std::atan(x / x1) -
                              2 * x * std::atan(x)));
}

}  // namespace shodo
