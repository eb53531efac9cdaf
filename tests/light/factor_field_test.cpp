// The form factor over a patch, against polynomials and against Lambert's integral.
#include "light/factor_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "light/polygon_factor.h"

namespace shodo {
namespace {

template <class Function>
FactorField fitted(Function value_at) {
  double value[FactorField::kNodes][FactorField::kNodes];
  for (std::uint32_t j = 0; j < FactorField::kNodes; ++j) {
    for (std::uint32_t i = 0; i < FactorField::kNodes; ++i) {
      value[j][i] = value_at(FactorField::node(i), FactorField::node(j));
    }
  }
  FactorField field;
  field.fit(value);
  return field;
}

TEST(FactorField, OfABiquadraticHasItsMeanOverAnySubPatch) {
  for (int p = 0; p <= 2; ++p) {
    for (int q = 0; q <= 2; ++q) {
      const FactorField field = fitted([&](double s, double t) { return 3 + std::pow(s, p) * std::pow(t, q); });
      for (const PatchPlace& place : {PatchPlace{0, 0, 0.5, 0.5}, PatchPlace{-0.375, 0.25, 0.125, 0.25}}) {
        const auto mean = [](int n, double middle, double half) {
          return (std::pow(middle + half, n + 1) - std::pow(middle - half, n + 1)) / (2 * half * (n + 1));
        };
        const double expected = 3 + mean(p, place.s, place.half_s) * mean(q, place.t, place.half_t);
        EXPECT_NEAR(field.mean(place), expected, 1e-14) << p << " " << q;
      }
    }
  }
}

TEST(FactorField, AtFourRadiiIsWithinFourThousandthsOfLambertsIntegral) {
  // A patch of the unit square in the plane z = 0, lights above and beside it, and its 16 sub-patches.
  const double radius = std::sqrt(0.5);
  for (const double width : {0.1, 2.0}) {
    for (const double tilt : {0.0, 1.0}) {
      const Vec3 middle{tilt * 4 * radius, 0, 4 * radius};
      const Vec3 corner[4] = {middle + Vec3{-width, width, 0}, middle + Vec3{width, width, 0},
                              middle + Vec3{width, -width, 0}, middle + Vec3{-width, -width, 0}};
      const auto at = [&](double s, double t) { return point_to_polygon({s, t, 0}, {0, 0, 1}, corner, 4); };
      const FactorField field = fitted(at);
      for (int k = 0; k < 16; ++k) {
        const PatchPlace place{(k % 4 - 1.5) / 4, (k / 4 - 1.5) / 4, 0.125, 0.125};
        double mean = 0;
        for (int n = 0; n < 100; ++n) {
          mean += at(place.s + 0.125 * ((n % 10 + 0.5) / 5 - 1), place.t + 0.125 * ((n / 10 + 0.5) / 5 - 1)) / 100;
        }
        EXPECT_NEAR(field.mean(place), mean, 0.004 * mean) << width << " " << tilt << " " << k;
      }
    }
  }
}

TEST(FactorField, IsNeverNegative) {
  const FactorField field = fitted([](double s, double) { return s > 0 ? 1.0 : 0.0; });
  for (int k = 0; k < 100; ++k) EXPECT_GE(field.mean({(k - 49.5) / 100, 0, 0.005, 0.5}), 0);
}

}  // namespace
}  // namespace shodo
