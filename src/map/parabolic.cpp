#include "map/parabolic.h"

#include "base/elementary.h"

namespace shodo {

namespace {

double lesser(double a, double b) { return a < b ? a : b; }
double greater(double a, double b) { return a > b ? a : b; }
/// Before the first of three cells, going on by their parabola.
double before(double a, double b, double c) { return 3 * a - 3 * b + c; }

/// At the outer end of a row of cells a, b, c: their parabola, on the side of the line through a and b and not farther
/// from a than b is; never negative.
double end_value(const CellMeans& cells, bool last) {
  const std::uint32_t n = cells.count;
  const auto cell = [&](std::uint32_t k) { return cells.at(last ? n - 1 - k : k); };
  if (n == 1) return cell(0);
  const double rise = cell(0) - cell(1);
  const double wanted = n == 2 ? 0.5 * rise : (5 * cell(0) - 7 * cell(1) + 2 * cell(2)) / 6;
  const double kept = rise > 0 ? lesser(greater(wanted, 0), rise) : greater(lesser(wanted, 0), rise);
  return greater(cell(0) + kept, 0);
}

/// a, b | c, d: the fourth-order value at the bar, limited.
double inner_value(double a, double b, double c, double d) {
  const double value = (7 * (b + c) - (a + d)) / 12;
  const double before_slope = b - a, after_slope = d - c;
  double low = lesser(b, c), high = greater(b, c);
  const double beyond = lesser(magnitude(before_slope), magnitude(after_slope)) / 6;
  const double middle = 0.5 * (b + c);
  if (before_slope > 0 && after_slope < 0) high = greater(high, middle + beyond);
  if (before_slope < 0 && after_slope > 0) low = lesser(low, middle - beyond);
  return greater(0, lesser(3 * lesser(b, c), lesser(high, greater(low, value))));
}

}  // namespace

double value_between(const CellMeans& cells, std::uint32_t k) {
  const std::uint32_t n = cells.count;
  if (cells.periodic) {
    const auto cell = [&](std::uint32_t at) { return cells.at(at % n); };
    return inner_value(cell(k + 2 * n - 2), cell(k + n - 1), cell(k), cell(k + 1));
  }
  if (k == 0 || k == n) return end_value(cells, k == n);
  const double b = cells.at(k - 1), c = cells.at(k);
  if (n == 2) return lesser(0.5 * (b + c), 3 * lesser(b, c));
  const double a = k >= 2 ? cells.at(k - 2) : before(b, c, cells.at(k + 1));
  const double d = k + 1 < n ? cells.at(k + 1) : before(c, b, cells.at(k - 2));
  return inner_value(a, b, c, d);
}

}  // namespace shodo
