#include "picture/view.h"

#include "base/elementary.h"

namespace shodo {

namespace {

double largest_component(const Vec3& a) {
  const double x = magnitude(a.x), y = magnitude(a.y), z = magnitude(a.z);
  const double xy = x > y ? x : y;
  return xy > z ? xy : z;
}

/// To the nearest, halves away from zero: here directions become integers, and nowhere else.
std::int64_t round_component(double x) {
  const std::int64_t size = static_cast<std::int64_t>(magnitude(x) + 0.5);
  return x < 0 ? -size : size;
}

LatticeVector rounded(const Vec3& a) { return {round_component(a.x), round_component(a.y), round_component(a.z)}; }

struct Frame {
  Vec3 forward, right, down;
};

Frame frame_of(const Camera& camera) {
  Frame frame;
  frame.forward = normalised(camera.look - camera.eye);
  if (length_squared(frame.forward) == 0) frame.forward = {0, 0, -1};
  Vec3 right = cross(frame.forward, normalised(camera.up));
  if (!(length_squared(right) > 1e-24)) {
    right = cross(frame.forward, magnitude(frame.forward.z) < 0.75 ? Vec3{0, 0, 1} : Vec3{0, 1, 0});
  }
  frame.right = normalised(right);
  frame.down = cross(frame.forward, frame.right);
  return frame;
}

/// The longest directions that keep both limits; rounding adds at most 1/2 to each of up to 4 (width + height) steps.
double longest_scale(const Vec3& forward, const Vec3& dx, const Vec3& dy, double width, double height) {
  double corner = 0;
  for (const double sx : {-4.0, 4.0}) {
    for (const double sy : {-4.0, 4.0}) {
      const double size = largest_component(forward + (sx * width) * dx + (sy * height) * dy);
      if (size > corner) corner = size;
    }
  }
  const double a = largest_component(dx), b = largest_component(dy);
  const double step = 8 * (a > b ? a : b);
  const double by_corner = (static_cast<double>(kDirectionLimit) - 2 * (width + height) - 2) / corner;
  const double by_step = (static_cast<double>(kPixelStepLimit) - 8) / step;
  return by_corner < by_step ? by_corner : by_step;
}

double rounding_of(const Vec3& a) {
  const auto off = [](double x) { return magnitude(static_cast<double>(round_component(x)) - x); };
  return largest_component({off(a.x), off(a.y), off(a.z)});
}

/// Lengths a few tenths of a percent below the longest round differently: takes the best of some for this picture.
double direction_scale(const Vec3& forward, const Vec3& dx, const Vec3& dy, double width, double height) {
  constexpr int kTried = 256;
  const double longest = longest_scale(forward, dx, dy, width, height);
  double best = longest, least = 0;
  for (int k = 0; k < kTried; ++k) {
    const double scale = longest * (1 - k * (1.0 / 65536));
    const double off = width * rounding_of(scale * dx) + height * rounding_of(scale * dy);
    if (k != 0 && !(off < least)) continue;
    best = scale;
    least = off;
  }
  return best;
}

}  // namespace

LatticeVector SampleGrid::direction(std::int64_t x, std::int64_t y) const {
  const auto at = [&](std::int64_t c0, std::int64_t cx, std::int64_t cy) {
    return (c0 + y * cy) * (1 << split) + x * cx;
  };
  return {at(d0.x, dx.x, dy.x), at(d0.y, dx.y, dy.y), at(d0.z, dx.z, dy.z)};
}

View view_of(const Camera& camera, const Lattice& lattice, std::uint32_t width, std::uint32_t height) {
  const Frame frame = frame_of(camera);
  const double w = width, h = height;
  // Half the height of the picture is tan(fov / 2) wide, and has 4 h steps.
  const double step = tangent_degrees(0.5 * camera.fov_degrees) / (4 * h);
  const Vec3 dx = step * frame.right, dy = step * frame.down;
  const double scale = direction_scale(frame.forward, dx, dy, w, h);
  View view;
  view.eye = even_point(lattice, camera.eye);
  view.dx = rounded(scale * dx);
  view.dy = rounded(scale * dy);
  const LatticeVector centre = rounded(scale * frame.forward);
  const std::int64_t x = 4 * std::int64_t{width}, y = 4 * std::int64_t{height};
  view.d0 = {centre.x - x * view.dx.x - y * view.dy.x, centre.y - x * view.dx.y - y * view.dy.y,
             centre.z - x * view.dx.z - y * view.dy.z};
  return view;
}

namespace {

/// Rows a pixel, 2^n.
constexpr std::uint32_t row_bits(std::uint32_t antialias) { return antialias == 16 ? 2 : antialias == 4 ? 1 : 0; }

/// Steps of 1/8 pixel; `x` and `y`: of them, to column 0 and row 0.
SampleGrid grid_of(const View& view, std::int64_t x, std::int64_t step_x, std::int64_t y, std::int64_t step_y) {
  const LatticeVector &dx = view.dx, &dy = view.dy;
  SampleGrid grid;
  grid.eye = view.eye;
  grid.d0 = {view.d0.x + x * dx.x + y * dy.x, view.d0.y + x * dx.y + y * dy.y, view.d0.z + x * dx.z + y * dy.z};
  grid.dx = {step_x * dx.x, step_x * dx.y, step_x * dx.z};
  grid.dy = {step_y * dy.x, step_y * dy.y, step_y * dy.z};
  grid.row_of = cross(grid.d0, grid.dx);
  grid.depth_of = cross(grid.dx, grid.dy);
  return grid;
}

}  // namespace

SampleGrid sample_grid(const View& view, std::uint32_t width, std::uint32_t height, std::uint32_t antialias) {
  const std::uint32_t bits = row_bits(antialias);
  const std::int64_t step = 8 >> bits;
  SampleGrid grid = grid_of(view, step / 2, step, step / 2, step);
  grid.columns = width << bits;
  grid.rows = height << bits;
  return grid;
}

SampleGrid picture_grid(const View& view, std::uint32_t width, std::uint32_t height, std::uint32_t antialias) {
  if (antialias == 1) return sample_grid(view, width, height, 1);
  const std::uint32_t bits = row_bits(antialias);
  const std::int64_t step = 8 >> bits;
  SampleGrid grid = grid_of(view, 0, 8, step / 2, step);
  grid.split = kColumnBits;
  grid.parts = bits;
  grid.columns = width << kColumnBits;
  grid.rows = height << bits;
  return grid;
}

}  // namespace shodo
