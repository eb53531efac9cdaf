// The report as Markdown, with its plots as files beside it, and its tables as CSV.
#include <algorithm>

#include "cli/report_document.h"

namespace shodo {

namespace {

/// What would end a cell or begin markup.
std::string marked(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\n') {
      safe += ' ';
      continue;
    }
    if (std::string_view("|*_`<>[]\\").find(c) != std::string_view::npos) safe += '\\';
    safe += c;
  }
  return safe;
}

struct MarkdownBody {
  std::string& text;

  void operator()(const Heading& heading) {
    text += std::string(static_cast<std::size_t>(heading.level), '#') + " " + marked(heading.text) + "\n\n";
  }
  void operator()(const Paragraph& paragraph) { text += marked(paragraph.text) + "\n\n"; }
  void operator()(const Plot& plot) { text += "![" + marked(plot.title) + "](" + plot.file + ")\n\n"; }
  void operator()(const Table& table) {
    for (const Column& column : table.columns) text += "| " + marked(column.title) + " ";
    text += "|\n";
    for (const Column& column : table.columns) text += column.left ? "|:---" : "|---:";
    text += "|\n";
    for (const auto& row : table.rows) {
      for (const Cell& cell : row) text += "| " + marked(shown_text(cell)) + " ";
      text += "|\n";
    }
    text += "\n";
  }
};

/// Quoted where it must be (RFC 4180).
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_header(const Table& table) {
  std::string text = "scene";
  for (const Column& column : table.columns) text.append(1, ',').append(csv_field(column.name));
  return text + "\n";
}

}  // namespace

std::string markdown_text(const Document& document) {
  std::string text = "# " + marked(document.title) + "\n\n";
  MarkdownBody body{text};
  for (const auto& block : document.blocks) std::visit(body, block);
  text.pop_back();
  return text;
}

std::vector<NamedText> csv_files(const Document& document) {
  std::vector<NamedText> files;
  for (const auto& block : document.blocks) {
    const Table* table = std::get_if<Table>(&block);
    if (table == nullptr || table->file.empty()) continue;
    auto at = std::find_if(files.begin(), files.end(), [&](const NamedText& f) { return f.name == table->file; });
    if (at == files.end()) at = files.insert(files.end(), {table->file, csv_header(*table)});
    for (const auto& row : table->rows) {
      at->text += csv_field(table->scene);
      for (const Cell& cell : row) at->text.append(1, ',').append(csv_field(exact_text(cell)));
      at->text += "\n";
    }
  }
  return files;
}

}  // namespace shodo
