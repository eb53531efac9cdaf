// The report as one HTML file: its style and its plots stand in it, it needs no script and nothing from elsewhere.
#include "cli/report_document.h"

namespace shodo {

namespace {

constexpr std::string_view kStyle = R"(
  :root { color-scheme: light; }
  body { margin: 0 auto; padding: 1.5rem 1.5rem 4rem; max-width: 1560px; background: #fff; color: #1d2126;
         font: 15px/1.5 "Helvetica Neue", Helvetica, Arial, sans-serif; }
  h1 { font-size: 1.7rem; margin: .5rem 0 1rem; }
  h2 { font-size: 1.3rem; margin: 2.6rem 0 .6rem; padding-top: .6rem; border-top: 2px solid #1f4e9c; }
  h3 { font-size: 1.05rem; margin: 1.6rem 0 .4rem; }
  p { max-width: 62rem; margin: .5rem 0; }
  .table { overflow-x: auto; margin: .8rem 0 1.2rem; }
  table { border-collapse: collapse; font-size: 11.5px; line-height: 1.35; font-variant-numeric: tabular-nums; }
  th, td { padding: .22rem .38rem; text-align: right; white-space: nowrap; border-bottom: 1px solid #e3e6ea; }
  th { vertical-align: bottom; white-space: normal; background: #eef2f8; border-bottom: 2px solid #b9c4d6; }
  th.left, td.left { text-align: left; }
  tbody tr:nth-child(even) { background: #f8f9fb; }
  tr.strong td { font-weight: 600; background: #eaf4ec; }
  .plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(460px, 1fr)); gap: 1rem; margin: 1rem 0; }
  .plots svg { width: 100%; height: auto; border: 1px solid #e3e6ea; }
  @page { size: A4 landscape; margin: 12mm; }
  @media print {
    body { padding: 0; max-width: none; font-size: 10pt; }
    table { font-size: 5.8pt; }
    th, td { padding: .1rem .15rem; }
    .table { overflow: visible; }
    h2, h3 { break-after: avoid; }
    tr, .plots svg { break-inside: avoid; }
    .plots { grid-template-columns: 1fr 1fr; }
    * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  }
)";

void add_cell(std::string& text, const char* tag, bool left, const std::string& words) {
  text += std::string("<") + tag + (left ? " class=\"left\">" : ">") + escaped(words) + "</" + tag + ">";
}

void add_table(std::string& text, const Table& table) {
  text += "<div class=\"table\"><table>\n<thead><tr>";
  for (const Column& column : table.columns) add_cell(text, "th", column.left, column.title);
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    text += r < table.strong.size() && table.strong[r] != 0 ? "<tr class=\"strong\">" : "<tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      add_cell(text, "td", table.columns[c].left, shown_text(table.rows[r][c]));
    text += "</tr>\n";
  }
  text += "</tbody></table></div>\n";
}

/// Plots that follow each other share a grid.
class HtmlBody {
 public:
  explicit HtmlBody(std::string& text) : text_(text) {}
  ~HtmlBody() { end_plots(); }

  void operator()(const Heading& heading) {
    end_plots();
    std::string tag(1, 'h');
    tag += std::to_string(heading.level);
    text_ += "<" + tag + ">" + escaped(heading.text) + "</" + tag + ">\n";
  }
  void operator()(const Paragraph& paragraph) {
    end_plots();
    text_ += "<p>" + escaped(paragraph.text) + "</p>\n";
  }
  void operator()(const Table& table) {
    end_plots();
    add_table(text_, table);
  }
  void operator()(const Plot& plot) {
    if (!in_plots_) text_ += "<div class=\"plots\">\n";
    in_plots_ = true;
    text_ += svg_text(plot);
  }

 private:
  void end_plots() {
    if (in_plots_) text_ += "</div>\n";
    in_plots_ = false;
  }

  std::string& text_;
  bool in_plots_ = false;
};

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      default: safe += c;
    }
  }
  return safe;
}

std::string html_text(const Document& document) {
  std::string text = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n";
  text += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n";
  text += "<title>" + escaped(document.title) + "</title>\n<style>" + std::string(kStyle) + "</style>\n";
  text += "</head>\n<body>\n<h1>" + escaped(document.title) + "</h1>\n";
  {
    HtmlBody body(text);
    for (const auto& block : document.blocks) std::visit(body, block);
  }
  return text + "</body>\n</html>\n";
}

}  // namespace shodo
