// Spreading cell means along a line (paper 2.3): a continuous curve that has the mean of each cell in that cell.
//
// Between cells the curve takes a value of fourth order, 7/12 of the two next to it less 1/12 of the two beyond
// (Colella and Woodward 1984); in a cell it is the parabola through both ends that has the cell's mean. A linear run
// of means comes out as the line itself, up to the ends; cubics come out with their own values between inner cells.
//
// Limits are set to the values between cells, which both sides share: the curve stays continuous and makes no seams,
// as limiting each parabola by itself would. Such a value stays between the means of its two cells, unless the means
// turn there: then it may go beyond by 1/6 of the lesser of the two slopes beside. And it is at most 3 times the
// lesser mean: no parabola of mean a with ends in [0, 3 a] dips below 0 (true in the corners of that square, and
// linear in the ends). The ends of a row are extrapolated by the parabola of three cells, by at most the step between
// the last two. Not limited: a parabola beside a steep step may pass its higher end, or fall below its lower one, by
// up to a third of the difference of its ends; mean, continuity and monotony cannot all be had there.
#pragma once

#include <cstdint>

namespace shodo {

/// Means of `count` cells at `mean[k * stride]`, none negative.
struct CellMeans {
  const double* mean = nullptr;
  std::uint32_t count = 0;
  std::uint32_t stride = 1;
  bool periodic = false;

  double at(std::uint32_t k) const { return mean[k * stride]; }
};

/// The curve's value between cells k - 1 and k; k from 0 to count.
double value_between(const CellMeans& cells, std::uint32_t k);

/// Means over the `parts` equal parts of every cell, in order: put(k * parts + part, mean).
template <class Put>
void spread(const CellMeans& cells, std::uint32_t parts, Put put) {
  double left = value_between(cells, 0);
  for (std::uint32_t k = 0; k < cells.count; ++k) {
    const double right = value_between(cells, k + 1);
    // left + s (right - left + bend (1 - s)), and its integral from 0 to s.
    const double bend = 6 * (cells.at(k) - 0.5 * (left + right));
    const auto integral = [&](double s) { return s * (left + s * (0.5 * (right - left + bend) - s * (bend / 3))); };
    double from = 0;
    for (std::uint32_t part = 0; part < parts; ++part) {
      const double to = integral(static_cast<double>(part + 1) / parts);
      put(k * parts + part, to > from ? (to - from) * parts : 0);
      from = to;
    }
    left = right;
  }
}

}  // namespace shodo
