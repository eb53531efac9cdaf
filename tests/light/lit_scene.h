// Scenes built by hand and lit directly, for the tests of direct light.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "light/direct.h"
#include "light/polygon_factor.h"
#include "visibility/scenes.h"

namespace shodo {

/// Build, then light(): places the scene and computes its direct illuminance.
class LitScene : public HandMadeScene {
 public:
  /// Closed, fronts inwards: floor, ceiling, then the four walls, n x n patches of s x s sub-patches each.
  void room(const Vec3& low, const Vec3& high, std::uint32_t n, std::uint32_t s) {
    const Vec3 a = low, b = high;
    quad({a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}, n, n, s, s);
    quad({a.x, a.y, b.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}, n, n, s, s);
    quad({a.x, a.y, a.z}, {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, a.y, a.z}, n, n, s, s);
    quad({a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}, n, n, s, s);
    quad({a.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}, {a.x, a.y, b.z}, n, n, s, s);
    quad({b.x, a.y, a.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, n, n, s, s);
  }
  /// A point light of `intensity` cd; `change` sets what else it has. Likewise the others.
  using Change = std::function<void(Light&)>;
  void add_point(const Vec3& at, double intensity, Change change = {}) {
    const std::uint32_t l = point_light(at);
    changes_.push_back([=, this] { set(scene.lights[l], LightKind::kPoint, intensity, change); });
  }
  void add_lambertian_point(const Vec3& at, const Vec3& towards, double intensity, double exponent = 1) {
    add_point(at, intensity, [=](Light& light) {
      light.aimed = true;
      light.towards = normalised(towards);
      light.cosine_exponent = exponent;
    });
  }
  void add_area(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double luminance, bool open = false,
                Change change = {}) {
    const std::uint32_t l = area_light(a, b, c, d, open);
    changes_.push_back([=, this] { set(scene.lights[l], LightKind::kArea, luminance, change); });
  }
  /// `inside`: any point within the scene's box.
  void add_sun(const Vec3& inside, const Vec3& towards, double illuminance, Change change = {}) {
    const std::uint32_t l = point_light(inside);
    changes_.push_back([=, this] {
      scene.lights[l].towards = normalised(towards);
      set(scene.lights[l], LightKind::kSun, illuminance, change);
    });
  }
  void add_polyhedron(std::uint32_t object, const Vec3& centre, double luminance, Change change = {}) {
    const std::uint32_t l = point_light(centre);
    changes_.push_back([=, this] {
      scene.lights[l].object = object;
      scene.objects[object].light = l;
      set(scene.lights[l], LightKind::kPolyhedron, luminance, change);
    });
  }

  void light() {
    arena_bytes = std::size_t{1} << 25;
    place();
    ASSERT_TRUE(status.done()) << status.message;
    for (const auto& change : changes_) change();
    ASSERT_TRUE(build_patches(scene, geometry, arena, patches, statistics).done());
    Intersector intersector(geometry);
    status = light_directly(scene, geometry, patches, options, intersector, progress, arena, direct, statistics);
    ASSERT_TRUE(status.done() || progress.report != nullptr) << status.message;
  }

  double lux(std::uint32_t m, std::uint32_t u, std::uint32_t v, std::uint32_t channel = 0) const {
    const Mesh& mesh = scene.meshes[m];
    const std::uint32_t local = mesh.kind == MeshKind::kTriangle ? triangle_piece_order(mesh.map_width(), {u, v, false})
                                                                 : v * mesh.map_width() + u;
    return direct.sub_patch_lx[(mesh.first_sub_patch + local) * scene.channels + channel];
  }
  /// Sum of E A over a mesh, lm.
  double flux(std::uint32_t m, std::uint32_t channel = 0) const {
    const Mesh& mesh = scene.meshes[m];
    double sum = 0;
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const double area = length(sub_patch_piece(scene, mesh, k).vector_area());
      sum += area * static_cast<double>(direct.sub_patch_lx[(mesh.first_sub_patch + k) * scene.channels + channel]);
    }
    return sum * scene.metres_per_unit * scene.metres_per_unit;
  }
  double flux() const {
    double sum = 0;
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) sum += flux(m);
    return sum;
  }

  std::span<Patch> patches;
  DirectLight direct;
  Statistics statistics;
  Progress progress;
  Options options;

 private:
  static void set(Light& light, LightKind kind, double strength, const Change& change) {
    light.kind = kind;
    light.strength = strength;
    if (change) change(light);
  }

  std::vector<std::function<void()>> changes_;
};

}  // namespace shodo
