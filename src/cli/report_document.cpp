#include "cli/report_document.h"

#include <cstdio>

namespace shodo {

namespace {

template <class... Values>
std::string printed(const char* format, Values... values) {
  char text[64];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// Three digits, without an exponent where that stays short: 0.00123, 1.23, 123, 12,300.
std::string three_digits(double value);

std::string grouped(const std::string& digits) {
  std::string text;
  const std::size_t start = !digits.empty() && digits[0] == '-' ? 1 : 0;
  for (std::size_t k = 0; k < digits.size(); ++k) {
    if (k > start && (digits.size() - k) % 3 == 0) text += ',';
    text += digits[k];
  }
  return text;
}

std::string three_digits(double value) {
  const double size = value < 0 ? -value : value;
  if (size == 0) return "0";
  if (size >= 999.5) return grouped(printed("%.0f", value));
  if (size < 0.0000995) return printed("%.2e", value);
  int decimals = 0;
  for (double limit = 99.95; size < limit && decimals < 6; limit /= 10) ++decimals;
  return printed("%.*f", decimals, value);
}

std::string with_unit(double value, double base, const char* const (&units)[5]) {
  std::size_t unit = 0;
  for (; unit < 4 && value >= 0.9995 * base; ++unit) value /= base;
  if (unit == 0) return printed("%.0f", value) + units[0];
  return three_digits(value) + units[unit];
}

}  // namespace

std::string shown_text(const Cell& cell) {
  switch (cell.kind) {
    case CellKind::kEmpty: return "-";
    case CellKind::kText: return cell.text;
    case CellKind::kNumber: return grouped(printed("%.0f", cell.value));
    case CellKind::kCount: return with_unit(cell.value, 1000, {"", " k", " M", " G", " T"});
    case CellKind::kBytes: return with_unit(cell.value, 1000, {" B", " kB", " MB", " GB", " TB"});
    case CellKind::kPercent: return three_digits(100 * cell.value) + " %";
    case CellKind::kReal: return three_digits(cell.value);
  }
  return "";
}

std::string exact_text(const Cell& cell) {
  if (cell.kind == CellKind::kEmpty) return "";
  if (cell.kind == CellKind::kText) return cell.text;
  return printed(cell.kind == CellKind::kPercent || cell.kind == CellKind::kReal ? "%.9g" : "%.0f", cell.value + 0.0);
}

}  // namespace shodo
