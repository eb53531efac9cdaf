// One table says everything of an option: its name, what it takes, who takes it, its help. Reading, the messages and
// --help all follow it. A second one does so for commands.
#pragma once

#include <span>
#include <string_view>

#include "cli/arguments.h"

namespace shodo {

inline constexpr unsigned kForRender = 1, kForMap = 2, kForCheck = 4, kForReport = 8, kForDifference = 16;
inline constexpr unsigned kForOne = kForRender | kForMap | kForCheck;  // a report has its own list of flags and rules
inline constexpr unsigned kForAll = kForOne | kForReport;
inline constexpr unsigned kForPicture = kForRender | kForReport | kForCheck;
inline constexpr unsigned kForTables = kForRender | kForMap;
inline constexpr unsigned kForOutput = kForTables | kForReport;
inline constexpr unsigned kForEvery = kForAll | kForDifference;

struct CommandName {
  std::string_view name;
  Command command;
  unsigned bit;
  std::string_view usage;
  std::string_view help;
};

struct OptionRule {
  std::string_view name;
  std::string_view value;  // its name in --help; empty: takes none
  unsigned commands;
  std::string_view expected;  // in messages
  std::string_view help;
  bool (*take)(std::string_view text, Arguments& arguments);
};

std::span<const CommandName> all_commands();
std::span<const OptionRule> all_options();

}  // namespace shodo
