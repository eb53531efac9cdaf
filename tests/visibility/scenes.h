// Scenes built by hand for the tests of exact visibility: quads, triangles, grids and lights in plain vectors.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "base/arena.h"
#include "visibility/geometry.h"
#include "visibility/intersector.h"

namespace shodo {

/// Grows, then place() fits the scene's box around it and places it.
class HandMadeScene {
 public:
  std::uint32_t object() {
    Object object;
    object.first_mesh = static_cast<std::uint32_t>(meshes_.size());
    objects_.push_back(object);
    return static_cast<std::uint32_t>(objects_.size() - 1);
  }
  std::uint32_t quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, std::uint32_t nu = 1,
                     std::uint32_t nv = 1, std::uint32_t su = 1, std::uint32_t sv = 1) {
    return add(MeshKind::kQuad, {a, b, c, d}, 1, 1, nu, nv, su, sv);
  }
  std::uint32_t triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t n = 1, std::uint32_t s = 1) {
    return add(MeshKind::kTriangle, {a, b, c}, 1, 1, n, n, s, s);
  }
  /// `columns` x `rows` vertices, row by row; one patch a cell.
  std::uint32_t grid(std::uint32_t columns, std::uint32_t rows, const std::vector<Vec3>& vertices,
                     std::uint32_t per_u = 1, std::uint32_t per_v = 1, std::uint32_t su = 1, std::uint32_t sv = 1) {
    return add(MeshKind::kGrid, vertices, columns - 1, rows - 1, per_u * (columns - 1), per_v * (rows - 1), su, sv);
  }
  Mesh& mesh(std::uint32_t m) { return meshes_[m]; }
  std::uint32_t area_light(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, bool open = false) {
    Light light;
    light.kind = LightKind::kArea;
    light.open = open;
    light.corners[0] = a;
    light.corners[1] = b;
    light.corners[2] = c;
    light.corners[3] = d;
    light.position = 0.25 * (a + b + c + d);
    lights_.push_back(light);
    return static_cast<std::uint32_t>(lights_.size() - 1);
  }
  std::uint32_t point_light(const Vec3& at) {
    Light light;
    light.position = at;
    lights_.push_back(light);
    return static_cast<std::uint32_t>(lights_.size() - 1);
  }
  /// The six faces, fronts outwards, or inwards for a room.
  void box(const Vec3& low, const Vec3& high, bool inwards = false) {
    const Vec3 v[8] = {{low.x, low.y, low.z},    {high.x, low.y, low.z}, {high.x, high.y, low.z},
                       {low.x, high.y, low.z},   {low.x, low.y, high.z}, {high.x, low.y, high.z},
                       {high.x, high.y, high.z}, {low.x, high.y, high.z}};
    const int face[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}};
    for (const auto& f : face) {
      if (inwards) {
        quad(v[f[3]], v[f[2]], v[f[1]], v[f[0]]);
      } else {
        quad(v[f[0]], v[f[1]], v[f[2]], v[f[3]]);
      }
    }
  }
  /// Every coordinate through `map`, before placing.
  template <class Map>
  void transform(Map map) {
    for (Vec3& v : vertices_) v = map(v);
    for (Light& light : lights_) {
      light.position = map(light.position);
      for (Vec3& v : light.corners) v = map(v);
    }
  }
  /// Half extent of the lattice's cube; 0: that of the scene, as the reader makes it, and centred.
  void place(double half_extent = 0) {
    Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    const auto include = [&](const Vec3& v) {
      low = {std::fmin(low.x, v.x), std::fmin(low.y, v.y), std::fmin(low.z, v.z)};
      high = {std::fmax(high.x, v.x), std::fmax(high.y, v.y), std::fmax(high.z, v.z)};
    };
    for (const Vec3& v : vertices_) include(v);
    for (const Light& light : lights_) {
      if (light.kind == LightKind::kPoint) include(light.position);
      if (light.kind == LightKind::kArea) {
        for (const Vec3& v : light.corners) include(v);
      }
    }
    if (half_extent == 0) {
      scene.origin = 0.5 * (low + high);
      transform([&](const Vec3& v) { return v - scene.origin; });
      scene.half_extent = 0.5 * (high - low);
    } else {
      scene.half_extent = {half_extent, half_extent, half_extent};
    }
    scene.objects = objects_;
    scene.meshes = meshes_;
    scene.vertices = vertices_;
    scene.lights = lights_;
    memory_.resize(arena_bytes / 8 + 1);
    arena = Arena(memory_.data(), arena_bytes);
    status = place_scene(scene, arena, geometry);
  }

  Scene scene;
  Geometry geometry;
  Arena arena{nullptr, 0};
  Status status;
  std::size_t arena_bytes = std::size_t{1} << 22;

 private:
  std::uint32_t add(MeshKind kind, const std::vector<Vec3>& vertices, std::uint32_t cells_u, std::uint32_t cells_v,
                    std::uint32_t nu, std::uint32_t nv, std::uint32_t su, std::uint32_t sv) {
    if (objects_.empty()) object();
    Mesh mesh;
    mesh.kind = kind;
    mesh.object = static_cast<std::uint32_t>(objects_.size() - 1);
    mesh.first_vertex = static_cast<std::uint32_t>(vertices_.size());
    mesh.cells_u = cells_u;
    mesh.cells_v = cells_v;
    mesh.nu = nu;
    mesh.nv = nv;
    mesh.su = su;
    mesh.sv = sv;
    mesh.first_patch = scene.patch_count;
    mesh.first_sub_patch = scene.sub_patch_count;
    scene.patch_count += mesh.patch_count();
    scene.sub_patch_count += mesh.sub_patch_count();
    vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
    meshes_.push_back(mesh);
    ++objects_.back().mesh_count;
    return static_cast<std::uint32_t>(meshes_.size() - 1);
  }

  std::vector<Object> objects_;
  std::vector<Mesh> meshes_;
  std::vector<Vec3> vertices_;
  std::vector<Light> lights_;
  std::vector<std::uint64_t> memory_;
};

/// Turned by `angle` about an axis through the origin (Rodrigues).
inline Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  const Vec3 k = normalised(axis);
  return std::cos(angle) * v + std::sin(angle) * cross(k, v) + ((1 - std::cos(angle)) * dot(k, v)) * k;
}

/// A small generator of its own, so that every machine tests the same cases (splitmix64).
/// Cases of a test that can go on for longer: `make soak` sets SHODO_SOAK to how many times as many.
inline int soaked(int cases) {
  const char* times = std::getenv("SHODO_SOAK");
  const int factor = times == nullptr ? 1 : std::atoi(times);
  return cases * (factor > 1 ? factor : 1);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(next() % n); }
  std::int32_t between(std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(next() % static_cast<std::uint64_t>(high - low + 1));
  }
  double unit() { return static_cast<double>(next() >> 11) / 9007199254740992.0; }
  double signed_unit() { return 2 * unit() - 1; }

 private:
  std::uint64_t state_;
};

inline Triangle triangle_of(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  Triangle t;
  t.a = a;
  t.b = b;
  t.c = c;
  t.n = cross(b - a, c - a);
  t.d = t.n.x * a.x + t.n.y * a.y + t.n.z * a.z;
  return t;
}

/// A point that vertices may have, at most so far from the middle in each coordinate.
inline LatticePoint even_within(Random& random, std::int32_t reach) {
  return {2 * random.between(-reach / 2, reach / 2), 2 * random.between(-reach / 2, reach / 2),
          2 * random.between(-reach / 2, reach / 2)};
}

}  // namespace shodo
