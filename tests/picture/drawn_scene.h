// Scenes for the tests of the picture, made of lattice triangles directly: nothing else of the pipeline takes part.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "picture/view.h"
#include "picture/visible_lines.h"
#include "support/collected_lines.h"
#include "support/picture_stage.h"
#include "support/picture_twin.h"

namespace shodo {

/// One lattice unit is one scene unit, so that a camera's eye is where it says.
class DrawnScene {
 public:
  DrawnScene() : memory_(new std::byte[kBytes]), arena_(memory_.get(), kBytes) {
    Mesh mesh;
    meshes_.push_back(mesh);
    objects_.push_back({});
    objects_[0].mesh_count = 1;
    Material material;
    material.diffuse = {{0.5, 0.5, 0.5}};
    materials_.push_back(material);
    link();
  }

  std::uint32_t triangle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    DrawnTriangle t;
    t.vertex[0] = a;
    t.vertex[1] = b;
    t.vertex[2] = c;
    t.mesh = 0;
    drawn.push_back(t);
    return static_cast<std::uint32_t>(drawn.size() - 1);
  }
  void quad(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  /// A parallelogram with the map of mesh `m`, `width` x `height` sub-patches: a is (0, 0), b (width, 0), d (0,
  /// height).
  void mapped_quad(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d,
                   std::int32_t width, std::int32_t height, std::uint32_t m = 0) {
    const std::int32_t u[4] = {0, 256 * width, 256 * width, 0}, v[4] = {0, 0, 256 * height, 256 * height};
    const std::uint32_t first = static_cast<std::uint32_t>(drawn.size());
    quad(a, b, c, d);
    const std::uint32_t corner[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (std::uint32_t t = 0; t < 2; ++t) {
      drawn[first + t].mesh = m;
      for (std::uint32_t k = 0; k < 3; ++k) {
        drawn[first + t].u[k] = u[corner[t][k]];
        drawn[first + t].v[k] = v[corner[t][k]];
      }
    }
  }
  /// A quad mesh with a map of width x height sub-patches, and illuminance 0; mesh 0 is 1 x 1.
  std::uint32_t mesh(std::uint32_t width, std::uint32_t height) {
    Mesh mesh;
    mesh.nu = width;
    mesh.nv = height;
    mesh.first_patch = mesh.first_sub_patch = scene.sub_patch_count;
    meshes_.push_back(mesh);
    link();
    return static_cast<std::uint32_t>(meshes_.size() - 1);
  }
  Mesh& mesh(std::uint32_t m) { return meshes_[m]; }
  Material& material() { return materials_[0]; }
  Object& object() { return objects_[0]; }
  /// Fronts outwards.
  void box(const LatticePoint& low, const LatticePoint& high) {
    const LatticePoint v[8] = {{low.x, low.y, low.z},    {high.x, low.y, low.z},  {high.x, high.y, low.z},
                               {low.x, high.y, low.z},   {low.x, low.y, high.z},  {high.x, low.y, high.z},
                               {high.x, high.y, high.z}, {low.x, high.y, high.z}};
    const int face[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}};
    for (const auto& f : face) quad(v[f[0]], v[f[1]], v[f[2]], v[f[3]]);
  }

  /// After the last triangle.
  void link() {
    geometry.lattice.steps_per_unit = 1;
    geometry.drawn = drawn;
    scene.meshes = meshes_;
    scene.objects = objects_;
    scene.materials = materials_;
    scene.lights = lights;
    scene.cameras = cameras;
    scene.patch_count = 0;
    for (const Mesh& mesh : meshes_) scene.patch_count += mesh.patch_count();
    scene.sub_patch_count = scene.patch_count;
    direct_lx.resize(std::size_t{scene.sub_patch_count} * scene.channels);
    ambient_lx.resize(direct_lx.size());
    maps.direct_lx = direct_lx;
    maps.ambient_lx = ambient_lx;
    maps.hidden = hidden;
  }
  Arena& arena() { return arena_; }

  /// What every sample sees, row by row.
  std::vector<TwinHit> visible(const SampleGrid& grid) {
    link();
    const ArenaScratch scratch(arena_);
    VisibleLines lines;
    EXPECT_TRUE(lines.start(scene, geometry, grid, arena_));
    std::vector<TwinHit> seen(std::size_t{grid.columns} * grid.rows);
    for (std::uint32_t y = 0; y < grid.rows; ++y) {
      lines.begin_row(y);
      std::int32_t end = 0;
      for (VisibleSpan span; lines.next(span); end = span.x1) {
        EXPECT_LE(end, span.x0);
        EXPECT_LT(span.x0, span.x1);
        EXPECT_LE(span.x1, static_cast<std::int32_t>(grid.columns));
        for (std::int32_t x = span.x0; x < span.x1; ++x) {
          seen[std::size_t{y} * grid.columns + static_cast<std::uint32_t>(x)] = {span.triangle, span.front};
        }
      }
    }
    exact_comparisons = lines.exact_comparisons();
    return seen;
  }
  /// The picture's bytes.
  std::vector<std::uint8_t> draw(const Options& options) {
    link();
    std::vector<std::uint8_t> rgb;
    const LineSink sink = collected_in(rgb);
    EXPECT_TRUE(draw_picture(scene, geometry, maps, options, {}, arena_, sink).done());
    return rgb;
  }
  std::vector<TwinHit> twin(const SampleGrid& grid) {
    link();
    const PictureTwin twin(scene, geometry, grid);
    std::vector<TwinHit> seen;
    for (std::uint32_t y = 0; y < grid.rows; ++y) {
      for (std::uint32_t x = 0; x < grid.columns; ++x) seen.push_back(twin.hit(x, y));
    }
    return seen;
  }

  Scene scene;
  Geometry geometry;
  std::vector<DrawnTriangle> drawn;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  std::vector<float> direct_lx, ambient_lx;
  std::vector<std::uint8_t> hidden;
  IlluminanceMaps maps;
  std::uint64_t exact_comparisons = 0;

 private:
  static constexpr std::size_t kBytes = std::size_t{256} << 20;  // untouched pages cost nothing
  std::unique_ptr<std::byte[]> memory_;
  Arena arena_;
  std::vector<Mesh> meshes_;
  std::vector<Object> objects_;
  std::vector<Material> materials_;
};

inline Camera camera_at(const Vec3& eye, const Vec3& look, double fov = 60, const Vec3& up = {0, 1, 0}) {
  Camera camera;
  camera.name = "main";
  camera.eye = eye;
  camera.look = look;
  camera.up = up;
  camera.fov_degrees = fov;
  return camera;
}

/// A camera of whole numbers: looks along -z, a pixel is `pixel` wide at distance `distance`, the centre of pixel (0,
/// 0) at -x, +y of `corner`. Then lattice points at z = eye.z - distance can lie exactly on samples.
inline SampleGrid plain_grid(const LatticePoint& eye, std::uint32_t columns, std::uint32_t rows, std::int64_t pixel,
                             std::int64_t distance) {
  SampleGrid grid;
  grid.eye = eye;
  grid.dx = {pixel, 0, 0};
  grid.dy = {0, -pixel, 0};
  grid.d0 = {-pixel * (columns / 2), pixel * (rows / 2), -distance};
  const auto cross_of = [](const LatticeVector& a, const LatticeVector& b) { return cross(a, b); };
  grid.row_of = cross_of(grid.d0, grid.dx);
  grid.depth_of = cross_of(grid.dx, grid.dy);
  grid.columns = columns;
  grid.rows = rows;
  return grid;
}

}  // namespace shodo
