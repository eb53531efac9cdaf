// A report before it is HTML, Markdown or CSV: headings, paragraphs, tables and plots.
//
// All three writers take their numbers from the same cells, so they can't contradict each other: CSV has them in full,
// the others rounded by the same rule.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace shodo {

enum class CellKind : std::uint8_t {
  kEmpty,
  kText,
  kNumber,   // all digits, in groups of three: 142,262
  kCount,    // three digits and a unit: 22.0 M
  kBytes,    // three digits and a unit: 1.90 MB
  kPercent,  // a part of one, three digits: 1.23 %
  kReal,     // three digits
};

struct Cell {
  CellKind kind = CellKind::kEmpty;
  double value = 0;
  std::string text;

  static Cell words(std::string text) { return {CellKind::kText, 0, std::move(text)}; }
  static Cell number(std::uint64_t value) { return {CellKind::kNumber, static_cast<double>(value), {}}; }
  static Cell count(std::uint64_t value) { return {CellKind::kCount, static_cast<double>(value), {}}; }
  static Cell bytes(std::uint64_t value) { return {CellKind::kBytes, static_cast<double>(value), {}}; }
  static Cell percent(double part) { return {CellKind::kPercent, part, {}}; }
  static Cell real(double value) { return {CellKind::kReal, value, {}}; }
};

/// As people read it; "-" if it is empty.
std::string shown_text(const Cell& cell);
/// As a machine reads it: counts in full, other numbers as %.9g, parts of one and not percent; nothing if it is empty.
std::string exact_text(const Cell& cell);

struct Column {
  std::string name;   // in CSV
  std::string title;  // in the others
  bool left = false;  // words, set from the left
};

struct Table {
  std::string file;   // of the CSV: tables of one file follow each other in it and have the same columns
  std::string scene;  // first column there
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  std::vector<std::uint8_t> strong;  // per row, 1: set apart; may be shorter
};

/// A point of a scatter plot. x and y above 0.
struct PlotPoint {
  double x = 0, y = 0;
  std::uint32_t number = 0;  // printed beside it; 0: nothing is
  std::uint32_t group = 0;   // its mark
  bool efficient = false;    // ringed, and on the line
  std::string told;          // shown when pointed at
};

struct Plot {
  std::string file;  // name of its own SVG file, beside report.md
  std::string title, x_title, y_title;
  std::vector<std::string> groups;  // names, by PlotPoint::group
  std::vector<PlotPoint> points;
};

struct Heading {
  int level = 1;
  std::string text;
};

struct Paragraph {
  std::string text;
};

struct Document {
  std::string title;
  std::vector<std::variant<Heading, Paragraph, Table, Plot>> blocks;

  void heading(int level, std::string text) { blocks.emplace_back(Heading{level, std::move(text)}); }
  void paragraph(std::string text) { blocks.emplace_back(Paragraph{std::move(text)}); }
};

std::string html_text(const Document& document);
std::string markdown_text(const Document& document);

struct NamedText {
  std::string name, text;
};

/// Every CSV file, in the order of the tables.
std::vector<NamedText> csv_files(const Document& document);
/// Every plot as an SVG file.
std::vector<NamedText> plot_files(const Document& document);

/// `text` with &, <, > and " as entities.
std::string escaped(std::string_view text);

/// The plot as one element; self-contained, no scripts, axes logarithmic.
std::string svg_text(const Plot& plot);

}  // namespace shodo
