// What a span of columns shows along its row (paper 2.4, antialiased): samples, and what they weigh.
//
// Sides and overtakings are known along a row to 1/256 pixel (view.h). What a map shows within a pixel of the row is
// nearly linear, so a span is shaded once a pixel, in the pixel's middle, and counts by the columns that it covers: it
// fills all its pixels but the first and the last. Their middles may lie beside the span, where its plane goes on; not
// if it nearly ends there at the horizon. Then, and where nothing is linear, on textures and where rays go on, spans
// are cut into whole parts of their row and what is left at both ends, each shaded in its own middle: as many parts of
// a pixel as there are rows in it. Spans share no column and leave none out: in a pixel's row weights are 256 in all.
// One sample a pixel (split 0): a column is a pixel, and a span one run of weight 1.
#pragma once

#include <cstdint>

namespace shodo {

/// Samples x0 <= x < x1, numbered by pixels or parts of them; that of x0 is at `column`.
struct SampleRun {
  std::int32_t x0 = 0, x1 = 0;
  std::int32_t column = 0;
  std::uint32_t bits = 0;             // 2^bits columns from one to the next, which are their weight
  std::uint32_t first = 1, last = 1;  // but for those of x0 and x1 - 1; if they are one, `first` counts

  std::int32_t column_of(std::int32_t x) const { return column + ((x - x0) << bits); }
};

/// Columns x0 .. x1 - 1, at least one, as samples in the middles of pixels, 2^split columns each.
SampleRun pixels_of(std::int32_t x0, std::int32_t x1, std::uint32_t split);

/// Cuts columns x0 .. x1 - 1 into runs of whole parts, 2^bits columns each, and of what is left, from left to right:
/// the weights of a run are all the same.
class RunWalk {
 public:
  RunWalk(std::int32_t x0, std::int32_t x1, std::uint32_t bits) : x_(x0), end_(x1), bits_(bits) {}

  bool next(SampleRun& run);

 private:
  std::int32_t x_, end_;
  std::uint32_t bits_;
};

/// Makes the first and the last pixel of a run count by their weights, after they were added as if the run filled them.
class EndPixels {
 public:
  /// sums[pixel * channels + channel], before anything is added.
  EndPixels(const SampleRun& run, std::uint32_t channels, std::uint32_t* sums);

  void weigh() const;

 private:
  const SampleRun& run_;
  std::uint32_t channels_;
  std::uint32_t *first_, *last_;
  std::uint32_t before_first_[3], before_last_[3];
};

}  // namespace shodo
