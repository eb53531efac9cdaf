#include "cli/report_workstation.h"

#include <algorithm>

#include "base/decimal.h"

namespace shodo {

namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t start = text.find_first_not_of(kSpace);
  return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

/// Whether every brace is closed: a file cut short is no object.
bool is_object(std::string_view text) {
  const auto count = [&](char c) { return std::count(text.begin(), text.end(), c); };
  return trimmed(text).starts_with('{') && count('{') == count('}');
}

/// What follows `"name":`; empty if there is none.
std::string_view value_of(std::string_view object, std::string_view name) {
  const std::string key = std::string(1, '"').append(name).append(1, '"');
  for (std::size_t at = object.find(key); at != std::string_view::npos; at = object.find(key, at + 1)) {
    const std::string_view rest = trimmed(object.substr(at + key.size()));
    if (rest.starts_with(':')) return trimmed(rest.substr(1));
  }
  return {};
}

bool number_of(std::string_view object, std::string_view name, double& value) {
  const std::string_view text = value_of(object, name);
  const DecimalResult number = parse_decimal(text.substr(0, text.find_first_of(" \t\r\n,}")));
  value = number.value;
  return number.error == DecimalError::none && value >= 0;
}

}  // namespace

bool workstation_seconds(std::string_view json, std::string_view room, std::optional<WorkstationSeconds>& seconds) {
  seconds.reset();
  if (json.empty()) return true;
  if (!is_object(json)) return false;
  std::string_view object = value_of(json, room);
  if (!object.starts_with('{')) return true;  // a number of another room
  object = object.substr(0, object.find('}'));
  WorkstationSeconds s;
  if (!number_of(object, "direct", s.direct) || !number_of(object, "form_factors", s.form_factors) ||
      !number_of(object, "solution", s.solution) || !number_of(object, "map", s.map) ||
      !number_of(object, "picture", s.picture) || !number_of(object, "total", s.total))
    return false;
  const std::string_view options = value_of(object, "options");
  if (options.starts_with('"')) s.options = std::string(options.substr(1, options.find('"', 1) - 1));
  seconds = std::move(s);
  return true;
}

}  // namespace shodo
