// The picture's slow obvious twin: every direction against every triangle, in 128-bit integers and continued fractions.
//
// Nothing of src/picture is used but the sample grid's directions: no lines, no spans, no wide.h. A sample belongs to
// a triangle if its direction D, moved by a hair along dx and a hair of that along dy, lies strictly in the cone of
// the corners; the nearest wins, ties as the design states them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "picture/view.h"
#include "scene/scene.h"
#include "visibility/geometry.h"

namespace shodo {

struct TwinHit {
  std::uint32_t triangle = kNone;
  bool front = false;
  bool operator==(const TwinHit&) const = default;
};

class PictureTwin {
 public:
  /// `scene` says which lights are open; all must outlive this.
  PictureTwin(const Scene& scene, const Geometry& geometry, const SampleGrid& grid);

  /// What the sample in column x of row y sees.
  TwinHit hit(std::int64_t x, std::int64_t y) const;
  /// How many triangles hold the sample, hidden ones too.
  std::uint32_t cover(std::int64_t x, std::int64_t y) const;
  /// Map coordinates of a sample on a triangle, in sub-patches; right to about 1e-15 of the map.
  std::array<long double, 2> map_point(std::uint32_t triangle, std::int64_t x, std::int64_t y) const;

 private:
  __extension__ typedef __int128 Wide;
  using Vector = std::array<std::int64_t, 3>;

  struct Cone {
    std::uint32_t triangle = 0;
    Vector side[3];        // corner k x corner k + 1
    Vector normal;         // (b - a) x (c - a)
    std::int64_t depth = 0;  // normal . (a - eye), not 0
  };

  static Vector cross(const Vector& a, const Vector& b);
  static Wide dot(const Vector& a, const Vector& b);
  static bool inside(const Cone& cone, const Vector& d, const Vector& dx, const Vector& dy);
  int compare_depth(const Cone& a, const Cone& b, const Vector& d) const;
  bool wins_tie(const Cone& a, const Cone& b) const;
  Vector direction(std::int64_t x, std::int64_t y) const;

  std::vector<DrawnTriangle> drawn_;
  std::vector<Cone> cones_;
  SampleGrid grid_;
};

}  // namespace shodo
