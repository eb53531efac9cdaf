// A furnished box, options with rules, and its equations solved as they stand: for the tests of rules and blocks.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "tests/ambient/ambient_scene.h"

namespace shodo {

inline Options with_rules(const Rules& rules) {
  Options options;
  options.rules = rules;
  options.tolerance = 1e-9;
  options.row_value_bits = 64;
  return options;
}

inline Rules rule(int number) {
  Rules rules;
  rules.rule1 = number == 1;
  rules.rule2 = number == 2;
  rules.rule3 = number == 3;
  return rules;
}

inline Rules blocks(double error) {
  Rules rules;
  rules.blocks = true;
  rules.blocks_error = error;
  return rules;
}

inline const char* const kTable =
    "object table\nquad white 1 1 0.7 1 2 0.7 3 2 0.7 3 1 0.7 patches 2 2 sub 1 1\n"
    "quad white 1 1 0.75 3 1 0.75 3 2 0.75 1 2 0.75 patches 2 3 sub 1 1\n";

inline std::string furnished(double rho, int k) {
  return grey(rho) + "display 1 50\n" + box_walls(4, 3, 2.5, 4 * k, 3 * k, 3 * k, "white") + kTable;
}

/// A bright spot on the floor, dim light on the wall x = 0, nothing elsewhere.
inline double e0_of(const Vec3& p, std::uint32_t m) {
  return m == 0 ? (p.x < 1 ? 400 : 20 * p.y) : m == 4 ? 2 * p.z : 0;
}

/// E = E0 + F rho E by plain repetition.
inline std::vector<double> solved(const std::vector<double>& f, const AmbientScene& scene, double rho) {
  const std::size_t n = scene.patches.size();
  std::vector<double> e(scene.lux), next(n);
  for (int k = 0; k < 400; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      next[i] = scene.lux[i];
      for (std::size_t j = 0; j < n; ++j) next[i] += f[i * n + j] * rho * e[j];
    }
    e = next;
  }
  return e;
}

inline double largest_difference(const std::vector<double>& e, const AmbientScene& scene) {
  double worst = 0;
  for (std::size_t i = 0; i < e.size(); ++i) worst = std::max(worst, std::abs(e[i] - scene.total(i)));
  return worst;
}

inline constexpr double kRho = 0.6;

}  // namespace shodo
