// Direct light on a point by chance, as the tracer of tests/truth takes it: one sample of each light with nothing in
// the way, one of them chosen by what it would bring, and a ray to that one; each sun has a ray of its own.
//
// Faces that shine are triangles. One is chosen by a rough form factor (never nothing where it might shine); a near
// one is sampled evenly over its solid angle (Arvo 1995), so that contacts have a bounded variance, a far one over its
// area. Both have the mean of L cos dw over it exactly. Nothing is clamped.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "truth/world.h"

namespace shodo::truth {

/// Weyl's sequence, mixed (Steele, Lea and Flood 2014). The seed is mixed too: neighbours' sequences would be one and
/// the same, a step apart.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(mixed(mixed(seed + 1) ^ 0x632BE59BD9B4E019u)) {}
  double next() { return static_cast<double>(mixed(state_ += 0x9E3779B97F4A7C15u) >> 11) * 0x1p-53; }

 private:
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
  }
  std::uint64_t state_;
};

class Lamps {
 public:
  explicit Lamps(const World& world) : world_(world), metres_(world.scene().metres_per_unit) {
    for (const Light& light : world.scene().lights) {
      Lamp lamp{&light, {}};
      if (light.kind == LightKind::kArea) add(World::piece_of(light), lamp);
      if (light.kind == LightKind::kPolyhedron) {
        const Object& object = world.scene().objects[light.object];
        for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
          const Mesh& mesh = world.scene().meshes[m];
          for (std::uint32_t k = 0; k < cell_count(mesh); ++k) add(cell_piece(world.scene(), mesh, k), lamp);
        }
      }
      (light.kind == LightKind::kSun ? suns_ : lamps_).push_back(lamp);
    }
    if (lamps_.size() > kMost) lamps_.resize(kMost);
  }
  static constexpr std::size_t kMost = 64;

  /// An estimate of the direct illuminance at a place, lux, by channel.
  void light(const Place& place, Chance& chance, double (&lux)[3]) const {
    for (double& x : lux) x = 0;
    const Vec3 from = place.point + world_.small() * place.normal;
    for (const Lamp& lamp : suns_) {
      const Vec3 to = -lamp.light->towards;
      const double cosine = dot(to, place.normal);
      if (cosine > 0) add_ray(from, to, 1e300, *lamp.light, lamp.light->strength * cosine, lux);
    }
    Arrival arrivals[kMost];
    double total = 0;
    for (std::size_t l = 0; l < lamps_.size(); ++l) {
      arrivals[l] = arrival(lamps_[l], place, from, chance);
      total += arrivals[l].weight;
    }
    if (!(total > 0)) return;
    double at = chance.next() * total;
    std::size_t chosen = 0;
    for (std::size_t l = 0; l < lamps_.size(); ++l) {
      if (!(arrivals[l].weight > 0)) continue;
      chosen = l;
      at -= arrivals[l].weight;
      if (at < 0) break;
    }
    const Arrival& arrival = arrivals[chosen];
    add_ray(from, arrival.along, arrival.distance - world_.small(), *lamps_[chosen].light,
            arrival.lux * total / arrival.weight, lux);
  }

 private:
  struct Face {
    Vec3 corner[3], normal, centre;
    double area = 0, radius = 0;
  };
  struct Lamp {
    const Light* light;
    std::vector<Face> faces;
  };
  struct Arrival {
    Vec3 along;  // unit
    double distance = 0, lux = 0, weight = 0;
  };

  static void add(const Piece& piece, Lamp& lamp) {
    World::cut(piece, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const Vec3 n = cross(b - a, c - a);
      if (!(length(n) > 0)) return;
      Face face{{a, b, c}, normalised(n), (1.0 / 3) * (a + b + c), 0.5 * length(n), 0};
      for (const Vec3& corner : face.corner) face.radius = std::max(face.radius, length(corner - face.centre));
      lamp.faces.push_back(face);
    });
  }

  /// One over C + L d + Q d^2, d in metres.
  static double law(const Light& light, double d) {
    const double divisor = light.attenuation[0] + light.attenuation[1] * d + light.attenuation[2] * d * d;
    return divisor > 0 ? 1 / divisor : 0;
  }

  Arrival arrival(const Lamp& lamp, const Place& place, const Vec3& from, Chance& chance) const {
    const Light& light = *lamp.light;
    Arrival arrival;
    if (light.kind == LightKind::kPoint) {
      const Vec3 to = light.position - from;
      arrival.distance = length(to);
      arrival.along = (1 / arrival.distance) * to;
      double candela = light.strength;
      if (light.luminaire != kNone) {
        candela = table(light, -arrival.along);
      } else if (light.aimed) {
        const double cosine = -dot(light.towards, arrival.along);
        candela *= cosine > 0 ? std::pow(cosine, light.cosine_exponent) : 0;
      }
      arrival.lux = candela * dot(arrival.along, place.normal) * law(light, arrival.distance * metres_);
    } else {
      sample(lamp, place, from, chance, arrival);
      const double metres = length(light.position - from) * metres_;
      arrival.lux *= light.strength * metres * metres * law(light, metres);
    }
    if (!(arrival.lux > 0)) return {};
    arrival.weight = arrival.lux * (light.colour.c[0] + light.colour.c[1] + light.colour.c[2]);
    return arrival;
  }

  /// What a luminaire's file says of a direction, linear in both of its angles; found by walking along them.
  double table(const Light& light, const Vec3& along) const {
    const Luminaire& from = world_.scene().luminaires[light.luminaire];
    const double v = std::acos(std::clamp(dot(along, light.towards), -1.0, 1.0)) * 360 / kTwoPi;
    double h = std::atan2(dot(along, from.across), dot(along, from.along)) * 360 / kTwoPi;
    // Every half-plane of the circle that has these intensities; one of them is in the file.
    if (h < 0) h += 360;
    const double low = from.horizontal.front(), high = from.horizontal.back();
    for (const double same : {h, 360 - h, 180 - h, 180 + h, 540 - h, h - 180}) {
      if (same >= low && same <= high) {
        h = same;
        break;
      }
    }
    if (high == low) h = low;
    const auto next = [](std::span<const float> angles, double at) {
      std::size_t k = 1;
      while (k + 1 < angles.size() && static_cast<double>(angles[k]) < at) ++k;
      return k;
    };
    if (v < from.vertical.front() || v > from.vertical.back()) return 0;
    const std::size_t rows = from.vertical.size(), n = next(from.vertical, v);
    const double up = (v - from.vertical[n - 1]) / (static_cast<double>(from.vertical[n]) - from.vertical[n - 1]);
    const auto plane = [&](std::size_t k) {
      return (1 - up) * from.candela[k * rows + n - 1] + up * from.candela[k * rows + n];
    };
    if (from.horizontal.size() == 1) return plane(0);
    const std::size_t m = next(from.horizontal, h);
    const double low_side = from.horizontal[m - 1], high_side = from.horizontal[m];
    const double side = (h - low_side) / (high_side - low_side);
    return (1 - side) * plane(m - 1) + side * plane(m);
  }

  /// A point of a lamp's faces, and cos dw over the chance of it.
  void sample(const Lamp& lamp, const Place& place, const Vec3& from, Chance& chance, Arrival& arrival) const {
    thread_local std::vector<double> weight;
    weight.assign(lamp.faces.size(), 0);
    double total = 0;
    for (std::size_t f = 0; f < lamp.faces.size(); ++f) {
      const Face& face = lamp.faces[f];
      const double height = dot(face.normal, from - face.centre);
      if (!(height > 0) || dot(place.normal, face.centre - from) <= -face.radius) continue;
      const double d = std::max(length(face.centre - from), face.radius);
      total += weight[f] = face.area * (height + 0.2 * face.radius) / (d * d * d);
    }
    if (!(total > 0)) return;
    double at = chance.next() * total;
    std::size_t chosen = 0;
    for (std::size_t f = 0; f < lamp.faces.size(); ++f) {
      if (!(weight[f] > 0)) continue;
      chosen = f;
      at -= weight[f];
      if (at < 0) break;
    }
    const Face& face = lamp.faces[chosen];
    const double x = chance.next(), y = chance.next();
    double measure;
    if (length_squared(face.centre - from) > 9 * face.radius * face.radius) {
      const double root = std::sqrt(x);
      const Vec3 point = (1 - root) * face.corner[0] + (root * (1 - y)) * face.corner[1] + (root * y) * face.corner[2];
      const Vec3 to = point - from;
      arrival.distance = length(to);
      arrival.along = (1 / arrival.distance) * to;
      measure = face.area * -dot(face.normal, arrival.along) / (arrival.distance * arrival.distance);
    } else {
      arrival.along = in_solid_angle(face, from, x, y, measure);
      if (!(measure > 0)) return;
      const double sink = dot(face.normal, arrival.along);
      arrival.distance = sink < 0 ? dot(face.normal, face.centre - from) / sink : 0;
      if (!(arrival.distance > 0)) return;
    }
    const double cosine = dot(place.normal, arrival.along);
    if (cosine > 0 && measure > 0) arrival.lux = measure * cosine * total / weight[chosen];
  }

  /// Arvo, Stratified sampling of spherical triangles, SIGGRAPH 95; `angle`: the solid angle.
  static Vec3 in_solid_angle(const Face& face, const Vec3& from, double x, double y, double& angle) {
    const Vec3 a = normalised(face.corner[0] - from), b = normalised(face.corner[1] - from),
               c = normalised(face.corner[2] - from);
    const auto dihedral = [](const Vec3& at, const Vec3& p, const Vec3& q) {
      const Vec3 u = normalised(cross(at, p)), v = normalised(cross(at, q));
      return std::atan2(length(cross(u, v)), dot(u, v));
    };
    const double alpha = dihedral(a, b, c), beta = dihedral(b, c, a), gamma = dihedral(c, a, b);
    angle = alpha + beta + gamma - kPi;
    if (!(angle > 0)) return a;
    const double part = x * angle, s = std::sin(part - alpha), t = std::cos(part - alpha);
    const double u = t - std::cos(alpha), v = s + std::sin(alpha) * dot(a, b);
    const double below = (v * s + u * t) * std::sin(alpha);
    double q = below != 0 ? ((v * t - u * s) * std::cos(alpha) - v) / below : 1;
    q = std::min(1.0, std::max(-1.0, q));
    const Vec3 new_c = q * a + std::sqrt(1 - q * q) * normalised(c - dot(c, a) * a);
    const double z = 1 - y * (1 - dot(new_c, b));
    return normalised(z * b + std::sqrt(std::max(0.0, 1 - z * z)) * normalised(new_c - dot(new_c, b) * b));
  }

  /// What of it comes through.
  void add_ray(const Vec3& from, const Vec3& along, double end, const Light& light, double lux,
               double (&sum)[3]) const {
    double through[3];
    for (int c = 0; c < 3; ++c) through[c] = light.colour.c[c] * lux;
    bool blocked = false;
    world_.tree().between(from, along, end, [&](const Facet& facet) {
      if (facet.pane == 0) return blocked = true;
      const Rgb part = world_.transmit(facet);
      for (int c = 0; c < 3; ++c) through[c] *= part.c[c];
      return false;
    });
    for (int c = 0; c < 3 && !blocked; ++c) sum[c] += through[c];
  }

  const World& world_;
  double metres_;
  std::vector<Lamp> lamps_, suns_;
};

}  // namespace shodo::truth
