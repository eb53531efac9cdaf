#include "cli/statistics_file.h"

#include <charconv>
#include <concepts>
#include <cstdio>
#include <string_view>

#include "cli/report_cases.h"
#include "shodo/shodo.h"

namespace shodo {

namespace {

/// Bytes of the UTF-8 character at the start of `text`; 0 if there is none (overlong forms aside).
std::size_t utf8_length(std::string_view text) {
  const unsigned first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((static_cast<unsigned char>(text[k]) & 0xc0) != 0x80) return 0;
  }
  return length;
}

class Json {
 public:
  Json& open(std::string_view name) {
    key(name);
    text_ += "{";
    first_ = true;
    ++depth_;
    return *this;
  }

  Json& close() {
    --depth_;
    text_ += "}";
    first_ = false;
    return *this;
  }

  template <std::unsigned_integral T>
  Json& add(std::string_view name, T value) {
    key(name);
    text_ += std::to_string(value);
    return *this;
  }

  /// JSON has no infinities and no not-a-numbers: null.
  Json& add(std::string_view name, double value) {
    key(name);
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    text_ += value - value == 0 ? std::string_view(digits, static_cast<std::size_t>(end - digits)) : "null";
    return *this;
  }

  Json& add(std::string_view name, std::string_view value) {
    key(name);
    string(value);
    return *this;
  }

  std::string text() const { return "{" + text_ + "\n}\n"; }

 private:
  void key(std::string_view name) {
    if (!first_) text_ += ",";
    text_ += depth_ == 0 ? "\n  " : (first_ ? "" : " ");
    first_ = false;
    string(name);
    text_ += ": ";
  }

  /// File names may hold any bytes: those that are not UTF-8 become U+FFFD.
  void string(std::string_view value) {
    text_ += '"';
    while (!value.empty()) {
      const std::size_t length = utf8_length(value);
      add_character(length == 0 ? std::string_view("\\ufffd") : value.substr(0, length), length == 0);
      value.remove_prefix(length == 0 ? 1 : length);
    }
    text_ += '"';
  }

  void add_character(std::string_view character, bool escaped) {
    const unsigned byte = static_cast<unsigned char>(character[0]);
    if (!escaped && byte < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", byte);
      text_ += escape;
      return;
    }
    if (!escaped && (byte == '"' || byte == '\\')) text_ += '\\';
    text_ += character;
  }

  std::string text_;
  bool first_ = true;
  int depth_ = 0;
};

}  // namespace

std::string statistics_json(const Run& run) {
  const Model& model = run.model();
  const Statistics& s = model.statistics;
  Json json;
  json.add("scene", std::string_view(run.arguments().scene))
      .add("objects", s.objects)
      .add("meshes", s.meshes)
      .add("patches", s.patches);
  json.add("sub_patches", s.sub_patches).add("channels", s.channels);
  json.add("flags", flags_text(model.options.flags));
  json.add("rules", std::string_view(rules_text(model.options.rules)));
  json.open("lattice")
      .add("step", s.lattice_step)
      .add("inserted", s.vertices_inserted)
      .add("moved", s.vertices_moved)
      .add("merged_plates", run.merged_plates())
      .close();
  json.open("dropped").add("patches", s.patches_dropped).add("polygons", s.polygons_dropped).close();
  if (s.planes > 0) {
    json.open("planes").add("planes", s.planes).add("sub_patches", s.plane_sub_patches);
    json.add("segments", s.segments_planes).add("tests", s.tests_planes).close();
  }
  json.open("segments").add("direct", s.segments_direct).add("ambient", s.segments_ambient).close();
  json.open("tests").add("direct", s.tests_direct).add("ambient", s.tests_ambient).close();
  json.open("form_factors")
      .add("computed", s.form_factors_computed)
      .add("nonzeros", s.nonzeros)
      .add("bytes", s.row_bytes)
      .close();
  json.open("links").add("stored", s.links).add("to_blocks", s.block_links).add("blocks", s.blocks).close();
  json.open("rules_dropped").add("rows", s.rows_emptied).add("columns", s.columns_emptied);
  json.add("columns_restored", s.columns_restored).add("rounds", s.rule2_rounds);
  json.add("loss_bound_lx", s.rule2_bound_lx).close();
  json.open("rows").add("scaled", s.rows_scaled).add("kept", s.rows_kept).add("recomputed", s.rows_recomputed).close();
  json.open("solution").add("sweeps", s.sweeps).add("bound", s.solution_bound).close();
  json.open("memory").add("budget", s.memory_budget).add("peak", s.memory_peak);
  const char* const stages[kMemoryStageCount] = {"load", "direct", "ambient", "map", "picture"};
  for (std::uint32_t k = 0; k < kMemoryStageCount; ++k) json.add(stages[k], s.stage_peak[k]);
  json.add("lit_again", s.lit_again).add("geometry_again", s.geometry_again);
  json.add("placed_again", s.placed_again).close();
  json.open("seconds");
  for (std::uint32_t k = 0; k < kStageCount; ++k) {
    const Stage stage = static_cast<Stage>(k);
    json.add(stage_name(stage), run.watch().seconds(stage));
  }
  return json.close().text();
}

}  // namespace shodo
