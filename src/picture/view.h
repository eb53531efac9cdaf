// The camera in integers (paper 2.4): the eye is a point of the lattice, every sample a direction of whole numbers.
//
// Directions are linear, D(x, y) = d0 + x dx + y dy, on a grid of 1/8 pixel, on which samples lie: centres of the
// pixel, of its 2 x 2 and of its 4 x 4 parts. Antialiased pictures follow the middle lines of a pixel's 2 or 4 rows
// instead, cut into 256 columns a pixel; a column is seen at its left border. From here on the picture is exact, for
// these directions.
//
// Approximate: d0, dx and dy themselves. Components stay below 2^27 and those of a whole pixel's step at most 2^20,
// so that edge functions (n.dx, n below 2^41) fit 64 bits. The direction at the centre, dx and dy are each rounded by
// at most 1/2; at (a, b) pixels from the centre that is at most 4 (|a| + |b|) + 1/2 in each component, where a pixel
// is 8 |dx| wide. Of 256 lengths of the directions, within 0.4 percent, the one that rounds best is taken: 0.021
// pixels off at the corners of 1280 x 1024 and 65 degrees at the worst of 200 directions of view (0.059 with the
// longest). It is a tiny zoom and turn, the same for every antialiasing. The eye is rounded like a vertex, to even
// points: an eye on a surface lies in its plane.
#pragma once

#include <cstdint>

#include "base/lattice.h"
#include "base/wide.h"
#include "scene/scene.h"

namespace shodo {

inline constexpr std::int64_t kDirectionLimit = std::int64_t{1} << 27;
inline constexpr std::int64_t kPixelStepLimit = std::int64_t{1} << 20;

/// The camera on the grid of 1/8 pixel; (0, 0) is the picture's upper left corner.
struct View {
  LatticePoint eye;
  LatticeVector d0, dx, dy;
};

/// Where a picture is looked at: column x and row y count from the upper left corner.
struct SampleGrid {
  LatticePoint eye;
  LatticeVector d0, dx, dy;      // direction at (0, 0); the step of 2^split columns; of a row
  LatticeVector row_of;          // d0 x dx: P.row_of / P.depth_of is the row at which P is seen; components within 2^48
  LatticeVector depth_of;        // dx x dy: positive for what lies before the eye; components within 2^41
  std::uint32_t columns = 0, rows = 0;
  std::uint32_t split = 0;       // 0: columns are samples; else there are 2^split in a pixel
  std::uint32_t parts = 0;       // then 2^parts rows in a pixel, and as many parts of each (picture/sample_run.h)

  /// Times 2^split, so that it is whole.
  LatticeVector direction(std::int64_t x, std::int64_t y) const;
  /// From a part of a row to the next one, and to the one below, as direction() has it.
  LatticeVector across() const { return times(dx, split - parts); }
  LatticeVector down() const { return times(dy, split); }

 private:
  static LatticeVector times(const LatticeVector& a, std::uint32_t bits) {
    return {a.x * (1 << bits), a.y * (1 << bits), a.z * (1 << bits)};
  }
};

/// Pinhole with square pixels; look and up may be given in any length. An eye that looks along `up` gets another up
/// axis.
View view_of(const Camera& camera, const Lattice& lattice, std::uint32_t width, std::uint32_t height);

inline constexpr std::uint32_t kColumnBits = 8;  // of an antialiased picture, a pixel

/// `antialias` samples a pixel: 1, 4 or 16.
SampleGrid sample_grid(const View& view, std::uint32_t width, std::uint32_t height, std::uint32_t antialias);

/// What pictures are drawn on: one sample a pixel, or the columns of 2 or 4 rows a pixel for `antialias` 4 and 16.
SampleGrid picture_grid(const View& view, std::uint32_t width, std::uint32_t height, std::uint32_t antialias);

/// a.b where 64 bits do not do: up to 2^69.
constexpr Int128 dot_wide(const LatticeVector& a, const LatticeVector& b) {
  return multiply(a.x, b.x) + multiply(a.y, b.y) + multiply(a.z, b.z);
}

}  // namespace shodo
