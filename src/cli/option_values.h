// What an option's value says, read strictly: numbers inside their range, words of a list, pairs and lists of them.
// Every function is false where the text is wrong; what it writes to is then worth nothing.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "cli/arguments.h"

namespace shodo {

/// Two parts around the first `separator`.
bool split(std::string_view text, char separator, std::string_view& left, std::string_view& right);

bool number_in(std::string_view text, double least, double most, double& value);
bool one_of(std::string_view text, std::initializer_list<std::uint32_t> allowed, std::uint32_t& value);
bool on_or_off(std::string_view text, bool& value);
bool take_text(std::string_view text, std::string& value);

// Each of the option that has its name.
bool take_memory(std::string_view text, Arguments& arguments);
bool take_segments(std::string_view text, Arguments& arguments);
bool take_size(std::string_view text, Arguments& arguments);
bool take_flags(std::string_view text, Arguments& arguments);
bool take_rules(std::string_view text, Arguments& arguments);
bool take_tiers(std::string_view text, Arguments& arguments);
bool take_false_colour(std::string_view text, Arguments& arguments);
bool take_isolux(std::string_view text, Arguments& arguments);
bool take_show(std::string_view text, Arguments& arguments);
bool take_gather(std::string_view text, Arguments& arguments);

}  // namespace shodo
