// A mesh's map on the screen (paper 2.4): bilinear lookup for the samples of a piece, without one for each of them.
//
// Between the centres of four texels, a cell, the map is a + b p + c q + d p q, and p and q are linear along a piece
// (shade.h). So the value is a parabola in the sample's number: it is set up once where the piece enters a cell, and
// two additions a channel take it from sample to sample. A room's walls have some 11 samples to a cell.
//
// Approximate: values have 13 fraction bits of a display step, and fall short of the formula by at most 0.27 step
// (3 + 3 k + k (k - 1) / 2 units after k samples, of which there are 64 at most), before they are rounded to the
// nearest step: so they are never negative.
#pragma once

#include <cstdint>

#include "picture/display.h"
#include "picture/shade.h"

namespace shodo {

/// A mesh's part of the display maps. Texel centres are sub-patch centres; lookups clamp at the border of a map, or go
/// round (Mesh::wraps_u).
struct MapTexels {
  const std::uint16_t* texel = nullptr;
  std::int32_t width = 0, height = 0;
  std::uint32_t channels = 1;
  bool wraps_u = false;
};

/// Where a row's samples go: with one sample a pixel to the screen at once, else, 2^split times, to the sums of pixels.
struct SampleRow {
  const std::uint8_t* level = nullptr;  // sRGB of display steps 0 .. white
  std::uint8_t* rgb = nullptr;          // 3 a pixel
  std::uint32_t* sums = nullptr;        // [pixel * channels + channel]
  std::uint32_t split = 0;
  std::uint32_t channels = 1;
  bool to_sums = false;
  RollOff roll;                         // of maps that aren't rolled off themselves
};

/// One coordinate of a piece from cell to cell, between the centres of texels.
struct PieceAxis {
  std::int32_t cell, part;          // part: 0 .. 65535 of the cell
  std::int32_t step, mask, size;    // 16.16; mask turns the part round if the step is positive

  PieceAxis(std::int32_t start, std::int32_t step_of)
      : cell((start - 2048) >> 12), part(((start - 2048) & 4095) << 4), step(step_of), mask(step_of > 0 ? 65535 : 0),
        size(step_of < 0 ? -step_of : step_of) {}

  /// Samples from here on in the same cell.
  std::int32_t stay(std::int32_t most) const { return size == 0 ? most : (part ^ mask) / size + 1; }
  void move(std::int32_t samples) {
    const std::int32_t to = part + samples * step;
    cell += to >> 16;
    part = to & 65535;
  }
};

/// The samples of a piece one by one: display steps, beyond white too, by channel.
class PieceLookup {
 public:
  PieceLookup(const MapTexels& map, const MapPiece& piece)
      : map_(&map), u_(piece.u, piece.du), v_(piece.v, piece.dv) {}
  void next(std::uint32_t (&steps)[3]);

 private:
  const MapTexels* map_;
  PieceAxis u_, v_;
};

/// Pixels x0 <= x < x1 show the same; `steps` by channel, at most white.
void show_plain(const SampleRow& row, std::int32_t x0, std::int32_t x1, const std::uint32_t (&steps)[3]);

/// The samples of a piece, at most white each, or rolled off.
void show_piece(const MapTexels& map, const MapPiece& piece, const SampleRow& row);

/// Adds them to steps[x * channels + channel], beyond white too (optics.h).
void add_piece(const MapTexels& map, const MapPiece& piece, std::uint32_t* steps);

}  // namespace shodo
