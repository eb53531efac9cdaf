// The camera in integers against the camera in doubles.
#include <gtest/gtest.h>

#include <cmath>

#include "picture/drawn_scene.h"

namespace shodo {
namespace {

/// How far a sample's direction is off the nominal one, in pixels, at most over the picture's corners and middles of
/// sides.
double worst_error(const Camera& camera, std::uint32_t width, std::uint32_t height) {
  const View view = view_of(camera, Lattice{1}, width, height);
  SCOPED_TRACE(camera.fov_degrees);
  const Vec3 f = normalised(camera.look - camera.eye), r = normalised(cross(f, camera.up)), d = cross(f, r);
  const double half = std::tan(camera.fov_degrees / 360 * M_PI);
  double worst = 0;
  for (const std::uint32_t x : {0u, width / 2, width}) {
    for (const std::uint32_t y : {0u, height / 2, height}) {
      const double gx = 8.0 * x, gy = 8.0 * y;
      const Vec3 direction{
          static_cast<double>(view.d0.x) + gx * static_cast<double>(view.dx.x) + gy * static_cast<double>(view.dy.x),
          static_cast<double>(view.d0.y) + gx * static_cast<double>(view.dx.y) + gy * static_cast<double>(view.dy.y),
          static_cast<double>(view.d0.z) + gx * static_cast<double>(view.dx.z) + gy * static_cast<double>(view.dy.z)};
      EXPECT_LT(std::fabs(direction.x), kDirectionLimit);
      EXPECT_LT(std::fabs(direction.y), kDirectionLimit);
      EXPECT_LT(std::fabs(direction.z), kDirectionLimit);
      const double at_x = dot(direction, r) / dot(direction, f) / half * height / 2 + width / 2.0;
      const double at_y = dot(direction, d) / dot(direction, f) / half * height / 2 + height / 2.0;
      worst = std::max(worst, std::hypot(at_x - x, at_y - y));
    }
  }
  return worst;
}

// view.h derives 0.02; directions of whole numbers below 2^20 would be 4 pixels off.
TEST(View, IsWithinATwentiethOfAPixelOfTheNominalCamera) {
  double worst = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 look{std::sin(k * 1.7), 0.6 * std::sin(k * 0.9), std::cos(k * 1.7)};
    worst = std::max(worst, worst_error(camera_at({0, 0, 0}, look, 65), 1280, 1024));
  }
  EXPECT_LT(worst, 0.05);
  EXPECT_GT(worst, 0.001);  // the measure measures
}

TEST(View, KeepsItsLimitsForAnySizeAndAngle) {
  for (const double fov : {1.0, 30.0, 65.0, 120.0, 170.0}) {
    for (const std::uint32_t width : {1u, 2u, 17u, 1280u, 16384u}) {
      for (const std::uint32_t height : {1u, 3u, 1024u}) {
        const Camera camera = camera_at({0, 0, 0}, {0.3, -0.2, 1}, fov);
        const double error = worst_error(camera, width, height);
        // A pixel is 280 units wide at 1 degree and 1280 x 1024; wide strips at wide angles are beyond any use.
        if (width < 2000 && fov < 100) {
          EXPECT_LT(error, 2) << width << ' ' << height;
        }
        const View view = view_of(camera, Lattice{1}, width, height);
        for (const LatticeVector& step : {view.dx, view.dy}) {
          for (const std::int64_t c : {step.x, step.y, step.z}) EXPECT_LE(std::abs(8 * c), kPixelStepLimit);
        }
        EXPECT_GT(dot(cross(view.dx, view.dy), {static_cast<std::int64_t>(1000 * camera.look.x),
                                               static_cast<std::int64_t>(1000 * camera.look.y),
                                               static_cast<std::int64_t>(1000 * camera.look.z)}), 0);
      }
    }
  }
}

TEST(View, KeepsItsLimitsHoweverStepsAreRounded) {
  // Steps of few units, each rounded by up to a half, 65,536 of them from the middle to the sides.
  for (int k = 0; k < 200; ++k) {
    const Vec3 look{std::sin(k * 1.7), 0.6 * std::sin(k * 0.9), std::cos(k * 1.7)};
    worst_error(camera_at({0, 0, 0}, look, 1 + k % 5), 16384, 16384);  // which asks for the limit of directions
  }
}

// Right is right, and up is up: a sample right of the centre looks right.
TEST(View, IsNotMirrored) {
  const View view = view_of(camera_at({0, 0, 0}, {0, 0, -1}), Lattice{1}, 64, 48);
  EXPECT_GT(view.dx.x, 0);
  EXPECT_LT(view.dy.y, 0);
  EXPECT_LT(view.d0.x, 0);
  EXPECT_GT(view.d0.y, 0);
  EXPECT_LT(view.d0.z, 0);
}

TEST(View, LookingAlongUpStillHasAPicture) {
  const View view = view_of(camera_at({0, 5, 0}, {0, 0, 0}), Lattice{1}, 64, 48);
  EXPECT_NE(dot_wide(cross(view.dx, view.dy), view.d0), Int128());
}

// Every antialiasing samples the same grid of 1/8 pixel, at the centres of its parts.
TEST(SampleGrid, SamplesLieOnTheGridOfAnEighthPixel) {
  const View view = view_of(camera_at({0, 0, 0}, {0.4, 0.1, -1}), Lattice{1}, 64, 48);
  for (const std::uint32_t antialias : {1u, 4u, 16u}) {
    const SampleGrid grid = sample_grid(view, 64, 48, antialias);
    const std::int64_t across = antialias == 1 ? 1 : antialias == 4 ? 2 : 4;
    EXPECT_EQ(grid.columns, 64 * across);
    EXPECT_EQ(grid.rows, 48 * across);
    for (const std::int64_t x : {std::int64_t{0}, std::int64_t{5}, 64 * across - 1}) {
      for (const std::int64_t y : {std::int64_t{0}, 48 * across - 1}) {
        // Centre of part x of `across` a pixel: (x + 1/2) / across pixels.
        const std::int64_t gx = (8 * (2 * x + 1)) / (2 * across), gy = (8 * (2 * y + 1)) / (2 * across);
        const LatticeVector d = grid.direction(x, y);
        EXPECT_EQ(d.x, view.d0.x + gx * view.dx.x + gy * view.dy.x);
        EXPECT_EQ(d.y, view.d0.y + gx * view.dx.y + gy * view.dy.y);
        EXPECT_EQ(d.z, view.d0.z + gx * view.dx.z + gy * view.dy.z);
      }
    }
  }
}

}  // namespace
}  // namespace shodo
