#include "light/distribution.h"

#include "base/elementary.h"

namespace shodo {

namespace {

constexpr double kDegrees = 1 / kRadiansPerDegree;

/// Between two of ascending angles.
struct Between {
  std::size_t first = 0;
  double part = 0;  // of the way from the first to the next

  /// Of at least two; `degrees` is between the first and the last.
  Between(std::span<const float> angles, double degrees) {
    std::size_t next = angles.size() - 1;
    while (next - first > 1) {
      const std::size_t middle = first + (next - first) / 2;
      (static_cast<double>(angles[middle]) <= degrees ? first : next) = middle;
    }
    const double from = static_cast<double>(angles[first]);
    part = (degrees - from) / (static_cast<double>(angles[next]) - from);
  }
  double of(const float* candela) const {
    const double here = static_cast<double>(candela[first]);
    return here + part * (static_cast<double>(candela[first + 1]) - here);
  }
};

double candela_of(const Luminaire& luminaire, const Vec3& towards, const Vec3& away) {
  const std::span<const float> vertical = luminaire.vertical, horizontal = luminaire.horizontal;
  const double x = dot(away, luminaire.along), y = dot(away, luminaire.across);
  const double degrees = kDegrees * arctangent2(square_root(x * x + y * y), dot(away, towards));
  if (degrees < static_cast<double>(vertical.front()) || degrees > static_cast<double>(vertical.back())) return 0;
  const Between v(vertical, degrees);
  const float* plane = luminaire.candela.data();
  if (horizontal.size() == 1) return v.of(plane);
  double around = kDegrees * arctangent2(y, x);
  if (around < 0) around += 360;
  // What the file leaves out is the mirror image of what it has, at its first and its last half-plane.
  const double first = static_cast<double>(horizontal.front()), last = static_cast<double>(horizontal.back());
  while (around > last || around < first) around = 2 * (around > last ? last : first) - around;
  const Between h(horizontal, around);
  plane += h.first * vertical.size();
  const double here = v.of(plane);
  return here + h.part * (v.of(plane + vertical.size()) - here);
}

}  // namespace

double intensity(const Scene& scene, const Light& light, const Vec3& away) {
  return intensity(scene, light, away, length(away));
}

double intensity(const Scene& scene, const Light& light, const Vec3& away, double length) {
  if (features::kLuminaires && light.luminaire != kNone) {
    return candela_of(scene.luminaires[light.luminaire], light.towards, away);
  }
  if (!light.aimed) return light.strength;
  const double along = dot(light.towards, away);
  if (!(along > 0)) return 0;
  const double cosine = along / length;
  return light.strength * power(cosine < 1 ? cosine : 1, light.cosine_exponent);
}

double exponent_of(const Light& light) { return light.cosine_exponent > 0 ? light.cosine_exponent : 0; }

double solid_angle_of(const Light& light) {
  const bool shaped = light.aimed || (features::kLuminaires && light.luminaire != kNone);
  return shaped ? 2 * kPi / (light.cosine_exponent + 1) : 4 * kPi;
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
