// A slow, obvious ray caster for mirrors, glass, textures, highlights and the background: recursion, doubles, every
// triangle at every ray, lights by hundreds of points. What a texture's neighbours are, two more rays find, a
// thousandth of a sample off, that meet the same planes. Shares no code with the picture; the drawn triangles and the
// directions of the samples are its input.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "map/illuminance_map.h"
#include "picture/view.h"
#include "scene/scene.h"
#include "visibility/geometry.h"

namespace shodo {

class OpticsTwin {
 public:
  using Point = std::array<double, 3>;
  using Colour = std::array<double, 3>;  // cd/m2

  OpticsTwin(const Scene& scene, const Geometry& geometry, const IlluminanceMaps& maps, const SampleGrid& grid);

  /// Luminance at a place of the grid: column and row.
  Colour luminance(double x, double y) const { return trace(rays_at(x, y), 8); }
  /// Of a pixel, as 8-bit sRGB: its sample, or the mean of the surfaces along its rows by what they cover, each shaded
  /// in the middle of every half or quarter of a pixel; none above white. Moved by so many samples, or parts of a
  /// pixel.
  std::array<int, 3> level(std::uint32_t px, std::uint32_t py, double dx = 0, double dy = 0) const;

  int light_points = 2000;  // of an area light

 private:
  struct Triangle {
    Point a, ab, ac, normal;
    std::uint32_t index;
  };
  struct Hit {
    double t, b, c;
    const Triangle* triangle;
    bool front;
  };

  /// A sample's ray, and those a thousandth of a sample right of it and below.
  struct Rays {
    Point from[3], way[3];
  };

  Rays rays_at(double x, double y) const;
  std::pair<std::uint32_t, bool> first(double x, double y) const;
  bool is_gone_by(const Hit& hit) const;
  void add_part(double x0, double x1, double y, double weight, Colour& mean) const;
  void add_shown(const Colour& sample, double weight, Colour& mean) const;
  std::vector<Hit> hits(const Point& from, const Point& way, double end) const;
  Colour trace(const Rays& rays, int depth) const;
  Colour surface(const Hit& hit, const Rays& rays) const;
  Colour pattern(const Hit& hit, const Rays& rays) const;
  static Hit on_plane(const Triangle& triangle, const Point& from, const Point& way);
  Colour background(const Point& way) const;
  Colour highlight(const Optics& optics, const Point& at, const Point& normal, const Point& view) const;
  Colour passes(const Point& from, const Point& way, double end) const;
  const Optics* optics_of(const Triangle& triangle) const;

  const Scene& scene_;
  const Geometry& geometry_;
  const IlluminanceMaps& maps_;
  const SampleGrid& grid_;
  std::vector<Triangle> triangles_;
};

}  // namespace shodo
