#include "light/factor_field.h"

namespace shodo {

namespace {

/// c0 + c1 x + c2 x^2 through three values.
void parabola(double low, double middle, double high, double off, double& c0, double& c1, double& c2) {
  c0 = middle;
  c1 = (high - low) / (2 * off);
  c2 = (high + low - 2 * middle) / (2 * off * off);
}

}  // namespace

void FactorField::fit(const double (&value)[kNodes][kNodes]) {
  double row[kNodes][kNodes];
  for (std::uint32_t j = 0; j < kNodes; ++j) {
    parabola(value[j][0], value[j][1], value[j][2], kOff, row[j][0], row[j][1], row[j][2]);
  }
  for (std::uint32_t i = 0; i < kNodes; ++i) {
    parabola(row[0][i], row[1][i], row[2][i], kOff, c_[0][i], c_[1][i], c_[2][i]);
  }
}

double FactorField::mean(const PatchPlace& place) const {
  const double s2 = place.s * place.s + place.half_s * place.half_s * (1.0 / 3);
  const double t2 = place.t * place.t + place.half_t * place.half_t * (1.0 / 3);
  double along[kNodes];
  for (std::uint32_t j = 0; j < kNodes; ++j) along[j] = c_[j][0] + c_[j][1] * place.s + c_[j][2] * s2;
  const double factor = along[0] + along[1] * place.t + along[2] * t2;
  return factor > 0 ? factor : 0;
}

}  // namespace shodo
