// How cost grows with size, from the file that `make scaling` leaves: a chapter of the report.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "cli/report_counts.h"
#include "cli/report_document.h"

namespace shodo {

/// A line a size, with the values patches, entries stored, segments, tests, bytes of rows, instructions (0: not
/// counted); its options end with --refine. False, and none, if `csv` is not empty and not such a table.
bool read_scaling(std::string_view csv, std::vector<CountedLine>& sizes);

/// x of y = c n^x, fitted by least squares of the logarithms, all above 0. 0 for fewer than two different n.
double fitted_exponent(std::span<const double> n, std::span<const double> y);

/// Nothing if there are no sizes.
void add_scaling_chapter(Document& document, const std::vector<CountedLine>& sizes);

}  // namespace shodo
