#include "support/optics_twin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/texture_twin.h"

namespace shodo {

namespace {

using Point = OpticsTwin::Point;
using Colour = OpticsTwin::Colour;

Point sub(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point along(const Point& a, double t, const Point& d) { return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point unit(const Point& a) { return along({0, 0, 0}, 1 / std::sqrt(dot(a, a)), a); }
Point of(const Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

OpticsTwin::OpticsTwin(const Scene& scene, const Geometry& geometry, const IlluminanceMaps& maps,
                       const SampleGrid& grid)
    : scene_(scene), geometry_(geometry), maps_(maps), grid_(grid) {
  const double step = 1 / geometry.lattice.steps_per_unit;
  for (std::uint32_t k = 0; k < geometry.drawn.size(); ++k) {
    Point v[3];
    for (int i = 0; i < 3; ++i) {
      const LatticePoint& p = geometry.drawn[k].vertex[i];
      v[i] = {step * p.x, step * p.y, step * p.z};
    }
    Triangle t{v[0], sub(v[1], v[0]), sub(v[2], v[0]), {}, k};
    t.normal = unit(cross(t.ab, t.ac));
    triangles_.push_back(t);
  }
}

const Optics* OpticsTwin::optics_of(const Triangle& triangle) const {
  const std::uint32_t mesh = geometry_.drawn[triangle.index].mesh;
  if (mesh == kNone) return nullptr;
  for (const Optics& optics : scene_.optics) {
    if (optics.material == scene_.meshes[mesh].material) return &optics;
  }
  return nullptr;
}

/// All hits in front of `from`, nearest first; openings only where they are seen.
std::vector<OpticsTwin::Hit> OpticsTwin::hits(const Point& from, const Point& way, double end) const {
  std::vector<Hit> found;
  for (const Triangle& triangle : triangles_) {
    const Point p = cross(way, triangle.ac);
    const double determinant = dot(triangle.ab, p);
    if (determinant == 0) continue;
    const Point s = sub(from, triangle.a);
    const double b = dot(s, p) / determinant;
    if (b < 0 || b > 1) continue;
    const Point q = cross(s, triangle.ab);
    const double c = dot(way, q) / determinant, t = dot(triangle.ac, q) / determinant;
    if (c < 0 || b + c > 1 || t <= 1e-7 || t >= end) continue;
    found.push_back({t, b, c, &triangle, dot(triangle.normal, way) < 0});
  }
  std::sort(found.begin(), found.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  return found;
}

Colour OpticsTwin::background(const Point& way) const {
  if (scene_.background.empty()) return {0, 0, 0};
  const Background& seen = scene_.background[0];
  const double sine = dot(unit(way), of(seen.up));
  Colour colour;
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] = sine < 0 ? seen.ground.c[c] : seen.horizon.c[c] + sine * sine * (seen.zenith.c[c] - seen.horizon.c[c]);
  }
  return colour;
}

/// Where a ray meets a triangle's plane.
OpticsTwin::Hit OpticsTwin::on_plane(const Triangle& triangle, const Point& from, const Point& way) {
  const Point p = cross(way, triangle.ac), s = sub(from, triangle.a), q = cross(s, triangle.ab);
  const double determinant = dot(triangle.ab, p);
  return {dot(triangle.ac, q) / determinant, dot(s, p) / determinant, dot(way, q) / determinant, &triangle, false};
}

/// What the texture there makes of the reflectance.
Colour OpticsTwin::pattern(const Hit& hit, const Rays& rays) const {
  const DrawnTriangle& drawn = geometry_.drawn[hit.triangle->index];
  const Mesh& mesh = scene_.meshes[drawn.mesh];
  const std::uint32_t which = texture_of(scene_, mesh);
  if (which == kNone) return {1, 1, 1};
  const Texture& texture = scene_.textures[which];
  const Repeats repeats = texture_repeats(scene_, mesh, texture);
  const auto texel = [&](const Hit& at) {
    const auto mix = [&](const std::int32_t (&corner)[3]) {
      return (corner[0] + at.b * (corner[1] - corner[0]) + at.c * (corner[2] - corner[0])) / 256.0;
    };
    return std::array<double, 2>{mix(drawn.u) * repeats.u / mesh.map_width() * texture.width,
                                 (1 - mix(drawn.v) * repeats.v / mesh.map_height()) * texture.height};
  };
  const std::array<double, 2> here = texel(hit);
  double step = 0;
  for (int k = 1; k < 3; ++k) {
    const std::array<double, 2> there = texel(on_plane(*hit.triangle, rays.from[k], rays.way[k]));
    for (std::size_t c = 0; c < 2; ++c) step = std::max(step, 1000 * std::abs(there[c] - here[c]));
  }
  Colour shown;
  for (std::uint32_t c = 0; c < 3; ++c) {
    shown[c] = filtered_twin(texture, here[0], here[1], std::min(step, 16384.0), c) / texture.mean[c];
  }
  return shown;
}

/// The mesh's map, bilinear between the centres of sub-patches; quads and grids whose sub-patches all have values.
Colour OpticsTwin::surface(const Hit& hit, const Rays& rays) const {
  const DrawnTriangle& drawn = geometry_.drawn[hit.triangle->index];
  Colour colour{0, 0, 0};
  if (drawn.mesh == kNone) {
    const Light& light = scene_.lights[drawn.light];
    for (std::size_t c = 0; c < 3; ++c) colour[c] = light.strength * light.colour.c[c];
    return colour;
  }
  const Mesh& mesh = scene_.meshes[drawn.mesh];
  const auto mix = [&](const std::int32_t (&at)[3]) {
    return (at[0] + hit.b * (at[1] - at[0]) + hit.c * (at[2] - at[0])) / 256.0 - 0.5;
  };
  const int width = static_cast<int>(mesh.nu * mesh.su), height = static_cast<int>(mesh.nv * mesh.sv);
  const double u = std::clamp(mix(drawn.u), 0.0, width - 1.0), v = std::clamp(mix(drawn.v), 0.0, height - 1.0);
  const int u0 = std::min(static_cast<int>(u), width - 1), v0 = std::min(static_cast<int>(v), height - 1);
  const std::uint32_t source = scene_.objects[mesh.object].light;
  const Colour shown = pattern(hit, rays);
  for (std::uint32_t c = 0; c < 3; ++c) {
    const auto lx = [&](int at_u, int at_v) {
      const std::size_t at = mesh.first_sub_patch +
                             static_cast<std::size_t>(std::min(at_v, height - 1) * width + std::min(at_u, width - 1));
      const std::size_t k = at * scene_.channels + (scene_.channels == 1 ? 0 : c);
      return static_cast<double>(maps_.direct_lx[k]) + static_cast<double>(maps_.ambient_lx[k]);
    };
    const double f = u - u0, g = v - v0;
    const double mean = (1 - g) * ((1 - f) * lx(u0, v0) + f * lx(u0 + 1, v0)) +
                        g * ((1 - f) * lx(u0, v0 + 1) + f * lx(u0 + 1, v0 + 1));
    colour[c] = shown[c] * scene_.materials[mesh.material].diffuse.c[c] * mean / M_PI;
    if (source != kNone) colour[c] += scene_.lights[source].strength * scene_.lights[source].colour.c[c];
  }
  return colour;
}

/// What panes let through, 0 where something else stands in the way.
Colour OpticsTwin::passes(const Point& from, const Point& way, double end) const {
  Colour colour{1, 1, 1};
  for (const Hit& hit : hits(from, way, end)) {
    const DrawnTriangle& drawn = geometry_.drawn[hit.triangle->index];
    if (drawn.mesh == kNone && scene_.lights[drawn.light].open) continue;
    const Optics* const optics = optics_of(*hit.triangle);
    for (std::size_t c = 0; c < 3; ++c) colour[c] *= optics == nullptr ? 0 : optics->transmit.c[c];
  }
  return colour;
}

/// k (n + 2) / (2 pi) times the integral of (l.r)^n L cos over the light.
Colour OpticsTwin::highlight(const Optics& optics, const Point& at, const Point& normal, const Point& view) const {
  Colour sum{0, 0, 0};
  const Point r = along(view, -2 * dot(view, normal), normal);
  const double n = optics.highlight_exponent, strength = optics.highlight * (n + 2) / (2 * M_PI);
  const Point from = along(at, 1e-6, normal);
  const auto add = [&](const Light& light, const Point& to, double lx_before_cosine, double end) {
    const Point l = unit(to);
    const double lobe = std::pow(std::max(0.0, dot(l, r)), n), cosine = dot(l, normal);
    if (lobe < 1e-7 || cosine <= 0) return;
    const Colour left = passes(from, to, end);
    const double lx = lx_before_cosine * cosine;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += strength * lobe * lx * light.colour.c[c] * left[c];
  };
  const auto add_quad = [&](const Light& light, const std::array<Point, 4>& corner, int points) {
    const Point across = cross(sub(corner[1], corner[0]), sub(corner[2], corner[0]));
    const Point front = unit(across);
    for (int k = 0; k < points; ++k) {
      // Spread by irrational steps (Roberts 2018): the edge of a shadow never lies along a row of points.
      const double s = std::fmod(0.5 + k * 0.7548776662466927, 1), t = std::fmod(0.5 + k * 0.5698402909980532, 1);
      const Point p = along(along(corner[0], s, sub(corner[1], corner[0])), t, sub(corner[3], corner[0]));
      const Point to = sub(p, at);
      const double d = std::sqrt(dot(to, to)), other = -dot(front, to) / d;
      const double area = std::sqrt(dot(across, across)) / points;
      // Not up to the light itself: the drawn one is off by half a lattice step, and seen at a slant.
      if (other > 0) add(light, to, light.strength * other * area / (d * d), 1 - 1e-3);
    }
  };
  for (const Light& light : scene_.lights) {
    if (light.kind == LightKind::kSun) {
      add(light, along({0, 0, 0}, -1, of(light.towards)), light.strength, std::numeric_limits<double>::infinity());
    } else if (light.kind == LightKind::kPoint) {
      const Point to = sub(of(light.position), at);
      const double squared = dot(to, to) * scene_.metres_per_unit * scene_.metres_per_unit;
      const double aim = -dot(unit(to), of(light.towards));
      const double intensity = light.aimed ? std::pow(std::max(0.0, aim), light.cosine_exponent) : 1;
      add(light, to, light.strength * intensity / squared, 1);
    } else if (light.kind == LightKind::kArea) {  // parallelograms only
      add_quad(light, {of(light.corners[0]), of(light.corners[1]), of(light.corners[2]), of(light.corners[3])},
               light_points);
    } else {
      const Object& object = scene_.objects[light.object];
      for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
        const Vec3* const v = &scene_.vertices[scene_.meshes[m].first_vertex];  // quads only
        add_quad(light, {of(v[0]), of(v[1]), of(v[2]), of(v[3])}, light_points);
      }
    }
  }
  return sum;
}

/// Openings, from behind, and from both sides if what stands outside is to be seen.
bool OpticsTwin::is_gone_by(const Hit& hit) const {
  const DrawnTriangle& drawn = geometry_.drawn[hit.triangle->index];
  return drawn.mesh == kNone && scene_.lights[drawn.light].open && (!hit.front || !scene_.background.empty());
}

Colour OpticsTwin::trace(const Rays& rays, int depth) const {
  const Point &from = rays.from[0], &way = rays.way[0];
  Colour sum{0, 0, 0}, part{1, 1, 1};
  for (const Hit& hit : hits(from, way, std::numeric_limits<double>::infinity())) {
    if (is_gone_by(hit)) continue;
    const Optics* const optics = optics_of(*hit.triangle);
    Colour here{0, 0, 0};
    if (hit.front) here = surface(hit, rays);
    if (hit.front && optics != nullptr) {
      const Point at = along(from, hit.t, way), &n = hit.triangle->normal;
      if (optics->highlight > 0) {
        const Colour shine = highlight(*optics, at, n, unit(way));
        for (std::size_t c = 0; c < 3; ++c) here[c] += shine[c];
      }
      if (depth > 0 && optics->reflect.c[0] + optics->reflect.c[1] + optics->reflect.c[2] > 0) {
        Rays back;
        for (std::size_t k = 0; k < 3; ++k) {
          const double t = k == 0 ? hit.t : on_plane(*hit.triangle, rays.from[k], rays.way[k]).t;
          back.from[k] = along(rays.from[k], t, rays.way[k]);
          back.way[k] = along(rays.way[k], -2 * dot(rays.way[k], n), n);
        }
        const Colour seen = trace(back, depth - 1);
        for (std::size_t c = 0; c < 3; ++c) here[c] += optics->reflect.c[c] * seen[c];
      }
    }
    bool on = false;
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += part[c] * here[c];
      part[c] *= optics == nullptr ? 0 : optics->transmit.c[c];
      on = on || part[c] > 0;
    }
    if (!on) return sum;
  }
  const Colour seen = background(way);
  for (std::size_t c = 0; c < 3; ++c) sum[c] += part[c] * seen[c];
  return sum;
}

OpticsTwin::Rays OpticsTwin::rays_at(double x, double y) const {
  const auto& g = grid_;
  const double step = 1 / geometry_.lattice.steps_per_unit;
  Rays rays;
  for (std::size_t k = 0; k < 3; ++k) {
    const double at_x = std::ldexp(x, -static_cast<int>(g.split)) +
                        (k == 1 ? std::ldexp(1e-3, -static_cast<int>(g.parts)) : 0), at_y = k == 2 ? y + 1e-3 : y;
    const auto way = [&](std::int64_t d0, std::int64_t dx, std::int64_t dy) {
      return static_cast<double>(d0) + at_x * static_cast<double>(dx) + at_y * static_cast<double>(dy);
    };
    rays.from[k] = {step * g.eye.x, step * g.eye.y, step * g.eye.z};
    rays.way[k] =
        unit({way(g.d0.x, g.dx.x, g.dy.x), way(g.d0.y, g.dx.y, g.dy.y), way(g.d0.z, g.dx.z, g.dy.z)});
  }
  return rays;
}

/// What is seen there first, and from which side.
std::pair<std::uint32_t, bool> OpticsTwin::first(double x, double y) const {
  const Rays rays = rays_at(x, y);
  for (const Hit& hit : hits(rays.from[0], rays.way[0], std::numeric_limits<double>::infinity())) {
    if (!is_gone_by(hit)) return {hit.triangle->index, hit.front};
  }
  return {kNone, false};
}

/// Adds what part of a row shows: each piece of a surface by the value in its middle. Pieces end between two of nine
/// places that see different things, and are found by halving.
void OpticsTwin::add_part(double x0, double x1, double y, double weight, Colour& mean) const {
  std::vector<double> ends{x0};
  for (int k = 0; k < 8; ++k) {
    double low = x0 + (x1 - x0) * k / 8, high = x0 + (x1 - x0) * (k + 1) / 8;
    const auto at_low = first(low, y);
    if (at_low == first(high, y)) continue;
    for (int turn = 0; turn < 20; ++turn) {
      const double middle = (low + high) / 2;
      (first(middle, y) == at_low ? low : high) = middle;
    }
    ends.push_back(high);
  }
  ends.push_back(x1);
  for (std::size_t k = 1; k < ends.size(); ++k) {
    add_shown(luminance((ends[k - 1] + ends[k]) / 2, y), weight * (ends[k] - ends[k - 1]) / (x1 - x0), mean);
  }
}

void OpticsTwin::add_shown(const Colour& sample, double weight, Colour& mean) const {
  const Display& display = scene_.display;
  for (std::size_t c = 0; c < 3; ++c) {
    const double range = display.max_cd_m2 - display.min_cd_m2, v = (sample[c] - display.min_cd_m2) / range;
    const double shown = display.roll && v > 0.5 ? display.min_cd_m2 + range * (1 - 0.25 / v) : sample[c];
    mean[c] += weight * std::min(shown, display.max_cd_m2);
  }
}

std::array<int, 3> OpticsTwin::level(std::uint32_t px, std::uint32_t py, double dx, double dy) const {
  const std::uint32_t across = 1u << grid_.parts;
  const double width = 1u << (grid_.split - grid_.parts);
  const Display& display = scene_.display;
  std::array<int, 3> level{};
  Colour mean{0, 0, 0};
  for (std::uint32_t j = 0; j < across; ++j) {
    for (std::uint32_t i = 0; i < across; ++i) {
      const double x = width * (px * across + i + dx), y = py * across + j + dy;
      if (grid_.split == 0) {
        add_shown(luminance(x, y), 1, mean);
      } else {
        add_part(x, x + width, y, 1.0 / (across * across), mean);
      }
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double v = std::clamp((mean[c] - display.min_cd_m2) / (display.max_cd_m2 - display.min_cd_m2), 0.0, 1.0);
    const double srgb = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    level[c] = static_cast<int>(std::lround(255 * srgb));
  }
  return level;
}

}  // namespace shodo
