// Lookups in maps against the bilinear formula in doubles, sample by sample.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "picture/display.h"
#include "picture/texels.h"

namespace shodo {
namespace {

struct TestMap {
  TestMap(std::int32_t width, std::int32_t height, std::uint32_t channels, bool wraps, std::uint32_t most) {
    std::mt19937 random(4);
    values.resize(static_cast<std::size_t>(width * height) * channels);
    for (auto& v : values) v = static_cast<std::uint16_t>(random() % (most + 1));
    texels = {values.data(), width, height, channels, wraps};
  }
  double at(double u, double v, std::uint32_t c) const {
    const auto texel = [&](int x, int y) {
      x = texels.wraps_u ? (x % texels.width + texels.width) % texels.width
                         : std::min(std::max(x, 0), texels.width - 1);
      y = std::min(std::max(y, 0), texels.height - 1);
      return double{1} * values[static_cast<std::size_t>(y * texels.width + x) * texels.channels + c];
    };
    const double x = std::floor(u - 0.5), y = std::floor(v - 0.5), s = u - 0.5 - x, t = v - 0.5 - y;
    const int ix = static_cast<int>(x), iy = static_cast<int>(y);
    return (1 - t) * ((1 - s) * texel(ix, iy) + s * texel(ix + 1, iy)) +
           t * ((1 - s) * texel(ix, iy + 1) + s * texel(ix + 1, iy + 1));
  }
  double at(const MapPiece& piece, std::int32_t k, std::uint32_t c) const {
    return std::min(at(piece.u / 4096.0 + k * (piece.du / 65536.0), piece.v / 4096.0 + k * (piece.dv / 65536.0), c),
                    double{kWhite});
  }
  std::vector<std::uint16_t> values;
  MapTexels texels;
};

/// The display steps of a piece's samples, by channel: those of a piece at x = 0, added to nothing.
std::vector<std::uint32_t> steps_of(const TestMap& map, const MapPiece& piece) {
  const std::uint32_t channels = map.texels.channels;
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(piece.length) * channels);
  MapPiece first = piece;
  first.x = 0;
  show_piece(map.texels, first, {nullptr, nullptr, sums.data(), 0, channels, true, {}});
  return sums;
}

std::vector<MapPiece> some_pieces(std::mt19937& random, std::int32_t most_step) {
  const auto number = [&](std::int32_t least, std::int32_t most) {
    return least + static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(most - least + 1));
  };
  std::vector<MapPiece> pieces;
  for (int k = 0; k < 60; ++k) {
    const std::int32_t length = number(1, k % 3 == 0 ? 129 : 20), step = number(1, most_step);
    pieces.push_back({0, length, number(-3000, 40000), number(-3000, 30000), number(-step, step), number(-step, step)});
  }
  pieces.push_back({0, 129, 2048, 2048, 0, 0});
  pieces.push_back({0, 129, 2048, 6143, 100, 0});
  pieces.push_back({0, 129, 6144, 2048, -100, -65536});
  return pieces;
}

// Rounded to the nearest, and before that at most 0.27 step too low: 2,211 of 8,192 units after 64 samples.
TEST(ShowPiece, IsTheBilinearFormulaToADisplayStep) {
  std::mt19937 random(7);
  for (const std::uint32_t most : {8191u, 20000u, 65535u}) {
    for (const std::uint32_t channels : {1u, 3u}) {
      for (const bool wraps : {false, true}) {
        const TestMap map(9, 5, channels, wraps, most);
        for (const std::int32_t fastest : {300, 6000, 32767, 200000}) {
          for (const MapPiece& piece : some_pieces(random, fastest)) {
            const std::vector<std::uint32_t> steps = steps_of(map, piece);
            for (std::int32_t k = 0; k < piece.length; ++k) {
              for (std::uint32_t c = 0; c < channels; ++c) {
                const double truth = map.at(piece, k, c), step = steps[static_cast<std::uint32_t>(k) * channels + c];
                EXPECT_GE(step, truth - 0.5 - 0.27) << k;
                EXPECT_LE(step, truth + 0.5) << k;
              }
            }
          }
        }
      }
    }
  }
}

TEST(ShowPiece, IsExactInTheMiddlesOfTexels) {
  for (const std::int32_t width : {1, 2, 7}) {
    const TestMap map(width, 3, 3, false, 8191);
    for (std::int32_t u = 0; u < width; ++u) {
      const std::vector<std::uint32_t> steps = steps_of(map, {0, 1, 4096 * u + 2048, 4096 + 2048, 0, 0});
      for (std::uint32_t c = 0; c < 3; ++c) {
        EXPECT_EQ(steps[c], map.values[static_cast<std::size_t>(width + u) * 3 + c]);
      }
    }
  }
}

// To the screen at once, and in sums, 2^split times each, the same samples are shown.
TEST(ShowPiece, ShowsTheSameStepsAtOnceAndInSums) {
  std::mt19937 random(8);
  std::vector<std::uint8_t> level(kWhite + 1);
  fill_display_table(level);
  for (const std::uint32_t channels : {1u, 3u}) {
    const TestMap map(9, 5, channels, false, 12000);
    for (MapPiece piece : some_pieces(random, 9000)) {
      piece.x = 6;
      const std::vector<std::uint32_t> steps = steps_of(map, piece);
      std::vector<std::uint8_t> rgb(3 * 140, 77), expected = rgb;
      show_piece(map.texels, piece, {level.data(), rgb.data(), nullptr, 0, channels, false, {}});
      for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(piece.length); ++k) {
        for (std::uint32_t c = 0; c < 3; ++c) {
          expected[3 * (6 + k) + c] = level[steps[k * channels + (channels == 1 ? 0 : c)]];
        }
      }
      EXPECT_EQ(rgb, expected);
      for (const std::uint32_t split : {0u, 8u}) {
        std::vector<std::uint32_t> sums(140 * channels, 5), added = sums;
        show_piece(map.texels, piece, {level.data(), nullptr, sums.data(), split, channels, true, {}});
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(piece.length); ++k) {
          for (std::uint32_t c = 0; c < channels; ++c) {
            added[(6 + k) * channels + c] += steps[k * channels + c] << split;
          }
        }
        EXPECT_EQ(sums, added);
      }
    }
  }
}

}  // namespace
}  // namespace shodo
