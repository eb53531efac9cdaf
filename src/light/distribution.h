// Luminous-intensity distributions and attenuation of lights (paper 2.1).
#pragma once

#include "scene/scene.h"

namespace shodo {

/// Luminous intensity of a point light in direction `away` (from the light, any length), cd: I, I cos^n about `towards`
/// and 0 behind, or that of its luminaire, linear between the angles of the file. Nothing along the zero vector if the
/// light is aimed.
double intensity(const Scene& scene, const Light& light, const Vec3& away);
/// The same, given the length of `away`.
double intensity(const Scene& scene, const Light& light, const Vec3& away, double length);

/// The exponent of a cos^n that is about as narrow, 0 for a light that shines all round.
double exponent_of(const Light& light);
/// Solid angle over which the largest intensity gives all of a point light's flux, sr.
double solid_angle_of(const Light& light);

/// 1 / (C + L d + Q d^2), per square metre, d in metres; 0 where that is not a positive number. Finite for d > 0.
double attenuation(const Light& light, double metres);

/// Whether the attenuation is the inverse-square law itself, 0 0 1.
bool inverse_square(const Light& light);

/// What the attenuation makes of illuminance that already falls off as the inverse square: d^2 / (C + L d + Q d^2).
/// Exactly 1 for the inverse-square law itself.
double relative_attenuation(const Light& light, double metres);

}  // namespace shodo
