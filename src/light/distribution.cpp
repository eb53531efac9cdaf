#include "light/distribution.h"

namespace shodo {

double intensity(const Light& light, const Vec3& away) { return intensity(light, away, length(away)); }

double intensity(const Light& light, const Vec3& away, double length) {
  if (!light.aimed) return light.strength;
  const double along = dot(light.towards, away);
  if (!(along > 0)) return 0;
  const double cosine = along / length;
  return light.strength * power(cosine < 1 ? cosine : 1, light.cosine_exponent);
}

double attenuation(const Light& light, double metres) {
  const double* k = light.attenuation;
  const double divisor = k[0] + k[1] * metres + k[2] * (metres * metres);
  return divisor > 0 ? 1 / divisor : 0;
}

bool inverse_square(const Light& light) {
  const double* k = light.attenuation;
  return k[0] == 0 && k[1] == 0 && k[2] == 1;
}

double relative_attenuation(const Light& light, double metres) {
  if (inverse_square(light)) return 1;
  return metres * metres * attenuation(light, metres);
}

}  // namespace shodo
