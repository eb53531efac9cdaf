#include "cli/option_values.h"

#include <algorithm>
#include <vector>

#include "base/decimal.h"

namespace shodo {

bool split(std::string_view text, char separator, std::string_view& left, std::string_view& right) {
  const std::size_t at = text.find(separator);
  if (at == std::string_view::npos) return false;
  left = text.substr(0, at);
  right = text.substr(at + 1);
  return true;
}

bool number_in(std::string_view text, double least, double most, double& value) {
  const DecimalResult number = parse_decimal(text);
  if (number.error != DecimalError::none || !(number.value >= least && number.value <= most)) return false;
  value = number.value;
  return true;
}

bool one_of(std::string_view text, std::initializer_list<std::uint32_t> allowed, std::uint32_t& value) {
  std::uint32_t number = 0;
  if (!parse_unsigned(text, number) || std::find(allowed.begin(), allowed.end(), number) == allowed.end()) return false;
  value = number;
  return true;
}

bool on_or_off(std::string_view text, bool& value) {
  if (text != "on" && text != "off") return false;
  value = text == "on";
  return true;
}

namespace {

constexpr double kMostLux = 1e9;

/// One item of the list; none may come twice, nor 3 beside blocks or 2 beside 2+.
bool take_rule(std::string_view item, Rules& rules) {
  std::string_view name = item, value;
  const bool has_value = split(item, ':', name, value);
  if (name == "3" && !rules.rule3 && !rules.blocks) {
    rules.rule3 = true;
    return !has_value || number_in(value, 0.1, 1000, rules.rule3_diameters);
  }
  if (name == "blocks" && !rules.rule3 && !rules.blocks) {
    rules.blocks = true;
    return !has_value || number_in(value, 1e-9, 1, rules.blocks_error);
  }
  bool* const rule = item == "1"    ? &rules.rule1
                     : item == "2"  ? &rules.rule2
                     : item == "2+" ? &rules.rule2_repeated
                                    : nullptr;
  if (rule == nullptr || *rule) return false;
  *rule = true;
  return !(rules.rule2 && rules.rule2_repeated);
}

}  // namespace

bool take_memory(std::string_view text, Arguments& a) {
  unsigned shift = 0;
  if (!text.empty()) {
    const std::size_t unit = std::string_view("KMG").find(text.back());
    if (unit != std::string_view::npos) {
      shift = 10 * (static_cast<unsigned>(unit) + 1);
      text.remove_suffix(1);
    }
  }
  std::uint64_t bytes = 0;
  if (text.empty() || text.size() > 15) return false;
  for (const char c : text) {
    if (c < '0' || c > '9') return false;
    bytes = 10 * bytes + static_cast<std::uint64_t>(c - '0');
  }
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40;
  if (bytes == 0 || bytes > (kMost >> shift)) return false;
  a.memory = bytes << shift;
  return true;
}

bool take_segments(std::string_view text, Arguments& a) {
  std::string_view first, mixed;
  std::uint32_t n = 0, m = 0;
  if (!split(text, ',', first, mixed) || !one_of(first, {1, 16, 64, 256}, n) || !one_of(mixed, {1, 16, 64, 256}, m))
    return false;
  if (n > m) return false;
  a.options.segments_first = n;
  a.options.segments_mixed = m;
  return true;
}

bool take_size(std::string_view text, Arguments& a) {
  constexpr std::uint32_t kMost = 16384;
  std::string_view w, h;
  std::uint32_t width = 0, height = 0;
  if (!split(text, 'x', w, h) || !parse_unsigned(w, width) || !parse_unsigned(h, height)) return false;
  if (width < 1 || width > kMost || height < 1 || height > kMost) return false;
  a.options.width = width;
  a.options.height = height;
  return true;
}

bool take_flags(std::string_view text, Arguments& a) {
  a.options.flags = text == "off" ? FlagMode::kOff : text == "scene" ? FlagMode::kScene : FlagMode::kAuto;
  return text == "off" || text == "auto" || text == "scene";
}

bool take_rules(std::string_view text, Arguments& a) {
  Rules rules;
  if (text == "all") {
    rules.rule1 = rules.rule2 = rules.rule3 = true;
  } else if (text != "none") {
    std::string_view item, rest = text;
    for (bool more = true; more;) {
      item = rest;
      more = split(rest, ',', item, rest);
      if (!take_rule(item, rules)) return false;
    }
  }
  a.options.rules = rules;
  return true;
}

bool take_tiers(std::string_view text, Arguments& a) {
  a.options.tiers = 0;
  return text == "near" || number_in(text, 1e-9, 1, a.options.tiers);
}

bool take_false_colour(std::string_view text, Arguments& a) {
  a.measured.false_colour = true;
  std::string_view low, high;
  LuxScale& scale = a.measured.scale;
  return text == "auto" || (split(text, ',', low, high) && number_in(low, 0, kMostLux, scale.low) &&
                            number_in(high, 1e-3, kMostLux, scale.high) && scale.low < scale.high);
}

bool take_isolux(std::string_view text, Arguments& a) {
  constexpr std::size_t kMost = 100;
  a.measured.isolux = true;
  if (text == "auto") return true;
  std::string_view item, rest = text;
  for (bool more = true; more;) {
    item = rest;
    more = split(rest, ',', item, rest);
    double level = 0;
    std::vector<double>& levels = a.measured.levels;
    if (!number_in(item, 1e-3, kMostLux, level) || levels.size() == kMost) return false;
    if (!levels.empty() && level <= levels.back()) return false;
    levels.push_back(level);
  }
  return true;
}

bool take_show(std::string_view text, Arguments& a) {
  a.measured.show = text == "patches" ? MeasuredOptions::Show::kPatches : MeasuredOptions::Show::kSubPatches;
  return text == "patches" || text == "sub-patches";
}

bool take_gather(std::string_view text, Arguments& a) {
  a.options.gather_lines = 0;
  if (on_or_off(text, a.options.gather)) return true;
  a.options.gather = true;
  std::uint32_t lines = 0;
  if (!parse_unsigned(text, lines) || lines < 1 || lines > kMostGatherLines) return false;
  a.options.gather_lines = lines;
  return true;
}

bool take_text(std::string_view text, std::string& value) {
  value = text;
  return !text.empty();
}

}  // namespace shodo
